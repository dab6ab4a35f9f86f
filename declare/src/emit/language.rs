//! Interface of languages to the printer: words, literals, and the lines around a function.

mod c;
mod wgsl;

use piola::__private::record::{Binary, Function, RecordedOperation, Unary};

use super::{Precision, Target};

/// The type of a value within a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number,
    Truth,
}

/// An argument of a function of the file.
pub(super) enum Argument {
    /// The structure of the parameters, `p`.
    Parameters,
    /// Numbers to be read.
    Input(&'static str, usize),
    /// Numbers to be written.
    Output(&'static str, usize),
}

/// A field of the structure of the parameters, with its comment.
pub(super) enum Field {
    /// A parameter without a place.
    Absent(String),
    Number(String, String),
    List(String, usize, String),
}

/// A language, with the number format and the prefix of a file.
pub(super) trait Language {
    /// True if a field cannot have this name.
    fn is_reserved(&self, name: &str) -> bool;

    fn literal(&self, value: f64) -> String;
    fn truth(&self, truth: bool) -> String;
    /// A statement with a value that is not changed.
    fn constant(&self, kind: Kind, name: &str, value: &str) -> String;
    /// A statement with a variable that is assigned later; zeroed, if not every way assigns it.
    fn variable(&self, kind: Kind, name: &str, is_zeroed: bool) -> String;

    fn parameter(&self, name: &str, entry: Option<usize>) -> String;
    /// An entry of an output of `count` numbers.
    fn output(&self, name: &str, count: usize, entry: usize) -> String;

    fn absolute(&self, a: &str) -> String;
    fn square_root(&self, a: &str) -> String;
    fn copy_sign(&self, a: &str, b: &str) -> String;
    fn mul_add(&self, a: &str, b: &str, c: &str) -> String;
    /// The result of an operation of arithmetic, rounded before it is used.
    fn rounded(&self, result: String) -> String;
    /// The first statement of a function that returns a status, whose first input this is.
    fn start(&self, input: &str) -> String;
    fn less(&self, a: &str, b: &str) -> String;
    fn is_zero(&self, a: &str) -> String;
    fn is_finite(&self, a: &str) -> String;
    fn select(&self, mask: &str, yes: &str, no: &str) -> String;
    /// Bit k of a status.
    fn bit(&self, k: usize, truth: &str) -> String;

    /// The first line of a function from numbers to a number, and to a second one if it is a pair.
    fn head(&self, name: &str, arguments: &[String], is_pair: bool) -> String;
    /// The first line of a function that returns a status.
    fn head_of_point(&self, name: &str, arguments: &[Argument]) -> String;
    /// A statement that makes compilers accept that the parameters are not read.
    fn parameters_are_unused(&self) -> &'static str;
    /// A statement that returns a number where a condition does not hold.
    fn return_unless(&self, condition: &str, number: usize) -> String;

    /// A number in a condition on parameters.
    fn number_in_condition(&self, number: f64) -> String;
    /// A parameter in a condition.
    fn parameter_in_condition(&self, place: String) -> String;
    /// A call in a condition by its name in Rust, where it is not that of C.
    fn call_in_condition(&self, name: &str, a: &str, b: &str) -> Option<String>;

    /// The structure of the parameters, and the values that the file was made with.
    fn structure(&self, fields: &[Field], example: &[String]) -> String;
    /// Numbers of a list among those values.
    fn list(&self, numbers: &[String]) -> String;
    /// Name of the values that the file was made with.
    fn example(&self) -> String;
    /// Compiler command, for the top of the file.
    fn advice(&self) -> &'static str;
    /// Functions that programs are made of, those that one of them needs.
    fn primitives(&self, needs: &Needs<'_>) -> String;
    /// The contents below the comment, with what must stand around them.
    fn guarded(&self, text: String) -> String;
}

/// The language of a target.
pub(super) fn language(target: Target, precision: Precision, prefix: &str) -> Box<dyn Language> {
    match target {
        Target::C => Box::new(c::C::new(c::Dialect::C, precision, prefix)),
        Target::Cuda => Box::new(c::C::new(c::Dialect::Cuda, precision, prefix)),
        Target::OpenCl => Box::new(c::C::new(c::Dialect::OpenCl, precision, prefix)),
        Target::Wgsl => Box::new(wgsl::Wgsl::new(prefix)),
    }
}

/// Operations of the programs of a file, whose primitives it must have.
pub(super) struct Needs<'a>(pub(super) Vec<&'a RecordedOperation>);

impl Needs<'_> {
    /// True if a part of the primitives is needed, named like its function; `all` always is.
    fn part(&self, part: &str) -> bool {
        let unary = |operator: Unary| {
            self.any(|one| matches!(one, RecordedOperation::Unary(used, _) if *used == operator))
        };
        let binary = |operator: Binary| {
            self.any(|one| matches!(one, RecordedOperation::Binary(used, ..) if *used == operator))
        };
        let calls = |function: Function| {
            self.any(|one| matches!(one, RecordedOperation::Call(used, _) if *used == function))
        };
        match part {
            "all" => true,
            "copysign" => binary(Binary::CopySign),
            "scale" => binary(Binary::Scale),
            "leading_power" => unary(Unary::LeadingPower),
            "reciprocal_of_power" => unary(Unary::ReciprocalOfPower),
            "split" => calls(Function::Split),
            "product_error" => calls(Function::ProductError),
            _ => false,
        }
    }

    fn any(&self, is_meant: impl Fn(&RecordedOperation) -> bool) -> bool {
        self.0.iter().any(|one| is_meant(one))
    }
}

/// The needed parts of a file, each of which follows a line `//@` with its name.
fn parts(file: &str, is_needed: impl Fn(&str) -> bool) -> String {
    let parts = file.split("//@ ").filter_map(|part| part.split_once('\n'));
    parts.filter(|(name, _)| is_needed(name)).map(|(_, text)| text).collect()
}
