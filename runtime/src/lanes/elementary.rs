//! Exponential, logarithm, powers and the cube root, written once for scalars and lanes.
//!
//! A power is e^(y ln x), and an error of the logarithm is multiplied by y ln x, which reaches 745. So
//! logarithms come with ten more digits than the format has, as an unevaluated sum of two numbers, and one of
//! them serves all powers of a base. There are no tables, since lanes would have to gather from them, and no
//! branch.
//!
//! Coefficients are minimax fits of the series' tails on the stated intervals. The leading terms stay exact,
//! so that the functions are exact where they should be: ln 1 = 0, e⁰ = 1, x⁰ = 1, 1ʸ = 1, ∛(n³) = n.
//!
//! Errors, in units in the last place, hold with and without a fused multiply-add: without it a product whose
//! own error matters is taken apart. `tests/elementary.rs` of the judge measures them.
//!
//! \[CW80\] Cody, Waite, *Software Manual for the Elementary Functions*, 1980, for the splitting of ln 2.
//! \[Dekker71\] Dekker, *A floating-point technique for extending the available precision*, 1971.

mod arithmetic;
mod cube_root;
mod exponential;
mod logarithm;

pub(super) use arithmetic::{is_finite, power_of_two_scale, two_product};
pub(super) use cube_root::cbrt;
pub(super) use exponential::{exp, power};
pub(super) use logarithm::{Logarithm, ln, logarithm, logarithm_of_ratio};

/// The part of an implementation of `Real` that is alike for all `Primitive`s: the functions above.
macro_rules! elementary_functions {
    () => {
        type Logarithm = $crate::lanes::elementary::Logarithm<Self>;

        elementary_functions! {
            cbrt() -> Self, ln() -> Self, exp() -> Self, logarithm() -> Self::Logarithm, is_finite() -> Self::Mask,
            two_product(other) -> (Self, Self), power_of_two_scale() -> (Self, Self),
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
