//! Two numbers side by side: the kernels compile over them, and give each the bits it would get alone.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::*;
use crate::hand_written::ExtendedNeoHookean;

#[derive(Clone, Copy, Debug)]
struct Two([f64; 2]);

#[derive(Clone, Copy, Debug)]
struct TwoTruths([bool; 2]);

impl Two {
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }

    /// Two results for each number.
    fn unzip(pairs: [(f64, f64); 2]) -> (Self, Self) {
        (Self(pairs.map(|pair| pair.0)), Self(pairs.map(|pair| pair.1)))
    }
}

macro_rules! operators {
    ($($Operator:ident $method:ident),*) => {$(
        impl $Operator for Two {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.zip(other, $Operator::$method)
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Two {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(Neg::neg)
    }
}

impl BitAnd for TwoTruths {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self([self.0[0] & other.0[0], self.0[1] & other.0[1]])
    }
}

impl BitOr for TwoTruths {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self([self.0[0] | other.0[0], self.0[1] | other.0[1]])
    }
}

impl Not for TwoTruths {
    type Output = Self;
    fn not(self) -> Self {
        Self(self.0.map(Not::not))
    }
}

impl Mask for TwoTruths {
    fn splat(value: bool) -> Self {
        Self([value; 2])
    }

    fn any(self) -> bool {
        self.0[0] || self.0[1]
    }
}

impl Real for Two {
    type Mask = TwoTruths;
    const UNIT_ROUNDOFF: f64 = f64::UNIT_ROUNDOFF;
    const MIN_POSITIVE: f64 = <f64 as Real>::MIN_POSITIVE;

    fn splat(value: f64) -> Self {
        Self([value; 2])
    }

    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self(std::array::from_fn(|k| Real::mul_add(self.0[k], factor.0[k], addend.0[k])))
    }

    fn sqrt(self) -> Self {
        self.map(Real::sqrt)
    }

    fn cbrt(self) -> Self {
        self.map(Real::cbrt)
    }

    fn ln(self) -> Self {
        self.map(Real::ln)
    }

    fn exp(self) -> Self {
        self.map(Real::exp)
    }

    fn powf(self, exponent: Self) -> Self {
        self.zip(exponent, Real::powf)
    }

    fn abs(self) -> Self {
        self.map(Real::abs)
    }

    fn max(self, other: Self) -> Self {
        self.zip(other, Real::max)
    }

    fn min(self, other: Self) -> Self {
        self.zip(other, Real::min)
    }

    fn copysign(self, sign: Self) -> Self {
        self.zip(sign, Real::copysign)
    }

    fn less(self, other: Self) -> TwoTruths {
        TwoTruths(std::array::from_fn(|k| self.0[k] < other.0[k]))
    }

    fn is_finite(self) -> TwoTruths {
        TwoTruths(self.0.map(f64::is_finite))
    }

    fn select(mask: TwoTruths, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|k| if mask.0[k] { yes.0[k] } else { no.0[k] }))
    }

    fn two_product(self, other: Self) -> (Self, Self) {
        Self::unzip(std::array::from_fn(|k| self.0[k].two_product(other.0[k])))
    }

    fn power_of_two_scale(self) -> (Self, Self) {
        Self::unzip(self.0.map(Real::power_of_two_scale))
    }
}

/// A material's points of two deformations at once against those of each.
#[track_caller]
fn check(material: &impl Material, pair: [&Matrix3<f64>; 2], filter: Filter) {
    let both = std::array::from_fn(|i| std::array::from_fn(|j| Two(pair.map(|F| F[i][j]))));
    compare(pair.map(|F| evaluate(material, F, filter)), &evaluate::<Two>(material, &both, filter));
    compare(
        pair.map(|H| evaluate_from_displacement(material, H, filter)),
        &evaluate_from_displacement::<Two>(material, &both, filter),
    );
}

#[track_caller]
fn compare(alone: [Point<f64>; 2], both: &Point<Two>) {
    let both_dP_dF = both.tangent.to_matrix();
    for (k, alone) in alone.into_iter().enumerate() {
        let stress = alone.stress.iter().flatten().zip(both.stress.iter().flatten());
        let dP_dF = alone.tangent.to_matrix();
        let tangent = dP_dF.iter().flatten().zip(both_dP_dF.iter().flatten());
        for (alone, both) in stress.chain(tangent) {
            let same = alone.to_bits() == both.0[k].to_bits() || (alone.is_nan() && both.0[k].is_nan());
            assert!(same, "{alone:e} became {:e} in {both:?}", both.0[k]);
        }
        assert_eq!(alone.filtered, both.filtered.0[k]);
        assert_eq!(alone.status.bounded, both.status.bounded.0[k]);
        assert_eq!(alone.status.refused, both.status.refused.0[k]);
        assert_eq!(alone.status.nonfinite, both.status.nonfinite.0[k]);
    }
}

#[test]
fn no_number_depends_on_its_neighbour() {
    let mut random = Random::new(41);
    let mut deformations: Vec<_> = STRETCHES.iter().map(|&l| with_stretches(&mut random, l)).collect();
    deformations.push([[0.0; 3]; 3]);
    // As displacement gradients these are small, and one of them tiny.
    deformations.push(random.matrix().map(|row| row.map(|x| x * 0.1)));
    deformations.push(random.matrix().map(|row| row.map(|x| x * 1e-290)));
    deformations.push(random.matrix().map(|row| row.map(|x| x * 1e200)));
    for F in &deformations {
        for G in &deformations {
            for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
                check(&SaintVenantKirchhoff, [F, G], filter);
                check(&RotatedLinear, [F, G], filter);
                check(&ExtendedNeoHookean { epsilon: 0.3 }, [F, G], filter);
            }
        }
    }
}
