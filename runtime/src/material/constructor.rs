//! Common parts of the constructors of declared materials: reading and checking of parameters.

use std::borrow::Cow;

use super::{Argument, Declared, Inversion, Material, MaterialError, Moduli, Parameter};

/// The largest exponent that is a parameter: that of `.powi(…)` in a declaration.
const LARGEST_WHOLE: u32 = 64;

/// Checks the numbers of a material's parameters, one slice for each, which is empty for a function.
///
/// # Errors
/// Like [`check_parameters`].
pub fn check_numbers<M: Declared>(values: &[&[f64]]) -> Result<(), MaterialError> {
    check_parameters(&M::DESCRIPTION.parameters, values.iter().copied())
}

/// Checks that numbers are finite and, if they are exponents, whole and not too large.
///
/// # Errors
/// [`MaterialError::NotFinite`], [`MaterialError::NotWhole`] with the first that is not.
pub fn check_parameters<'a>(
    parameters: &[Parameter],
    values: impl Iterator<Item = &'a [f64]>,
) -> Result<(), MaterialError> {
    let numbers = parameters.iter().zip(values);
    let mut numbers =
        numbers.flat_map(|(parameter, list)| list.iter().enumerate().map(move |one| (parameter, one)));
    numbers.try_for_each(|(parameter, (index, &value))| match parameter.is_whole() {
        true => whole_number(parameter, index, value).map(|_| ()),
        false if value.is_finite() => Ok(()),
        false => Err(MaterialError::NotFinite { given: argument(parameter, index, value) }),
    })
}

fn argument(parameter: &Parameter, index: usize, value: f64) -> Argument {
    Argument { parameter: parameter.name.clone(), index: parameter.is_list().then_some(index), value }
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

/// Name of a parameter, its place if it is an entry of a list, and its value: the fields of [`Argument`].
type Named = (&'static str, Option<usize>, f64);

fn named(given: &[Named]) -> Vec<Argument> {
    let argument =
        |&(parameter, index, value): &Named| Argument { parameter: parameter.into(), index, value };
    given.iter().map(argument).collect()
}

/// Checks a condition of `admissible(…)`.
///
/// # Errors
/// [`MaterialError::Violated`] unless it holds.
pub fn admissible(holds: bool, condition: &'static str, given: &[Named]) -> Result<(), MaterialError> {
    if holds {
        Ok(())
    } else {
        Err(MaterialError::Violated { condition: condition.into(), given: named(given) })
    }
}

/// Checks a condition of `extend(…)`.
///
/// # Errors
/// [`MaterialError::DoesNotRestore`] unless it holds.
pub fn restoring(holds: bool, condition: &'static str, given: &[Named]) -> Result<(), MaterialError> {
    if holds {
        Ok(())
    } else {
        Err(MaterialError::DoesNotRestore { condition: condition.into(), given: named(given) })
    }
}

/// True if a material is to be extended.
///
/// # Errors
/// [`MaterialError::Threshold`] unless 0 < ε < 1.
pub fn extends(inversion: Inversion) -> Result<bool, MaterialError> {
    match inversion {
        Inversion::Refuse => Ok(false),
        Inversion::Extend { epsilon } if epsilon > 0.0 && epsilon < 1.0 => Ok(true),
        Inversion::Extend { epsilon } => Err(MaterialError::Threshold { epsilon }),
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

/// Checks that a bound of the domain, which is positive inside of it, is so at rest.
///
/// # Errors
/// [`MaterialError::RestOutside`].
pub fn inside_at_rest(bound: f64, condition: &'static str, given: &[Named]) -> Result<(), MaterialError> {
    if bound > 0.0 {
        Ok(())
    } else {
        Err(MaterialError::RestOutside { condition: condition.into(), given: named(given) })
    }
}

/// A material that is defined where all stretches are 1.
///
/// # Errors
/// [`MaterialError::UndefinedRest`].
pub fn defined_at_rest<M: Material>(material: M) -> Result<M, MaterialError> {
    if material.admits([1.0f64; 3]) { Ok(material) } else { Err(MaterialError::UndefinedRest) }
}

/// True if the sign of a tiny stretch decides about the domain, for example if a function of a stretch ends
/// at 0.
#[must_use]
pub fn sign_decides(material: &impl Material) -> bool {
    let tiny = 2f64.powi(-1000);
    material.admits([1.0, 1.0, tiny]) != material.admits([1.0, 1.0, -tiny])
}

/// A material whose shear modulus at rest is positive and whose bulk modulus is not negative.
///
/// # Errors
/// [`MaterialError::UnstableRest`].
pub fn stable_at_rest<M: Material>(material: M) -> Result<M, MaterialError> {
    let moduli = Moduli::of(&material);
    if moduli.mu > 0.0 && moduli.bulk() >= 0.0 && moduli.bulk().is_finite() {
        return Ok(material);
    }
    Err(MaterialError::UnstableRest { moduli })
}

/// A material without stress at rest, to rounding.
///
/// # Errors
/// [`MaterialError::StressedRest`].
pub fn stress_free_at_rest<M: Material>(material: M) -> Result<M, MaterialError> {
    let moduli = Moduli::of(&material);
    let [stress, ..] = material.gradient([1.0f64; 3]);
    if stress.abs() <= 1e-9 * (2.0 * moduli.mu + moduli.lambda.abs()) {
        return Ok(material);
    }
    Err(MaterialError::StressedRest { stress })
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
    /// [`MaterialError::Shape`], [`MaterialError::NotWhole`].
    pub fn whole_number(&mut self) -> Result<u32, MaterialError> {
        let value = self.number()?;
        whole_number(self.latest(), 0, value)
    }

    /// The next parameter, a list of N whole exponents.
    ///
    /// # Errors
    /// [`MaterialError::Shape`], [`MaterialError::NotWhole`].
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
    /// [`MaterialError::NotWhole`].
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
    Err(MaterialError::NotWhole { given: argument(parameter, index, value) })
}
