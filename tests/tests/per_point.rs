//! Parameters that differ from point to point: each point gets what it would get alone, in batches and in
//! bodies.
//!
//! Three compiled types stand for all: two of numbers and lists, which lanes hold side by side, and one of
//! functions; and an interpreted one. The test `attribute` has compiled lists of different lengths.

use piola::batch::{Batch, TileMaterial};
use piola::lanes::Backend;
use piola::material::{Graded, MaterialError, PerPoint, PerPointError};
use piola::point::Filter;
use piola::{Inversion, Spline};
use piola_bodies::mesh::{Group, TetMesh, tetrahedral_box};
use piola_bodies::system::{Body, BodyError, ElasticResponse, NodalStiffness, Part};
use piola_materials::{Gent, NeoHookean, Ogden, StretchSpline};
use piola_tests::answers::{Answers, COUNT, deformations};
use piola_tests::energies::find;

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

const EXTEND: Inversion = Inversion::Extend { epsilon: 0.25 };

/// Fails unless each of the points gets the bits that it would get alone, on every back end.
fn check_each<M: Graded>(materials: &[M]) -> Outcome {
    let all = deformations();
    let each = PerPoint::new(materials)?;
    for backend in Backend::available() {
        let answers = |material: &dyn TileMaterial<f64>, points: &[[f64; 9]]| {
            Answers::of(Batch::new(material).with_backend(backend), points.as_flattened())
        };
        let together = answers(&each, &all);
        for (p, material) in materials.iter().enumerate() {
            together.check(&backend.to_string(), p, &answers(material, &all[p..=p]));
        }
    }
    Ok(())
}

/// Rubber with a number and lists of its own.
fn ogden(scale: f64, inversion: Inversion) -> Result<Ogden<2>, MaterialError> {
    Ogden::new([scale, 0.2], [1.3 * scale, 3.0 + scale], 5.0 / scale)?.with_inversion(inversion)
}

#[test]
fn each_point_of_a_batch_gets_what_it_would_get_alone() -> Outcome {
    for inversion in [Inversion::Refuse, EXTEND] {
        let ogdens: Result<Vec<_>, _> = (0..COUNT).map(|p| ogden(1.0 + 0.01 * p as f64, inversion)).collect();
        check_each(&ogdens?)?;
    }
    // The bound of the domain is a parameter.
    let gents: Result<Vec<_>, _> = (0..COUNT).map(|p| Gent::new(1.0, 0.5 + 0.2 * p as f64, 10.0)).collect();
    check_each(&gents?)?;
    let (one, other) = (ogden(1.0, EXTEND)?, ogden(0.7, EXTEND)?);
    check_each(&(0..COUNT).map(|p| if p % 3 == 0 { &one } else { &other }).collect::<Vec<_>>())
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
    check_each(&(0..COUNT).map(|p| three[p * p % 3].clone()).collect::<Vec<_>>())
}

/// Materials that differ in numbers, in the lengths of lists, or altogether.
#[test]
fn each_point_of_a_batch_may_have_interpreted_lists_of_its_own() -> Outcome {
    let energy = &find("ogden").expect("in the catalogue").energy;
    let term = |k: usize| [1e5 * (1.0 + k as f64 / 50.0)];
    let terms = |k: usize| vec![1e5; 1 + k % 2];
    let alike = |k: usize| energy.material(&[&term(k), &[2.0], &[1e6]], Inversion::Refuse);
    let mixed = |k: usize| energy.material(&[&terms(k), &terms(k), &[1e6]], Inversion::Refuse);
    check_each(&(0..COUNT).map(alike).collect::<Result<Vec<_>, _>>()?)?;
    check_each(&(0..COUNT).map(mixed).collect::<Result<Vec<_>, _>>()?)
}

#[test]
fn materials_must_fit_the_points_and_each_other() -> Outcome {
    let rubber = ogden(1.0, Inversion::Refuse)?;
    let three = [rubber; 3];
    let each = PerPoint::new(&three)?;
    let error = Batch::<f64>::new(&each).energies(&[1.0; 18], &mut [0.0; 2]).expect_err("two points");
    assert!(error.to_string().contains("materials"), "{error}");
    let error = PerPoint::<Ogden<2>, _>::new(&[]).expect_err("no material").to_string();
    assert!(error.starts_with("the list of materials is empty: "), "{error}");
    let mixed = [rubber, rubber.with_inversion(EXTEND)?];
    let error = PerPoint::new(&mixed).expect_err("two inversions").to_string();
    assert!(error.starts_with("material 1 treats deformations outside its domain differently"), "{error}");
    Ok(())
}

/// The energy at these positions, and the product of the clamped stiffness there with them.
fn energy_and_product(body: &Body, x: &[[f64; 3]]) -> Outcome<(f64, Vec<[f64; 3]>)> {
    let mut response = ElasticResponse::new(body);
    let (energy, survey) = response.energy(body, x)?;
    assert!(survey.is_clean());
    let mut stiffness = NodalStiffness::of_body(body)?;
    response.stiffness_here(body, Filter::Clamp, &mut vec![[0.0; 3]; x.len()], &mut stiffness)?;
    let mut product = vec![[0.0; 3]; x.len()];
    stiffness.multiply(x, &mut product)?;
    Ok((energy, product))
}

/// Parts of many elements, with a material for each in their order, are parts of one element each.
#[test]
fn each_element_of_a_part_has_its_material() -> Outcome {
    let mut mesh = tetrahedral_box([3, 3, 3], [0.3; 3])?;
    let all = mesh.tets.len();
    let rubber = |k: usize| Ogden::new([1e5 + 1e3 * k as f64, 2e4], [2.0, 3.0], 4e5);
    let materials: Vec<Ogden<2>> = (0..all).map(rubber).collect::<Result<_, _>>()?;
    // In two parts, the first of which is shorter than two tiles.
    let (first, second) = materials.split_at(all - 70);
    let name = "first".to_owned();
    mesh.groups = vec![Group { name, dimension: 3, nodes: Vec::new(), tets: (0..first.len()).collect() }];
    let part = |group: Option<&str>, materials: &[Ogden<2>]| -> Result<Part, PerPointError> {
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
    let five = PerPoint::new(vec![ogden(1.0, EXTEND)?; 5])?;
    let refused =
        "there are 5 materials for a part of 6 elements: give one for all, or one for each".to_owned();
    let message = |error: Option<BodyError>| error.map(|error| error.to_string());
    assert_eq!(message(Body::new(&mesh, five, 1.0).err()), Some(refused));
    Ok(())
}

#[test]
fn a_parameter_can_be_replaced_and_is_checked() -> Result<(), MaterialError> {
    let rubber = NeoHookean::new(1.0, 3.0)?.with_inversion(EXTEND)?;
    assert_eq!(rubber.with_lambda(5.0)?, NeoHookean::new(1.0, 5.0)?.with_inversion(EXTEND)?);
    assert!(matches!(rubber.with_mu(-1.0), Err(MaterialError::Violated { .. })));
    let refused = rubber.with_lambda(f64::NAN).map_err(|error| error.to_string());
    assert_eq!(refused.err().as_deref(), Some("`lambda` is NaN; it must be a finite number"));
    Ok(())
}
