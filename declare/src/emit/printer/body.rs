//! The statements of a program.

use std::fmt::Write;

use piola::__private::record::{Id, RecordedOperation, RecordedProgram};

use super::Printer;
use crate::emit::language::{Kind, Language};
use crate::emit::steps::{Step, Steps};

/// Statements of a program.
pub(super) struct Body<'a> {
    printer: &'a Printer<'a>,
    program: &'a RecordedProgram,
    arguments: Vec<String>,
    steps: Steps,
}

impl<'a> Body<'a> {
    pub(super) fn new(
        printer: &'a Printer<'a>,
        program: &'a RecordedProgram,
        arguments: Vec<String>,
    ) -> Self {
        Self { printer, program, arguments, steps: Steps::of(program) }
    }

    pub(super) fn statements(&self) -> String {
        let mut text = String::new();
        for &id in &self.steps.escaping {
            let _ =
                writeln!(text, "    {}", self.language().variable(self.kind(id), &format!("t{id}"), true));
            if self.is_pair(id) {
                let second = self.language().variable(Kind::Number, &format!("s{id}"), true);
                let _ = writeln!(text, "    {second}");
            }
        }
        self.write(&self.steps.all, 1, &mut text);
        text
    }

    fn language(&self) -> &Language {
        &self.printer.language
    }

    fn write(&self, steps: &[Step], depth: usize, text: &mut String) {
        let margin = "    ".repeat(depth);
        let variable = |kind, name: &str| self.language().variable(kind, name, false);
        for step in steps {
            match step {
                Step::Compute(id) => {
                    let (name, value) = (format!("t{id}"), self.expression(*id));
                    let is_declared = self.steps.escaping.contains(id);
                    if self.is_pair(*id) && !is_declared {
                        let _ = writeln!(text, "{margin}{}", variable(Kind::Number, &format!("s{id}")));
                    }
                    let statement = match is_declared {
                        true => format!("{name} = {value};"),
                        false => self.language().constant(self.kind(*id), &name, &value),
                    };
                    let _ = writeln!(text, "{margin}{statement}");
                }
                Step::Branch { mask, selections, inner } => {
                    for &(id, _) in selections.iter().filter(|(id, _)| !self.steps.escaping.contains(id)) {
                        let _ = writeln!(text, "{margin}{}", variable(self.kind(id), &format!("t{id}")));
                    }
                    let _ = writeln!(text, "{margin}if ({}) {{", self.operand(*mask));
                    for (k, inner) in inner.iter().enumerate() {
                        if k == 1 {
                            let _ = writeln!(text, "{margin}}} else {{");
                        }
                        self.write(inner, depth + 1, text);
                        for (id, values) in selections {
                            let _ = writeln!(text, "{margin}    t{id} = {};", self.operand(values[k]));
                        }
                    }
                    let _ = writeln!(text, "{margin}}}");
                }
            }
        }
    }

    fn is_pair(&self, id: Id) -> bool {
        matches!(self.program.operations[id as usize], RecordedOperation::Call(function, _) if function.is_pair())
    }

    fn kind(&self, id: Id) -> Kind {
        use RecordedOperation::{And, IsZero, Less, Not, Or, Select, Truth};
        match self.program.operations[id as usize] {
            Truth(_) | Less(..) | IsZero(_) | Not(_) | And(..) | Or(..) => Kind::Truth,
            Select(_, yes, no) if [yes, no].iter().any(|&id| self.kind(id) == Kind::Truth) => Kind::Truth,
            _ => Kind::Number,
        }
    }

    /// An operand where it is used.
    pub(super) fn operand(&self, id: Id) -> String {
        match self.program.operations[id as usize] {
            RecordedOperation::Argument(k) => self.arguments[k as usize].clone(),
            RecordedOperation::Parameter(k) => self.printer.parameters[k as usize].clone(),
            RecordedOperation::Literal(bits) => {
                let text = self.language().literal(f64::from_bits(bits));
                if text.starts_with('-') { format!("({text})") } else { text }
            }
            RecordedOperation::Truth(truth) => self.language().truth(truth),
            RecordedOperation::Second(call) => format!("s{call}"),
            _ => format!("t{id}"),
        }
    }

    fn expression(&self, id: Id) -> String {
        let operation = &self.program.operations[id as usize];
        self.language().expression(id, operation, &|operand| self.operand(operand))
    }
}
