//! A bar of linear tetrahedra, bent out of shape.

/// Linear tetrahedra with the positions of their nodes.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Positions of the nodes now, m.
    pub positions: Vec<[f32; 3]>,
    /// Four nodes of each element.
    pub corners: Vec<[u32; 4]>,
    /// Dm⁻¹ row by row, 1/m, and the volume, m³, of each element.
    pub rest: Vec<[f32; 10]>,
}

/// A bar with `cells` cubes along its axes, five tetrahedra each, stretched, twisted about its first axis,
/// and waved so that each element has another deformation gradient. All J are positive.
#[must_use]
pub fn bar(cells: [usize; 3]) -> Mesh {
    let counts @ [nx, ny, _] = cells.map(|count| count + 1);
    let size = 1.0 / cells[0] as f64;
    let place = |node| grid(node, counts).map(|count| count as f64 * size);
    let at_rest: Vec<[f64; 3]> = (0..counts.iter().product::<usize>()).map(place).collect();
    // A cube is cut into a tetrahedron in the middle and one at each corner that this leaves; neighbours are
    // mirror images, whose faces fit, and whose corners have the other order.
    const CUT: [[usize; 4]; 5] = [[0, 3, 6, 5], [1, 3, 0, 5], [2, 0, 3, 6], [4, 0, 6, 5], [7, 3, 5, 6]];
    let mut mesh = Mesh { positions: Vec::new(), corners: Vec::new(), rest: Vec::new() };
    for [x, y, z] in (0..cells.iter().product::<usize>()).map(|cell| grid(cell, cells)) {
        let mirror = (x + y + z) % 2;
        for tetrahedron in CUT {
            let mut corners = tetrahedron.map(|corner| {
                let [x, y, z] = [x + ((corner & 1) ^ mirror), y + (corner >> 1 & 1), z + (corner >> 2)];
                (z * ny + y) * nx + x
            });
            if mirror == 1 {
                corners.swap(2, 3);
            }
            mesh.corners.push(corners.map(|corner| corner as u32));
            mesh.rest.push(rest_shape(corners.map(|corner| at_rest[corner])).map(|x| x as f32));
        }
    }
    let middle = [cells[1], cells[2]].map(|count| count as f64 * size / 2.0);
    mesh.positions.extend(at_rest.into_iter().map(|at| deformed(at, middle).map(|x| x as f32)));
    mesh
}

/// Place of a number in a grid, along each axis.
fn grid(number: usize, [nx, ny, _]: [usize; 3]) -> [usize; 3] {
    [number % nx, number / nx % ny, number / (nx * ny)]
}

/// Deformed position of a point of the bar: half of a turn over its length, a stretch between 0.5 and 1.5
/// along it, and one between 0.6 and 1.4 across.
fn deformed([x, y, z]: [f64; 3], middle: [f64; 2]) -> [f64; 3] {
    use std::f64::consts::PI;
    let across = 1.0 + 0.4 * (4.0 * PI * x).cos();
    let [y, z] = [y - middle[0], z - middle[1]].map(|x| x * across);
    let (sin, cos) = (PI * x).sin_cos();
    let along = x + 0.5 / (6.0 * PI) * (6.0 * PI * x).sin();
    [along + 0.05 * (9.0 * y).sin() * z, cos * y - sin * z, sin * y + cos * z]
}

/// Dm⁻¹ row by row and the volume, from the corners: the columns of Dm are the edges from the first one.
fn rest_shape(corners: [[f64; 3]; 4]) -> [f64; 10] {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let [a, b, c] = [1, 2, 3].map(|k| [0, 1, 2].map(|i| corners[k][i] - corners[0][i]));
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant: f64 = (0..3).map(|i| a[i] * rows[0][i]).sum();
    std::array::from_fn(|k| if k < 9 { rows[k / 3][k % 3] / determinant } else { determinant / 6.0 })
}
