//! One point a call in printed C, which CC compiles with CFLAGS.

use std::process::Command;

use piola::Inversion;
use piola_declare::emit::{Emission, PointFunction, Target};
use piola_speed::{IN_CACHE, Times, deformation_gradients};
use piola_tests::energies::find;

use crate::Outcome;

/// Sweeps over all points in a turn.
const SWEEPS: usize = 32;

/// Prints the nanoseconds for each point of a turn, of the tangent and of the projected one.
const PROGRAM: &str = r#"
#define _POSIX_C_SOURCE 199309L
#include "energy.h"
#include <stdio.h>
#include <time.h>
static double F[POINTS][9];
#define SWEEP(function) do { \
    struct timespec start, end; \
    double sum = 0; \
    clock_gettime(CLOCK_MONOTONIC, &start); \
    for (int sweep = 0; sweep < SWEEPS; sweep++) \
        for (int k = 0; k < POINTS; k++) { \
            double P[9], A[81]; \
            const unsigned status = function(&p, F[k], P, A); \
            sum += P[0] + A[80] + status; \
        } \
    clock_gettime(CLOCK_MONOTONIC, &end); \
    printf("%.17g ", ((double)(end.tv_sec - start.tv_sec) * 1e9 + (double)(end.tv_nsec - start.tv_nsec)) / POINTS / SWEEPS); \
    fprintf(stderr, "%g", sum); \
} while (0)
static __attribute__((noinline)) unsigned tangent(const energy_parameters *p, const double *F, double *P, double *A) {
    return energy_tangent(p, F, P, A);
}
static __attribute__((noinline)) unsigned projected(const energy_parameters *p, const double *F, double *P, double *A) {
    return energy_projected(p, F, P, A);
}
int main(void) {
    const energy_parameters p = ENERGY_EXAMPLE;
    FILE *points = fopen("points", "rb");
    if (!points || fread(F, sizeof F, 1, points) != 1) return 1;
    for (int turn = 0; turn < 3; turn++) {
        SWEEP(tangent);
        SWEEP(projected);
    }
    return 0;
}
"#;

/// The compiler, and the times of P with dP/dF and of P with its projection, over three turns in each run.
pub(crate) fn times(name: &str, values: &[&[f64]], runs: usize) -> Outcome<(String, [Times; 2])> {
    let variable = |name: &str, default: &str| std::env::var(name).unwrap_or_else(|_| default.to_owned());
    let compiler = variable("CC", "cc");
    let flags = variable("CFLAGS", "-std=c99 -O3 -march=native -ffp-contract=off");
    let folder = tempfile::tempdir()?;
    let write = |name: &str, content: &[u8]| std::fs::write(folder.path().join(name), content);
    let points: Vec<_> = deformation_gradients().take(IN_CACHE).collect();
    let numbers = points.as_flattened().as_flattened();
    write("points", &numbers.iter().flat_map(|x| x.to_ne_bytes()).collect::<Vec<_>>())?;
    let functions = vec![PointFunction::Tangent, PointFunction::Projected];
    let emission = Emission { prefix: Some("energy".into()), functions, ..Emission::new(Target::C) };
    let energy = &find(name).ok_or("not in the catalogue")?.energy;
    write("energy.h", energy.emit(values, Inversion::Refuse, &emission)?.as_bytes())?;
    let program = PROGRAM.replace("POINTS", &IN_CACHE.to_string()).replace("SWEEPS", &SWEEPS.to_string());
    write("main.c", program.as_bytes())?;

    let run = |command: &mut Command| -> Outcome<String> {
        let output = command.current_dir(folder.path()).output()?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        Ok(String::from_utf8(output.stdout)?)
    };
    let arguments = flags.split_ascii_whitespace().chain(["main.c", "-lm", "-o", "main"]);
    run(Command::new(&compiler).args(arguments))?;
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..runs {
        let text = run(&mut Command::new(folder.path().join("main")))?;
        for (k, number) in text.split_ascii_whitespace().enumerate() {
            times[k % 2].push(number.parse::<f64>()?);
        }
    }
    Ok((format!("C, `{compiler} {flags}`"), times.map(Times::of)))
}
