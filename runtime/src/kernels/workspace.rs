//! Memory between the stages of a tile. Each thread keeps one, so that calls neither allocate nor clear it.

#![expect(non_snake_case, reason = "F as in the literature")]

use super::rows::Rows;
use super::sink::{LineBuffer, Lines};
use super::svd_tile::SvdTile;
use crate::lanes::Scalar;

/// Memory for one tile of any call.
#[derive(Debug)]
pub struct Workspace<E> {
    pub(crate) F: Lines<E, 9>,
    pub(crate) rest: Lines<E, 10>,
    pub(crate) svd: SvdTile<E>,
    pub(crate) scratch: Scratch<E>,
}

/// Memory that is used only during the call of a tile.
#[derive(Debug)]
pub(crate) struct Scratch<E> {
    pub(crate) energies: Rows<E, 1>,
    pub(crate) gradients: Rows<E, 3>,
    pub(crate) invariants: Rows<E, 3>,
    pub(crate) derivatives: Rows<E, 9>,
    pub(crate) blocks: Rows<E, 15>,
    pub(crate) line: LineBuffer<E>,
    /// Memory for P or gradients next to [`line`](Self::line).
    pub(crate) short_line: LineBuffer<E>,
}

impl<E: Scalar> Workspace<E> {
    pub(crate) fn new() -> Box<Self> {
        Box::new(Self {
            F: Lines::zero(),
            rest: Lines::zero(),
            svd: SvdTile::new(),
            scratch: Scratch {
                energies: Rows::zero(),
                gradients: Rows::zero(),
                invariants: Rows::zero(),
                derivatives: Rows::zero(),
                blocks: Rows::zero(),
                line: LineBuffer::zero(),
                short_line: LineBuffer::zero(),
            },
        })
    }
}
