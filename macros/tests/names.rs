//! Names straight from a paper need no further word where a crate denies all warnings.

#![deny(warnings)]

use piola::Material;
use piola::material::Declared;

/// Letters of either case, Greek ones among them.
#[piola::material(
    domain(J > 0.0, I1 - 3.0 < Jm),
    admissible(Jm > 0.0, β[p] > 0.0),
    extend(K >= 0.0)
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

/// An energy by invariants.
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

/// Materials with names that their own expansions use, each in a block of its own.
macro_rules! with_names {
    ($($declare:ident: $($name:ident)*;)*) => { $($(const _: () = { $declare!($name); };)*)* };
}

macro_rules! numbers {
    ($name:ident) => {
        numbers!(Energy, $name);
    };
    ($Energy:ident, $name:ident) => {
        /// Rubber.
        #[piola::material(domain(J > 0.0), admissible($name > 0.0), extend($name > 0.0))]
        fn $Energy(
            [l1, l2, l3]: [f64; 3],
            /** Pa. */
            $name: f64,
            /** Pa. */
            lambda: f64,
        ) -> f64 {
            $name / 2.0 * (I1 - 3.0) - $name * J.ln() + lambda / 2.0 * J.ln().powi(2)
        }
    };
}

macro_rules! types {
    ($name:ident) => {
        numbers!($name, mu);
    };
}

macro_rules! lists {
    ($name:ident) => {
        lists!($name, N);
    };
    ($name:ident, $N:ident) => {
        /// Sum.
        #[piola::material(domain(J > 0.0), admissible($name[p] > 0.0), extend)]
        fn Energy<const $N: usize>(
            [l1, l2, l3]: [f64; 3],
            /** Pa. */
            $name: [f64; $N],
        ) -> f64 {
            sum(|p| $name[p] * (I1 - 3.0 - 2.0 * J.ln()))
        }
    };
}

macro_rules! lengths {
    ($name:ident) => {
        lists!(mu, $name);
    };
}

macro_rules! stretches {
    ($name:ident) => {
        /// Logarithms.
        #[piola::material(domain(J > 0.0), extend)]
        fn Energy(
            [$name, l2, l3]: [f64; 3],
            /** Pa. */
            mu: f64,
        ) -> f64 {
            mu * ($name.ln().powi(2) + l2.ln().powi(2) + l3.ln().powi(2))
        }
    };
}

#[allow(dead_code, non_camel_case_types, non_upper_case_globals)]
mod names_of_expansions {
    with_names! {
        types: Some None Ok Err Option Result Vec Clone Copy Fn Debug PartialEq Default Real Mask Inversion Material
            Declared Graded PerLane ParameterValue P V Value R D S T Self_ serde core_ mu l1 t1 energy;
        numbers: t1 t2 p q k x a one lane material value splat ln len core std piola __p f64 u8 str R P V Value T
            epsilon strains stretch self_ args index;
        lists: t1 q k x one lane material value len iter core std __p f64 R P V T epsilon strains;
        stretches: t1 t2 q k x one lane material value core std __p f64 R P V epsilon strains stretch;
        lengths: P V Value D S T K M Real Mask Material Declared PerLane _N;
    }
}

#[test]
fn the_names_are_those_of_the_declaration() {
    let solid = Solid::new(1e6, [2.0, 4.0], [1e5, 1e3], 1e4, 30.0).expect("admissible");
    assert_eq!(
        (solid.K(), solid.β(), solid.C(), solid.C10(), solid.Jm()),
        (1e6, [2.0, 4.0], [1e5, 1e3], 1e4, 30.0)
    );
    let names: Vec<_> =
        Solid::<2>::DESCRIPTION.parameters.iter().map(|parameter| parameter.name.clone()).collect();
    assert_eq!(names, ["K", "β", "C", "C10", "Jm"]);
    let pair = Pair::new(1e6, 2e6).expect("elastic");
    assert!(pair.energy([1.1, 1.0, 1.0]) > 0.0);
    assert!(pair.G() < pair.K__());
    let _ = Curve::W;
    assert_eq!(Springs::from_values(&[], piola::Inversion::Refuse), Springs::new());
}
