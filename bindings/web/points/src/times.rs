//! Time of a point on every back end, compared with points one by one.

use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

use piola::batch::{Batch, TileMaterial};
use piola::lanes::Backend;
use piola::material::Response;
use piola::point::{self, Filter};
use piola_materials::{NeoHookean, Ogden};

/// Points of a call, and calls of which the fastest counts.
const POINTS: usize = 4096;
const REPEATS: usize = 60;

pub(crate) fn write(to: &mut impl Write) -> Result<(), Box<dyn Error>> {
    writeln!(to, "ns a point for P and 81 entries of dP/dF")?;
    let neo_hookean = NeoHookean::new(1e5, 4e5)?;
    let ogden = Ogden::new([6e5, 1e3], [1.3, 5.0], 1e6)?;
    write_of(to, "neo-Hookean by invariants", &neo_hookean, Filter::None)?;
    write_of(to, "neo-Hookean, clamped", &neo_hookean, Filter::Clamp)?;
    write_of(to, "Ogden with two terms", &ogden, Filter::None)?;
    Ok(())
}

fn write_of<M: TileMaterial<f64> + Response<f64>>(
    to: &mut impl Write,
    name: &str,
    material: &M,
    filter: Filter,
) -> std::io::Result<()> {
    // Rotated, stretched and sheared, no two alike.
    let wave = |point: usize, k: usize| 0.3 * f64::sin(1.0 + (point * 9 + k) as f64);
    let entries = (0..9 * POINTS).map(|at| wave(at / 9, at % 9) + if at % 9 % 4 == 0 { 1.0 } else { 0.0 });
    let deformations: Vec<f64> = entries.collect();
    let (mut stress, mut tangent) = (vec![0.0; 9 * POINTS], vec![0.0; 81 * POINTS]);
    let one_by_one = least(|| {
        for (at, out) in deformations.chunks_exact(9).zip(tangent.chunks_exact_mut(81)) {
            let matrix = std::array::from_fn(|i| std::array::from_fn(|j| at[3 * i + j]));
            let answer = point::evaluate(material, &black_box(matrix), filter);
            for (out, row) in out.chunks_exact_mut(9).zip(answer.tangent.to_matrix()) {
                out.copy_from_slice(&row);
            }
        }
    });
    write!(to, "{name:26} one by one {one_by_one:6.0}")?;
    for backend in Backend::available() {
        let batch = Batch::new(material).with_filter(filter).with_backend(backend);
        // The lengths fit together.
        let time = least(|| {
            let _ = batch.tangents(black_box(&deformations), &mut stress, &mut tangent);
        });
        write!(to, "  {backend} {time:6.0}")?;
    }
    writeln!(to)
}

/// Nanoseconds a point in the fastest of many calls.
fn least(mut call: impl FnMut()) -> f64 {
    let time = || {
        let start = Instant::now();
        call();
        start.elapsed().as_secs_f64()
    };
    std::iter::repeat_with(time).take(REPEATS).fold(f64::INFINITY, f64::min) * 1e9 / POINTS as f64
}
