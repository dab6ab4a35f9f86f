//! Bodies, their responses, matrices and factors.

use piola::batch::Layout;
use piola::point::Filter;
use piola::step::Integrator;
use piola::step::divided::StagedSteps;
use piola::system::{BlockMatrix, Body, Cholesky, ElasticResponse, NodalStiffness, Part, Pattern, Pins};

use crate::arguments::{TOO_MANY, check};

#[test]
fn matrices_of_ones_own() {
    check(|hostile| {
        let nodes = if hostile.0.once_in(6) { hostile.one_of(&TOO_MANY) } else { hostile.0.below(9) };
        let count = hostile.0.below(4);
        let tets: Vec<_> = (0..count).map(|_| [(); 4].map(|()| hostile.node(nodes))).collect();
        let pins = hostile.pins(nodes);
        let _ = Pattern::of_tets(nodes, &tets, &pins);
        let Ok(mut matrix) = BlockMatrix::new(nodes, &tets, &pins) else { return };
        let layout = hostile.one_of(&[Layout::Points, Layout::Lines]);
        let points = if layout == Layout::Lines { count.next_multiple_of(8) } else { count };
        let inertia = hostile.about(1e3);
        let (full, packed) = (hostile.numbers(144 * points), hostile.numbers(78 * points));
        let _ = matrix.assemble(&full, layout, |node| inertia + node as f64);
        let _ = matrix.assemble_packed(&packed, layout, |_| inertia);
        let block = [(); 3].map(|()| hostile.point());
        let _ = matrix.add_block(hostile.node(nodes), hostile.node(nodes), block);
        let (x, mut product) = (hostile.numbers(3 * nodes.min(9)), hostile.numbers(3 * nodes.min(9)));
        let _ = matrix.lower_triangle().multiply(&x, &mut product);
        let (starts, rows) = (matrix.pattern().column_starts(), matrix.pattern().row_indices());
        let mut cholesky = Cholesky::new(starts, rows).expect("a pattern of its own");
        let values = hostile.numbers(rows.len());
        let values = if hostile.0.once_in(2) { matrix.values() } else { &values };
        let factored = cholesky.factor(values);
        let mut b = hostile.numbers(matrix.pattern().unknowns());
        let solved = cholesky.solve(&mut b);
        assert!(factored.is_ok() || solved.is_err());
    });
}

#[test]
fn patterns_of_ones_own() {
    check(|hostile| {
        let mut starts: Vec<usize> = (0..hostile.0.below(5)).map(|_| hostile.node(4)).collect();
        if hostile.0.once_in(2) {
            starts.sort_unstable();
        }
        let rows: Vec<usize> = (0..hostile.0.below(6)).map(|_| hostile.node(4)).collect();
        if let Ok(mut cholesky) = Cholesky::new(&starts, &rows) {
            let mut b = hostile.numbers(starts.len() - 1);
            let _ = cholesky.factor(&vec![1.0; hostile.length(rows.len())]);
            let _ = cholesky.solve(&mut b);
        }
    });
}

#[test]
fn bodies() {
    check(|hostile| {
        let mesh = hostile.mesh();
        let _ = Body::new(&mesh, hostile.rubber(), hostile.about(1e3));
        let parts = (0..hostile.0.below(3)).map(|_| Part {
            group: (!hostile.0.once_in(2)).then(|| hostile.one_of(&["half", "other"]).to_owned()),
            material: Box::new(hostile.rubber()),
            density: hostile.about(1e3),
        });
        let parts = parts.collect();
        let Ok(mut body) = Body::from_parts(&mesh, parts) else { return };
        let positions = hostile.points(body.rest());
        let mut product = hostile.points(body.rest());
        let _ = Pattern::new(hostile.node(9), body.elements(), &Pins::none());
        let mut response = ElasticResponse::new(&body);
        let _ = response.energy(&body, &positions);
        let _ = response.gradient(&body, &positions, &mut product);
        if let Ok(mut matrix) = BlockMatrix::of_body(&body, &hostile.pins(body.rest().len())) {
            let _ = response.stiffness(&body, &positions, Filter::Clamp, &mut product, &mut matrix);
        }
        let _ = response.gradient_here(&body, &mut product);
        if let Ok(mut matrix) = NodalStiffness::of_body(&body) {
            let _ = response.stiffness_here(&body, Filter::Clamp, &mut product, &mut matrix);
        }
        let _ = response.difference_noise(&body);
        let pinned = [hostile.node(body.rest().len()), 1];
        if let Ok(mut steps) = StagedSteps::new(Integrator::Sdirk2, body.rest(), &pinned) {
            let _ = steps.set_positions(&positions);
            let _ = steps.set_velocities(&product);
            let _ = steps.set_accelerations(&positions);
            let _ = steps.prescribe(1, hostile.point());
            let _ = steps.begin(hostile.number());
            let _ = steps.begin_stage(0);
        }
        let _ = body.set_material(hostile.node(2), hostile.rubber());
    });
}
