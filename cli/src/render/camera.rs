//! Projection of points in space to the picture, and rays of its pixels.

use super::Vector;

/// A view of the scene: central for the picture, parallel for the shadow of a distant light.
///
/// Image coordinates run over width × height pixels, x to the right and y downwards, pixel centres at halves.
/// "Nearness" orders what a pixel sees, the largest being in front; it is affine in image coordinates, so
/// that it may be interpolated there: the reciprocal of the depth for a central view, its negative for a
/// parallel one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    eye: Vector,
    right: Vector,
    up: Vector,
    forward: Vector,
    width: f32,
    height: f32,
    is_central: bool,
    /// Pixels per unit of x/depth of a central view, per unit of length of a parallel one.
    scale: f32,
}

impl Camera {
    /// The central view along `forward` from as near as shows all of `points`, with `margin` (a share of the
    /// picture's half width and half height) left free around them.
    ///
    /// The position is exact: in camera coordinates every point bounds it by four planes, and the tightest of
    /// them meet there.
    pub(super) fn fitting(
        points: impl Iterator<Item = Vector>,
        forward: Vector,
        [width, height]: [f32; 2],
        margin: f32,
    ) -> Self {
        let [right, up, forward] = frame(forward);
        // The picture is 0.36 deep per unit of width: about the look of an 85 mm portrait lens.
        let slope = [0.21, 0.21 * height / width].map(|slope| slope * (1.0 - margin));
        let mut bound = [[f32::NEG_INFINITY; 2]; 2];
        for point in points {
            let [x, y, z] = [point.dot(&right), point.dot(&up), point.dot(&forward)];
            for (bound, (along, slope)) in bound.iter_mut().zip([(x, slope[0]), (y, slope[1])]) {
                bound[0] = bound[0].max(along - slope * z);
                bound[1] = bound[1].max(-along - slope * z);
            }
        }
        let [x, y] = bound.map(|[above, below]| 0.5 * (above - below));
        let z = (0..2).map(|i| -(bound[i][0] + bound[i][1]) / (2.0 * slope[i])).fold(f32::INFINITY, f32::min);
        let eye = right * x + up * y + forward * z;
        Self { eye, right, up, forward, width, height, is_central: true, scale: 0.5 * width / 0.21 }
    }

    /// The parallel view along `forward` of the sphere about `centre`, in a square of `size` pixels.
    pub(super) fn parallel(centre: Vector, radius: f32, forward: Vector, size: f32) -> Self {
        let [right, up, forward] = frame(forward);
        let (width, height, scale) = (size, size, 0.5 * size / radius);
        Self { eye: centre, right, up, forward, width, height, is_central: false, scale }
    }

    /// Image coordinates and nearness of a point.
    pub(super) fn project(&self, point: Vector) -> [f32; 3] {
        let relative = point - self.eye;
        let [x, y, depth] = [relative.dot(&self.right), relative.dot(&self.up), relative.dot(&self.forward)];
        let (scale, nearness) =
            if self.is_central { (self.scale / depth, 1.0 / depth) } else { (self.scale, -depth) };
        [0.5 * self.width + scale * x, 0.5 * self.height - scale * y, nearness]
    }

    /// The eye, and the direction in which a central view sees the image point (x, y).
    pub(super) fn ray(&self, x: f32, y: f32) -> (Vector, Vector) {
        let [x, y] = [x - 0.5 * self.width, 0.5 * self.height - y];
        (self.eye, (self.right * x + self.up * y + self.forward * self.scale).normalize())
    }
}

/// The right-handed triple (right, up, −forward) as [right, up, forward], up being as vertical as possible.
fn frame(forward: Vector) -> [Vector; 3] {
    let forward = forward.normalize();
    // A light from the zenith has no horizontal part to turn about; any will do for it.
    let vertical = if forward.y.abs() < 0.999 { Vector::y() } else { Vector::z() };
    let right = forward.cross(&vertical).normalize();
    [right, right.cross(&forward), forward]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fitting_touches_the_margins_and_no_more() {
        let corners =
            || (0..8).map(|k| Vector::new((k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32 * 3.0));
        let camera = Camera::fitting(corners(), Vector::new(-1.0, -0.4, -0.7), [300.0, 200.0], 0.1);
        let (mut reach_x, mut reach_y) = (0f32, 0f32);
        for corner in corners() {
            let [x, y, nearness] = camera.project(corner);
            assert!(nearness > 0.0, "{corner} lies behind the camera");
            reach_x = reach_x.max((x - 150.0).abs() / 150.0);
            reach_y = reach_y.max((y - 100.0).abs() / 100.0);
        }
        // Rounding of a few dozen f32 operations on numbers of order 10.
        assert!((reach_x.max(reach_y) - 0.9).abs() < 1e-4, "reaches {reach_x} × {reach_y}");
    }

    #[test]
    fn rays_undo_projection() {
        let point = Vector::new(0.3, -0.2, 0.5);
        let camera =
            Camera::fitting([point, -point].into_iter(), Vector::new(0.2, -0.5, 1.0), [64.0, 48.0], 0.1);
        let [x, y, _] = camera.project(point);
        let (eye, direction) = camera.ray(x, y);
        let aside = (point - eye).cross(&direction).norm() / (point - eye).norm();
        assert!(aside < 1e-5, "{aside}");
    }
}
