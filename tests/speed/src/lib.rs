//! Work to be timed and counted: the kernels of a batch on fixed points, for the table of speeds and
//! the counts of instructions.
//!
//! * [`Task`]: the work of a batch; [`Arrays`]: its input and output;
//! * [`materials`]: the energies;
//! * [`Decompositions`]: the singular value decomposition alone;
//! * [`deformation_gradients`]: the points;
//! * [`time`]: the timing of calls.
//!
//! It has few dependencies, so that instructions are counted without building the judges.

use piola::batch::TileMaterial;
use piola::lanes::Scalar;
use piola_materials::{NeoHookean, Ogden, StVenantKirchhoff};

mod arrays;
mod decomposition;
mod front;
mod task;
mod timing;

pub use arrays::Arrays;
pub use decomposition::Decompositions;
pub use front::{RESOLUTION, beats, is_on_front};
pub use task::{Task, deformation_gradients};
pub use timing::{Effort, Times, processor, time, time_in_turns};

/// Points whose numbers stay in the caches of a core.
pub const IN_CACHE: usize = 128;

/// Shear modulus of [`materials`], MPa, except for Ogden's.
pub const MU: f64 = 1.0;

/// First Lamé parameter of [`materials`], MPa.
pub const LAMBDA: f64 = 1.5;

/// A polynomial, a logarithm and three powers of each stretch: the energies that are timed, by name.
///
/// Ogden's shear part has the three terms of his rubber. No energy is faster or slower for its parameters,
/// unless a filter finds nothing to do.
#[must_use]
pub fn materials<E: Scalar>() -> [(&'static str, Box<dyn TileMaterial<E>>); 3] {
    [
        ("StVenantKirchhoff", Box::new(StVenantKirchhoff::new(MU, LAMBDA).expect("admissible parameters"))),
        ("NeoHookean", Box::new(NeoHookean::new(MU, LAMBDA).expect("admissible parameters"))),
        ("Ogden<3>", Box::new(ogden())),
    ]
}

/// The third of [`materials`].
#[must_use]
pub fn ogden() -> Ogden<3> {
    Ogden::new([0.63, 0.0012, -0.01], [1.3, 5.0, -2.0], LAMBDA).expect("admissible parameters")
}
