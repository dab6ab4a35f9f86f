//! Functions of bodies and batches that return a `Result` do so whatever they are given: wrong lengths, NaN,
//! infinities, the ends of the range, nodes that are missing, repeated, or more than any memory holds.
//!
//! `tests/tidy` sees to it that none of these functions is left out.
#![cfg(feature = "bodies")]

use std::panic::{AssertUnwindSafe, catch_unwind};

use piola::batch::{Batch, FACTORS, Layout, PointBatch, Quadrature, REST, Tetrahedra};
use piola::mesh::{
    Anchor, Bounds, Embedding, Group, NodeLines, Surface, TetLines, TetMesh, parse_msh, parse_surface_obj,
    read_msh, read_surface_obj, read_tetgen, tetrahedral_box,
};
use piola::point::Filter;
use piola::point::measures::Measure;
use piola::random::Random;
use piola::step::{
    Damping, Equilibrium, Filtering, InitialGuess, Integrator, LineSearchSettings, LinearSolver, NewtonError,
    NewtonSettings, NodeBlocks, Simulation, SimulationSettings, SparseSolver, Spring, StagedSteps,
    StepEquation, StepStart, Term, solve_step,
};
use piola::system::{
    BlockMatrix, Body, Cholesky, CsrPlaces, DiscreteGradient, ElasticResponse, LinearError, LowerTriangle,
    NodalStiffness, Part, Pattern, Pins, StiffnessOperator,
};
use piola::{Inversion, StatusCell, material};

/// Neo-Hookean solid.
#[material(domain(J > 0.0), extend)]
fn Rubber(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Pa. */
    lambda: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

/// Runs of each test, each with arguments of its own.
const SEEDS: u64 = 2000;

/// Numbers at which something ends.
const ENDS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    1e200,
    1e-200,
    f64::MIN_POSITIVE,
    5e-324,
    1e100,
    -1e-100,
    f64::EPSILON,
];

/// Numbers of nodes and cells that no address space holds.
const TOO_MANY: [usize; 4] = [1 << 48, 1 << 60, usize::MAX / 2, usize::MAX];

/// Calls a function with arguments of many seeds.
#[track_caller]
fn check(mut call: impl FnMut(&mut Hostile)) {
    for seed in 0..SEEDS {
        let mut hostile = Hostile(Random::new(seed));
        assert!(catch_unwind(AssertUnwindSafe(|| call(&mut hostile))).is_ok(), "panic with seed {seed}");
    }
}

/// A source of arguments, good ones among them, so that each check is passed now and then.
struct Hostile(Random);

