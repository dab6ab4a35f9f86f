//! Memory between the stages of a tile. Each thread keeps one, so that calls neither allocate nor clear it.

use super::rows::Rows;
use super::sink::{Line, Lines};
use super::svd_tile::SvdTile;
use crate::lanes::Scalar;

/// Memory for one tile of any call.
#[derive(Debug)]
pub struct Workspace<E> {
    pub(super) F: Lines<E, 9>,
    pub(super) rest: Lines<E, 10>,
    pub(super) svd: SvdTile<E>,
    pub(super) scratch: Scratch<E>,
}

/// Memory of which nothing outlasts the call of a tile.
#[derive(Debug)]
pub(super) struct Scratch<E> {
    pub(super) energies: Rows<E, 1>,
    pub(super) gradients: Rows<E, 3>,
    pub(super) invariants: Rows<E, 3>,
    pub(super) derivatives: Rows<E, 9>,
    pub(super) blocks: Rows<E, 15>,
    pub(super) line: Line<E>,
    /// Memory for P or gradients next to [`line`](Self::line).
    pub(super) short_line: Line<E>,
}

impl<E: Scalar> Workspace<E> {
    pub(super) fn new() -> Box<Self> {
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
                line: Line::zero(),
                short_line: Line::zero(),
            },
        })
    }
}
