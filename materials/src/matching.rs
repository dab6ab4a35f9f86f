//! Parameters for given small-strain moduli.

use piola::Inversion;
use piola::material::{Inadmissible, Moduli, Parameter};

use crate::Entry;

/// The shear modulus does not depend on a parameter that changes it by no more than this share: a few roundings.
const ROUNDING: f64 = 1e-12;

impl Entry {
    /// The typical parameters, changed as little as makes the body as stiff as these moduli say.
    ///
    /// Poisson's ratio is matched by the parameter that the shear modulus does not depend on, where there is one and it can be;
    /// then all parameters that are stresses are multiplied by one factor for Young's modulus. An energy is
    /// proportional to these together, so that its shape, exponents and limits included, stays that of the typical material.
    ///
    /// ```
    /// use piola::Inversion;
    /// use piola::material::Moduli;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let entry = piola_materials::find("stable_neo_hookean").ok_or("not in the catalogue")?;
    /// let values = entry.matching(Moduli::from_young_poisson(1e6, 0.45)?)?;
    /// let moduli = entry.moduli(&[&values[0], &values[1]], Inversion::Refuse)?;
    /// assert!((moduli.young() / 1e6 - 1.0).abs() < 1e-14);
    /// assert!((moduli.poisson() - 0.45).abs() < 1e-14);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// Where the material refuses its parameters, as for moduli that are not positive.
    pub fn matching(&self, wanted: Moduli) -> Result<Vec<Vec<f64>>, Inadmissible> {
        let typical: Vec<Vec<f64>> = self.typical.iter().map(|values| values.to_vec()).collect();
        let values = self.with_ratio(&typical, wanted.lambda / wanted.mu).unwrap_or(typical);
        let factor = wanted.young() / self.moduli_of(&values)?.young();
        let parameters = self.description.parameters.iter().zip(values);
        let values: Vec<_> =
            parameters.map(|(parameter, values)| scaled(parameter, values, factor)).collect();
        self.moduli_of(&values)?;
        Ok(values)
    }

    /// These parameters with a ratio λ/μ, if one of them alone can bring it about.
    fn with_ratio(&self, values: &[Vec<f64>], ratio: f64) -> Option<Vec<Vec<f64>>> {
        let before = self.moduli_of(values).ok()?;
        let with = |index: usize, factor: f64| {
            let mut values = values.to_vec();
            values[index] = scaled(&self.description.parameters[index], values[index].clone(), factor);
            values
        };
        (0..values.len()).find_map(|index| {
            let doubled = self.moduli_of(&with(index, 2.0)).ok()?;
            if (doubled.mu - before.mu).abs() > ROUNDING * before.mu || doubled.lambda == before.lambda {
                return None;
            }
            // The moduli are linear in the stresses.
            let factor = 1.0 + (ratio * before.mu - before.lambda) / (doubled.lambda - before.lambda);
            let values = with(index, factor);
            (factor > 0.0 && self.moduli_of(&values).is_ok()).then_some(values)
        })
    }

    fn moduli_of(&self, values: &[Vec<f64>]) -> Result<Moduli, Inadmissible> {
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        self.moduli(&values, Inversion::Refuse)
    }
}

/// Values of a parameter with its stresses, which its documentation gives in Pa, multiplied by a factor. Of control points
/// these are the ordinates.
fn scaled(parameter: &Parameter, mut values: Vec<f64>, factor: f64) -> Vec<f64> {
    let words = |doc: &'static str| doc.split(|c: char| !c.is_alphanumeric());
    if words(parameter.doc).any(|word| word == "Pa") {
        let (first, step) = if parameter.doc.contains("control points") { (1, 2) } else { (0, 1) };
        values.iter_mut().skip(first).step_by(step).for_each(|value| *value *= factor);
    }
    values
}
