//! The part of an energy that a message underlines.

use std::collections::HashMap;

use syn::{BinOp, Block, Expr, Local, Pat, Stmt, UnOp};

use super::source::Source;
use crate::algebra::expr::Id;
use crate::read::resolve::LONG_SUM;

impl<'a> Source<'a> {
    /// The smallest term that alone breaks a rule, found through sums and the names of their terms.
    ///
    /// Terms that break a rule together, such as two that should cancel, are not taken apart.
    pub(crate) fn blamed_term(&self, breaks: impl FnMut(Id) -> bool) -> Option<&'a Expr> {
        self.smallest(breaks, terms, false)
    }

    /// The smallest operand that alone breaks a rule, found through operators and functions.
    pub(crate) fn blamed_operand(&self, breaks: impl FnMut(Id) -> bool) -> Option<&'a Expr> {
        self.smallest(breaks, operands, false)
    }

    /// The smallest operand that contains the culprit, the first one if it is written more than once.
    pub(crate) fn first_operand(&self, holds: impl FnMut(Id) -> bool) -> Option<&'a Expr> {
        self.smallest(holds, operands, true)
    }

    /// The smallest part that breaks a rule. Several parts of one expression may break it together, unless
    /// the first one is meant.
    fn smallest(
        &self,
        mut breaks: impl FnMut(Id) -> bool,
        parts: impl Fn(&'a Expr, &mut HashMap<String, &'a Expr>) -> Vec<&'a Expr>,
        is_first_meant: bool,
    ) -> Option<&'a Expr> {
        let mut definitions = HashMap::new();
        let mut blamed = value(&self.declaration.body, &mut definitions)?;
        loop {
            let parts = parts(blamed, &mut definitions).into_iter();
            let mut blamed_parts = parts.filter(|part| self.nodes.of(part).is_some_and(&mut breaks));
            match (blamed_parts.next(), blamed_parts.next()) {
                (Some(part), other) if other.is_none() || is_first_meant => blamed = part,
                _ => return Some(blamed),
            }
        }
    }
}

/// The terms of a sum, or the expression that a name or parentheses stand for.
fn terms<'b>(expression: &'b Expr, definitions: &mut HashMap<String, &'b Expr>) -> Vec<&'b Expr> {
    match expression {
        Expr::Paren(inner) => vec![&*inner.expr],
        Expr::Group(inner) => vec![&*inner.expr],
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => vec![&*unary.expr],
        Expr::Binary(binary) if is_sum(binary) => {
            let mut all = vec![&*binary.right];
            let mut left = &*binary.left;
            while let Expr::Binary(inner) = left
                && is_sum(inner)
            {
                all.push(&inner.right);
                left = &inner.left;
            }
            all.push(left);
            all.reverse();
            if all.len() > LONG_SUM { all } else { vec![&*binary.left, &*binary.right] }
        }
        Expr::Block(inner) => value(&inner.block, definitions).into_iter().collect(),
        Expr::Path(path) => {
            let name = path.path.get_ident().map(ToString::to_string);
            name.and_then(|name| definitions.get(&name).copied()).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

fn is_sum(binary: &syn::ExprBinary) -> bool {
    matches!(binary.op, BinOp::Add(_) | BinOp::Sub(_))
}

/// The operands of an operator, a method or a function, or the expression that a name or parentheses stand
/// for.
fn operands<'b>(expression: &'b Expr, definitions: &mut HashMap<String, &'b Expr>) -> Vec<&'b Expr> {
    match expression {
        Expr::Unary(unary) => vec![&*unary.expr],
        Expr::Binary(binary) if !is_sum(binary) => vec![&*binary.left, &*binary.right],
        Expr::MethodCall(call) => std::iter::once(&*call.receiver).chain(&call.args).collect(),
        Expr::Call(call) => call.args.iter().map(summand).collect(),
        _ => terms(expression, definitions),
    }
}

/// The body of a closure, which a sum adds up, or another argument as it is.
fn summand(argument: &Expr) -> &Expr {
    match argument {
        Expr::Closure(summand) => &summand.body,
        argument => argument,
    }
}

/// The last line of a block; the definitions of its names are collected.
fn value<'b>(block: &'b Block, definitions: &mut HashMap<String, &'b Expr>) -> Option<&'b Expr> {
    for statement in &block.stmts {
        if let Stmt::Local(Local { pat: Pat::Ident(name), init: Some(init), .. }) = statement {
            definitions.insert(name.ident.to_string(), &init.expr);
        }
    }
    match block.stmts.last() {
        Some(Stmt::Expr(expression, None)) => Some(expression),
        _ => None,
    }
}
