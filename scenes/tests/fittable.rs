//! The derivatives of the stress by the parameters, against the stress itself.

use std::sync::LazyLock;

use piola::Inversion;
use piola::material::{MaterialError, Unit};
use piola_declare::{Energy, Limit};
use piola_laboratory::Specimen;
use piola_laboratory::fit::Candidate;
use piola_materials::DECLARATIONS;
use piola_scenes::material::MaterialSpec;

/// Within the domains of all: rest, equal stretches, tension, compression, a sheet.
const STRETCHES: [[f64; 3]; 6] =
    [[1.0, 1.0, 1.0], [1.3, 1.3, 0.8], [1.1, 0.9, 0.9], [2.0, 0.75, 0.7], [1.02, 1.01, 0.5], [1.6, 1.5, 0.4]];

/// Coefficients of the central difference of order eight, for the steps h, 2h, 3h, 4h to either side.
const STENCIL: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Relative to the parameter. With a truncation error of h⁸/630 times the ninth derivative and a rounding
/// error of u/h this is about the best step.
const STEP: f64 = 1.0 / 128.0;

/// A gradient has a few hundred roundings at most, each up to u times its largest term; of what is added the
/// eight values of the difference have two units in all, divided by the step. What is left is truncation,
/// which the parameters' exponents of up to six raise to (6 ln 2)⁹ h⁸/630: the same order.
const TOLERANCE: f64 = 100.0 * f64::EPSILON / STEP;

/// Typical parameters, but none zero, where steps relative to it would be none and conditions often end, and
/// none for which steps show more than the slope: Levinson and Burgess's Poisson's ratio near its pole at ½,
/// and the exponential of skin.
fn values(name: &str, energy: &Energy) -> Vec<Vec<f64>> {
    match name {
        "levinson_burgess" => return vec![vec![3.74e5], vec![0.5], vec![0.3]],
        "veronda_westmann" => return vec![vec![3.94e3], vec![1.0], vec![1e6]],
        _ => {}
    }
    let nonzero = |&value: &f64| if value == 0.0 { 0.5 } else { value };
    energy.typical().iter().map(|list| list.iter().map(nonzero).collect()).collect()
}

/// An energy with these values as a candidate of a fit.
fn candidate(energy: Energy, values: &[&[f64]]) -> Candidate {
    let material = energy.material(values, Inversion::Refuse).expect("admissible values");
    Candidate { energy, material }
}

/// All energies but the one whose parameters are functions, for which see
/// [`ordinates_of_the_curves_of_the_catalogue_are_parameters`]. Their values are those of the constructor.
static CANDIDATES: LazyLock<Vec<(&str, Candidate)>> = LazyLock::new(|| {
    let others = DECLARATIONS.iter().filter(|declaration| declaration.name != "stretch_spline");
    let of = |declaration: &piola_materials::Declaration| {
        let energy = Energy::from_rust(declaration.source).expect("a declaration");
        let values = values(declaration.name, &energy);
        let candidate = candidate(energy, &values.iter().map(Vec::as_slice).collect::<Vec<_>>());
        assert_eq!(candidate.energy.values(&candidate.material), values, "{}", declaration.name);
        (declaration.name, candidate)
    };
    others.map(of).collect()
});

/// The numbers among the parameters, as list and place in it.
fn places(values: &[Vec<f64>]) -> Vec<(usize, usize)> {
    let places = values.iter().enumerate();
    places.flat_map(|(list, values)| (0..values.len()).map(move |place| (list, place))).collect()
}

/// p ∂ψk/∂p by central differences for the number at a place.
fn difference(
    Candidate { energy, material }: &Candidate,
    values: &[Vec<f64>],
    (list, place): (usize, usize),
    stretches: [f64; 3],
) -> Result<[f64; 3], MaterialError> {
    let mut slope = [0.0; 3];
    for (k, coefficient) in (1..).zip(STENCIL) {
        for side in [1.0, -1.0] {
            let mut changed = values.to_vec();
            changed[list][place] *= 1.0 + side * f64::from(k) * STEP;
            let gradient =
                Specimen::<f64>::blocks(&energy.with_values(material, &changed)?, stretches).gradient;
            for (slope, gradient) in slope.iter_mut().zip(gradient) {
                *slope += side * coefficient * gradient / STEP;
            }
        }
    }
    Ok(slope)
}

