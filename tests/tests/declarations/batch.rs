//! Each point of a batch gets the bits that it would get alone, on every back end; stresses by invariants and
//! by stretches agree, and so do the layouts.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use piola::batch::{Batch, Layout};
use piola::lanes::Backend;
use piola_tests::answers::{Answers, COUNT, HUGE, deformations};
use piola_tests::declarations::{Sample, slices};
use piola_tests::is_full;

/// The answers of a batch together, with what made them.
struct Judge<'a> {
    what: String,
    batch: Batch<'a, f64>,
    all: &'a [[f64; 9]],
    together: Answers<f64>,
}

pub(crate) fn judge(sample: &Sample) {
    let all = deformations();
    for values in sample.values() {
        for inversion in sample.judged.inversions(0.25) {
            let Ok(material) = sample.judged.subject(&slices(&values), inversion) else { continue };
            for backend in Backend::available() {
                let what = format!("{values:?} {inversion:?} on {backend}");
                let batch = Batch::new(&*material.double).with_backend(backend);
                let together = Answers::of(batch, all.as_flattened());
                let judge = Judge { what, batch, all: &all, together };
                judge.points_get_what_they_would_get_alone();
                judge.stresses_are_the_same_by_another_way();
                judge.lines_are_points();
            }
        }
    }
}

impl Judge<'_> {
    fn points_get_what_they_would_get_alone(&self) {
        let Self { what, together, .. } = self;
        let mut refused = [0; 3];
        let mut p = 0;
        while p < COUNT {
            // The first ones and those around the huge one are alone, others by threes unless all are judged.
            let is_alone = is_full() || p < 8 || (HUGE - 2..=HUGE).contains(&p);
            let count = if is_alone { 1 } else { 3.min(COUNT - p) };
            let alone = Answers::of(self.batch, self.all[p..p + count].as_flattened());
            for (refused, survey) in refused.iter_mut().zip(&alone.surveys) {
                *refused += survey.refused;
            }
            together.check(what, p, &alone);
            p += count;
        }
        assert_eq!(together.surveys.each_ref().map(|survey| survey.refused), refused, "{what}");
    }

    /// Tangents need a decomposition, and stresses may come from invariants.
    fn stresses_are_the_same_by_another_way(&self) {
        let Self { what, together, .. } = self;
        let is_judged =
            |p: &usize| *p != HUGE && together.statuses[*p].iter().all(|status| status.is_clean());
        for p in (0..COUNT).filter(is_judged) {
            let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (found, expected) = (&together.stresses[9 * p..][..9], &together.beside[9 * p..][..9]);
            let difference: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
            // Each of the two is good to 30 u (‖P‖ + sens), as the reference cases judge.
            let sensitivity = norm(&together.tangents[81 * p..][..81]) * norm(&self.all[p]);
            let bound = 60.0 * f64::EPSILON / 2.0 * (norm(expected) + sensitivity);
            assert!(norm(&difference) <= bound, "{what}, point {p}: {} > {bound}", norm(&difference));
        }
    }

    fn lines_are_points(&self) {
        let whole = COUNT / 8 * 8;
        let entries =
            || (0..whole).flat_map(|p| (0..9).map(move |k| (p, k, Layout::Lines.index::<f64>(p, 9, k))));
        let (mut F, mut P) = (vec![0.0; 9 * whole], vec![0.0; 9 * whole]);
        for (p, k, place) in entries() {
            F[place] = self.all[p][k];
        }
        self.batch.with_layout(Layout::Lines).stresses(&F, &mut P).expect("whole lines");
        for (p, k, place) in entries() {
            let (found, expected) = (P[place], self.together.stresses[9 * p + k]);
            assert_eq!(found.to_bits(), expected.to_bits(), "{}, entry {k} of point {p}", self.what);
        }
    }
}