impl Hostile {
    fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.0.below(choices.len())]
    }

    fn number(&mut self) -> f64 {
        if self.0.once_in(4) { self.one_of(&ENDS) } else { self.0.uniform(-2.0, 2.0) }
    }

    /// Mostly a good number.
    fn about(&mut self, good: f64) -> f64 {
        if self.0.once_in(8) { self.number() } else { good }
    }

    fn point(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.number())
    }

    /// Mostly this length.
    fn length(&mut self, good: usize) -> usize {
        match self.0.below(6) {
            0 => self.0.below(2 * good + 2),
            1 => good.saturating_sub(1),
            _ => good,
        }
    }

    fn numbers(&mut self, good: usize) -> Vec<f64> {
        let all_good = self.0.once_in(2);
        (0..self.length(good))
            .map(|_| if all_good { self.0.uniform(0.5, 2.0) } else { self.number() })
            .collect()
    }

    fn points(&mut self, good: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut points = good.to_vec();
        points.resize(self.length(good.len()), [0.5; 3]);
        if self.0.once_in(2) && !points.is_empty() {
            let node = self.0.below(points.len());
            points[node] = self.point();
        }
        points
    }

    /// Mostly a node that exists.
    fn node(&mut self, nodes: usize) -> usize {
        match self.0.below(12) {
            0 => self.one_of(&TOO_MANY),
            1 => nodes,
            _ => self.0.below(nodes.clamp(1, 1000)),
        }
    }

    fn pins(&mut self, nodes: usize) -> Pins {
        let count = self.0.below(6);
        let mut of =
            |_| if self.0.once_in(10) { self.node(nodes) } else { self.0.below(nodes.clamp(1, 1000)) };
        Pins::at((0..count).map(&mut of).collect::<Vec<_>>())
    }

    /// A small box in which something may be wrong.
    fn mesh(&mut self) -> TetMesh {
        let mut mesh = tetrahedral_box([2, 1, 1], [2.0, 1.0, 1.0]).expect("a box");
        let nodes = mesh.positions.len();
        if self.0.once_in(3) {
            mesh.positions = self.points(&mesh.positions.clone());
        }
        if self.0.once_in(4) {
            let (tet, corner) = (self.0.below(mesh.tets.len()), self.0.below(4));
            mesh.tets[tet][corner] = self.node(nodes);
        }
        if self.0.once_in(8) {
            let tet = self.0.below(mesh.tets.len());
            mesh.tets.push(mesh.tets[tet]);
        }
        if self.0.once_in(16) {
            mesh.tets.clear();
        }
        if self.0.once_in(4) {
            let scale = self.one_of(&[1e-160, 1e-103, 1e-90, 1e90, 1e103, 1e160]);
            mesh.positions.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
        }
        mesh.tags = (0..self.length(mesh.tets.len())).collect();
        mesh.groups = vec![Group {
            name: "half".to_owned(),
            dimension: self.0.below(4),
            nodes: vec![self.node(nodes), self.node(nodes)],
            tets: (0..3).map(|_| self.node(mesh.tets.len())).collect(),
        }];
        mesh
    }

    fn rubber(&mut self) -> Rubber {
        let mu = if self.0.once_in(8) { self.one_of(&[1e-300, 1e300, 1e150]) } else { 1e5 };
        let rubber = Rubber::new(mu, 4.0 * mu).expect("positive moduli");
        let inversion = match self.0.below(3) {
            0 => Inversion::Refuse,
            1 => Inversion::Extend { epsilon: 0.1 },
            _ => Inversion::Extend { epsilon: self.one_of(&[5e-324, 1e-100, 1.0 - f64::EPSILON]) },
        };
        rubber.with_inversion(inversion).expect("a threshold between 0 and 1")
    }

    fn settings(&mut self) -> SimulationSettings {
        let linear = match self.0.below(4) {
            0 => LinearSolver::Automatic,
            1 => LinearSolver::Cholesky,
            2 => LinearSolver::RefinedCholesky { tolerance: self.about(1e-6) },
            _ => LinearSolver::ConjugateGradients {
                tolerance: self.about(1e-3),
                max_iterations: self.one_of(&[0, 1, 100]),
            },
        };
        let filtering = match self.0.below(3) {
            0 => Filtering::OnDemand,
            1 => Filtering::Always(self.one_of(&[Filter::None, Filter::Clamp, Filter::Absolute])),
            _ => Filtering::TrustRegion { tolerance: self.about(0.01) },
        };
        let damping = match self.0.below(3) {
            0 => Damping::None,
            1 => Damping::Mass { rate: self.about(1.0) },
            _ => Damping::Stiffness { time: self.about(1e-3) },
        };
        let newton = NewtonSettings::default()
            .with_linear(linear)
            .with_filtering(filtering)
            .with_start(self.one_of(&[InitialGuess::Position, InitialGuess::Velocity]))
            .with_tolerance(self.about(1e-6))
            .with_max_iterations(self.one_of(&[1, 5, 50]));
        let line_search = LineSearchSettings::default()
            .with_sufficient_decrease(self.about(1e-4))
            .with_shrink(self.about(0.5))
            .with_max_trials(self.one_of(&[0, 1, 48, 48]));
        let integrator = match self.0.below(6) {
            0 => Integrator::Sdirk2,
            1 => Integrator::Sdirk3,
            2 => Integrator::ImplicitMidpoint,
            3 => Integrator::Newmark,
            4 => Integrator::GeneralizedAlpha { spectral_radius: self.about(0.8) },
            _ => Integrator::ImplicitEuler,
        };
        SimulationSettings::default()
            .with_integrator(integrator)
            .with_gravity([self.about(0.0), self.about(-9.81), self.about(0.0)])
            .with_damping(damping)
            .with_newton(newton)
            .with_line_search(line_search)
    }
}

