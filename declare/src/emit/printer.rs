//! Recorded programs as text: the file, its parameters and its functions.

mod body;
mod check;

use std::collections::BTreeSet;
use std::fmt::Write;

use piola::__private::record::{Function, RecordedOperation, RecordedProgram, Recording};
use piola::Inversion;
use piola::material::{Form, Parameter};

use super::language::{Argument, Kind, Language};
use super::{File, PointFunction};
use body::Body;

/// True if names can begin with this one, in every language.
pub(super) fn is_identifier(name: &str) -> bool {
    let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    // Others belong to the compiler.
    let is_free = !name.contains("__") && !name.ends_with('_');
    name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(is_of_name) && is_free
}

/// The file.
pub(super) fn print(file: &File<'_>) -> String {
    let printer = Printer::new(file);
    let recordings: Vec<&Recording> =
        file.functions.iter().map(|(_, recording)| recording).chain([&file.rest]).collect();
    let mut text = String::new();
    let mut printed = BTreeSet::new();
    for recording in &recordings {
        for function in recording.functions.keys() {
            printer.function(*function, recording, &mut printed, &mut text);
        }
    }
    text += &printer.check();
    for (function, recording) in &file.functions {
        text += &printer.point_function(*function, &recording.program);
    }
    let text = printer.parameters() + &printer.language.primitives(&text) + &text;
    printer.comment() + &printer.language.guarded(text)
}

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

    /// A function, after those that it calls.
    fn function(
        &self,
        function: Function,
        recording: &Recording,
        printed: &mut BTreeSet<Function>,
        text: &mut String,
    ) {
        let Some(program) = recording.functions.get(&function).filter(|_| printed.insert(function)) else {
            return;
        };
        for operation in &program.operations {
            if let RecordedOperation::Call(called, _) = operation {
                self.function(*called, recording, printed, text);
            }
        }
        let arguments: Vec<_> = (0..program.arguments).map(|k| format!("x{k}")).collect();
        let mut list: Vec<_> = arguments.iter().map(String::as_str).map(Argument::Number).collect();
        if function.is_pair() {
            list.push(Argument::Output("second", 1));
        }
        let _ = writeln!(text, "{}", self.language.head(function.name(), &list, Kind::Number));
        let body = Body::new(self, program, arguments);
        *text += &body.statements();
        if function.is_pair() {
            let _ = writeln!(text, "    *second = {};", body.operand(program.results[1]));
        }
        let _ = writeln!(text, "    return {};\n}}\n", body.operand(program.results[0]));
    }

    fn point_function(&self, function: PointFunction, program: &RecordedProgram) -> String {
        let language = &self.language;
        let Signature { comment, inputs, outputs } = Signature::of(function);
        let mut arguments = Vec::new();
        for &(name, count) in inputs {
            arguments.extend((0..count).map(|k| format!("{name}[{k}]")));
        }
        let mut list = vec![Argument::Parameters];
        list.extend(inputs.iter().map(|&(name, count)| Argument::Input(name, count)));
        list.extend(outputs.iter().map(|&(name, count)| Argument::Output(name, count)));
        let mut text = format!("/* {comment} */\n{}\n", language.head(function.name(), &list, Kind::Status));
        if !program.operations.iter().any(|one| matches!(one, RecordedOperation::Parameter(_))) {
            text += language.parameters_are_unused();
        }
        text += &language.start(&arguments[0]);
        let body = Body::new(self, program, arguments);
        text += &body.statements();
        let mut results = program.results.iter();
        for &(name, count) in outputs {
            for (k, &result) in (0..count).zip(results.by_ref()) {
                let place = language.output(name, count, k);
                let _ = writeln!(text, "    {place} = {};", body.operand(result));
            }
        }
        let bits: Vec<_> = results
            .enumerate()
            .filter(|&(_, &result)| program.operations[result as usize] != RecordedOperation::Truth(false))
            .map(|(k, &result)| language.bit(k, &body.operand(result)))
            .collect();
        let status = if bits.is_empty() { "0u".to_owned() } else { bits.join(" | ") };
        let _ = writeln!(text, "    return {status};\n}}\n");
        text
    }
}

/// Arguments and results of a function, and the comment above it.
pub(super) struct Signature {
    comment: &'static str,
    pub(super) inputs: &'static [(&'static str, usize)],
    outputs: &'static [(&'static str, usize)],
}

impl Signature {
    pub(super) fn of(function: PointFunction) -> Self {
        const F: &[(&str, usize)] = &[("F", 9)];
        const P: (&str, usize) = ("P", 9);
        const TANGENT: &[(&str, usize)] = &[P, ("A", 81)];
        const NODES: &[(&str, usize)] = &[("x", 12), ("rest", 10)];
        const ELEMENT: &[(&str, usize)] = &[("gradient", 12), ("K", 144)];
        let (comment, inputs, outputs): (_, _, &[_]) = match function {
            PointFunction::Energy => ("The energy density psi at F, Pa.", F, &[("psi", 1)]),
            PointFunction::Stress => ("The first Piola stress P at F, Pa.", F, &[P]),
            PointFunction::Tangent => ("P and A = dP/dF at F, Pa.", F, TANGENT),
            PointFunction::Projected => (
                "P and dP/dF at F, Pa, with negative eigenvalues clamped to zero: positive semidefinite.",
                F,
                TANGENT,
            ),
            PointFunction::Absolute => {
                ("P and dP/dF at F, Pa, with the absolute values of its eigenvalues.", F, TANGENT)
            }
            PointFunction::Tetrahedron => (
                "The gradient of the energy of a linear tetrahedron, N (forces are minus it), and its stiffness, N/m, symmetric:
 * coordinate a of node i at 3 i + a, entry of K at 12 row + column. x: positions of the nodes; rest: the inverse of Dm
 * row by row, whose columns are the edges from node 0 at rest, and the volume, which is not negative.",
                NODES,
                ELEMENT,
            ),
            PointFunction::ProjectedTetrahedron => (
                "As tetrahedron, with negative eigenvalues of dP/dF clamped to zero, so that K is positive semidefinite.",
                NODES,
                ELEMENT,
            ),
            PointFunction::Blocks => (
                "psi_i, then psi_11, _22, _33, _12, _13, _23, flips (psi_i - psi_j)/(l_i - l_j) and twists
 * (psi_i + psi_j)/(l_i + l_j) of the pairs 12, 13, 23, at signed stretches, Pa.",
                &[("l", 3)],
                &[("blocks", 15)],
            ),
            PointFunction::Svd => ("F = U diag(l) V^T.", F, &[("U", 9), ("l", 3), ("V", 9)]),
        };
        Self { comment, inputs, outputs }
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
