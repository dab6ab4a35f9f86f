//! Bodies, their responses, matrices and factors.

use piola::point::Filter;
use piola_bodies::step::divided::{Preconditioner, Undivided};
use piola_bodies::system::{Body, ElasticResponse, LowerTriangle, NodalStiffness, Part, parts_of_tets};

use crate::arguments::{Hostile, check};

/// A stiffness without some nodes, as a matrix that is multiplied.
fn triangle(hostile: &mut Hostile, stiffness: &NodalStiffness) {
    let nodes = hostile.node(9);
    let Ok(mut matrix) = LowerTriangle::new(stiffness, &hostile.pins(nodes)) else { return };
    let inertia = hostile.about(1e3);
    let _ = matrix.fill(stiffness, |node| inertia + node as f64);
    let other = Body::new(&hostile.mesh(), hostile.rubber(), 1.0).map(|body| NodalStiffness::of_body(&body));
    if let Ok(Ok(other)) = other {
        let _ = matrix.fill(&other, |_| inertia);
    }
    let unknowns = 3 * matrix.free_nodes().len();
    let (x, mut product) = (hostile.numbers(unknowns), hostile.numbers(unknowns));
    let _ = matrix.multiply(&x, &mut product);
}

/// Blocks or levels for a stiffness, and what they make of a right side.
fn preconditioner(hostile: &mut Hostile, stiffness: &NodalStiffness, positions: &[[f64; 3]]) {
    let nodes = hostile.length(positions.len());
    let mut preconditioner = Preconditioner::new(nodes, Undivided);
    let is_free: Vec<bool> = (0..hostile.length(nodes)).map(|_| !hostile.0.once_in(4)).collect();
    let inertia = if hostile.0.once_in(2) { 0.0 } else { hostile.about(1e3) };
    let empty = NodalStiffness::of_body(&Body::empty()).expect("nothing");
    let taken = if hostile.0.once_in(8) { &empty } else { stiffness };
    let _ = preconditioner.take(taken, &is_free, positions, |_| inertia);
    let (r, mut z) = (hostile.points(positions), hostile.points(positions));
    preconditioner.apply(&r, &mut z);
}

#[test]
fn bodies() {
    check(|hostile| {
        let mesh = hostile.mesh();
        let _ = Body::new(&mesh, hostile.rubber(), hostile.about(1e3));
        let _ = parts_of_tets(&mesh, &[None, Some("half"), None]);
        let parts = (0..hostile.0.below(3)).map(|_| Part {
            group: (!hostile.0.once_in(2)).then(|| hostile.one_of(&["half", "other"]).to_owned()),
            material: Box::new(hostile.rubber()),
            density: hostile.about(1e3),
        });
        let parts = parts.collect();
        let Ok(body) = Body::from_parts(&mesh, parts) else { return };
        let positions = hostile.points(body.rest());
        let mut product = hostile.points(body.rest());
        let mut response = ElasticResponse::new(&body);
        let _ = response.energy(&body, &positions);
        let _ = response.gradient_here(&body, &mut product);
        if let Ok(mut stiffness) = NodalStiffness::of_body(&body) {
            let _ = response.stiffness_here(&body, Filter::Clamp, &mut product, &mut stiffness);
            let _ = stiffness.multiply(&positions, &mut product);
            triangle(hostile, &stiffness);
            preconditioner(hostile, &stiffness, &positions);
        }
    });
}
