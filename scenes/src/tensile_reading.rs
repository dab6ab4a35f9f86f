//! Stretch and stress of a specimen in a tensile test.

use piola_bodies::mesh::TetMesh;
use piola_bodies::step::Simulation;
use piola_laboratory::Specimen;
use piola_laboratory::curve::{Mode, Volume, respond};

use crate::measure;
use crate::output::TensileReading;

/// Measures an upright specimen between two marks, in shares of its height.
#[must_use]
pub fn read_specimen(
    mesh: &TetMesh,
    simulation: &Simulation,
    marks: [f64; 2],
    material: &dyn Specimen,
) -> TensileReading {
    let bounds = mesh.bounds();
    let height = bounds.size()[1];
    let marks = marks.map(|share| bounds.min[1] + share * height);
    let positions = simulation.positions();
    let stretch = measure::upright_stretch(&mesh.positions, positions, marks);
    let upwards = simulation
        .springs()
        .iter()
        .map(|pull| pull.stiffness * (pull.target[1] - pull.anchor.position(positions)[1]));
    let cross_section = measure::total_volume(&mesh.positions, &mesh.tets) / height;
    let bar = stretch.and_then(|stretch| respond(material, Mode::Uniaxial, Volume::Free, stretch).ok());
    TensileReading {
        stretch,
        nominal_stress: upwards.sum::<f64>() / cross_section,
        uniaxial_stress: bar.map(|bar| bar.stress),
    }
}
