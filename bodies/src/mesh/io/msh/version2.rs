//! Sections particular to MSH 2.2: flat lists of nodes and elements, which name their groups themselves.

use std::collections::{HashMap, HashSet};

use super::super::text::{Cursor, Problem};
use super::File;
use crate::mesh::elements::{self, TETRAHEDRON};

impl File {
    /// `count`, then `tag x y z` each; behind them parametric nodes have an entity and parameters on it.
    pub(super) fn nodes_2(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let count: usize = cursor.next("the number of nodes")?.number("the number of nodes")?;
        for _ in 0..count {
            self.add_node(&mut cursor.next("a node")?, "the tag of a node")?;
        }
        Ok(())
    }

    /// `count`, then `tag type number-of-tags physical-group …, node …` each; an element of several groups is
    /// written once for each of them, perhaps under other tags.
    pub(super) fn elements_2(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let count: usize = cursor.next("the number of elements")?.number("the number of elements")?;
        let (mut seen, mut of_groups, mut others) = (HashMap::new(), HashSet::new(), HashSet::new());
        for _ in 0..count {
            let mut line = cursor.next("an element")?;
            let tag: usize = line.number("the tag of the element")?;
            let kind: usize = line.number("the type of the element")?;
            let dimension = elements::dimension(kind);
            let mut group = 0;
            for at in 0..line.number::<usize>("the number of tags of the element")? {
                let tag: i32 = line.number("a tag of the element")?;
                if at == 0 {
                    // A negative tag means the reversed orientation, which is nothing to a set of elements.
                    group = tag.unsigned_abs().into();
                }
            }
            if kind == TETRAHEDRON {
                let tet = self.tetrahedron(&mut line)?;
                let known = *seen.entry(tet).or_insert(self.tets.len());
                // Twice in one group it is a mistake, which is found where rest shapes are computed.
                let index = if of_groups.insert((group, tet)) { known } else { self.tets.len() };
                if index == self.tets.len() {
                    self.tags.push(tag);
                    self.tets.push(tet);
                }
                if group != 0 {
                    self.put_into_group(group, index);
                }
                continue;
            }
            // An unknown element may be one of the volume.
            let is_volume = dimension.is_none_or(|dimension| dimension == 3);
            if is_volume && others.insert((kind, line.words.clone().collect::<Vec<_>>())) {
                self.others.add(kind, 1);
            }
            if let Some(dimension) = dimension.filter(|_| group != 0) {
                let nodes = self.nodes_of_element(&mut line)?;
                self.groups.entry((dimension, group)).or_default().nodes.extend(nodes);
            }
        }
        Ok(())
    }
}
