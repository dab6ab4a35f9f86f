//! Energies that are declared on the command line: `--energy FORMULA`, or a file instead of a material's
//! name; and materials of groups, `--part`.

use std::path::Path;

use clap::Args;
use piola::__private::message::{number, quoted};
use piola::material::Unit;
use piola_declare::{Energy, FormulaOptions, Mistakes};

use crate::error::Error;
use crate::material::{MaterialPart, MaterialSpec};
use crate::output::read_text;

use super::value::{Given, modulus, parameter};

/// An energy that is declared by its formula, and values of the parameters of any material.
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct Formula {
    /// Energy as a formula, such as `mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2`, instead of a material.
    ///
    /// Its names are the parameters given by --param, the stretches l1, l2, l3 and the invariants I1, I2, J,
    /// I1b and I2b, also as lambda_1, tr(C), det(F) and more. Conditions may follow, as in `… where J > 0, I1
    /// < 3 + Jm`.
    #[arg(long, value_name = "FORMULA", conflicts_with = "material", allow_hyphen_values = true)]
    energy: Option<String>,

    /// Subtract s ln J from the formula, s being its stress at rest, so that the rest state is free of
    /// stress. Curves and fits at constant volume do not need it.
    #[arg(long, requires = "energy")]
    free_rest: bool,

    /// Add K/2 (J - 1)^2 to the formula, which resists changes of volume; K in Pa, or with a unit of stress.
    #[arg(long, value_name = "K", requires = "energy", allow_negative_numbers = true, value_parser = modulus)]
    kappa: Option<f64>,

    /// Value of a parameter, in SI units or with a unit of stress after it, such as MPa or psi, or /MPa for
    /// one by a stress; lists as NAME=V,V,V.
    #[arg(long = "param", value_name = "NAME=V", value_parser = parameter)]
    pub parameters: Vec<Given>,
}

/// The name of the parameter that `--kappa` adds.
const BULK: &str = "kappa";

impl Formula {
    /// The formula for curves at constant volume. A stress at rest is a pressure, which does no work then: it
    /// is left out, as by `--free-rest`.
    #[must_use]
    pub fn at_constant_volume(self) -> Self {
        Self { free_rest: self.free_rest || self.energy.is_some(), ..self }
    }

    /// The material of the formula, or else of the file with this name, or else the one that `listed` finds
    /// by its name; with the parameters that are given.
    ///
    /// # Errors
    /// [`Error::Declaration`]; a name without a value is a mistake at its place. [`Error::Usage`], and those
    /// of `listed`.
    pub fn material(
        self,
        name: Option<&str>,
        listed: impl FnOnce(Option<&str>) -> Result<MaterialSpec, Error>,
    ) -> Result<MaterialSpec, Error> {
        let material = match (&self.energy, name) {
            (Some(formula), _) => self.declared(formula)?,
            (None, name) => match name.map(in_file).transpose()?.flatten() {
                Some(material) => material,
                None => listed(name)?,
            },
        };
        with_values(material, self.parameters)
    }

    fn declared(&self, formula: &str) -> Result<MaterialSpec, Error> {
        let names = self.parameters.iter().map(|given| (given.name.clone(), given.documentation()));
        let options = FormulaOptions {
            parameters: Some(names.collect()),
            free_rest: self.free_rest,
            bulk: self.kappa.map(|_| BULK.into()),
            value: Some("--param NAME=VALUE"),
            free_rest_option: Some("--free-rest"),
            ..FormulaOptions::default()
        };
        let energy = Energy::from_formula_with(formula, &options).map_err(Error::Declaration)?;
        check_units(&energy, &self.parameters)?;
        let spec = MaterialSpec::declared(energy);
        Ok(match self.kappa {
            Some(kappa) => spec.with_parameter(BULK, [kappa]),
            None => spec,
        })
    }
}