#[test]
fn meshes_and_embeddings() {
    check(|hostile| {
        let mesh = hostile.mesh();
        let _ = mesh.rest_shapes();
        let _ = (mesh.connected_components(), mesh.unused_nodes(), mesh.bounds(), mesh.tag(usize::MAX));
        let _ = mesh.clone().without_unused_nodes();
        let _ = Pins::in_box(&mesh, Bounds { min: hostile.point(), max: hostile.point() });
        let _ = Pins::of_group(&mesh, hostile.one_of(&["half", "", "\u{1b}"]));
        let good = [[0.5, 0.5, 0.5], [1.0, 0.0, 0.0], [2.01, 0.5, 0.5]];
        let surface = Surface { positions: hostile.points(&good), triangles: vec![[usize::MAX; 3]] };
        let tolerance = hostile.about(0.1);
        if let Ok(embedding) = Embedding::new(&mesh, &surface, tolerance) {
            let weights = embedding.anchors().iter().flat_map(|anchor| anchor.weights);
            assert!(tolerance > 1e50 || weights.into_iter().all(f64::is_finite), "{tolerance:e}");
        }
        let cells = [(); 3].map(|()| hostile.one_of(&[0, 1, 2, 3, 1 << 46, usize::MAX]));
        let _ = tetrahedral_box(cells, hostile.point());
    });
}

#[test]
fn files() {
    let msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n\
               $Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let lines = ["4 3 1 1", "1 0.5 0 1e3 7 -1 # a node", "2 4 1", "1 1 2 3 4 5"];
    check(|hostile| {
        for text in [msh, obj].into_iter().chain(lines) {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..hostile.0.below(4) {
                let at = hostile.0.below(bytes.len());
                let words: [&[u8]; 6] = [b"\xff\xfe", b"-", b"18446744073709551616", b"1e999", b"\n", b"\0"];
                let word = hostile.one_of(&words);
                bytes.splice(at..(at + hostile.0.below(3)).min(bytes.len()), word.iter().copied());
            }
            let text = String::from_utf8_lossy(&bytes);
            let _ = parse_msh(&text, "some.msh").map(|mesh| mesh.rest_shapes());
            let _ = parse_surface_obj(&text, "some.obj");
            let [nodes, tets] =
                [lines[0], lines[2]].map(|good| if hostile.0.once_in(2) { good } else { &text });
            let _ = NodeLines::of_first_line(nodes).and_then(|lines| lines.node(&text));
            let _ = TetLines::of_first_line(tets).and_then(|lines| lines.tet(&text));
        }
    });
    for path in ["", "/", "no/such/file", "\0"] {
        assert!(read_msh(path).is_err() && read_tetgen(path).is_err() && read_surface_obj(path).is_err());
    }
}

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
        if let Ok(mut cholesky) = Cholesky::<f32>::new(&starts, &rows) {
            let mut b: Vec<f32> = hostile.numbers(starts.len() - 1).iter().map(|&x| x as f32).collect();
            let _ = cholesky.factor(&vec![1.0; hostile.length(rows.len())]);
            let _ = cholesky.solve(&mut b);
        }
    });
}

