//! A material behind `dyn`, for points and, with feature `batch`, for tiles.

#[cfg(feature = "batch")]
use crate::batch::TileMaterial as Tiles;
use crate::lanes::Scalar;
use crate::material::{Material, Response};

/// A material whose type is known at run time only: `Box<dyn DynMaterial<f64>>`.
///
/// Every [`Material`] is one, in `f64` and `f32`. The functions of [`point`](crate::point) take it, and with
/// feature `batch` so does `Batch`.
///
/// ```
/// use piola::{DynMaterial, material};
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

/// Nothing where there are no batches.
#[cfg(not(feature = "batch"))]
pub trait Tiles<E> {}

#[cfg(not(feature = "batch"))]
impl<E, M: ?Sized> Tiles<E> for M {}