/// Checks that all values have units that need one, if some do; 0 needs none.
fn check_units(energy: &Energy, parameters: &[Given]) -> Result<(), Error> {
    let needs_unit = |given: &&Given| given.unit.is_none() && given.values.iter().any(|&value| value != 0.0);
    for given in parameters.iter().filter(needs_unit) {
        let known = energy.description().parameters.iter().find(|known| known.name == given.name);
        if let Some(unit @ (Unit::Pascal | Unit::PerPascal)) = known.and_then(|known| known.unit) {
            let values = given.values.iter().map(|&value| number(value)).collect::<Vec<_>>().join(",");
            let (name, sign) = (quoted(&given.name), if unit == Unit::PerPascal { "/" } else { "" });
            let value = quoted(&format!("{}={values}", given.name));
            return Err(Error::Usage(format!(
                "the parameter `{name}` is {}, because other values have units, but its own value has none; write it with \
                 its unit, such as `{value}{sign}MPa`, or `{value}{sign}Pa`",
                in_words(unit)
            )));
        }
    }
    Ok(())
}

/// The material of a declaration in Rust, if a name is that of a file.
///
/// # Errors
/// [`Error::Usage`] if it cannot be read, [`Error::Declaration`].
fn in_file(name: &str) -> Result<Option<MaterialSpec>, Error> {
    let path = Path::new(name);
    if path.extension().is_none_or(|extension| extension != "rs") {
        return Ok(None);
    }
    let energy = Energy::from_rust(&read_text(path, u64::MAX)?);
    let name = path.display().to_string();
    let named = |mistakes: Mistakes| Error::Declaration(Mistakes { name, ..mistakes });
    Ok(Some(MaterialSpec::declared(energy.map_err(named)?)))
}

/// A kind of unit in sentences.
fn in_words(unit: Unit) -> &'static str {
    match unit {
        Unit::Pascal => "in Pa",
        Unit::PerPascal => "in 1/Pa",
        _ => "without a unit",
    }
}

/// Adds values of parameters to a material.
///
/// # Errors
/// [`Error::Usage`] for a value in a unit that its parameter does not have.
fn with_values(spec: MaterialSpec, parameters: Vec<Given>) -> Result<MaterialSpec, Error> {
    let known = &spec.description()?.parameters;
    for given in &parameters {
        let declared = known.iter().find(|known| known.name == given.name).and_then(|known| known.unit);
        if let (Some(unit), Some(declared)) = (given.unit, declared)
            && unit != declared
        {
            return Err(Error::Usage(format!(
                "the parameter `{}` is {}, but its value is given {}; write another unit after it, or none",
                quoted(&given.name),
                in_words(declared),
                in_words(unit)
            )));
        }
    }
    Ok(parameters.into_iter().fold(spec, |spec, given| spec.with_parameter(&given.name, given.values)))
}

/// The material of a name with the small-strain moduli of another one, which may have this name or stand for
/// none.
pub(super) fn as_stiff(name: Option<&str>, other: &MaterialSpec) -> Result<MaterialSpec, Error> {
    match name {
        Some(name) if !other.is(name) => Ok(MaterialSpec::matching(name, other.build()?.moduli)),
        _ => Ok(other.clone()),
    }
}

/// Reads a material of a group, `GROUP=NAME;PARAM=V;…;density=RHO`, next to the material and the density of
/// the others.
pub(super) fn part(text: &str, others: &MaterialSpec, density: f64) -> Result<MaterialPart, Error> {
    let wrong = |reason: &str| Error::Usage(format!("--part {}: {reason}", quoted(text)));
    let mut words = text.split(';');
    let first = words.next().and_then(|first| first.split_once('='));
    let (group, name) = first.ok_or_else(|| wrong("write GROUP=NAME, or GROUP=NAME;PARAM=V"))?;
    let given = words.map(parameter).collect::<Result<Vec<_>, String>>();
    let given = given.map_err(|reason| wrong(&reason))?;
    let (densities, parameters): (Vec<_>, Vec<_>) = given.into_iter().partition(|one| one.name == "density");
    let density = match &densities[..] {
        [] => density,
        [Given { values, unit: None, .. }] if values.len() == 1 => values[0],
        _ => return Err(wrong("density=RHO needs one number, in kg/m³ and without a unit")),
    };
    let formula = Formula { parameters, ..Formula::default() };
    let mut material = formula.material(Some(name), |name| as_stiff(name, others))?;
    material.inversion = others.inversion;
    material.build().map_err(|error| wrong(&error.to_string()))?;
    Ok(MaterialPart { group: Some(group.to_owned()), material, density })
}
