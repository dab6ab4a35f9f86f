//! Functions of a point, at many points: a judge compares the bytes.

use crate::device::Device;
use crate::{Error, PREFIX};

/// The functions with the names and lengths of what they compute, in the order of the results.
const FUNCTIONS: [Function; 7] = [
    ("energy", &[("psi", 1)]),
    ("stress", &[("P", 9)]),
    ("tangent", &[("P", 9), ("A", 81)]),
    ("projected", &[("P", 9), ("A", 81)]),
    ("absolute", &[("P", 9), ("A", 81)]),
    ("svd", &[("U", 9), ("l", 3), ("V", 9)]),
    ("blocks", &[("blocks", 15)]),
];

/// A function with what it computes.
type Function = (&'static str, &'static [(&'static str, usize)]);

/// Words of the results at a point: what each function computes, and its status.
fn words(functions: &[Function]) -> usize {
    let numbers = functions.iter().flat_map(|(_, outputs)| *outputs).map(|(_, count)| count);
    numbers.sum::<usize>() + functions.len()
}

/// Offset of the stretches that `blocks` takes.
const STRETCHES: usize = 285 + 9;

/// The program for an energy: its own text, and an entry point for each function.
fn shader(energy: &str, functions: &[Function], has_parameters: bool) -> String {
    let words = words(functions);
    let (field, parameters) = match has_parameters {
        true => (format!("parameters: {PREFIX}_parameters, "), "points[id.x].parameters".to_owned()),
        false => (String::new(), format!("{PREFIX}_example()")),
    };
    let mut text = format!(
        "{energy}
struct Point {{ {field}F: array<f32, 9> }}
@group(0) @binding(0) var<storage, read> points: array<Point>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(1)
fn check() {{
    results[0] = {PREFIX}_check({PREFIX}_example());
}}
"
    );
    let mut offset = 0;
    for &(function, outputs) in functions {
        let (input, count, source) = match function {
            "blocks" => ("l", 3, format!("bitcast<f32>(results[at + {STRETCHES}u + k])")),
            _ => ("F", 9, "points[id.x].F[k]".to_owned()),
        };
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
    let at = {words}u * id.x;
    var {input}: array<f32, {count}>;
    for (var k = 0u; k < {count}u; k++) {{ {input}[k] = {source}; }}
{declared}    results[at + {}u] = {PREFIX}_{function}({parameters}, {input}{arguments});
{stored}}}
",
            offset
        );
        offset += 1;
    }
    text
}

/// Results at deformation gradients, nine numbers each: of all functions, with the parameters of the text.
/// With a count of points each F has its parameters before it, and the results are those of the first four
/// functions.
///
/// # Errors
/// The device does not compile the text, or the points are too many for it; the parameters are refused.
pub fn results(
    device: &Device,
    energy: &str,
    points: &[f32],
    count: Option<usize>,
) -> Result<Vec<u32>, Error> {
    let functions = if count.is_some() { &FUNCTIONS[..4] } else { &FUNCTIONS[..] };
    let names: Vec<_> = functions.iter().map(|(function, _)| format!("at_{function}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).chain(["check"]).collect();
    let programs = device.programs(&shader(energy, functions, count.is_some()), &names)?;
    let count = count.unwrap_or(points.len() / 9);
    let bytes = (4 * words(functions) * count) as u64;
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
