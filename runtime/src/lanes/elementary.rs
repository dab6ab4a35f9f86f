//! Exponential, logarithm, powers, the cube root, and the functions that are made like them, written once for
//! scalars and lanes.
//!
//! A power is e^(y ln x), and an error of the logarithm is multiplied by y ln x, which reaches 745. So
//! logarithms come with ten more digits than the format has, as an unevaluated sum of two numbers, and one of
//! them is enough for all powers of a base. There are no tables, since lanes would have to gather from them,
//! and no branch.
//!
//! Coefficients are minimax fits of the series' tails on the stated intervals. The leading terms stay exact,
//! so that the functions are exact where they should be: ln 1 = 0, e⁰ = 1, x⁰ = 1, 1ʸ = 1, ∛(n³) = n, and
//! those that vanish at 0 keep the digits of x close to it. Odd functions are those of |x| with the sign of
//! x.
//!
//! Errors, in units in the last place, hold with and without a fused multiply-add: without it a product whose
//! own error matters is taken apart. `tests/elementary.rs` of the judge measures them.
//!
//! \[CW80\] Cody, Waite, *Software Manual for the Elementary Functions*, 1980, for the splitting of ln 2.
//! \[Knuth97\] Knuth, *The Art of Computer Programming*, vol. 2, 3rd ed., 1997, for sums with their errors.
//! \[Dekker71\] Dekker, *A floating-point technique for extending the available precision*, 1971.

mod arctangent;
mod arithmetic;
mod cube_root;
mod error_function;
mod exponential;
mod hyperbolic;
mod inverse_hyperbolic;
mod logarithm;
mod sigmoid;
mod trigonometric;

pub(super) use arctangent::atan;
pub(super) use arithmetic::{is_finite, power_of_two_scale, two_product};
pub(super) use cube_root::cbrt;
pub(super) use error_function::erf;
pub(super) use exponential::{exp, exp_m1, power};
pub(super) use hyperbolic::{cosh, sinh, tanh};
pub(super) use inverse_hyperbolic::asinh;
pub(super) use logarithm::{Logarithm, ln, ln_1p, logarithm, logarithm_of_ratio};
pub(super) use sigmoid::{sigmoid, softplus};
pub(super) use trigonometric::{cos, sin};

/// The part of an implementation of `Real` that is alike for all `Primitive`s: the functions above.
macro_rules! elementary_functions {
    () => {
        type Logarithm = $crate::lanes::elementary::Logarithm<Self>;

        elementary_functions! {
            cbrt() -> Self, ln() -> Self, ln_1p() -> Self, exp() -> Self, exp_m1() -> Self, sinh() -> Self,
            cosh() -> Self, tanh() -> Self, asinh() -> Self, sin() -> Self, cos() -> Self, atan() -> Self,
            erf() -> Self, softplus() -> Self, sigmoid() -> Self, logarithm() -> Self::Logarithm,
            is_finite() -> Self::Mask, two_product(other) -> (Self, Self), power_of_two_scale() -> (Self, Self),
        }

        #[inline(always)]
        fn power(logarithm: Self::Logarithm, exponent: Self) -> Self {
            $crate::lanes::elementary::power(logarithm, exponent)
        }

        #[inline(always)]
        fn logarithm_of_ratio(a: Self::Logarithm, b: Self::Logarithm) -> Self {
            $crate::lanes::elementary::logarithm_of_ratio(a, b)
        }
    };
    ($($function:ident($($other:ident)?) -> $Output:ty,)*) => {$(
        #[inline(always)]
        fn $function(self $(, $other: Self)?) -> $Output {
            $crate::lanes::elementary::$function(self $(, $other)?)
        }
    )*};
}
pub(super) use elementary_functions;
