//! Functions of one variable as parameters of an energy: φ(λi), φ(λiλj), φ(J).
//!
//! An energy may be given by curves instead of formulas, as in Σ f(λi) + Σ g(λiλj) + h(J) \[XSZB15\]. A
//! parameter whose type implements [`Univariate`] is called in the declaration like a function, `f(l1)`. The
//! type supplies φ′ and φ″, mostly φ as well, and may supply the quotients φ\[a, b\] and φ′\[a, b\], which
//! have defaults, and the domain of φ. [`Spline`] is such a type, which approximates by control points.
//!
//! \[XSZB15\] Xu, Sin, Zhu, Barbič, *Nonlinear Material Design Using Principal Stretches*, 2015.

use std::fmt::Debug;

use crate::lanes::{Mask, Real};
use crate::material::{Form, MaterialError};

mod spline;

pub use spline::Spline;

/// A function φ of one variable, twice continuously differentiable.
///
/// Mark every method that computes `#[inline(always)]`: then it is compiled for the instructions of each back
/// end. The [contract](mod@crate::contract) of a material with the function compares φ, φ′, φ″ and the
/// quotients with each other: the rules `stress_slope`, `tangent_slope` and `quotients`.
///
/// ```
/// use piola::{Real, Univariate, material};
///
/// /// φ(x) = c (x − 1)², c in Pa.
/// #[derive(Clone, Debug, PartialEq)]
/// struct Parabola(f64);
///
/// impl Univariate for Parabola {
///     #[inline(always)]
///     fn value<R: Real>(&self, x: R) -> R {
///         let d = x - R::splat(1.0);
///         R::splat(self.0) * d * d
///     }
///     #[inline(always)]
///     fn derivative<R: Real>(&self, x: R) -> R {
///         R::splat(2.0 * self.0) * (x - R::splat(1.0))
///     }
///     #[inline(always)]
///     fn second_derivative<R: Real>(&self, _: R) -> R {
///         R::splat(2.0 * self.0)
///     }
/// }
///
/// /// A sum over the stretches.
/// #[material]
/// fn Separable([l1, l2, l3]: [f64; 3], /** Energy of a stretch. */ f: Parabola) -> f64 {
///     f(l1) + f(l2) + f(l3)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use piola::material::Declared;
/// assert_eq!(Separable::new(Parabola(1e6))?.moduli().mu, 1e6);
/// # Ok(())
/// # }
/// ```
pub trait Univariate: Clone + Debug + PartialEq + Send + Sync + 'static {
    /// The form of the numbers that [`from_values`](Univariate::from_values) takes.
    const FORM: Form = Form::Function;

    /// True if φ is defined at x; by default it is for every x.
    ///
    /// A material refuses the points at which an argument of one of its functions is not admitted, regardless
    /// of its [`inversion`](crate::material::Material::inversion): an extension continues the energy around
    /// its functions, not the functions themselves, which get the continued arguments. So with `extend` a
    /// function should admit the arguments of inverted points. The rest state must be admitted.
    ///
    /// With `x.less(R::splat(self.limit))` and `mu * f(I1b - 3.0)` in the energy, for example, chains lock at
    /// I1b = 3 + limit; `docs/your-first-material.md` has such a function.
    #[inline(always)]
    fn admits<R: Real>(&self, x: R) -> R::Mask {
        let _ = x;
        R::Mask::splat(true)
    }

    /// φ(x).
    ///
    /// By default the integral of φ′ from [`origin`](Univariate::origin) to x, for papers that give only
    /// derivatives: by Gauss's rule with eight points on each of 16 parts. Their ends are equally far apart,
    /// or, for x beyond a factor of 2 from a positive origin, have equal ratios, so that φ′ may grow as a
    /// power of x towards 0. The error is within rounding if φ′ is analytic for x > 0 and x within two orders
    /// of magnitude of the origin; with φ′ = x⁻⁴ it is 4e-13 of φ for 1e-3 of the origin, and 1e-6 for 1e-8.
    /// It matters to ψ alone where φ stands alone in the energy.
    #[inline(always)]
    fn value<R: Real>(&self, x: R) -> R {
        const PARTS: u8 = 16;
        let origin = R::splat(self.origin());
        let ratio = x / origin;
        let is_far =
            R::splat(0.0).less(origin.min(x)) & !(R::splat(0.5).less(ratio) & ratio.less(R::splat(2.0)));
        let scale = R::select(is_far, ratio, R::splat(1.0)).ln();
        let end = |k: u8| {
            let share = R::splat(f64::from(k) / f64::from(PARTS));
            let (even, by_ratio) = (share.mul_add(x - origin, origin), origin * (share * scale).exp());
            R::select(is_far, by_ratio, even)
        };
        let (mut sum, mut from) = (R::splat(0.0), origin);
        for k in 1..=PARTS {
            let to = if k == PARTS { x } else { end(k) };
            sum = (to - from).mul_add(by_pieces(&Derivative::<_, 0>(self), to, from), sum);
            from = to;
        }
        sum
    }

    /// Argument at which φ is 0 if [`value`](Univariate::value) is the default.
    ///
    /// 1 by default; 3 suits a function of I1 or I2.
    fn origin(&self) -> f64 {
        1.0
    }

    /// φ′(x).
    fn derivative<R: Real>(&self, x: R) -> R;

    /// φ″(x).
    fn second_derivative<R: Real>(&self, x: R) -> R;

    /// Points at which φ is not smooth, in increasing order; the default methods integrate between them.
    ///
    /// None by default. If φ has a kink that is not among them, the defaults detect it and use the plain
    /// quotient, which loses digits in proportion to the gap.
    fn breakpoints(&self) -> &[f64] {
        &[]
    }

    /// φ\[a, b\] = (φ(a) − φ(b))/(a − b), and φ′(a) for a = b.
    ///
    /// The default is the plain quotient for |a − b| > ¼ max(|a|, |b|), which loses about two digits at most,
    /// else the mean of φ′ over each smooth piece between b and a, by Gauss's rule with eight points. The
    /// error of the mean is below h¹⁶ max|φ⁽¹⁷⁾| / 10²⁴ for a piece of length h, which is within rounding if
    /// φ is analytic for all x > 0.
    #[inline(always)]
    fn quotient<R: Real>(&self, a: R, b: R) -> R {
        quotient_by_pieces(&Derivative::<_, 0>(self), a, b)
    }

    /// φ′\[a, b\] = (φ′(a) − φ′(b))/(a − b), and φ″(a) for a = b.
    ///
    /// The default is that of [`Univariate::quotient`], applied to φ′.
    #[inline(always)]
    fn derivative_quotient<R: Real>(&self, a: R, b: R) -> R {
        quotient_by_pieces(&Derivative::<_, 1>(self), a, b)
    }

    /// Builds the function from a list of numbers, for a material that is chosen by name at run time.
    ///
    /// # Errors
    /// [`MaterialError::Shape`] if the list describes no function of this type; by default always.
    fn from_values(values: &[f64]) -> Result<Self, MaterialError> {
        let _ = values;
        let type_name = std::any::type_name::<Self>();
        Err(MaterialError::Shape {
            expected: format!("a {type_name} cannot be given by numbers, only in Rust"),
        })
    }
}

