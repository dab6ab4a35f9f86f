//! Counts of the operations of a program.
//!
//! A fused multiplication and addition counts as both, so that counts compare with those of a formula. Powers
//! of one base share a logarithm, which counts once in addition; so does the common part of divided
//! differences. Literals, parameters and stretches cost nothing. A total over a list takes one addition for
//! each entry.

use syn::Expr;

use crate::algebra::expr::Length;
use crate::read::parse::{Declaration, Entries};
use crate::schedule::program::{Op, Program, Statement};
use crate::schedule::sorted::{Sorted, entry};

/// The counts of a declaration as a table in Markdown.
#[must_use]
pub fn table(declaration: &Declaration, counts: &[(&str, Count)]) -> String {
    let rows =
        counts.iter().map(|(result, count)| format!("| {result} | {} |\n", count.summary(declaration)));
    format!("| result | operations |\n|---|---|\n{}", rows.collect::<String>())
}

/// Operations of about the same cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum OperationKind {
    /// Addition, subtraction, change of sign, maximum or selection.
    Addition,
    /// Multiplication of two values.
    Multiplication,
    /// Division or reciprocal.
    Division,
    /// Square or cube root.
    Root,
    /// Logarithm, also one from which powers are computed.
    Logarithm,
    /// Exponential to the base e.
    Exponential,
    /// Another elementary function, such as the hyperbolic tangent.
    Elementary,
    /// Power with a real exponent, or with a whole one that is a parameter.
    Power,
    /// Divided difference, or the common part of those of two values.
    Quotient,
    /// Call of a function that is a parameter.
    Function,
}

/// Operations that cost more than an addition, with their signs in a summary.
const COSTLY: [(OperationKind, &str); 8] = [
    (OperationKind::Division, "÷"),
    (OperationKind::Root, "√"),
    (OperationKind::Logarithm, "ln"),
    (OperationKind::Exponential, "exp"),
    (OperationKind::Elementary, "φ"),
    (OperationKind::Power, "pow"),
    (OperationKind::Quotient, "Δ"),
    (OperationKind::Function, "f"),
];

/// An explanation of the counts for their readers.
pub const LEGEND: &str = "A fused multiplication and addition counts as two operations, a loop over lists of length N as N \
     times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a \
     multiplication: ÷ divisions, √ roots, ln, exp, φ other elementary functions, pow real powers, Δ divided differences, f functions that are parameters";

/// The operations of a program: those done once, and those done for each entry of lists of one length.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Count(Sorted<(OperationKind, Option<Length>), usize>);

impl Count {
    /// The count of a whole program.
    #[must_use]
    pub fn of(program: &Program) -> Self {
        let mut count = Self::default();
        for statement in &program.statements {
            match statement {
                Statement::Let(_, op) => count.add(op, None),
                Statement::Loop { length, body, totals } => {
                    body.iter().for_each(|(_, op)| count.add(op, Some(*length)));
                    if !totals.is_empty() {
                        *entry(&mut count.0, (OperationKind::Addition, Some(*length))) += totals.len();
                    }
                }
            }
        }
        count
    }

    fn add(&mut self, op: &Op, length: Option<Length>) {
        for &kind in kinds(op) {
            *entry(&mut self.0, (kind, length)) += 1;
        }
    }

    /// The number of operations of the given kinds, for lists of the given lengths.
    #[must_use]
    pub fn number(&self, lengths: &[usize], is_asked: impl Fn(OperationKind) -> bool) -> usize {
        let times = |length: Option<Length>| length.map_or(1, |length| lengths[length]);
        self.0.iter().filter(|((kind, _), _)| is_asked(*kind)).map(|((_, l), n)| n * times(*l)).sum()
    }

    /// The number of all operations and of the costly ones, such as `12 + 31 N (1 ÷, 1 ln, 3 N pow)`.
    fn summary(&self, declaration: &Declaration) -> String {
        let all = self.text(declaration, |_| true);
        let costly = COSTLY.into_iter().filter_map(|(kind, sign)| {
            let is_used = self.0.iter().any(|((used, _), _)| *used == kind);
            is_used.then(|| format!("{} {sign}", self.text(declaration, |asked| asked == kind)))
        });
        let costly: Vec<_> = costly.collect();
        if costly.is_empty() { all } else { format!("{all} ({})", costly.join(", ")) }
    }

    /// The number of operations of the given kinds, such as `12 + 31 N`.
    fn text(&self, declaration: &Declaration, is_asked: impl Fn(OperationKind) -> bool) -> String {
        let mut once = 0;
        let mut each: Sorted<Length, usize> = Sorted::new();
        for &((kind, length), number) in &self.0 {
            match length {
                _ if !is_asked(kind) => {}
                Some(length) => *entry(&mut each, length) += number,
                None => once += number,
            }
        }
        let constant = (once > 0 || each.is_empty()).then(|| once.to_string());
        let terms = each.into_iter().map(|(length, number)| {
            let length = &declaration.lengths[length];
            let text = length.text(declaration);
            match (number, length) {
                (_, Entries::Known(Expr::Lit(_))) => format!("{number} · {text}"),
                (1, _) => text,
                _ => format!("{number} {text}"),
            }
        });
        constant.into_iter().chain(terms).collect::<Vec<_>>().join(" + ")
    }
}

/// The kinds that an operation counts as.
fn kinds(op: &Op) -> &'static [OperationKind] {
    match op {
        Op::Literal(_) | Op::Stretch(_) | Op::Strain(_) | Op::Parameter(_) | Op::Entry(_) | Op::Epsilon => {
            &[]
        }
        Op::Neg(_)
        | Op::Add(..)
        | Op::Sub(..)
        | Op::Max(..)
        | Op::AboveZero(_)
        | Op::Below(..)
        | Op::WhereNegative(..)
        | Op::PoleFloor => &[OperationKind::Addition],
        Op::Mul(..) => &[OperationKind::Multiplication],
        Op::MulAdd(..) | Op::NegMulAdd(..) | Op::MulSub(..) => {
            &[OperationKind::Addition, OperationKind::Multiplication]
        }
        Op::Div(..) => &[OperationKind::Division],
        Op::Sqrt(_) | Op::Cbrt(_) => &[OperationKind::Root],
        Op::Ln(_) | Op::LnProduct(_) | Op::Logarithm(_) => &[OperationKind::Logarithm],
        Op::Exp(_) => &[OperationKind::Exponential],
        Op::Elementary(..) => &[OperationKind::Elementary],
        Op::Power(..) | Op::WholePower(..) => &[OperationKind::Power],
        Op::Pair { .. }
        | Op::LnQuotient(_)
        | Op::PowerQuotient { .. }
        | Op::WholePowerQuotient(..)
        | Op::ExpQuotient { .. }
        | Op::ElementaryQuotient(..)
        | Op::FunctionQuotient(..)
        | Op::ShareAbove(..)
        | Op::ShareBelow(..) => &[OperationKind::Quotient],
        Op::Function(..) => &[OperationKind::Function],
    }
}
