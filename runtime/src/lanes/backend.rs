//! Choice of the instructions that a kernel runs with, at run time.

#![cfg_attr(
    target_arch = "x86_64",
    expect(
        unsafe_code,
        reason = "calls of functions compiled for instructions that the processor was found to have"
    )
)]

use std::fmt;

use super::lanes2::Lanes2;
use super::vector::{InstructionSet, Lanes, Scalar};
#[cfg(target_arch = "x86_64")]
use super::x86::{F32x8, F32x16, F64x4, F64x8};

/// A computation written for the lanes of any back end.
///
/// `run` must be `#[inline(always)]`, and so must all arithmetic that it calls: only code that is inlined
/// into the function of the back end is compiled for its instructions.
pub trait Kernel<E: Scalar>: Sized {
    /// The result of the computation.
    type Output;

    /// Computes with lanes of type `R`.
    fn run<R: Lanes<Scalar = E>>(self) -> Self::Output;

    // The functions of the back ends, for `Backend::run` alone. They are methods of the kernel because the
    // compiler places a method with the module of its type: kernels of several modules are then compiled at
    // the same time.

    /// [`run`](Self::run) with the instructions of AVX-512.
    ///
    /// # Safety
    /// The processor has AVX-512F, AVX-512DQ, AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    #[doc(hidden)]
    #[target_feature(enable = "avx512f,avx512dq,avx2,fma")]
    unsafe fn with_avx512(self) -> Self::Output {
        align_stack();
        self.run::<E::In<Avx512>>()
    }

    /// [`run`](Self::run) with the instructions of AVX2.
    ///
    /// # Safety
    /// The processor has AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    #[doc(hidden)]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn with_avx2(self) -> Self::Output {
        align_stack();
        self.run::<E::In<Avx2>>()
    }

    /// [`run`](Self::run) with the instructions of every processor.
    #[doc(hidden)]
    fn portable(self) -> Self::Output {
        self.run::<E::In<Portable>>()
    }
}

/// Instruction set of this processor, which kernels run with.
///
/// ```
/// use piola::lanes::Backend;
///
/// let fastest = Backend::best();
/// assert!(Backend::available().any(|backend| backend == fastest));
/// assert!(Backend::available().any(|backend| backend.name() == "portable"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Backend(Instructions);

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Instructions {
    #[cfg(target_arch = "x86_64")]
    Avx512,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    Portable,
}

impl Backend {
    /// The fastest back end of this processor.
    #[must_use]
    pub fn best() -> Self {
        Self::available().next().unwrap_or(Self::portable())
    }

    /// The back end of every processor: arrays of numbers, which the compiler vectorises for its target.
    #[must_use]
    pub const fn portable() -> Self {
        Self(Instructions::Portable)
    }

    /// The back ends of this processor, the fastest first.
    pub fn available() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let vector = {
            let has_avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            let has_avx512 = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq");
            // Kernels on the registers of AVX-512 are compiled for the instructions of both.
            [(has_avx512 && has_avx2).then_some(Instructions::Avx512), has_avx2.then_some(Instructions::Avx2)]
        };
        #[cfg(not(target_arch = "x86_64"))]
        let vector: [Option<Instructions>; 0] = [];
        vector.into_iter().flatten().chain([Instructions::Portable]).map(Self)
    }

    /// Name of the back end: `AVX-512`, `AVX2` or `portable`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512 => "AVX-512",
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => "AVX2",
            Instructions::Portable => "portable",
        }
    }

    /// Runs a kernel with the lanes of this back end.
    #[doc(hidden)]
    #[inline]
    pub fn run<E: Scalar, K: Kernel<E>>(self, kernel: K) -> K::Output {
        match self.0 {
            // SAFETY: `available` alone makes a `Backend` of these instructions, having found them.
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512 => unsafe { kernel.with_avx512() },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => unsafe { kernel.with_avx2() },
            Instructions::Portable => kernel.portable(),
        }
    }
}

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Makes the compiler align the stack frame of the calling function to the widest register.
///
/// Compilers align a frame for variables that ask for it, not for spilled registers. Unaligned, most of these
/// cross the border of a cache line, and a kernel takes half as long again.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn align_stack() {
    #[repr(align(64))]
    struct Line([u8; 64]);
    let line = Line([0; 64]);
    std::hint::black_box(&line.0);
}

/// The registers of AVX-512.
#[cfg(target_arch = "x86_64")]
struct Avx512;

#[cfg(target_arch = "x86_64")]
impl InstructionSet for Avx512 {
    type F64 = F64x8;
    type F32 = F32x16;
}

/// The registers of AVX2.
#[cfg(target_arch = "x86_64")]
struct Avx2;

#[cfg(target_arch = "x86_64")]
impl InstructionSet for Avx2 {
    type F64 = F64x4;
    type F32 = F32x8;
}

/// The lanes of every processor: pairs, which compilers turn into registers of 16 bytes. One lane at a time
/// takes 1.3 to 3.6 times the instructions on x86-64.
struct Portable;

impl InstructionSet for Portable {
    type F64 = Lanes2<f64>;
    type F32 = Lanes2<Lanes2<f32>>;
}