/// Σ |p ∂ψk/∂p| over all numbers and k, with the moduli for what cancels at rest: the size of what the
/// gradient is a sum of.
fn scale(Candidate { energy, material }: &Candidate, derivatives: &[[f64; 3]]) -> f64 {
    let values = energy.values(material);
    let [h11, _, _, h12, _, _] = Specimen::<f64>::blocks(material, [1.0; 3]).hessian;
    let shares = places(&values).into_iter().zip(derivatives);
    let size = |((list, place), d): ((usize, usize), &[f64; 3])| {
        let p = values[list][place];
        d.iter().map(|d| (p * d).abs()).sum::<f64>()
    };
    (h11 - h12).abs() + h12.abs() + shares.map(size).sum::<f64>()
}

fn check_slopes(name: &str, candidate: &Candidate) -> Result<(), MaterialError> {
    let Candidate { energy, material } = candidate;
    let (values, description) = (energy.values(material), energy.description());
    for stretches in STRETCHES {
        let derivatives = energy.gradient_by_parameters(material, stretches);
        let places = places(&values);
        assert_eq!(derivatives.len(), places.len(), "{name}");
        let tolerance = TOLERANCE * scale(candidate, &derivatives);
        for ((list, place), derivative) in places.into_iter().zip(&derivatives) {
            if description.parameters[list].is_whole() {
                assert_eq!(*derivative, [0.0; 3], "{name}: whole exponents do not change");
                continue;
            }
            let differences = difference(candidate, &values, (list, place), stretches)?;
            for (k, (derivative, difference)) in derivative.iter().zip(differences).enumerate() {
                let slope = values[list][place] * derivative;
                assert!(
                    (slope - difference).abs() <= tolerance,
                    "{name} at {stretches:?}: p ∂ψ{}/∂p of `{}`, entry {place}, is {slope:e}, by differences {difference:e}",
                    k + 1,
                    description.parameters[list].name,
                );
            }
        }
    }
    Ok(())
}

#[test]
fn derivatives_are_slopes() -> Result<(), MaterialError> {
    CANDIDATES.iter().try_for_each(|(name, candidate)| check_slopes(name, candidate))
}

/// Euler's theorem: Σ p ∂ψk/∂p = ψk over the parameters p that are stresses, because ψ is proportional to all
/// of them together. Both sides have a few hundred roundings of terms of one size at most.
#[test]
fn stresses_are_proportional_to_moduli() {
    for (name, candidate) in CANDIDATES.iter() {
        let Candidate { energy, material } = candidate;
        let (values, description) = (energy.values(material), energy.description());
        for stretches in STRETCHES {
            let derivatives = energy.gradient_by_parameters(material, stretches);
            let tolerance = 200.0 * f64::EPSILON * scale(candidate, &derivatives);
            for (k, expected) in Specimen::<f64>::blocks(material, stretches).gradient.into_iter().enumerate()
            {
                let shares = places(&values).into_iter().zip(&derivatives);
                let is_stress = |list: usize| description.parameters[list].unit == Some(Unit::Pascal);
                let stresses = shares.filter(|((list, _), _)| is_stress(*list));
                let sum: f64 = stresses.map(|((list, place), d)| values[list][place] * d[k]).sum();
                assert!((sum - expected).abs() <= tolerance, "{name} at {stretches:?}: {sum:e} {expected:e}");
            }
        }
    }
}

