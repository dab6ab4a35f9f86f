//! Batches of declared materials: parameters for each point, and energies of invariants with and without
//! them.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use piola::batch::{Batch, Layout, TileMaterial};
use piola::lanes::Backend;
use piola::material::{Graded, PerPoint, PerPointError};
use piola::point::Filter;
use piola::{Inversion, Spline, Survey};
use piola_bodies::mesh::{Group, TetMesh, tetrahedral_box};
use piola_bodies::system::{Body, BodyError, ElasticResponse, NodalStiffness, Part};
use piola_materials::{Gent, NeoHookean, Ogden, StretchSpline};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const EXTEND: Inversion = Inversion::Extend { epsilon: 0.25 };

/// More than two tiles, and not a whole number of lines.
const COUNT: usize = 150;

/// Deformation gradients from gentle to inside out, one that is rank-deficient and one out of the invariants'
/// range.
fn deformations() -> Vec<[f64; 9]> {
    let mut all: Vec<[f64; 9]> = (0..COUNT)
        .map(|p| {
            let turn = 0.7 * p as f64;
            let shear = 0.4 * turn.sin();
            let last = if p % 7 == 3 { -0.5 } else { 0.5 + (0.3 * turn.cos()).abs() };
            [1.0 + 0.3 * turn.cos(), shear, 0.1, -0.2 * shear, 1.1, shear, 0.05, 0.2, last]
        })
        .collect();
    all[40] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    all[41] = [1e60, 0.0, 0.0, 0.0, 1e60, 0.0, 0.0, 0.0, 1e60];
    all
}

/// Results of a batch at points: energies, stresses, tangents, and the outcome of the first two calls.
#[derive(Debug, PartialEq)]
struct Answers {
    energies: Vec<f64>,
    stresses: Vec<f64>,
    tangents: Vec<f64>,
    surveys: [Survey; 2],
}

fn answers(
    energy: &dyn TileMaterial<f64>,
    backend: Backend,
    all: &[[f64; 9]],
) -> Result<Answers, Box<dyn std::error::Error>> {
    let (batch, F) = (Batch::new(energy).with_backend(backend), all.as_flattened());
    let n = all.len();
    let (mut energies, mut stresses) = (vec![0.0; n], vec![0.0; 9 * n]);
    let (mut beside, mut tangents) = (vec![0.0; 9 * n], vec![0.0; 81 * n]);
    let surveys = [batch.energies(F, &mut energies)?, batch.stresses(F, &mut stresses)?];
    batch.tangents(F, &mut beside, &mut tangents)?;
    Ok(Answers { energies, stresses, tangents, surveys })
}

/// As bits, so that NaN equals itself.
fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

fn check_each<M: Graded>(materials: &[M]) -> Outcome {
    let all = deformations();
    let each = PerPoint::new(materials)?;
    for backend in Backend::available() {
        let together = answers(&each, backend, &all)?;
        for (p, material) in materials.iter().enumerate() {
            let alone = answers(material, backend, &all[p..=p])?;
            assert_eq!(bits(&together.energies[p..=p]), bits(&alone.energies), "point {p}, {backend}");
            assert_eq!(bits(&together.stresses[9 * p..][..9]), bits(&alone.stresses), "point {p}, {backend}");
            assert_eq!(
                bits(&together.tangents[81 * p..][..81]),
                bits(&alone.tangents),
                "point {p}, {backend}"
            );
        }
    }
    Ok(())
}

#[test]
fn each_point_of_a_batch_gets_what_it_would_get_alone() -> Outcome {
    let stiffness = |p: usize| 1.0 + 0.1 * p as f64;
    let rubbers: Result<Vec<_>, _> =
        (0..COUNT).map(|p| NeoHookean::new(stiffness(p), 3.0)?.with_inversion(EXTEND)).collect();
    check_each(&rubbers?)?;
    let refusing: Result<Vec<_>, _> = (0..COUNT).map(|p| Gent::new(stiffness(p), 30.0, 10.0)).collect();
    check_each(&refusing?)?;
    let ogdens: Result<Vec<_>, _> = (0..COUNT)
        .map(|p| Ogden::new([stiffness(p), 0.2], [1.3, 3.0], 5.0)?.with_inversion(EXTEND))
        .collect();
    check_each(&ogdens?)
}

