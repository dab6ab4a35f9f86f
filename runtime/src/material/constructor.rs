//! Common parts of the constructors of declared materials: reading and checking of parameters.

use std::borrow::Cow;

use super::condition::{Condition, argument, number};
use super::{Argument, Declared, Inversion, Material, MaterialError, Moduli, Parameter, Text};
use crate::message;

/// The largest exponent that is a parameter: that of `.powi(…)` in a declaration.
const LARGEST_WHOLE: u32 = 64;

/// Checks that numbers are finite and, if they are exponents, whole and not too large, and that they satisfy
/// the conditions of `admissible(…)`. There is one slice of values for each parameter, empty for a function.
///
/// # Errors
/// [`MaterialError::Other`], [`MaterialError::Violated`] with the first that is not.
pub fn check_parameters(
    parameters: &[Parameter],
    values: &[&[f64]],
    admissible: &[Condition],
) -> Result<(), MaterialError> {
    let lists = parameters.iter().zip(values);
    let numbers =
        lists.flat_map(|(parameter, list)| list.iter().enumerate().map(move |one| (parameter, one)));
    for (parameter, (index, &value)) in numbers {
        if parameter.is_whole() {
            whole_number(parameter, index, value)?;
        } else if !value.is_finite() {
            return Err(wrong(parameter, index, value, "it must be a finite number"));
        }
    }
    match violated(parameters, values, admissible) {
        None => Ok(()),
        Some((condition, given)) => Err(MaterialError::Violated { condition, given }),
    }
}

/// The first condition that does not hold, and the parameters that it names.
fn violated(
    parameters: &[Parameter],
    values: &[&[f64]],
    conditions: &[Condition],
) -> Option<(Text, Vec<Argument>)> {
    let given = |condition: &Condition| condition.violation(parameters, values);
    conditions.iter().find_map(|condition| Some((condition.text.clone(), given(condition)?)))
}

/// Checks that a list has as many entries as the first of those that are read with it, each given by its name
/// and its length.
///
/// # Errors
/// [`MaterialError::Shape`].
pub fn same_length(list: (&str, usize), first: (&str, usize)) -> Result<(), MaterialError> {
    if list.1 == first.1 {
        return Ok(());
    }
    let expected =
        format!("`{}` must have as many entries as `{}`, {}, not {}", list.0, first.0, first.1, list.1);
    Err(MaterialError::Shape { expected })
}

/// Checks that a material with these parameters can be extended, if that is requested.
///
/// # Errors
/// [`MaterialError::Other`] unless 0 < ε < 1, [`MaterialError::DoesNotRestore`] unless the conditions of
/// `extend(…)` hold.
pub fn extends(
    parameters: &[Parameter],
    values: &[&[f64]],
    inversion: Inversion,
    restoring: &[Condition],
) -> Result<(), MaterialError> {
    let Inversion::Extend { epsilon } = inversion else { return Ok(()) };
    if !(epsilon > 0.0 && epsilon < 1.0) {
        let epsilon = message::number(epsilon);
        return Err(MaterialError::Other(format!(
            "the extension threshold epsilon is {epsilon}; it must satisfy 0 < epsilon < 1"
        )));
    }
    match violated(parameters, values, restoring) {
        None => Ok(()),
        Some((condition, given)) => Err(MaterialError::DoesNotRestore { condition, given }),
    }
}

/// Stated moduli of a material, Pa, from its two expressions.
#[must_use]
pub const fn stated_moduli(mu: f64, lambda: f64) -> Option<Moduli> {
    Some(Moduli { mu, lambda })
}

/// A material that has no extension.
///
/// # Errors
/// [`MaterialError::NoExtension`] if one is requested.
pub fn unextended<M: Declared>(material: M, inversion: Inversion) -> Result<M, MaterialError> {
    match inversion {
        Inversion::Refuse => Ok(material),
        Inversion::Extend { .. } => {
            Err(MaterialError::NoExtension { material: M::DESCRIPTION.name, reason: M::DESCRIPTION.refusal })
        }
    }
}

/// Checks that a bound of the domain, which is positive inside of it, is so at rest. The condition names
/// parameters by their places.
///
/// # Errors
/// [`MaterialError::RestOutside`] with the numbers among these parameters.
pub fn inside_at_rest(
    parameters: &[Parameter],
    values: &[&[f64]],
    bound: f64,
    condition: impl Into<Text>,
    names: &[usize],
) -> Result<(), MaterialError> {
    if bound > 0.0 {
        return Ok(());
    }
    let named = names.iter().filter_map(|&k| Some((parameters.get(k)?, number(values, k, 0))));
    let numbers = named.filter(|(parameter, _)| !parameter.is_list());
    let given = numbers.map(|(parameter, value)| argument(parameter, 0, value)).collect();
    Err(MaterialError::RestOutside { condition: condition.into(), given })
}

/// A material whose rest state is as declared: stable, unless it is prestressed. Where its functions are
/// defined, and what cancels their stress, no declaration can promise.
///
/// # Errors
/// [`MaterialError::UnstableRest`]; [`MaterialError::Other`] for functions.
pub fn at_rest<M: Material>(
    material: M,
    is_prestressed: bool,
    has_functions: bool,
) -> Result<M, MaterialError> {
    if has_functions && !material.admits([1.0f64; 3]) {
        let undefined = "the energy is not defined at rest, where all stretches are 1: let each of its functions admit its \
                         argument there";
        return Err(MaterialError::Other(undefined.to_owned()));
    }
    if is_prestressed {
        return Ok(material);
    }
    let moduli = Moduli::of(&material);
    let is_stable = moduli.mu > 0.0 && moduli.bulk() >= 0.0 && moduli.bulk().is_finite();
    if !is_stable {
        return Err(MaterialError::UnstableRest { moduli });
    }
    if has_functions {
        let [stress, ..] = material.gradient([1.0f64; 3]);
        let is_free = stress.abs() <= 1e-9 * (2.0 * moduli.mu + moduli.lambda.abs());
        if !is_free {
            return Err(stressed_rest(stress));
        }
    }
    Ok(material)
}