/// The derivative of order N of a function, 0 or 1.
struct Derivative<'a, F, const N: u8>(&'a F);

impl<F: Univariate, const N: u8> Derivative<'_, F, N> {
    #[inline(always)]
    fn at<R: Real>(&self, x: R) -> R {
        match N {
            0 => self.0.value(x),
            _ => self.0.derivative(x),
        }
    }

    #[inline(always)]
    fn slope<R: Real>(&self, x: R) -> R {
        match N {
            0 => self.0.derivative(x),
            _ => self.0.second_derivative(x),
        }
    }

    /// True if the slope jumps between a and b, at a point that is not among the breakpoints.
    ///
    /// A mean of slopes is then wrong by up to the jump. Between close points a smooth slope is nearly
    /// straight: its second difference s(a) − 2 s(m) + s(b) is far below its first. A jump is in one half,
    /// and both are as large as it is. A difference that noise explains, 2¹⁴ u of the slopes, is not a jump.
    #[inline(always)]
    fn bends<R: Real>(&self, a: R, b: R) -> R::Mask {
        if !self.0.breakpoints().is_empty() {
            return R::Mask::splat(false);
        }
        let half = R::splat(0.5);
        let [at_a, at_b, middle] = [a, b, a.mul_add(half, b * half)].map(|x| self.slope(x));
        let (first, second) = (at_a - at_b, (at_a - middle) - (middle - at_b));
        let noise = R::splat(16384.0 * R::unit_roundoff()) * at_a.abs().max(at_b.abs()).max(middle.abs());
        (R::splat(0.25) * first.abs() + noise).less(second.abs())
    }
}