#[test]
fn each_point_of_a_batch_may_have_functions_of_its_own() -> Outcome {
    let drawn = |p: usize| {
        let curve = |force: f64| Spline::through(&[[0.5, -force], [1.0, 0.0], [2.0, force]]);
        let stiffness = 1.0 + 0.1 * p as f64;
        StretchSpline::new(curve(stiffness)?, curve(0.2)?, curve(5.0)?)
    };
    let graded: Result<Vec<_>, _> = (0..COUNT).map(drawn).collect();
    check_each(&graded?)?;
    // Runs of points with one material, and points with different ones side by side.
    let three = [drawn(0)?, drawn(1)?, drawn(2)?];
    check_each(&(0..COUNT).map(|p| three[p / 40 % 3].clone()).collect::<Vec<_>>())?;
    check_each(&(0..COUNT).map(|p| &three[p * p % 3]).collect::<Vec<_>>())
}

#[test]
fn materials_must_fit_the_points_and_each_other() -> Outcome {
    let rubber = NeoHookean::new(1.0, 3.0)?;
    let three = [rubber; 3];
    let each = PerPoint::new(&three)?;
    let error = Batch::<f64>::new(&each).energies(&[1.0; 18], &mut [0.0; 2]).expect_err("two points");
    assert!(error.to_string().contains("materials"), "{error}");
    assert_eq!(PerPoint::<NeoHookean, _>::new(&[]).err(), Some(PerPointError::NoMaterial));
    let mixed = [rubber, rubber.with_inversion(EXTEND)?];
    assert_eq!(PerPoint::new(&mixed).err(), Some(PerPointError::DifferentInversion { material: 1 }));
    Ok(())
}

type EnergyAndProduct = (f64, Vec<[f64; 3]>);

/// The energy at these positions, and the product of the clamped stiffness there with them.
fn energy_and_product(body: &Body, x: &[[f64; 3]]) -> Result<EnergyAndProduct, Box<dyn std::error::Error>> {
    let mut response = ElasticResponse::new(body);
    let (energy, survey) = response.energy(body, x)?;
    assert!(survey.is_clean());
    let mut stiffness = NodalStiffness::of_body(body)?;
    response.stiffness_here(body, Filter::Clamp, &mut vec![[0.0; 3]; x.len()], &mut stiffness)?;
    let mut product = vec![[0.0; 3]; x.len()];
    for (row, column, block) in stiffness.blocks() {
        for a in 0..3 {
            for c in 0..3 {
                product[row][a] += block[a][c] * x[column][c];
                if row != column {
                    product[column][c] += block[a][c] * x[row][a];
                }
            }
        }
    }
    Ok((energy, product))
}

/// Parts of many elements, with a material for each in their order, are parts of one element each.
#[test]
fn each_element_of_a_part_has_its_material() -> Outcome {
    let mut mesh = tetrahedral_box([3, 3, 3], [0.3; 3])?;
    let all = mesh.tets.len();
    let materials: Vec<NeoHookean> =
        (0..all).map(|k| NeoHookean::new(1e5 + 1e3 * k as f64, 4e5)).collect::<Result<_, _>>()?;
    // In two parts, the first of which is shorter than two tiles.
    let (first, second) = materials.split_at(all - 70);
    let name = "first".to_owned();
    mesh.groups = vec![Group { name, dimension: 3, nodes: Vec::new(), tets: (0..first.len()).collect() }];
    let part = |group: Option<&str>, materials: &[NeoHookean]| -> Result<Part, PerPointError> {
        let material = Box::new(PerPoint::new(materials.to_vec())?);
        Ok(Part { group: group.map(str::to_owned), material, density: 1000.0 })
    };
    let body = Body::from_parts(&mesh, vec![part(Some("first"), first)?, part(None, second)?])?;
    let bent: Vec<[f64; 3]> = mesh.positions.iter().map(|&[x, y, z]| [1.2 * x, y + x * x, 0.9 * z]).collect();
    let (found, product) = energy_and_product(&body, &bent)?;
    let (mut energy, mut sum) = (0.0, vec![[0.0; 3]; bent.len()]);
    for (tet, material) in mesh.tets.iter().zip(&materials) {
        let one = TetMesh::new(tet.map(|node| mesh.positions[node]).to_vec(), vec![[0, 1, 2, 3]]);
        let (body, x) = (Body::new(&one, *material, 1000.0)?, tet.map(|node| bent[node]));
        let (alone, product) = energy_and_product(&body, &x)?;
        energy += alone;
        for (&node, product) in tet.iter().zip(product) {
            (0..3).for_each(|c| sum[node][c] += product[c]);
        }
    }
    assert!((found - energy).abs() <= 1e-13 * energy, "{found} for {energy}");
    let size = sum.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (found, expected) in product.as_flattened().iter().zip(sum.as_flattened()) {
        assert!((found - expected).abs() <= 1e-12 * size, "{found} for {expected}");
    }
    Ok(())
}

