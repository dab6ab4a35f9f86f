//! Functions of a point, at many points: a judge compares the bytes.

use crate::device::Device;
use crate::{Error, PREFIX};

/// The functions with the names and lengths of what they compute, in the order of the results.
const FUNCTIONS: [(&str, &[(&str, usize)]); 4] = [
    ("energy", &[("psi", 1)]),
    ("stress", &[("P", 9)]),
    ("tangent", &[("P", 9), ("A", 81)]),
    ("projected", &[("P", 9), ("A", 81)]),
];

/// Words of the results at a point: what each function computes, and its status.
const WORDS: usize = 1 + 9 + 2 * (9 + 81) + FUNCTIONS.len();

/// The program for an energy: its own text, and an entry point for each function.
fn shader(energy: &str) -> String {
    let mut text = format!(
        "{energy}
struct Point {{ parameters: {PREFIX}_parameters, F: array<f32, 9> }}
@group(0) @binding(0) var<storage, read> points: array<Point>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(1)
fn check() {{
    results[0] = {PREFIX}_check({PREFIX}_example());
}}
"
    );
    let mut offset = 0;
    for (function, outputs) in FUNCTIONS {
        let (mut declared, mut stored, mut arguments) = (String::new(), String::new(), String::new());
        for &(name, count) in outputs {
            let (kind, value) = match count {
                1 => ("f32".to_owned(), name.to_owned()),
                _ => (format!("array<f32, {count}>"), format!("{name}[k]")),
            };
            declared += &format!("    var {name}: {kind};\n");
            arguments += &format!(", &{name}");
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
{declared}    results[at + {offset}u] = {PREFIX}_{function}(points[id.x].parameters, F{arguments});
{stored}}}
"
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
    let group = |program, takes_points: bool| {
        device.bind(program, &[takes_points.then_some(&points), Some(&results)])
    };
    let (check, programs) = programs.split_last().ok_or("no program")?;
    device.run([(check, &group(check, false), 1)])?;
    let refused = device.read::<u32>(&results)?[0];
    if refused != 0 {
        return Err(format!("the parameters are refused: {PREFIX}_check returns {refused}").into());
    }
    let groups: Vec<_> = programs.iter().map(|program| group(program, true)).collect();
    let workgroups = count.div_ceil(64) as u32;
    device.run(programs.iter().zip(&groups).map(|(program, group)| (program, group, workgroups)))?;
    device.read(&results)
}
