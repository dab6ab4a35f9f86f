//! An energy in one line moves a body: a horse of 2646 tetrahedra, flattened onto a plane, stands up again.

mod picture;

use std::time::Instant;

use piola::material;
use piola_bodies::mesh::{Bounds, embed, read_msh, read_surface_obj};
use piola_bodies::step::{NewtonSettings, Simulation, SimulationSettings};
use piola_bodies::system::{Body, Pins};

// The energy density ψ(λ1, λ2, λ3), J/m³; stress and tangent follow from it. Replace it by your own, without
// stress at rest; I1, I2 and J are predefined. One that is defined only for J > 0, such as one with ln J,
// needs `#[material(domain(J > 0.0), extend)]`, and in the function `rubber`, for flat elements,
// `Rubber::new(…)?.with_inversion(piola::Inversion::Extend { epsilon: 0.1 })`.
/// Rotated linear solid; mu and lambda in Pa.
#[material]
pub fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
        + lambda / 2.0 * (l1 + l2 + l3 - 3.0).powi(2)
}

/// Young's modulus of 1 MPa, Poisson's ratio of 0.45.
fn rubber() -> Result<Rubber, piola::material::MaterialError> {
    Rubber::new(0.345e6, 3.103e6)
}

/// Nodes up to this height, m, are held: the hooves.
const GROUND: f64 = 0.05;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A mesh of tetrahedra from Gmsh, and a finer surface that moves with it.
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/assets");
    let mesh = read_msh(format!("{assets}/horse.msh"))?;
    let surface = read_surface_obj(format!("{assets}/horse.obj"))?;
    let anchors = embed(&mesh, &surface, 0.1)?;

    let body = Body::new(&mesh, rubber()?, 1000.0)?;
    let hooves = Bounds { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY, GROUND, f64::INFINITY] };
    // Implicit Euler with one Newton iteration a step.
    let newton = NewtonSettings::single();
    let settings = SimulationSettings { damping: 2.0, newton, ..Default::default() };
    let mut horse = Simulation::new(body, &Pins::in_box(&mesh, hooves)?, settings)?;

    // All other nodes onto a plane: nearly every tetrahedron is a sheet without volume.
    let flat: Vec<_> = mesh.positions.iter().map(|&[x, y, z]| [x, y.min(GROUND), z]).collect();
    horse.set_positions(&flat)?;

    let (dt, mut frames, mut seconds) = (1.0 / 30.0, Vec::new(), 0.0);
    for frame in 0..=150 {
        if frame > 0 {
            let start = Instant::now();
            horse.step(dt)?;
            seconds += start.elapsed().as_secs_f64();
        }
        if [0, 1, 2, 3, 6, 150].contains(&frame) {
            let vertices: Vec<_> = anchors.iter().map(|anchor| anchor.position(horse.positions())).collect();
            frames.push((f64::from(frame) * dt, vertices));
        }
    }
    std::fs::write("horse.svg", picture::svg(&frames, &surface.triangles))?;
    println!("{} tetrahedra, {:.0} steps a second; picture: horse.svg", mesh.tets.len(), 150.0 / seconds);

    // The body has recovered if each node is back in its place.
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt();
    let largest = horse.positions().iter().zip(&mesh.positions).map(distance).fold(0.0, f64::max);
    let share = largest / mesh.bounds().size()[1];
    println!("after 5 s each node is within {:.4} % of the height from its place at rest", 100.0 * share);
    if share > 1e-3 { Err("the horse has not recovered".into()) } else { Ok(()) }
}

// `cargo test -p horse` tests the energy: derivatives by finite differences, symmetry, inversion and more.
#[cfg(test)]
piola::contract!(rubber: super::rubber()?);
