//! One point a call: printed C compared with [`evaluate_dense`] of the same energies, in nanoseconds.
//!
//! `cargo bench -p piola-speed --features report --bench emitted`; CC and CFLAGS choose the compiler of C.
//! Both sides evaluate the same deformation gradients in the same order, in turns, of which the least and the
//! median are shown.

#![expect(non_snake_case, reason = "F as in the literature")]
#![expect(clippy::print_stdout, reason = "a table to show")]

use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use piola::material::Response;
use piola::point::{Filter, Matrix3, evaluate_dense};
use piola::{Inversion, Material};
use piola_declare::emit::{Emission, PointFunction, Target};
use piola_materials::{NeoHookean, StVenantKirchhoff};
use piola_speed::{LAMBDA, MU, Times, deformation_gradients, ogden, processor};
use piola_tests::energies::find;

const POINTS: usize = 1024;
const TURNS: usize = 40;
/// Sweeps over all points in a turn.
const SWEEPS: usize = 4;

/// Prints the nanoseconds for each point of a turn, of the tangent and of the projected one.
const PROGRAM: &str = include_str!("emitted.c");

fn main() -> Result<(), Box<dyn Error>> {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let flags =
        std::env::var("CFLAGS").unwrap_or_else(|_| "-std=c99 -O3 -march=native -ffp-contract=off".to_owned());
    println!("{}, {compiler} {flags}: ns a point, least (median)\n", processor());
    println!("| | evaluate_dense | C | ratio of the least |\n|---|---|---|---|");
    let tool = (compiler.as_str(), flags.as_str());
    let ogden = ogden();
    let powers = [vec![0.63, 0.0012, -0.01], vec![1.3, 5.0, -2.0], vec![LAMBDA]];
    row("neo_hookean", &NeoHookean::new(MU, LAMBDA)?, &[vec![MU], vec![LAMBDA]], tool)?;
    row("st_venant_kirchhoff", &StVenantKirchhoff::new(MU, LAMBDA)?, &[vec![MU], vec![LAMBDA]], tool)?;
    row("ogden", &ogden, &powers, tool)
}

/// Two rows of the table: without a filter and projected.
fn row(
    name: &str,
    material: &impl Material,
    values: &[Vec<f64>],
    (compiler, flags): (&str, &str),
) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let points: Vec<Matrix3<f64>> = deformation_gradients().take(POINTS).collect();
    let numbers = points.as_flattened().as_flattened();
    let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_ne_bytes()).collect();
    std::fs::write(folder.path().join("points"), bytes)?;
    let functions = vec![PointFunction::Tangent, PointFunction::Projected];
    let emission = Emission { prefix: Some("energy".into()), functions, ..Emission::new(Target::C) };
    let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
    let energy = &find(name).ok_or("not in the catalogue")?.energy;
    std::fs::write(folder.path().join("energy.h"), energy.emit(&values, Inversion::Refuse, &emission)?)?;
    let program = PROGRAM.replace("POINTS", &POINTS.to_string()).replace("SWEEPS", &SWEEPS.to_string());
    std::fs::write(folder.path().join("main.c"), program)?;
    let compiled = Command::new(compiler)
        .args(flags.split_ascii_whitespace())
        .args(["main.c", "-lm", "-o", "main"])
        .current_dir(folder.path())
        .output()?;
    if !compiled.status.success() {
        return Err(String::from_utf8_lossy(&compiled.stderr).into());
    }

    let works = [("P + 81", Filter::None), ("projected", Filter::Clamp)];
    for (k, (work, filter)) in works.into_iter().enumerate() {
        let (mut ours, mut theirs) = (Vec::new(), Vec::new());
        for _ in 0..TURNS {
            ours.push(turn(material, &points, filter));
            theirs.extend(turns_in_c(folder.path())?.into_iter().skip(k).step_by(works.len()));
        }
        let [ours, theirs] = [ours, theirs].map(Times::of);
        let cell = |times: Times| format!("{:.0} ({:.0})", times.least, times.median);
        let ratio = theirs.least / ours.least;
        println!("| {name}, {work} | {} | {} | {ratio:.2} |", cell(ours), cell(theirs));
    }
    Ok(())
}

fn turn(material: &impl Material, points: &[Matrix3<f64>], filter: Filter) -> f64 {
    let start = Instant::now();
    for _ in 0..SWEEPS {
        for F in points {
            black_box(dense(material, black_box(F), filter));
        }
    }
    start.elapsed().as_secs_f64() * 1e9 / (POINTS * SWEEPS) as f64
}

#[inline(never)]
fn dense(material: &impl Response<f64>, F: &Matrix3<f64>, filter: Filter) -> piola::point::DensePoint<f64> {
    evaluate_dense(material, F, filter)
}

fn turns_in_c(folder: &Path) -> Result<Vec<f64>, Box<dyn Error>> {
    let output = Command::new(folder.join("main")).current_dir(folder).output()?;
    let text = String::from_utf8(output.stdout)?;
    Ok(text.split_ascii_whitespace().map(str::parse).collect::<Result<_, _>>()?)
}
