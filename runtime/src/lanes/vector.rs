//! Lanes and their number formats: the types that a kernel loads, computes with and stores.

use std::fmt::Debug;

use super::primitive::Primitive;
use super::real::Real;

/// Lanes of one number format: a [`Real`] that is loaded from slices and stored to them.
pub trait Lanes: Real {
    /// The number format of a lane.
    type Scalar: Scalar;

    /// Several registers that take turns, for kernels whose operations wait for each other.
    ///
    /// Each gets the bits that it would get alone. On x86-64 there are two: the singular value decomposition
    /// spills with them, and is still faster than with one. Scalars and portable lanes are their own.
    #[doc(hidden)] // for the kernels of batches
    type Interleaved: Lanes<Scalar = Self::Scalar>;

    /// The number of lanes.
    const LANES: usize;

    /// Loads the first [`LANES`](Self::LANES) entries of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    fn load(from: &[Self::Scalar]) -> Self;

    /// Loads one component of consecutive points from blocks of [`LINE`](Scalar::LINE) points.
    ///
    /// A block has `components` lines, one after the other, and each line one component of LINE points. So
    /// lane i comes from `from[i / LINE * components * LINE + i % LINE]`.
    ///
    /// # Panics
    /// If the slice is shorter.
    #[doc(hidden)] // for the kernels of batches
    #[inline(always)]
    fn load_lines(from: &[Self::Scalar], components: usize) -> Self {
        // A register is no longer than a line.
        let _ = components;
        Self::load(from)
    }

    /// Stores the lanes into the first [`LANES`](Self::LANES) entries of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    fn store(self, to: &mut [Self::Scalar]);

    /// Brings up to [`LINE`](Scalar::LINE) points, each with its N components one after the other, to a line:
    /// component k of point p from `from[p * N + k]` to `to[k * LINE + p]`.
    ///
    /// N is not zero. An incomplete last point stays behind; more points than LINE mix with each other.
    ///
    /// # Panics
    /// If an entry lies outside of its slice.
    #[doc(hidden)] // for the kernels of batches
    #[inline(never)]
    fn points_to_line<const N: usize>(from: &[Self::Scalar], to: &mut [Self::Scalar]) {
        for (p, point) in from.as_chunks::<N>().0.iter().enumerate() {
            for k in 0..N {
                to[k * <Self::Scalar as Scalar>::LINE + p] = point[k];
            }
        }
    }

    /// Brings N components of the first points of a line to these points: component k of point p from
    /// `from[k * LINE + p]` to `to[p * N + k]`.
    ///
    /// N is not zero, and there are at most [`LINE`](Scalar::LINE) points.
    ///
    /// # Panics
    /// If an entry lies outside of its slice.
    #[doc(hidden)] // for the kernels of batches
    #[inline(never)]
    fn line_to_points<const N: usize>(from: &[Self::Scalar], points: usize, to: &mut [Self::Scalar]) {
        let to = &mut to.as_chunks_mut::<N>().0[..points];
        for (p, point) in to.iter_mut().enumerate() {
            for k in 0..N {
                point[k] = from[k * <Self::Scalar as Scalar>::LINE + p];
            }
        }
    }

    /// A mask as bits: bit i is set if lane i is.
    fn bits(mask: Self::Mask) -> u64;
}

/// A format of floating-point numbers: `f64` or `f32`.
pub trait Scalar:
    Primitive + Lanes<Scalar = Self, Mask = bool> + Default + PartialEq + PartialOrd + Debug + Into<f64>
{
    /// Number of values that fill a cache line of 64 bytes; blocks of points are laid out in such lines.
    const LINE: usize;

    /// The lanes of this format in a set of instructions.
    ///
    /// Safe code must not name registers that the processor may not have. Code outside of this crate cannot,
    /// since it has no name for any `I`.
    #[doc(hidden)]
    type In<I: InstructionSet>: Lanes<Scalar = Self>;

    /// Slices by their format, so that a kernel for each is compiled once, in this crate.
    #[doc(hidden)]
    fn by_format<'a>(from: &'a [Self], to: &'a mut [Self]) -> ByFormat<'a>;
}

/// Slices of one format.
#[derive(Debug)]
pub enum ByFormat<'a> {
    /// Arrays of `f64`.
    F64(&'a [f64], &'a mut [f64]),
    /// Arrays of `f32`.
    F32(&'a [f32], &'a mut [f32]),
}

/// A set of instructions, by its lanes for each number format.
pub trait InstructionSet {
    /// Lanes of double precision.
    type F64: Lanes<Scalar = f64>;
    /// Lanes of single precision.
    type F32: Lanes<Scalar = f32>;
}