#[test]
fn batches() {
    check(|hostile| {
        let (rubber, points) = (hostile.rubber(), hostile.one_of(&[0, 1, 8, 63, 64, 65]));
        let statuses: Vec<StatusCell> = (0..hostile.length(points)).map(|_| StatusCell::default()).collect();
        let mut batch = Batch::new(&rubber)
            .with_layout(hostile.one_of(&[Layout::Points, Layout::Lines]))
            .with_filter(hostile.one_of(&[Filter::None, Filter::Clamp, Filter::Absolute]))
            .with_streams(hostile.0.once_in(2))
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
        let mut packed = hostile.numbers(45 * points);
        let _ = batch.packed_tangents(&deformations, &mut nine, &mut packed);
        let mut factors = hostile.numbers(FACTORS * points);
        let _ = batch.factored_tangents(&deformations, &mut nine, &mut factors);
        let _ = batch.products(&factors, &deformations, &mut nine);
        let (rest, mut gradients) = (hostile.numbers(REST * points), hostile.numbers(12 * points));
        let [mut full, mut packed] = [144, 78].map(|size| hostile.numbers(size * points));
        let _ = batch.stiffnesses(&deformations, &rest, &mut gradients, &mut full);
        let _ = batch.packed_stiffnesses(&deformations, &rest, &mut gradients, &mut packed);
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
        let [mut full, mut packed] = [144, 78].map(|size| hostile.numbers(size * points));
        let _ = batch.stiffnesses_at(tetrahedra, &positions, &rest, &mut gradients, &mut full);
        let _ = batch.packed_stiffnesses_at(tetrahedra, &positions, &rest, &mut gradients, &mut packed);

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
fn batches_in_the_plane() {
    check(|hostile| {
        let (rubber, points) = (hostile.rubber(), hostile.one_of(&[0, 1, 63, 64, 65]));
        let statuses: Vec<StatusCell> = (0..hostile.length(points)).map(|_| StatusCell::default()).collect();
        let mut batch = PointBatch::new(&rubber)
            .with_filter(hostile.one_of(&[Filter::None, Filter::Clamp, Filter::Absolute]))
            .with_threads(hostile.0.once_in(2));
        if hostile.0.once_in(2) {
            batch = batch.with_statuses(&statuses);
        }
        let [deformations, axial] = [4, 1].map(|size| hostile.numbers(size * points));
        let [mut across, mut one, mut other] = [(); 3].map(|()| hostile.numbers(points));
        let [mut four, mut many] = [4, 16].map(|size| hostile.numbers(size * points));
        let _ = batch.plane_strains(&deformations, &mut four, &mut many);
        let _ = batch.plane_stresses(&deformations, &mut across, &mut four, &mut many);
        let _ = batch.uniaxial_stresses(&axial, &mut across, &mut one, &mut other);
        let [displacements, mut nine, mut all] = [9, 9, 81].map(|size| hostile.numbers(size * points));
        let _ = batch.energies_from_displacements(&displacements, &mut one);
        let _ = batch.stresses_from_displacements(&displacements, &mut nine);
        let _ = batch.tangents_from_displacements(&displacements, &mut nine, &mut all);
    });
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
        let mut stiffness = StiffnessOperator::new(&body);
        let positions = hostile.points(body.rest());
        let _ = stiffness.linearise(&body, &positions, Filter::Clamp);
        let mut product = hostile.points(body.rest());
        let _ = stiffness.multiply(&positions, &mut product);
        let mut blocks = vec![[[0.0; 3]; 3]; hostile.length(body.rest().len())];
        let _ = stiffness.diagonal_blocks(&mut blocks);
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
        let mut between = DiscreteGradient::new(&body);
        let _ = between.begin(&body, &positions);
        let _ = between.evaluate(&body, &product);
        let _ = between.linearise(&body);
        let _ = between.add_gradient(&body, &mut product);
        assert_eq!(between.tangents(&body).count(), body.elements().len());
        let integrator = Integrator::GeneralizedAlpha { spectral_radius: hostile.number() };
        if let Ok(mut steps) = StagedSteps::new(integrator, body.rest()) {
            let _ = steps.set_state(&positions, &product);
            let _ = steps.set_accelerations(&positions);
        }
        let _ = body.set_material(hostile.node(2), hostile.rubber());
    });
}

/// A term of hostile numbers: it refuses, it is not finite, it names nodes that are missing or share no
/// element.
struct Nonsense {
    energy: Option<f64>,
    force: [f64; 3],
    nodes: [usize; 2],
    block: [[f64; 3]; 3],
    longest: f64,
}

impl Term for Nonsense {
    fn energy(&self, _: &[[f64; 3]]) -> Option<f64> {
        self.energy
    }

    fn add_gradient(&self, _: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        (0..3).for_each(|c| gradient[0][c] += self.force[c]);
    }

    fn add_second_derivatives(&self, _: &[[f64; 3]], blocks: &mut NodeBlocks) {
        blocks.add(self.nodes[0], self.nodes[1], self.block);
    }

    fn longest_step(&self, _: &[[f64; 3]], _: &[[f64; 3]]) -> f64 {
        self.longest
    }
}

/// A solver that fails, or answers with hostile numbers.
#[derive(Clone)]
struct Wrong {
    error: Option<LinearError>,
    x: f64,
}

impl SparseSolver for Wrong {
    fn solve(&mut self, _: LowerTriangle<'_>, b: &mut [f64], _: f64) -> Result<usize, LinearError> {
        self.error.map_or(Ok(0), Err)?;
        b.fill(self.x);
        Ok(0)
    }
}

/// An equation that answers with hostile numbers.
struct Nowhere<'a>(&'a mut Hostile);

impl Nowhere<'_> {
    fn number(&mut self, good: f64) -> Result<f64, NewtonError> {
        if self.0.0.once_in(8) { Err(NewtonError::NotFinite) } else { Ok(self.0.about(good)) }
    }
}

impl StepEquation for Nowhere<'_> {
    type Jacobian = ();
    type Error = NewtonError;

    fn start(&mut self, share: f64, start: StepStart) -> Result<f64, NewtonError> {
        let [before, ahead, kept] = [(); 3].map(|()| self.0.point());
        let _ = start.position(share, before, ahead, kept);
        self.number(1.0)
    }

    fn linearise(&mut self) -> Result<(), NewtonError> {
        self.number(0.0).map(|_| ())
    }

    fn correct(&mut self, (): &()) -> Result<f64, NewtonError> {
        self.number(0.5)
    }

    fn take_direction(&mut self) -> f64 {
        self.0.about(1.0)
    }

    fn try_step(&mut self, _: f64) -> Result<Option<f64>, NewtonError> {
        let refuses = self.0.0.once_in(8);
        self.number(0.5).map(|residual| (!refuses).then_some(residual))
    }

    fn accept(&mut self) {}

    fn keep_solution(&mut self) {}
}

