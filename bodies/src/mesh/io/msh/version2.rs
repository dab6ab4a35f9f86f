//! Sections particular to MSH 2.2: flat lists of nodes and elements, which name their groups themselves.

use std::collections::{HashMap, HashSet};
use std::io::BufRead;

use super::super::text::{Cursor, Line, Problem};
use super::{ELEMENT, File, Lists, element_tag, node_tag};
use crate::mesh::elements::{self, TETRAHEDRON};

/// `count`, then the lines of as many nodes.
pub(super) fn nodes<R: BufRead>(cursor: &mut Cursor<R>, lists: &mut impl Lists) -> Result<(), Problem> {
    let count = cursor.next("the number of nodes")?.number("the number of nodes")?;
    lists.nodes_2(count, cursor)
}

/// `count`, then the lines of as many elements.
pub(super) fn elements<R: BufRead>(cursor: &mut Cursor<R>, lists: &mut impl Lists) -> Result<(), Problem> {
    let count = cursor.next("the number of elements")?.number("the number of elements")?;
    lists.elements_2(count, cursor)
}

/// `tag x y z`; behind them parametric nodes have an entity and parameters on it.
pub(super) fn node(line: &mut Line<'_>) -> Result<(usize, [f64; 3]), Problem> {
    Ok((node_tag(line)?, line.point()?))
}

/// Beginning of the line of an element: all except its nodes.
pub(super) struct Element {
    pub(super) tag: usize,
    /// Type by Gmsh's number.
    pub(super) kind: usize,
    /// Dimension of the type; `None` if it is unknown.
    pub(super) dimension: Option<usize>,
    /// Tag of its physical group.
    pub(super) group: Option<i64>,
}

impl Element {
    /// `tag type number-of-tags physical-group …`
    pub(super) fn read(line: &mut Line<'_>) -> Result<Self, Problem> {
        let tag = element_tag(line)?;
        let kind = line.number("the type of the element")?;
        let mut group = None;
        for at in 0..line.number::<usize>("the number of tags of the element")? {
            let tag: i32 = line.number("a tag of the element")?;
            if at == 0 && tag != 0 {
                // A negative tag means the reversed orientation, which is nothing to a set of elements.
                group = Some(tag.unsigned_abs().into());
            }
        }
        Ok(Self { tag, kind, dimension: elements::dimension(kind), group })
    }

    /// True if the element may be one of the volume; one of an unknown type may be.
    pub(super) fn is_volume(&self) -> bool {
        self.dimension.is_none_or(|dimension| dimension == 3)
    }
}

impl File {
    /// Reads elements. An element of several groups is written once for each of them, perhaps under other
    /// tags.
    pub(super) fn read_elements_2<R: BufRead>(
        &mut self,
        count: usize,
        cursor: &mut Cursor<R>,
    ) -> Result<(), Problem> {
        let (mut seen, mut of_groups, mut others) = (HashMap::new(), HashSet::new(), HashSet::new());
        for _ in 0..count {
            let mut line = cursor.next(ELEMENT)?;
            let element = Element::read(&mut line)?;
            let Element { tag, kind, dimension, group } = element;
            if kind == TETRAHEDRON {
                let tet = self.tetrahedron(&mut line)?;
                let known = *seen.entry(tet).or_insert(self.tets.len());
                // Twice in one group it is a mistake, which is found where rest shapes are computed.
                let index = if of_groups.insert((group, tet)) { known } else { self.tets.len() };
                if index == self.tets.len() {
                    self.tags.push(tag);
                    self.tets.push(tet);
                }
                if let Some(group) = group {
                    self.put_into_group(group, index);
                }
                continue;
            }
            let words = || line.words.clone().map(str::to_owned).collect::<Vec<_>>();
            if element.is_volume() && others.insert((kind, words())) {
                self.others.add(kind, 1);
            }
            if let Some((dimension, group)) = dimension.zip(group) {
                let nodes = self.nodes_of_element(&mut line)?;
                self.groups.entry((dimension, group)).or_default().nodes.extend(nodes);
            }
        }
        Ok(())
    }
}
