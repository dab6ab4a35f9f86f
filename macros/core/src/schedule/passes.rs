//! Passes over a program whose operations are in order: fusion and renumbering.

use super::program::{Op, Program, Value};

/// Fuses a b + c, c − a b and a b − c into one operation if the product is used nowhere else, given the
/// number of values.
pub(super) fn fuse_multiply_add(mut program: Program, values: usize) -> Program {
    let mut uses = vec![0; values];
    let mut products = vec![None; values];
    program.each_read(|value| uses[value.0] += 1);
    for (value, op) in program.operations() {
        if let Op::Mul(a, b) = op {
            products[value.0] = Some((a, b));
        }
    }
    let mut is_fused = vec![false; values];
    let mut fuse = |op: &mut Op| {
        type Fuse = fn(Value, Value, Value) -> Op;
        let candidates: &[(Value, Fuse, Value)] = match *op {
            Op::Add(a, b) => &[(b, Op::MulAdd, a), (a, Op::MulAdd, b)],
            Op::Sub(a, b) => &[(b, Op::NegMulAdd, a), (a, Op::MulSub, b)],
            _ => &[],
        };
        for &(product, fuse, other) in candidates {
            if uses[product.0] == 1
                && let Some((x, y)) = products[product.0]
            {
                *op = fuse(x, y, other);
                is_fused[product.0] = true;
                return;
            }
        }
    };
    program.blocks.iter_mut().flat_map(|block| &mut block.body).for_each(|(_, op)| fuse(op));
    program.blocks.iter_mut().for_each(|block| block.body.retain(|(value, _)| !is_fused[value.0]));
    program
}

/// Numbers values in the order in which they are computed; literals and inputs, which are written where they
/// are used, come after all others.
pub(super) fn renumber(mut program: Program, values: usize) -> Program {
    let (mut named, mut inlined) = (Vec::new(), Vec::new());
    let mut name = |value: Value, op: Option<Op>| {
        if op.is_some_and(is_inlined) { inlined.push(value) } else { named.push(value) }
    };
    for block in &program.blocks {
        block.totals.iter().for_each(|&(total, _)| name(total, None));
        block.body.iter().for_each(|&(value, op)| name(value, Some(op)));
    }
    let mut names = vec![Value(0); values];
    for (k, value) in named.into_iter().chain(inlined).enumerate() {
        names[value.0] = Value(k);
    }
    program.rename(|value| names[value.0]);
    program
}

/// True if an operation is written where its value is used.
fn is_inlined(op: Op) -> bool {
    matches!(
        op,
        Op::Literal(_) | Op::Stretch(_) | Op::Strain(_) | Op::Parameter(_) | Op::Entry(_) | Op::Epsilon
    )
}
