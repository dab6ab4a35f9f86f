//! Conditions on parameters, which the constructor evaluates.

use piola::__private::{Condition, Term};
use piola_codegen::emit::condition;
use piola_codegen::read::parse::Declaration;
use syn::Expr;

/// A condition of a declaration.
pub(crate) fn condition(declaration: &Declaration, condition: &Expr) -> Condition {
    let condition::Condition { text, sides, comparison, list, names } =
        condition::Condition::new(declaration, condition, &|term| match term {
            condition::Term::Number(number) => Term::Number(number),
            condition::Term::Parameter(k) => Term::Parameter(k),
            condition::Term::Call(name, operands) => Term::Call(name.into(), operands.into()),
        });
    Condition { text: text.into(), sides, comparison, list, names: names.into() }
}
