//! A million tetrahedra in a compute shader, and a judge of emitted WGSL.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

use std::process::ExitCode;

use piola::Inversion;
use piola_declare::Energy;
use piola_declare::emit::{Emission, PointFunction, Precision, Target};
use piola_wgpu::device::{Device, NoAdapter};
use piola_wgpu::tetrahedra::Elements;
use piola_wgpu::{Error, PREFIX, mesh, points};

const USAGE: &str = "usage: piola-wgpu [--cells 200x40x25] [--projected] [FORMULA NAME=V[,V…]…]
       piola-wgpu judge FILE.wgsl POINTS RESULTS COUNT
       piola-wgpu adapter";

const FORMULA: [&str; 3] = ["mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2", "mu=1e6", "lambda=5e6"];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments[..] {
        ["adapter"] => Device::open().map(|device| println!("{}", device.name)),
        ["judge", energy, points, results, count] => judge(energy, points, results, count),
        _ => bar(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(if error.is::<NoAdapter>() { 3 } else { 1 })
        }
    }
}

fn judge(energy: &str, from: &str, to: &str, count: &str) -> Result<(), Error> {
    let device = Device::open()?;
    let numbers: Vec<f32> = bytemuck::pod_collect_to_vec(&std::fs::read(from)?);
    let results = points::results(&device, &std::fs::read_to_string(energy)?, &numbers, count.parse()?)?;
    Ok(std::fs::write(to, bytemuck::cast_slice(&results))?)
}

fn bar(arguments: &[&str]) -> Result<(), Error> {
    let mut cells = [200, 40, 25];
    let mut function = PointFunction::Tetrahedron;
    let mut words = Vec::new();
    let mut arguments = arguments.iter();
    while let Some(&argument) = arguments.next() {
        match argument {
            "--cells" => {
                let counts = arguments.next().ok_or(USAGE)?.split('x').map(str::parse);
                cells = counts.collect::<Result<Vec<usize>, _>>()?.try_into().map_err(|_| USAGE)?;
            }
            "--projected" => function = PointFunction::ProjectedTetrahedron,
            word if word.starts_with('-') && word.len() < 16 => return Err(USAGE.into()),
            word => words.push(word),
        }
    }
    if cells.contains(&0) {
        return Err(USAGE.into());
    }
    if words.is_empty() {
        words.extend(FORMULA);
    }
    let energy = Energy::from_formula(words[0])?;
    let values = values(&energy, &words[1..])?;
    let lists: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
    let emission = Emission::new(Target::Wgsl).with_precision(Precision::F32).with_prefix(PREFIX);
    let emission = emission.with_functions([function]);
    let text = energy.emit(&lists, Inversion::Refuse, &emission)?;

    let device = Device::open()?;
    let mesh = mesh::bar(cells);
    let start = std::time::Instant::now();
    let elements = Elements::new(&device, (&text, function.name()), &mesh)?;
    // The first time the driver compiles, and fills memory with zeros.
    elements.compute()?;
    let ready = start.elapsed().as_secs_f64();
    let mut best = elements.compute()?;
    for _ in 0..4 {
        best = best.min(elements.compute()?);
    }
    let (count, seconds) = (mesh.corners.len(), best.as_secs_f64());
    let statuses = elements.statuses()?;
    let of_status = |bit: u32| statuses.iter().filter(|&status| status & bit != 0).count();
    println!("{}", device.name);
    println!("{count} tetrahedra, ready after {ready:.1} s");
    println!("{:.2} ms, {:.1} ns each", 1e3 * seconds, 1e9 * seconds / count as f64);
    println!("{:.2} GB/s written", (count * 4 * (12 + 144 + 1)) as f64 / seconds / 1e9);
    println!(
        "{} refused, {} bounded, {} not finite, {} filtered",
        of_status(1),
        of_status(2),
        of_status(4),
        of_status(8)
    );
    Ok(())
}

/// A list for each parameter of an energy from words `NAME=V,V`.
fn values(energy: &Energy, words: &[&str]) -> Result<Vec<Vec<f64>>, Error> {
    let given = words.iter().map(|word| {
        let (name, list) = word.split_once('=').ok_or(USAGE)?;
        let list = list.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>();
        Ok((name, list.map_err(|error| format!("{word}: {error}"))?))
    });
    let given = given.collect::<Result<Vec<_>, Error>>()?;
    let names: Vec<&str> = energy.description().parameters.iter().map(|one| &*one.name).collect();
    if let Some((unknown, _)) = given.iter().find(|(name, _)| !names.contains(name)) {
        return Err(format!("there is no parameter {unknown}; there are: {}", names.join(", ")).into());
    }
    let value = |name: &&str| {
        let found = given.iter().rev().find(|(other, _)| other == name);
        found.map(|(_, list)| list.clone()).ok_or_else(|| format!("{name} has no value: add {name}=…").into())
    };
    names.iter().map(value).collect()
}