#[test]
fn a_part_has_a_material_for_all_elements_or_for_each() -> Outcome {
    let mesh = tetrahedral_box([1, 1, 1], [0.1; 3])?;
    let five = || PerPoint::new(vec![NeoHookean::new(1.0, 3.0).expect("moduli"); 5]);
    let refused = BodyError::MaterialsForPoints { materials: 5, elements: 6 };
    assert_eq!(Body::new(&mesh, five()?, 1.0).err(), Some(refused.clone()));
    let mut body = Body::new(&mesh, NeoHookean::new(1.0, 3.0)?, 1.0)?;
    assert_eq!(body.set_material(0, five()?).err(), Some(refused));
    assert_eq!(PerPoint::<NeoHookean>::new(Vec::new()).err(), Some(PerPointError::NoMaterial));
    Ok(())
}

/// A point that needs a decomposition leaves the bits of its neighbours as they are, and gets its own.
#[test]
fn points_with_and_without_invariants_share_a_tile() -> Outcome {
    let all = deformations();
    for energy in [NeoHookean::new(1.0, 3.0)?, NeoHookean::new(1.0, 3.0)?.with_inversion(EXTEND)?] {
        for backend in Backend::available() {
            let together = answers(&energy, backend, &all)?;
            let mut refused = 0;
            for (p, F) in all.iter().enumerate() {
                let alone = answers(&energy, backend, &[*F])?;
                refused += alone.surveys[0].refused;
                assert_eq!(bits(&together.energies[p..=p]), bits(&alone.energies), "point {p}, {backend}");
                assert_eq!(
                    bits(&together.stresses[9 * p..][..9]),
                    bits(&alone.stresses),
                    "point {p}, {backend}"
                );
            }
            assert_eq!(together.surveys.map(|survey| survey.refused), [refused; 2], "{backend}");
        }
    }
    Ok(())
}

/// By invariants and by stretches P is the same up to rounding, in either layout.
#[test]
fn stress_is_the_same_with_and_without_a_decomposition() -> Outcome {
    let (all, energy) = (deformations(), NeoHookean::new(1.0, 3.0)?.with_inversion(EXTEND)?);
    for backend in Backend::available() {
        let batch = Batch::<f64>::new(&energy).with_backend(backend);
        let (mut stresses, mut beside) = (vec![0.0; 9 * COUNT], vec![0.0; 9 * COUNT]);
        let mut tangents = vec![0.0; 81 * COUNT];
        batch.stresses(all.as_flattened(), &mut stresses)?;
        batch.tangents(all.as_flattened(), &mut beside, &mut tangents)?;
        for p in (0..COUNT).filter(|&p| p != 41) {
            let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (found, expected) = (&stresses[9 * p..][..9], &beside[9 * p..][..9]);
            let difference: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
            // Each of the two is good to 30 u (‖P‖ + sens), as the reference cases judge.
            let sensitivity = norm(&tangents[81 * p..][..81]) * norm(&all[p]);
            let bound = 60.0 * f64::EPSILON / 2.0 * (norm(expected) + sensitivity);
            assert!(norm(&difference) <= bound, "point {p}, {backend}: {} > {bound}", norm(&difference));
        }
        let lines = batch.with_layout(Layout::Lines);
        let whole = COUNT / 8 * 8;
        let (mut F, mut P) = (vec![0.0; 9 * whole], vec![0.0; 9 * whole]);
        for (p, k) in (0..whole).flat_map(|p| (0..9).map(move |k| (p, k))) {
            F[Layout::Lines.index::<f64>(p, 9, k)] = all[p][k];
        }
        lines.stresses(&F, &mut P)?;
        for (p, k) in (0..whole).flat_map(|p| (0..9).map(move |k| (p, k))) {
            let found = P[Layout::Lines.index::<f64>(p, 9, k)];
            assert_eq!(found.to_bits(), stresses[9 * p + k].to_bits(), "entry {k} of point {p}, {backend}");
        }
    }
    Ok(())
}
