//! The derivatives of the stress by the parameters, against the stress itself.

mod own;

use piola::Inversion;
use piola::material::{Declared, Fittable, MaterialError, Moduli, Parameter, Unit};
use piola_materials::{CATALOGUE, Entry, FittableVisitor, find};

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
fn values(entry: &Entry) -> Vec<Vec<f64>> {
    match entry.name {
        "levinson_burgess" => return vec![vec![3.74e5], vec![0.5], vec![0.3]],
        "veronda_westmann" => return vec![vec![3.94e3], vec![1.0], vec![1e6]],
        _ => {}
    }
    let nonzero = |&value: &f64| if value == 0.0 { 0.5 } else { value };
    entry.typical().iter().map(|list| list.iter().map(nonzero).collect()).collect()
}

fn visit<V: FittableVisitor>(
    entry: &Entry,
    values: &[Vec<f64>],
    visitor: V,
) -> Result<V::Output, MaterialError> {
    let values: Vec<_> = values.iter().map(Vec::as_slice).collect();
    entry.visit_fittable(&values, Inversion::Refuse, visitor)
}

/// ψ1, ψ2, ψ3 with other parameters.
fn gradient<M: Declared>(values: &[Vec<f64>], stretches: [f64; 3]) -> Result<[f64; 3], MaterialError> {
    let values: Vec<_> = values.iter().map(Vec::as_slice).collect();
    Ok(M::from_values(&values, Inversion::Refuse)?.gradient(stretches))
}

/// The numbers among the parameters, as list and place in it.
fn places(values: &[Vec<f64>]) -> Vec<(usize, usize)> {
    let places = values.iter().enumerate();
    places.flat_map(|(list, values)| (0..values.len()).map(move |place| (list, place))).collect()
}

/// p ∂ψk/∂p by central differences for the number at a place.
fn difference<M: Declared>(
    values: &[Vec<f64>],
    (list, place): (usize, usize),
    stretches: [f64; 3],
) -> Result<[f64; 3], MaterialError> {
    let mut slope = [0.0; 3];
    for (k, coefficient) in (1..).zip(STENCIL) {
        for side in [1.0, -1.0] {
            let mut changed = values.to_vec();
            changed[list][place] *= 1.0 + side * f64::from(k) * STEP;
            let gradient = gradient::<M>(&changed, stretches)?;
            for (slope, gradient) in slope.iter_mut().zip(gradient) {
                *slope += side * coefficient * gradient / STEP;
            }
        }
    }
    Ok(slope)
}

/// Σ |p ∂ψk/∂p| over all numbers and k, with the moduli for what cancels at rest: the size of what the
/// gradient is a sum of.
fn scale(material: &impl Fittable, derivatives: &[[f64; 3]]) -> f64 {
    let (values, Moduli { mu, lambda }) = (material.values(), material.moduli());
    let shares = places(&values).into_iter().zip(derivatives);
    let size = |((list, place), d): ((usize, usize), &[f64; 3])| {
        let p = values[list][place];
        d.iter().map(|d| (p * d).abs()).sum::<f64>()
    };
    2.0 * mu.abs() + lambda.abs() + shares.map(size).sum::<f64>()
}

struct Slopes<'a>(&'a str);

impl FittableVisitor for Slopes<'_> {
    type Output = Result<(), MaterialError>;

    fn visit<M: Fittable + 'static>(self, material: M) -> Self::Output {
        let Self(name) = self;
        let values = material.values();
        for stretches in STRETCHES {
            let derivatives = material.gradient_by_parameters(stretches);
            let places = places(&values);
            assert_eq!(derivatives.len(), places.len(), "{name}");
            let tolerance = TOLERANCE * scale(&material, &derivatives);
            for ((list, place), derivative) in places.into_iter().zip(&derivatives) {
                let differences = difference::<M>(&values, (list, place), stretches)?;
                for (k, (derivative, difference)) in derivative.iter().zip(differences).enumerate() {
                    let slope = values[list][place] * derivative;
                    assert!(
                        (slope - difference).abs() <= tolerance,
                        "{name} at {stretches:?}: p ∂ψ{}/∂p of `{}`, entry {place}, is {slope:e}, by differences {difference:e}",
                        k + 1,
                        M::DESCRIPTION.parameters[list].name,
                    );
                }
            }
        }
        Ok(())
    }
}

