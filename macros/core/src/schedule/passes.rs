//! What is done to a program once its operations are in order.

use super::{Op, Program, Statement, Value};
use crate::hash::{HashMap, HashSet};

/// a b + c, c − a b and a b − c in one operation where the product is used nowhere else.
pub(super) fn fuse_multiply_add(mut program: Program) -> Program {
    let mut uses: HashMap<Value, usize> = HashMap::default();
    let mut products: HashMap<Value, (Value, Value)> = HashMap::default();
    let mut count = |value: Value| *uses.entry(value).or_default() += 1;
    program.outputs.iter().copied().for_each(&mut count);
    for statement in &program.statements {
        let lets: &[_] = match statement {
            Statement::Let(value, op) => &[(*value, *op)],
            Statement::Loop { body, totals, .. } => {
                totals.iter().for_each(|&(_, term)| count(term));
                body
            }
        };
        for &(value, op) in lets {
            op.operands().into_iter().for_each(&mut count);
            if let Op::Mul(a, b) = op {
                products.insert(value, (a, b));
            }
        }
    }
    let mut fused: HashSet<Value> = HashSet::default();
    let mut fuse = |op: &mut Op| {
        type Fuse = fn(Value, Value, Value) -> Op;
        let candidates: &[(Value, Fuse, Value)] = match *op {
            Op::Add(a, b) => &[(b, Op::MulAdd, a), (a, Op::MulAdd, b)],
            Op::Sub(a, b) => &[(b, Op::NegMulAdd, a), (a, Op::MulSub, b)],
            _ => &[],
        };
        for &(product, fuse, other) in candidates {
            if uses[&product] == 1
                && let Some(&(x, y)) = products.get(&product)
            {
                *op = fuse(x, y, other);
                fused.insert(product);
                return;
            }
        }
    };
    for statement in &mut program.statements {
        match statement {
            Statement::Let(_, op) => fuse(op),
            Statement::Loop { body, .. } => body.iter_mut().for_each(|(_, op)| fuse(op)),
        }
    }
    for statement in &mut program.statements {
        if let Statement::Loop { body, .. } = statement {
            body.retain(|(value, _)| !fused.contains(value));
        }
    }
    program
        .statements
        .retain(|statement| !matches!(statement, Statement::Let(value, _) if fused.contains(value)));
    program
}

/// Numbers values in the order in which they are computed; literals and inputs, which are written where they are used,
/// come after all others.
pub(super) fn renumber(mut program: Program) -> Program {
    let mut names: HashMap<Value, Value> = HashMap::default();
    let mut inlined = Vec::new();
    let mut name = |value: Value, op: Option<Op>| {
        if matches!(op, Some(op) if op.operands().is_empty() && op != Op::PoleFloor) {
            inlined.push(value);
        } else {
            names.insert(value, Value(names.len()));
        }
    };
    for statement in &program.statements {
        match statement {
            Statement::Let(value, op) => name(*value, Some(*op)),
            Statement::Loop { body, totals, .. } => {
                totals.iter().for_each(|&(total, _)| name(total, None));
                body.iter().for_each(|&(value, op)| name(value, Some(op)));
            }
        }
    }
    for value in inlined {
        names.insert(value, Value(names.len()));
    }
    let new = |value: &mut Value| *value = names[value];
    for statement in &mut program.statements {
        match statement {
            Statement::Let(value, op) => {
                new(value);
                op.operands_mut().into_iter().for_each(new);
            }
            Statement::Loop { body, totals, .. } => {
                for (value, op) in body {
                    new(value);
                    op.operands_mut().into_iter().for_each(new);
                }
                for (total, term) in totals {
                    new(total);
                    new(term);
                }
            }
        }
    }
    program.outputs.iter_mut().for_each(new);
    program
}