#[test]
fn equations() {
    let mut solved = 0;
    check(|hostile| {
        let SimulationSettings { newton, line_search, .. } = hostile.settings();
        if let Ok(report) = solve_step(&mut Nowhere(hostile), &newton, &line_search) {
            assert!(report.residual.is_finite(), "{report:?}");
            solved += 1;
        }
    });
    assert!(solved > 0, "no equation counts as solved");
}

/// A step that succeeds leaves numbers behind.
#[test]
fn simulations() {
    let mut steps = 0;
    check(|hostile| {
        let mut mesh = tetrahedral_box([2, 1, 1], [2.0, 1.0, 1.0]).expect("a box");
        let scale = if hostile.0.once_in(4) { hostile.one_of(&[1e-100, 1e-50, 1e50, 1e100]) } else { 1.0 };
        mesh.positions.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
        let density = hostile.about(1e3);
        let Ok(body) = Body::new(&mesh, hostile.rubber(), density) else { return };
        let nodes = body.rest().len();
        let (pins, settings) = (hostile.pins(nodes), hostile.settings());
        let Ok(mut simulation) = Simulation::new(body, &pins, settings) else { return };
        for _ in 0..4 {
            let _ = match hostile.0.below(12) {
                5 => simulation.set_accelerations(&hostile.points(&mesh.positions)),
                6 => simulation.set_forces(&hostile.points(&vec![[0.0; 3]; nodes])),
                7 => simulation.set_pins(&hostile.pins(nodes)),
                8 => {
                    let _ = simulation.set_material(hostile.node(1), hostile.rubber());
                    Ok(())
                }
                9 => {
                    simulation.set_terms(vec![std::sync::Arc::new(Nonsense {
                        energy: (!hostile.0.once_in(8)).then(|| hostile.about(0.0)),
                        force: [(); 3].map(|()| hostile.about(0.0)),
                        nodes: [(); 2].map(|()| hostile.node(nodes)),
                        block: [(); 3].map(|()| [(); 3].map(|()| hostile.about(0.0))),
                        longest: hostile.about(1.0),
                    })]);
                    Ok(())
                }
                10 => {
                    let error = hostile.one_of(&[
                        None,
                        Some(LinearError::NotPositive { column: usize::MAX }),
                        Some(LinearError::NotFactored),
                    ]);
                    simulation.set_linear_solver(Wrong { error, x: hostile.about(0.0) })
                }
                0 => simulation.set_positions(&hostile.points(&mesh.positions)),
                1 => simulation.set_velocities(&hostile.points(&mesh.positions)),
                2 => simulation.prescribe(hostile.node(nodes), hostile.point()),
                3 => simulation.set_settings(hostile.settings()),
                _ => simulation.set_springs(&[Spring {
                    anchor: Anchor {
                        nodes: mesh.tets[0]
                            .map(|node| if hostile.0.once_in(8) { hostile.node(nodes) } else { node }),
                        weights: [(); 4].map(|()| hostile.about(0.25)),
                    },
                    target: hostile.point(),
                    stiffness: hostile.about(1e3),
                }]),
            };
        }
        let dt = hostile.about(0.01);
        let stepped = match hostile.0.below(6) {
            0 | 1 => simulation.equilibrate(),
            2 => simulation.advance_within(dt, hostile.about(0.1)).map(|report| report.step),
            _ => simulation.step(dt),
        };
        if stepped.is_ok() {
            steps += 1;
            let state = [simulation.positions(), simulation.velocities(), simulation.accelerations()];
            assert!(state.concat().as_flattened().iter().all(|x| x.is_finite()), "dt = {dt:e}: {state:?}");
        }
        let _ = simulation.reactions();
        if let Ok(Equilibrium { smallest_eigenvalue: Some(eigenvalue), .. }) = Equilibrium::of(&simulation) {
            assert!(eigenvalue.value.is_finite() && eigenvalue.error.is_finite(), "{eigenvalue:?}");
        }
    });
    assert!(steps > SEEDS / 20, "{steps} steps succeed");
}
