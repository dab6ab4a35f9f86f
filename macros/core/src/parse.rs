//! From tokens to a [`Declaration`]: the form of the item, not yet the meaning of its body.
//!
//! A declaration is an ordinary Rust function from stretches and parameters to the energy density, so rustfmt and
//! editors treat it as one:
//!
//! ```text
//! #[material(domain(J > 0.0), admissible(mu > 0.0), extend)]
//! pub fn NeoHookean([l1, l2, l3]: [f64; 3], /// Shear modulus, Pa.
//!                   mu: f64) -> f64 { … }
//! ```

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Attribute, Expr, FnArg, GenericParam, Ident, ItemFn, Pat, Token, Type, Visibility};

use crate::diagnostics::Diagnostics;
use crate::expr::Length;

/// An energy as declared.
#[derive(Debug)]
pub struct Declaration {
    /// Documentation and other attributes of the item.
    pub attributes: Vec<Attribute>,
    /// Visibility of the type.
    pub visibility: Visibility,
    /// Name of the type.
    pub name: Ident,
    /// Names of the constant generics, each the length of lists.
    pub generics: Vec<Ident>,
    /// Names of the three stretches.
    pub stretches: [Ident; 3],
    /// In the order of the declaration.
    pub parameters: Vec<Parameter>,
    /// Lengths of lists: an integer literal or a constant generic.
    pub lengths: Vec<Expr>,
    /// The energy.
    pub body: syn::Block,
    /// What the attribute says.
    pub options: Options,
}

/// A parameter of the energy.
#[derive(Debug)]
pub struct Parameter {
    /// Its name.
    pub name: Ident,
    /// Its documentation.
    pub doc: String,
    /// The documentation as written.
    pub attributes: Vec<Attribute>,
    /// What it is.
    pub kind: Kind,
}

/// What a parameter is.
#[derive(Debug)]
pub enum Kind {
    /// A number.
    Number,
    /// A list of numbers.
    List(Length),
    /// A function of one variable, of a type that implements `piola::Univariate`.
    Function(Box<Type>),
}

impl Parameter {
    /// The length of a list.
    #[must_use]
    pub fn length(&self) -> Option<Length> {
        match self.kind {
            Kind::List(length) => Some(length),
            Kind::Number | Kind::Function(_) => None,
        }
    }

    /// Whether it is a function.
    #[must_use]
    pub fn is_function(&self) -> bool {
        matches!(self.kind, Kind::Function(_))
    }
}

