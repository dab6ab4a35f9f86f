//! A material as batches see it: one dynamic dispatch for each tile.

use super::tile::{Rows, first_bits, for_each_group};
use crate::lanes::{Backend, Kernel, Lanes, Real, Scalar};
use crate::material::{Blocks, Each, Material, Varying};
use crate::point::energy_is_finite;

/// An energy density over tiles of points; implemented for every [`Material`], the same for all points, and for [`Each`], a
/// material for each.
///
/// The points of a tile are numbered from `start` on within the batch, and its first `count` rows mean something. Each
/// method returns the points outside the domain of the energy as bits, whose results are meaningless.
pub trait Energy<E: Scalar>: Send + Sync {
    /// ψ, Pa, from signed principal stretches.
    fn energies(&self, tile: TileOf<'_, E>, energies: &mut Rows<E, 1>) -> Verdict;

    /// ψ1, ψ2, ψ3, Pa.
    fn gradients(&self, tile: TileOf<'_, E>, gradients: &mut Rows<E, 3>) -> u64;

    /// The fifteen numbers of [`Blocks`], Pa, in the order of its fields.
    fn blocks(&self, tile: TileOf<'_, E>, blocks: &mut Rows<E, 15>) -> u64;

    /// Whether the two methods that follow answer for any point at all.
    fn has_invariants(&self) -> bool;

    /// ψ, Pa, from I1, I2, J in the place of stretches. Returned are the points for which it may be taken and is finite.
    fn energies_by_invariants(&self, tile: TileOf<'_, E>, energies: &mut Rows<E, 1>) -> u64;

    /// W1, W2, WJ, Pa, likewise.
    fn gradients_by_invariants(&self, tile: TileOf<'_, E>, gradients: &mut Rows<E, 3>) -> u64;

    /// How many points there are parameters for, where not for any number.
    fn points(&self) -> Option<usize>;

    /// As [`Material::has_pole`].
    fn has_pole(&self) -> bool;

    /// As [`Material::ends_at_zero_volume`].
    fn ends_at_zero_volume(&self) -> bool;

    /// ψ11 at rest, Pa: how stiff the material is, and so how large the rounding error of an energy.
    fn rest_stiffness(&self) -> f64;
}

/// What a point's number decides about the material: nothing, or all of it.
#[doc(hidden)]
pub trait Law: Send + Sync {
    const HAS_INVARIANTS: bool;
    fn energy<R: Real>(&self, point: usize, stretches: [R; 3]) -> R;
    fn gradient<R: Real>(&self, point: usize, stretches: [R; 3]) -> [R; 3];
    fn blocks<R: Real>(&self, point: usize, stretches: [R; 3]) -> Blocks<R>;
    fn admits<R: Real>(&self, point: usize, stretches: [R; 3]) -> R::Mask;
    fn energy_by_invariants<R: Real>(&self, point: usize, invariants: [R; 3]) -> R;
    fn gradient_by_invariants<R: Real>(&self, point: usize, invariants: [R; 3]) -> [R; 3];
    fn admits_invariants<R: Real>(&self, point: usize, invariants: [R; 3]) -> R::Mask;
    fn points(&self) -> Option<usize>;
    fn has_pole(&self) -> bool;
    fn ends_at_zero_volume(&self) -> bool;
    fn rest_stiffness(&self) -> f64;
}

macro_rules! for_one {
    ($($method:ident -> $Result:ty),*) => {$(
        #[inline(always)]
        fn $method<R: Real>(&self, _: usize, arguments: [R; 3]) -> $Result {
            Material::$method(self, arguments)
        }
    )*};
}

impl<M: Material> Law for M {
    const HAS_INVARIANTS: bool = M::HAS_INVARIANTS;

    for_one! {
        energy -> R, gradient -> [R; 3], blocks -> Blocks<R>, admits -> R::Mask,
        energy_by_invariants -> R, gradient_by_invariants -> [R; 3], admits_invariants -> R::Mask
    }

    fn points(&self) -> Option<usize> {
        None
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

macro_rules! for_each {
    ($($method:ident by $method_of:ident -> $Result:ty),*) => {$(
        #[inline(always)]
        fn $method<R: Real>(&self, point: usize, arguments: [R; 3]) -> $Result {
            M::$method_of(&self.from(point), arguments)
        }
    )*};
}

impl<M: Varying> Law for Each<'_, M> {
    const HAS_INVARIANTS: bool = M::HAS_INVARIANTS;

    for_each! {
        energy by energy_of -> R,
        gradient by gradient_of -> [R; 3],
        blocks by blocks_of -> Blocks<R>,
        admits by admits_of -> R::Mask,
        energy_by_invariants by energy_by_invariants_of -> R,
        gradient_by_invariants by gradient_by_invariants_of -> [R; 3],
        admits_invariants by admits_invariants_of -> R::Mask
    }

    fn points(&self) -> Option<usize> {
        Some(self.materials().len())
    }

    fn has_pole(&self) -> bool {
        self.materials().iter().any(Material::has_pole)
    }

    fn ends_at_zero_volume(&self) -> bool {
        self.materials().iter().any(Material::ends_at_zero_volume)
    }

    fn rest_stiffness(&self) -> f64 {
        self.materials().iter().map(Law::rest_stiffness).fold(0.0, f64::max)
    }
}

/// What is wrong with energies, as bits of the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Verdict {
    /// Outside the domain.
    pub refused: u64,
    /// The energy or a stretch is infinite or NaN, or a stretch comes within a factor 16 of it.
    pub nonfinite: u64,
}

/// Principal stretches of a tile, or invariants where a method says so, and how to compute with them.
#[derive(Clone, Copy, Debug)]
pub struct TileOf<'a, E> {
    /// The instructions to use.
    pub backend: Backend,
    /// Number of its first point in the batch.
    pub start: usize,
    /// How many points it has.
    pub count: usize,
    pub(crate) arguments: &'a Rows<E, 3>,
}

impl<E: Scalar, L: Law> Energy<E> for L {
    fn energies(&self, tile: TileOf<'_, E>, energies: &mut Rows<E, 1>) -> Verdict {
        struct Energies<'a, L, E>(&'a L, TileOf<'a, E>, &'a mut Rows<E, 1>);
        impl<L: Law, E: Scalar> Kernel<E> for Energies<'_, L, E> {
            type Output = Verdict;
            #[inline(always)]
            fn run<R: Lanes<Scalar = E>>(self) -> Verdict {
                let Self(law, tile, energies) = self;
                let (mut admitted, mut finite) = (0, 0);
                for_each_group!(R, tile.count, |at| {
                    let stretches = tile.arguments.get_all::<R>(at);
                    let energy = law.energy(tile.start + at, stretches);
                    energies.set(0, at, energy);
                    finite |= R::bits(energy_is_finite(stretches, energy)) << at;
                    admitted |= R::bits(law.admits(tile.start + at, stretches)) << at;
                });
                let points = first_bits(tile.count);
                Verdict { refused: !admitted & points, nonfinite: !finite & points }
            }
        }
        tile.backend.run(Energies(self, tile, energies))
    }

    fn gradients(&self, tile: TileOf<'_, E>, gradients: &mut Rows<E, 3>) -> u64 {
        struct Gradients<'a, L, E>(&'a L, TileOf<'a, E>, &'a mut Rows<E, 3>);
        impl<L: Law, E: Scalar> Kernel<E> for Gradients<'_, L, E> {
            type Output = u64;
            #[inline(always)]
            fn run<R: Lanes<Scalar = E>>(self) -> u64 {
                let Self(law, tile, gradients) = self;
                let mut admitted = 0;
                for_each_group!(R, tile.count, |at| {
                    let stretches = tile.arguments.get_all::<R>(at);
                    gradients.set_all(at, law.gradient(tile.start + at, stretches));
                    admitted |= R::bits(law.admits(tile.start + at, stretches)) << at;
                });
                !admitted & first_bits(tile.count)
            }
        }
        tile.backend.run(Gradients(self, tile, gradients))
    }