#[test]
fn derivatives_are_slopes() -> Result<(), MaterialError> {
    for entry in CATALOGUE.iter().filter(|entry| entry.name != "stretch_spline") {
        visit(entry, &values(entry), Slopes(entry.name))??;
    }
    Ok(())
}

/// Whether it is a stress: energies are proportional to all of these together.
fn is_stress(parameter: &Parameter) -> bool {
    parameter.unit == Some(Unit::Pascal)
}

struct Homogeneity<'a>(&'a str);

impl FittableVisitor for Homogeneity<'_> {
    type Output = ();

    /// Euler's theorem: Σ p ∂ψk/∂p = ψk over the parameters p to which ψ is proportional. Both sides have a
    /// few hundred roundings of terms of one size at most.
    fn visit<M: Fittable + 'static>(self, material: M) -> Self::Output {
        let values = material.values();
        for stretches in STRETCHES {
            let derivatives = material.gradient_by_parameters(stretches);
            let tolerance = 200.0 * f64::EPSILON * scale(&material, &derivatives);
            for (k, expected) in material.gradient(stretches).into_iter().enumerate() {
                let shares = places(&values).into_iter().zip(&derivatives);
                let stresses = shares.filter(|((list, _), _)| is_stress(&M::DESCRIPTION.parameters[*list]));
                let sum: f64 = stresses.map(|((list, place), d)| values[list][place] * d[k]).sum();
                let Self(name) = self;
                assert!((sum - expected).abs() <= tolerance, "{name} at {stretches:?}: {sum:e} {expected:e}");
            }
        }
    }
}

#[test]
fn stresses_are_proportional_to_moduli() -> Result<(), MaterialError> {
    for entry in CATALOGUE.iter().filter(|entry| entry.name != "stretch_spline") {
        visit(entry, &values(entry), Homogeneity(entry.name))?;
    }
    Ok(())
}

struct Constraints<'a>(&'a str);

impl FittableVisitor for Constraints<'_> {
    type Output = ();

    /// All hold, and central differences of each value have its gradient. Their truncation is h² by the third
    /// derivative, which powers of six raise to a hundred times the value.
    fn visit<M: Fittable + 'static>(self, material: M) -> Self::Output {
        const STEP: f64 = 1e-5;
        let Self(name) = self;
        let all = |values: &[Vec<f64>]| {
            let values: Vec<_> = values.iter().map(Vec::as_slice).collect();
            let moved = M::from_values(&values, Inversion::Refuse).expect("near admissible parameters");
            let domain = moved.domain_constraints([1.3, 1.1, 0.75]);
            moved.constraints().into_iter().chain(domain).collect::<Vec<_>>()
        };
        let values = material.values();
        let here = all(&values);
        assert!(here.iter().all(|constraint| constraint.value >= 0.0), "{name}: {here:?}");
        for (number, (list, place)) in places(&values).into_iter().enumerate() {
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
}

#[test]
fn constraints_have_their_gradients() -> Result<(), MaterialError> {
    for entry in CATALOGUE.iter().filter(|entry| entry.name != "stretch_spline") {
        visit(entry, &values(entry), Constraints(entry.name))?;
    }
    Ok(())
}

struct Values;

impl FittableVisitor for Values {
    type Output = Vec<Vec<f64>>;

    fn visit<M: Fittable + 'static>(self, material: M) -> Self::Output {
        material.values()
    }
}

#[test]
fn values_are_those_of_the_constructor() -> Result<(), MaterialError> {
    for entry in CATALOGUE.iter().filter(|entry| entry.name != "stretch_spline") {
        assert_eq!(visit(entry, &values(entry), Values)?, values(entry), "{}", entry.name);
    }
    Ok(())
}

#[test]
fn curves_cannot_be_fitted() {
    let drawn = find("stretch_spline").expect("in the catalogue");
    let refused = visit(drawn, &values(drawn), Values);
    assert_eq!(refused, Err(MaterialError::NotFittable { material: "StretchSpline".into() }));
}
