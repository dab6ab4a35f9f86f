//! Memory between the stages of a tile. Each thread keeps one, so that calls neither allocate nor clear it.

use super::sink::{Line, Lines};
use super::svd_tile::SvdTile;
use super::tile::Rows;
use crate::lanes::Scalar;

/// Room for one tile of any call.
#[derive(Debug)]
pub struct Workspace<E> {
    pub(super) F: Lines<E, 9>,
    pub(super) points: SvdTile<E>,
    pub(super) energies: Rows<E, 1>,
    pub(super) gradients: Rows<E, 3>,
    pub(super) invariants: Rows<E, 3>,
    pub(super) derivatives: Rows<E, 9>,
    pub(super) blocks: Rows<E, 15>,
    pub(super) rest: Lines<E, 10>,
    pub(super) line: Line<E>,
    /// Room for P or gradients beside what is in [`line`](Self::line).
    pub(super) short_line: Line<E>,
}

/// Memory between the stages of a tile for stresses and tangents.
pub(super) struct Rooms<'w, E> {
    pub(super) points: &'w mut SvdTile<E>,
    pub(super) invariants: &'w mut Rows<E, 3>,
    pub(super) derivatives: &'w mut Rows<E, 9>,
    pub(super) energies: &'w mut Rows<E, 1>,
    pub(super) blocks: &'w mut Rows<E, 15>,
    pub(super) line: &'w mut Line<E>,
    pub(super) short_line: &'w mut Line<E>,
}

impl<E: Scalar> Workspace<E> {
    /// Room for deformation gradients and for shapes at rest, and what lies between the stages.
    pub(super) fn for_elements(&mut self) -> (&mut Lines<E, 9>, &mut Lines<E, 10>, Rooms<'_, E>) {
        let Self { F, rest, points, invariants, derivatives, energies, blocks, line, short_line, .. } = self;
        (F, rest, Rooms { points, invariants, derivatives, energies, blocks, line, short_line })
    }

    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            F: Lines::zero(),
            points: SvdTile::new(),
            energies: Rows::zero(),
            gradients: Rows::zero(),
            invariants: Rows::zero(),
            derivatives: Rows::zero(),
            blocks: Rows::zero(),
            rest: Lines::zero(),
            line: Line::zero(),
            short_line: Line::zero(),
        })
    }
}
