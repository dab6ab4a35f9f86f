//! Declarations in Rust: the same function that `#[piola::material]` takes.

use piola::contract;
use piola_codegen::analyse_in;
use piola_codegen::read::notation::Notation;
use proc_macro2::TokenStream;

use crate::energy::Energy;
use crate::mistakes::Mistakes;

/// The message about an energy beyond the limits.
pub(crate) const TOO_LARGE: &str = "this energy is too large: fewer operations, or a list with a sum instead of many terms, keep within the limits";

/// The longest text of an energy, in bytes.
const LARGEST_TEXT: usize = 1 << 16;

/// The largest size of an energy, the number of its different expressions, derivatives included, and of their
/// operands: some ten times that of the largest energy of the catalogue, and compiled within a second or
/// two.
pub(crate) const LARGEST: Option<usize> = Some(150_000);

impl Energy {
    /// The energy of the one declaration in a text, a function as `#[piola::material]` takes it.
    ///
    /// # Errors
    /// All [`Mistakes`], the messages of the attribute.
    pub fn from_rust(text: &str) -> Result<Self, Mistakes> {
        check_size(text)?;
        let declarations =
            piola_codegen::declarations(text).map_err(|error| Mistakes::from_syn(text, error))?;
        let energies = declarations.into_iter().map(|(arguments, item)| compile(text, arguments, item));
        let mut energies = energies.collect::<Result<Vec<_>, _>>()?;
        match (energies.pop(), energies.len()) {
            (Some(energy), 0) => Ok(energy),
            (None, _) => Err(Mistakes::of_all(
                text,
                "no energy is declared here: write a function `fn Name([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { … }` with \
                 `#[material]` before it"
                    .to_owned(),
            )),
            (Some(last), more) => Err(Mistakes::of_all(
                text,
                format!("{} energies are declared here, `{}` the last of them: keep one", more + 1, last.description().name),
            )),
        }
    }
}

fn compile(text: &str, arguments: TokenStream, item: TokenStream) -> Result<Energy, Mistakes> {
    let (declaration, model) = analyse_in(Notation::Rust, arguments, item, LARGEST)
        .map_err(|error| Mistakes::from_syn(text, error))?;
    Energy::new(&declaration, model, text.to_owned(), text.to_owned(), contract::Notation::Rust)
        .ok_or_else(|| Mistakes::of_all(text, TOO_LARGE.to_owned()))
}

/// Checks that a text is no longer than any energy.
///
/// # Errors
/// [`Mistakes`] about the whole text.
pub(crate) fn check_size(text: &str) -> Result<(), Mistakes> {
    if text.len() <= LARGEST_TEXT {
        return Ok(());
    }
    let message = format!("this text has {} bytes; that of an energy has at most {LARGEST_TEXT}", text.len());
    Err(Mistakes::of_all("", message))
}
