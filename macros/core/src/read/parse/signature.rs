//! The signature of an energy: its generics, stretches and parameters.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{
    Expr, FnArg, GenericArgument, GenericParam, Ident, Lit, Pat, PathArguments, ReturnType, Safety,
    Signature, Type,
};

use super::{Entries, Kind, Parameter, WORDS, documentation, identifiers};
use crate::read::diagnostics::Diagnostics;
use crate::read::notation::Notation;
use crate::read::spelling::taken;
use crate::read::unit::Unit;

/// Members of every material, which a method for a parameter of the same name would hide.
const MEMBERS: [&str; 33] = [
    // Of the type and of the traits of the language.
    "new",
    "with_inversion",
    "clone",
    // Of `Material`.
    "energy",
    "gradient",
    "gradient_at_strains",
    "blocks",
    "energy_and_blocks",
    "admits",
    "has_invariants",
    "has_second_invariant",
    "curvature_by_invariants",
    "has_energy_by_invariants",
    "energy_by_invariants",
    "gradient_by_invariants",
    "derivatives_by_invariants",
    "admits_invariants",
    "has_pole",
    "ends_at_zero_volume",
    "inversion",
    "stated_moduli",
    "RESPONDS_TOGETHER",
    "respond_together",
    // Of `Declared`.
    "DESCRIPTION",
    "from_values",
    "moduli",
    // Of `Fittable`.
    "values",
    "with_values",
    "gradient_by_parameters",
    "constraints",
    "domain_constraints",
    // Of `Graded`.
    "on_lanes",
    "shares_lanes",
];

/// Values that are patterns everywhere, so that no argument can have their name.
const PATTERNS: [&str; 4] = ["Some", "None", "Ok", "Err"];

/// The parameters of a signature, with the lengths of the lists among them.
#[derive(Default)]
pub(super) struct Lists {
    pub(super) parameters: Vec<Parameter>,
    pub(super) lengths: Vec<Entries>,
    pub(super) mistaken: Vec<Ident>,
}

/// Types and crates that a material of the same name would hide from its own expansion, and for which a
/// length of the same name would be taken.
const TYPES: [&str; 22] = [
    "bool", "char", "f16", "f32", "f64", "f128", "i8", "i16", "i32", "i64", "i128", "isize", "str", "u8",
    "u16", "u32", "u64", "u128", "usize", "core", "std", "__p",
];

/// Reports a name that the type cannot have.
pub(super) fn named(signature: &Signature, diagnostics: &mut Diagnostics) {
    let name = &signature.ident;
    if is_type(name) {
        diagnostics.error(name, meaning(name));
    }
}

/// True if a name is a type, or a keyword of Rust.
pub(crate) fn is_type(name: &Ident) -> bool {
    TYPES.iter().any(|ty| name == ty) || is_raw(name)
}

/// True if a name is a keyword of Rust, written as `r#type`.
fn is_raw(name: &Ident) -> bool {
    name.to_string().starts_with("r#")
}

/// Reports features that only executable functions can have.
pub(super) fn plain(signature: &Signature, diagnostics: &mut Diagnostics) {
    let safety = (!matches!(signature.safety, Safety::Default)).then_some(&signature.safety);
    let superfluous = [
        signature.constness.to_token_stream(),
        signature.asyncness.to_token_stream(),
        safety.to_token_stream(),
        signature.abi.to_token_stream(),
        signature.variadic.to_token_stream(),
        signature.generics.where_clause.to_token_stream(),
    ];
    for tokens in superfluous.into_iter().filter(|tokens| !tokens.is_empty()) {
        diagnostics.error(tokens, "an energy is a plain function: remove this");
    }
}

#[derive(Default)]
pub(super) struct Generics {
    /// Lengths of lists.
    pub(super) lengths: Vec<Ident>,
    /// Types, which a declaration cannot have: `f64` was meant.
    types: Vec<Ident>,
}

