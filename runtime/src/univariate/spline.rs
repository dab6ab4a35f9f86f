//! Force curves through control points, and the energy as their integral.

use super::{Piecewise, Univariate, by_pieces};
use crate::lanes::Real;
use crate::material::{Form, MaterialError};
use crate::message::number;

/// A function φ given by its derivative: φ′ is the natural cubic spline through control points, φ(1) = 0.
///
/// φ′ is twice continuously differentiable, and linear before the first and after the last control point, so
/// that φ is defined for every argument. If each curve of an energy has a control point (1, 0), the rest
/// state is free of stress.
///
/// ```
/// use piola::{Spline, Univariate};
///
/// # fn main() -> Result<(), piola::material::MaterialError> {
/// let force = Spline::through(&[[0.5, -2e5], [1.0, 0.0], [2.0, 1e5]])?;
/// assert_eq!(force.derivative(2.0), 1e5);
/// assert_eq!(force.value(1.0), 0.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(into = "Vec<[f64; 2]>", try_from = "Vec<[f64; 2]>")
)]
pub struct Spline {
    /// Abscissae of the control points.
    knots: Vec<f64>,
    /// φ′ at the control points.
    forces: Vec<f64>,
    /// Piece k ends at knot k, and one more follows the last knot. The first and the last are straight lines.
    pieces: Vec<Piece>,
}

/// φ = c0 + c1 d + … + c4 d⁴ with d = x − anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    anchor: f64,
    coefficients: [f64; 5],
}

impl Spline {
    /// The spline whose derivative, Pa, passes through these points (x, φ′).
    ///
    /// # Errors
    /// Fewer than two points, a coordinate that is not finite, or abscissae that do not increase.
    pub fn through(points: &[[f64; 2]]) -> Result<Self, MaterialError> {
        let refuse = |expected: String| Err(MaterialError::Shape { expected });
        if points.len() < 2 {
            return refuse(format!("a spline needs two or more control points, not {}", points.len()));
        }
        if let Some(point) = points.iter().flatten().find(|coordinate| !coordinate.is_finite()) {
            return refuse(format!("a control point has the coordinate {point}; it must be finite"));
        }
        if let Some(pair) = points.windows(2).find(|pair| pair[0][0] >= pair[1][0]) {
            return refuse(format!(
                "the control points of a spline must be in increasing order of x, but x = {} is followed by {}",
                number(pair[0][0]),
                number(pair[1][0])
            ));
        }
        let moments = moments(points);
        let (knots, forces) = points.iter().map(|&[x, force]| (x, force)).unzip();
        let mut pieces = Vec::new();
        for (k, pair) in points.windows(2).enumerate() {
            let ([x0, y0], [x1, y1]) = (pair[0], pair[1]);
            let (h, m0, m1) = (x1 - x0, moments[k], moments[k + 1]);
            let slope = (y1 - y0) / h;
            // A curve is zero at rest, x = 1. Pieces are expanded about their end nearer to it, so that a
            // control point (1, 0) is the anchor of both pieces next to it, and the curve exactly zero there.
            let (anchor, y, slope, m) = if x1 <= 1.0 {
                (x1, y1, slope + h * (m0 + 2.0 * m1) / 6.0, m1)
            } else {
                (x0, y0, slope - h * (2.0 * m0 + m1) / 6.0, m0)
            };
            let mut piece =
                Piece { anchor, coefficients: [0.0, y, slope / 2.0, m / 6.0, (m1 - m0) / (24.0 * h)] };
            if k == 0 {
                pieces.push(piece.straight_from(x0));
            }
            piece.coefficients[0] = pieces[k].taylor(x0)[0] - piece.taylor(x0)[0];
            pieces.push(piece);
        }
        let last = points.len() - 1;
        pieces.push(pieces[last].straight_from(points[last][0]));
        let mut spline = Self { knots, forces, pieces };
        let at_rest = spline.value(1.0);
        for piece in &mut spline.pieces {
            piece.coefficients[0] -= at_rest;
        }
        Ok(spline)
    }

