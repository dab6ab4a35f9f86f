//! Functions of a point, at many points: a judge compares the bytes.

use crate::device::Device;
use crate::{Error, PREFIX};

/// Entry points of `points.wgsl`, the check of the parameters last.
const ENTRIES: [&str; 5] = ["at_energy", "at_stress", "at_tangent", "at_projected", "check"];

/// Words of the results at a point: the outputs of each function, and its status.
const WORDS: usize = (1 + 1) + (9 + 1) + 2 * (9 + 81 + 1);

/// Results of the functions at `count` points: the parameters of each, and its deformation gradient, nine
/// numbers.
///
/// # Errors
/// The device does not compile the text, or the points are too many for it; the parameters are refused.
pub fn results(device: &Device, energy: &str, points: &[f32], count: usize) -> Result<Vec<u32>, Error> {
    let programs = device.programs(&[energy, include_str!("points.wgsl")].join("\n"), &ENTRIES)?;
    let bytes = (4 * WORDS * count) as u64;
    if count == 0 || bytes > device.limits.max_storage_buffer_binding_size {
        return Err(format!("{count} points: there must be some, and room for {bytes} bytes").into());
    }
    let (points, results) = (device.filled(points), device.empty(bytes));
    let groups: Vec<_> = programs.iter().map(|program| device.bind(program, &[&points, &results])).collect();
    let workgroups = count.div_ceil(64) as u32;
    let mut calls: Vec<_> =
        programs.iter().zip(&groups).map(|(program, group)| (program, group, workgroups)).collect();
    device.run(calls.pop().map(|(program, group, _)| (program, group, 1)))?;
    let refused = device.read::<u32>(&results)?[0];
    if refused != 0 {
        return Err(format!("the parameters are refused: {PREFIX}_check returns {refused}").into());
    }
    device.run(calls)?;
    device.read(&results)
}
