//! Boxes cut into tetrahedra: bodies of any size without a file.
//!
//! A cell is cut into six tetrahedra around its diagonal from the lowest to the highest corner, one for each
//! order in which a path along its edges can take the three axes \[Kuh60\]. Every face of a cell is then cut
//! from its lowest to its highest corner as well, in both of its cells: neighbours fit.
//!
//! \[Kuh60\] Kuhn, *Some Combinatorial Lemmas in Topology*, 1960; the same triangulation is Freudenthal's of
//! 1942.

use piola::__private::message::number;
use thiserror::Error;

use super::TetMesh;

/// Orders of the three axes, each with true if it is an odd permutation: its path turns the other way.
const PATHS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], false),
    ([1, 2, 0], false),
    ([2, 0, 1], false),
    ([0, 2, 1], true),
    ([2, 1, 0], true),
    ([1, 0, 2], true),
];

/// Meshes a box from the origin to `size`, m, with `cells` along each axis, each of six tetrahedra.
///
/// Nodes are numbered in layers across the axis with the most cells, and in a layer in rows across the axis
/// with the second most; tetrahedra follow the same order. The nodes of a tetrahedron are then as near in
/// memory as plain counting brings them. There are no groups: [`Pins::in_box`](crate::system::Pins::in_box)
/// finds a side.
///
/// ```
/// use piola_bodies::mesh::tetrahedral_box;
///
/// let beam = tetrahedral_box([10, 2, 2], [1.0, 0.2, 0.2])?;
/// assert_eq!((beam.positions.len(), beam.tets.len()), (11 * 3 * 3, 6 * 10 * 2 * 2));
/// let volume: f64 = beam.rest_shapes()?.iter().map(|shape| shape.volume).sum();
/// assert!((volume - 0.04).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BoxError`] for no cells, too many for the memory, or a length that is not positive and finite.
pub fn tetrahedral_box(cells: [usize; 3], size: [f64; 3]) -> Result<TetMesh, BoxError> {
    let [x, y, z] = cells;
    if cells.contains(&0) {
        return Err(BoxError(format!("a box of {x}×{y}×{z} cells is empty; each axis needs at least one")));
    }
    if !size.iter().all(|&length| length > 0.0 && length.is_finite()) {
        let [x, y, z] = size.map(number);
        return Err(BoxError(format!(
            "a box cannot measure {x} m × {y} m × {z} m; lengths must be positive and finite"
        )));
    }
    let nodes = product(cells.map(|n| n.checked_add(1)));
    let tets = product(cells.map(Some)).and_then(|cells| cells.checked_mul(PATHS.len()));
    let too_many = || BoxError(format!("a box of {x}×{y}×{z} cells does not fit into memory"));
    let (nodes, tets) = nodes.zip(tets).ok_or_else(too_many)?;
    let mut mesh = TetMesh::default();
    mesh.positions.try_reserve_exact(nodes).map_err(|_| too_many())?;
    mesh.tets.try_reserve_exact(tets).map_err(|_| too_many())?;

    let mut axes = [0, 1, 2];
    axes.sort_by_key(|&axis| std::cmp::Reverse(cells[axis]));
    let strides = strides(cells.map(|n| n + 1), axes);
    mesh.positions.extend(
        places(cells.map(|n| n + 1), axes)
            .map(|at| -> [f64; 3] { std::array::from_fn(|c| size[c] * (at[c] as f64 / cells[c] as f64)) }),
    );
    mesh.tets.extend(places(cells, axes).flat_map(|at| tetrahedra_of_cell(at, strides)));
    Ok(mesh)
}

/// The tetrahedra of a cell by the place of its lowest corner, and the distance in the numbering between two
/// neighbours along each axis.
#[doc(hidden)]
#[must_use]
pub fn tetrahedra_of_cell(at: [usize; 3], strides: [usize; 3]) -> [[usize; 4]; 6] {
    let lowest: usize = (0..3).map(|c| at[c] * strides[c]).sum();
    PATHS.map(|(path, is_odd)| {
        let mut tet = [lowest; 4];
        for (step, axis) in path.into_iter().enumerate() {
            tet[step + 1] = tet[step] + strides[axis];
        }
        if is_odd {
            tet.swap(1, 2);
        }
        tet
    })
}

fn product([x, y, z]: [Option<usize>; 3]) -> Option<usize> {
    x?.checked_mul(y?)?.checked_mul(z?)
}

