//! Sets of nodes with prescribed positions.
//!
//! Their positions and motions belong to the [simulation](crate::step::Simulation).

use piola::__private::message::quoted;
use thiserror::Error;

use crate::mesh::{Bounds, TetMesh, no_such_group};

/// Nodes with prescribed positions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pins {
    nodes: Vec<usize>,
}

impl Pins {
    /// No pins: a free body.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// Pins at these nodes, in any order.
    #[must_use]
    pub fn at(nodes: impl IntoIterator<Item = usize>) -> Self {
        let mut nodes: Vec<usize> = nodes.into_iter().collect();
        nodes.sort_unstable();
        nodes.dedup();
        Self { nodes }
    }

    /// Pins at the nodes that lie in a box at rest.
    ///
    /// # Errors
    /// [`PinError`] if there are none.
    pub fn in_box(mesh: &TetMesh, bounds: Bounds) -> Result<Self, PinError> {
        let inside = mesh.positions.iter().enumerate().filter(|&(_, &x)| bounds.contains(x));
        let pins = Self::at(inside.map(|(node, _)| node));
        if pins.nodes.is_empty() {
            let (Bounds { min, max }, body) = (bounds, mesh.bounds());
            return Err(PinError(format!(
                "no node lies in the box {min:?} to {max:?}; the body extends from {:?} to {:?}",
                body.min, body.max
            )));
        }
        Ok(pins)
    }

    /// Pins at the nodes of a group of any dimension, such as a physical group of Gmsh.
    ///
    /// # Errors
    /// [`PinError`] if there is no such group, or none of its nodes belongs to a tetrahedron.
    pub fn of_group(mesh: &TetMesh, name: &str) -> Result<Self, PinError> {
        // Gmsh allows one name in each dimension.
        let nodes = mesh.groups.iter().filter(|group| group.name == name).flat_map(|group| &group.nodes);
        let pins = Self::at(nodes.copied());
        if !pins.nodes.is_empty() {
            Ok(pins)
        } else if mesh.group(name).is_some() {
            Err(PinError(format!("the group `{}` holds no node of a tetrahedron", quoted(name))))
        } else {
            Err(PinError(no_such_group(name, mesh.groups.iter(), "")))
        }
    }

    /// Union with other pins.
    #[must_use]
    pub fn and(self, others: &Self) -> Self {
        Self::at(self.nodes.into_iter().chain(others.nodes.iter().copied()))
    }

    /// Indices of the pinned nodes, ascending.
    #[must_use]
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }
}

/// Reason why there is nothing to pin, in words.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct PinError(String);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Group;

    fn mesh() -> TetMesh {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut mesh = TetMesh::new(positions, vec![[0, 1, 2, 3]]);
        let group = |name, dimension, nodes: &[usize]| Group::of(name, dimension, nodes, &[]);
        mesh.groups = vec![group("feet", 1, &[2, 0]), group("feet", 0, &[3]), group("air", 2, &[])];
        mesh
    }

    #[test]
    fn boxes_and_groups_select_nodes() {
        let low = Bounds { min: [0.0; 3], max: [1.0, 0.5, 0.0] };
        assert_eq!(Pins::in_box(&mesh(), low), Ok(Pins::at([1, 0, 1])));
        assert_eq!(Pins::of_group(&mesh(), "feet"), Ok(Pins::at([0, 2, 3])));
        assert_eq!(Pins::at([3]).and(&Pins::at([1, 3])).nodes(), [1, 3]);
    }

    #[test]
    fn nothing_to_pin_is_an_error_that_says_what_exists() {
        let error = Pins::of_group(&mesh(), "hooves").expect_err("no such group");
        assert_eq!(error.to_string(), "there is no group `hooves`; there are: feet, feet, air");
        let error = Pins::of_group(&mesh(), "air").expect_err("an empty group");
        assert_eq!(error.to_string(), "the group `air` holds no node of a tetrahedron");
        let far = Bounds { min: [5.0; 3], max: [6.0; 3] };
        let error = Pins::in_box(&mesh(), far).expect_err("an empty box");
        assert_eq!(
            error.to_string(),
            "no node lies in the box [5.0, 5.0, 5.0] to [6.0, 6.0, 6.0]; \
             the body extends from [0.0, 0.0, 0.0] to [1.0, 1.0, 1.0]"
        );
    }
}