    /// The control points (x, φ′) that it was made from.
    pub fn points(&self) -> impl ExactSizeIterator<Item = [f64; 2]> + '_ {
        self.knots.iter().zip(&self.forces).map(|(&x, &force)| [x, force])
    }

    /// Values that a fit may change: the ordinates φ′ of the control points, Pa, except for one at x = 1,
    /// which is kept, and with it a rest state without stress.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.points().filter(|&[x, _]| x != REST).map(|[_, force]| force).collect()
    }

    /// The spline with other [`values`](Self::values).
    ///
    /// # Errors
    /// [`MaterialError::Shape`] if there are more or fewer values, or one is not finite.
    ///
    /// ```
    /// use piola::Spline;
    ///
    /// # fn main() -> Result<(), piola::material::MaterialError> {
    /// let force = Spline::through(&[[0.5, -2e5], [1.0, 0.0], [2.0, 1e5]])?;
    /// assert_eq!(force.values(), [-2e5, 1e5]);
    /// let softer = force.with_values(&[-1e5, 5e4])?;
    /// assert!(softer.points().eq([[0.5, -1e5], [1.0, 0.0], [2.0, 5e4]]));
    /// # Ok(())
    /// # }
    /// ```
    pub fn with_values(&self, values: &[f64]) -> Result<Self, MaterialError> {
        let mut rest = values.iter();
        let mut next = || rest.next().copied();
        let points = self.points().map(|[x, force]| Some([x, if x == REST { force } else { next()? }]));
        match points.collect::<Option<Vec<_>>>() {
            Some(points) if rest.as_slice().is_empty() => Self::through(&points),
            _ => Err(MaterialError::Shape {
                expected: format!(
                    "this spline has {} ordinates to be changed, but {} are given",
                    self.values().len(),
                    values.len()
                ),
            }),
        }
    }

    /// The coefficients of the piece that x lies in, for each lane, and the distance of x from its anchor.
    #[inline(always)]
    fn piece<R: Real>(&self, x: R) -> ([R; 5], R) {
        let mut coefficients = self.pieces[0].coefficients_for();
        let mut anchor = R::splat(self.pieces[0].anchor);
        for (knot, piece) in self.knots.iter().zip(&self.pieces[1..]) {
            let is_before = x.less(R::splat(*knot));
            let next: [R; 5] = piece.coefficients_for();
            for k in 0..5 {
                coefficients[k] = R::select(is_before, coefficients[k], next[k]);
            }
            anchor = R::select(is_before, anchor, R::splat(piece.anchor));
        }
        (coefficients, x - anchor)
    }
}

impl From<Spline> for Vec<[f64; 2]> {
    fn from(spline: Spline) -> Self {
        spline.points().collect()
    }
}

impl TryFrom<Vec<[f64; 2]>> for Spline {
    type Error = MaterialError;

    fn try_from(points: Vec<[f64; 2]>) -> Result<Self, MaterialError> {
        Self::through(&points)
    }
}

impl Piece {
    #[inline(always)]
    fn coefficients_for<R: Real>(&self) -> [R; 5] {
        let [c0, c1, c2, c3, c4] = self.coefficients;
        [R::splat(c0), R::splat(c1), R::splat(c2), R::splat(c3), R::splat(c4)]
    }

    /// The piece with the φ, φ′ and φ″ of this one at x, and a straight φ′.
    fn straight_from(&self, x: f64) -> Self {
        let [value, slope, second] = self.taylor(x);
        Self { anchor: x, coefficients: [value, slope, second / 2.0, 0.0, 0.0] }
    }

    /// The coefficients, and the terms of the divided differences of powers: a + b = (a² − b²)/(a − b), a² +
    /// b² and a² + ab + b² = (a³ − b³)/(a − b), where a and b are measured from the anchor.
    #[inline(always)]
    fn between<R: Real>(&self, a: R, b: R) -> ([R; 5], [R; 3]) {
        let anchor = R::splat(self.anchor);
        let (a, b) = (a - anchor, b - anchor);
        let squares = a.mul_add(a, b * b);
        (self.coefficients_for(), [a + b, squares, a.mul_add(b, squares)])
    }

    /// φ, φ′ and φ″ at x.
    fn taylor(&self, x: f64) -> [f64; 3] {
        let [c0, c1, c2, c3, c4] = self.coefficients;
        let d = x - self.anchor;
        [
            c0 + d * (c1 + d * (c2 + d * (c3 + d * c4))),
            c1 + d * (2.0 * c2 + d * (3.0 * c3 + d * 4.0 * c4)),
            2.0 * c2 + d * (6.0 * c3 + d * 12.0 * c4),
        ]
    }
}

/// Second derivatives, called moments, of the natural cubic spline at its points, by elimination in the
/// tridiagonal system of continuous slopes [de Boor, *A Practical Guide to Splines*, chapter IV].
fn moments(points: &[[f64; 2]]) -> Vec<f64> {
    let n = points.len();
    let length = |k: usize| points[k + 1][0] - points[k][0];
    let slope = |k: usize| (points[k + 1][1] - points[k][1]) / length(k);
    let mut factors = vec![0.0; n];
    let mut moments = vec![0.0; n];
    for k in 1..n - 1 {
        let pivot = 2.0 * (length(k - 1) + length(k)) - length(k - 1) * factors[k - 1];
        factors[k] = length(k) / pivot;
        moments[k] = (6.0 * (slope(k) - slope(k - 1)) - length(k - 1) * moments[k - 1]) / pivot;
    }
    for k in (1..n - 1).rev() {
        moments[k] -= factors[k] * moments[k + 1];
    }
    moments
}

impl Univariate for Spline {
    const FORM: Form = Form::Points;

    #[inline(always)]
    fn value<R: Real>(&self, x: R) -> R {
        let ([c0, c1, c2, c3, c4], d) = self.piece(x);
        c4.mul_add(d, c3).mul_add(d, c2).mul_add(d, c1).mul_add(d, c0)
    }

    #[inline(always)]
    fn derivative<R: Real>(&self, x: R) -> R {
        let ([_, c1, c2, c3, c4], d) = self.piece(x);
        let (twice, thrice, four) = (c2 + c2, R::splat(3.0) * c3, R::splat(4.0) * c4);
        four.mul_add(d, thrice).mul_add(d, twice).mul_add(d, c1)
    }

