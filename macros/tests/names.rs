//! Names straight from a paper need no further word where a crate denies all warnings.

#![deny(warnings)]

use piola::Material;
use piola::material::Declared;

/// Letters of either case, Greek ones among them.
#[piola::material(
    domain(J > 0.0, I1 - 3.0 < Jm),
    admissible(Jm > 0.0, β[p] > 0.0),
    extend(K >= 0.0),
    fit
)]
pub fn Solid<const N: usize>(
    [λ1, λ2, λ3]: [f64; 3],
    /// Bulk modulus, Pa.
    K: f64,
    /// Exponents.
    β: [f64; N],
    /// Moduli, Pa.
    C: [f64; N],
    /// Modulus, Pa.
    C10: f64,
    /// Limit of I1 − 3.
    Jm: f64,
) -> f64 {
    let Shape = sum(|p| C[p] / β[p] * (λ1.powf(β[p]) + λ2.powf(β[p]) + λ3.powf(β[p]) - 3.0 - β[p] * J.ln()));
    Shape - C10 * (Jm * (1.0 - (I1 - 3.0) / Jm).ln() + 2.0 * J.ln()) + K / 2.0 * (J - 1.0).powi(2)
}

/// An energy by invariants, with a constructor from a pair of moduli.
#[piola::material(domain(J > 0.0))]
pub fn Pair(
    [L1, L2, L3]: [f64; 3],
    /** Pa. */
    G: f64,
    /** Pa. */
    K__: f64,
) -> f64 {
    G / 2.0 * (I1b - 3.0) + K__ / 2.0 * (J - 1.0).powi(2)
}

/// An energy with a function.
#[piola::material]
pub fn Curve(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    W: piola::Spline,
) -> f64 {
    W(l1) + W(l2) + W(l3)
}

/// An energy without parameters.
#[piola::material]
pub fn Springs([l1, l2, l3]: [f64; 3]) -> f64 {
    (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2)
}

#[test]
fn the_names_are_those_of_the_declaration() {
    let solid = Solid::new(1e6, [2.0, 4.0], [1e5, 1e3], 1e4, 30.0).expect("admissible");
    assert_eq!(
        (solid.K(), solid.β(), solid.C(), solid.C10(), solid.Jm()),
        (1e6, [2.0, 4.0], [1e5, 1e3], 1e4, 30.0)
    );
    let names: Vec<_> = Solid::<2>::DESCRIPTION.parameters.iter().map(|parameter| parameter.name).collect();
    assert_eq!(names, ["K", "β", "C", "C10", "Jm"]);
    let pair = Pair::from_young_poisson(1e6, 0.3).expect("elastic");
    assert!(pair.energy([1.1, 1.0, 1.0]) > 0.0);
    assert!(pair.G() < pair.K__());
    let _ = Curve::W;
    assert_eq!(Springs::from_values(&[], piola::Inversion::Refuse), Springs::new());
}