impl Declaration {
    /// The Rust type of a parameter.
    #[must_use]
    pub fn parameter_type(&self, parameter: &Parameter) -> Type {
        match &parameter.kind {
            Kind::Number => syn::parse_quote!(f64),
            Kind::List(length) => {
                let length = &self.lengths[*length];
                syn::parse_quote!([f64; #length])
            }
            Kind::Function(ty) => (**ty).clone(),
        }
    }

    /// Whether some parameter is a function, of which nothing is known before it is given.
    #[must_use]
    pub fn has_functions(&self) -> bool {
        self.parameters.iter().any(Parameter::is_function)
    }
}

/// The arguments of the attribute.
#[derive(Debug, Default)]
pub struct Options {
    /// Comparisons in stretches, invariants and parameters that bound the domain.
    pub domain: Vec<Expr>,
    /// Comparisons in parameters that the constructor checks.
    pub admissible: Vec<Expr>,
    /// Comparisons in parameters under which the extension restores; `None` without an extension.
    pub extend: Option<Vec<Expr>>,
    /// Why there is no extension.
    pub refuse: Option<syn::LitStr>,
    /// The rest state is meant to carry stress.
    pub prestressed: bool,
}

/// Words with a meaning in every energy.
pub const WORDS: [&str; 5] = ["J", "I1", "I2", "I1b", "I2b"];

/// Methods and fields of every material, which a parameter's own method would hide.
const METHODS: [&str; 12] = [
    "new",
    "inversion",
    "with_inversion",
    "energy",
    "gradient",
    "gradient_at_strains",
    "blocks",
    "admits",
    "has_pole",
    "ends_at_zero_volume",
    "from_values",
    "moduli",
];

/// Reads the attribute's arguments and its item.
///
/// # Errors
/// All mistakes of form, each at its token.
pub fn parse(arguments: TokenStream, item: TokenStream) -> syn::Result<Declaration> {
    let function: ItemFn = syn::parse2(item).map_err(|error| {
        let message =
            format!("{error}; `#[material]` stands on a function from stretches to the energy density");
        syn::Error::new(error.span(), message)
    })?;
    let mut diagnostics = Diagnostics::default();
    let options = diagnostics.take(syn::parse2::<Options>(arguments)).unwrap_or_default();
    let signature = &function.sig;
    for token in [
        signature.asyncness.as_ref().map(Spanned::span),
        (!matches!(signature.safety, syn::Safety::Default)).then(|| signature.safety.span()),
        signature.abi.as_ref().map(Spanned::span),
        signature.generics.where_clause.as_ref().map(Spanned::span),
    ]
    .into_iter()
    .flatten()
    {
        diagnostics.error(token, "an energy is a plain function: remove this");
    }
    let generics = generics(signature, &mut diagnostics);
    if !returns_f64(signature) {
        diagnostics.error(signature.output.span(), "an energy density is a number: write `-> f64`");
    }
    let mut inputs = signature.inputs.iter();
    let stretches = match inputs.next() {
        Some(input) => stretches(input, &mut diagnostics),
        None => {
            diagnostics
                .error(signature.paren_token.span.join(), "the first argument is `[l1, l2, l3]: [f64; 3]`");
            None
        }
    };
    let mut lengths = Vec::new();
    let mut parameters: Vec<Parameter> = Vec::new();
    for input in inputs {
        let Some(parameter) = parameter(input, &generics, &mut lengths, &mut diagnostics) else { continue };
        let is_stretch = stretches.as_ref().is_some_and(|names| names.contains(&parameter.name));
        if is_stretch
            || generics.contains(&parameter.name)
            || parameters.iter().any(|other| other.name == parameter.name)
        {
            diagnostics
                .error(parameter.name.span(), format!("the name `{}` is taken already", parameter.name));
        } else {
            parameters.push(parameter);
        }
    }
    let declaration = stretches.map(|stretches| Declaration {
        attributes: function.attrs,
        visibility: function.vis,
        name: function.sig.ident,
        generics,
        stretches,
        parameters,
        lengths,
        body: *function.block,
        options,
    });
    diagnostics.finish(declaration)
}

fn generics(signature: &syn::Signature, diagnostics: &mut Diagnostics) -> Vec<Ident> {
    let mut names = Vec::new();
    for generic in &signature.generics.params {
        match generic {
            // The real type of generated functions is called R.
            GenericParam::Const(constant) if constant.ident == "R" => {
                diagnostics.error(constant.ident.span(), "`R` has a meaning of its own: choose another name");
            }
            GenericParam::Const(constant) if constant.ty.to_token_stream().to_string() == "usize" => {
                names.push(constant.ident.clone());
            }
            _ => diagnostics.error(
                generic.span(),
                "only lengths of lists can be generic: write `const N: usize` and a parameter `[f64; N]`",
            ),
        }
    }
    names
}

fn returns_f64(signature: &syn::Signature) -> bool {
    matches!(&signature.output, syn::ReturnType::Type(_, ty) if is_f64(ty))
}

fn is_f64(ty: &Type) -> bool {
    matches!(ty, Type::Path(path) if path.path.is_ident("f64"))
}

fn stretches(input: &FnArg, diagnostics: &mut Diagnostics) -> Option<[Ident; 3]> {
    const MESSAGE: &str = "the first argument names the stretches: `[l1, l2, l3]: [f64; 3]`";
    let names = match input {
        FnArg::Typed(argument) => match &*argument.pat {
            Pat::Slice(slice) => slice.elems.iter().map(plain_name).collect::<Option<Vec<_>>>(),
            _ => None,
        },
        FnArg::Receiver(_) => None,
    };
    let Some(Ok(names)) = names.map(<[Ident; 3]>::try_from) else {
        diagnostics.error(input.span(), MESSAGE);
        return None;
    };
    for (k, name) in names.iter().enumerate() {
        reserved(name, diagnostics);
        if names[..k].contains(name) {
            diagnostics.error(name.span(), format!("the name `{name}` is taken already"));
        }
    }
    Some(names)
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
    let text = name.to_string();
    if WORDS.contains(&text.as_str()) || METHODS.contains(&text.as_str()) || text == "sum" {
        diagnostics.error(name.span(), format!("`{text}` has a meaning of its own: choose another name"));
    }
}

fn parameter(
    input: &FnArg,
    generics: &[Ident],
    lengths: &mut Vec<Expr>,
    diagnostics: &mut Diagnostics,
) -> Option<Parameter> {
    const MESSAGE: &str =
        "a parameter is a number `mu: f64`, a list `mu: [f64; N]` or a function `f: piola::Spline`";
    let FnArg::Typed(argument) = input else {
        diagnostics.error(input.span(), MESSAGE);
        return None;
    };
    let Some(name) = plain_name(&argument.pat) else {
        diagnostics.error(argument.pat.span(), MESSAGE);
        return None;
    };
    reserved(&name, diagnostics);
    let kind = match &*argument.ty {
        ty if is_f64(ty) => Kind::Number,
        Type::Array(array) if is_f64(&array.elem) => {
            let known = match &array.len {
                Expr::Lit(_) => true,
                Expr::Path(path) => generics.iter().any(|generic| path.path.is_ident(generic)),
                _ => false,
            };
            if !known {
                diagnostics.error(
                    array.len.span(),
                    "the length of a list is a literal or a `const N: usize` generic",
                );
            }
            let text = array.len.to_token_stream().to_string();
            let position = lengths.iter().position(|length| length.to_token_stream().to_string() == text);
            Kind::List(position.unwrap_or_else(|| {
                lengths.push(array.len.clone());
                lengths.len() - 1
            }))
        }
        ty if may_be_function(ty) => Kind::Function(Box::new(ty.clone())),
        ty => {
            diagnostics.error(ty.span(), MESSAGE);
            return None;
        }
    };
    Some(Parameter { name, doc: documentation(&argument.attrs), attributes: argument.attrs.clone(), kind })
}

/// Any named type but those of the language that are no numbers of an energy.
fn may_be_function(ty: &Type) -> bool {
    const NEVER: [&str; 17] = [
        "f32", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16", "i32", "i64", "i128", "isize",
        "bool", "char", "str", "String",
    ];
    matches!(ty, Type::Path(path) if !NEVER.iter().any(|name| path.path.is_ident(name)))
}

/// The text of documentation comments, lines joined by spaces, paragraphs by newlines.
#[must_use]
pub fn documentation(attributes: &[Attribute]) -> String {
    let mut text = String::new();
    for attribute in attributes {
        if let syn::Meta::NameValue(doc) = &attribute.meta
            && doc.path.is_ident("doc")
            && let Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(line), .. }) = &doc.value
        {
            let line = line.value();
            match line.trim() {
                "" => text.push('\n'),
                line => {
                    if !text.is_empty() && !text.ends_with('\n') {
                        text.push(' ');
                    }
                    text.push_str(line);
                }
            }
        }
    }
    text
}

