//! Forces and stiffnesses of the shader, compared with those of piola's batches, on a small mesh.

#![expect(non_snake_case, reason = "K as in the literature")]
#![expect(clippy::print_stdout, reason = "figures to show")]

use piola::Inversion;
use piola::batch::{Batch, Kernels, Tetrahedra, TileMaterial};
use piola::interpreter::Interpreted;
use piola::point::Filter;
use piola_declare::Energy;
use piola_declare::emit::{Emission, PointFunction, Target};
use piola_wgpu::PREFIX;
use piola_wgpu::device::Device;
use piola_wgpu::mesh::{Mesh, bar};
use piola_wgpu::tetrahedra::Elements;

/// Bound of errors in units of u: of stiffnesses times the largest entry of the element's K, of gradients
/// times their own largest entry and that of K times the largest edge, since a change of u in the edges
/// changes them by that. It is piola's own for P and dP/dF; 22 u and 4.6 u are found.
const BOUND: f64 = 30.0;

/// Unit roundoff of `f32`.
const U: f64 = 1.0 / (1 << 24) as f64;

/// Functions of the shader, and the filters of a batch.
const FUNCTIONS: [(PointFunction, Filter); 2] =
    [(PointFunction::Tetrahedron, Filter::None), (PointFunction::ProjectedTetrahedron, Filter::Clamp)];

/// Gradient and stiffness of each element by a batch, in `f32` or `f64`.
fn by_piola<E: Kernels + From<f32>>(material: &Interpreted, filter: Filter, mesh: &Mesh) -> Vec<[f64; 156]>
where
    Interpreted: TileMaterial<E>,
{
    let positions: Vec<[E; 3]> = mesh.positions.iter().map(|at| at.map(E::from)).collect();
    let corners: Vec<[usize; 4]> = mesh.corners.iter().map(|all| all.map(|node| node as usize)).collect();
    let rest: Vec<E> = mesh.rest.as_flattened().iter().map(|&x| E::from(x)).collect();
    let tetrahedra = Tetrahedra::new(positions.len(), &corners).expect("nodes of the mesh");
    let [mut gradients, mut K] = [12, 144].map(|count| vec![E::from(0.0f32); count * corners.len()]);
    let survey = Batch::<E>::new(material)
        .with_filter(filter)
        .stiffnesses_at(tetrahedra, &positions, &rest, &mut gradients, &mut K)
        .expect("lengths that fit");
    assert_eq!((survey.refused, survey.nonfinite), (0, 0));
    let number = |element: usize, k: usize| {
        if k < 12 { gradients[12 * element + k] } else { K[144 * element + k - 12] }
    };
    (0..corners.len()).map(|element| std::array::from_fn(|k| number(element, k).into())).collect()
}

/// Largest errors of gradients and stiffnesses, as [`BOUND`] has them.
fn errors(mesh: &Mesh, exact: &[[f64; 156]], found: &[[f64; 156]]) -> [f64; 2] {
    assert_eq!([exact.len(), found.len()], [mesh.corners.len(); 2]);
    let largest = |entries: &[f64]| entries.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut worst = [0.0f64; 2];
    for (corners, (exact, found)) in mesh.corners.iter().zip(exact.iter().zip(found)) {
        let places = corners.map(|node| mesh.positions[node as usize].map(f64::from));
        let edges = places.map(|place| [0, 1, 2].map(|a| place[a] - places[0][a]));
        let stiffness = largest(&exact[12..]);
        let force = largest(&exact[..12]) + stiffness * largest(edges.as_flattened());
        let difference: [f64; 156] = std::array::from_fn(|k| exact[k] - found[k]);
        worst[0] = worst[0].max(largest(&difference[..12]) / (U * force));
        worst[1] = worst[1].max(largest(&difference[12..]) / (U * stiffness));
    }
    worst
}

#[track_caller]
fn check(formula: &str, values: &[&[f64]]) {
    let device = Device::open().expect("an adapter; `check` looks for one");
    let energy = Energy::from_formula(formula).expect("a formula");
    let material = energy.material(values, Inversion::Refuse).expect("admissible parameters");
    // The last line of 64 elements is not full.
    let mesh = bar([11, 4, 3]).expect("a box");
    for (function, filter) in FUNCTIONS {
        let (prefix, functions) = (Some(PREFIX.into()), vec![function]);
        let emission = Emission { prefix, functions, ..Emission::new(Target::Wgsl) };
        let text = energy.emit(values, Inversion::Refuse, &emission).expect("an energy that can be printed");
        let function = function.name();
        let elements = Elements::new(&device, (&text, function), &mesh).expect("a program");
        elements.compute().expect("a device");
        let statuses = elements.statuses().expect("a device");
        let is_filtered = |&status: &u32| status == 8 && filter != Filter::None;
        assert!(statuses.iter().all(|status| *status == 0 || is_filtered(status)), "{statuses:?}");
        assert_eq!(statuses.iter().any(is_filtered), filter != Filter::None);
        let results = elements.results().expect("a device");
        let results: Vec<_> = results.iter().map(|element| element.map(f64::from)).collect();
        let exact = by_piola::<f64>(&material, filter, &mesh);
        let here = errors(&mesh, &exact, &results);
        let there = errors(&mesh, &exact, &by_piola::<f32>(&material, filter, &mesh));
        println!("{formula}, {function}: gradients and K {here:.1?} u; by piola in f32 {there:.1?} u");
        assert!(here.iter().all(|&error| error < BOUND), "{formula}, {function}: {here:.1?} u");
    }
}

#[test]
fn neo_hookean() {
    check("mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2", &[&[1e6], &[5e6]]);
}

#[test]
fn ogden() {
    let formula = "sum(p, mu[p]/alpha[p]*(l1^alpha[p] + l2^alpha[p] + l3^alpha[p] - 3)) - sum(p, mu[p])*ln(J) + kappa/2*(J - 1)^2";
    check(formula, &[&[6.3e5, 1.2e3, -1e4], &[1.3, 5.0, -2.0], &[2e7]]);
}