/// Distance in the numbering between two neighbours along each axis.
fn strides(counts: [usize; 3], [slow, middle, fast]: [usize; 3]) -> [usize; 3] {
    let mut strides = [1; 3];
    strides[middle] = counts[fast];
    strides[slow] = counts[fast] * counts[middle];
    strides
}

/// The places of a grid in the order of their numbers.
fn places(counts: [usize; 3], axes: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let (strides, [x, y, z]) = (strides(counts, axes), counts);
    (0..x * y * z).map(move |number| std::array::from_fn(|axis| number / strides[axis] % counts[axis]))
}

/// Reason why a box cannot be meshed, in words.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct BoxError(String);

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::mesh::Bounds;

    const CELLS: [usize; 3] = [3, 5, 4];
    const SIZE: [f64; 3] = [0.7, 1.1, 0.3];

    fn example() -> TetMesh {
        tetrahedral_box(CELLS, SIZE).expect("a box")
    }

    #[test]
    fn it_fills_the_box_with_positive_tetrahedra() {
        let mesh = example();
        assert_eq!(mesh.bounds(), Bounds { min: [0.0; 3], max: SIZE });
        // An error would name a tetrahedron that is not positive, or an unused node.
        let shapes = mesh.rest_shapes().expect("a body");
        let volume: f64 = shapes.iter().map(|shape| shape.volume).sum();
        let expected = SIZE.iter().product::<f64>();
        // A sum of 360 terms, each of edges with a rounding error of u of the size of the box.
        assert!((volume - expected).abs() <= 360.0 * f64::EPSILON * expected, "{volume} for {expected}");
        for shape in shapes {
            // All are a sixth of a cell; the rounding of a coordinate is u times the whole box, five cells
            // long.
            let cell = expected / 360.0;
            assert!((shape.volume - cell).abs() <= 64.0 * f64::EPSILON * cell, "{} for {cell}", shape.volume);
        }
    }

    #[test]
    fn inner_faces_have_two_sides_and_the_others_are_on_the_surface() {
        let mesh = example();
        let mut faces = HashMap::new();
        for tet in &mesh.tets {
            // The face opposite each corner, seen from outside.
            for [i, j, k] in [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]] {
                let face = [tet[i], tet[j], tet[k]];
                let mut sorted = face;
                sorted.sort_unstable();
                faces.entry(sorted).or_insert_with(Vec::new).push(face);
            }
        }
        for sides in faces.values() {
            match sides[..] {
                [face] => {
                    let corners = face.map(|node| mesh.positions[node]);
                    let is_on_side = |axis: usize, at: f64| corners.iter().all(|x| x[axis] == at);
                    let mut axes = 0..3;
                    assert!(axes.any(|axis| is_on_side(axis, 0.0) || is_on_side(axis, SIZE[axis])));
                }
                [one, other] => {
                    let start = other.iter().position(|&node| node == one[0]).expect("the same nodes");
                    // The two tetrahedra see the face from opposite sides.
                    assert_eq!(one, [other[start], other[(start + 2) % 3], other[(start + 1) % 3]]);
                }
                _ => panic!("a face with {} sides", sides.len()),
            }
        }
    }

    #[test]
    fn neighbours_are_at_most_a_layer_apart_whichever_axis_is_long() {
        for cells in [[2, 3, 20], [20, 2, 3], [3, 20, 2]] {
            let mesh = tetrahedral_box(cells, [1.0; 3]).expect("a box");
            let spread =
                |tet: &[usize; 4]| tet.iter().max().zip(tet.iter().min()).map(|(max, min)| max - min);
            // A layer of 3×4 nodes, a row of 3, and one.
            assert_eq!(mesh.tets.iter().filter_map(spread).max(), Some(12 + 3 + 1));
        }
    }

    #[test]
    fn boxes_that_cannot_be_are_errors() {
        let message = |cells, size| tetrahedral_box(cells, size).expect_err("not a box").to_string();
        assert_eq!(message([2, 0, 1], SIZE), "a box of 2×0×1 cells is empty; each axis needs at least one");
        for (length, text) in [(0.0, "0"), (-1.0, "-1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
            let expected =
                format!("a box cannot measure 1 m × {text} m × 1 m; lengths must be positive and finite");
            assert_eq!(message(CELLS, [1.0, length, 1.0]), expected);
        }
        let many = usize::MAX;
        for cells in [[many, 1, 1], [many - 1, 1, 1], [1 << 22; 3], [1 << 20; 3]] {
            assert!(message(cells, SIZE).ends_with(" cells does not fit into memory"), "{cells:?}");
        }
    }
}
