//! A material behind `dyn`, for points and, with feature `batch`, for tiles.

#[cfg(feature = "batch")]
use crate::batch::TileMaterial as Tiles;
use crate::lanes::Scalar;
use crate::material::{Material, Response};

/// Material of any type, behind `dyn`: the bound for functions and structs that take or keep a material,
/// except for [`contract`](mod@crate::contract), which takes a [`Material`].
///
/// Every [`Material`] is one, in `f64` and `f32`, and `dyn DynMaterial<f64>` is one whose type is known at
/// run time only. Points and batches take it by reference, bodies by value; a part of a body takes it in a
/// `Box`.
///
/// ```
/// use piola::DynMaterial;
/// use piola::point::{Filter, Point, evaluate};
///
/// fn sheared(material: &dyn DynMaterial<f64>) -> Point<f64> {
///     evaluate(material, &[[1.0, 0.1, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], Filter::None)
/// }
///
/// # #[cfg(feature = "batch")]
/// fn energies(material: &dyn DynMaterial<f64>, F: &[f64], to: &mut [f64]) -> Result<(), Box<dyn std::error::Error>> {
///     piola::batch::Batch::new(material).energies(F, to)?;
///     Ok(())
/// }
///
/// /// μ Σ(λ − 1)².
/// #[piola::material]
/// fn Springs([l1, l2, l3]: [f64; 3], /** Stiffness, Pa. */ mu: f64) -> f64 {
///     mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let materials: Vec<Box<dyn DynMaterial<f64>>> = vec![Box::new(Springs::new(1.0)?), Box::new(Springs::new(2.0)?)];
/// assert!(sheared(&*materials[0]).status.is_clean());
/// # Ok(())
/// # }
/// ```
pub trait DynMaterial<E: Scalar>: Response<E> + Tiles<E> {}

impl<E: Scalar, M: Material> DynMaterial<E> for M {}

/// Empty trait without the feature `batch`.
#[cfg(not(feature = "batch"))]
pub trait Tiles<E> {}

#[cfg(not(feature = "batch"))]
impl<E, M: ?Sized> Tiles<E> for M {}
