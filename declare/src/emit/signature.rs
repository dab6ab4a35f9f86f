//! Arguments, results and comments of the functions of a file, from `functions.txt`.

use std::collections::HashMap;

use piola::__private::record::{RecordedFunction, RecordedOperation};

/// Functions, an empty line between two. A number has a name, an array also its length; `?` is a truth
/// value, `status` the four of a status. A function of `p`, the parameters, belongs to the energy, the others
/// to all. Functions whose comment is elsewhere have none here.
///
/// Stages marked `inline` are inlined, so that the arrays between them stay in registers. Long stages that
/// many functions call are not, and neither are stages that write whole matrices.
const FUNCTIONS: &str = include_str!("functions.txt");

/// Arguments and results of a function, and the comment above it.
pub(super) struct Signature {
    pub(super) name: &'static str,
    pub(super) comment: &'static str,
    pub(super) is_of_energy: bool,
    pub(super) is_inline: bool,
    pub(super) inputs: Vec<Value>,
    /// Results that are written through pointers.
    pub(super) outputs: Vec<Value>,
    /// The number of all results.
    results: usize,
    pub(super) returned: Returned,
}

/// A number or an array.
#[derive(Clone, Copy)]
pub(super) struct Value {
    pub(super) name: &'static str,
    /// Length of an array.
    pub(super) length: Option<usize>,
}

impl Value {
    pub(super) fn count(&self) -> usize {
        self.length.unwrap_or(1)
    }
}

/// The value that a function returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Returned {
    Nothing,
    /// Its first result, if there is no truth value.
    Number,
    /// Its last result.
    Truth(&'static str),
    Status,
}

/// All functions by their names.
pub(super) type Signatures = HashMap<&'static str, Signature>;

/// A function with two programs, or with other arguments or results than its signature has.
pub(super) fn contradiction(signatures: &Signatures, all: &[RecordedFunction]) -> Option<&'static str> {
    let inputs = |name: &str| signatures.get(name).map(|one| count(&one.inputs));
    for (k, (name, program)) in all.iter().enumerate() {
        let is_second = all[..k].iter().any(|before| before.0 == *name);
        if is_second || signatures.get(name).map(|one| one.results) != Some(program.results.len()) {
            return Some(name);
        }
        for operation in &program.operations {
            match *operation {
                RecordedOperation::Argument(k) if inputs(name) <= Some(k as usize) => return Some(name),
                RecordedOperation::Call(callee, ref arguments) if inputs(callee) != Some(arguments.len()) => {
                    return Some(callee);
                }
                _ => {}
            }
        }
    }
    None
}

impl Signature {
    pub(super) fn all() -> Signatures {
        let all = FUNCTIONS.trim_end().split("\n\n").filter_map(Self::parse);
        all.map(|one| (one.name, one)).collect()
    }

    fn parse(text: &'static str) -> Option<Self> {
        let (first, comment) = text.split_once('\n').unwrap_or((text, ""));
        let (call, results) = first.split_once(" -> ")?;
        let (name, inputs) = call.strip_suffix(')')?.split_once('(')?;
        let (is_inline, name) = name.strip_prefix("inline ").map_or((false, name), |name| (true, name));
        let is_of_energy = inputs == "p" || inputs.starts_with("p, ");
        let values = |text: &'static str| text.split(", ").filter(|one| *one != "p").map(value);
        let mut outputs: Vec<Value> = values(results).collect();
        let last = outputs.last()?.name;
        let returned = match last.strip_suffix('?') {
            Some(truth) => Returned::Truth(truth),
            None if last == "status" => Returned::Status,
            None if outputs[0].length.is_none() => Returned::Number,
            None => Returned::Nothing,
        };
        let results = count(&outputs) + if returned == Returned::Status { 3 } else { 0 };
        match returned {
            Returned::Status | Returned::Truth(_) => outputs.truncate(outputs.len() - 1),
            Returned::Number => _ = outputs.remove(0),
            Returned::Nothing => {}
        }
        let inputs = values(inputs).collect();
        Some(Self { name, comment, is_of_energy, is_inline, inputs, outputs, results, returned })
    }

    /// The array or number of the outputs that a result is in, and its place there; `None` for the one that
    /// is returned.
    pub(super) fn place(&self, result: usize) -> Option<(usize, usize)> {
        let result = match self.returned {
            Returned::Number => result.checked_sub(1)?,
            _ => result,
        };
        place(&self.outputs, result)
    }

    /// True if a result is a truth value.
    pub(super) fn is_truth(&self, result: usize) -> bool {
        !matches!(self.returned, Returned::Number | Returned::Nothing) && self.place(result).is_none()
    }
}

/// The number of numbers.
fn count(values: &[Value]) -> usize {
    values.iter().map(Value::count).sum()
}

/// The value that a number is in, and its place there.
pub(super) fn place(values: &[Value], mut number: usize) -> Option<(usize, usize)> {
    for (k, value) in values.iter().enumerate() {
        if number < value.count() {
            return Some((k, number));
        }
        number -= value.count();
    }
    None
}

fn value(text: &'static str) -> Value {
    let array =
        text.split_once('[').and_then(|(name, end)| Some((name, end.strip_suffix(']')?.parse().ok()?)));
    match array {
        Some((name, length)) => Value { name, length: Some(length) },
        None => Value { name: text, length: None },
    }
}

#[cfg(test)]
mod tests {
    use piola::__private::record::RecordedProgram;

    use super::*;

    #[test]
    fn every_entry_of_the_file_is_a_function() {
        assert_eq!(Signature::all().len(), FUNCTIONS.split("\n\n").count());
    }

    #[test]
    fn a_program_may_contradict_its_signature() {
        let check = |operations: &[RecordedOperation], results: &[u32], times, expected| {
            let (operations, results) = (operations.to_vec(), results.to_vec());
            let program = RecordedProgram { operations, results, guards: Default::default() };
            assert_eq!(contradiction(&Signature::all(), &vec![("ln", program); times]), expected);
        };
        let argument = RecordedOperation::Argument;
        let call = |name, arguments: &[u32]| RecordedOperation::Call(name, arguments.into());
        check(&[argument(0), call("exp", &[0])], &[1], 1, None);
        check(&[argument(0)], &[0], 2, Some("ln"));
        check(&[argument(0)], &[0, 0], 1, Some("ln"));
        check(&[argument(1)], &[0], 1, Some("ln"));
        check(&[argument(0), call("exp", &[0, 0])], &[1], 1, Some("exp"));
        check(&[argument(0), call("nameless", &[0])], &[1], 1, Some("nameless"));
    }
}
