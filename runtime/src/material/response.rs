//! The responses of a material one by one: forwarded by pointers, and behind `dyn` where a type is known at run time only.

use std::sync::Arc;

use super::{Blocks, Inversion, Material, Moduli};
use crate::lanes::{Real, Scalar};

/// Hands every response of a [`Material`] to a macro: whatever forwards them all then forwards a new one too.
///
/// Linear responses add up where energies do; the others are masks of a domain.
macro_rules! with_responses {
    ($callback:ident $($context:tt)*) => {
        $callback! {
            [$($context)*]
            linear {
                energy -> R,
                gradient -> [R; 3],
                gradient_at_strains -> [R; 3],
                blocks -> Blocks<R>,
                energy_and_blocks -> (R, Blocks<R>),
                energy_by_invariants -> R,
                gradient_by_invariants -> [R; 3],
            }
            domain { admits, admits_invariants }
        }
    };
}
pub(super) use with_responses;

macro_rules! declare_response {
    ([] linear { $($linear:ident -> $Linear:ty,)* } domain { $($domain:ident),* }) => {
        /// Responses of a material for one type of real number: implemented for every [`Material`].
        ///
        /// The functions of [`point`](crate::point) take this trait, and so they take a `dyn` [`DynMaterial`] as well. To write a
        /// material by hand, implement [`Material`].
        #[diagnostic::on_unimplemented(
            message = "`{Self}` is not a material",
            label = "expected a material",
            note = "declare one with `#[piola::material]`, or implement `piola::Material`",
            note = "where the type is known at run time only, use `dyn piola::material::DynMaterial<f64>`"
        )]
        pub trait Response<R: Real>: Send + Sync {
            $(
                #[doc = concat!("Forwards to [`Material::", stringify!($linear), "`].")]
                fn $linear(&self, at: [R; 3]) -> $Linear;
            )*
            $(
                #[doc = concat!("Forwards to [`Material::", stringify!($domain), "`].")]
                fn $domain(&self, at: [R; 3]) -> R::Mask;
            )*
            /// Forwards to [`Material::has_pole`].
            fn has_pole(&self) -> bool;
            /// Forwards to [`Material::ends_at_zero_volume`].
            fn ends_at_zero_volume(&self) -> bool;
        }

        impl<M: Material, R: Real> Response<R> for M {
            $(
                #[inline(always)]
                fn $linear(&self, at: [R; 3]) -> $Linear {
                    Material::$linear(self, at)
                }
            )*
            $(
                #[inline(always)]
                fn $domain(&self, at: [R; 3]) -> R::Mask {
                    Material::$domain(self, at)
                }
            )*
            #[inline]
            fn has_pole(&self) -> bool {
                Material::has_pole(self)
            }
            #[inline]
            fn ends_at_zero_volume(&self) -> bool {
                Material::ends_at_zero_volume(self)
            }
        }
    };
}
with_responses!(declare_response);

macro_rules! forward_to_pointee {
    ([$($head:tt)*] linear { $($linear:ident -> $Linear:ty,)* } domain { $($domain:ident),* }) => {
        $($head)* {
            const HAS_INVARIANTS: bool = M::HAS_INVARIANTS;
            $(
                #[inline(always)]
                fn $linear<R: Real>(&self, at: [R; 3]) -> $Linear {
                    (**self).$linear(at)
                }
            )*
            $(
                #[inline(always)]
                fn $domain<R: Real>(&self, at: [R; 3]) -> R::Mask {
                    (**self).$domain(at)
                }
            )*
            fn has_pole(&self) -> bool {
                (**self).has_pole()
            }
            fn ends_at_zero_volume(&self) -> bool {
                (**self).ends_at_zero_volume()
            }
            fn inversion(&self) -> Inversion {
                (**self).inversion()
            }
            fn stated_moduli(&self) -> Option<Moduli> {
                (**self).stated_moduli()
            }
        }
    };
}
with_responses!(forward_to_pointee impl<M: Material> Material for &M);
with_responses!(forward_to_pointee impl<M: Material> Material for Box<M>);
with_responses!(forward_to_pointee impl<M: Material> Material for Arc<M>);

/// A material whose type is known at run time only: `Box<dyn DynMaterial<f64>>`.
///
/// Every [`Material`] is one, in `f64` and `f32`. The functions of [`point`](crate::point) take it, and with feature `batch`
/// so does `Batch`.
///
/// ```
/// use piola::material;
/// use piola::material::DynMaterial;
/// use piola::point::{Filter, evaluate};
///
/// /// μ Σ(λ − 1)².
/// #[material]
/// fn Springs([l1, l2, l3]: [f64; 3], /** Stiffness, Pa. */ mu: f64) -> f64 {
///     mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let materials: Vec<Box<dyn DynMaterial<f64>>> = vec![Box::new(Springs::new(1.0)?), Box::new(Springs::new(2.0)?)];
/// let F = [[1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(evaluate(&*materials[1], &F, Filter::None).stress[0][0], 2.0);
/// # Ok(())
/// # }
/// ```
pub trait DynMaterial<E: Scalar>: Response<E> + Tiles<E> {}

impl<E: Scalar, M: Material> DynMaterial<E> for M {}

#[cfg(feature = "batch")]
use crate::batch::TileMaterial as Tiles;

/// Nothing where there are no batches.
#[cfg(not(feature = "batch"))]
pub trait Tiles<E> {}

#[cfg(not(feature = "batch"))]
impl<E, M: ?Sized> Tiles<E> for M {}
