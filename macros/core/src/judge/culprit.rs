//! The term of an energy that breaks a rule, for the rule's message to stand on.

use std::collections::HashMap;

use syn::{BinOp, Block, Expr, Local, Pat, Stmt, UnOp};

/// The smallest part that alone breaks the rule, on the way down through sums and the names of their terms.
///
/// Terms that break a rule together, such as two that should cancel, are not taken apart.
pub(crate) fn culprit(body: &Block, breaks: impl FnMut(&Expr) -> bool) -> Option<&Expr> {
    smallest(body, breaks, terms)
}

/// The smallest part that alone holds something, down to the operands of operators and functions.
pub(crate) fn holder(body: &Block, holds: impl FnMut(&Expr) -> bool) -> Option<&Expr> {
    smallest(body, holds, operands)
}

fn smallest<'b>(
    body: &'b Block,
    mut breaks: impl FnMut(&Expr) -> bool,
    parts: impl Fn(&'b Expr, &mut HashMap<String, &'b Expr>) -> Vec<&'b Expr>,
) -> Option<&'b Expr> {
    let mut definitions = HashMap::new();
    let mut guilty = value(body, &mut definitions)?;
    loop {
        let parts = parts(guilty, &mut definitions);
        let mut guilty_parts = parts.into_iter().filter(|part| breaks(part));
        match (guilty_parts.next(), guilty_parts.next()) {
            (Some(part), None) => guilty = part,
            _ => return Some(guilty),
        }
    }
}

/// The terms of a sum, or what a name or parentheses stand for.
fn terms<'b>(expression: &'b Expr, definitions: &mut HashMap<String, &'b Expr>) -> Vec<&'b Expr> {
    match expression {
        Expr::Paren(inner) => vec![&*inner.expr],
        Expr::Group(inner) => vec![&*inner.expr],
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => vec![&*unary.expr],
        Expr::Binary(binary) if matches!(binary.op, BinOp::Add(_) | BinOp::Sub(_)) => {
            vec![&*binary.left, &*binary.right]
        }
        Expr::Block(inner) => value(&inner.block, definitions).into_iter().collect(),
        Expr::Path(path) => {
            let name = path.path.get_ident().map(ToString::to_string);
            name.and_then(|name| definitions.get(&name).copied()).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

/// What an operator, a method or a function is applied to, or what a name or parentheses stand for.
fn operands<'b>(expression: &'b Expr, definitions: &mut HashMap<String, &'b Expr>) -> Vec<&'b Expr> {
    match expression {
        Expr::Unary(unary) => vec![&*unary.expr],
        Expr::Binary(binary) => vec![&*binary.left, &*binary.right],
        Expr::MethodCall(call) => std::iter::once(&*call.receiver).chain(&call.args).collect(),
        Expr::Call(call) => call.args.iter().collect(),
        _ => terms(expression, definitions),
    }
}

/// The last line of a block; what its names stand for is noted.
pub(crate) fn value<'b>(block: &'b Block, definitions: &mut HashMap<String, &'b Expr>) -> Option<&'b Expr> {
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
