//! A depth buffer: the triangle that is visible at each pixel.

use super::camera::Camera;
use super::{Surface, Vector};

/// Nothing is seen.
pub(super) const NOTHING: u32 = u32::MAX;

/// Nearest triangle and its nearness for each pixel, row by row from the top.
#[derive(Clone, Debug)]
pub(super) struct DepthBuffer {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) nearness: Vec<f32>,
    pub(super) triangle: Vec<u32>,
}

impl DepthBuffer {
    /// The surface as it appears to `camera` through width × height pixels.
    pub(super) fn of(surface: Surface<'_>, camera: &Camera, width: usize, height: usize) -> Self {
        let mut buffer = Self {
            width,
            height,
            nearness: vec![f32::NEG_INFINITY; width * height],
            triangle: vec![NOTHING; width * height],
        };
        let projected: Vec<_> =
            surface.vertices.iter().map(|&vertex| camera.project(Vector::from(vertex))).collect();
        for (index, triangle) in surface.triangles.iter().enumerate() {
            buffer.draw(index as u32, triangle.map(|vertex| projected[vertex as usize]));
        }
        buffer
    }

    /// Draws one triangle, given by image coordinates and nearness of its corners.
    fn draw(&mut self, index: u32, [a, b, c]: [[f32; 3]; 3]) {
        let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        // Edge-on triangles cover nothing; what is not finite has no place in the picture.
        if !(twice_area.is_finite() && twice_area != 0.0) {
            return;
        }
        let first = |low: f32| (low - 0.5).ceil().max(0.0) as usize;
        let past = |high: f32, size: usize| ((high + 0.5).floor().max(0.0) as usize).min(size);
        let columns = first(a[0].min(b[0]).min(c[0]))..past(a[0].max(b[0]).max(c[0]), self.width);
        let rows = first(a[1].min(b[1]).min(c[1]))..past(a[1].max(b[1]).max(c[1]), self.height);
        for row in rows {
            let y = row as f32 + 0.5;
            for column in columns.clone() {
                let x = column as f32 + 0.5;
                let share = |p: [f32; 3], q: [f32; 3]| {
                    ((p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y)) / twice_area
                };
                let [alpha, beta, gamma] = [share(b, c), share(c, a), share(a, b)];
                if alpha < 0.0 || beta < 0.0 || gamma < 0.0 {
                    continue;
                }
                let nearness = alpha * a[2] + beta * b[2] + gamma * c[2];
                let pixel = row * self.width + column;
                if nearness > self.nearness[pixel] {
                    self.nearness[pixel] = nearness;
                    self.triangle[pixel] = index;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearer_triangle_hides_the_other_whichever_is_drawn_first() {
        let vertices = [
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, -1.0, 0.5],
            [1.0, -1.0, 0.5],
            [0.0, 1.0, 0.5],
        ];
        let camera = Camera::parallel(Vector::zeros(), 1.0, -Vector::z(), 8.0);
        for triangles in [[[0, 1, 2], [3, 4, 5]], [[5, 4, 3], [2, 1, 0]]] {
            let buffer =
                DepthBuffer::of(Surface { vertices: &vertices, triangles: &triangles }, &camera, 8, 8);
            let seen = buffer.triangle[4 * 8 + 4] as usize;
            assert!(triangles[seen].contains(&3), "sees triangle {seen} of {triangles:?}");
            assert_eq!(buffer.triangle[0], NOTHING, "the corner of the picture");
            // Half of the square, give or take the pixels on the two slanted edges.
            let covered = buffer.triangle.iter().filter(|&&triangle| triangle != NOTHING).count();
            assert!((24..=40).contains(&covered), "{covered} of 64 pixels");
        }
    }
}
