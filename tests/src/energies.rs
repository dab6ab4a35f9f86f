//! The catalogue as judges take it: every energy behind pointers, so that no judge is compiled again for each
//! of them.
//!
//! An energy is the compiled one where this build has it, and else the interpreted one:
//! `tests/interpreted.rs` proves that both have the same bits. With the feature `all` every energy is a
//! compiled one.

use std::sync::LazyLock;

use piola::interpreter::Interpreted;
use piola::material::{Declared, Description, MaterialError, Moduli, Response};
use piola::{DynMaterial, Inversion, Real};
use piola_declare::Energy;
use piola_materials::{DECLARATIONS, Entry, Visitor};

/// All energies of the catalogue, in the order of their names.
pub static ENERGIES: LazyLock<Vec<Judged>> = LazyLock::new(|| {
    let judged = |declaration: &piola_materials::Declaration| Judged {
        name: declaration.name,
        compiled: piola_materials::find(declaration.name),
        energy: Energy::from_rust(declaration.source)
            .unwrap_or_else(|mistakes| panic!("{}: {mistakes}", declaration.name)),
    };
    DECLARATIONS.iter().map(judged).collect()
});

/// The energy of that name.
pub fn find(name: &str) -> Option<&'static Judged> {
    ENERGIES.iter().find(|energy| energy.name == name)
}

/// True if the arguments of the program have no name, or one that is part of `trial`: the filter of tests
/// without a harness.
pub fn is_asked_for(trial: &str) -> bool {
    let mut names = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).peekable();
    names.peek().is_none() || names.any(|name| trial.contains(&name))
}

/// An energy of the catalogue.
#[derive(Debug)]
pub struct Judged {
    /// Name in the catalogue.
    pub name: &'static str,
    /// The compiled energy, if this build has it.
    pub compiled: Option<&'static Entry>,
    /// The energy declared at run time.
    pub energy: Energy,
}

impl Judged {
    /// Formula, parameters, domain.
    pub fn description(&self) -> &Description {
        self.energy.description()
    }

    /// Typical parameters as declared, one slice for each.
    pub fn typical(&self) -> Vec<&[f64]> {
        self.energy.typical()
    }

    /// The material with these values, one slice for each parameter.
    ///
    /// # Errors
    /// [`MaterialError`], those of the compiled constructor where the build has it.
    pub fn subject(&self, values: &[&[f64]], inversion: Inversion) -> Result<Subject, MaterialError> {
        let compiled = Compiled { energy: &self.energy, values, inversion };
        match self.compiled.map(|entry| entry.visit(values, inversion, compiled)?) {
            // The catalogue compiles lists of a few lengths only.
            None | Some(Err(MaterialError::Shape { .. })) => {
                let exact = self.energy.material(values, inversion)?;
                let moduli = Moduli::of(&exact);
                let double = self.energy.boxed(values, inversion)?;
                Ok(Subject { double, single: Box::new(exact.clone()), exact, moduli })
            }
            Some(subject) => subject,
        }
    }

    /// The ways of inversion that the energy has: refusing, and continued below `epsilon` if it can be.
    pub fn inversions(&self, epsilon: f64) -> impl Iterator<Item = Inversion> + use<> {
        let extended = self.description().extends.then_some(Inversion::Extend { epsilon });
        std::iter::once(Inversion::Refuse).chain(extended)
    }
}

/// Makes the subject of a compiled energy.
struct Compiled<'a> {
    energy: &'a Energy,
    values: &'a [&'a [f64]],
    inversion: Inversion,
}

impl Visitor for Compiled<'_> {
    type Output = Result<Subject, MaterialError>;

    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
        let Self { energy, values, inversion } = self;
        let (moduli, single) = (material.moduli(), M::from_values(values, inversion)?);
        let exact = energy.material(values, inversion)?;
        Ok(Subject { double: Box::new(material), single: Box::new(single), exact, moduli })
    }
}

/// A material in the formats that judges use.
pub struct Subject {
    /// Material in `f64`, single points and batches.
    pub double: Box<dyn DynMaterial<f64>>,
    /// Material in `f32`, single points.
    pub single: Box<dyn Response<f32>>,
    /// Material for any other real number, such as one of a hundred digits.
    pub exact: Interpreted,
    /// Small-strain moduli, Pa.
    pub moduli: Moduli,
}

/// A real type of one machine number, read and written by its bits: a format of single points.
pub trait Format: Real<Mask = bool> + PartialOrd + Into<f64> {
    /// `f64` or `f32`.
    const NAME: &'static str;
    /// The largest finite number.
    const LARGEST: f64;
    /// The smallest positive number, subnormal.
    const SMALLEST: f64;

    /// The number of these bits; of the lower half of them where it has only 32.
    fn from_bits(bits: u64) -> Self;

    /// The material in this format.
    fn of(subject: &Subject) -> &dyn Response<Self>;

    /// The number as a double, exactly.
    fn widen(self) -> f64 {
        self.into()
    }
}

impl Format for f64 {
    const NAME: &'static str = "f64";
    const LARGEST: f64 = Self::MAX;
    const SMALLEST: f64 = 5e-324;

    fn from_bits(bits: u64) -> Self {
        Self::from_bits(bits)
    }

    fn of(subject: &Subject) -> &dyn Response<Self> {
        &*subject.double
    }
}

impl Format for f32 {
    const NAME: &'static str = "f32";
    const LARGEST: f64 = Self::MAX as f64;
    const SMALLEST: f64 = 1.401_298_464_324_817e-45;

    fn from_bits(bits: u64) -> Self {
        Self::from_bits(bits as u32)
    }

    fn of(subject: &Subject) -> &dyn Response<Self> {
        &*subject.single
    }
}
