//! The contract for every material of the catalogue, unextended and extended.

use piola::Inversion;
use piola::contract::{Settings, check, moduli};
use piola::material::Declared;
use piola_materials::{
    Arap, ArrudaBoyce, FixedCorotated, Fung, Gent, Hencky, MooneyRivlin, MooneyRivlinCoupled, NeoHookean,
    Ogden, RotatedLinear, StVenantKirchhoff, StableNeoHookean, SymmetricDirichlet, Varga, Yeoh,
};

const MU: f64 = 3.5e5;
const LAMBDA: f64 = 3.1e6;
const EPSILON: f64 = 0.3;

#[track_caller]
fn keeps_it(material: impl Declared, settings: &Settings) {
    if let Err(violation) = check(&material, settings).and_then(|_| moduli(&material)) {
        panic!("{violation}");
    }
}

#[track_caller]
fn keeps_it_plain(material: Result<impl Declared, piola::material::Inadmissible>) {
    keeps_it(material.expect("admissible parameters"), &Settings::default());
}

#[track_caller]
fn keeps_it_extended(material: Result<impl Declared, piola::material::Inadmissible>) {
    keeps_it(
        material.expect("admissible parameters"),
        &Settings { threshold: Some(EPSILON), ..Settings::default() },
    );
}

fn extend() -> Inversion {
    Inversion::Extend { epsilon: EPSILON }
}

#[test]
fn st_venant_kirchhoff() {
    keeps_it_plain(StVenantKirchhoff::new(MU, LAMBDA));
}

#[test]
fn rotated_linear() {
    keeps_it_plain(RotatedLinear::new(MU, LAMBDA));
}

#[test]
fn fixed_corotated() {
    keeps_it_plain(FixedCorotated::new(MU, LAMBDA));
}

#[test]
fn stable_neo_hookean() {
    keeps_it_plain(StableNeoHookean::new(MU, LAMBDA));
}

#[test]
fn neo_hookean() {
    let material = NeoHookean::new(MU, LAMBDA);
    keeps_it_plain(material.clone());
    keeps_it_extended(material.and_then(|material| material.with_inversion(extend())));
}

#[test]
fn ogden() {
    // Ogden's 1972 set for rubber, α = 1.3, 5, −2, with a volumetric modulus.
    let material = Ogden::new([6.3e5, 1.2e3, -1e4], [1.3, 5.0, -2.0], 1e7);
    keeps_it_plain(material.clone());
    keeps_it_extended(material.and_then(|material| material.with_inversion(extend())));
    keeps_it_plain(Ogden::new([1e5], [0.5], 1e6));
}

#[test]
fn arap() {
    keeps_it_plain(Arap::new(MU));
}

#[test]
fn symmetric_dirichlet() {
    keeps_it_plain(SymmetricDirichlet::new(MU));
}

#[test]
fn fung() {
    keeps_it(
        Fung::new(MU, 0.5, 0.25).expect("admissible parameters"),
        // Beyond, the exponential amplifies rounding errors by its exponent.
        &Settings { range: (0.5, 1.6), ..Settings::default() },
    );
}

#[test]
fn gent() {
    keeps_it_plain(Gent::new(MU, 40.0, LAMBDA));
}

#[test]
fn hencky() {
    let material = Hencky::new(MU, LAMBDA);
    keeps_it_plain(material.clone());
    keeps_it_extended(material.and_then(|material| material.with_inversion(extend())));
}

#[test]
fn varga() {
    let material = Varga::new(MU, LAMBDA);
    keeps_it_plain(material.clone());
    keeps_it_extended(material.and_then(|material| material.with_inversion(extend())));
}

#[test]
fn mooney_rivlin() {
    keeps_it_plain(MooneyRivlin::new(MU, MU / 4.0, LAMBDA));
}

#[test]
fn mooney_rivlin_coupled() {
    let material = MooneyRivlinCoupled::new(MU, MU / 4.0, LAMBDA);
    keeps_it_plain(material.clone());
    keeps_it_extended(material.and_then(|material| material.with_inversion(extend())));
}

#[test]
fn yeoh() {
    keeps_it_plain(Yeoh::new(MU, -0.02 * MU, 0.001 * MU, LAMBDA));
}

#[test]
fn arruda_boyce() {
    let material = ArrudaBoyce::new(MU, 3.0, LAMBDA);
    keeps_it_plain(material.clone());
    keeps_it_extended(material.and_then(|material| material.with_inversion(extend())));
}
