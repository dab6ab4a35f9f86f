//! A method that takes part, and what it reads and writes.

#![expect(non_snake_case, reason = "F, P, K as in the literature")]

use piola::Real;
use piola::batch::{Batch, Kernels, Layout, TileMaterial};
use piola::lanes::{Backend, Kernel, Lanes};
use piola::point::{Filter, Matrix3};
use piola_baselines::LibraryNumber;

/// Points of a group: a tile of a batch.
pub(crate) const POINTS: usize = 64;

/// `f64` or `f32`: a format of batches, and of the libraries of the baselines.
pub(crate) trait Number: Kernels + LibraryNumber {}

impl Number for f64 {}
impl Number for f32 {}

/// Deformation gradients, one by one and in lines.
pub(crate) struct Points<E> {
    pub(crate) F: Vec<Matrix3<E>>,
    pub(crate) lines: Vec<E>,
}

impl<E: Kernels> Points<E> {
    pub(crate) fn new(deformation: impl Fn(usize) -> [f64; 9]) -> Self {
        let mut F = vec![[[E::default(); 3]; 3]; POINTS];
        let mut lines = vec![E::default(); 9 * POINTS];
        for point in 0..POINTS {
            for (k, x) in deformation(point).into_iter().enumerate() {
                F[point][k / 3][k % 3] = E::splat(x);
                lines[Layout::Lines.index::<E>(point, 9, k)] = E::splat(x);
            }
        }
        Self { F, lines }
    }
}

/// P and dP/dF of the points.
pub(crate) struct Output<E> {
    pub(crate) P: Vec<E>,
    pub(crate) K: Vec<E>,
}

impl<E: Kernels> Output<E> {
    pub(crate) fn new() -> Self {
        Self { P: vec![E::default(); 9 * POINTS], K: vec![E::default(); 81 * POINTS] }
    }

    /// Fills it with what no method may leave.
    pub(crate) fn clear(&mut self) {
        self.P.fill(E::splat(f64::NAN));
        self.K.fill(E::splat(f64::NAN));
    }

    pub(crate) fn of_point(&self, point: usize, layout: Layout) -> ([f64; 9], [f64; 81]) {
        let P = std::array::from_fn(|k| self.P[layout.index::<E>(point, 9, k)].into());
        (P, std::array::from_fn(|k| self.K[layout.index::<E>(point, 81, k)].into()))
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Label {
    pub(crate) method: &'static str,
    /// Empty where there is nothing to set.
    pub(crate) setting: String,
    pub(crate) is_general: bool,
}

impl Label {
    pub(crate) fn new(method: &'static str) -> Self {
        Self { method, setting: String::new(), is_general: true }
    }

    pub(crate) fn set(method: &'static str, setting: impl ToString) -> Self {
        Self { setting: setting.to_string(), ..Self::new(method) }
    }

    /// Label of a method for particular energies.
    pub(crate) fn special(method: &'static str) -> Self {
        Self { is_general: false, ..Self::new(method) }
    }
}

type Run<E> = dyn Fn(&Points<E>, &mut Output<E>);

/// A method for one energy.
pub(crate) struct Contestant<E> {
    pub(crate) label: Label,
    /// Layout of its output.
    pub(crate) layout: Layout,
    pub(crate) run: Box<Run<E>>,
}

impl<E: Kernels> Contestant<E> {
    pub(crate) fn batch(label: Label, material: impl TileMaterial<E> + 'static, filter: Filter) -> Self {
        let run = move |points: &Points<E>, output: &mut Output<E>| {
            let layout = Layout::Lines;
            let batch = Batch::new(&material).with_filter(filter).with_layout(layout);
            let survey = batch.tangents(&points.lines, &mut output.P, &mut output.K);
            // What a survey complains of, the reference judges too.
            survey.expect("the slices fit the points");
        };
        Self { label, layout: Layout::Lines, run: Box::new(run) }
    }

    /// One point after the other, compiled for the instructions of the best back end.
    pub(crate) fn one_by_one(label: Label, method: impl AtPoint<E> + 'static) -> Self {
        let run = move |points: &Points<E>, output: &mut Output<E>| {
            Backend::best().run(OneByOne { method: &method, F: &points.F, output });
        };
        Self { label, layout: Layout::Points, run: Box::new(run) }
    }

    /// Contestant that computes as many points side by side as a register holds.
    pub(crate) fn on_lanes(label: Label, method: impl OnLanes + 'static) -> Self {
        let run = move |points: &Points<E>, output: &mut Output<E>| {
            Backend::best().run(SideBySide { method: &method, F: &points.lines, output });
        };
        Self { label, layout: Layout::Lines, run: Box::new(run) }
    }
}

/// A method for a point. `#[inline(always)]`, so that it is compiled for a back end.
pub(crate) trait AtPoint<E> {
    /// P and dP/dF.
    fn evaluate(&self, F: &Matrix3<E>) -> (Matrix3<E>, [[E; 9]; 9]);
}

/// A method for as many points as a register holds. `#[inline(always)]` likewise.
pub(crate) trait OnLanes {
    /// P and dP/dF.
    fn evaluate<R: Real>(&self, F: &Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]);
}

/// A point alone is a register of one.
impl<T: OnLanes, E: Kernels> AtPoint<E> for T {
    #[inline(always)]
    fn evaluate(&self, F: &Matrix3<E>) -> (Matrix3<E>, [[E; 9]; 9]) {
        OnLanes::evaluate(self, F)
    }
}

struct OneByOne<'a, T, E> {
    method: &'a T,
    F: &'a [Matrix3<E>],
    output: &'a mut Output<E>,
}

impl<T: AtPoint<E>, E: Kernels> Kernel<E> for OneByOne<'_, T, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let Output { P, K } = self.output;
        for point in 0..self.F.len() {
            let (stress, tangent) = self.method.evaluate(&self.F[point]);
            P[9 * point..][..9].copy_from_slice(stress.as_flattened());
            K[81 * point..][..81].copy_from_slice(tangent.as_flattened());
        }
    }
}

struct SideBySide<'a, T, E> {
    method: &'a T,
    F: &'a [E],
    output: &'a mut Output<E>,
}

impl<T: OnLanes, E: Kernels> Kernel<E> for SideBySide<'_, T, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let Output { P, K } = self.output;
        let mut at = 0;
        while at < POINTS {
            let mut F = [[R::splat(0.0); 3]; 3];
            for k in 0..9 {
                F[k / 3][k % 3] = R::load(&self.F[Layout::Lines.index::<E>(at, 9, k)..]);
            }
            let (stress, tangent) = self.method.evaluate(&F);
            for k in 0..9 {
                stress[k / 3][k % 3].store(&mut P[Layout::Lines.index::<E>(at, 9, k)..]);
            }
            for k in 0..81 {
                tangent[k / 9][k % 9].store(&mut K[Layout::Lines.index::<E>(at, 81, k)..]);
            }
            at += R::LANES;
        }
    }
}
