use super::*;
use crate::mesh::Group;
use crate::system::Part;
use crate::system::testing::{beam, kirchhoff};

fn part(group: Option<&str>, density: f64) -> Part {
    Part { group: group.map(str::to_owned), material: Box::new(kirchhoff()), density }
}

#[test]
fn compensation_keeps_what_a_plain_sum_loses() {
    assert_eq!(compensated([1.0, 1e100, 1.0, -1e100].into_iter()), 2.0);
}

#[test]
fn groups_hold_elements_of_one_material() {
    let mut mesh = beam(4);
    mesh.groups =
        vec![Group::of("left", 3, &[], &[0, 1, 2, 3, 4, 5, 6]), Group::of("middle", 3, &[], &[7, 8])];
    let parts = vec![part(Some("middle"), 1.0), part(Some("left"), 2.0), part(None, 4.0)];
    let body = Body::from_parts(&mesh, parts).expect("a body");
    let tags: Vec<usize> = body.elements().iter().map(|element| element.tag).collect();
    assert_eq!(tags[..3], [8, 9, 1]);
    let ranges: Vec<_> = body.groups().map(|(_, range)| range).collect();
    assert_eq!(ranges, [0..2, 2..9, 9..24]);
    let long = Body::new(&beam(30), kirchhoff(), 1.0).expect("a body");
    let ranges: Vec<_> = long.groups().map(|(_, range)| range).collect();
    assert_eq!(ranges, [0..64, 64..128, 128..180]);
    // A sixth of a cell for each tetrahedron.
    let total: f64 = body.masses().iter().sum();
    let expected = (2.0 * 1.0 + 7.0 * 2.0 + 15.0 * 4.0) * 1e-3 / 6.0;
    assert!((total - expected).abs() <= 64.0 * f64::EPSILON * expected);
}

#[test]
fn parts_that_do_not_fit_are_errors() {
    let mut mesh = beam(1);
    mesh.groups = vec![Group::of("skin", 3, &[], &[0, 1]), Group::of("bone", 3, &[], &[1, 2])];
    let part = |name| part(Some(name), 1.0);
    let message = |parts| Body::from_parts(&mesh, parts).expect_err("bad parts").to_string();
    assert_eq!(message(vec![part("skin")]), "element 3 has no material: it belongs to no part");
    assert_eq!(
        message(vec![part("skin"), part("bone")]),
        "element 2 has two materials: it belongs to two parts"
    );
    assert_eq!(message(vec![part("hair")]), "there is no group `hair` of tetrahedra; there are: skin, bone");
    let error = Body::new(&mesh, kirchhoff(), 0.0).expect_err("no mass");
    assert_eq!(error.to_string(), "the density is 0 kg/m³; it must be positive and finite");
    for (density, word) in [(1e-308, "underflows"), (1e308, "overflows")] {
        let mut large = mesh.clone();
        let scale = if density > 1.0 { 1e3 } else { 1.0 };
        large.positions.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
        let message = Body::new(&large, kirchhoff(), density).expect_err("masses out of range").to_string();
        assert!(message.starts_with("the mass of node 0 (from 0)") && message.contains(word), "{message}");
    }
}
