//! Sections particular to MSH 4.1: entities, and blocks of nodes and elements.

use super::super::text::{Cursor, Problem};
use super::File;
use crate::mesh::elements::{self, TETRAHEDRON};

impl File {
    /// Counts of points, curves, surfaces, volumes; then for each its tag, a point or a box, and its physical
    /// groups.
    pub(super) fn entities_4(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let mut line = cursor.next("the numbers of entities")?;
        let mut counts = [0usize; 4];
        for count in &mut counts {
            *count = line.number("the number of entities of a dimension")?;
        }
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                let mut line = cursor.next("an entity")?;
                let tag = line.number("the tag of the entity")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    line.number::<f64>("a coordinate of the entity")?;
                }
                let groups: usize = line.number("the number of physical groups")?;
                let mut tags = Vec::new();
                for _ in 0..groups {
                    // A negative tag means the reversed orientation, which is nothing to a set of elements.
                    tags.push(line.number::<i32>("the tag of a physical group")?.unsigned_abs().into());
                }
                self.physical.insert((dimension, tag), tags);
            }
        }
        Ok(())
    }

    /// `blocks nodes min max`, then for each block `dimension entity parametric count`, its tags, its
    /// coordinates.
    pub(super) fn nodes_4(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let blocks: usize = cursor.next("the number of node blocks")?.number("the number of node blocks")?;
        let mut tags = Vec::new();
        for _ in 0..blocks {
            let mut line = cursor.next("a block of nodes")?;
            line.number::<usize>("the dimension of the block")?;
            line.number::<i64>("the entity of the block")?;
            line.number::<usize>("whether the block is parametric")?;
            let count: usize = line.number("the number of nodes of the block")?;
            tags.clear();
            for _ in 0..count {
                let mut line = cursor.next("the tag of a node")?;
                let tag = line.number("the tag of a node")?;
                if self.node_of_tag.insert(tag, self.positions.len() + tags.len()).is_some() {
                    return Err(line.problem(format!("node {tag} is given twice")));
                }
                tags.push(tag);
            }
            for tag in &tags {
                self.positions.push(cursor.next(&format!("the position of node {tag}"))?.point()?);
            }
        }
        Ok(())
    }

    /// `blocks elements min max`, then for each block `dimension entity type count` and lines `tag node …`.
    pub(super) fn elements_4(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let blocks: usize =
            cursor.next("the number of element blocks")?.number("the number of element blocks")?;
        for _ in 0..blocks {
            let mut line = cursor.next("a block of elements")?;
            let dimension: usize = line.number("the dimension of the block")?;
            let entity: i64 = line.number("the entity of the block")?;
            let kind: usize = line.number("the type of the elements")?;
            let count: usize = line.number("the number of elements of the block")?;
            let groups = self.physical.get(&(dimension, entity)).cloned().unwrap_or_default();
            let known = elements::dimension(kind);
            let is_volume = known.unwrap_or(dimension) == 3;
            for _ in 0..count {
                let mut line = cursor.next("an element")?;
                let tag: usize = line.number("the tag of the element")?;
                if kind == TETRAHEDRON {
                    let tet = self.tetrahedron(&mut line)?;
                    self.tags.push(tag);
                    self.tets.push(tet);
                    for &group in &groups {
                        self.put_into_group(group, self.tets.len() - 1);
                    }
                    continue;
                }
                if is_volume {
                    self.others.add(kind, 1);
                }
                if known.is_some() && !groups.is_empty() {
                    let nodes = self.nodes_of_element(&mut line)?;
                    for &group in &groups {
                        self.groups.entry((dimension, group)).or_default().nodes.extend(&nodes);
                    }
                }
            }
        }
        Ok(())
    }
}
