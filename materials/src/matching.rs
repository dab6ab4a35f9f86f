//! Parameters for given small-strain moduli.

use piola::__private::message::number;
use piola::material::{Description, Form, MaterialError, Moduli, Parameter, Unit};

/// The share of a modulus that a few roundings change at most.
const ROUNDING: f64 = 1e-12;

/// A factor of a parameter that is as good as infinite.
const FAR: f64 = 1e18;

/// The typical parameters of a declaration, changed to the small-strain moduli `wanted`; `moduli` are those
/// of the material with the values of its parameters, one slice for each.
///
/// One parameter is multiplied by a number, of any sign or zero, that brings Poisson's ratio about: if
/// possible one in [Pa](piola::material::Unit) on which the shear modulus does not depend, else another one,
/// such as the exponent of J in a foam. Then all parameters in Pa are multiplied by one factor for Young's
/// modulus. An energy is proportional to these together, so that its shape, other exponents and limits
/// included, stays that of the typical material. The moduli of the result are compared with `wanted`.
///
/// ```
/// use piola::Inversion::Refuse;
/// use piola::material::{Declared, Moduli};
/// use piola_materials::NeoHookean;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let moduli = |values: &[&[f64]]| NeoHookean::from_values(values, Refuse).map(|rubber| rubber.moduli());
/// for poisson in [0.45, 0.0, -0.2] {
///     let wanted = Moduli::from_young_poisson(1e6, poisson)?;
///     let values = piola_materials::matching(&NeoHookean::DESCRIPTION, moduli, wanted)?;
///     let rubber = NeoHookean::from_values(&[&values[0], &values[1]], Refuse)?.moduli();
///     assert!((rubber.young() / 1e6 - 1.0).abs() < 1e-14 && (rubber.poisson() - poisson).abs() < 1e-14);
/// }
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`MaterialError::Other`] with the range of Poisson's ratio that one parameter alone can bring about, if
/// `wanted` is outside of it or not elastic, and if no typical parameters are declared; another
/// [`MaterialError`] if the material refuses these.
pub fn matching(
    description: &Description,
    moduli: impl Fn(&[&[f64]]) -> Result<Moduli, MaterialError>,
    wanted: Moduli,
) -> Result<Vec<Vec<f64>>, MaterialError> {
    let Some(typical) = &description.typical else {
        let missing = "the declaration has no typical parameters to be changed; give all parameters";
        return Err(MaterialError::Other(missing.to_owned()));
    };
    let typical: Vec<Vec<f64>> = typical.values.iter().map(|values| values.to_vec()).collect();
    let moduli = |values: &[Vec<f64>]| {
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        moduli(&values)
    };
    let before = moduli(&typical)?;
    let parameters = &description.parameters[..];
    let with = |index: usize, factor: f64| {
        let mut values = typical.clone();
        let (parameter, numbers) = (&parameters[index], &mut values[index]);
        if is_stress(parameter) {
            parameter.rescale(numbers, factor);
        } else if matches!(parameter.form, Form::Number | Form::List) {
            numbers.iter_mut().for_each(|number| *number *= factor);
        }
        let moduli = moduli(&values).ok()?;
        Some((values, moduli))
    };
    let mut order: Vec<usize> = (0..parameters.len()).collect();
    order.sort_by_key(|&index| !is_stress(&parameters[index]));

    let ratio = wanted.lambda / wanted.mu;
    let solved = |index: usize, keeps_shear: bool| {
        let (factor, after) =
            [2.0, 0.5].into_iter().find_map(|factor| Some((factor, with(index, factor)?.1)))?;
        let shear = after.mu - before.mu;
        if keeps_shear && shear.abs() > ROUNDING * before.mu {
            return None;
        }
        // λ and μ are linear in stresses and shares, ν in a parameter that is Poisson's ratio. 0: as it is.
        let lame = (ratio * before.mu - before.lambda) / (after.lambda - before.lambda - ratio * shear);
        let poisson = (wanted.poisson() - before.poisson()) / (after.poisson() - before.poisson());
        // 0 comes first: then the share of a parameter without effect would be a ratio of two roundings.
        [0.0, lame, poisson].into_iter().find_map(|share| {
            let (values, found) = with(index, 1.0 + (factor - 1.0) * share)?;
            has_ratio(found, ratio).then_some(values)
        })
    };
    let as_stiff = |mut values: Vec<Vec<f64>>| {
        let factor = wanted.young() / moduli(&values).ok()?.young();
        for (parameter, values) in parameters.iter().zip(&mut values) {
            parameter.rescale(values, factor);
        }
        let found = moduli(&values).ok()?;
        let is_as_stiff = (found.young() - wanted.young()).abs() <= 3.0 * ROUNDING * wanted.mu;
        (is_as_stiff && has_ratio(found, ratio)).then_some(values)
    };
    let any = |keeps_shear| order.iter().find_map(|&index| solved(index, keeps_shear));
    any(true).or_else(|| any(false)).and_then(as_stiff).ok_or_else(|| {
        let ends = order.iter().flat_map(|&index| {
            [-FAR, FAR].map(|far| farthest(far, before, |factor| with(index, factor).map(|found| found.1)))
        });
        out_of_reach(wanted, before, ends)
    })
}

/// True if a parameter is in Pa or in 1/Pa.
fn is_stress(parameter: &Parameter) -> bool {
    !matches!(parameter.unit, None | Some(Unit::Dimensionless))
}

/// True if λ/μ is as wanted, except for roundings, which a Poisson's ratio near 1/2 magnifies.
fn has_ratio(Moduli { mu, lambda }: Moduli, ratio: f64) -> bool {
    (lambda - ratio * mu).abs() <= ROUNDING * (mu + lambda.abs()) * (1.0 + ratio.abs())
}

/// The moduli with the factor that is nearest to a far one among those that the material admits, to the last
/// bit: a far one has sixty bits before its point.
fn farthest(far: f64, before: Moduli, with: impl Fn(f64) -> Option<Moduli>) -> Moduli {
    let (mut inside, mut outside, mut found) = (1.0, far, before);
    for _ in 0..128 {
        let middle = 0.5 * (inside + outside);
        match with(middle) {
            Some(moduli) => (inside, found) = (middle, moduli),
            None => outside = middle,
        }
    }
    found
}

/// Error of moduli that no change of one parameter brings about, with the range of ν between its ends.
fn out_of_reach(wanted: Moduli, before: Moduli, ends: impl Iterator<Item = Moduli>) -> MaterialError {
    // The sum has no negative zero.
    let short = |moduli: Moduli| (1e6 * moduli.poisson()).round() / 1e6 + 0.0;
    let own = (short(before), short(before));
    let (low, high) = ends.map(short).fold(own, |(low, high), end| (low.min(end), high.max(end)));
    let range = match low < high {
        true => format!("between {} and {}", number(low), number(high)),
        false => format!("= {}", number(low)),
    };
    MaterialError::Other(format!(
        "E = {:.6e} Pa with ν = {} is out of reach: with one typical parameter changed, and those in Pa \
         scaled, the energy has E > 0 and ν {range}; give all parameters for another solid",
        wanted.young(),
        number(short(wanted))
    ))
}
