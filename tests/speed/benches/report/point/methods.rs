//! The methods, in the order in which they are listed.

#![expect(non_snake_case, reason = "F, P, K, U, V as in the literature")]

use piola::material::Blocks;
use piola::point::{Filter, Matrix3, Svd, Tangent, decompose, evaluate_dense, project, stress, svd};
use piola::{Material, Real};
use piola_baselines::automatic::{self, Potential};
use piola_baselines::clamped::Clamp;
use piola_baselines::direct::{self, DirectEnergy};
use piola_baselines::invariants::{self, InvariantEnergy};
use piola_baselines::quotients::{Changed, Plain, Switch};
use piola_baselines::{coincidences, decompositions, differences, eigen, polar, svd_gradients};
use piola_materials::RotatedLinear;

use super::contestant::{AtPoint, Contestant, Label, Number, OnLanes};

/// The product on lanes.
pub(crate) const OURS: &str = "piola";

/// The product without lanes.
pub(crate) const OURS_AS_A_SCALAR: &str = "piola, point by point";

/// The methods for any energy, given as it is declared and as a potential of hyper-dual numbers.
pub(crate) fn all<E: Number>(
    material: impl Material + Potential + Copy + 'static,
    filter: Filter,
) -> Vec<Contestant<E>> {
    let mut all = vec![
        Contestant::batch(Label::new(OURS), material, filter),
        Contestant::one_by_one(Label::new(OURS_AS_A_SCALAR), Ours { material, filter }),
        Contestant::batch(Label::new("plain quotients"), Changed(material, Plain), filter),
    ];
    for threshold in [1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let label = Label::set("l'Hôpital switch", format_args!("{threshold:e}"));
        all.push(Contestant::batch(label, Changed(material, Switch { threshold }), filter));
    }
    for limit in [0.01, 0.1, 0.5] {
        let label = Label::set("[ITF04]", limit);
        all.push(Contestant::batch(label, Changed(material, Clamp { limit }), filter));
    }
    for epsilon in [1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let label = Label::set("[SZLSB11]", format_args!("{epsilon:e}"));
        all.push(entries(label, SvdGradients { material, epsilon }, filter));
    }
    for threshold in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let label = Label::set("[GKJD09]", format_args!("{threshold:e}"));
        all.push(entries(label, Coincidences { material, threshold }, filter));
    }
    for step in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
        let label = Label::set("finite differences", format_args!("{step:e}"));
        all.push(entries(label, Differences { material, step }, filter));
    }
    all.push(Contestant::one_by_one(Label::new("hyper-dual ψ(λ)"), DualStretches { material, filter }));
    all.push(entries(Label::new("hyper-dual ψ(F)"), DualDecomposition { material }, filter));
    let by_nalgebra = Decomposed { material, filter, decompose: decompositions::nalgebra };
    all.push(Contestant::one_by_one(Label::new("nalgebra SVD"), by_nalgebra));
    let by_faer = Decomposed { material, filter, decompose: decompositions::faer };
    all.push(Contestant::one_by_one(Label::new("faer SVD"), by_faer));
    for sweeps in 2..=7 {
        let label = Label::set("Jacobi SVD", sweeps);
        all.push(Contestant::on_lanes(label, Jacobi { material, filter, sweeps }));
    }
    all
}

/// The same, and the methods for energies that somebody has written in invariants.
pub(crate) fn with_invariants<E: Number>(
    material: impl Material + Potential + InvariantEnergy + DirectEnergy + Copy + 'static,
    filter: Filter,
) -> Vec<Contestant<E>> {
    let mut all = all(material, filter);
    all.push(entries(Label::special("[TSIF05]"), Invariants { material }, filter));
    all.push(without_frames(Label::special("invariants without SVD"), Direct(material), filter));
    if filter == Filter::None {
        let label = Label::special("invariants without SVD, point by point");
        all.push(Contestant::one_by_one(label, Direct(material)));
    }
    all
}

/// The same, and the method for the energy that somebody has written in the polar decomposition.
pub(crate) fn with_polar<E: Number>(material: RotatedLinear, filter: Filter) -> Vec<Contestant<E>> {
    let mut all = all(material, filter);
    all.push(without_frames(Label::special("polar decomposition"), Polar(material), filter));
    all
}

/// A method on lanes that computes the tangent by its entries; a projection takes one point after the other.
fn without_frames<E: Number>(label: Label, method: impl OnLanes + 'static, filter: Filter) -> Contestant<E> {
    if filter == Filter::None { Contestant::on_lanes(label, method) } else { entries(label, method, filter) }
}

