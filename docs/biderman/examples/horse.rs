//! A horse of Biderman's rubber is flattened into the ground and stands up again.

use std::fs::File;

use biderman::Biderman;
use piola::Inversion;
use piola_bodies::mesh::Bounds;
use piola_bodies::step::{NewtonSettings, Simulation, SimulationSettings};
use piola_bodies::system::{Body, Pins};
use piola_cli::render::{Frame, contact_sheet};
use piola_scenes::geometry::Geometry;
use piola_scenes::scene;

/// Up to here, m, the hooves are held.
const GROUND: f64 = 0.05;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Biderman::new(1.837e5, 3.589e3, -1.938e3, 46.02, 2e7)?
        .with_inversion(Inversion::Extend { epsilon: 0.1 })?;

    let horse = Geometry::of(scene::Body::HORSE)?;
    let hooves = Bounds { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY, GROUND, f64::INFINITY] };
    let hooves = Pins::in_box(&horse.mesh, hooves)?;
    let body = Body::new(&horse.mesh, rubber, 1000.0)?;
    let newton = NewtonSettings::single();
    let settings = SimulationSettings { damping: 2.0, newton, ..Default::default() };
    let mut simulation = Simulation::new(body, &hooves, settings)?;

    // Flat on the ground: nearly every tetrahedron is a sheet without volume.
    let flat: Vec<_> = simulation.positions().iter().map(|&[x, y, z]| [x, y.min(GROUND), z]).collect();
    simulation.set_positions(&flat)?;

    let dt = 1.0 / 60.0;
    let mut frames = Vec::new();
    for number in 0..=300 {
        if [0, 1, 2, 4, 6, 8, 10, 14, 20, 30, 60, 300].contains(&number) {
            let vertices = horse.surface_at(simulation.positions());
            frames.push(Frame { number, time: number as f64 * dt, vertices });
        }
        simulation.step(dt).map_err(|error| format!("step {number}: {error}"))?;
    }

    if let Some(file) = std::env::args().nth(1) {
        contact_sheet(&frames, &horse.triangles, &scene::Body::HORSE.style).write_png(File::create(file)?)?;
    }

    let top = |positions: &[[f64; 3]]| positions.iter().fold(0.0, |top: f64, [_, y, _]| top.max(*y));
    let [now, rest] = [simulation.positions(), simulation.body().rest()].map(top);
    println!("{now:.4} m high again, of {rest:.4} m");
    assert!((now - rest).abs() < 1e-3 * rest, "not back yet, or in another equilibrium");
    Ok(())
}
