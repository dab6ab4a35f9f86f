//! Batches of points and of elements.

use piola::StatusCell;
use piola::batch::{Batch, CsrPlaces, Layout, Quadrature, REST, Tetrahedra};
use piola::point::Filter;
use piola::point::measures::Measure;

use crate::arguments::{SEEDS, check};

#[test]
fn batches() {
    check(|hostile| {
        let (rubber, points) = (hostile.rubber(), hostile.one_of(&[0, 1, 8, 63, 64, 65]));
        let statuses: Vec<StatusCell> = (0..hostile.length(points)).map(|_| StatusCell::default()).collect();
        let mut batch = Batch::new(&rubber)
            .with_layout(hostile.one_of(&[Layout::Points, Layout::Lines]))
            .with_filter(hostile.one_of(&[Filter::None, Filter::Clamp, Filter::Absolute]))
            .with_threads(hostile.0.once_in(2));
        if hostile.0.once_in(2) {
            batch = batch.with_statuses(&statuses);
        }
        let deformations = hostile.numbers(9 * points);
        let [mut one, mut nine, mut many] = [1, 9, 81].map(|size| hostile.numbers(size * points));
        let _ = batch.energies(&deformations, &mut one);
        let _ = batch.stresses(&deformations, &mut nine);
        let _ = batch.tangents(&deformations, &mut nine, &mut many);
        let _ = batch.energies_and_tangents(&deformations, &mut one, &mut nine, &mut many);
        let (rest, mut gradients) = (hostile.numbers(REST * points), hostile.numbers(12 * points));
        let mut full = hostile.numbers(144 * points);
        let _ = batch.stiffnesses(&deformations, &rest, &mut gradients, &mut full);
        let [mut six, mut tangents] = [6, 36].map(|size| hostile.numbers(size * points));
        let measure = hostile.one_of(&Measure::ALL);
        let _ = batch.measured_stresses(measure, &deformations, &mut six);
        let _ = batch.measured_tangents(measure, &deformations, &mut six, &mut tangents);
    });
}

#[test]
fn tetrahedra_of_ones_own() {
    let mut added = 0;
    check(|hostile| {
        let (rubber, count, nodes) =
            (hostile.rubber(), hostile.one_of(&[0_usize, 1, 8, 65]), hostile.node(9));
        let corners: Vec<[usize; 4]> = (0..count).map(|_| [(); 4].map(|()| hostile.0.below(9))).collect();
        let Ok(tetrahedra) = Tetrahedra::new(nodes, &corners) else { return };
        let layout = hostile.one_of(&[Layout::Points, Layout::Lines]);
        let batch = Batch::new(&rubber).with_layout(layout).with_threads(hostile.0.once_in(2));
        let points = if layout == Layout::Lines { count.next_multiple_of(8) } else { count };
        let positions = hostile.points(&vec![[0.5; 3]; nodes.min(20)]);
        let (rest, mut gradients) = (hostile.numbers(REST * points), hostile.numbers(12 * points));
        let mut full = hostile.numbers(144 * points);
        let _ = batch.stiffnesses_at(tetrahedra, &positions, &rest, &mut gradients, &mut full);

        let rows = hostile.length(3 * 9).min(100);
        let mut starts: Vec<i64> = (0..=rows as i64).map(|row| row * rows as i64).collect();
        let mut columns: Vec<i64> = (0..rows * rows).map(|at| (at % rows) as i64).collect();
        if hostile.0.once_in(4) && !columns.is_empty() {
            let (row, at) = (hostile.0.below(starts.len()), hostile.0.below(columns.len()));
            starts[row] = hostile.one_of(&[-1, 3, i64::MAX]);
            columns[at] = hostile.one_of(&[-1, 3, i64::MAX]);
        }
        let far = hostile.0.once_in(8);
        let unknowns = |node: usize| (node != 3).then_some(if far { usize::MAX - node } else { 3 * node });
        let Ok(places) = CsrPlaces::new(tetrahedra, unknowns, &starts, &columns) else { return };
        let mut values = vec![0.0; hostile.length(columns.len())];
        added += u64::from(places.add(&full, layout, &mut values).is_ok());
    });
    assert!(added > SEEDS / 20, "{added} sums succeed");
}

#[test]
fn elements_with_quadrature() {
    check(|hostile| {
        let (nodes, points) =
            (hostile.one_of(&[0, 1, 8, 10, usize::MAX]), hostile.one_of(&[0, 1, 3, usize::MAX]));
        let (count, unknowns, all) = (hostile.0.below(3), 3 * nodes.min(10), points.min(3));
        let mut elements = Quadrature::new(nodes, points);
        let [positions, mut gradients] = [(); 2].map(|()| hostile.numbers(unknowns * count));
        let [slopes, volumes, mut stresses, tangents] =
            [unknowns, 1, 9, 81].map(|size| hostile.numbers(size * all * count));
        let mut stiffnesses = hostile.numbers(unknowns * unknowns * count);
        let _ = elements.deform(&positions, &slopes, &mut stresses);
        let _ = elements.gradients(&slopes, &volumes, &stresses, &mut gradients);
        let _ = elements.stiffnesses(&slopes, &volumes, &tangents, &mut stiffnesses);
    });
}
