//! The nodes in frame 0.

use piola::__private::random::Random;
use piola_bodies::system::Pins;

use crate::geometry::Geometry;
use crate::measure;
use crate::scene::{Amplitude, Start};
use crate::settings::Settings;

/// Positions of the nodes before the first step, m; pinned ones are at rest.
#[must_use]
pub fn start_positions(settings: &Settings, geometry: &Geometry, pins: &Pins) -> Vec<[f64; 3]> {
    let mesh = &geometry.mesh;
    let bounds = mesh.bounds();
    let middle: [f64; 3] = std::array::from_fn(|i| 0.5 * (bounds.min[i] + bounds.max[i]));
    let mut positions = match settings.start {
        Start::Rest => mesh.positions.clone(),
        Start::Flattened => {
            // The cage of tetrahedra reaches below the surface, and the ground lies under the surface.
            let heights = geometry.surface_at(&mesh.positions).into_iter().map(|vertex| f64::from(vertex[1]));
            let ground = heights.fold(f64::INFINITY, f64::min);
            mesh.positions.iter().map(|&[x, _, z]| [x, ground, z]).collect()
        }
        Start::Scrambled { seed, amplitude } => {
            // Three numbers for each node, pinned or not: what is pinned does not move the others elsewhere.
            let mut random = Random::new(seed);
            let edge = measure::mean_edge_length(&mesh.positions, &mesh.tets);
            let mut coordinate = |rest: f64, low: f64, high: f64| match amplitude {
                Amplitude::Edges(number) => rest + edge * random.uniform(-number, number),
                Amplitude::Box => random.uniform(low, high),
            };
            let mut place =
                |rest: [f64; 3]| std::array::from_fn(|i| coordinate(rest[i], bounds.min[i], bounds.max[i]));
            mesh.positions.iter().map(|&rest| place(rest)).collect()
        }
        Start::Mirrored => {
            let mirrored = |rest: &[f64; 3]| std::array::from_fn(|i| 2.0 * middle[i] - rest[i]);
            mesh.positions.iter().map(mirrored).collect()
        }
        Start::Collapsed => vec![middle; mesh.positions.len()],
    };
    for &node in pins.nodes() {
        positions[node] = mesh.positions[node];
    }
    positions
}

#[cfg(test)]
mod tests {
    use piola_bodies::mesh::TetMesh;

    use super::*;
    use crate::scene::{Body, SCRAMBLE};

    fn scrambled(seed: u64, amplitude: Amplitude, pins: &Pins) -> (TetMesh, Vec<[f64; 3]>) {
        let start = Start::Scrambled { seed, amplitude };
        let settings = Settings { body: Body::DINOSAUR, start, ..Settings::new(&SCRAMBLE) };
        let geometry = Geometry::load(&settings).expect("a body of the program");
        let positions = start_positions(&settings, &geometry, pins);
        (geometry.mesh, positions)
    }

    #[test]
    fn a_seed_gives_the_same_start_forever() {
        let (TetMesh { positions: rest, tets, .. }, start) =
            scrambled(1, Amplitude::Edges(0.3), &Pins::none());
        let moved: [f64; 3] = std::array::from_fn(|i| start[0][i] - rest[0][i]);
        // The first three numbers of SplitMix64 for the seed 1, by 0.3 mean edge lengths.
        let edge = measure::mean_edge_length(&rest, &tets);
        let expected =
            [0.1331231503445618, 0.49156351452540226, 0.9420055071735924].map(|share| 0.3 * edge * share);
        // A few roundings of coordinates below 1 m.
        assert!((0..3).all(|i| (moved[i] - expected[i]).abs() < 1e-15), "{moved:?} {expected:?}");
        assert_ne!(start, scrambled(2, Amplitude::Edges(0.3), &Pins::none()).1);
    }

    #[test]
    fn pins_hold_their_nodes_and_move_no_others() {
        let (mesh, free) = scrambled(5, Amplitude::Box, &Pins::none());
        let (_, mut pinned) = scrambled(5, Amplitude::Box, &Pins::at([3]));
        assert_eq!(pinned[3], mesh.positions[3]);
        pinned[3] = free[3];
        assert_eq!(pinned, free);
    }
}
