//! Recorded programs as text: the file, its parameters and its functions.

mod body;
mod check;

use std::collections::BTreeSet;
use std::fmt::Write;

use piola::__private::record::{RecordedFunction, RecordedOperation};
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
    for function in printer.needed() {
        let signature = printer.signature(function.name);
        let text = printer.function(function, signature);
        match signature.is_of_energy {
            true if signature.name == "at_rest" => own = text + &printer.check() + &own,
            true => own += &text,
            false => shared += &printer.language.once(signature.name, &text),
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
    signatures: Vec<Signature>,
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
        Self { file, language, fields, parameters, signatures: Signature::all() }
    }

    /// What is written about a function.
    fn signature(&self, name: &str) -> &Signature {
        let found = self.signatures.iter().find(|one| one.name == name);
        debug_assert!(found.is_some(), "functions.txt has no `{name}`");
        found.unwrap_or(&self.signatures[0])
    }

    /// The functions that are requested, and those that they call, in an order in which they can be compiled.
    fn needed(&self) -> Vec<&'a RecordedFunction> {
        let wanted = self.file.wanted.iter().map(|function| function.name());
        let mut names: BTreeSet<_> = wanted.chain(["at_rest"]).collect();
        let mut needed = Vec::new();
        for function in self.file.functions.iter().rev() {
            if !names.contains(function.name) {
                continue;
            }
            needed.push(function);
            for operation in &function.program.operations {
                if let RecordedOperation::Call(name, _) = operation {
                    names.insert(name);
                }
            }
        }
        needed.reverse();
        needed
    }

    /// The description of the file and its use.
    fn comment(&self) -> String {
        let Self { file, language, .. } = self;
        let (description, prefix) = (file.energy.description(), &file.prefix);
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
        text + &format!(
            " *
 * F, P row by row: entry (i, j) at 3 i + j. dP/dF: row 3 i + j for entry (i, j) of P, column 3 k + l for entry
 * (k, l) of F, entry at 9 row + column; symmetric. Energies are densities of rest volume, Pa in SI units.
 * Stretches are signed: F = U diag(l) V^T with rotations U and V, l1 >= l2 >= |l3|. Outputs may not overlap
 * inputs.
 *
 * Functions return bits: 1 refused (outside of the domain), 2 bounded (at a pole: l2 + l3 is zero to within
 * roundings), 4 not finite, 8 filtered. With 1 or 4 the results are invalid. Call {prefix}_check once for each
 * set of parameters, on the processor that uses them. Those that the file was made with: {}.
 *
 * {}
 * Nothing is allocated, and there is no global state. Licence: MIT or Apache-2.0, as you choose. */
",
            language.example(),
            language.advice(),
        )
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

    /// True for a stage that is inlined, so that arrays between stages are in registers: neither one that
    /// many functions call and that is long, nor one that writes whole matrices.
    fn is_inlined(&self, name: &str) -> bool {
        let signature = self.signature(name);
        let is_short = |one: &RecordedFunction| one.program.operations.len() <= SHORT;
        signature.returned != Returned::Status
            && signature.inputs.iter().any(|input| input.length.is_some())
            && signature.size() < 81
            && !signature.name.starts_with("decomposition")
            && (!signature.is_of_energy
                || self.file.functions.iter().any(|one| one.name == name && is_short(one)))
    }

    fn function(&self, function: &RecordedFunction, signature: &Signature) -> String {
        let (language, program) = (&self.language, &function.program);
        let comment = signature.comment.replace('\n', "\n * ");
        let mut text =
            format!("/* {comment} */\n{}\n", language.head(signature, self.is_inlined(function.name)));
        let mut body = Body::new(self, program, signature);
        let statements = body.statements();
        if signature.is_of_energy && !statements.contains("p->") && !statements.contains("(p, ") {
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