impl Generics {
    fn is_number(&self, ty: &Type) -> bool {
        is_f64(ty) || matches!(ty, Type::Path(path) if self.types.iter().any(|name| path.path.is_ident(name)))
    }
}

/// The lengths of lists, and all other generics.
pub(super) fn generics(signature: &Signature, diagnostics: &mut Diagnostics) -> Generics {
    let Generics { lengths: mut names, mut types } = Generics::default();
    for generic in &signature.generics.params {
        match generic {
            // The real type of generated functions is called R.
            GenericParam::Const(constant) if constant.ident == "R" || is_type(&constant.ident) => {
                diagnostics.error(&constant.ident, meaning(&constant.ident));
                names.push(constant.ident.clone());
            }
            // Those are variables in generated functions.
            GenericParam::Const(constant) if constant.ident.to_string().starts_with(char::is_lowercase) => {
                let message =
                    "the length of a list is a constant: begin its name with a capital, such as `N`";
                diagnostics.error(&constant.ident, message);
                names.push(constant.ident.clone());
            }
            GenericParam::Const(constant) if constant.ty.to_token_stream().to_string() == "usize" => {
                let name = &constant.ident;
                if names.contains(name) {
                    diagnostics.error(name, taken(name));
                    continue;
                }
                if !identifiers(signature.inputs.to_token_stream()).contains(name) {
                    let message = format!(
                        "`{name}` is not the length of a list: write a parameter `[f64; {name}]` or remove it"
                    );
                    diagnostics.error(name, message);
                }
                names.push(name.clone());
            }
            GenericParam::Type(function) if !function.bounds.is_empty() => diagnostics.error(
                generic,
                "a function has a type of its own: write `f: Curve` with `impl piola::Univariate for Curve`, and no type parameter",
            ),
            _ => {
                diagnostics.error(
                    generic,
                    "only lengths of lists can be generic: write `const N: usize` and a parameter `[f64; N]`",
                );
                if let GenericParam::Type(generic) = generic {
                    types.push(generic.ident.clone());
                }
            }
        }
    }
    Generics { lengths: names, types }
}

pub(super) fn stretches(
    signature: &Signature,
    generics: &Generics,
    diagnostics: &mut Diagnostics,
) -> Option<[Ident; 3]> {
    const MESSAGE: &str = "the first argument names the three stretches: `[l1, l2, l3]: [f64; 3]`";
    let Some(input) = signature.inputs.first() else {
        diagnostics.error(&signature.ident, MESSAGE);
        return None;
    };
    let names = match input {
        FnArg::Typed(argument) if is_three_numbers(&argument.ty, generics) => match &*argument.pat {
            Pat::Slice(slice) => slice.elems.iter().map(plain_name).collect::<Option<Vec<_>>>(),
            _ => None,
        },
        _ => None,
    };
    let Some(Ok(names)) = names.map(<[Ident; 3]>::try_from) else {
        diagnostics.error(input, MESSAGE);
        return None;
    };
    for (k, name) in names.iter().enumerate() {
        reserved(name, diagnostics);
        if generics.lengths.contains(name) || names[..k].contains(name) {
            diagnostics.error(name, taken(name));
        }
    }
    Some(names)
}

/// All arguments but the first.
pub(super) fn parameters(
    signature: &Signature,
    generics: &Generics,
    stretches: Option<&[Ident; 3]>,
    diagnostics: &mut Diagnostics,
) -> Lists {
    let mut lists = Lists::default();
    for input in signature.inputs.iter().skip(1) {
        lists.add(input, generics, stretches, diagnostics);
    }
    lists
}

/// Reports a result that is not an energy density.
pub(super) fn result(signature: &Signature, generics: &Generics, diagnostics: &mut Diagnostics) {
    match &signature.output {
        ReturnType::Type(_, ty) if generics.is_number(ty) => {}
        ReturnType::Type(_, ty) => diagnostics.error(ty, "an energy density is a number: write `-> f64`"),
        ReturnType::Default => {
            diagnostics
                .error(&signature.ident, "an energy density is a number: write `-> f64` before the body");
        }
    }
}

