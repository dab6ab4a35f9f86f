//! The operations of programs: each is the one that the emitted Rust of the same declaration performs.

use piola_codegen::algebra::expr::Elementary;
use piola_codegen::schedule::Op;

use super::parameters::Parameters;
use super::program::{Operation, Program, Register};
use super::registers::{Each, Files};
use crate::lanes::Real;
use crate::quotient::{
    Pair, above_zero, asinh_quotient, atan_quotient, cos_quotient, cosh_quotient, erf_quotient,
    exp_m1_quotient, exp_quotient, ln_1p_quotient, ln_product, pole_floor, share_above, share_below,
    sigmoid_quotient, sin_quotient, sinh_quotient, softplus_quotient, tanh_quotient, whole_power,
    whole_power_quotient,
};
use crate::univariate::Univariate;

/// An operand that is the same at all groups.
#[derive(Clone, Copy)]
struct Same<R>(R);

impl<R: Real> Same<R> {
    #[inline(always)]
    fn get(self, _group: usize) -> R {
        self.0
    }
}

/// Computes one operation at all groups.
#[inline(always)]
pub(super) fn compute<R: Real, const G: usize>(
    program: &Program,
    operation: Operation,
    file: &Files<'_, R, G>,
    parameters: &Parameters<'_>,
    entry: usize,
) {
    /// A loop over the groups: `to = value` with the operands read from their registers, of numbers unless
    /// another kind is named.
    macro_rules! each {
        ($kind:ident $to:expr, [$($operand_kind:ident $x:ident: $register:expr),+] $value:expr) => {{
            let to = file.$kind($to);
            $(let $x = file.$operand_kind($register);)+
            for group in 0..G {
                to.set(group, { $(let $x = $x.get(group);)+ $value });
            }
        }};
        ($to:expr, [$($x:ident: $register:expr),+] $value:expr) => {
            each!(number $to, [$(number $x: $register),+] $value)
        };
    }
    /// An operation of arithmetic: an operand that is constant is read once, and a result that is constant
    /// computed once. With four operands, constants are read for each group: sixteen loops would take long to
    /// compile.
    macro_rules! arithmetic {
        ($to:expr, [$x:ident: $a:expr, $y:ident: $b:expr, $z:ident: $c:expr, $w:ident: $d:expr] $value:expr) => {{
            let (to, $x, $y, $z, $w) =
                (file.number($to), file.number($a), file.number($b), file.number($c), file.number($d));
            for group in 0..if to.is_constant() { 1 } else { G } {
                to.set(group, {
                    let ($x, $y, $z, $w) = ($x.get(group), $y.get(group), $z.get(group), $w.get(group));
                    $value
                });
            }
        }};
        ($to:expr, [$($x:ident: $register:expr),+] $value:expr) => {{
            let to = file.number($to);
            $(let $x = file.number($register);)+
            if const { G == 1 } || to.is_constant() {
                to.set(0, { $(let $x = $x.get(0);)+ $value });
            } else {
                arithmetic!(to, [] [$($x)+] $value);
            }
        }};
        ($to:ident, [$($known:ident)*] [$x:ident $($others:ident)*] $value:expr) => {
            if $x.is_constant() {
                let $x = Same($x.get(0));
                arithmetic!($to, [$($known)* $x] [$($others)*] $value);
            } else {
                let $x = Each($x.cells);
                arithmetic!($to, [$($known)* $x] [$($others)*] $value);
            }
        };
        ($to:ident, [$($x:ident)+] [] $value:expr) => {
            for group in 0..G {
                $to.set(group, { $(let $x = $x.get(group);)+ $value });
            }
        };
    }
    let (to, op) = match operation {
        // The order of the operations, which is not theirs to decide.
        Operation::Begin(_) | Operation::End(_) => return,
        Operation::MulMul(to, [a, b, c]) => return arithmetic!(to, [x: a, y: b, z: c] x * y * z),
        Operation::MulMulMul(to, [a, b, c, d]) => {
            return arithmetic!(to, [x: a, y: b, z: c, w: d] x * y * z * w);
        }
        Operation::MulMulAdd(to, [a, b, c, d]) => {
            return arithmetic!(to, [x: a, y: b, z: c, w: d] (x * y).mul_add(z, w));
        }
        Operation::NegMulMulAdd(to, [a, b, c, d]) => {
            return arithmetic!(to, [x: a, y: b, z: c, w: d] (-(x * y)).mul_add(z, w));
        }
        Operation::MulAddMul(to, [a, b, c, d]) => {
            return arithmetic!(to, [x: a, y: b, z: c, w: d] x.mul_add(y, z) * w);
        }
        Operation::NegMulAddMul(to, [a, b, c, d]) => {
            return arithmetic!(to, [x: a, y: b, z: c, w: d] (-x).mul_add(y, z) * w);
        }
        Operation::NegMul(to, a, b) => return arithmetic!(to, [x: a, y: b] -(x * y)),
        Operation::One(to, op) => (to, op),
    };
    let whole = |exponent: Register| parameters.whole(program.exponents[usize::from(exponent)], entry);
    match op {
        // They fill registers before the first operation.
        Op::Literal(_) | Op::Parameter(_) | Op::Entry(_) | Op::Epsilon | Op::Stretch(_) | Op::Strain(_) => {}
        Op::Neg(a) => arithmetic!(to, [x: a] -x),
        Op::Add(a, b) => arithmetic!(to, [x: a, y: b] x + y),
        Op::Sub(a, b) => arithmetic!(to, [x: a, y: b] x - y),
        Op::Mul(a, b) => arithmetic!(to, [x: a, y: b] x * y),
        Op::Div(a, b) => arithmetic!(to, [x: a, y: b] x / y),
        Op::MulAdd(a, b, c) => arithmetic!(to, [x: a, y: b, z: c] x.mul_add(y, z)),
        Op::NegMulAdd(a, b, c) => arithmetic!(to, [x: a, y: b, z: c] (-x).mul_add(y, z)),
        Op::MulSub(a, b, c) => arithmetic!(to, [x: a, y: b, z: c] x.mul_add(y, -z)),
        Op::Sqrt(a) => each!(to, [x: a] x.sqrt()),
        Op::Cbrt(a) => each!(to, [x: a] x.cbrt()),
        Op::Ln(a) => each!(to, [x: a] x.ln()),
        Op::Exp(a) => each!(to, [x: a] x.exp()),
        Op::Max(a, b) => each!(to, [x: a, y: b] x.max(y)),
        Op::Below(a, b) => each!(to, [x: a, y: b] (x - y).min(R::splat(0.0))),
        Op::AboveZero(a) => each!(to, [x: a] above_zero(x)),
        Op::WhereNegative(a, b, c) => {
            each!(to, [x: a, y: b, z: c] R::select(x.less(R::splat(0.0)), y, z))
        }
        Op::ShareAbove(a, b, c) => each!(to, [x: a, y: b, z: c] share_above(x, y, z)),
        Op::ShareBelow(a, b, c) => each!(to, [x: a, y: b, z: c] share_below(x, y, z)),
        Op::PoleFloor => {
            let [a, b, c] = program.stretches;
            each!(to, [x: a, y: b, z: c] pole_floor([x, y, z]));
        }
        Op::LnProduct([a, b, c]) => each!(to, [x: a, y: b, z: c] ln_product([x, y, z])),
        Op::Elementary(function, a) => match function {
            Elementary::Asinh => each!(to, [x: a] x.asinh()),
            Elementary::Atan => each!(to, [x: a] x.atan()),
            Elementary::Cos => each!(to, [x: a] x.cos()),
            Elementary::Cosh => each!(to, [x: a] x.cosh()),
            Elementary::Erf => each!(to, [x: a] x.erf()),
            Elementary::ExpM1 => each!(to, [x: a] x.exp_m1()),
            Elementary::Ln1p => each!(to, [x: a] x.ln_1p()),
            Elementary::Sigmoid => each!(to, [x: a] x.sigmoid()),
            Elementary::Sin => each!(to, [x: a] x.sin()),
            Elementary::Sinh => each!(to, [x: a] x.sinh()),
            Elementary::Softplus => each!(to, [x: a] x.softplus()),
            Elementary::Tanh => each!(to, [x: a] x.tanh()),
        },
        Op::ElementaryQuotient(function, a, b) => match function {
            Elementary::Asinh => each!(to, [x: a, y: b] asinh_quotient(x, y)),
            Elementary::Atan => each!(to, [x: a, y: b] atan_quotient(x, y)),
            Elementary::Cos => each!(to, [x: a, y: b] cos_quotient(x, y)),
            Elementary::Cosh => each!(to, [x: a, y: b] cosh_quotient(x, y)),
            Elementary::Erf => each!(to, [x: a, y: b] erf_quotient(x, y)),
            Elementary::ExpM1 => each!(to, [x: a, y: b] exp_m1_quotient(x, y)),
            Elementary::Ln1p => each!(to, [x: a, y: b] ln_1p_quotient(x, y)),
            Elementary::Sigmoid => each!(to, [x: a, y: b] sigmoid_quotient(x, y)),
            Elementary::Sin => each!(to, [x: a, y: b] sin_quotient(x, y)),
            Elementary::Sinh => each!(to, [x: a, y: b] sinh_quotient(x, y)),
            Elementary::Softplus => each!(to, [x: a, y: b] softplus_quotient(x, y)),
            Elementary::Tanh => each!(to, [x: a, y: b] tanh_quotient(x, y)),
        },
        Op::Logarithm(a) => each!(logarithm to, [number x: a] x.logarithm()),
        Op::Power(logarithm, exponent) => {
            each!(number to, [logarithm ln: logarithm, number r: exponent] R::power(ln, r));
        }
        Op::Pair { values: [a, b], reciprocals: [ra, rb], logarithms: [la, lb] } => {
            each!(pair to, [number a: a, number b: b, number ra: ra, number rb: rb, logarithm la: la, logarithm lb: lb] {
                Pair::new([a, b], [ra, rb], [la, lb])
            });
        }
        Op::LnQuotient(pair) => each!(number to, [pair both: pair] both.ln_quotient()),
        Op::PowerQuotient { pair, powers: [a, b], exponent } => {
            each!(number to, [pair both: pair, number a: a, number b: b, number r: exponent] {
                both.power_quotient([a, b], r)
            });
        }
        Op::ExpQuotient { values: [a, b], exponentials: [ea, eb] } => {
            each!(to, [a: a, ea: ea, b: b, eb: eb] exp_quotient([a, ea], [b, eb]));
        }
        Op::WholePower(a, exponent, order) => {
            let n = whole(exponent);
            each!(to, [x: a] whole_power(x, n, u32::from(order)));
        }
        Op::WholePowerQuotient([a, b], exponent, order) => {
            let n = whole(exponent);
            each!(to, [x: a, y: b] whole_power_quotient([x, y], n, u32::from(order)));
        }
        Op::Function(k, order, a) => match (order, parameters.function(k)) {
            (0, Some(function)) => each!(to, [x: a] function.value(x)),
            (1, Some(function)) => each!(to, [x: a] function.derivative(x)),
            (2, Some(function)) => each!(to, [x: a] function.second_derivative(x)),
            _ => each!(to, [_x: a] R::splat(f64::NAN)),
        },
        Op::FunctionQuotient(k, order, a, b) => match (order, parameters.function(k)) {
            (0, Some(function)) => each!(to, [x: a, y: b] function.quotient(x, y)),
            (1, Some(function)) => each!(to, [x: a, y: b] function.derivative_quotient(x, y)),
            _ => each!(to, [_x: a] R::splat(f64::NAN)),
        },
    }
}
