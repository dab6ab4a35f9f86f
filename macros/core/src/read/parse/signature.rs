//! The signature of an energy: its generics, stretches and parameters.

use std::fmt::Display;

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
const MEMBERS: [&str; 27] = [
    // Of the type and of the traits of the language.
    "new",
    "with_inversion",
    "clone",
    // Of `Material`.
    "energy",
    "gradient",
    "gradient_at_strains",
    "blocks",
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
    // Of `Graded`.
    "on_lanes",
    "shares_lanes",
];

/// Values that are patterns everywhere, so that no argument can have their name.
const PATTERNS: [&str; 4] = ["Some", "None", "Ok", "Err"];

/// Types and crates that a material of the same name would hide from its own expansion, and for which a
/// length of the same name would be taken.
const TYPES: [&str; 22] = [
    "bool", "char", "f16", "f32", "f64", "f128", "i8", "i16", "i32", "i64", "i128", "isize", "str", "u8",
    "u16", "u32", "u64", "u128", "usize", "core", "std", "__p",
];

/// True if a name is a type, or a keyword of Rust.
pub(crate) fn is_type(name: &Ident) -> bool {
    TYPES.iter().any(|ty| name == ty) || is_raw(name)
}

/// True if a name is a keyword of Rust, written as `r#type`.
fn is_raw(name: &Ident) -> bool {
    name.to_string().starts_with("r#")
}

/// The message about a parameter of another form.
const PARAMETER: &str = "a parameter is a number `mu: f64`, a list `mu: [f64; N]` or `mu: Vec<f64>`, a whole exponent `n: u32` or a function `f: F`, with `F: piola::Univariate`";

/// The message about the type of a function in a declaration that is read at run time.
const NO_SPLINE: &str = "a function that is found at run time is a `Spline`: another type needs the declaration to be compiled, by \
     `#[piola::material]`";

/// A signature as far as it has been read.
pub(super) struct Reader<'a> {
    signature: &'a Signature,
    diagnostics: &'a mut Diagnostics,
    /// Constant generics.
    pub(super) generics: Vec<Ident>,
    /// Generic types, which a declaration cannot have: `f64` was meant.
    types: Vec<Ident>,
    pub(super) stretches: Option<[Ident; 3]>,
    pub(super) parameters: Vec<Parameter>,
    pub(super) lengths: Vec<Entries>,
    pub(super) mistaken: Vec<Ident>,
}

impl<'a> Reader<'a> {
    pub(super) fn read(signature: &'a Signature, diagnostics: &'a mut Diagnostics) -> Self {
        let (generics, types, stretches) = (Vec::new(), Vec::new(), None);
        let (parameters, lengths, mistaken) = (Vec::new(), Vec::new(), Vec::new());
        let mut reader =
            Self { signature, diagnostics, generics, types, stretches, parameters, lengths, mistaken };
        let name = &signature.ident;
        if is_type(name) {
            reader.error(name, meaning(name));
        }
        reader.check_is_plain();
        signature.generics.params.iter().for_each(|generic| reader.generic(generic));
        reader.stretches = reader.stretches();
        signature.inputs.iter().skip(1).for_each(|input| reader.parameter(input));
        match &signature.output {
            ReturnType::Type(_, ty) if reader.is_number(ty) => {}
            ReturnType::Type(_, ty) => reader.error(ty, "an energy density is a number: write `-> f64`"),
            ReturnType::Default => {
                reader.error(name, "an energy density is a number: write `-> f64` before the body");
            }
        }
        reader
    }

    fn error(&mut self, tokens: impl ToTokens, message: impl Display) {
        self.diagnostics.error(tokens, message);
    }

    /// Reports features that only executable functions can have.
    fn check_is_plain(&mut self) {
        let Signature { constness, asyncness, safety, abi, variadic, generics, .. } = self.signature;
        let safety = (!matches!(safety, Safety::Default)).then_some(safety);
        let superfluous = [
            constness.to_token_stream(),
            asyncness.to_token_stream(),
            safety.to_token_stream(),
            abi.to_token_stream(),
            variadic.to_token_stream(),
            generics.where_clause.to_token_stream(),
        ];
        for tokens in superfluous.into_iter().filter(|tokens| !tokens.is_empty()) {
            self.error(tokens, "an energy is a plain function: remove this");
        }
    }

    /// The length of lists, or another generic.
    fn generic(&mut self, generic: &GenericParam) {
        match generic {
            // The real type of generated functions is called R.
            GenericParam::Const(constant) if constant.ident == "R" || is_type(&constant.ident) => {
                self.error(&constant.ident, meaning(&constant.ident));
                self.generics.push(constant.ident.clone());
            }
            // Those are variables in generated functions.
            GenericParam::Const(constant) if constant.ident.to_string().starts_with(char::is_lowercase) => {
                self.error(
                    &constant.ident,
                    "the length of a list is a constant: begin its name with a capital, such as `N`",
                );
                self.generics.push(constant.ident.clone());
            }
            GenericParam::Const(constant) if constant.ty.to_token_stream().to_string() == "usize" => {
                let name = &constant.ident;
                if self.generics.contains(name) {
                    return self.error(name, taken(name));
                }
                if !identifiers(self.signature.inputs.to_token_stream()).contains(name) {
                    self.error(
                        name,
                        format!("`{name}` is not the length of a list: write a parameter `[f64; {name}]` or remove it"),
                    );
                }
                self.generics.push(name.clone());
            }
            GenericParam::Type(function) if !function.bounds.is_empty() => self.error(
                generic,
                "a function has a type of its own: write `f: Curve` with `impl piola::Univariate for Curve`, and no type parameter",
            ),
            _ => {
                self.error(
                    generic,
                    "only lengths of lists can be generic: write `const N: usize` and a parameter `[f64; N]`",
                );
                if let GenericParam::Type(generic) = generic {
                    self.types.push(generic.ident.clone());
                }
            }
        }
    }

