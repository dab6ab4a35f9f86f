//! Properties of the materials of many points together, for batches.

use super::{Curvature, Material};

/// Properties of the materials of many points that do not depend on the deformation.
#[derive(Clone, Copy, Debug)]
pub struct Properties {
    /// True if ψ is a function of I1, I2 and J alone: [`Material::has_invariants`].
    pub(crate) has_invariants: bool,
    /// True if ψ by invariants depends on I2: [`Material::has_second_invariant`].
    pub(crate) has_second_invariant: bool,
    /// Second derivatives of ψ by invariants that do not vanish: [`Material::curvature_by_invariants`].
    pub(crate) curvature: Curvature,
    /// True if ψ is computed from the invariants too: [`Material::has_energy_by_invariants`].
    pub(crate) has_energy_by_invariants: bool,
    /// True if a twist of any of the materials has a pole: [`Material::has_pole`].
    pub(crate) has_pole: bool,
    /// True if the domain of any of the materials ends at J = 0: [`Material::ends_at_zero_volume`].
    pub(crate) ends_at_zero_volume: bool,
    /// Number of points with a material of their own; `None` if one material is used for any number of
    /// points.
    pub points: Option<usize>,
}

impl Properties {
    /// Combines the properties of `materials`. `points` is the number of points if each has a material of its
    /// own.
    pub(crate) fn of<M: Material>(materials: &[M], points: Option<usize>) -> Self {
        let curvatures = materials.iter().map(Material::curvature_by_invariants);
        Self {
            has_invariants: materials.iter().all(Material::has_invariants),
            has_second_invariant: materials.iter().any(Material::has_second_invariant),
            curvature: curvatures.reduce(Curvature::and).unwrap_or(Curvature::All),
            has_energy_by_invariants: materials.iter().all(Material::has_energy_by_invariants),
            has_pole: materials.iter().any(Material::has_pole),
            ends_at_zero_volume: materials.iter().any(Material::ends_at_zero_volume),
            points,
        }
    }
}
