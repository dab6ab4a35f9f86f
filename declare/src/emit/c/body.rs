//! The statements of a program in C.

use std::fmt::Write;

use piola::__private::record::{Binary, Id, RecordedOperation, RecordedProgram, Unary};

use super::Printer;
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
            let _ = writeln!(text, "    {} t{id} = 0;", self.type_of(id));
            if self.is_pair(id) {
                let _ = writeln!(text, "    {} s{id} = 0;", self.printer.number);
            }
        }
        self.write(&self.steps.all, 1, &mut text);
        text
    }

    fn write(&self, steps: &[Step], depth: usize, text: &mut String) {
        let margin = "    ".repeat(depth);
        for step in steps {
            match step {
                Step::Compute(id) => {
                    let is_declared = self.steps.escaping.contains(id);
                    if self.is_pair(*id) && !is_declared {
                        let _ = writeln!(text, "{margin}{} s{id};", self.printer.number);
                    }
                    let kind =
                        if is_declared { String::new() } else { format!("const {} ", self.type_of(*id)) };
                    let _ = writeln!(text, "{margin}{kind}t{id} = {};", self.expression(*id));
                }
                Step::Branch { mask, selections, yes, no } => {
                    for id in selections.iter().filter(|id| !self.steps.escaping.contains(id)) {
                        let _ = writeln!(text, "{margin}{} t{id};", self.type_of(*id));
                    }
                    let _ = writeln!(text, "{margin}if ({}) {{", self.operand(*mask));
                    for (k, inner) in [yes, no].into_iter().enumerate() {
                        if k == 1 {
                            let _ = writeln!(text, "{margin}}} else {{");
                        }
                        self.write(inner, depth + 1, text);
                        for &id in selections {
                            if let RecordedOperation::Select(_, yes, no) =
                                self.program.operations[id as usize]
                            {
                                let _ = writeln!(text, "{margin}    t{id} = {};", self.operand([yes, no][k]));
                            }
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

    fn type_of(&self, id: Id) -> &'static str {
        use RecordedOperation::{And, IsZero, Less, Not, Or, Select, Truth};
        match self.program.operations[id as usize] {
            Truth(_) | Less(..) | IsZero(_) | Not(_) | And(..) | Or(..) => "int",
            Select(_, yes, no) if [yes, no].iter().any(|&id| self.type_of(id) == "int") => "int",
            _ => self.printer.number,
        }
    }

    /// An operand where it is used.
    pub(super) fn operand(&self, id: Id) -> String {
        match self.program.operations[id as usize] {
            RecordedOperation::Argument(k) => self.arguments[k as usize].clone(),
            RecordedOperation::Parameter(k) => self.printer.parameters[k as usize].clone(),
            RecordedOperation::Literal(bits) => {
                let text = self.printer.literal(f64::from_bits(bits));
                if text.starts_with('-') { format!("({text})") } else { text }
            }
            RecordedOperation::Truth(truth) => u8::from(truth).to_string(),
            RecordedOperation::Second(call) => format!("s{call}"),
            _ => format!("t{id}"),
        }
    }

    fn expression(&self, id: Id) -> String {
        let Printer { prefix, upper, suffix, .. } = self.printer;
        let o = |id: Id| self.operand(id);
        match self.program.operations[id as usize] {
            RecordedOperation::Unary(operator, a) => match operator {
                Unary::Negate => format!("-{}", o(a)),
                Unary::Absolute => format!("fabs{suffix}({})", o(a)),
                Unary::SquareRoot => format!("sqrt{suffix}({})", o(a)),
                Unary::LeadingPower => format!("{prefix}_leading_power({})", o(a)),
                Unary::ReciprocalOfPower => format!("{prefix}_reciprocal_of_power({})", o(a)),
            },
            RecordedOperation::Binary(operator, a, b) => match operator {
                Binary::Add => format!("{} + {}", o(a), o(b)),
                Binary::Subtract => format!("{} - {}", o(a), o(b)),
                Binary::Multiply => format!("{} * {}", o(a), o(b)),
                Binary::Divide => format!("{} / {}", o(a), o(b)),
                Binary::CopySign => format!("copysign{suffix}({}, {})", o(a), o(b)),
                Binary::Scale => format!("{prefix}_scale({}, {})", o(a), o(b)),
            },
            RecordedOperation::MulAdd(a, b, c) => format!("{upper}_MUL_ADD({}, {}, {})", o(a), o(b), o(c)),
            RecordedOperation::Less(a, b) => format!("{} < {}", o(a), o(b)),
            RecordedOperation::IsZero(a) => format!("{} == 0", o(a)),
            RecordedOperation::Not(a) => format!("!{}", o(a)),
            RecordedOperation::And(a, b) => format!("{} & {}", o(a), o(b)),
            RecordedOperation::Or(a, b) => format!("{} | {}", o(a), o(b)),
            RecordedOperation::Select(mask, yes, no) => format!("{} ? {} : {}", o(mask), o(yes), o(no)),
            RecordedOperation::Call(function, arguments) => {
                let mut list: Vec<_> = arguments.iter().flatten().map(|&argument| o(argument)).collect();
                if function.is_pair() {
                    list.push(format!("&s{id}"));
                }
                format!("{prefix}_{}({})", function.name(), list.join(", "))
            }
            _ => o(id),
        }
    }
}
