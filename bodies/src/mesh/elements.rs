//! Types of finite elements by Gmsh's numbers, and their names.

use std::collections::BTreeMap;
use std::fmt;

/// Gmsh's type number of a linear tetrahedron.
pub(super) const TETRAHEDRON: usize = 4;
/// Gmsh's type number of a tetrahedron of second order.
pub(super) const TETRAHEDRON_10: usize = 11;

/// Orders of elements, from 1.
const ORDERS: [&str; 10] =
    ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"];

/// Counts of elements in a file by type, as Gmsh numbers the types.
///
/// Displayed as `6 second-order tetrahedra (10 nodes), 1 hexahedron, 48 tetrahedra`, with linear tetrahedra
/// at the end.
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
            let Some((shape, order)) = shape_and_order(kind) else {
                let elements = if count == 1 { "element" } else { "elements" };
                write!(f, "{comma}{count} {elements} of type {kind}")?;
                continue;
            };
            write!(f, "{comma}{count} ")?;
            if order > 1 {
                write!(f, "{}-order ", ORDERS[order - 1])?;
            }
            let (one, several) = shape.names();
            f.write_str(if count == 1 { one } else { several })?;
            if let Some(nodes) = second_order_nodes(kind) {
                write!(f, " ({nodes} nodes)")?;
            }
        }
        Ok(())
    }
}

/// Dimension of the elements of a type, which distinguishes groups of one name; `None` for an unknown type.
pub(super) fn dimension(kind: usize) -> Option<usize> {
    shape_and_order(kind).map(|(shape, _)| match shape {
        Shape::Point => 0,
        Shape::Line => 1,
        Shape::Triangle | Shape::Quadrangle => 2,
        Shape::Tetrahedron | Shape::Hexahedron | Shape::Prism | Shape::Pyramid => 3,
    })
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Point,
    Line,
    Triangle,
    Quadrangle,
    Tetrahedron,
    Hexahedron,
    Prism,
    Pyramid,
}

impl Shape {
    /// The names of one and of several.
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Point => ("point", "points"),
            Self::Line => ("line", "lines"),
            Self::Triangle => ("triangle", "triangles"),
            Self::Quadrangle => ("quadrangle", "quadrangles"),
            Self::Tetrahedron => ("tetrahedron", "tetrahedra"),
            Self::Hexahedron => ("hexahedron", "hexahedra"),
            Self::Prism => ("prism", "prisms"),
            Self::Pyramid => ("pyramid", "pyramids"),
        }
    }
}

/// Shape and order of the elements of a type, complete or without nodes on faces and inside.
fn shape_and_order(kind: usize) -> Option<(Shape, usize)> {
    Some(match kind {
        15 => (Shape::Point, 1),
        1 => (Shape::Line, 1),
        8 => (Shape::Line, 2),
        26..=28 => (Shape::Line, kind - 23),
        62..=66 => (Shape::Line, kind - 56),
        2 => (Shape::Triangle, 1),
        9 => (Shape::Triangle, 2),
        20..=25 => (Shape::Triangle, kind / 2 - 7),
        42..=46 => (Shape::Triangle, kind - 36),
        52..=56 => (Shape::Triangle, kind - 46),
        3 => (Shape::Quadrangle, 1),
        10 | 16 => (Shape::Quadrangle, 2),
        36..=38 => (Shape::Quadrangle, kind - 33),
        39..=41 => (Shape::Quadrangle, kind - 36),
        47..=51 => (Shape::Quadrangle, kind - 41),
        57..=61 => (Shape::Quadrangle, kind - 51),
        TETRAHEDRON => (Shape::Tetrahedron, 1),
        TETRAHEDRON_10 => (Shape::Tetrahedron, 2),
        29..=31 => (Shape::Tetrahedron, kind - 26),
        32..=33 => (Shape::Tetrahedron, kind - 28),
        71..=75 => (Shape::Tetrahedron, kind - 65),
        79..=83 => (Shape::Tetrahedron, kind - 73),
        5 => (Shape::Hexahedron, 1),
        12 | 17 => (Shape::Hexahedron, 2),
        92..=98 => (Shape::Hexahedron, kind - 89),
        99..=105 => (Shape::Hexahedron, kind - 96),
        6 => (Shape::Prism, 1),
        13 | 18 => (Shape::Prism, 2),
        90..=91 => (Shape::Prism, kind - 87),
        106..=110 => (Shape::Prism, kind - 101),
        111..=117 => (Shape::Prism, kind - 108),
        7 => (Shape::Pyramid, 1),
        14 | 19 => (Shape::Pyramid, 2),
        118..=124 => (Shape::Pyramid, kind - 115),
        125..=131 => (Shape::Pyramid, kind - 122),
        _ => return None,
    })
}

/// Number of nodes of an element of second order, of which some shapes have two types. For higher orders, it
/// has changed between versions of Gmsh.
fn second_order_nodes(kind: usize) -> Option<usize> {
    match kind {
        8 => Some(3),
        9 => Some(6),
        10 => Some(9),
        16 => Some(8),
        TETRAHEDRON_10 => Some(10),
        12 => Some(27),
        17 => Some(20),
        13 => Some(18),
        18 => Some(15),
        14 => Some(14),
        19 => Some(13),
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
            "2 third-order tetrahedra, 2 elements of type 35, \
             1 tenth-order tetrahedron, 1 element of type 999",
        );
        check(&[(5, 0)], "");
    }

    /// Every type that has a name has an order with one, and Gmsh's numbers of shapes and orders: the counts
    /// are of lines, and so on.
    #[test]
    fn types_are_those_of_gmsh() {
        let known: Vec<(Shape, usize)> = (0..1000).filter_map(shape_and_order).collect();
        let count = |shape| known.iter().filter(|&&(other, _)| other == shape).count();
        assert!(known.iter().all(|&(_, order)| (1..=ORDERS.len()).contains(&order)));
        assert_eq!(count(Shape::Point), 1);
        assert_eq!(count(Shape::Line), 10, "complete from order 1 to 10");
        assert_eq!(count(Shape::Triangle), 18, "complete from 1, incomplete from 3 to 10");
        assert_eq!(count(Shape::Quadrangle), 19, "complete from 1, incomplete from 2 to 10");
        assert_eq!(count(Shape::Tetrahedron), 17, "complete from 1, incomplete from 4 to 10");
        for shape in [Shape::Hexahedron, Shape::Prism, Shape::Pyramid] {
            assert_eq!(count(shape), 17, "complete from 1 to 9, incomplete from 2");
        }
        assert_eq!([15, 8, 16, 33, 140].map(dimension), [Some(0), Some(1), Some(2), Some(3), None]);
    }
}
