//! A material as batches see it: one dynamic dispatch for each tile.

use super::tile::{Rows, first_bits, for_each_group};
use crate::lanes::{Backend, Element, Kernel, Lanes};
use crate::material::{Blocks, Material};
use crate::point::energy_is_finite;

/// An energy density over tiles of points; implemented for every [`Material`].
///
/// The points of a tile are numbered from `start` on within the batch, and its first `count` rows mean something. Each
/// method returns the points outside the domain of the energy as bits, whose results are meaningless.
pub trait Energy<E: Element>: Send + Sync {
    /// ψ, Pa, from signed principal stretches.
    fn energies(&self, tile: TileOf<'_, E>, energies: &mut Rows<E, 1>) -> Verdict;

    /// ψ1, ψ2, ψ3, Pa.
    fn gradients(&self, tile: TileOf<'_, E>, gradients: &mut Rows<E, 3>) -> u64;

    /// The fifteen numbers of [`Blocks`], Pa, in the order of its fields.
    fn blocks(&self, tile: TileOf<'_, E>, blocks: &mut Rows<E, 15>) -> u64;

    /// As [`Material::has_pole`].
    fn has_pole(&self) -> bool;

    /// As [`Material::ends_at_zero_volume`].
    fn ends_at_zero_volume(&self) -> bool;

    /// ψ11 at rest, Pa: how stiff the material is, and so how large the rounding error of an energy.
    fn rest_stiffness(&self) -> f64;
}

/// What is wrong with energies, as bits of the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Verdict {
    /// Outside the domain.
    pub refused: u64,
    /// The energy or a stretch is infinite or NaN, or a stretch comes within a factor 16 of it.
    pub nonfinite: u64,
}

/// Principal stretches of a tile and how to compute with them.
#[derive(Clone, Copy, Debug)]
pub struct TileOf<'a, E> {
    /// The instructions to use.
    pub backend: Backend,
    /// Number of its first point in the batch.
    pub start: usize,
    /// How many points it has.
    pub count: usize,
    pub(crate) stretches: &'a Rows<E, 3>,
}

impl<E: Element, M: Material> Energy<E> for M {
    fn energies(&self, tile: TileOf<'_, E>, energies: &mut Rows<E, 1>) -> Verdict {
        struct Energies<'a, M, E>(&'a M, TileOf<'a, E>, &'a mut Rows<E, 1>);
        impl<M: Material, E: Element> Kernel<E> for Energies<'_, M, E> {
            type Output = Verdict;
            #[inline(always)]
            fn run<R: Lanes<Element = E>>(self) -> Verdict {
                let Self(material, tile, energies) = self;
                let (mut admitted, mut finite) = (0, 0);
                for_each_group!(R, tile.count, |at| {
                    let stretches = tile.stretches.get_all::<R>(at);
                    let energy = material.energy(stretches);
                    energies.set(0, at, energy);
                    finite |= R::bits(energy_is_finite(stretches, energy)) << at;
                    admitted |= R::bits(material.admits(stretches)) << at;
                });
                let points = first_bits(tile.count);
                Verdict { refused: !admitted & points, nonfinite: !finite & points }
            }
        }
        tile.backend.run(Energies(self, tile, energies))
    }

    fn gradients(&self, tile: TileOf<'_, E>, gradients: &mut Rows<E, 3>) -> u64 {
        struct Gradients<'a, M, E>(&'a M, TileOf<'a, E>, &'a mut Rows<E, 3>);
        impl<M: Material, E: Element> Kernel<E> for Gradients<'_, M, E> {
            type Output = u64;
            #[inline(always)]
            fn run<R: Lanes<Element = E>>(self) -> u64 {
                let Self(material, tile, gradients) = self;
                let mut admitted = 0;
                for_each_group!(R, tile.count, |at| {
                    let stretches = tile.stretches.get_all::<R>(at);
                    gradients.set_all(at, material.gradient(stretches));
                    admitted |= R::bits(material.admits(stretches)) << at;
                });
                !admitted & first_bits(tile.count)
            }
        }
        tile.backend.run(Gradients(self, tile, gradients))
    }

    fn blocks(&self, tile: TileOf<'_, E>, blocks: &mut Rows<E, 15>) -> u64 {
        struct All<'a, M, E>(&'a M, TileOf<'a, E>, &'a mut Rows<E, 15>);
        impl<M: Material, E: Element> Kernel<E> for All<'_, M, E> {
            type Output = u64;
            #[inline(always)]
            fn run<R: Lanes<Element = E>>(self) -> u64 {
                let Self(material, tile, blocks) = self;
                let mut admitted = 0;
                for_each_group!(R, tile.count, |at| {
                    let stretches = tile.stretches.get_all::<R>(at);
                    blocks.set_all(at, to_numbers(&material.blocks(stretches)));
                    admitted |= R::bits(material.admits(stretches)) << at;
                });
                !admitted & first_bits(tile.count)
            }
        }
        tile.backend.run(All(self, tile, blocks))
    }

    fn has_pole(&self) -> bool {
        Material::has_pole(self)
    }

    fn ends_at_zero_volume(&self) -> bool {
        Material::ends_at_zero_volume(self)
    }

    fn rest_stiffness(&self) -> f64 {
        Material::blocks(self, [1.0f64; 3]).hessian[0]
    }
}

#[inline(always)]
pub(super) fn to_numbers<R: Copy>(blocks: &Blocks<R>) -> [R; 15] {
    let [p1, p2, p3] = blocks.gradient;
    let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
    let ([f12, f13, f23], [t12, t13, t23]) = (blocks.flip, blocks.twist);
    [p1, p2, p3, h11, h22, h33, h12, h13, h23, f12, f13, f23, t12, t13, t23]
}

#[inline(always)]
pub(super) fn from_numbers<R: Copy>(numbers: [R; 15]) -> Blocks<R> {
    let [p1, p2, p3, h11, h22, h33, h12, h13, h23, f12, f13, f23, t12, t13, t23] = numbers;
    Blocks {
        gradient: [p1, p2, p3],
        hessian: [h11, h22, h33, h12, h13, h23],
        flip: [f12, f13, f23],
        twist: [t12, t13, t23],
    }
}
