//! Energies: of the catalogue, or declared in a text.

use std::ffi::{CString, c_char};

use piola::material::Description;
use piola_materials::DECLARATIONS;
use piola_scenes::material::MaterialSpec;

use crate::error::c_string;
use crate::functions::functions;
use crate::{handle, lent};

/// An elastic energy without values for its parameters. Immutable: threads may share it.
pub struct Energy {
    pub(crate) spec: MaterialSpec,
    description: Texts,
}

/// The notation of a declaration.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum Notation {
    /// The Rust function that `#[piola::material]` takes, such as
    /// `fn Rubber([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu / 2.0 * (I1 - 3.0) - mu * J.ln() }`.
    Rust = 0,
    /// A formula as papers write it, such as `mu/2*(I1 - 3) - mu*ln(J) where J > 0`. Names without another
    /// meaning are its parameters, in the order in which they occur.
    Formula = 1,
}

/// Description of a parameter.
#[repr(C)]
pub struct ParameterDescription {
    /// Its name.
    pub name: *const c_char,
    /// Its documentation, units included.
    pub documentation: *const c_char,
    /// 1 if it takes a list of values, such as one for each term of a sum; 0 if it takes one.
    pub is_list: i32,
    /// Values of some real material; null if none are known.
    pub typical: *const f64,
    /// Number of typical values.
    pub typical_length: usize,
}

/// Description of an energy.
#[repr(C)]
pub struct EnergyDescription {
    /// The name by which it is chosen.
    pub name: *const c_char,
    /// Short description, in a sentence or two.
    pub summary: *const c_char,
    /// The energy density as a formula in one line.
    pub formula: *const c_char,
    /// Domain of the energy, such as `J > 0`; empty if it is defined everywhere.
    pub domain: *const c_char,
    /// 1 if it can be continued beyond its domain, for inverted elements; 0 if not.
    pub extends: i32,
    /// The parameters.
    pub parameters: *const ParameterDescription,
    /// Number of parameters.
    pub parameter_count: usize,
}

/// Memory behind a description.
struct Texts {
    description: EnergyDescription,
    _texts: Vec<CString>,
    _typical: Vec<Vec<f64>>,
    _parameters: Vec<ParameterDescription>,
}

// SAFETY: its pointers are into memory that it owns and never changes.
unsafe impl Send for Texts {}
// SAFETY: as above.
unsafe impl Sync for Texts {}

impl Texts {
    fn new(name: &str, description: &Description) -> Self {
        let mut texts = Vec::new();
        let mut keep = |text: &str| {
            let text = c_string(text);
            // What a CString points to stays where it is when the CString moves.
            let pointer = text.as_ptr();
            texts.push(text);
            pointer
        };
        let typical: Vec<Vec<f64>> = match &description.typical {
            Some(typical) => typical.values.iter().map(|values| values.to_vec()).collect(),
            None => vec![Vec::new(); description.parameters.len()],
        };
        let parameters: Vec<_> = description
            .parameters
            .iter()
            .zip(&typical)
            .map(|(parameter, typical)| ParameterDescription {
                name: keep(&parameter.name),
                documentation: keep(&parameter.doc),
                is_list: parameter.is_list().into(),
                typical: if typical.is_empty() { std::ptr::null() } else { typical.as_ptr() },
                typical_length: typical.len(),
            })
            .collect();
        let description = EnergyDescription {
            name: keep(name),
            summary: keep(&description.summary),
            formula: keep(&description.formula),
            domain: keep(&description.domain),
            extends: description.extends.into(),
            parameters: parameters.as_ptr(),
            parameter_count: parameters.len(),
        };
        Self { description, _texts: texts, _typical: typical, _parameters: parameters }
    }
}

functions! {
/// An energy of the catalogue by its name, such as "neo_hookean"; ignores case, spaces, `_` and `-`.
///
/// Errors: PIOLA_CODE_MATERIAL for a name that is not in the catalogue; the message lists those that are.
fn piola_energy_named(name: &str, energy: New<Energy>) {
    energy.give(|| {
        let spec = MaterialSpec::new(name);
        let known = DECLARATIONS.iter().map(|declaration| declaration.name);
        let name = known.into_iter().find(|known| spec.is(known)).unwrap_or(name);
        let description = Texts::new(name, spec.description()?);
        Ok(Energy { spec, description })
    })
}

/// An energy that a text declares, in one of the notations of `piola_notation`. It is compiled here, within
/// milliseconds to seconds, and computes what the same declaration compiled by Rust does, to the last bit.
///
/// Errors: PIOLA_CODE_ENERGY for mistakes; the message lists all of them, each with its line.
fn piola_energy_declared(text: &str, notation: i32, energy: New<Energy>) {
    let notation = lent::choice("notation", notation, [Notation::Rust, Notation::Formula])?;
    energy.give(|| {
        let declared = match notation {
            Notation::Rust => piola_declare::Energy::from_rust(text),
            Notation::Formula => piola_declare::Energy::from_formula(text),
        }?;
        let description = Texts::new(&declared.description().name, declared.description());
        Ok(Energy { spec: MaterialSpec::declared(declared), description })
    })
}

/// The description of an energy, valid as long as its handle.
fn piola_energy_describe(energy: &Energy, description: Out<*const EnergyDescription>) {
    description.write(&energy.description.description)
}
}

/// Frees an energy, or does nothing with null. Materials made of it stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_energy_free(energy: Option<Box<Energy>>) {
    handle::free(energy);
}
