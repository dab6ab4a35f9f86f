//! The arguments of the attribute.

use proc_macro2::TokenStream;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::{BinOp, Expr, Ident, LitStr, Meta, Token};

use crate::read::diagnostics::Diagnostics;
use crate::read::spelling::{list, nearest};

use super::nesting::{DEEPEST, check};
use super::typical::Typical;

/// The arguments of the attribute.
#[derive(Default)]
pub struct Options {
    /// Comparisons in stretches, invariants and parameters that bound the domain.
    pub domain: Vec<Expr>,
    /// Comparisons in parameters that the constructor checks.
    pub admissible: Vec<Expr>,
    /// Comparisons in parameters under which the extension restores; `None` without an extension.
    pub extend: Option<Vec<Expr>>,
    /// Reason why there is no extension.
    pub refuse: Option<LitStr>,
    /// Parameters of some real material.
    pub typical: Option<Typical>,
    /// The rest state may carry stress or lack stiffness.
    pub prestressed: bool,
    /// The material is written and read by serde.
    pub serde: bool,
    /// The names of the arguments as written.
    pub words: Vec<Ident>,
}

/// Each argument as it is written, its name first.
const FORMS: [&str; 7] = [
    "domain(J > 0.0)",
    "admissible(mu > 0.0)",
    "extend",
    "refuse(\"why it does not extend\")",
    "typical(\"natural rubber\", mu = 4e5)",
    "prestressed",
    "serde",
];

impl Options {
    /// Reason why there is no extension, if one is stated or evident.
    #[must_use]
    pub fn refusal(&self) -> Option<String> {
        let needless = || "it is defined for every deformation gradient already".to_owned();
        self.refuse.as_ref().map(LitStr::value).or_else(|| self.domain.is_empty().then(needless))
    }

    /// Reads all valid arguments and reports the rest.
    pub(super) fn read(arguments: TokenStream, diagnostics: &mut Diagnostics) -> Self {
        let mut options = Self::default();
        if diagnostics.take(check(DEEPEST, &arguments, diagnostics.notation())).is_none() {
            return options;
        }
        let arguments = Punctuated::<Meta, Token![,]>::parse_terminated.parse2(arguments).map_err(|error| {
            syn::Error::new(error.span(), format!("{error}; the arguments are {}", list(&FORMS)))
        });
        for argument in diagnostics.take(arguments).into_iter().flatten() {
            options.add(&argument, diagnostics);
        }
        options
    }

    fn add(&mut self, argument: &Meta, diagnostics: &mut Diagnostics) {
        let Some(name) = argument.path().get_ident() else {
            return diagnostics.error(argument.path(), "an argument is one word");
        };
        if self.words.contains(name) {
            return diagnostics.error(name, format!("`{name}` is given twice: remove one"));
        }
        match (name.to_string().as_str(), argument) {
            ("domain", Meta::List(list)) => self.domain = comparisons(&list.tokens, diagnostics),
            ("admissible", Meta::List(list)) => self.admissible = comparisons(&list.tokens, diagnostics),
            ("extend", Meta::List(list)) => self.extend = Some(comparisons(&list.tokens, diagnostics)),
            ("extend", Meta::Path(_)) => self.extend = Some(Vec::new()),
            ("refuse", Meta::List(list)) => self.refuse = reason(&list.tokens, diagnostics),
            ("typical", Meta::List(list)) => self.typical = Typical::read(name, &list.tokens, diagnostics),
            ("prestressed", Meta::Path(_)) => self.prestressed = true,
            ("serde", Meta::Path(_)) => self.serde = true,
            (text, _) => {
                return diagnostics.error(name, unknown(text));
            }
        }
        self.words.push(name.clone());
        if self.extend.is_some() && self.refuse.is_some() {
            diagnostics.error(name, "an energy has either `extend` or `refuse`: remove one");
        }
    }
}

/// The message about an unknown argument, or one that is written in another form.
fn unknown(name: &str) -> String {
    let word = |form: &'static str| form.split('(').next().unwrap_or(form);
    let form = |name: &str| FORMS.into_iter().find(|&form| word(form) == name);
    match (form(name), nearest(name, FORMS.map(word)).and_then(form)) {
        (Some(form), _) => format!("`{name}` is written `{form}`"),
        (None, Some(form)) => format!("unknown argument `{name}`: did you mean `{form}`?"),
        (None, None) => format!("unknown argument `{name}`: there are {}", list(&FORMS)),
    }
}

fn reason(tokens: &TokenStream, diagnostics: &mut Diagnostics) -> Option<LitStr> {
    let reason = syn::parse2(tokens.clone()).map_err(|error| {
        let message = "give as a string the reason why the energy has no extension: `refuse(\"…\")`";
        syn::Error::new(error.span(), message)
    });
    diagnostics.take(reason)
}

fn comparisons(tokens: &TokenStream, diagnostics: &mut Diagnostics) -> Vec<Expr> {
    const MESSAGE: &str = "a condition is a comparison such as `mu > 0.0`";
    let list = Punctuated::<Expr, Token![,]>::parse_terminated
        .parse2(tokens.clone())
        .map_err(|error| syn::Error::new(error.span(), format!("{error}; {MESSAGE}")));
    let mut conditions = Vec::new();
    for expression in diagnostics.take(list).into_iter().flatten() {
        match &expression {
            Expr::Binary(binary) => match binary.op {
                BinOp::Lt(_) | BinOp::Gt(_) | BinOp::Le(_) | BinOp::Ge(_) | BinOp::Ne(_) => {
                    conditions.push(expression);
                }
                BinOp::And(and) => {
                    diagnostics.error(and, "conditions that must all hold are separated by commas");
                }
                _ => diagnostics.error(&expression, MESSAGE),
            },
            _ => diagnostics.error(&expression, MESSAGE),
        }
    }
    conditions
}
