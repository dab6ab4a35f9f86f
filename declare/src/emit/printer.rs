//! Recorded programs as text: the file, its parameters and its functions.

mod body;
mod check;

use std::collections::BTreeSet;
use std::fmt::Write;

use piola::__private::record::{RecordedFunction, RecordedOperation, RecordedProgram};
use piola::Inversion;
use piola::material::{Form, Parameter};

use super::File;
use super::language::Language;
use super::signature::{Returned, Signature};
use body::Body;

/// True if names can begin with this one, in every language.
pub(super) fn is_identifier(name: &str) -> bool {
    let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    // Others belong to the compiler.
    let is_free = !name.contains("__") && !name.ends_with('_');
    name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(is_of_name) && is_free
}

/// The file: what belongs to all energies, then the parameters, their check, and what belongs to this one.
pub(super) fn print(file: &File<'_>) -> String {
    let printer = Printer::new(file);
    let [mut shared, mut own] = [String::new(), String::new()];
    for (name, program) in printer.needed() {
        let signature = &file.signatures[name];
        let text = printer.function(signature, program);
        match signature.is_of_energy {
            true if signature.name == "at_rest" => own = text + &printer.check() + &own,
            true => own += &text,
            false => shared += &printer.language.shared(signature.name, &text),
        }
    }
    let text = printer.parameters() + &own;
    let primitives = printer.language.primitives(&[&shared[..], &text].concat());
    printer.comment() + &printer.language.guarded(primitives + &shared, text)
}

/// Operations of a function of the energy that is inlined.
const SHORT: usize = 128;

struct Printer<'a> {
    file: &'a File<'a>,
    language: Language,
    /// The name of each parameter.
    fields: Vec<String>,
    /// Text of each number among the parameters; whole exponents have no place.
    parameters: Vec<String>,
}

impl<'a> Printer<'a> {
    fn new(file: &'a File<'a>) -> Self {
        let language = Language::new(file.target, file.precision, &file.prefix);
        let description = file.energy.description();
        let mut parameters = Vec::new();
        let fields = fields(description.parameters.iter(), &language);
        for ((parameter, values), name) in description.parameters.iter().zip(file.values).zip(&fields) {
            for k in 0..values.len() {
                let is_list = matches!(parameter.form, Form::List | Form::Exponents);
                parameters.push(language.parameter(name, is_list.then_some(k)));
            }
        }
        Self { file, language, fields, parameters }
    }

    /// The functions that are requested, and those that they call, in an order in which they can be compiled.
    fn needed(&self) -> Vec<&'a RecordedFunction> {
        let wanted = self.file.wanted.iter().map(|function| function.name());
        let mut names: BTreeSet<_> = wanted.chain(["at_rest"]).collect();
        let is_needed = |(name, program): &&RecordedFunction| {
            let is_needed = names.contains(name);
            let calls = program.operations.iter().filter_map(|operation| match *operation {
                RecordedOperation::Call(name, _) if is_needed => Some(name),
                _ => None,
            });
            names.extend(calls);
            is_needed
        };
        let mut needed: Vec<_> = self.file.functions.iter().rev().filter(is_needed).collect();
        needed.reverse();
        needed
    }

    /// The description of the file and its use.
    fn comment(&self) -> String {
        let Self { file, language, .. } = self;
        let description = file.energy.description();
        let mut text = format!(
            "/* {}: an isotropic hyperelastic energy, by piola {}.\n *\n * {}\n *\n * psi = {}\n",
            safe(&description.name),
            env!("CARGO_PKG_VERSION"),
            safe(&description.summary),
            safe(&description.formula)
        );
        if !description.domain.is_empty() {
            let _ = writeln!(text, " * for {}", safe(&description.domain));
        }
        if let Inversion::Extend { epsilon } = file.inversion {
            let _ = writeln!(text, " * continued where a stretch is below {epsilon}.");
        }
        text + &language.comment()
    }

    /// The structure of the parameters.
    fn parameters(&self) -> String {
        let Self { file, language, .. } = self;
        let description = file.energy.description();
        let (mut fields, mut example) = (String::new(), Vec::new());
        for ((parameter, values), name) in description.parameters.iter().zip(file.values).zip(&self.fields) {
            let doc = safe(&parameter.doc);
            let mut numbers: Vec<_> = values.iter().map(|&value| language.literal(value)).collect();
            fields += &match parameter.form {
                Form::Exponent | Form::Exponents => {
                    format!("    /* {name} is {}, a whole exponent. */\n", numbers.join(", "))
                }
                Form::List if values.is_empty() => format!("    /* {name} has no entries. */\n"),
                Form::List => {
                    example.push(language.list(&numbers));
                    language.field(name, Some(values.len()), &doc)
                }
                _ => {
                    example.append(&mut numbers);
                    language.field(name, None, &doc)
                }
            };
        }
        if example.is_empty() {
            fields += &language.field("unused", None, "The energy has no parameters.");
            example.push(language.literal(0.0));
        }
        language.structure(&fields, &example)
    }

    /// True for a stage that is inlined, if it belongs to the energy only if it is short.
    fn is_inlined(&self, signature: &Signature) -> bool {
        let is_long = |one: &RecordedFunction| one.0 == signature.name && one.1.operations.len() > SHORT;
        signature.is_inline && !(signature.is_of_energy && self.file.functions.iter().any(is_long))
    }

    fn function(&self, signature: &Signature, program: &RecordedProgram) -> String {
        let language = &self.language;
        let comment = signature.comment.replace('\n', "\n * ");
        let mut text = format!("/* {comment} */\n{}\n", language.head(signature, self.is_inlined(signature)));
        let mut body = Body::new(self, program, signature);
        let statements = body.statements();
        let reads_parameters = |operation: &RecordedOperation| match operation {
            RecordedOperation::Parameter(_) => true,
            RecordedOperation::Call(name, _) => self.file.signatures[name].is_of_energy,
            _ => false,
        };
        if signature.is_of_energy && !program.operations.iter().any(reads_parameters) {
            text += language.parameters_are_unused();
        }
        if let (true, Some(input)) = (signature.returned == Returned::Status, signature.inputs.first()) {
            text += &language.start(&format!("{}[0]", input.name));
        }
        text + &statements + "}\n\n"
    }
}

/// The names of all parameters as fields, each another one.
fn fields<'p>(parameters: impl Iterator<Item = &'p Parameter>, language: &Language) -> Vec<String> {
    let mut fields: Vec<String> = Vec::new();
    for parameter in parameters {
        let mut name = String::new();
        for c in parameter.name.chars() {
            match c.is_ascii_alphanumeric() || c == '_' {
                true => name.push(c),
                false => _ = write!(name, "u{:x}", u32::from(c)),
            }
        }
        while language.is_reserved(&name) || fields.contains(&name) {
            name.push('_');
        }
        fields.push(name);
    }
    fields
}

/// A text in a comment.
fn safe(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
        .replace('\\', "/")
        .replace("??", "? ?")
        .replace("*/", "* /")
        .replace("/*", "/ *")
}
