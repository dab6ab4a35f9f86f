//! Formulas in the notation of papers: `mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2`.
//!
//! A formula is translated into the Rust function that `#[piola::material]` takes, token by token, so that
//! its mistakes are reported at their places in the formula. Names without another meaning are parameters, in
//! the order in which they occur, and so are all names with values from the caller.
//!
//! The domain follows the formula, `… where J > 0, I1 < 3 + Jm`, together with conditions on the parameters.
//! Without it, the energy is defined for every J, for J > 0 and continued beyond, or for J > 0 alone: the
//! first of these that its formula allows.

mod notation;
mod parse;
mod spellings;

use piola::contract;
use piola_codegen::algebra::increment::substitute_rest;
use piola_codegen::emit::spaced;
use piola_codegen::model::MOST_PARAMETERS;
use piola_codegen::printer;
use piola_codegen::read::notation::Notation as Language;
use piola_codegen::{analyse_in, read};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use crate::energy::Energy;
use crate::mistakes::Mistakes;
use crate::rust::{LARGEST, TOO_LARGE};
use notation::Notation;
use parse::{Parsed, parse};

/// Choices for an energy that is given by a formula.
///
/// ```
/// use piola::Inversion;
/// use piola_declare::{Energy, FormulaOptions};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // Rivlin's solid as printed has a stress at rest, and lets the volume go.
/// let bulk = Some("kappa".into());
/// let options = FormulaOptions { free_rest: true, bulk, ..FormulaOptions::default() };
/// let energy = Energy::from_formula_with("C10*(I1 - 3) + C01*(I2 - 3)", &options)?;
/// let rubber = energy.material(&[&[2e5], &[1e4], &[1e7]], Inversion::Refuse)?;
/// assert_eq!(energy.description().moduli[0], "2 C10 + 2 C01");
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FormulaOptions {
    /// Names that are parameters, regardless of any other meaning: those that have values. Each has its
    /// documentation, which may end with a unit, as in `Shear modulus, Pa.`. A name without a value is then a
    /// mistake. `None` to take every name that means nothing else.
    pub parameters: Option<Vec<(String, String)>>,
    /// True if unknown names beyond [`parameters`](Self::parameters) are parameters, too.
    pub further: bool,
    /// True to add −s ln J, s being the stress at rest, which makes the rest state free of stress.
    pub free_rest: bool,
    /// Name of the bulk modulus κ of a term κ/2 (J − 1)² that is added.
    pub bulk: Option<String>,
    /// The form in which the user gives a value to the parameter `NAME`, for messages: `--param NAME=VALUE`.
    pub value: Option<&'static str>,
    /// The option by which the user sets [`free_rest`](Self::free_rest), for messages: `--free-rest`.
    pub free_rest_option: Option<&'static str>,
}

impl Energy {
    /// The energy of a formula.
    ///
    /// ```
    /// use piola::Inversion;
    /// use piola_declare::Energy;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let energy = Energy::from_formula("mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2")?;
    /// let names: Vec<_> = energy.description().parameters.iter().map(|parameter| &*parameter.name).collect();
    /// assert_eq!((names, &*energy.description().domain), (vec!["mu", "lambda"], "J > 0"));
    /// let rubber = energy.material(&[&[1e6], &[5e6]], Inversion::Refuse)?;
    ///
    /// let mistakes = Energy::from_formula("mu/2*(I1 - 3").unwrap_err();
    /// assert_eq!(mistakes.list[0].place.map(|place| place.column), Some(6));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// All [`Mistakes`], each at its place in the formula.
    pub fn from_formula(formula: &str) -> Result<Self, Mistakes> {
        Self::from_formula_with(formula, &FormulaOptions::default())
    }