/// The message about a parameter of another form.
const PARAMETER: &str = "a parameter is a number `mu: f64`, a list `mu: [f64; N]` or `mu: Vec<f64>`, a whole exponent `n: u32` or a function `f: F`, with `F: piola::Univariate`";

impl Lists {
    fn add(
        &mut self,
        input: &FnArg,
        generics: &Generics,
        stretches: Option<&[Ident; 3]>,
        diagnostics: &mut Diagnostics,
    ) {
        let FnArg::Typed(argument) = input else {
            return diagnostics.error(input, PARAMETER);
        };
        let Some(name) = plain_name(&argument.pat) else {
            self.mistaken.extend(identifiers(argument.pat.to_token_stream()));
            return diagnostics.error(&argument.pat, PARAMETER);
        };
        // No code is generated at run time, in which a name could have another meaning.
        if diagnostics.notation() == Notation::Attribute || !is_raw(&name) {
            reserved(&name, diagnostics);
        }
        let is_taken = stretches.is_some_and(|stretches| stretches.contains(&name))
            || generics.lengths.contains(&name)
            || self.parameters.iter().any(|other| other.name == name);
        if is_taken {
            diagnostics.error(&name, taken(&name));
            return self.mistaken.push(name);
        }
        match self.kind(&name, &argument.ty, generics) {
            Ok(kind) => {
                let (doc, attributes) = (documentation(&argument.attrs), argument.attrs.clone());
                let is_whole = is_whole(&argument.ty);
                if let Err(unit) = Unit::read(&doc) {
                    let message = format!(
                        "values of parameters are in SI units, not in `{unit}`: write `Pa`, `1/Pa` or `dimensionless` there, and give \
                         the values in that unit"
                    );
                    diagnostics.error(quote!(#(#attributes)*), message);
                }
                self.parameters.push(Parameter { name, doc, attributes, kind, is_whole });
            }
            Err((tokens, message)) => {
                diagnostics.error(tokens, message);
                self.mistaken.push(name);
            }
        }
    }

    /// The kind of a parameter, or the mistaken tokens with the message about them.
    fn kind(
        &mut self,
        name: &Ident,
        ty: &Type,
        generics: &Generics,
    ) -> Result<Kind, (TokenStream, &'static str)> {
        const ENTRIES: &str = "the entries of a list are `f64`, or `u32` if they are exponents";
        const OWNED: &str =
            "a material owns its lists: write `Vec<f64>`, or `[f64; N]` with `const N: usize`";
        let mistake = |tokens: &dyn ToTokens, message: &'static str| Err((tokens.to_token_stream(), message));
        let is_number = |ty: &Type| generics.is_number(ty) || is_u32(ty);
        match ty {
            ty if is_number(ty) => Ok(Kind::Number),
            Type::Array(array) if !is_number(&array.elem) => mistake(&array.elem, ENTRIES),
            Type::Array(array) => {
                let is_known = match &array.len {
                    Expr::Lit(literal) => {
                        matches!(&literal.lit, Lit::Int(n) if n.base10_parse::<usize>().is_ok_and(|n| n > 0))
                    }
                    Expr::Path(path) => generics.lengths.iter().any(|generic| path.path.is_ident(generic)),
                    _ => false,
                };
                if is_known {
                    Ok(Kind::List(self.length(&array.len)))
                } else {
                    mistake(
                        &array.len,
                        "the length of a list is a number such as `3`, or `N` with `const N: usize`",
                    )
                }
            }
            Type::Slice(_) | Type::Reference(_) => mistake(ty, OWNED),
            ty if is_vector(ty) => match entry(ty) {
                Some(entry) if is_number(entry) => {
                    self.lengths.push(Entries::AtRunTime(name.clone()));
                    Ok(Kind::List(self.lengths.len() - 1))
                }
                Some(entry) => mistake(entry, ENTRIES),
                None => mistake(ty, ENTRIES),
            },
            ty if may_be_function(ty) => Ok(Kind::Function(Box::new(ty.clone()))),
            ty => mistake(ty, PARAMETER),
        }
    }

    /// Equal lengths are one.
    fn length(&mut self, length: &Expr) -> usize {
        let text = length.to_token_stream().to_string();
        let is_equal = |other: &Entries| matches!(other, Entries::Known(other) if other.to_token_stream().to_string() == text);
        self.lengths.iter().position(is_equal).unwrap_or_else(|| {
            self.lengths.push(Entries::Known(length.clone()));
            self.lengths.len() - 1
        })
    }
}

/// True if a parameter's type may be a function: any path but Rust's primitive types and likely typos of
/// `f64`.
pub(crate) fn may_be_function(ty: &Type) -> bool {
    let Type::Path(path) = ty else { return false };
    path.path.get_ident().is_none_or(|name| {
        let name = name.to_string();
        let is_float = name
            .strip_prefix(['f', 'F'])
            .is_some_and(|digits| digits.bytes().all(|digit| digit.is_ascii_digit()));
        !is_float && name != "String" && !TYPES.contains(&name.as_str())
    })
}

/// True if it is the type of a list whose length is known at run time.
pub(crate) fn is_vector(ty: &Type) -> bool {
    matches!(ty, Type::Path(path) if path.path.segments.last().is_some_and(|last| last.ident == "Vec"))
}

/// The type of the entries of a vector.
pub(crate) fn entry(ty: &Type) -> Option<&Type> {
    let Type::Path(path) = ty else { return None };
    let PathArguments::AngleBracketed(arguments) = &path.path.segments.last()?.arguments else { return None };
    match arguments.args.first() {
        Some(GenericArgument::Type(entry)) if arguments.args.len() == 1 => Some(entry),
        _ => None,
    }
}

/// True if it is the type of a whole exponent.
pub(crate) fn is_u32(ty: &Type) -> bool {
    matches!(ty, Type::Path(path) if path.path.is_ident("u32"))
}

/// True if it is the type of a whole exponent or of a list of whole exponents.
fn is_whole(ty: &Type) -> bool {
    match ty {
        Type::Array(array) => is_u32(&array.elem),
        ty if is_vector(ty) => entry(ty).is_some_and(is_u32),
        ty => is_u32(ty),
    }
}

/// True if it is the type of a number.
pub(crate) fn is_f64(ty: &Type) -> bool {
    matches!(ty, Type::Path(path) if path.path.is_ident("f64"))
}

fn is_three_numbers(ty: &Type, generics: &Generics) -> bool {
    matches!(ty, Type::Array(array)
        if generics.is_number(&array.elem) && array.len.to_token_stream().to_string() == "3")
}

fn plain_name(pattern: &Pat) -> Option<Ident> {
    match pattern {
        Pat::Ident(name) if name.by_ref.is_none() && name.mutability.is_none() && name.subpat.is_none() => {
            Some(name.ident.clone())
        }
        _ => None,
    }
}

fn reserved(name: &Ident, diagnostics: &mut Diagnostics) {
    if is_reserved(name) {
        diagnostics.error(name, meaning(name));
    }
}

fn meaning(name: &Ident) -> String {
    format!("`{name}` is reserved: choose another name")
}

/// True if a name is reserved: a word of energies, a member of materials, or a pattern or keyword of Rust.
#[must_use]
pub fn is_reserved(name: &Ident) -> bool {
    let text = name.to_string();
    let text = text.as_str();
    WORDS.contains(&text)
        || MEMBERS.contains(&text)
        || PATTERNS.contains(&text)
        || text == "sum"
        || is_raw(name)
}
