use piola::__private::random::Random;

use super::*;
use crate::mesh::tetrahedral_box;
use crate::system::testing::{kirchhoff, shake};

/// Of a shaken box of more elements than a wave holds.
#[test]
fn the_product_is_the_sum_of_those_of_the_elements() {
    let mesh = tetrahedral_box([10, 9, 9], [1.0, 0.9, 0.9]).expect("a box");
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    assert!(body.elements().len() > WAVE * TILE);
    let mut elastic = Elastic::new(&body);
    elastic.evaluate(&body, &shake(&mut Random::new(3), &mesh.positions, 0.01));
    let nodes = body.rest().len();
    let mut random = Random::new(4);
    let x: Vec<[f64; 3]> = (0..nodes).map(|_| [0; 3].map(|_| random.uniform(-1.0, 1.0))).collect();
    let mut kept = NodalStiffness::new(&body, &[], true).expect("small");
    kept.linearise(&body, &mut elastic, Filter::Clamp);
    let mut expected = vec![[0.0; 3]; nodes];
    kept.add_product(&body, &x, &mut expected);

    let mut stiffness = NodalStiffness::of_body(&body).expect("small");
    let mut found = vec![[f64::NAN; 3]; nodes];
    // Twice, since nothing may be left from the first time.
    for _ in 0..2 {
        let evaluated = stiffness.linearise(&body, &mut elastic, Filter::Clamp);
        assert!(evaluated.survey.is_clean(), "{evaluated:?}");
        stiffness.multiply(&x, &mut found).expect("lengths");
    }
    let largest = expected.as_flattened().iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
        // Sums of some 24 elements times 12 terms, in different orders, which cancel.
        assert!((found - expected).abs() <= 600.0 * f64::EPSILON * largest, "{found} for {expected}");
    }
    // The matrix that keeps the stiffnesses of all elements has the same blocks.
    assert!(stiffness.matrix().blocks() == kept.matrix().blocks());
    let tiles = [&stiffness, &kept].map(|matrix| matrix.tiles.len());
    assert_eq!(tiles, [WAVE, body.groups().count()]);
    assert!(stiffness.multiply(&x[1..], &mut found).is_err());
    assert!(stiffness.multiply(&x, &mut found[1..]).is_err());
}

#[test]
fn the_curve_keeps_neighbours_together() {
    let mesh = tetrahedral_box([7, 7, 7], [1.0; 3]).expect("a box");
    let order = along_a_curve(&mesh.positions);
    let mut sorted = order.clone();
    sorted.sort_unstable();
    assert!(sorted.iter().enumerate().all(|(at, &node)| at == node as usize), "each node once");
    // The first 64 of 512 nodes of a cube fill one of its octants.
    for &node in &order[..64] {
        assert!(
            mesh.positions[node as usize].iter().all(|&x| x < 0.5),
            "{:?}",
            mesh.positions[node as usize]
        );
    }
    assert_eq!(along_a_curve(&[[2.0; 3]; 3]), [0, 1, 2]);
}
