//! Prints how many operations the energy, the gradient and the blocks of each declaration in Rust source files take.
//!
//! ```text
//! cargo run -p piola-codegen --example counts -- materials/src/ogden.rs materials/src/neo_hookean.rs
//! ```
//!
//! Operations in a loop over the entries of lists have a row of their own, `Σ`, and are counted for one entry. A fused
//! multiplication and addition is one operation; additions include maxima and changes of sign.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::error::Error;

use piola_codegen::model::{Variant, model};
use piola_codegen::parse::parse;
use piola_codegen::schedule::{Op, Statement, schedule};

const COLUMNS: [&str; 9] = ["add", "mul", "fma", "div", "root", "ln", "exp", "power", "quotient"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("{:24} {:9} {:18}{}", "energy", "domain", "", COLUMNS.map(|name| format!("{name:>9}")).concat());
    for path in std::env::args().skip(1) {
        let source = std::fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
        for (arguments, item) in piola_codegen::declarations(&source)? {
            let declaration = parse(arguments, item)?;
            let mut model = model(&declaration)?;
            let variants = [("inside", Some(model.plain.clone())), ("extended", model.extended.clone())];
            for (word, variant) in variants {
                let Some(variant) = variant else { continue };
                let Variant { energy, gradient, hessian, flip, twist, .. } = &variant;
                let blocks = [&gradient[..], hessian, flip, twist].concat();
                for (output, roots) in
                    [("energy", vec![*energy]), ("gradient", gradient.to_vec()), ("blocks", blocks)]
                {
                    let (mut once, mut each) = ([0; 9], [0; 9]);
                    for statement in schedule(&mut model.graph, &roots).statements {
                        match statement {
                            Statement::Let(_, op) => count(&mut once, &op),
                            Statement::Loop { body, totals, .. } => {
                                body.iter().for_each(|(_, op)| count(&mut each, op));
                                each[0] += totals.len();
                            }
                        }
                    }
                    let name = declaration.name.to_string();
                    for (row, counts) in [(output.to_owned(), once), (format!("{output} Σ"), each)] {
                        if counts != [0; 9] {
                            let counts = counts.map(|count| format!("{count:9}")).concat();
                            println!("{name:24} {word:9} {row:18}{counts}");
                        }
                    }
                }
            }
        }
    }
    Ok(())
}

fn count(counts: &mut [usize; 9], op: &Op) {
    let column = match op {
        Op::Literal(_) | Op::Stretch(_) | Op::Strain(_) | Op::Parameter(_) | Op::Entry(_) | Op::Epsilon => {
            return;
        }
        Op::Neg(_)
        | Op::Add(..)
        | Op::Sub(..)
        | Op::Max(..)
        | Op::Below(..)
        | Op::WhereNegative(..)
        | Op::PoleFloor => 0,
        Op::Mul(..) => 1,
        Op::MulAdd(..) | Op::NegMulAdd(..) | Op::MulSub(..) => 2,
        Op::Div(..) => 3,
        Op::Sqrt(_) | Op::Cbrt(_) => 4,
        Op::Ln(_) | Op::LnProduct(_) | Op::Logarithm(_) => 5,
        Op::Exp(_) => 6,
        Op::Power(..) => 7,
        Op::Pair { .. }
        | Op::LnQuotient(_)
        | Op::PowerQuotient { .. }
        | Op::ExpQuotient { .. }
        | Op::Function(..)
        | Op::FunctionQuotient(..)
        | Op::ShareAbove(..)
        | Op::ShareBelow(..) => 8,
    };
    counts[column] += 1;
}
