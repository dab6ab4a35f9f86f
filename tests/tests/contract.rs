//! The contract for every material of the catalogue, unextended and extended.

use piola::Inversion;
use piola::contract::{Settings, check, moduli};
use piola::material::Declared;
use piola_materials::{
    FixedCorotated, NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff, StableNeoHookean,
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
