//! Parameters for given small-strain moduli.

use piola::material::{Description, MaterialError, Moduli, Parameter};

/// The shear modulus does not depend on a parameter that changes it by no more than this share: a few
/// roundings.
const ROUNDING: f64 = 1e-12;

/// The typical parameters of a declaration, rescaled to the small-strain moduli `wanted`; `moduli` are those
/// of the material with the values of its parameters, one slice for each.
///
/// Poisson's ratio is matched by a parameter on which the shear modulus does not depend, if there is one and
/// it can be; then all parameters in [Pa](piola::material::Unit) are multiplied by one factor for Young's
/// modulus. An energy is proportional to these together, so that its shape, exponents and limits included,
/// stays that of the typical material.
///
/// ```
/// use piola::Inversion::Refuse;
/// use piola::material::{Declared, Moduli};
/// use piola_materials::NeoHookean;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let wanted = Moduli::from_young_poisson(1e6, 0.45)?;
/// let moduli = |values: &[&[f64]]| NeoHookean::from_values(values, Refuse).map(|rubber| rubber.moduli());
/// let values = piola_materials::matching(&NeoHookean::DESCRIPTION, moduli, wanted)?;
/// let rubber = NeoHookean::from_values(&[&values[0], &values[1]], Refuse)?.moduli();
/// assert!((rubber.young() / 1e6 - 1.0).abs() < 1e-14 && (rubber.poisson() - 0.45).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`MaterialError`] if the material refuses the parameters, as for moduli that are not positive, or because
/// no typical ones are declared.
pub fn matching(
    description: &Description,
    moduli: impl Fn(&[&[f64]]) -> Result<Moduli, MaterialError>,
    wanted: Moduli,
) -> Result<Vec<Vec<f64>>, MaterialError> {
    let moduli = |values: &[Vec<f64>]| {
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        moduli(&values)
    };
    let typical = description.typical.iter().flat_map(|typical| typical.values.iter());
    let typical: Vec<Vec<f64>> = typical.map(|values| values.to_vec()).collect();
    let ratio = wanted.lambda / wanted.mu;
    let values = with_ratio(&description.parameters, &moduli, &typical, ratio).unwrap_or(typical);
    let factor = wanted.young() / moduli(&values)?.young();
    let values = description.parameters.iter().zip(values).map(|(parameter, mut values)| {
        parameter.rescale(&mut values, factor);
        values
    });
    let values: Vec<_> = values.collect();
    moduli(&values)?;
    Ok(values)
}

/// These values of the parameters with a ratio λ/μ, if one of them alone can bring it about.
fn with_ratio(
    parameters: &[Parameter],
    moduli: &impl Fn(&[Vec<f64>]) -> Result<Moduli, MaterialError>,
    values: &[Vec<f64>],
    ratio: f64,
) -> Option<Vec<Vec<f64>>> {
    let before = moduli(values).ok()?;
    let with = |index: usize, factor: f64| {
        let mut values = values.to_vec();
        parameters[index].rescale(&mut values[index], factor);
        values
    };
    (0..values.len()).find_map(|index| {
        let doubled = moduli(&with(index, 2.0)).ok()?;
        if (doubled.mu - before.mu).abs() > ROUNDING * before.mu || doubled.lambda == before.lambda {
            return None;
        }
        // The moduli are linear in the stresses.
        let factor = 1.0 + (ratio * before.mu - before.lambda) / (doubled.lambda - before.lambda);
        let values = with(index, factor);
        (factor > 0.0 && moduli(&values).is_ok()).then_some(values)
    })
}
