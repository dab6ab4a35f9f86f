//! A million tetrahedra in a compute shader, and a judge of emitted WGSL.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

use std::process::ExitCode;

use piola::Inversion;
use piola_declare::Energy;
use piola_declare::emit::{Emission, PointFunction, Target};
use piola_wgpu::device::Device;
use piola_wgpu::tetrahedra::Elements;
use piola_wgpu::{Error, PREFIX, mesh, points};

/// The energy, with the values of its parameters in their order in the formula: replace them by your own.
const FORMULA: &str = "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2";
const PARAMETERS: [&[f64]; 2] = [&[1e6], &[5e6]];

/// Cubes of the bar along each axis, six tetrahedra each.
const CELLS: [usize; 3] = [196, 34, 25];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments[..] {
        [] => bar(),
        ["adapter"] => Device::open().map(|device| println!("{}", device.name)),
        ["judge", energy, points, results, count] => judge(energy, points, results, count),
        _ => Err("usage: piola-wgpu [adapter | judge FILE.wgsl POINTS RESULTS COUNT]".into()),
    };
    if let Err(error) = &result {
        eprintln!("{error}");
    }
    ExitCode::from(u8::from(result.is_err()))
}

fn judge(energy: &str, from: &str, to: &str, count: &str) -> Result<(), Error> {
    let device = Device::open()?;
    let numbers: Vec<f32> = bytemuck::pod_collect_to_vec(&std::fs::read(from)?);
    let results = points::results(&device, &std::fs::read_to_string(energy)?, &numbers, count.parse()?)?;
    Ok(std::fs::write(to, bytemuck::cast_slice(&results))?)
}

fn bar() -> Result<(), Error> {
    let energy = Energy::from_formula(FORMULA)?;
    let device = Device::open()?;
    println!("{}", device.name);
    let mesh = mesh::bar(CELLS)?;
    for function in [PointFunction::Tetrahedron, PointFunction::ProjectedTetrahedron] {
        let (prefix, functions) = (Some(PREFIX.into()), vec![function]);
        let emission = Emission { prefix, functions, ..Emission::new(Target::Wgsl) };
        let text = energy.emit(&PARAMETERS, Inversion::Refuse, &emission)?;
        let start = std::time::Instant::now();
        let elements = Elements::new(&device, (&text, function.name()), &mesh)?;
        // The first time the driver compiles, and fills memory with zeros.
        elements.compute()?;
        let ready = start.elapsed().as_secs_f64();
        let mut best = elements.compute()?;
        for _ in 0..4 {
            best = best.min(elements.compute()?);
        }
        let (count, milliseconds) = (mesh.corners.len(), 1e3 * best.as_secs_f64());
        let statuses = elements.statuses()?;
        let [refused, bounded, not_finite, filtered] =
            [1u32, 2, 4, 8].map(|bit| statuses.iter().filter(|&status| status & bit != 0).count());
        println!("{}: {count} in {milliseconds:.2} ms, ready after {ready:.1} s;", function.name());
        println!("  {refused} refused, {bounded} bounded, {not_finite} not finite, {filtered} filtered");
    }
    Ok(())
}
