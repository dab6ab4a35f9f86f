//! Motions of the ends of a body.

use piola_bodies::mesh::Bounds;

/// Springs from some of the nodes to points that move away from them, until they are let go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// The nodes that are pulled, in shares of the bounding box.
    pub region: Bounds,
    /// Motion of the points.
    pub motion: Motion,
    /// Time, s, until which the motion is steady; the points then stay.
    pub reached: f64,
    /// Time, s, at which the springs vanish.
    pub released: f64,
}

/// A motion of points that starts where the nodes are at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Straight displacement, in body heights along each axis.
    Shift([f64; 3]),
    /// Rotation about the upright line through the middle of the bounding box, in turns from z towards x.
    Turn(f64),
}

impl Motion {
    /// Position, m, of a point after a share of the motion, for a body with these bounds, m.
    #[must_use]
    pub fn place(self, rest: [f64; 3], share: f64, bounds: Bounds) -> [f64; 3] {
        match self {
            Self::Shift(by) => {
                let height = bounds.size()[1];
                std::array::from_fn(|i| rest[i] + share * by[i] * height)
            }
            Self::Turn(turns) => {
                let middle: [f64; 3] = std::array::from_fn(|i| 0.5 * (bounds.min[i] + bounds.max[i]));
                let (sin, cos) = (share * turns * std::f64::consts::TAU).sin_cos();
                let (x, z) = (rest[0] - middle[0], rest[2] - middle[2]);
                [middle[0] + cos * x + sin * z, rest[1], middle[2] + cos * z - sin * x]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_of_a_turn_takes_z_to_x() {
        let bounds = Bounds { min: [1.0, 0.0, 1.0], max: [3.0, 2.0, 3.0] };
        let place = Motion::Turn(0.5).place([2.0, 1.5, 3.0], 0.5, bounds);
        // The cosine of a right angle is not exactly 0.
        assert!((0..3).all(|i| (place[i] - [3.0, 1.5, 2.0][i]).abs() < 1e-15), "{place:?}");
        assert_eq!(Motion::Shift([0.0, 3.0, 0.0]).place([1.0; 3], 0.5, bounds), [1.0, 4.0, 1.0]);
    }
}
