//! Reference cases: P, dP/dF and its projection for hard deformation gradients, to 25 digits.
//!
//! The schema is described in `reference/SCHEMA.md`. A result X is judged by ‖X − X*‖ ≤ C u (‖X*‖ + sens),
//! Frobenius norms, where sens = ‖∂X/∂F‖ ‖F‖ is what a relative change of F changes in X.

#![expect(non_snake_case, reason = "P, F as in the files")]

use std::collections::BTreeMap;
use std::path::Path;

use piola::Real;
use piola::material::Description;
use piola::point::Matrix3;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
struct File {
    schema: String,
    cases: Vec<Case>,
}

/// One deformation gradient for one material.
#[derive(Debug, Deserialize)]
pub struct Case {
    /// `ref-0000` and so on.
    pub id: String,
    /// Name in the catalogue.
    pub material: String,
    params: BTreeMap<String, Value>,
    /// Family of deformation gradients.
    pub tag: String,
    /// Entry (i, j) is `F[3 i + j]`.
    #[serde(rename = "F")]
    pub deformation: [f64; 9],
    /// Every entry of F is an `f32`.
    pub f32_exact: bool,
    stretches: Vec<String>,
    psi: String,
    P: Vec<String>,
    dPdF: Vec<String>,
    dPdF_psd: Vec<String>,
    sens: Sensitivities,
}

#[derive(Debug, Deserialize)]
struct Sensitivities {
    psi: f64,
    P: f64,
    dPdF: f64,
    psd: f64,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Value {
    Number(f64),
    List(Vec<f64>),
}

/// A quantity that the reference cases judge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// ψ.
    Energy,
    /// P.
    Stress,
    /// dP/dF.
    Tangent,
    /// The nearest semidefinite matrix to dP/dF.
    Projected,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Energy, Self::Stress, Self::Tangent, Self::Projected];
}

/// The files of `reference/`.
pub const FILES: [&str; 4] = ["cases", "cases-more", "cases-further", "cases-ordinary"];

impl Case {
    /// Reads some of the [`FILES`].
    pub fn own(files: &[&str]) -> Result<Vec<Self>, String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
        let cases: Result<Vec<_>, _> =
            files.iter().map(|file| Self::read(&folder.join(format!("{file}.json")))).collect();
        cases.map(|cases| cases.into_iter().flatten().collect())
    }

    fn read(path: &Path) -> Result<Vec<Self>, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let file: File =
            serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
        if file.schema != "isohyper-oracle-1" {
            return Err(format!("{}: unknown schema `{}`", path.display(), file.schema));
        }
        for case in &file.cases {
            for quantity in Quantity::ALL {
                let (length, values) = (case.stated(quantity).0, case.reference(quantity));
                if values.len() != length || values.iter().any(|value| value.is_nan()) {
                    let (path, id) = (path.display(), &case.id);
                    return Err(format!("{path}: {id}: {quantity:?} is not {length} numbers"));
                }
            }
        }
        Ok(file.cases)
    }

    /// The parameters in the order of a description.
    pub fn values(&self, description: &Description) -> Result<Vec<Vec<f64>>, String> {
        let value = |name: &str| match self.params.get(name) {
            Some(Value::Number(value)) => Ok(vec![*value]),
            Some(Value::List(values)) => Ok(values.clone()),
            None => Err(format!("{}: no value for `{name}`", self.id)),
        };
        description.parameters.iter().map(|parameter| value(&parameter.name)).collect()
    }

    /// The deformation gradient, rounded to a format.
    pub fn F<R: Real>(&self) -> Matrix3<R> {
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| R::splat(self.deformation[3 * i + j])))
    }

    /// λ1 ≥ λ2 ≥ |λ3|, nearest `f64`.
    pub fn stretches(&self) -> Result<[f64; 3], String> {
        let numbers: Option<Vec<f64>> = self.stretches.iter().map(|text| text.parse().ok()).collect();
        let triple = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        triple.ok_or_else(|| format!("{}: the stretches are not 3 numbers", self.id))
    }

    /// How many reference values there must be, the values, and their sensitivity.
    fn stated(&self, quantity: Quantity) -> (usize, &[String], f64) {
        match quantity {
            Quantity::Energy => (1, std::slice::from_ref(&self.psi), self.sens.psi),
            Quantity::Stress => (9, &self.P, self.sens.P),
            Quantity::Tangent => (81, &self.dPdF, self.sens.dPdF),
            Quantity::Projected => (81, &self.dPdF_psd, self.sens.psd),
        }
    }

    /// The reference values, nearest `f64`.
    pub fn reference(&self, quantity: Quantity) -> Vec<f64> {
        self.stated(quantity).1.iter().map(|text| text.parse().unwrap_or(f64::NAN)).collect()
    }

    /// ‖X − X*‖ in units of u (‖X*‖ + sens + noise); infinite for NaN. Rounding the reference to `f64` costs
    /// half a unit.
    ///
    /// The noise is Σ|terms| of the energy's formula for ψ, whose terms cancel near rest, and zero for the
    /// others.
    pub fn error(&self, quantity: Quantity, values: &[f64], noise: f64, unit_roundoff: f64) -> f64 {
        let expected = self.reference(quantity);
        let (.., sensitivity) = self.stated(quantity);
        let distance = norm(values.iter().zip(&expected).map(|(x, y)| x - y));
        let scale = norm(expected.iter().copied()) + sensitivity + noise;
        // An infinite scale would excuse everything.
        if values.len() != expected.len() || !distance.is_finite() || !scale.is_finite() {
            f64::INFINITY
        } else if distance == 0.0 {
            0.0
        } else {
            distance / (unit_roundoff * scale)
        }
    }
}

/// √Σx², scaled by the largest entry, so that squares neither overflow nor vanish; NaN if an entry is.
pub fn norm(entries: impl IntoIterator<Item = f64>) -> f64 {
    let entries: Vec<f64> = entries.into_iter().collect();
    let largest = entries.iter().fold(0.0, |a: f64, b| if b.is_nan() { f64::NAN } else { a.max(b.abs()) });
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * entries.iter().map(|x| (x / largest).powi(2)).sum::<f64>().sqrt()
}