    /// The energy of a formula, with these options.
    ///
    /// # Errors
    /// All [`Mistakes`], each at its place in the formula.
    pub fn from_formula_with(formula: &str, options: &FormulaOptions) -> Result<Self, Mistakes> {
        let language = Language::Formula { free_rest: options.free_rest_option };
        let notation = Notation::read(formula)?;
        let mistakes = |error: syn::Error| notation.mistakes(formula, error);
        let mut parsed = parse(notation.tokens.clone(), options).map_err(mistakes)?;
        let parameters = parsed.parameters.len();
        if parameters > MOST_PARAMETERS {
            let message = format!(
                "this formula has {parameters} parameters, and one that is compiled at run time at most {MOST_PARAMETERS}: \
                 write lists of them, as in `sum(p, mu[p]*…)`"
            );
            return Err(Mistakes::of_all(formula, message));
        }
        if options.free_rest {
            parsed.free_rest(language).map_err(mistakes)?;
        }
        // The text alone is the energy, if it is read so without the options.
        let alone = parse(notation.tokens.clone(), &FormulaOptions::default());
        let all = |parsed: &Parsed| {
            let [item, arguments] = [parsed.item(), parsed.arguments().into_iter().collect()];
            (item.to_string(), arguments.to_string())
        };
        let is_alone = alone.is_ok_and(|alone| all(&alone) == all(&parsed));
        // The first of these that has no mistakes and is not too large; else the mistakes of the last.
        let mut last = Mistakes::of_all(formula, "this is not an energy".to_owned());
        for arguments in parsed.arguments() {
            let found = analyse_in(language, arguments.clone(), parsed.item(), LARGEST);
            let energy = found.map_err(mistakes).and_then(|(declaration, model)| {
                let source = source(&arguments, &parsed.item());
                let text = if is_alone { formula.to_owned() } else { source.clone() };
                Self::new(&declaration, model, text, source, contract::Notation::Formula)
                    .ok_or_else(|| Mistakes::of_all(formula, TOO_LARGE.to_owned()))
            });
            match energy {
                Ok(energy) => return Ok(energy),
                Err(mistakes) => last = mistakes,
            }
        }
        Err(last)
    }
}

impl Parsed {
    /// The declared function.
    fn item(&self) -> TokenStream {
        let Self { parameters, body, .. } = self;
        let [l1, l2, l3] = parse::STRETCHES.map(|stretch| Ident::new(stretch, Span::call_site()));
        quote! {
            #[doc = " Energy of a formula."]
            pub fn Energy([#l1, #l2, #l3]: [f64; 3], #(#parameters),*) -> f64 {
                #body
            }
        }
    }

    /// Arguments of the attribute, the most general first.
    fn arguments(&self) -> Vec<TokenStream> {
        let Self { domain, admissible, .. } = self;
        let admissible = (!admissible.is_empty()).then(|| quote!(admissible(#(#admissible),*)));
        let everywhere = domain.is_empty().then(|| quote!(#admissible));
        let domain = if domain.is_empty() { vec![quote!(J > 0.0)] } else { domain.clone() };
        let admissible = admissible.map(|admissible| quote!(, #admissible));
        let bounded = quote!(domain(#(#domain),*) #admissible);
        everywhere.into_iter().chain([quote!(#bounded, extend), bounded]).collect()
    }

    /// Subtracts s ln J, with the stress s at rest.
    fn free_rest(&mut self, language: Language) -> syn::Result<()> {
        let domain = if self.domain.is_empty() { vec![quote!(J > 0.0)] } else { self.domain.clone() };
        let (declaration, mut model) =
            analyse_in(language, quote!(domain(#(#domain),*), prestressed), self.item(), LARGEST)?;
        let stress = substitute_rest(&mut model.graph, model.plain.gradient[0]);
        if model.graph.is_zero(stress) {
            return Ok(());
        }
        let stress: TokenStream = printer::rust(&mut model.graph, &declaration, stress)
            .parse()
            .map_err(|_| syn::Error::new(Span::call_site(), "the stress at rest has no formula"))?;
        let body = &self.body;
        self.body = quote!(#body - (#stress) * J.ln());
        Ok(())
    }
}

/// The declaration in the usual style of Rust.
fn source(arguments: &TokenStream, item: &TokenStream) -> String {
    let function = match syn::parse2(item.clone()) {
        Ok(file) => prettyplease::unparse(&file),
        Err(_) => item.to_string(),
    };
    // The attribute stands between documentation and function.
    let (documentation, function) = function.split_once("pub fn ").unwrap_or(("", &function));
    let arguments = if arguments.is_empty() { String::new() } else { format!("({})", spaced(arguments)) };
    format!("use piola::material;\n\n{documentation}#[material{arguments}]\npub fn {function}")
}

/// Advice for a name of papers for which declarations have another notation.
fn advice(name: &str) -> Option<String> {
    let formula = Language::Formula { free_rest: None };
    read::resolve::advice(name).map(|advice| formula.message(advice))
}
