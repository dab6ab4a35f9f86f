//! Batches: many points at once, on the memory of the caller.

use piola::point::measures;

use crate::functions::functions;
use crate::lent;
use crate::material::Material;
use crate::options::Survey;

/// A measure of stress with the tangent that belongs to it.
///
/// Symmetric tensors are six numbers, 11, 22, 33, 23, 13, 12; tangents 36, row by row, which act on strains
/// with doubled shears.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum Measure {
    /// The second Piola-Kirchhoff stress S and dS/dE.
    SecondPiola = 0,
    /// The Kirchhoff stress and the tangent of its Lie derivative.
    Kirchhoff = 1,
    /// The Cauchy stress and the spatial tangent of its Truesdell rate.
    Cauchy = 2,
    /// The Cauchy stress and the tangent of the Jaumann rate of the Kirchhoff stress by deformed volume,
    /// which is DDSDDE of Abaqus except for the order: number I there is number {0, 1, 2, 5, 4, 3}[I] here.
    Jaumann = 3,
    /// The Cauchy stress and the tangent of the Green-Naghdi rate of the Kirchhoff stress by deformed volume.
    GreenNaghdi = 4,
}

functions! {
    E = f64, f32: " in single precision.";

/// Energy densities, Pa, of deformation gradients F, nine numbers each, row by row: one number for each
/// point.
fn piola_energies, piola_energies_f32(
    material: &Material,
    options: Options,
    F: &[E],
    energies: &mut [E],
    survey: Out<Survey>,
) {
    survey.write(options.batch(material)?.energies(F, energies)?.into())
}

/// First Piola stresses P, Pa: nine numbers for each F, row by row.
fn piola_stresses, piola_stresses_f32(
    material: &Material,
    options: Options,
    F: &[E],
    P: &mut [E],
    survey: Out<Survey>,
) {
    survey.write(options.batch(material)?.stresses(F, P)?.into())
}

/// Stresses P, Pa, and filtered tangents dP/dF, Pa: 81 numbers for each point, row 3i+j for entry (i, j) of
/// P, column 3k+l for entry (k, l) of F.
fn piola_tangents, piola_tangents_f32(
    material: &Material,
    options: Options,
    F: &[E],
    P: &mut [E],
    dP_dF: &mut [E],
    survey: Out<Survey>,
) {
    survey.write(options.batch(material)?.tangents(F, P, dP_dF)?.into())
}

/// Stresses in one of the measures of `piola_measure`, Pa, six numbers for each F. Their tangents, Pa, 36
/// numbers for each F and without a filter, are computed if there is an array for them: `tangents` may be
/// null, with a length of 0.
///
/// A point is nonfinite if its stress is, such as the Cauchy stress for a singular F.
fn piola_stresses_in, piola_stresses_in_f32(
    material: &Material,
    options: Options,
    measure: i32,
    F: &[E],
    stresses: &mut [E],
    tangents: &mut [E],
    survey: Out<Survey>,
) {
    let batch = options.batch(material)?;
    let measure = lent::choice("measure", measure, measures::Measure::ALL)?;
    let found = match tangents {
        [] => batch.measured_stresses(measure, F, stresses),
        _ => batch.measured_tangents(measure, F, stresses, tangents),
    };
    survey.write(found?.into())
}
}
