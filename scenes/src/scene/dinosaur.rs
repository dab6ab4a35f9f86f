//! A dinosaur pulled by its head.
//!
//! \[Ogden72\] Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment for
//! incompressible rubberlike solids*, 1972.

use piola::material::Moduli;
use piola::mesh::Bounds;
use piola::step::Damping;

use super::{Asset, Pull, Scene, Start};
use crate::energy::Energy;
use crate::region::EVERYWHERE;
use crate::render::Style;

const HEAD: Bounds = Bounds { min: [0.8, 0.8, f64::NEG_INFINITY], ..EVERYWHERE };

/// Its head is drawn aside by one and a half body heights and let go.
pub const DINOSAUR: Scene = Scene {
    name: "dinosaur",
    about: "a dinosaur with pinned feet is pulled aside by its head, one and a half body heights far, and let go",
    mesh: Asset { name: "dinosaur.msh", text: include_str!("../../assets/dinosaur.msh") },
    surface: Asset { name: "dinosaur.obj", text: include_str!("../../assets/dinosaur.obj") },
    energy: ogden,
    density: 1000.0,
    damping: Damping::Mass { rate: 2.0 },
    dt: 1.0 / 30.0,
    frames: 360,
    pinned: Bounds { max: [f64::INFINITY, 0.08, f64::INFINITY], ..EVERYWHERE },
    start: Start::Rest,
    pulls: &[Pull { region: HEAD, by: [0.0, 0.0, 1.5], reached: 1.5, released: 2.0 }],
    style: Style { colour: [0.20, 0.36, 0.13], azimuth: 60.0, elevation: 20.0 },
};

/// The same, five body heights far: elements turn inside out while the head is still being pulled.
///
/// Ogden's energy ends at det F = 0; its extension lets them pass (det F reaches about −0.2, and −0.4 on the way back) and
/// restores them.
pub const DINOSAUR_OVERSTRETCHED: Scene = Scene {
    name: "dinosaur-overstretched",
    about: "the same pull, five body heights far, so that elements turn inside out before it is let go",
    pulls: &[Pull { region: HEAD, by: [0.0, 0.0, 5.0], reached: 2.0, released: 2.5 }],
    frames: 375,
    ..DINOSAUR
};

/// Ogden's three terms \[Ogden72\] with the shear modulus shared 0.6 : 0.2 : 0.2 among them.
///
/// The small-strain shear modulus is Σ μₚαₚ/2, so a term with the share s has μₚ = 2 s μ/αₚ; the bulk response is that
/// of the first Lamé parameter.
fn ogden() -> Energy {
    const EXPONENTS: [f64; 3] = [1.3, 5.0, -2.0];
    const SHARES: [f64; 3] = [0.6, 0.2, 0.2];
    let moduli = Moduli::from_young_poisson(1e6, 0.45);
    let mu: [f64; 3] = std::array::from_fn(|p| 2.0 * SHARES[p] * moduli.mu / EXPONENTS[p]);
    Energy::of("Ogden").with("mu", mu).with("alpha", EXPONENTS).with("kappa", [moduli.lambda])
}
