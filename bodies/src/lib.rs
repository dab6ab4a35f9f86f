//! Bodies of tetrahedra that move: meshes, sparse stiffness, implicit time steps and statics.
//!
//! The material is any energy declared with [`#[piola::material]`](macro@piola::material), or a
//! [`DynMaterial`](piola::DynMaterial). Elements may be flat or inverted, at the start or on the way.
//!
//! A bar of tetrahedra, held at one end, sags by implicit Euler steps of 1/30 s and comes to rest. `Body`
//! takes any mesh; integrators of higher order, contact and linear solvers are settings of `Simulation`.
//!
//! ```
//! use piola_bodies::mesh::tetrahedral_box;
//! use piola_bodies::step::{Simulation, SimulationSettings};
//! use piola_bodies::system::{Body, Pins};
//!
//! /// Compressible neo-Hookean rubber; mu and lambda in Pa.
//! #[piola::material(domain(J > 0.0), extend)]
//! fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let mesh = tetrahedral_box([4, 1, 1], [0.4, 0.1, 0.1])?;
//!     let pins = Pins::at((0..mesh.positions.len()).filter(|&node| mesh.positions[node][0] == 0.0));
//!     let body = Body::new(&mesh, Rubber::new(1e5, 4e5)?, 1000.0)?;
//!     let settings = SimulationSettings { gravity: [0.0, -9.81, 0.0], ..Default::default() };
//!     let mut bar = Simulation::new(body, &pins, settings)?;
//!     for _ in 0..150 {
//!         bar.step(1.0 / 30.0)?;
//!     }
//!     let tip = mesh.positions.len() - 1;
//!     assert!(bar.positions()[tip][1] < 0.1 - 0.01);
//!     // The pins carry 4 kg.
//!     bar.equilibrate()?;
//!     let weight: f64 = bar.reactions()?.iter().map(|force| force[1]).sum();
//!     assert!((weight - 39.24).abs() < 1e-3);
//!     Ok(())
//! }
//! ```
//! [`Body::from_parts`](system::Body::from_parts) makes bodies of several materials. The state of a
//! simulation is its positions, velocities and accelerations. `docs/bodies.md` has an example of both.
//!
//! # Modules
//!
//! Each module depends only on those above it, and on [`piola`]:
//!
//! * [`mesh`]: tetrahedra, boxes of them, their files, embedded surfaces;
//! * [`system`]: forces, stiffness, its sparse assembly, pins, linear solvers;
//! * [`step`]: time steps by Newton's method, implicit Euler and integrators of higher order, statics.
//!
//! # Features
//!
//! * `faer`, on by default: sparse Cholesky factorisation, the fastest solver for bodies of up to some
//!   thousand elements, and the stability of equilibria. Without it this crate builds in less than half the
//!   time, and linear systems are solved by conjugate gradients with multigrid, or by a [solver of your
//!   own](step::SparseSolver).
//! * `serde`: settings and reports are written to files and read back. A value that is not finite becomes
//!   `null` in JSON and cannot be read back.
//!
//! Friction, fracture, plasticity and higher-order elements are not included. Contact is a user-defined
//! [`Term`](step::Term) of the energy, as in the example `ground` of `piola-materials`.

#[cfg(doctest)]
#[doc = include_str!("../../docs/bodies.md")]
struct Page;

#[cfg(test)]
#[allow(dead_code, reason = "each crate that includes this file needs some of it")]
#[macro_use]
#[path = "../../runtime/src/hand_written.rs"]
mod hand_written;
pub mod mesh;
pub mod step;
pub mod system;
