//! The responses of a material one by one: forwarded by pointers.

use std::sync::Arc;

use super::{Blocks, Curvature, Inversion, Material, Moduli};
use crate::lanes::{Backend, Real, Scalar};

/// Passes every response of a [`Material`] to a macro, so that code that forwards them all forwards a new one
/// too: responses at stretches, strains or invariants, and properties that do not depend on the deformation.
macro_rules! with_responses {
    ($callback:ident $($context:tt)*) => {
        $callback! {
            [$($context)*]
            responses {
                energy -> R,
                gradient -> [R; 3],
                gradient_at_strains -> [R; 3],
                blocks -> Blocks<R>,
                energy_by_invariants -> R,
                gradient_by_invariants -> [R; 3],
                derivatives_by_invariants -> [R; 9],
                admits -> R::Mask,
                admits_invariants -> R::Mask,
            }
            properties {
                has_invariants -> bool,
                has_second_invariant -> bool,
                curvature_by_invariants -> Curvature,
                has_energy_by_invariants -> bool,
                has_pole -> bool,
                ends_at_zero_volume -> bool,
                inversion -> Inversion,
                stated_moduli -> Option<Moduli>,
            }
        }
    };
}

/// A response that many points compute together: see [`Material::respond_together`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResponseKind {
    /// [`Material::energy`], one number.
    Energy,
    /// [`Material::gradient`], three numbers.
    Gradient,
    /// [`Material::blocks`], fifteen numbers in the order of the fields of [`Blocks`].
    Blocks,
    /// [`Material::energy_by_invariants`], one number.
    EnergyByInvariants,
    /// [`Material::gradient_by_invariants`], three numbers.
    GradientByInvariants,
    /// [`Material::derivatives_by_invariants`], nine numbers.
    DerivativesByInvariants,
}

impl ResponseKind {
    /// True if its arguments are I1, I2, J instead of stretches.
    #[must_use]
    pub fn is_by_invariants(self) -> bool {
        !matches!(self, Self::Energy | Self::Gradient | Self::Blocks)
    }
}

/// Points that compute a response together: see [`Material::respond_together`].
#[derive(Debug)]
pub struct RawTile<'a, E> {
    /// Vector instructions of the kernels.
    pub backend: Backend,
    /// Number of points, at most 64.
    pub count: usize,
    /// Number of points with a material of their own; 1 if all have the same.
    pub materials: usize,
    /// Distance of the rows of arguments, and of those of results.
    pub stride: usize,
    /// Rows of the three arguments.
    pub arguments: &'a [E],
    /// Rows for the results.
    pub results: &'a mut [E],
    /// Rows that nothing reads, as bits.
    pub unread: u32,
}

macro_rules! declare_response {
    (
        [] responses { $($response:ident -> $Answer:ty,)* } properties { $($property:ident -> $Property:ty,)* }
    ) => {
        /// Responses of a material for one type of real number: implemented for every [`Material`], with the
        /// methods of the same names.
        ///
        /// The functions of [`point`](crate::point) take this trait, and so they take a `dyn`
        /// [`DynMaterial`](crate::DynMaterial) as well. To write a material by hand, implement [`Material`].
        #[diagnostic::on_unimplemented(
            message = "`{Self}` is not a material",
            label = "expected a material",
            note = "declare one with `#[piola::material]`, or implement `piola::Material`",
            note = "where the type is known at run time only, use `dyn piola::DynMaterial<f64>`"
        )]
        pub trait Response<R: Real>: Send + Sync {
            $(
                #[doc(hidden)] // those of `Material`
                fn $response(&self, at: [R; 3]) -> $Answer;
            )*
            $(
                #[doc(hidden)] // those of `Material`
                fn $property(&self) -> $Property;
            )*
        }

        impl<M: Material, R: Real> Response<R> for M {
            $(
                #[inline(always)]
                fn $response(&self, at: [R; 3]) -> $Answer {
                    Material::$response(self, at)
                }
            )*
            $(
                #[inline]
                fn $property(&self) -> $Property {
                    Material::$property(self)
                }
            )*
        }
    };
}
with_responses!(declare_response);

macro_rules! forward_to_pointee {
    (
        [$($head:tt)*]
        responses { $($response:ident -> $Answer:ty,)* } properties { $($property:ident -> $Property:ty,)* }
    ) => {
        $($head)* {
            $(
                #[inline(always)]
                fn $response<R: Real>(&self, at: [R; 3]) -> $Answer {
                    (**self).$response(at)
                }
            )*
            $(
                #[inline(always)]
                fn $property(&self) -> $Property {
                    (**self).$property()
                }
            )*
            const RESPONDS_TOGETHER: bool = M::RESPONDS_TOGETHER;
            fn respond_together<'m, E: Scalar>(
                material: impl Fn(usize) -> &'m Self + Copy,
                response: ResponseKind,
                tile: RawTile<'_, E>,
            ) -> u64
            where
                Self: 'm,
            {
                M::respond_together(|point| &**material(point), response, tile)
            }
        }
    };
}
with_responses!(forward_to_pointee impl<M: Material> Material for &M);
with_responses!(forward_to_pointee impl<M: Material> Material for Box<M>);
with_responses!(forward_to_pointee impl<M: Material> Material for Arc<M>);
