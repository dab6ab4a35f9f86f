//! Functions of a point, at many points: a judge compares the bytes.

use crate::device::Device;
use crate::{Error, PREFIX};

/// The functions with their outputs, in the order of the results.
const FUNCTIONS: [(&str, &[&str]); 4] =
    [("energy", &["psi"]), ("stress", &["P"]), ("tangent", &["P", "A"]), ("projected", &["P", "A"])];

/// Words of the results at a point: the outputs of each function, and its status.
const WORDS: usize = (1 + 1) + (9 + 1) + 2 * (9 + 81 + 1);

/// The program for an energy: its own text, and an entry point for each function.
fn shader(energy: &str) -> String {
    let mut text = format!(
        "{energy}
struct Point {{ parameters: {PREFIX}_parameters, F: array<f32, 9> }}
@group(0) @binding(0) var<storage, read> points: array<Point>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(1)
fn check() {{
    results[0] = {PREFIX}_check(points[0].parameters);
}}
"
    );
    let mut offset = 0;
    for (function, outputs) in FUNCTIONS {
        let mut stored = String::new();
        for &name in outputs {
            let (count, value) = match name {
                "psi" => (1, "psi"),
                "P" => (9, "P[k]"),
                _ => (81, "A[k]"),
            };
            stored += &format!(
                "    for (var k = 0u; k < {count}u; k++) {{ results[at + {offset}u + k] = bitcast<u32>({value}); }}\n"
            );
            offset += count;
        }
        text += &format!(
            "
@compute @workgroup_size(64)
fn at_{function}(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&points) {{ return; }}
    let at = {WORDS}u * id.x;
    var F: array<f32, 9>;
    for (var k = 0u; k < 9u; k++) {{ F[k] = points[id.x].F[k]; }}
    var psi: f32;
    var P: array<f32, 9>;
    var A: array<f32, 81>;
    results[at + {offset}u] = {PREFIX}_{function}(points[id.x].parameters, F, &{});
{stored}}}
",
            outputs.join(", &")
        );
        offset += 1;
    }
    text
}

/// Results of the functions at `count` points: the parameters of each, and its deformation gradient, nine
/// numbers.
///
/// # Errors
/// The device does not compile the text, or the points are too many for it; the parameters are refused.
pub fn results(device: &Device, energy: &str, points: &[f32], count: usize) -> Result<Vec<u32>, Error> {
    let names = FUNCTIONS.map(|(function, _)| format!("at_{function}"));
    let names: Vec<&str> = names.iter().map(String::as_str).chain(["check"]).collect();
    let programs = device.programs(&shader(energy), &names)?;
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
