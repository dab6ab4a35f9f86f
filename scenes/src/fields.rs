//! Tetrahedra of a body with fields, for ParaView.

#![expect(non_snake_case, reason = "F as in the literature")]

use std::io::{self, Write};

use piola::batch::Batch;
use piola::point::svd;
use piola_bodies::step::Simulation;

use crate::output::{Field, write_vtu};

/// Writes the tetrahedra of a body as VTU, with displacement, m, and velocity, m/s, of nodes, and det F,
/// principal stretches and energy density, J/m³, of tetrahedra; the last is NaN for a tetrahedron outside the
/// domain of its energy.
///
/// # Errors
/// If `target` cannot be written to.
pub fn write(target: &mut impl Write, simulation: &Simulation) -> io::Result<()> {
    let (body, positions) = (simulation.body(), simulation.positions());
    let displacements: Vec<f64> = positions
        .as_flattened()
        .iter()
        .zip(body.rest().as_flattened())
        .map(|(position, rest)| position - rest)
        .collect();
    let F: Vec<_> = body.elements().iter().map(|element| element.deformation_gradient(positions)).collect();
    let stretches: Vec<[f64; 3]> = F.iter().map(|F| svd(F).stretches).collect();
    let dets: Vec<f64> = stretches.iter().map(|[l1, l2, l3]| l1 * l2 * l3).collect();
    let energies = energies(simulation);
    let tets: Vec<_> = body.elements().iter().map(|element| element.nodes).collect();
    let nodal = [
        Field { name: "displacement", components: 3, values: &displacements },
        Field { name: "velocity", components: 3, values: simulation.velocities().as_flattened() },
    ];
    let elemental = [
        Field { name: "det F", components: 1, values: &dets },
        Field { name: "stretches", components: 3, values: stretches.as_flattened() },
        Field { name: "energy density", components: 1, values: &energies },
    ];
    write_vtu(target, positions, &tets, &nodal, &elemental)
}

/// Energy density of each element, J/m³; NaN outside the domain of its energy.
pub(crate) fn energies(simulation: &Simulation) -> Vec<f64> {
    let body = simulation.body();
    let mut energies = Vec::new();
    for (material, elements) in body.materials() {
        for element in &body.elements()[elements] {
            let F = element.deformation_gradient(simulation.positions());
            let mut density = [0.0];
            let survey = Batch::new(material).energies(F.as_flattened(), &mut density);
            let is_defined = survey.is_ok_and(|survey| survey.refused == 0 && survey.nonfinite == 0);
            energies.push(if is_defined { density[0] } else { f64::NAN });
        }
    }
    energies
}
