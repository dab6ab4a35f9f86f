//! Young's modulus and Poisson's ratio: the parameters that they determine, and that these make a material as
//! stiff.

use piola::Inversion;
use piola::material::{MaterialError, Moduli};
use piola_codegen::algebra::young_poisson::{Determined, YoungPoisson};
use piola_codegen::model::Model;
use piola_codegen::read::parse::Declaration;
use piola_tests::declarations::{Sample, slices};

/// The energies of the catalogue with `from_young_poisson`. Of the others, some have one modulus, some more
/// than two parameters in their moduli, and in some, as Gent's, an exponent or limit enters too.
const DETERMINED: [&str; 17] = [
    "Bazant",
    "CiarletNeoHookean",
    "ExponentiatedHencky",
    "FixedCorotated",
    "Hencky",
    "IsochoricNeoHookean",
    "Khajehsaeid",
    "Knowles",
    "Murnaghan",
    "NeoHookean",
    "PengLandel",
    "RotatedLinear",
    "StVenantKirchhoff",
    "StableNeoHookean",
    "ValanisLandel",
    "Varga",
    "Yeoh",
];

/// Poisson's ratios from that of cork to that of rubber.
const RATIOS: [f64; 5] = [0.0, 0.2, 0.3, 0.45, 0.499];

pub(crate) fn judge(sample: &Sample, declaration: &Declaration, model: &Model) {
    let name = declaration.name.to_string();
    match &model.from_young_poisson {
        Some(both) => materials_are_as_stiff_as_requested(sample, both),
        None => assert!(sample.text.remarks("determined").next().is_none(), "{name}"),
    }
    if sample.is_of_catalogue {
        assert_eq!(model.from_young_poisson.is_some(), DETERMINED.contains(&name.as_str()), "{name}");
    }
    assert!(
        sample.text.remarks("undetermined").next().is_none() || model.from_young_poisson.is_none(),
        "{name}"
    );
    let expected: Vec<_> = sample.text.remarks("determined").collect();
    if !expected.is_empty() {
        let parameters = &declaration.parameters;
        let solved = |Determined { parameter, mu, lambda, constant }: Determined| {
            format!("{}: {mu} μ + {lambda} λ + {constant}", parameters[parameter].name)
        };
        let found = model.from_young_poisson.into_iter().flat_map(|both| both.0.map(solved));
        assert_eq!(found.collect::<Vec<_>>(), expected, "{name}");
    }
}

/// E = μ (3λ + 2μ)/(λ + μ) and 1 − 2ν = μ/(λ + μ) of the material, compared with the given ones.
///
/// A parameter and the modulus that follows from it have six roundings each; λ may be a difference of
/// parameters no more than 3 (λ + μ) in size, so that both moduli err by 20 u (λ + μ). E changes by at most
/// three times as much as μ and λ (1 − 2ν)², so both err by 100 u of E and of one.
fn materials_are_as_stiff_as_requested(sample: &Sample, YoungPoisson(both): &YoungPoisson) {
    let tolerance = 100.0 * f64::EPSILON;
    for young in [1.0, 3.7e5, 2.1e11] {
        for poisson in RATIOS {
            let mu = young / (2.0 * (1.0 + poisson));
            let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
            let mut values = sample.values().remove(0);
            for one in both {
                let [by_mu, by_lambda, constant] = [one.mu, one.lambda, one.constant].map(|c| c.to_f64());
                values[one.parameter] = vec![by_mu * mu + by_lambda * lambda + constant];
            }
            let moduli = match sample.judged.energy.material(&slices(&values), Inversion::Refuse) {
                // Some energies require more of their parameters.
                Err(MaterialError::Violated { .. }) if poisson == 0.0 => continue,
                material => Moduli::of(&material.expect("admissible")),
            };
            let name = sample.judged.name;
            let [found, ratio] = [moduli.young(), moduli.poisson()];
            assert!(
                (found / young - 1.0).abs() <= tolerance,
                "{name}: E is {found}, not {young}, with ν = {poisson}"
            );
            assert!((ratio - poisson).abs() <= tolerance, "{name}: ν is {ratio}, not {poisson}");
        }
    }
}
