//! The operations of programs: each is the one that the emitted Rust of the same declaration performs.

use std::cell::Cell;

use super::parameters::Parameters;
use super::program::{Elementary, Exponent, Operation};
use super::registers::Files;
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

/// An operand with a value of its own at each group.
#[derive(Clone, Copy)]
struct Each<'a, R, const G: usize>(&'a [Cell<R>; G]);

impl<R: Real, const G: usize> Each<'_, R, G> {
    #[inline(always)]
    fn get(self, group: usize) -> R {
        self.0[group].get()
    }
}

/// Computes one operation at all groups.
#[inline(always)]
pub(super) fn compute<R: Real, const G: usize>(
    operation: &Operation,
    file: &Files<'_, R, G>,
    parameters: &Parameters<'_>,
    entry: usize,
) {
    /// A loop over the groups: `to = value` with the operands read from their registers.
    macro_rules! each {
        (number $to:expr, [$($operand_kind:ident $x:ident: $register:expr),+] $value:expr) => {{
            let to = file.number($to);
            $(let $x = file.$operand_kind($register);)+
            for group in 0..G {
                to.set(group, { $(let $x = read!($operand_kind $x, group);)+ $value });
            }
        }};
        ($kind:ident $to:expr, [$($operand_kind:ident $x:ident: $register:expr),+] $value:expr) => {{
            let to = file.$kind($to);
            $(let $x = file.$operand_kind($register);)+
            for group in 0..G {
                let value = { $(let $x = read!($operand_kind $x, group);)+ $value };
                to[group].set(value);
            }
        }};
    }
    macro_rules! read {
        (number $x:ident, $group:expr) => {
            $x.get($group)
        };
        ($kind:ident $x:ident, $group:expr) => {
            $x[$group].get()
        };
    }
    macro_rules! unary {
        ($to:expr, $a:expr, |$x:ident| $value:expr) => { each!(number $to, [number $x: $a] $value) };
    }
    macro_rules! binary {
        ($to:expr, $a:expr, $b:expr, |$x:ident, $y:ident| $value:expr) => {
            each!(number $to, [number $x: $a, number $y: $b] $value)
        };
    }
    macro_rules! ternary {
        ($to:expr, $operands:expr, |$x:ident, $y:ident, $z:ident| $value:expr) => {
            each!(number $to, [number $x: $operands[0], number $y: $operands[1], number $z: $operands[2]] $value)
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
    let whole = |exponent: Exponent| match exponent {
        Exponent::Parameter(k) => parameters.whole(k, 0),
        Exponent::Entry(k) => parameters.whole(k, entry),
    };
    match *operation {
        // The order of the operations, which is not theirs to decide.
        Operation::Begin(_) | Operation::End(_) => {}
        Operation::Neg(to, a) => arithmetic!(to, [x: a] -x),
        Operation::Add(to, a, b) => arithmetic!(to, [x: a, y: b] x + y),
        Operation::Sub(to, a, b) => arithmetic!(to, [x: a, y: b] x - y),
        Operation::Mul(to, a, b) => arithmetic!(to, [x: a, y: b] x * y),
        Operation::Div(to, a, b) => arithmetic!(to, [x: a, y: b] x / y),
        Operation::MulAdd(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] x.mul_add(y, z)),
        Operation::NegMulAdd(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] (-x).mul_add(y, z)),
        Operation::MulSub(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] x.mul_add(y, -z)),
        Operation::MulMul(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] x * y * z),
        Operation::MulMulMul(to, [a, b, c, d]) => arithmetic!(to, [x: a, y: b, z: c, w: d] x * y * z * w),
        Operation::MulMulAdd(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] (x * y).mul_add(z, w));
        }
        Operation::NegMulMulAdd(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] (-(x * y)).mul_add(z, w));
        }
        Operation::MulAddMul(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] x.mul_add(y, z) * w)
        }
        Operation::NegMulAddMul(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] (-x).mul_add(y, z) * w)
        }
        Operation::NegMul(to, a, b) => arithmetic!(to, [x: a, y: b] -(x * y)),
        Operation::Sqrt(to, a) => unary!(to, a, |x| x.sqrt()),
        Operation::Cbrt(to, a) => unary!(to, a, |x| x.cbrt()),
        Operation::Ln(to, a) => unary!(to, a, |x| x.ln()),
        Operation::Exp(to, a) => unary!(to, a, |x| x.exp()),
        Operation::Max(to, a, b) => binary!(to, a, b, |x, y| x.max(y)),
        Operation::Below(to, a, b) => binary!(to, a, b, |x, y| (x - y).min(R::splat(0.0))),
        Operation::AboveZero(to, a) => unary!(to, a, |x| above_zero(x)),
        Operation::WhereNegative(to, of) => {
            ternary!(to, of, |x, y, z| R::select(x.less(R::splat(0.0)), y, z))
        }
        Operation::ShareAbove(to, of) => ternary!(to, of, |x, y, z| share_above(x, y, z)),
        Operation::ShareBelow(to, of) => ternary!(to, of, |x, y, z| share_below(x, y, z)),
        Operation::PoleFloor(to, of) => ternary!(to, of, |x, y, z| pole_floor([x, y, z])),
        Operation::LnProduct(to, of) => ternary!(to, of, |x, y, z| ln_product([x, y, z])),
        Operation::Elementary(function, to, a) => match function {
            Elementary::Asinh => unary!(to, a, |x| x.asinh()),
            Elementary::Atan => unary!(to, a, |x| x.atan()),
            Elementary::Cos => unary!(to, a, |x| x.cos()),
            Elementary::Cosh => unary!(to, a, |x| x.cosh()),
            Elementary::Erf => unary!(to, a, |x| x.erf()),
            Elementary::ExpM1 => unary!(to, a, |x| x.exp_m1()),
            Elementary::Ln1p => unary!(to, a, |x| x.ln_1p()),
            Elementary::Sigmoid => unary!(to, a, |x| x.sigmoid()),
            Elementary::Sin => unary!(to, a, |x| x.sin()),
            Elementary::Sinh => unary!(to, a, |x| x.sinh()),
            Elementary::Softplus => unary!(to, a, |x| x.softplus()),
            Elementary::Tanh => unary!(to, a, |x| x.tanh()),
        },
        Operation::ElementaryQuotient(function, to, a, b) => match function {
            Elementary::Asinh => binary!(to, a, b, |x, y| asinh_quotient(x, y)),
            Elementary::Atan => binary!(to, a, b, |x, y| atan_quotient(x, y)),
            Elementary::Cos => binary!(to, a, b, |x, y| cos_quotient(x, y)),
            Elementary::Cosh => binary!(to, a, b, |x, y| cosh_quotient(x, y)),
            Elementary::Erf => binary!(to, a, b, |x, y| erf_quotient(x, y)),
            Elementary::ExpM1 => binary!(to, a, b, |x, y| exp_m1_quotient(x, y)),
            Elementary::Ln1p => binary!(to, a, b, |x, y| ln_1p_quotient(x, y)),
            Elementary::Sigmoid => binary!(to, a, b, |x, y| sigmoid_quotient(x, y)),
            Elementary::Sin => binary!(to, a, b, |x, y| sin_quotient(x, y)),
            Elementary::Sinh => binary!(to, a, b, |x, y| sinh_quotient(x, y)),
            Elementary::Softplus => binary!(to, a, b, |x, y| softplus_quotient(x, y)),
            Elementary::Tanh => binary!(to, a, b, |x, y| tanh_quotient(x, y)),
        },
        Operation::Logarithm(to, a) => each!(logarithm to, [number x: a] x.logarithm()),
        Operation::Power(to, logarithm, exponent) => {
            each!(number to, [logarithm ln: logarithm, number r: exponent] R::power(ln, r));
        }
        Operation::Pair { to, values: [a, b], reciprocals: [ra, rb], logarithms: [la, lb] } => {
            each!(pair to, [number a: a, number b: b, number ra: ra, number rb: rb, logarithm la: la, logarithm lb: lb] {
                Pair::new([a, b], [ra, rb], [la, lb])
            });
        }
        Operation::LnQuotient(to, pair) => each!(number to, [pair both: pair] both.ln_quotient()),
        Operation::PowerQuotient { to, pair, powers: [a, b], exponent } => {
            each!(number to, [pair both: pair, number a: a, number b: b, number r: exponent] {
                both.power_quotient([a, b], r)
            });
        }
        Operation::ExpQuotient(to, [a, ea], [b, eb]) => {
            each!(number to, [number a: a, number ea: ea, number b: b, number eb: eb] {
                exp_quotient([a, ea], [b, eb])
            });
        }
        Operation::WholePower(to, a, exponent, order) => {
            let n = whole(exponent);
            unary!(to, a, |x| whole_power(x, n, u32::from(order)));
        }
        Operation::WholePowerQuotient(to, [a, b], exponent, order) => {
            let n = whole(exponent);
            binary!(to, a, b, |x, y| whole_power_quotient([x, y], n, u32::from(order)));
        }
        Operation::Function(to, k, order, a) => match (order, parameters.function(k)) {
            (0, Some(function)) => unary!(to, a, |x| function.value(x)),
            (1, Some(function)) => unary!(to, a, |x| function.derivative(x)),
            (2, Some(function)) => unary!(to, a, |x| function.second_derivative(x)),
            _ => unary!(to, a, |_x| R::splat(f64::NAN)),
        },
        Operation::FunctionQuotient(to, k, order, [a, b]) => match (order, parameters.function(k)) {
            (0, Some(function)) => binary!(to, a, b, |x, y| function.quotient(x, y)),
            (1, Some(function)) => binary!(to, a, b, |x, y| function.derivative_quotient(x, y)),
            _ => unary!(to, a, |_x| R::splat(f64::NAN)),
        },
    }
}
