//! Bodies of fenris' elements in equilibrium, with materials of fenris and the same ones of piola.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use eyre::{OptionExt, ensure};
use fenris::assembly::global::{
    CsrAssembler, VectorAssembler, apply_homogeneous_dirichlet_bc_csr, apply_homogeneous_dirichlet_bc_rhs,
};
use fenris::assembly::local::{ElementEllipticAssemblerBuilder, UniformQuadratureTable};
use fenris::element::ElementConnectivity;
use fenris::mesh::procedural::{create_unit_box_uniform_hex_mesh_3d, create_unit_box_uniform_tet_mesh_3d};
use fenris::mesh::{Mesh3d, Tet10Mesh};
use fenris::nalgebra::{DMatrix, DVector, Matrix3, U3, Vector3};
use fenris::quadrature::{self, QuadraturePair3d};
use fenris_solid::materials::{LameParameters, NeoHookeanMaterial, StVKMaterial};
use fenris_solid::{HyperelasticMaterial, MaterialEllipticOperator};
use piola::__private::random::Random;
use piola::point::Filter;
use piola_fenris::PiolaMaterial;
use piola_materials::{NeoHookean, StVenantKirchhoff};

const LAME: LameParameters<f64> = LameParameters { mu: 3.0, lambda: 7.0 };

/// Displacements of a unit cube that is held at x = 0 and whose nodes at x = 1 share a force along and
/// across.
///
/// Newton's method with dense Cholesky factors, until its steps are rounding.
fn equilibrium<C, M>(
    mesh: &Mesh3d<f64, C>,
    (weights, points): &QuadraturePair3d<f64>,
    material: &M,
    parameters: &M::Parameters,
) -> eyre::Result<DVector<f64>>
where
    C: ElementConnectivity<f64, GeometryDim = U3, ReferenceDim = U3> + Sync,
    M: HyperelasticMaterial<f64, U3>,
{
    let quadrature = UniformQuadratureTable::from_points_and_weights(points.clone(), weights.clone())
        .with_uniform_data(parameters.clone());
    let operator = MaterialEllipticOperator::new(material);
    let at = |x: f64| {
        let nodes = mesh.vertices().iter().enumerate();
        nodes.filter(move |(_, vertex)| (vertex.x - x).abs() < 1e-9).map(|(node, _)| node)
    };
    let held: Vec<usize> = at(0.0).collect();
    let mut load = DVector::zeros(3 * mesh.vertices().len());
    let share = Vector3::new(1.0, 0.0, -0.3) / at(1.0).count() as f64;
    for node in at(1.0) {
        load.fixed_rows_mut::<3>(3 * node).copy_from(&share);
    }

    let mut u = DVector::zeros(load.len());
    for _ in 0..20 {
        let elements = ElementEllipticAssemblerBuilder::new()
            .with_finite_element_space(mesh)
            .with_operator(&operator)
            .with_quadrature_table(&quadrature)
            .with_u(&u)
            .build();
        let mut residual = &load - VectorAssembler::default().assemble_vector(&elements)?;
        let mut stiffness = CsrAssembler::default().assemble(&elements)?;
        apply_homogeneous_dirichlet_bc_rhs(&mut residual, &held, 3);
        apply_homogeneous_dirichlet_bc_csr(&mut stiffness, &held, 3);
        let factor = DMatrix::from(&stiffness).cholesky().ok_or_eyre("the cube has buckled")?;
        let step = factor.solve(&residual);
        u += &step;
        if step.amax() <= 1e-13 * u.amax() {
            return Ok(u);
        }
    }
    Err(eyre::eyre!("Newton's method has not converged"))
}

fn compare<C>(mesh: &Mesh3d<f64, C>, quadrature: &QuadraturePair3d<f64>) -> eyre::Result<()>
where
    C: ElementConnectivity<f64, GeometryDim = U3, ReferenceDim = U3> + Sync,
{
    let rubber = PiolaMaterial { material: NeoHookean::new(LAME.mu, LAME.lambda)?, filter: Filter::None };
    let expected = equilibrium(mesh, quadrature, &NeoHookeanMaterial, &LAME)?;
    let found = equilibrium(mesh, quadrature, &rubber, &None)?;
    ensure!(expected.amax() > 0.1, "the cube hardly moves: {}", expected.amax());
    let difference = (&found - &expected).amax();
    // The last steps, and rounding times the condition of the stiffness, which is some thousands.
    ensure!(difference <= 1e-11, "displacements differ by {difference:e}");
    Ok(())
}

#[test]
fn hexahedra_come_to_rest_where_those_of_fenris_do() -> eyre::Result<()> {
    compare(&create_unit_box_uniform_hex_mesh_3d(3), &quadrature::tensor::hexahedron_gauss(2))
}

#[test]
fn quadratic_tetrahedra_come_to_rest_where_those_of_fenris_do() -> eyre::Result<()> {
    let mesh = Tet10Mesh::from(&create_unit_box_uniform_tet_mesh_3d(2));
    compare(&mesh, &quadrature::total_order::tetrahedron(2)?)
}

/// The same energies, stresses and contractions as of fenris' materials, up to rounding.
fn check_values<M: HyperelasticMaterial<f64, U3, Parameters = LameParameters<f64>>, N>(fenris: &M, piola: N)
where
    N: piola::Material + Copy + 'static,
{
    let piola = PiolaMaterial { material: piola, filter: Filter::None };
    let mut random = Random::new(9);
    for _ in 0..1000 {
        let F = Matrix3::identity() + Matrix3::from_fn(|_, _| random.uniform(-0.3, 0.3));
        let [a, b] = [(); 2].map(|()| Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0)));
        let energies = [piola.compute_energy_density(&F, &None), fenris.compute_energy_density(&F, &LAME)];
        let stresses = [piola.compute_stress_tensor(&F, &None), fenris.compute_stress_tensor(&F, &LAME)];
        let contractions = [
            piola.compute_stress_contraction(&F, &a, &b, &None),
            fenris.compute_stress_contraction(&F, &a, &b, &LAME),
        ];
        // Moduli of ten, strains of a third, and det F down to a fifth, by which fenris divides.
        let tolerance = 1e-12;
        assert!((energies[0] - energies[1]).abs() <= tolerance, "{energies:?} at {F}");
        assert!((stresses[0] - stresses[1]).amax() <= tolerance, "{stresses:?} at {F}");
        assert!((contractions[0] - contractions[1]).amax() <= tolerance, "{contractions:?} at {F}");
    }
}

#[test]
fn values_are_those_of_fenris() -> eyre::Result<()> {
    check_values(&NeoHookeanMaterial, NeoHookean::new(LAME.mu, LAME.lambda)?);
    check_values(&StVKMaterial, StVenantKirchhoff::new(LAME.mu, LAME.lambda)?);
    Ok(())
}

#[test]
fn outside_the_domain_energies_are_infinite_and_stresses_are_nan() -> eyre::Result<()> {
    let rubber = PiolaMaterial { material: NeoHookean::new(LAME.mu, LAME.lambda)?, filter: Filter::None };
    let inverted = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
    assert_eq!(rubber.compute_energy_density(&inverted, &None), f64::INFINITY);
    assert!(rubber.compute_stress_tensor(&inverted, &None).iter().all(|x| x.is_nan()));
    let axis = Vector3::x();
    assert!(rubber.compute_stress_contraction(&inverted, &axis, &axis, &None).iter().all(|x| x.is_nan()));
    Ok(())
}