impl Parse for Options {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut options = Self::default();
        let mut seen: Vec<Ident> = Vec::new();
        while !input.is_empty() {
            let name: Ident = input.parse()?;
            if seen.contains(&name) {
                return Err(syn::Error::new(
                    name.span(),
                    format!("`{name}` is given twice: put all into one list"),
                ));
            }
            match name.to_string().as_str() {
                "domain" => options.domain = comparisons(input)?,
                "admissible" => options.admissible = comparisons(input)?,
                "extend" if input.peek(syn::token::Paren) => options.extend = Some(comparisons(input)?),
                "extend" => options.extend = Some(Vec::new()),
                "refuse" => {
                    let content;
                    syn::parenthesized!(content in input);
                    options.refuse = Some(content.parse().map_err(|error: syn::Error| {
                        let message = "say in a string why the energy has no extension: `refuse(\"…\")`";
                        syn::Error::new(error.span(), message)
                    })?);
                }
                "prestressed" => options.prestressed = true,
                other => {
                    return Err(syn::Error::new(
                        name.span(),
                        format!(
                            "unknown argument `{other}`: there are `domain(J > 0.0)`, `admissible(mu > 0.0)`, `extend`, \
                             `refuse(\"why not extend\")` and `prestressed`"
                        ),
                    ));
                }
            }
            if options.extend.is_some() && options.refuse.is_some() {
                return Err(syn::Error::new(
                    name.span(),
                    "an energy has either `extend` or `refuse`: remove one",
                ));
            }
            seen.push(name);
            if !input.is_empty() {
                input.parse::<Token![,]>()?;
            }
        }
        Ok(options)
    }
}

fn comparisons(input: ParseStream<'_>) -> syn::Result<Vec<Expr>> {
    let content;
    syn::parenthesized!(content in input);
    let list = Punctuated::<Expr, Token![,]>::parse_terminated(&content)?;
    for expression in &list {
        let is_comparison = matches!(
            expression,
            Expr::Binary(binary) if matches!(binary.op,
                syn::BinOp::Lt(_) | syn::BinOp::Gt(_) | syn::BinOp::Le(_) | syn::BinOp::Ge(_) | syn::BinOp::Ne(_))
        );
        if !is_comparison {
            return Err(syn::Error::new(expression.span(), "a condition is a comparison such as `mu > 0.0`"));
        }
    }
    Ok(list.into_iter().collect())
}
