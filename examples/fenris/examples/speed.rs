//! Forces and stiffnesses that fenris assembles with a material of piola and with its own: they agree. Ratios
//! of times, best of many runs.

#![expect(clippy::print_stdout, reason = "figures to show")]

use std::time::{Duration, Instant};

use fenris::assembly::global::{CsrAssembler, VectorAssembler};
use fenris::assembly::local::{ElementEllipticAssemblerBuilder, UniformQuadratureTable};
use fenris::element::ElementConnectivity;
use fenris::mesh::procedural::{create_unit_box_uniform_hex_mesh_3d, create_unit_box_uniform_tet_mesh_3d};
use fenris::mesh::{Mesh3d, Tet10Mesh};
use fenris::nalgebra::{DVector, U3};
use fenris::quadrature::{self, QuadraturePair3d};
use fenris_solid::materials::{LameParameters, NeoHookeanMaterial};
use fenris_solid::{HyperelasticMaterial, MaterialEllipticOperator};
use piola::point::Filter;
use piola_fenris::PiolaMaterial;
use piola_materials::NeoHookean;

/// A vector of forces and the entries of a stiffness, with the times that they take.
fn assemble<C, M>(
    mesh: &Mesh3d<f64, C>,
    (weights, points): &QuadraturePair3d<f64>,
    material: &M,
    parameters: &M::Parameters,
) -> eyre::Result<[(DVector<f64>, Duration); 2]>
where
    C: ElementConnectivity<f64, GeometryDim = U3, ReferenceDim = U3> + Sync,
    M: HyperelasticMaterial<f64, U3>,
{
    let quadrature = UniformQuadratureTable::from_points_and_weights(points.clone(), weights.clone())
        .with_uniform_data(parameters.clone());
    let operator = MaterialEllipticOperator::new(material);
    let u = DVector::from_fn(3 * mesh.vertices().len(), |n, _| 0.01 * (1.0 + 17.0 * n as f64).sin());
    let elements = ElementEllipticAssemblerBuilder::new()
        .with_finite_element_space(mesh)
        .with_operator(&operator)
        .with_quadrature_table(&quadrature)
        .with_u(&u)
        .build();
    let (vectors, matrices) = (VectorAssembler::default(), CsrAssembler::default());
    let mut stiffness = matrices.assemble(&elements)?;
    let start = Instant::now();
    let forces = vectors.assemble_vector(&elements)?;
    let between = Instant::now();
    matrices.assemble_into_csr(&mut stiffness, &elements)?;
    let end = Instant::now();
    let entries = DVector::from_column_slice(stiffness.values());
    Ok([(forces, between - start), (entries, end - between)])
}

fn compare<C>(name: &str, mesh: &Mesh3d<f64, C>, quadrature: &QuadraturePair3d<f64>) -> eyre::Result<()>
where
    C: ElementConnectivity<f64, GeometryDim = U3, ReferenceDim = U3> + Sync,
{
    let lame = LameParameters { mu: 3.0, lambda: 7.0 };
    let rubber = PiolaMaterial { material: NeoHookean::new(lame.mu, lame.lambda)?, filter: Filter::None };
    let mut best = [[Duration::MAX; 2]; 2];
    // Interleaved, so that both meet the same neighbours.
    for _ in 0..40 {
        let fenris = assemble(mesh, quadrature, &NeoHookeanMaterial, &lame)?;
        let piola = assemble(mesh, quadrature, &rubber, &None)?;
        for (k, ((expected, _), (found, _))) in fenris.iter().zip(&piola).enumerate() {
            // Sums of some hundred values, each of which is rounded.
            let difference = (found - expected).amax() / expected.amax();
            eyre::ensure!(difference <= 1e-13, "{name}, {}: {difference:e}", ["forces", "stiffness"][k]);
        }
        for (best, run) in best.iter_mut().zip([fenris, piola]) {
            *best = [0, 1].map(|k| best[k].min(run[k].1));
        }
    }
    let [forces, stiffness] = [0, 1].map(|k| best[1][k].as_secs_f64() / best[0][k].as_secs_f64());
    println!(
        "{name}: forces {forces:.2}, stiffness {stiffness:.2} of the time with fenris' neo-Hookean solid"
    );
    Ok(())
}

fn main() -> eyre::Result<()> {
    let hexahedra = create_unit_box_uniform_hex_mesh_3d(6);
    compare("hexahedra of 8 nodes", &hexahedra, &quadrature::tensor::hexahedron_gauss(2))?;
    let tetrahedra = Tet10Mesh::from(&create_unit_box_uniform_tet_mesh_3d(4));
    compare("tetrahedra of 10 nodes", &tetrahedra, &quadrature::total_order::tetrahedron(2)?)
}
