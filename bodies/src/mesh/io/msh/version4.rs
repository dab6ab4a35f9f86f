//! Sections particular to MSH 4.1: entities, and blocks of nodes and elements.

use std::io::BufRead;

use super::super::text::{Cursor, Problem};
use super::{Block, ELEMENT, Entities, File, Lists, element_tag};
use crate::mesh::elements::{self, TETRAHEDRON};

/// Counts of points, curves, surfaces, volumes; then for each its tag, a point or a box, and its physical
/// groups.
pub(super) fn entities<R: BufRead>(cursor: &mut Cursor<R>, entities: &mut Entities) -> Result<(), Problem> {
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
            entities.insert((dimension, tag), tags);
        }
    }
    Ok(())
}

/// `blocks nodes min max`, then for each block `dimension entity parametric count`, its tags, its
/// coordinates.
pub(super) fn nodes<R: BufRead>(cursor: &mut Cursor<R>, lists: &mut impl Lists) -> Result<(), Problem> {
    let blocks: usize = cursor.next("the number of node blocks")?.number("the number of node blocks")?;
    for _ in 0..blocks {
        let mut line = cursor.next("a block of nodes")?;
        line.number::<usize>("the dimension of the block")?;
        line.number::<i64>("the entity of the block")?;
        line.number::<usize>("whether the block is parametric")?;
        let count = line.number("the number of nodes of the block")?;
        lists.nodes_4(count, cursor)?;
    }
    Ok(())
}

/// `blocks elements min max`, then for each block `dimension entity type count` and its elements.
pub(super) fn elements<R: BufRead>(
    cursor: &mut Cursor<R>,
    entities: &Entities,
    lists: &mut impl Lists,
) -> Result<(), Problem> {
    let blocks: usize =
        cursor.next("the number of element blocks")?.number("the number of element blocks")?;
    for _ in 0..blocks {
        let mut line = cursor.next("a block of elements")?;
        let dimension: usize = line.number("the dimension of the block")?;
        let entity: i64 = line.number("the entity of the block")?;
        let kind = line.number("the type of the elements")?;
        let count = line.number("the number of elements of the block")?;
        let groups = entities.get(&(dimension, entity)).cloned().unwrap_or_default();
        lists.elements_4(&Block { dimension, kind, count, groups }, cursor)?;
    }
    Ok(())
}

impl Block {
    /// True if the elements are of the volume; those of an unknown type are if the block is.
    pub(super) fn is_volume(&self) -> bool {
        elements::dimension(self.kind).unwrap_or(self.dimension) == 3
    }

    /// True if the elements are members of groups, by their nodes.
    pub(super) fn has_members(&self) -> bool {
        elements::dimension(self.kind).is_some() && !self.groups.is_empty()
    }
}

impl File {
    pub(super) fn read_elements_4<R: BufRead>(
        &mut self,
        block: &Block,
        cursor: &mut Cursor<R>,
    ) -> Result<(), Problem> {
        for _ in 0..block.count {
            let mut line = cursor.next(ELEMENT)?;
            let tag = element_tag(&mut line)?;
            if block.kind == TETRAHEDRON {
                let tet = self.tetrahedron(&mut line)?;
                self.tags.push(tag);
                self.tets.push(tet);
                block.groups.iter().for_each(|&group| self.put_into_group(group, self.tets.len() - 1));
                continue;
            }
            if block.is_volume() {
                self.others.add(block.kind, 1);
            }
            if block.has_members() {
                let nodes = self.nodes_of_element(&mut line)?;
                for &group in &block.groups {
                    self.groups.entry((block.dimension, group)).or_default().nodes.extend(&nodes);
                }
            }
        }
        Ok(())
    }
}
