//! The time that `clients/overhead.c` measures, without the border: the energy of one point, ns.

use std::hint::black_box;
use std::time::Instant;

use piola::batch::Batch;
use piola_scenes::material::MaterialSpec;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spec = MaterialSpec::new("neo_hookean").with_parameter("mu", [1e6]).with_parameter("lambda", [4e6]);
    let material = spec.with_inversion(piola::Inversion::Refuse).build()?.elements;
    let shear = [1.0, 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        const CALLS: u32 = 10_000;
        let start = Instant::now();
        for _ in 0..CALLS {
            let mut energy = [0.0];
            black_box(Batch::new(black_box(&*material)).energies(black_box(&shear), &mut energy)?);
            black_box(energy);
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS));
    }
    #[expect(clippy::print_stdout, reason = "its result")]
    {
        println!("{best:.1}");
    }
    Ok(())
}
