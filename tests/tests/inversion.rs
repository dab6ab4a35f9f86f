//! An extended energy restores a point: a free element, however collapsed or inverted, ends at a rotation of its rest shape.

use piola::Inversion;
use piola::material::Declared;
use piola::mesh::TetMesh;
use piola::point::svd;
use piola::step::{NewtonSettings, Settings, Simulation};
use piola::system::{Body, Pins};
use piola_materials::{ArrudaBoyce, Hencky, MooneyRivlinCoupled, NeoHookean, Ogden, Varga};

/// How many random deformation gradients each element starts from.
const STARTS: u64 = 60;

const EXTEND: Inversion = Inversion::Extend { epsilon: 0.1 };

const REST: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, 0.9, 0.0], [0.3, 0.2, 1.1]];

/// Entries uniform in −1 … 1, from SplitMix64.
fn random_matrix(seed: u64) -> [[f64; 3]; 3] {
    let mut state = seed;
    let mut uniform = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    std::array::from_fn(|_| std::array::from_fn(|_| uniform()))
}

fn times(matrix: &[[f64; 3]; 3], x: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2])
}

/// Minimises from F0 by long, damped time steps and returns the stretches at the end.
fn relax<M: Declared + Clone + 'static>(material: &M, start: &[[f64; 3]; 3]) -> [f64; 3] {
    let mesh = TetMesh::new(REST.to_vec(), vec![[0, 1, 2, 3]]);
    let body = Body::new(&mesh, material.clone(), 1.0).expect("a body");
    let settings = Settings { damping: 1.0, newton: NewtonSettings::default(), ..Settings::default() };
    let mut simulation = Simulation::new(body, &Pins::none(), settings).expect("a simulation");
    let positions = REST.map(|x| times(start, x));
    simulation.set_positions(&positions).expect("finite positions");
    for _ in 0..400 {
        simulation.step(1.0).expect("a step");
    }
    let elements = simulation.body().elements();
    let deformation = elements[0].deformation_gradient(simulation.positions());
    svd(&deformation).stretches
}

#[track_caller]
fn restores<M: Declared + Clone + 'static>(material: M) {
    for seed in 0..STARTS {
        let mut start = random_matrix(seed);
        // A third inverted as they come, a third collapsed nearly to a point, a third mirrored.
        match seed % 3 {
            0 => {}
            1 => start = start.map(|row| row.map(|x| 1e-3 * x)),
            _ => start[0] = start[0].map(|x| -x),
        }
        let stretches = relax(&material, &start);
        let distance = stretches.iter().fold(0.0f64, |worst, stretch| worst.max((stretch - 1.0).abs()));
        assert!(distance < 1e-6, "from {start:?} it ends at the stretches {stretches:?}");
    }
}

#[test]
fn neo_hookean() {
    restores(
        NeoHookean::new(1.0, 5.0).and_then(|material| material.with_inversion(EXTEND)).expect("admissible"),
    );
}

#[test]
fn ogden() {
    let material = Ogden::new([0.6, 0.1, -0.2], [1.3, 5.0, -2.0], 5.0);
    restores(material.and_then(|material| material.with_inversion(EXTEND)).expect("admissible"));
}

#[test]
fn hencky() {
    restores(Hencky::new(1.0, 5.0).and_then(|material| material.with_inversion(EXTEND)).expect("admissible"));
}

#[test]
fn varga() {
    restores(Varga::new(1.0, 5.0).and_then(|material| material.with_inversion(EXTEND)).expect("admissible"));
}

#[test]
fn mooney_rivlin_coupled() {
    let material = MooneyRivlinCoupled::new(0.4, 0.1, 5.0);
    restores(material.and_then(|material| material.with_inversion(EXTEND)).expect("admissible"));
}

#[test]
fn arruda_boyce() {
    let material = ArrudaBoyce::new(1.0, 3.0, 5.0);
    restores(material.and_then(|material| material.with_inversion(EXTEND)).expect("admissible"));
}
