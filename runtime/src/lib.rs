//! Invertible isotropic hyperelasticity: stress, consistent tangent and element stiffness from an energy.
//!
//! A hyperelastic material, or constitutive model, is declared by its energy density ψ(λ1, λ2, λ3) with
//! [`#[piola::material]`](macro@material). piola computes ψ, the first Piola stress P, the consistent tangent
//! dP/dF, its positive-semidefinite (PSD) projection, and element forces and stiffness. The crate
//! `piola-bodies` computes implicit time steps of whole bodies.
//! No derivative is written by hand. Accuracy does not depend on the spacing of the stretches, and inverted
//! elements need no special treatment (invertible FEM).
//!
//! ```
//! use piola::material;
//! use piola::point::{Filter, evaluate_dense};
//!
//! /// Compressible neo-Hookean rubber; mu and lambda in Pa.
//! #[material(domain(J > 0.0), extend)]
//! pub fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let rubber = Rubber::new(1e6, 5e6)?;
//!     let shear: [[f64; 3]; 3] = [[1.0, 0.2, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//!     let point = evaluate_dense(&rubber, &shear, Filter::Clamp);
//!     assert!((point.stress[0][1] - 0.2e6).abs() < 1e-3);
//!     assert!(point.tangent[1][1] > 0.99e6);
//!     piola::contract::check(&rubber, &Default::default())?;
//!     Ok(())
//! }
//! ```
//!
//! [`Filter::Clamp`](point::Filter::Clamp) is the PSD (or SPD) projection of projected Newton methods, also
//! called Hessian clamping. It uses the analytic eigensystem of dP/dF instead of a 9×9 eigensolver.
//!
//! # By task
//!
//! | your code has | use | feature |
//! |---|---|---|
//! | many points at once: material points, arrays | [`batch`]: [program](#points-in-batches) | `batch` |
//! | tetrahedra and a sparse solver | [`batch`]: [program](#tetrahedra) | `batch` |
//! | other elements | [`batch`]: [program](#other-elements) | `batch` |
//! | a mesh that has to move; its own minimiser, integrator, linear solver or contact | the crate `piola-bodies` | – |
//! | one point a call: a UMAT, Cauchy stress | [`point`]: [program](#a-umat) | – |
//!
//! ## Points in batches
//!
//! The Kirchhoff stress τ = P Fᵀ of a thousand particles of a material-point method (MPM); the grid node i
//! receives the force −Σ V τ ∇wᵢ. `Batch::tangents` computes P and dP/dF in the same way.
//!
#![cfg_attr(feature = "batch", doc = "```")]
#![cfg_attr(not(feature = "batch"), doc = "```ignore")]
//! use piola::batch::Batch;
//! use piola::material;
//! use piola::point::measures::Measure;
//!
//! /// Compressible neo-Hookean rubber; mu and lambda in Pa.
//! #[material(domain(J > 0.0), extend)]
//! fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let rubber = Rubber::new(1e5, 4e5)?;
//!     // Nine components of each F, row by row: here a simple shear by 0.1.
//!     let F = [1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0].repeat(1000);
//!     // Six components of each τ: 11, 22, 33, 23, 13, 12.
//!     let mut tau = vec![0.0_f64; 6 * 1000];
//!     let survey = Batch::new(&rubber).measured_stresses(Measure::Kirchhoff, &F, &mut tau)?;
//!     assert!(survey.is_clean());
//!     // τ = μ (F Fᵀ − I) + λ ln J I.
//!     assert!((tau[6 * 999] - 1e3).abs() < 1e-6);
//!     assert!((tau[6 * 999 + 5] - 1e4).abs() < 1e-6);
//!     Ok(())
//! }
#![doc = "```"]
//!
//! ## Tetrahedra
//!
//! Forces and stiffness of tetrahedra for another solver, whose sparse matrix is given by slices of any
//! integer type. The rest shape of a tetrahedron is Dm⁻¹ by rows and the volume, as computed by
//! `TetMesh::rest_shapes` of `piola-bodies`.
//!
#![cfg_attr(feature = "batch", doc = "```")]
#![cfg_attr(not(feature = "batch"), doc = "```ignore")]
//! use piola::batch::{Batch, CsrPlaces, Layout, Tetrahedra};
//! use piola::point::Filter;
//!
//! /// Compressible neo-Hookean rubber; mu and lambda in Pa.
//! #[piola::material(domain(J > 0.0), extend)]
//! fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let rubber = Rubber::new(1e5, 4e5)?;
//!     let batch = Batch::new(&rubber).with_filter(Filter::Clamp);
//!     let tetrahedra = Tetrahedra::new(4, &[[0, 1, 2, 3]])?;
//!     let rest = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0 / 6.0];
//!     // Node 3 is free and has the unknowns 0 to 2; the matrix has three full rows.
//!     let (starts, columns) = ([0, 3, 6, 9], [0, 1, 2].repeat(3));
//!     let places = CsrPlaces::new(tetrahedra, |node| (node == 3).then_some(0), &starts, &columns)?;
//!     let mut x = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//!     // Newton's method: a force pulls node 3 to the stretch 1.5.
//!     let pull = (1e5 * (1.5 - 1.0 / 1.5) + 4e5 * f64::ln(1.5) / 1.5) / 6.0;
//!     for _ in 0..10 {
//!         let (mut f, mut K, mut values) = ([0.0; 12], [0.0; 144], [0.0; 9]);
//!         batch.stiffnesses_at(tetrahedra, &x, &rest, &mut f, &mut K)?;
//!         places.add(&K, Layout::Points, &mut values)?;
//!         x[3][2] += (pull - f[11]) / values[8];
//!     }
//!     assert!((x[3][2] - 1.5).abs() < 1e-12);
//!     Ok(())
//! }
#![doc = "```"]
//!
//! ## Other elements
//!
//! `Quadrature` sums over the points of elements whose shape functions your code has. The unit cube below is
//! a hexahedron with eight Gauss points, stretched by 1.1 along x. The four nodes of its face x = 1 carry the
//! stress P11. The example `bring_your_own_fem` of `piola-materials` bends a bar.
//!
#![cfg_attr(feature = "batch", doc = "```")]
#![cfg_attr(not(feature = "batch"), doc = "```ignore")]
//! use piola::batch::{Batch, Quadrature};
//!
//! /// Compressible neo-Hookean rubber; mu and lambda in Pa.
//! #[piola::material(domain(J > 0.0), extend)]
//! fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let corner = |n: usize| [n & 1, n >> 1 & 1, n >> 2].map(|bit| bit as f64);
//!     let gauss = |q| corner(q).map(|bit| 0.5 + (bit - 0.5) / f64::sqrt(3.0));
//!     // ∂N/∂X of the eight trilinear shape functions at the eight points, whose volumes are 1/8.
//!     let N = |n, axis: usize, x: f64| if corner(n)[axis] == 1.0 { x } else { 1.0 - x };
//!     let slope = |n: usize, [x, y, z]: [f64; 3]| {
//!         let sign = corner(n).map(|bit| 2.0 * bit - 1.0);
//!         let [x, y, z] = [N(n, 0, x), N(n, 1, y), N(n, 2, z)];
//!         [sign[0] * y * z, sign[1] * x * z, sign[2] * x * y]
//!     };
//!     let slopes: Vec<f64> = (0..64).flat_map(|k| slope(k % 8, gauss(k / 8))).collect();
//!     let x: Vec<f64> = (0..8).map(corner).flat_map(|[x, y, z]| [1.1 * x, y, z]).collect();
//!     let (mut F, mut P, mut dP_dF) = ([0.0; 72], [0.0; 72], [0.0; 648]);
//!     let (mut hexahedra, mut gradients, mut K) = (Quadrature::new(8, 8), [0.0; 24], [0.0; 24 * 24]);
//!     hexahedra.deform(&x, &slopes, &mut F)?;
//!     Batch::new(&Rubber::new(1e5, 4e5)?).tangents(&F, &mut P, &mut dP_dF)?;
//!     hexahedra.gradients(&slopes, &[0.125; 8], &P, &mut gradients)?;
//!     hexahedra.stiffnesses(&slopes, &[0.125; 8], &dP_dF, &mut K)?;
//!     let force: f64 = [1, 3, 5, 7].map(|n| gradients[3 * n]).iter().sum();
//!     assert!((force - 1e5 * (1.1 - 1.0 / 1.1) - 4e5 * f64::ln(1.1) / 1.1).abs() < 1e-9);
//!     Ok(())
//! }
#![doc = "```"]
//!
//! ## A UMAT
//!
//! The call of a finite-element solver with user materials: F in, Cauchy stress and consistent tangent out.
//! `Measure::Jaumann` is the pair that Abaqus calls STRESS and DDSDDE; `Kirchhoff`, `Cauchy` (Truesdell
//! rate), `GreenNaghdi` and `SecondPiola` (total Lagrangian) are the others. `bindings/c` has a `umat_`.
//!
//! ```
//! use piola::Material;
//! use piola::point::measures::{Measure, voigt::Matrix6};
//! use piola::point::{Filter, evaluate};
//!
//! /// Compressible neo-Hookean rubber; mu and lambda in Pa.
//! #[piola::material(domain(J > 0.0))]
//! fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! /// STRESS and DDSDDE in the order 11, 22, 33, 12, 13, 23; `None` if the increment must be cut.
//! fn umat(material: &impl Material, F: [[f64; 3]; 3]) -> Option<([f64; 6], Matrix6<f64>)> {
//!     let point = evaluate(material, &F, Filter::None);
//!     let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
//!     let stress = Measure::Jaumann.stress(&svd, blocks.gradient);
//!     let tangent = Measure::Jaumann.tangent(&svd, blocks);
//!     let order = [0, 1, 2, 5, 4, 3];
//!     let ddsdde = order.map(|i| order.map(|j| tangent[i][j]));
//!     point.status.is_clean().then_some((order.map(|i| stress[i]), ddsdde))
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let rubber = Rubber::new(1e6, 4e6)?;
//!     let shear = [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//!     let (stress, ddsdde) = umat(&rubber, shear).ok_or("outside of the domain")?;
//!     assert!((stress[3] - 0.5e6).abs() < 1e-3 && (ddsdde[3][3] - 1.125e6).abs() < 1e-3);
//!     assert!(umat(&rubber, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]).is_none());
//!     Ok(())
//! }
//! ```
//!
//! # Modules
//!
//! Code that stores or passes a material of any type uses [`DynMaterial`]: `&dyn DynMaterial<f64>` for points
//! and batches, `impl DynMaterial<f64> + 'static` or a `Box` for bodies. Only [`contract`](mod@contract)
//! requires `impl` [`Material`], because it computes with dual numbers and in single precision too.
//!
//! Each module depends only on those above it:
//!
//! * [`lanes`]: real numbers, one at a time or side by side in vector registers;
//! * [`material`](mod@material): the trait that energies implement, generated or by hand;
//! * [`univariate`]: curves as parameters of an energy;
//! * [`point`]: P and dP/dF from F through a signed singular value decomposition, and other measures of
//!   stress;
//! * [`batch`]: slices of many points, on vector lanes and threads (feature `batch`);
//! * `convert`: matrices from and to nalgebra (feature `nalgebra`);
//! * [`contract`](mod@contract): requirements on every material, as tests in one line or functions;
//! * `interpreter`: materials whose energy is known only at run time, made by `piola-declare` (feature
//!   `interpreter`).
//!
//! Without features, which is the default, piola depends only on its macro and builds in seconds: enough to
//! declare materials, test them and evaluate them at points. `batch` adds rayon; `f32` adds batches in single
//! precision.
//!
//! `serde` writes and reads settings, reports, splines and materials declared with the word `serde`. A value
//! that is not finite becomes `null` in JSON and cannot be read back.
//!
//! Friction, fracture, plasticity and higher-order elements are not included. Contact is a user-defined term
//! of the energy, as in the example `ground` of `piola-materials`.

// Links to modules whose feature is off.
#![cfg_attr(not(feature = "batch"), doc = "", doc = "[`batch`]: https://docs.rs/piola/latest/piola/batch/")]

extern crate self as piola;

#[doc(hidden)]
pub mod __private;
#[cfg(feature = "batch")]
pub mod batch;
pub mod contract;
#[cfg(any(feature = "nalgebra", test))]
pub mod convert;
mod dynamic;
#[cfg(test)]
#[allow(dead_code, reason = "each crate that includes this file needs some of it")]
mod hand_written;
// Its kernels are not compiled a second time for the unit tests, none of which needs them.
#[cfg(all(feature = "interpreter", not(test)))]
pub mod interpreter;
#[cfg(feature = "batch")]
mod kernels;
pub mod lanes;
pub mod material;
mod message;
#[cfg(feature = "batch")]
mod no_such_node;
pub mod point;
mod quotient;
mod random;
mod status;
pub mod univariate;

pub use dynamic::DynMaterial;
pub use lanes::Real;
pub use material::{Inversion, Material};
#[cfg(feature = "batch")]
pub use no_such_node::NoSuchNode;
pub use piola_macros::material;
pub use status::{Status, StatusCell, Survey};
pub use univariate::{Spline, Univariate};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
