//! Common parts of the constructors of declared materials: checks of parameters, and how they are read.

use super::{Argument, Declared, Inversion, Material, MaterialError, Moduli};

/// Checks that a parameter is a finite number.
///
/// # Errors
/// [`MaterialError::NotFinite`].
pub fn finite(parameter: &'static str, value: f64) -> Result<(), MaterialError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(MaterialError::NotFinite { given: Argument::scalar(parameter, value) })
}

/// Checks that all entries of a list are finite numbers.
///
/// # Errors
/// [`MaterialError::NotFinite`] with the first that is not.
pub fn all_finite(parameter: &'static str, values: &[f64]) -> Result<(), MaterialError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => {
            Err(MaterialError::NotFinite { given: Argument::entry(parameter, index, values[index]) })
        }
    }
}

/// The largest exponent that is a parameter: that of `.powi(…)` in a declaration.
const LARGEST_WHOLE: u32 = 64;

/// Checks that an exponent is not too large.
///
/// # Errors
/// [`MaterialError::NotWhole`].
pub fn whole(parameter: &'static str, value: u32) -> Result<(), MaterialError> {
    whole_number(Argument::scalar(parameter, f64::from(value))).map(|_| ())
}

/// Checks that no exponent of a list is too large.
///
/// # Errors
/// [`MaterialError::NotWhole`] with the first that is.
pub fn all_whole(parameter: &'static str, values: &[u32]) -> Result<(), MaterialError> {
    let mut values = values.iter().enumerate();
    values.try_for_each(|(index, &value)| {
        whole_number(Argument::entry(parameter, index, f64::from(value))).map(|_| ())
    })
}

/// Checks that a list has as many entries as the first of those that are read with it, each given by its name
/// and its length.
///
/// # Errors
/// [`MaterialError::Shape`].
pub fn same_length(list: (&'static str, usize), first: (&'static str, usize)) -> Result<(), MaterialError> {
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

/// Whether a material is to be extended.
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
/// [`MaterialError::NoExtension`] if one is asked for.
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

/// Whether the sign of a tiny stretch decides over the domain, as where a function of a stretch ends at 0.
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
pub struct Values<'a>(std::iter::Zip<std::slice::Iter<'a, &'static str>, std::slice::Iter<'a, &'a [f64]>>);

impl<'a> Values<'a> {
    /// One slice for each parameter.
    ///
    /// # Errors
    /// [`MaterialError::Shape`] if there are more or fewer.
    pub fn new(values: &'a [&'a [f64]], names: &'a [&'static str]) -> Result<Self, MaterialError> {
        if values.len() == names.len() {
            return Ok(Self(names.iter().zip(values)));
        }
        let listed = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        Err(MaterialError::Shape { expected: format!("{} parameters are expected: {listed}", names.len()) })
    }

    /// The next parameter, however many numbers describe it.
    pub fn slice(&mut self) -> &'a [f64] {
        self.0.next().map_or(&[], |(_, values)| values)
    }

    /// The next parameter, one number.
    ///
    /// # Errors
    /// [`MaterialError::Shape`].
    pub fn number(&mut self) -> Result<f64, MaterialError> {
        let [number] = self.array(|name, _| format!("`{name}` must be one number"))?;
        Ok(number)
    }

    /// The next parameter, one whole exponent.
    ///
    /// # Errors
    /// [`MaterialError::Shape`], [`MaterialError::NotWhole`].
    pub fn whole_number(&mut self) -> Result<u32, MaterialError> {
        let name = self.name();
        let value = self.number()?;
        whole_number(Argument::scalar(name, value))
    }

    /// The next parameter, a list of N whole exponents.
    ///
    /// # Errors
    /// [`MaterialError::Shape`], [`MaterialError::NotWhole`].
    pub fn whole_list<const N: usize>(&mut self) -> Result<[u32; N], MaterialError> {
        let name = self.name();
        let values = self.list::<N>()?;
        let mut list = [0; N];
        for (index, (entry, value)) in list.iter_mut().zip(values).enumerate() {
            *entry = whole_number(Argument::entry(name, index, value))?;
        }
        Ok(list)
    }

    /// The next parameter, whole exponents, however many.
    ///
    /// # Errors
    /// [`MaterialError::NotWhole`].
    pub fn whole_numbers(&mut self) -> Result<Vec<u32>, MaterialError> {
        let name = self.name();
        let values = self.slice().iter().enumerate();
        values.map(|(index, &value)| whole_number(Argument::entry(name, index, value))).collect()
    }

    /// The name of the next parameter.
    fn name(&self) -> &'static str {
        self.0.clone().next().map_or("", |(name, _)| *name)
    }

    /// The next parameter, a list of N numbers.
    ///
    /// # Errors
    /// [`MaterialError::Shape`].
    pub fn list<const N: usize>(&mut self) -> Result<[f64; N], MaterialError> {
        self.array(|name, length| format!("`{name}` must have {length} entries"))
    }

    fn array<const N: usize>(
        &mut self,
        expected: impl Fn(&str, usize) -> String,
    ) -> Result<[f64; N], MaterialError> {
        let (name, values) = self.0.next().map_or(("", &[][..]), |(name, values)| (*name, *values));
        <[f64; N]>::try_from(values).map_err(|_| MaterialError::Shape { expected: expected(name, N) })
    }
}

/// A value as an exponent.
fn whole_number(given: Argument) -> Result<u32, MaterialError> {
    let value = given.value;
    if value.fract() == 0.0 && (0.0..=f64::from(LARGEST_WHOLE)).contains(&value) {
        return Ok(value as u32);
    }
    Err(MaterialError::NotWhole { given })
}
