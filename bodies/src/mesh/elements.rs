//! Types of finite elements by Gmsh's numbers, and their names.

use std::collections::BTreeMap;
use std::fmt;

/// Gmsh's type number of a linear tetrahedron.
pub(super) const TETRAHEDRON: usize = 4;
/// Gmsh's type number of a tetrahedron of second order.
pub(super) const TETRAHEDRON_10: usize = 11;

/// Names of the volume elements of first and second order, for one element and for several.
///
/// Some shapes have two types of second order, which differ in their number of nodes.
const NAMES: [(usize, &str, &str); 11] = [
    (TETRAHEDRON, "tetrahedron", "tetrahedra"),
    (5, "hexahedron", "hexahedra"),
    (6, "prism", "prisms"),
    (7, "pyramid", "pyramids"),
    (TETRAHEDRON_10, "second-order tetrahedron (10 nodes)", "second-order tetrahedra (10 nodes)"),
    (12, "second-order hexahedron (27 nodes)", "second-order hexahedra (27 nodes)"),
    (13, "second-order prism (18 nodes)", "second-order prisms (18 nodes)"),
    (14, "second-order pyramid (14 nodes)", "second-order pyramids (14 nodes)"),
    (17, "second-order hexahedron (20 nodes)", "second-order hexahedra (20 nodes)"),
    (18, "second-order prism (15 nodes)", "second-order prisms (15 nodes)"),
    (19, "second-order pyramid (13 nodes)", "second-order pyramids (13 nodes)"),
];

/// Counts of volume elements in a file by type, as Gmsh numbers the types.
///
/// Displayed as `6 second-order tetrahedra (10 nodes), 1 hexahedron, 48 tetrahedra`, with linear tetrahedra
/// at the end; types of third or higher order by their numbers, as `2 elements of type 29`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ElementCounts(BTreeMap<usize, usize>);

impl ElementCounts {
    /// True if no element is counted.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Counts more elements of a type.
    #[must_use]
    pub(super) fn and(mut self, kind: usize, count: usize) -> Self {
        self.add(kind, count);
        self
    }

    /// Counts more elements of a type.
    pub(super) fn add(&mut self, kind: usize, count: usize) {
        if count > 0 {
            *self.0.entry(kind).or_default() += count;
        }
    }

    /// Reason to refuse a volume that is made of these elements.
    pub(super) fn refusal(&self, remedy: &str) -> String {
        format!("the volume is made of {self}, and only linear tetrahedra are read; {remedy}")
    }
}

impl fmt::Display for ElementCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tetrahedra = self.0.get_key_value(&TETRAHEDRON);
        let others = self.0.iter().filter(|&(&kind, _)| kind != TETRAHEDRON);
        for (place, (&kind, &count)) in others.chain(tetrahedra).enumerate() {
            let comma = if place == 0 { "" } else { ", " };
            match NAMES.iter().find(|name| name.0 == kind) {
                Some(&(_, one, several)) => {
                    write!(f, "{comma}{count} {}", if count == 1 { one } else { several })?;
                }
                None if count == 1 => write!(f, "{comma}1 element of type {kind}")?,
                None => write!(f, "{comma}{count} elements of type {kind}")?,
            }
        }
        Ok(())
    }
}

/// Dimension of the elements of a type, which distinguishes groups of one name; `None` for an unknown type.
pub(super) fn dimension(kind: usize) -> Option<usize> {
    match kind {
        15 => Some(0),
        1 | 8 | 26..=28 | 62..=66 => Some(1),
        2..=3 | 9..=10 | 16 | 20..=25 | 36..=61 => Some(2),
        4..=7 | 11..=14 | 17..=19 | 29..=33 | 71..=75 | 79..=83 | 90..=131 => Some(3),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(counts: &[(usize, usize)], expected: &str) {
        let counts = counts.iter().fold(ElementCounts::default(), |all, &(kind, count)| all.and(kind, count));
        assert_eq!(counts.to_string(), expected);
    }

    #[test]
    fn elements_are_named_in_singular_and_plural() {
        check(&[(4, 48), (5, 1)], "1 hexahedron, 48 tetrahedra");
        check(&[(5, 2), (6, 1), (7, 1), (4, 1)], "2 hexahedra, 1 prism, 1 pyramid, 1 tetrahedron");
        check(&[(11, 6)], "6 second-order tetrahedra (10 nodes)");
        check(
            &[(17, 1), (12, 3)],
            "3 second-order hexahedra (27 nodes), 1 second-order hexahedron (20 nodes)",
        );
        check(
            &[(29, 2), (83, 1), (999, 1), (35, 2)],
            "2 elements of type 29, 2 elements of type 35, 1 element of type 83, 1 element of type 999",
        );
        check(&[(5, 0)], "");
    }

    /// Gmsh's numbers of shapes and orders: ten lines, complete from order 1 to 10, and so on.
    #[test]
    fn types_are_those_of_gmsh() {
        let count = |wanted| (0..1000).filter(|&kind| dimension(kind) == Some(wanted)).count();
        // Triangles and quadrangles: complete from 1, incomplete from 3 and from 2 to 10.
        // Tetrahedra: complete from 1, incomplete from 4 to 10.
        // Hexahedra, prisms, pyramids: complete from 1 to 9, incomplete from 2.
        assert_eq!([0, 1, 2, 3].map(count), [1, 10, 18 + 19, 17 + 3 * 17]);
        assert_eq!([15, 8, 16, 33, 140].map(dimension), [Some(0), Some(1), Some(2), Some(3), None]);
        assert!(NAMES.iter().all(|&(kind, ..)| dimension(kind) == Some(3)));
    }
}
