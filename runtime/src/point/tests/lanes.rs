//! Two numbers side by side: the kernels compile over them, and give each the bits it would get alone.

use super::measures::every_number;
use super::*;
use crate::hand_written::ExtendedNeoHookean;
use crate::lanes::{Lanes, Lanes2};
use crate::material::Material;

type Two = Lanes2<f64>;

/// A material's results at two deformations at once against the results at each.
#[track_caller]
fn check(material: &impl Material, pair: [&Matrix3<f64>; 2], filter: Filter) {
    let both = std::array::from_fn(|i| std::array::from_fn(|j| Two::load(&pair.map(|F| F[i][j]))));
    compare(pair.map(|F| evaluate(material, F, filter)), &evaluate(material, &both, filter));
    compare(
        pair.map(|H| evaluate(material, DisplacementGradient(H), filter)),
        &evaluate(material, DisplacementGradient(&both), filter),
    );
}

#[track_caller]
fn compare(alone: [Point<f64>; 2], both: &Point<Two>) {
    for (k, alone) in alone.iter().enumerate() {
        for (alone, both) in every_number(alone).into_iter().zip(every_number(both)) {
            let both = of_lane(both, k);
            let same = alone.to_bits() == both.to_bits() || (alone.is_nan() && both.is_nan());
            assert!(same, "{alone:e} became {both:e}");
        }
        let Status { refused, bounded, nonfinite, filtered } = both.status;
        let [refused, bounded, nonfinite, filtered] =
            [refused, bounded, nonfinite, filtered].map(|mask| Two::bits(mask) >> k & 1 == 1);
        assert_eq!(alone.status, Status { refused, bounded, nonfinite, filtered });
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
