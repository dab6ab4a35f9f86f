//! Times of the batch in Rust, ns a point, to compare with those from Python by `times.py`: `cargo bench -p
//! piola-python --bench batch -- POINTS THREADS`.

use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

use piola::Inversion;
use piola::batch::Batch;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let [points, threads] = arguments[..] else { return Err("the number of points, and of threads".into()) };
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let entry = piola_materials::find("neo_hookean").ok_or("not in the catalogue")?;
    let material = entry.material(&[&[0.8], &[4.0]], Inversion::Refuse)?;
    let batch = Batch::new(&*material).with_threads(threads > 1);
    let entry = |k: usize| {
        // A sequence without pattern, from −1 to 1.
        let random = (k as f64 * 0.618_033_988_749_895).fract() * 2.0 - 1.0;
        f64::from(u8::from((k % 9).is_multiple_of(4))) + 0.2 * random
    };
    let deformations: Vec<f64> = (0..9 * points).map(entry).collect();
    let (mut stresses, mut tangents) = (vec![0.0; 9 * points], vec![0.0; 81 * points]);
    let stress = best(points, || batch.stresses(&deformations, &mut stresses).map(drop))?;
    let tangent = best(points, || batch.tangents(&deformations, &mut stresses, &mut tangents).map(drop))?;
    black_box((&stresses, &tangents));
    writeln!(std::io::stdout(), "{stress} {tangent}")?;
    Ok(())
}

/// The shortest time of several calls, ns a point.
fn best<E>(points: usize, mut call: impl FnMut() -> Result<(), E>) -> Result<f64, E> {
    call()?;
    let mut shortest = f64::INFINITY;
    for _ in 0..12 {
        let start = Instant::now();
        call()?;
        shortest = shortest.min(start.elapsed().as_secs_f64());
    }
    Ok(shortest / points as f64 * 1e9)
}