/// All hold, and central differences of each value have its gradient. Their truncation is h² by the third
/// derivative, which powers of six raise to a hundred times the value.
fn check_constraints(name: &str, Candidate { energy, material }: &Candidate) {
    const STEP: f64 = 1e-5;
    let all = |values: &[Vec<f64>]| {
        let moved = energy.with_values(material, values).expect("near admissible parameters");
        let domain = energy.domain_constraints(&moved, [1.3, 1.1, 0.75]);
        energy.constraints(&moved).into_iter().chain(domain).collect::<Vec<_>>()
    };
    let values = energy.values(material);
    let here = all(&values);
    assert!(here.iter().all(|constraint| constraint.value >= 0.0), "{name}: {here:?}");
    for (number, (list, place)) in places(&values).into_iter().enumerate() {
        if energy.description().parameters[list].is_whole() {
            assert!(here.iter().all(|constraint| constraint.gradient[number] == 0.0), "{name}: {here:?}");
            continue;
        }
        let value = values[list][place];
        let [below, above] = [-STEP, STEP].map(|step| {
            let mut values = values.clone();
            values[list][place] += step * value;
            all(&values)
        });
        for ((constraint, below), above) in here.iter().zip(&below).zip(&above) {
            let (slope, change) = (constraint.gradient[number] * value, above.value - below.value);
            let size = slope.abs().max(constraint.value.abs());
            let error = (change / (2.0 * STEP) - slope).abs();
            let tolerance = 100.0 * (STEP * STEP + f64::EPSILON / STEP);
            assert!(error <= tolerance * size.max(1.0), "{name}: {constraint:?} by {number}: {change:e}");
        }
    }
}

#[test]
fn constraints_have_their_gradients() {
    CANDIDATES.iter().for_each(|(name, candidate)| check_constraints(name, candidate));
}

/// Fits go without an extension, whatever they start from.
#[test]
fn an_extension_changes_nothing() {
    let (at, mut judged) = ([1.3, 1.1, 0.75], 0);
    for (name, Candidate { energy, material }) in CANDIDATES.iter() {
        let values = energy.values(material);
        let lists: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        // Its own conditions may refuse these values.
        let Ok(extended) = energy.material(&lists, Inversion::Extend { epsilon: 0.9 }) else { continue };
        judged += 1;
        let [found, expected] = [&extended, material].map(|material| {
            let domain = energy.domain_constraints(material, at);
            (energy.gradient_by_parameters(material, at), energy.constraints(material), domain)
        });
        assert_eq!(found, expected, "{name}");
        assert_eq!(energy.with_values(&extended, &values).as_ref(), Ok(material), "{name}");
    }
    assert!(judged > 10, "{judged}");
}

/// Their slopes are differences themselves, and less exact than proportionality would have to be.
#[test]
fn ordinates_of_the_curves_of_the_catalogue_are_parameters() -> Result<(), MaterialError> {
    let spec = MaterialSpec::typical("stretch_spline").expect("in the catalogue");
    let solid = spec.candidate().expect("typical parameters");
    check_slopes("stretch_spline", &solid)?;
    check_constraints("stretch_spline", &solid);
    // What a fit finds goes to the control points.
    let mut values = solid.energy.values(&solid.material);
    values[1] = vec![-3e4, 4e4];
    let fitted = spec.with_fitted(&values).expect("as many ordinates");
    assert_eq!(fitted.values_of("g"), [0.1, -3e4, 1.0, 0.0, 4.0, 4e4]);
    assert_eq!(fitted.values_of("h"), spec.values_of("h"));
    let Candidate { energy, material } = fitted.candidate().expect("stable");
    assert_eq!(energy.values(&material), values);
    Ok(())
}

/// Sums in products, in logarithms, in each other's terms and in exponents; lists of two lengths; names of
/// what is emitted.
const NESTED: &str = include_str!("fittable/nested.txt");

/// Powers of what differs from entry to entry, in a list of fixed length.
const SHIFTED: &str = include_str!("fittable/shifted.txt");

/// A real power, whose logarithm vanishes at rest.
const STIFFENING: &str = include_str!("fittable/stiffening.txt");

/// A curve, which also bounds the domain, and powers with whole exponents.
const DRAWN: &str = include_str!("fittable/drawn.txt");

/// Springs, of which as many stiffnesses as wanted stand in the arguments of a curve.
const SPRUNG: &str = include_str!("fittable/sprung.txt");

/// The candidate of a declaration.
fn declared(text: &str, values: &[&[f64]]) -> Candidate {
    candidate(Energy::from_rust(text).expect("a declaration"), values)
}