impl<F: Univariate, const N: u8> Piecewise for Derivative<'_, F, N> {
    #[inline(always)]
    fn breakpoints(&self) -> &[f64] {
        self.0.breakpoints()
    }

    /// The mean of the slope between b and a, exact for polynomials of degree 15.
    #[inline(always)]
    fn quotient_within<R: Real>(&self, _: usize, a: R, b: R) -> R {
        /// Positive abscissae and their weights of Gauss's rule with eight points on −1 … 1.
        const RULE: [[f64; 2]; 4] = [
            [0.183_434_642_495_649_8, 0.362_683_783_378_362],
            [0.525_532_409_916_329, 0.313_706_645_877_887_27],
            [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
            [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
        ];
        let half = R::splat(0.5);
        let (middle, reach) = (a.mul_add(half, b * half), (a - b) * half);
        let mut sum = R::splat(0.0);
        for [x, weight] in RULE {
            let offset = reach * R::splat(x);
            let both = self.slope(middle + offset) + self.slope(middle - offset);
            sum = both.mul_add(R::splat(0.5 * weight), sum);
        }
        sum
    }
}

#[inline(always)]
fn quotient_by_pieces<F: Univariate, R: Real, const N: u8>(function: &Derivative<'_, F, N>, a: R, b: R) -> R {
    let gap = a - b;
    let is_wide = (R::splat(0.25) * a.abs().max(b.abs())).less(gap.abs());
    let plain = (function.at(a) - function.at(b)) / gap;
    if !(!is_wide).any() {
        return plain;
    }
    let is_plain = is_wide | function.bends(a, b);
    R::select(is_plain, plain, by_pieces(function, a, b))
}

/// A function whose divided differences are known within each of its smooth pieces.
trait Piecewise {
    /// The ends of the pieces, in increasing order.
    fn breakpoints(&self) -> &[f64];

    /// The divided difference between two points of piece k, which ends at breakpoint k.
    fn quotient_within<R: Real>(&self, k: usize, a: R, b: R) -> R;
}

/// A divided difference across pieces: the mean of those within each piece, weighted with its length.
#[inline(always)]
fn by_pieces<R: Real>(function: &impl Piecewise, a: R, b: R) -> R {
    let breakpoints = function.breakpoints();
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let gap = a - b;
    let is_point = !zero.less(gap.abs());
    let mut sum = zero;
    for k in 0..=breakpoints.len() {
        let start = R::splat(if k == 0 { f64::NEG_INFINITY } else { breakpoints[k - 1] });
        let end = R::splat(if k < breakpoints.len() { breakpoints[k] } else { f64::INFINITY });
        let (from, to) = (b.max(start).min(end), a.max(start).min(end));
        let is_inside = !a.less(start) & a.less(end);
        let share = R::select(is_point, R::select(is_inside, one, zero), (to - from) / gap);
        sum = share.mul_add(function.quotient_within(k, to, from), sum);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// φ = −ln x with the defaults.
    #[derive(Clone, Debug, PartialEq)]
    struct Logarithm;

    impl Univariate for Logarithm {
        fn value<R: Real>(&self, x: R) -> R {
            -x.ln()
        }
        fn derivative<R: Real>(&self, x: R) -> R {
            -(R::splat(1.0) / x)
        }
        fn second_derivative<R: Real>(&self, x: R) -> R {
            R::splat(1.0) / (x * x)
        }
    }

    #[test]
    fn default_quotients_keep_their_digits_at_every_gap() {
        for b in [0.01, 1.0, 300.0] {
            for gap in (0..60).map(|k| 2f64.powi(-k)).chain([0.0]) {
                let a = b + b * gap;
                // (1/b − 1/a)/(a − b) = 1/(ab), and for the logarithm its kernel.
                let exact = 1.0 / (a * b);
                let found = Logarithm.derivative_quotient(a, b);
                assert!((found - exact).abs() <= 16.0 * f64::UNIT_ROUNDOFF * exact, "{found} for {exact}");
                let exact = -crate::quotient::Pair::of(a, b).ln_quotient();
                let found = Logarithm.quotient(a, b);
                // The plain quotient at ln 1.25 loses a factor of 1/0.2 of what the logarithms have.
                let noise = 8.0 + 4.0 * a.ln().abs().max(b.ln().abs()) / (a / b).ln().max(0.2);
                assert!(
                    (found - exact).abs() <= noise * f64::UNIT_ROUNDOFF * exact.abs(),
                    "{found} for {exact}"
                );
            }
        }
    }

    /// φ = |x − 1|, the kink of which is not declared.
    #[derive(Clone, Debug, PartialEq)]
    struct Kink;

    impl Univariate for Kink {
        fn value<R: Real>(&self, x: R) -> R {
            (x - R::splat(1.0)).abs()
        }
        fn derivative<R: Real>(&self, x: R) -> R {
            R::select(x.less(R::splat(1.0)), R::splat(-1.0), R::splat(1.0))
        }
        fn second_derivative<R: Real>(&self, _: R) -> R {
            R::splat(0.0)
        }
    }

    #[test]
    fn kinks_that_are_not_declared_are_noticed() {
        for gap in (2..40).map(|k| 2f64.powi(-k)) {
            // φ(a) − φ(b) is exact for these.
            let (a, b) = (1.0 + 0.75 * gap, 1.0 - 0.25 * gap);
            assert_eq!(Kink.quotient(a, b), 0.5, "{gap:e}");
        }
        assert_eq!(Kink.quotient(1.5, 1.4375), 1.0);
    }

    /// φ by its derivative alone, as a paper gives it: φ′ = x⁻⁴, which grows without bound towards 0.
    #[derive(Clone, Debug, PartialEq)]
    struct Pole;

    impl Univariate for Pole {
        fn derivative<R: Real>(&self, x: R) -> R {
            R::splat(1.0) / (x * x * x * x)
        }
        fn second_derivative<R: Real>(&self, x: R) -> R {
            R::splat(-4.0) / (x * x * x * x * x)
        }
    }

    #[test]
    fn integrals_towards_a_pole_keep_their_digits() {
        for (x, tolerance) in
            [(0.6, 1e-14), (0.4, 1e-14), (0.01, 1e-14), (1e-3, 1e-12), (1e-8, 2e-6), (50.0, 1e-14)]
        {
            let exact = (1.0 - 1.0 / (x * x * x)) / 3.0;
            let error = (Pole.value(x) - exact).abs() / f64::abs(exact);
            assert!(error <= tolerance, "{x}: {error:e}");
        }
    }

    #[test]
    fn a_function_without_numbers_says_so() {
        let error = Logarithm::from_values(&[1.0]).unwrap_err().to_string();
        assert!(error.contains("only in Rust"), "{error}");
    }
}