    fn blocks(&self, tile: TileOf<'_, E>, blocks: &mut Rows<E, 15>) -> u64 {
        struct All<'a, L, E>(&'a L, TileOf<'a, E>, &'a mut Rows<E, 15>);
        impl<L: Law, E: Scalar> Kernel<E> for All<'_, L, E> {
            type Output = u64;
            #[inline(always)]
            fn run<R: Lanes<Scalar = E>>(self) -> u64 {
                let Self(law, tile, blocks) = self;
                let mut admitted = 0;
                for_each_group!(R, tile.count, |at| {
                    let stretches = tile.arguments.get_all::<R>(at);
                    blocks.set_all(at, to_numbers(&law.blocks(tile.start + at, stretches)));
                    admitted |= R::bits(law.admits(tile.start + at, stretches)) << at;
                });
                !admitted & first_bits(tile.count)
            }
        }
        tile.backend.run(All(self, tile, blocks))
    }

    fn has_invariants(&self) -> bool {
        L::HAS_INVARIANTS
    }

    fn energies_by_invariants(&self, tile: TileOf<'_, E>, energies: &mut Rows<E, 1>) -> u64 {
        struct Energies<'a, L, E>(&'a L, TileOf<'a, E>, &'a mut Rows<E, 1>);
        impl<L: Law, E: Scalar> Kernel<E> for Energies<'_, L, E> {
            type Output = u64;
            #[inline(always)]
            fn run<R: Lanes<Scalar = E>>(self) -> u64 {
                let Self(law, tile, energies) = self;
                let mut taken = 0;
                for_each_group!(R, tile.count, |at| {
                    let invariants = tile.arguments.get_all::<R>(at);
                    let energy = law.energy_by_invariants(tile.start + at, invariants);
                    energies.set(0, at, energy);
                    let admitted = law.admits_invariants(tile.start + at, invariants);
                    taken |= R::bits(admitted & energy.is_finite()) << at;
                });
                taken & first_bits(tile.count)
            }
        }
        if L::HAS_INVARIANTS { tile.backend.run(Energies(self, tile, energies)) } else { 0 }
    }

    fn gradients_by_invariants(&self, tile: TileOf<'_, E>, gradients: &mut Rows<E, 3>) -> u64 {
        struct Gradients<'a, L, E>(&'a L, TileOf<'a, E>, &'a mut Rows<E, 3>);
        impl<L: Law, E: Scalar> Kernel<E> for Gradients<'_, L, E> {
            type Output = u64;
            #[inline(always)]
            fn run<R: Lanes<Scalar = E>>(self) -> u64 {
                let Self(law, tile, gradients) = self;
                let mut taken = 0;
                for_each_group!(R, tile.count, |at| {
                    let invariants = tile.arguments.get_all::<R>(at);
                    gradients.set_all(at, law.gradient_by_invariants(tile.start + at, invariants));
                    taken |= R::bits(law.admits_invariants(tile.start + at, invariants)) << at;
                });
                taken & first_bits(tile.count)
            }
        }
        if L::HAS_INVARIANTS { tile.backend.run(Gradients(self, tile, gradients)) } else { 0 }
    }

    fn points(&self) -> Option<usize> {
        Law::points(self)
    }

    fn has_pole(&self) -> bool {
        Law::has_pole(self)
    }

    fn ends_at_zero_volume(&self) -> bool {
        Law::ends_at_zero_volume(self)
    }

    fn rest_stiffness(&self) -> f64 {
        Law::rest_stiffness(self)
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