    #[inline(always)]
    fn second_derivative<R: Real>(&self, x: R) -> R {
        let ([_, _, c2, c3, c4], d) = self.piece(x);
        (R::splat(12.0) * c4).mul_add(d, R::splat(6.0) * c3).mul_add(d, c2 + c2)
    }

    fn breakpoints(&self) -> &[f64] {
        &self.knots
    }

    #[inline(always)]
    fn quotient<R: Real>(&self, a: R, b: R) -> R {
        by_pieces(&Quotients::<false>(self), a, b)
    }

    #[inline(always)]
    fn derivative_quotient<R: Real>(&self, a: R, b: R) -> R {
        by_pieces(&Quotients::<true>(self), a, b)
    }

    /// Builds the spline from its control points, listed as x, φ′, x, φ′, …
    fn from_values(values: &[f64]) -> Result<Self, MaterialError> {
        let (points, rest) = values.as_chunks::<2>();
        if !rest.is_empty() {
            return Err(MaterialError::Shape {
                expected: format!("control points are pairs x, φ′, but there are {} numbers", values.len()),
            });
        }
        Self::through(points)
    }
}

/// The stretch of a length, an area or a volume at rest.
const REST: f64 = 1.0;

/// The quotients of φ, or of φ′, piece by piece.
struct Quotients<'a, const OF_SLOPE: bool>(&'a Spline);

impl<const OF_SLOPE: bool> Piecewise for Quotients<'_, OF_SLOPE> {
    #[inline(always)]
    fn breakpoints(&self) -> &[f64] {
        &self.0.knots
    }

    #[inline(always)]
    fn quotient_within<R: Real>(&self, k: usize, a: R, b: R) -> R {
        let ([_, c1, c2, c3, c4], [sum, squares, cubic]) = self.0.pieces[k].between(a, b);
        if OF_SLOPE {
            (R::splat(3.0) * c3).mul_add(sum, (R::splat(4.0) * c4) * cubic) + (c2 + c2)
        } else {
            (c4 * squares + c2).mul_add(sum, c3.mul_add(cubic, c1))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 2]; 5] = [[0.25, -3.0], [0.5, -1.5], [1.0, 0.0], [1.75, 1.0], [3.0, 4.0]];

    #[test]
    fn the_derivative_passes_through_the_points_and_bends_continuously() {
        let spline = Spline::through(&POINTS).unwrap();
        assert_eq!(spline.value(1.0), 0.0);
        for [x, y] in POINTS {
            assert!((spline.derivative(x) - y).abs() <= 1e-14, "at {x}");
            let [before, after] = [x.next_down(), x].map(|x| {
                let third = (spline.second_derivative(x + 1e-6) - spline.second_derivative(x - 1e-6)) / 2e-6;
                [spline.value(x), spline.derivative(x), spline.second_derivative(x), third]
            });
            for (left, right) in before.into_iter().zip(after) {
                assert!((left - right).abs() <= 1e-8 * (1.0 + left.abs()), "{left} and {right} at {x}");
            }
        }
        // Natural: straight at both ends.
        for x in [0.25, -1.0, 3.0, 5.0] {
            let h = 1e-3;
            let bend = spline.second_derivative(x + h) - spline.second_derivative(x - h);
            assert!(bend.abs() <= 0.02, "{bend} at {x}");
        }
        assert_eq!(spline.second_derivative(-1.0), spline.second_derivative(0.2));
    }

    #[test]
    fn ordinates_are_replaced_and_the_rest_stays() {
        let spline = Spline::through(&POINTS).unwrap();
        assert_eq!(spline.values(), [-3.0, -1.5, 1.0, 4.0]);
        assert_eq!(spline.with_values(&spline.values()), Ok(spline.clone()));
        // Where x is 1 alone decides: an ordinate that comes to be 0 is a value still.
        let other = spline.with_values(&[-3.0, 0.0, 1.0, 4.0]).unwrap();
        assert_eq!(other.values(), [-3.0, 0.0, 1.0, 4.0]);
        assert!(other.derivative(0.5).abs() <= 1e-14 && other.derivative(1.0) == 0.0);
        for values in [&[1.0; 3][..], &[1.0; 5]] {
            let error = spline.with_values(values).unwrap_err().to_string();
            assert!(error.contains("4 ordinates to be changed"), "{error}");
        }
        assert!(spline.with_values(&[f64::NAN; 4]).is_err());
    }

    #[test]
    fn bad_points_are_refused() {
        let message = |values: &[f64]| Spline::from_values(values).unwrap_err().to_string();
        assert!(message(&[1.0, 0.0]).contains("two or more control points, not 1"));
        assert!(message(&[1.0, 0.0, 2.0]).contains("pairs"));
        assert!(message(&[1.0, 0.0, 1.0, 2.0]).contains("x = 1 is followed by 1"));
        assert!(message(&[1.0, 0.0, f64::NAN, 2.0]).contains("finite"));
    }
}
