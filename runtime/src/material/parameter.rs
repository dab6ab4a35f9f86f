//! Parameters of an energy: one value for all points, or one for each lane.
//!
//! A declared material is generic over the representation of its parameters. With `f64`, the default, every
//! lane gets that value; with [`PerLane`] each lane gets a value of its own, for points of a graded or fitted
//! body.

use std::fmt;
use std::marker::PhantomData;
use std::sync::Arc;

#[cfg(doc)]
use super::Inversion;
use super::Material;
#[cfg(feature = "batch")]
use super::properties::Properties;
use crate::lanes::Real;

/// Representation of a parameter in a declared material.
pub trait ParameterValue: Copy + fmt::Debug + PartialEq + Send + Sync + 'static {
    /// The parameter on the lanes of a real type.
    #[doc(hidden)]
    fn on<R: Real>(&self) -> R;
}

impl ParameterValue for f64 {
    #[inline(always)]
    fn on<R: Real>(&self) -> R {
        R::splat(*self)
    }
}

/// The most lanes of any back end: 16 of `f32` in AVX-512.
const LANES: usize = 16;

/// Values of a parameter for the points on the lanes of a register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerLane([f64; LANES]);

impl PerLane {
    /// The value for each lane.
    #[inline(always)]
    pub fn gather(value: impl Fn(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }
}

impl ParameterValue for PerLane {
    #[inline(always)]
    fn on<R: Real>(&self) -> R {
        R::from_fn(|lane| self.0[lane.min(LANES - 1)])
    }
}

/// A material whose parameters may differ from point to point: every declared one.
///
/// Parameters that are numbers have a value for each lane. Other parameters, such as functions, do not: next
/// to each other, points that differ in these cost one evaluation for each of their materials. The methods
/// are internals of batches.
pub trait Graded: Material + Sized {
    /// This kind of material with parameters for each lane.
    #[doc(hidden)]
    type OnLanes<'a>: Material
    where
        Self: 'a;

    /// Materials side by side, `material(lane)` on each of at most 16 lanes.
    ///
    /// All must have the same [`inversion`](Material::inversion), threshold included, as [`PerPoint`] checks:
    /// it selects the program. Each must [share lanes](Graded::shares_lanes) with the first.
    #[doc(hidden)]
    fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes<'a>
    where
        Self: 'a;

    /// True if lanes hold this material and the other one side by side: unless they differ in parameters that
    /// are not numbers. An equivalence relation.
    #[doc(hidden)]
    #[inline(always)]
    fn shares_lanes(&self, other: &Self) -> bool {
        let _ = other;
        true
    }
}

/// Points may share materials by pointers to them.
macro_rules! graded_by_pointee {
    ($($Pointer:ty),*) => {$(
        impl<M: Graded> Graded for $Pointer {
            type OnLanes<'a> = M::OnLanes<'a> where Self: 'a;

            #[inline(always)]
            fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes<'a>
            where
                Self: 'a,
            {
                M::on_lanes(|lane| &**material(lane))
            }

            #[inline(always)]
            fn shares_lanes(&self, other: &Self) -> bool {
                M::shares_lanes(self, other)
            }
        }
    )*};
}
graded_by_pointee!(&M, Box<M>, Arc<M>);

/// A material for each point of a batch, or for each element of a part of a body, in their order.
///
/// `S` holds the list: `Vec<M>`, `&[M]`, `Arc<[M]>` or any other type that gives a slice. If many points have
/// the same material, the list may hold references, `&M` or `Arc<M>`.
///
/// ```
/// # #[cfg(feature = "batch")]
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use piola::batch::Batch;
/// use piola::material;
/// use piola::material::PerPoint;
///
/// /// μ/2 Σ(λ − 1)².
/// #[material]
/// fn Springs([l1, l2, l3]: [f64; 3], /** Stiffness, Pa. */ mu: f64) -> f64 {
///     mu / 2.0 * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
/// }
///
/// let springs = [Springs::new(1.0)?, Springs::new(2.0)?];
/// let stretch = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
/// let mut energies = [0.0; 2];
/// Batch::new(&PerPoint::new(&springs)?).energies(&[stretch, stretch].concat(), &mut energies)?;
/// assert_eq!(energies, [0.5, 1.0]);
/// # Ok(())
/// # }
/// # #[cfg(not(feature = "batch"))]
/// # fn main() {}
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PerPoint<M, S = Vec<M>> {
    materials: S,
    /// Properties of all materials together, kept because each group of elements reads them.
    #[cfg(feature = "batch")]
    pub(crate) properties: Properties,
    material: PhantomData<M>,
}

impl<M: Graded, S: AsRef<[M]>> PerPoint<M, S> {
    /// Builds the list from a material for each point; all must have the same [`Inversion`].
    ///
    /// # Errors
    /// [`PerPointError`] if there is no material, or if two differ in their [`Inversion`].
    pub fn new(materials: S) -> Result<Self, PerPointError> {
        let list = materials.as_ref();
        let empty = "the list of materials is empty: give one material for each point";
        let first = list.first().ok_or_else(|| PerPointError(empty.to_owned()))?.inversion();
        match list.iter().position(|material| material.inversion() != first) {
            None => Ok(Self {
                #[cfg(feature = "batch")]
                properties: Properties::of(list, Some(list.len())),
                materials,
                material: PhantomData,
            }),
            Some(material) => Err(PerPointError(format!(
                "material {material} treats deformations outside its domain differently from material 0: \
                 build all of them with the same inversion"
            ))),
        }
    }

    /// The materials, one for each point.
    #[must_use]
    pub fn materials(&self) -> &[M] {
        self.materials.as_ref()
    }

    /// Materials of the points from `start` on; the last one is repeated for lanes beyond.
    #[cfg(feature = "batch")]
    #[inline(always)]
    pub(crate) fn from(&self, start: usize) -> M::OnLanes<'_> {
        let rest = &self.materials.as_ref()[start..];
        M::on_lanes(|lane| &rest[lane.min(rest.len() - 1)])
    }
}

/// Reason why materials cannot be evaluated together, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PerPointError(String);

impl fmt::Display for PerPointError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PerPointError {}
