//! Batches: many points at once, on the memory of the caller.

use piola::batch::Batch;
use piola::point::measures;

use crate::error::{Code, Failure, guard};
use crate::lent::{self, Arrays};
use crate::material::{Material, Precision};
use crate::options::{self, Options, Survey};
use crate::twins::twins;

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

twins!(
    E = f64, f32: " in single precision.";

/// Energy densities, Pa, of deformation gradients F, nine numbers each, row by row: one number for each
/// point.
fn piola_energies, piola_energies_f32(
    material: *const Material,
    options: *const Options,
    F: *const E,
    F_length: usize,
    energies: *mut E,
    energies_length: usize,
    survey: *mut Survey,
) {
    let (inputs, outputs) = ([("F", F, F_length)], [("energies", energies, energies_length)]);
    // SAFETY: the requirements of the header on its caller.
    unsafe {
        call(material, options, inputs, outputs, survey, |batch, [F], [energies]| {
            Ok(batch.energies(F, energies)?)
        })
    }
}

/// First Piola stresses P, Pa: nine numbers for each F, row by row.
fn piola_stresses, piola_stresses_f32(
    material: *const Material,
    options: *const Options,
    F: *const E,
    F_length: usize,
    P: *mut E,
    P_length: usize,
    survey: *mut Survey,
) {
    let (inputs, outputs) = ([("F", F, F_length)], [("P", P, P_length)]);
    // SAFETY: the requirements of the header on its caller.
    unsafe { call(material, options, inputs, outputs, survey, |batch, [F], [P]| Ok(batch.stresses(F, P)?)) }
}

/// Stresses P, Pa, and filtered tangents dP/dF, Pa: 81 numbers for each point, row 3i+j for entry (i, j) of
/// P, column 3k+l for entry (k, l) of F.
fn piola_tangents, piola_tangents_f32(
    material: *const Material,
    options: *const Options,
    F: *const E,
    F_length: usize,
    P: *mut E,
    P_length: usize,
    dP_dF: *mut E,
    dP_dF_length: usize,
    survey: *mut Survey,
) {
    let (inputs, outputs) = ([("F", F, F_length)], [("P", P, P_length), ("dP_dF", dP_dF, dP_dF_length)]);
    // SAFETY: the requirements of the header on its caller.
    unsafe {
        call(material, options, inputs, outputs, survey, |batch, [F], [P, dP_dF]| {
            Ok(batch.tangents(F, P, dP_dF)?)
        })
    }
}

/// Energy densities, stresses and tangents: `piola_energies` and `piola_tangents` with one decomposition of
/// each F.
fn piola_energies_and_tangents, piola_energies_and_tangents_f32(
    material: *const Material,
    options: *const Options,
    F: *const E,
    F_length: usize,
    energies: *mut E,
    energies_length: usize,
    P: *mut E,
    P_length: usize,
    dP_dF: *mut E,
    dP_dF_length: usize,
    survey: *mut Survey,
) {
    let (inputs, outputs) = (
        [("F", F, F_length)],
        [("energies", energies, energies_length), ("P", P, P_length), ("dP_dF", dP_dF, dP_dF_length)],
    );
    // SAFETY: the requirements of the header on its caller.
    unsafe {
        call(material, options, inputs, outputs, survey, |batch, [F], [energies, P, dP_dF]| {
            Ok(batch.energies_and_tangents(F, energies, P, dP_dF)?)
        })
    }
}

/// Stresses in one of the measures of `piola_measure`, Pa, six numbers for each F. Their tangents, Pa, 36
/// numbers for each F and without a filter, are computed if there is an array for them: `tangents` may be
/// null, with a length of 0.
///
/// A point is nonfinite if its stress is, such as the Cauchy stress for a singular F.
fn piola_stresses_in, piola_stresses_in_f32(
    material: *const Material,
    options: *const Options,
    measure: i32,
    F: *const E,
    F_length: usize,
    stresses: *mut E,
    stresses_length: usize,
    tangents: *mut E,
    tangents_length: usize,
    survey: *mut Survey,
) {
    let (inputs, outputs) = (
        [("F", F, F_length)],
        [("stresses", stresses, stresses_length), ("tangents", tangents, tangents_length)],
    );
    // SAFETY: the requirements of the header on its caller.
    unsafe {
        call(material, options, inputs, outputs, survey, |batch, [F], [stresses, tangents]| {
            let measure = lent::choice("measure", measure, measures::Measure::ALL)?;
            Ok(match tangents {
                [] => batch.measured_stresses(measure, F, stresses),
                _ => batch.measured_tangents(measure, F, stresses, tangents),
            }?)
        })
    }
}
);

/// Runs a batch on borrowed arrays.
///
/// # Safety
/// Pointers are null or point to what the header requires, and arrays are as long as stated.
#[inline]
pub(crate) unsafe fn call<E: Precision, const I: usize, const O: usize>(
    material: *const Material,
    options: *const Options,
    inputs: [(&'static str, *const E, usize); I],
    outputs: [(&'static str, *mut E, usize); O],
    survey: *mut Survey,
    compute: impl FnOnce(Batch<'_, E>, [&[E]; I], [&mut [E]; O]) -> Result<piola::Survey, Failure>,
) -> Code {
    // SAFETY: that of this function.
    guard(|| unsafe { call_with(Arrays::new(), material, options, inputs, outputs, survey, compute) })
}

/// Runs [`call`] next to other arrays that have been borrowed already.
///
/// # Safety
/// As for [`call`].
#[inline]
pub(crate) unsafe fn call_with<E: Precision, const I: usize, const O: usize>(
    mut arrays: Arrays<'_>,
    material: *const Material,
    options: *const Options,
    inputs: [(&'static str, *const E, usize); I],
    outputs: [(&'static str, *mut E, usize); O],
    survey: *mut Survey,
    compute: impl FnOnce(Batch<'_, E>, [&[E]; I], [&mut [E]; O]) -> Result<piola::Survey, Failure>,
) -> Result<(), Failure> {
    let mut read: [&[E]; I] = [&[]; I];
    let mut written: [&mut [E]; O] = std::array::from_fn(|_| &mut [][..]);
    // SAFETY: that of this function.
    unsafe {
        let material = lent::value("material", material)?;
        let batch = options::batch(options, material, &mut arrays)?;
        for (read, (name, data, length)) in read.iter_mut().zip(inputs) {
            *read = arrays.input(name, data, length)?;
        }
        for (written, (name, data, length)) in written.iter_mut().zip(outputs) {
            *written = arrays.output(name, data, length)?;
        }
        lent::report("survey", survey, compute(batch, read, written)?.into())
    }
}