/// A method that computes the tangent by its entries: its projection is that of a 9×9 matrix.
fn entries<E: Number>(label: Label, method: impl AtPoint<E> + 'static, filter: Filter) -> Contestant<E> {
    if filter == Filter::None {
        Contestant::one_by_one(label, method)
    } else {
        Contestant::one_by_one(label, Projected(method))
    }
}

struct Projected<T>(T);

impl<T: AtPoint<E>, E: Number> AtPoint<E> for Projected<T> {
    #[inline(always)]
    fn evaluate(&self, F: &Matrix3<E>) -> (Matrix3<E>, [[E; 9]; 9]) {
        let (P, K) = self.0.evaluate(F);
        (P, eigen::clamp(&K).unwrap_or([[Real::splat(f64::NAN); 9]; 9]))
    }
}

/// Declares methods at a point: traits of the material, the setting, and P and dP/dF at F.
macro_rules! at_point {
    ($($Method:ident<M: $Trait:ident $(+ $Other:ident)?> { $($setting:ident: $Setting:ty)? } |$self:ident, $F:ident| $evaluation:block)+) => {$(
        struct $Method<M> {
            material: M,
            $($setting: $Setting,)?
        }

        impl<M: $Trait $(+ $Other)?, E: Number> AtPoint<E> for $Method<M> {
            #[inline(always)]
            fn evaluate(&$self, $F: &Matrix3<E>) -> (Matrix3<E>, [[E; 9]; 9]) $evaluation
        }
    )+};
}

at_point! {
    Ours<M: Material> { filter: Filter } |self, F| {
        let point = evaluate_dense(&self.material, F, self.filter);
        (point.stress, point.tangent)
    }

    SvdGradients<M: Material> { epsilon: f64 } |self, F| {
        let svd = decompose(&self.material, F);
        let K = svd_gradients::tangent(&self.material, &svd, self.epsilon);
        (stress(&svd, self.material.gradient(svd.stretches)), K)
    }

    Coincidences<M: Material> { threshold: f64 } |self, F| {
        let svd = decompose(&self.material, F);
        let K = coincidences::tangent(&self.material, &svd, self.threshold);
        (stress(&svd, self.material.gradient(svd.stretches)), K)
    }

    Differences<M: Material> { step: f64 } |self, F| {
        let P = piola::point::evaluate_stress(&self.material, F).stress;
        (P, differences::tangent(&self.material, F, self.step))
    }

    DualStretches<M: Material + Potential> { filter: Filter } |self, F| {
        let svd = decompose(&self.material, F);
        from_blocks(&svd, automatic::through_stretches(&self.material, &svd), self.filter)
    }

    DualDecomposition<M: Potential> {} |self, F| { automatic::through_decomposition(&self.material, F) }

    Invariants<M: InvariantEnergy> {} |self, F| { invariants::evaluate(&self.material, &svd(F)) }
}

/// Our derivatives after somebody else's decomposition.
struct Decomposed<M, E> {
    material: M,
    filter: Filter,
    decompose: fn(&Matrix3<E>) -> Option<Svd<E>>,
}

impl<M: Material, E: Number> AtPoint<E> for Decomposed<M, E> {
    #[inline(always)]
    fn evaluate(&self, F: &Matrix3<E>) -> (Matrix3<E>, [[E; 9]; 9]) {
        let Some(svd) = (self.decompose)(F) else {
            return ([[Real::splat(f64::NAN); 3]; 3], [[Real::splat(f64::NAN); 9]; 9]);
        };
        from_blocks(&svd, self.material.blocks(svd.stretches), self.filter)
    }
}

struct Jacobi<M> {
    material: M,
    filter: Filter,
    sweeps: usize,
}

impl<M: Material> OnLanes for Jacobi<M> {
    #[inline(always)]
    fn evaluate<R: Real>(&self, F: &Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]) {
        let svd = decompositions::jacobi(F, self.sweeps);
        from_blocks(&svd, self.material.blocks(svd.stretches), self.filter)
    }
}

struct Direct<T>(T);

impl<T: DirectEnergy> OnLanes for Direct<T> {
    #[inline(always)]
    fn evaluate<R: Real>(&self, F: &Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]) {
        direct::evaluate(&self.0, F)
    }
}

struct Polar(RotatedLinear);

impl OnLanes for Polar {
    #[inline(always)]
    fn evaluate<R: Real>(&self, F: &Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]) {
        polar::evaluate(&self.0, F)
    }
}

#[inline(always)]
fn from_blocks<R: Real>(svd: &Svd<R>, blocks: Blocks<R>, filter: Filter) -> (Matrix3<R>, [[R; 9]; 9]) {
    let P = stress(svd, blocks.gradient);
    let (blocks, _) = project(&blocks, filter);
    (P, Tangent { U: svd.U, V: svd.V, blocks }.to_matrix())
}