    fn stretches(&mut self) -> Option<[Ident; 3]> {
        const MESSAGE: &str = "the first argument names the three stretches: `[l1, l2, l3]: [f64; 3]`";
        let Some(input) = self.signature.inputs.first() else {
            self.error(&self.signature.ident, MESSAGE);
            return None;
        };
        let is_three = |ty: &Type| {
            matches!(ty, Type::Array(array)
                if self.is_number(&array.elem) && array.len.to_token_stream().to_string() == "3")
        };
        let names = match input {
            FnArg::Typed(argument) if is_three(&argument.ty) => match &*argument.pat {
                Pat::Slice(slice) => slice.elems.iter().map(plain_name).collect::<Option<Vec<_>>>(),
                _ => None,
            },
            _ => None,
        };
        let Some(Ok(names)) = names.map(<[Ident; 3]>::try_from) else {
            self.error(input, MESSAGE);
            return None;
        };
        for (k, name) in names.iter().enumerate() {
            self.check_is_free(name);
            if self.generics.contains(name) || names[..k].contains(name) {
                self.error(name, taken(name));
            }
        }
        Some(names)
    }

    fn parameter(&mut self, input: &FnArg) {
        let FnArg::Typed(argument) = input else {
            return self.error(input, PARAMETER);
        };
        let Some(name) = plain_name(&argument.pat) else {
            self.mistaken.extend(identifiers(argument.pat.to_token_stream()));
            return self.error(&argument.pat, PARAMETER);
        };
        // No code is generated at run time, in which a name could have another meaning.
        if self.diagnostics.notation() == Notation::Attribute || !is_raw(&name) {
            self.check_is_free(&name);
        }
        let is_taken = self.stretches.iter().flatten().chain(&self.generics).any(|other| *other == name)
            || self.parameters.iter().any(|other| other.name == name);
        if is_taken {
            self.error(&name, taken(&name));
            return self.mistaken.push(name);
        }
        match self.kind(&name, &argument.ty) {
            Ok(kind) => {
                let (doc, attributes) = (documentation(&argument.attrs), argument.attrs.clone());
                let is_whole = is_whole(&argument.ty);
                if let Err(unit) = Unit::read(&doc) {
                    let message = format!(
                        "values of parameters are in SI units, not in `{unit}`: write `Pa`, `1/Pa` or `dimensionless` there, and give \
                         the values in that unit"
                    );
                    self.error(quote!(#(#attributes)*), message);
                }
                self.parameters.push(Parameter { name, doc, attributes, kind, is_whole });
            }
            Err((tokens, message)) => {
                self.error(tokens, message);
                self.mistaken.push(name);
            }
        }
    }

    /// The kind of a parameter, or the mistaken tokens with the message about them.
    fn kind(&mut self, name: &Ident, ty: &Type) -> Result<Kind, (TokenStream, &'static str)> {
        const ENTRIES: &str = "the entries of a list are `f64`, or `u32` if they are exponents";
        const OWNED: &str =
            "a material owns its lists: write `Vec<f64>`, or `[f64; N]` with `const N: usize`";
        let mistake = |tokens: &dyn ToTokens, message: &'static str| Err((tokens.to_token_stream(), message));
        let is_number = |ty: &Type| self.is_number(ty) || is_u32(ty);
        match ty {
            ty if is_number(ty) => Ok(Kind::Number),
            Type::Array(array) if !is_number(&array.elem) => mistake(&array.elem, ENTRIES),
            Type::Array(array) => {
                let is_known = match &array.len {
                    Expr::Lit(literal) => {
                        matches!(&literal.lit, Lit::Int(n) if n.base10_parse::<usize>().is_ok_and(|n| n > 0))
                    }
                    Expr::Path(path) => self.generics.iter().any(|generic| path.path.is_ident(generic)),
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
            Type::Path(path) if may_be_function(ty) => {
                let is_spline = path.path.segments.last().is_some_and(|last| last.ident == "Spline");
                match self.diagnostics.notation() {
                    Notation::Rust if !is_spline => mistake(ty, NO_SPLINE),
                    _ => Ok(Kind::Function(Box::new(ty.clone()))),
                }
            }
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

    fn is_number(&self, ty: &Type) -> bool {
        is_f64(ty) || matches!(ty, Type::Path(path) if self.types.iter().any(|name| path.path.is_ident(name)))
    }

    /// Reports a reserved name.
    fn check_is_free(&mut self, name: &Ident) {
        if is_reserved(name) {
            self.error(name, meaning(name));
        }
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

fn plain_name(pattern: &Pat) -> Option<Ident> {
    match pattern {
        Pat::Ident(name) if name.by_ref.is_none() && name.mutability.is_none() && name.subpat.is_none() => {
            Some(name.ident.clone())
        }
        _ => None,
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