/// Harder than any energy of the catalogue.
#[test]
fn derivatives_of_sums_and_powers_are_slopes() -> Result<(), MaterialError> {
    let nested = declared(NESTED, &[&[1.5, 2.0, 0.5], &[1.3, 4.0, -2.0], &[0.25, 0.5], &[3.0]]);
    check_slopes("Nested", &nested)?;
    check_constraints("Nested", &nested);
    // An exponent of zero, where λ^α is 1 and its derivative ln λ.
    let zero = declared(NESTED, &[&[1.5, 2.0], &[1.0, 0.0], &[0.5], &[3.0]]);
    let [.., to_exponent, _, _] = zero.energy.gradient_by_parameters(&zero.material, [2.0, 1.0, 0.5])[..]
    else {
        panic!("six numbers")
    };
    assert!(to_exponent[0] > 0.0 && to_exponent[1] > 0.0, "{to_exponent:?}");
    check_slopes("Shifted", &declared(SHIFTED, &[&[1.0, 2.0], &[0.5, 0.7], &[1.2]]))?;
    let solid = declared(STIFFENING, &[&[1.0], &[2.0], &[2.5]]);
    check_slopes("Stiffening", &solid)?;
    assert_eq!(solid.energy.gradient_by_parameters(&solid.material, [1.0; 3]), [[0.0; 3]; 3]);
    Ok(())
}

#[test]
fn ordinates_of_a_curve_are_parameters() -> Result<(), MaterialError> {
    let points = [0.5, 1e5, 1.0, 2e5, 1.4, 3e5, 2.0, 6e5];
    let solid = declared(DRAWN, &[&[3e5], &points, &[1e5, 2e3], &[1.0, 2.0]]);
    let Candidate { energy, material } = &solid;
    let values = energy.values(material);
    assert_eq!(values, [&[3e5][..], &[1e5, 3e5, 6e5], &[1e5, 2e3], &[1.0, 2.0]]);
    check_slopes("Drawn", &solid)?;
    check_constraints("Drawn", &solid);
    let again = energy.with_values(material, &values)?;
    let place = [1.3, 1.1, 0.8];
    assert_eq!(Specimen::<f64>::blocks(&again, place), Specimen::<f64>::blocks(material, place));

    let refused =
        |values: &[Vec<f64>]| energy.with_values(material, values).expect_err("refused").to_string();
    let other = |k: usize, list: &[f64]| {
        let mut values = values.clone();
        values[k] = list.to_vec();
        refused(&values)
    };
    assert!(other(1, &[1.0]).contains("3 ordinates to be changed, but 1 are given"));
    assert!(other(1, &[f64::NAN; 3]).contains("it must be finite"));
    assert!(other(0, &[2e6]).contains("mu < 1e6"));
    assert!(other(2, &[1e5, 2e6]).contains("k[p] < 1e6"));
    assert!(other(3, &[1.0, 1.5]).contains("`n[1]` is 1.5"));
    assert!(refused(&values[..1]).contains("4 parameters"));
    Ok(())
}

#[test]
fn conditions_beyond_the_second_derivative_of_a_curve_are_differenced() {
    // φ = c x² with c = 3/2, so that k = 2 c (a² + Σ b²) leaves no stress; μ = c (a² + Σ b²) + k/2 and λ = 0.
    let line = [0.25, 0.75, 1.0, 3.0, 2.0, 6.0, 4.0, 12.0];
    let Candidate { energy, material } = declared(SPRUNG, &[&[2.0], &[0.5, 1.5], &[19.5], &line]);
    let [shear, _] = <[_; 2]>::try_from(energy.constraints(&material)).expect("two");
    assert_eq!(shear.limit, Limit::ShearModulus);
    // By a: 2 c a, and by each b; by k: ½.
    assert_eq!(shear.gradient.len(), 4 + 3);
    for (found, expected) in [shear.value].iter().chain(&shear.gradient).zip([19.5, 6.0, 1.5, 4.5, 0.5]) {
        // 470 u of what is differenced, and a few roundings of it, by values near 1.
        assert!((found - expected).abs() <= 2000.0 * f64::EPSILON * 40.0, "{found} for {expected}");
    }
}