/// Error of a rest state with a stress ψ1(1, 1, 1), Pa, which functions given as parameters do not cancel.
pub(super) fn stressed_rest(stress: f64) -> MaterialError {
    MaterialError::Other(format!(
        "the rest state would carry a stress of {} Pa: the derivatives of the functions do not cancel there. Pass \
         functions whose derivatives do, or change the energy: write `I1b`, `I2b` for `I1`, `I2`, or add `- p * J.ln()` \
         with this stress as a parameter `p`",
        message::number(stress)
    ))
}

/// True if the sign of a tiny stretch decides about the domain, for example if a function of a stretch ends
/// at 0.
#[must_use]
pub fn sign_decides(material: &impl Material) -> bool {
    let tiny = 2f64.powi(-1000);
    material.admits([1.0, 1.0, tiny]) != material.admits([1.0, 1.0, -tiny])
}

/// Values of parameters, read one after the other in the order of the declaration.
pub struct Values<'a> {
    parameters: Cow<'a, [Parameter]>,
    values: &'a [&'a [f64]],
    /// Number of parameters that have been read.
    read: usize,
}

impl<'a> Values<'a> {
    /// Values from one slice for each parameter of a declared material.
    ///
    /// # Errors
    /// As [`Values::new`].
    pub fn of<M: Declared>(values: &'a [&'a [f64]]) -> Result<Self, MaterialError> {
        Self::new(values, M::DESCRIPTION.parameters)
    }

    /// Values from one slice for each parameter.
    ///
    /// # Errors
    /// [`MaterialError::Shape`] if there are more or fewer.
    pub fn new(values: &'a [&'a [f64]], parameters: Cow<'a, [Parameter]>) -> Result<Self, MaterialError> {
        if values.len() == parameters.len() {
            return Ok(Self { parameters, values, read: 0 });
        }
        let listed = parameters.iter().map(|parameter| format!("`{}`", parameter.name));
        let listed = listed.collect::<Vec<_>>().join(", ");
        let expected = format!("{} parameters are expected: {listed}", parameters.len());
        Err(MaterialError::Shape { expected })
    }

    /// The next parameter, described by any number of values.
    pub fn slice(&mut self) -> &'a [f64] {
        self.read += 1;
        self.values.get(self.read - 1).copied().unwrap_or_default()
    }

    /// The next parameter, one number.
    ///
    /// # Errors
    /// [`MaterialError::Shape`].
    pub fn number(&mut self) -> Result<f64, MaterialError> {
        match *self.slice() {
            [number] => Ok(number),
            _ => Err(self.shape("be one number")),
        }
    }

    /// The next parameter, a list of `length` numbers.
    ///
    /// # Errors
    /// [`MaterialError::Shape`].
    pub fn entries(&mut self, length: usize) -> Result<&'a [f64], MaterialError> {
        let entries = self.slice();
        if entries.len() == length { Ok(entries) } else { Err(self.shape(&format!("have {length} entries"))) }
    }

    /// The next parameter, a list of N numbers.
    ///
    /// # Errors
    /// [`MaterialError::Shape`].
    pub fn list<const N: usize>(&mut self) -> Result<[f64; N], MaterialError> {
        let entries = self.entries(N)?;
        Ok(std::array::from_fn(|k| entries[k]))
    }

    /// The next parameter, one whole exponent.
    ///
    /// # Errors
    /// [`MaterialError::Shape`], [`MaterialError::Other`].
    pub fn whole_number(&mut self) -> Result<u32, MaterialError> {
        let value = self.number()?;
        whole_number(self.latest(), 0, value)
    }

    /// The next parameter, a list of N whole exponents.
    ///
    /// # Errors
    /// [`MaterialError::Shape`], [`MaterialError::Other`].
    pub fn whole_list<const N: usize>(&mut self) -> Result<[u32; N], MaterialError> {
        let values = self.list::<N>()?;
        let mut list = [0; N];
        for (index, (entry, value)) in list.iter_mut().zip(values).enumerate() {
            *entry = whole_number(self.latest(), index, value)?;
        }
        Ok(list)
    }

    /// The next parameter, a list of any number of whole exponents.
    ///
    /// # Errors
    /// [`MaterialError::Other`].
    pub fn whole_numbers(&mut self) -> Result<Vec<u32>, MaterialError> {
        let values = self.slice().iter().enumerate();
        values.map(|(index, &value)| whole_number(self.latest(), index, value)).collect()
    }

    /// The parameter that has been read last.
    fn latest(&self) -> &Parameter {
        &self.parameters[self.read - 1]
    }

    /// Error of a parameter that has been read.
    fn shape(&self, expected: &str) -> MaterialError {
        MaterialError::Shape { expected: format!("`{}` must {expected}", self.latest().name) }
    }
}

/// A value as an exponent.
fn whole_number(parameter: &Parameter, index: usize, value: f64) -> Result<u32, MaterialError> {
    if value.fract() == 0.0 && (0.0..=f64::from(LARGEST_WHOLE)).contains(&value) {
        return Ok(value as u32);
    }
    Err(wrong(parameter, index, value, "such an exponent must be a whole number from 0 to 64"))
}

/// Error of a number among the parameters, with the demand that it does not meet.
fn wrong(parameter: &Parameter, index: usize, value: f64, demand: &str) -> MaterialError {
    let name = argument(parameter, index, value).name();
    MaterialError::Other(format!("`{name}` is {}; {demand}", message::number(value)))
}
