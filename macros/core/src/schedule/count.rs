//! Counts of the operations of a program.
//!
//! A fused multiplication and addition counts as both, so that counts compare with those of a formula. Powers
//! of one base share a logarithm, which counts once in addition; so does the common part of divided
//! differences. Literals, parameters and stretches cost nothing. A total over a list takes one addition for
//! each entry.

use crate::algebra::expr::Length;
use crate::read::parse::Declaration;
use crate::schedule::program::{Op, Program};
use crate::schedule::{Sorted, entry};

/// The counts of a declaration as a table in Markdown.
#[must_use]
pub fn table(declaration: &Declaration, counts: &[(&str, Count)]) -> String {
    let rows =
        counts.iter().map(|(result, count)| format!("| {result} | {} |\n", count.summary(declaration)));
    format!("| result | operations |\n|---|---|\n{}", rows.collect::<String>())
}

/// The signs in a summary of operations that cost more than an addition or a multiplication; those have none.
const COSTLY: [&str; 8] = ["÷", "√", "ln", "exp", "φ", "pow", "Δ", "f"];

/// An explanation of the counts for their readers.
pub const LEGEND: &str = "A fused multiplication and addition counts as two operations, a loop over lists of length N as N \
     times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a \
     multiplication: ÷ divisions, √ roots, ln, exp, φ other elementary functions, pow real powers, Δ divided differences, f functions that are parameters";

/// The numbers of operations of a program by their signs: those done once, and those done for each entry of
/// lists of one length.
#[derive(Clone, Debug, Default)]
pub struct Count(Sorted<(&'static str, Option<Length>), usize>);

impl Count {
    /// The count of a whole program.
    #[must_use]
    pub fn of(program: &Program) -> Self {
        let mut count = Self::default();
        for block in &program.blocks {
            block.body.iter().for_each(|(_, op)| count.add(signs(op), block.length));
            block.totals.iter().for_each(|_| count.add(&[""], block.length));
        }
        count
    }

    fn add(&mut self, signs: &[&'static str], length: Option<Length>) {
        for &sign in signs {
            *entry(&mut self.0, (sign, length)) += 1;
        }
    }

    /// The number of all operations and of the costly ones, such as `12 + 31 N (1 ÷, 1 ln, 3 N pow)`.
    fn summary(&self, declaration: &Declaration) -> String {
        let all = self.text(declaration, |_| true);
        let costly = COSTLY.into_iter().filter_map(|sign| {
            let is_used = self.0.iter().any(|((used, _), _)| *used == sign);
            is_used.then(|| format!("{} {sign}", self.text(declaration, |asked| asked == sign)))
        });
        let costly: Vec<_> = costly.collect();
        if costly.is_empty() { all } else { format!("{all} ({})", costly.join(", ")) }
    }

    /// The number of operations of the given signs, such as `12 + 31 N`.
    fn text(&self, declaration: &Declaration, is_asked: impl Fn(&str) -> bool) -> String {
        let mut once = 0;
        let mut each: Sorted<Length, usize> = Sorted::new();
        for &((sign, length), number) in &self.0 {
            match length {
                _ if !is_asked(sign) => {}
                Some(length) => *entry(&mut each, length) += number,
                None => once += number,
            }
        }
        let constant = (once > 0 || each.is_empty()).then(|| once.to_string());
        let terms = each.into_iter().map(|(length, number)| {
            let length = &declaration.lengths[length];
            let text = length.text(declaration);
            match number {
                _ if length.stated().is_some() => format!("{number} · {text}"),
                1 => text,
                _ => format!("{number} {text}"),
            }
        });
        constant.into_iter().chain(terms).collect::<Vec<_>>().join(" + ")
    }
}

/// The signs of what an operation counts as.
fn signs(op: &Op) -> &'static [&'static str] {
    match op {
        Op::Literal(_) | Op::Stretch(_) | Op::Strain(_) | Op::Parameter(_) | Op::Entry(_) | Op::Epsilon => {
            &[]
        }
        Op::Neg(_)
        | Op::Add(..)
        | Op::Sub(..)
        | Op::Mul(..)
        | Op::Max(..)
        | Op::AboveZero(_)
        | Op::Below(..)
        | Op::WhereNegative(..)
        | Op::PoleFloor => &[""],
        Op::MulAdd(..) | Op::NegMulAdd(..) | Op::MulSub(..) => &["", ""],
        Op::Div(..) => &["÷"],
        Op::Sqrt(_) | Op::Cbrt(_) => &["√"],
        Op::Ln(_) | Op::LnProduct(_) | Op::Logarithm(_) => &["ln"],
        Op::Exp(_) => &["exp"],
        Op::Elementary(..) => &["φ"],
        Op::Power(..) | Op::WholePower(..) => &["pow"],
        Op::Pair { .. }
        | Op::LnQuotient(_)
        | Op::PowerQuotient { .. }
        | Op::WholePowerQuotient(..)
        | Op::ExpQuotient { .. }
        | Op::ElementaryQuotient(..)
        | Op::FunctionQuotient(..)
        | Op::ShareAbove(..)
        | Op::ShareBelow(..) => &["Δ"],
        Op::Function(..) => &["f"],
    }
}
