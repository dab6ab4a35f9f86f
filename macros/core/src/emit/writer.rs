//! Programs as Rust statements.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::Ident;

use crate::read::parse::Declaration;
use crate::schedule::{Op, Program, Statement, Value};

/// Writes programs with the names of one declaration.
#[derive(Clone)]
pub(super) struct Writer<'a> {
    declaration: &'a Declaration,
    /// Names of the three stretches of the graph.
    variables: [Ident; 3],
    /// Before the number of a value; such that no declared name looks like a value.
    prefix: &'static str,
    /// The index of sums.
    pub(super) index: Ident,
    /// The threshold of the extension.
    pub(super) threshold: Ident,
    /// The principal strains.
    pub(super) strains: Ident,
}

impl<'a> Writer<'a> {
    /// Reads the parameters of `self`.
    pub(super) fn new(declaration: &'a Declaration) -> Self {
        let is_number = |name: &str, prefix: &str| {
            name.strip_prefix(prefix)
                .is_some_and(|rest| rest.is_empty() || rest.bytes().all(|b| b.is_ascii_digit()))
        };
        let declared: Vec<String> = declaration
            .stretches
            .iter()
            .chain(declaration.parameters.iter().map(|parameter| &parameter.name))
            .map(Ident::to_string)
            .collect();
        let prefix = ["t", "u", "w", "value_"]
            .into_iter()
            .find(|prefix| !declared.iter().any(|name| is_number(name, prefix)))
            .unwrap_or("emitted_value_");
        let free = |candidates: &[&str]| free_name(declaration, candidates);
        let (index, threshold) = (free(&["p", "k", "entry"]), free(&["epsilon", "threshold"]));
        let strains = free(&["strains", "principal_strains"]);
        let variables = declaration.stretches.clone();
        Self { declaration, variables, prefix, index, threshold, strains }
    }

    /// A writer for programs in which stretches stand for other variables.
    pub(super) fn with_variables(&self, variables: [Ident; 3]) -> Self {
        Self { variables, ..self.clone() }
    }

    /// A field as a number of type `R`.
    fn field(&self, field: TokenStream) -> TokenStream {
        if self.declaration.has_functions() {
            quote!(R::splat(self.#field))
        } else {
            quote!(__piola::ParameterValue::on(&self.#field))
        }
    }

    /// The statements of a program and its outputs as expressions.
    pub(super) fn program(&self, program: &Program) -> (TokenStream, Vec<TokenStream>) {
        let mut names = Names::default();
        let mut statements = TokenStream::new();
        for statement in &program.statements {
            match statement {
                Statement::Let(value, op) => statements.extend(self.binding(*value, op, &mut names)),
                Statement::Loop { length, body, totals } => {
                    let length = &self.declaration.lengths[*length];
                    let index = &self.index;
                    let body: Vec<_> =
                        body.iter().filter_map(|(value, op)| self.binding(*value, op, &mut names)).collect();
                    let (mut starts, mut additions) = (Vec::new(), Vec::new());
                    for &(total, term) in totals {
                        let name = self.name(total);
                        let term = names.get(term);
                        starts.push(quote!(let mut #name = R::splat(0.0);));
                        additions.push(quote!(#name = #name + #term;));
                        names.set(total, quote!(#name));
                    }
                    statements.extend(quote! {
                        #(#starts)*
                        for #index in 0..#length {
                            #(#body)*
                            #(#additions)*
                        }
                    });
                }
            }
        }
        let outputs = program.outputs.iter().map(|&output| names.get(output).to_token_stream()).collect();
        (statements, outputs)
    }

    fn name(&self, value: Value) -> Ident {
        format_ident!("{}{}", self.prefix, value.0)
    }

    /// Names a value: literals and inputs are written where they are used, the rest is a `let`.
    fn binding(&self, value: Value, op: &Op, names: &mut Names) -> Option<TokenStream> {
        let parameter = |k: usize| &self.declaration.parameters[k].name;
        let inline = match *op {
            Op::Literal(bits) => Some(literal(f64::from_bits(bits))),
            Op::Stretch(i) => Some(self.variables[i].to_token_stream()),
            Op::Strain(i) => {
                let (strains, i) = (&self.strains, Literal::usize_unsuffixed(i));
                Some(quote!(#strains[#i]))
            }
            Op::Epsilon => Some(self.threshold.to_token_stream()),
            _ => None,
        };
        if let Some(inline) = inline {
            names.set(value, inline);
            return None;
        }
        let (name, expression) = match *op {
            Op::Parameter(k) => {
                let parameter = parameter(k);
                (parameter.clone(), self.field(quote!(#parameter)))
            }
            Op::Entry(k) => {
                let (parameter, index) = (parameter(k), &self.index);
                (parameter.clone(), self.field(quote!(#parameter[#index])))
            }
            _ => (self.name(value), self.expression(op, names)),
        };
        names.set(value, name.to_token_stream());
        Some(match *op {
            Op::Parameter(_) | Op::Entry(_) => quote!(let #name: R = #expression;),
            _ => quote!(let #name = #expression;),
        })
    }

    fn expression(&self, op: &Op, names: &Names) -> TokenStream {
        let n = |value: Value| names.get(value);
        match *op {
            Op::Neg(a) => {
                let a = n(a);
                quote!(-#a)
            }
            Op::Add(a, b) => {
                let (a, b) = (n(a), n(b));
                quote!(#a + #b)
            }
            Op::Sub(a, b) => {
                let (a, b) = (n(a), n(b));
                quote!(#a - #b)
            }
            Op::Mul(a, b) => {
                let (a, b) = (n(a), n(b));
                quote!(#a * #b)
            }
            Op::Div(a, b) => {
                let (a, b) = (n(a), n(b));
                quote!(#a / #b)
            }
            Op::MulAdd(a, b, c) => {
                let (a, b, c) = (n(a), n(b), n(c));
                quote!(#a.mul_add(#b, #c))
            }
            // A change of sign costs nothing: it is part of the fused instruction.
            Op::NegMulAdd(a, b, c) => {
                let (a, b, c) = (n(a), n(b), n(c));
                quote!((-#a).mul_add(#b, #c))
            }
            Op::MulSub(a, b, c) => {
                let (a, b, c) = (n(a), n(b), n(c));
                quote!(#a.mul_add(#b, -#c))
            }
            Op::Sqrt(a) => method(n(a), "sqrt"),
            Op::Cbrt(a) => method(n(a), "cbrt"),
            Op::Ln(a) => method(n(a), "ln"),
            Op::Exp(a) => method(n(a), "exp"),
            Op::LnProduct(factors) => {
                let factors = factors.map(n);
                self.call("ln_product", &[quote!([#(#factors),*])])
            }
            Op::Logarithm(a) => method(n(a), "logarithm"),
            Op::Power(logarithm, exponent) => {
                let (logarithm, exponent) = (n(logarithm), n(exponent));
                quote!(R::power(#logarithm, #exponent))
            }
            Op::Max(a, b) => {
                let (a, b) = (n(a), n(b));
                quote!(#a.max(#b))
            }
            Op::Below(a, b) => {
                let (a, b) = (n(a), n(b));
                quote!((#a - #b).min(R::splat(0.0)))
            }
            Op::Function(k, order, a) => {
                let name = ["value", "derivative", "second_derivative"].get(usize::from(order));
                self.function(k, name, &[n(a)])
            }
            Op::FunctionQuotient(k, order, a, b) => {
                let name = ["quotient", "derivative_quotient"].get(usize::from(order));
                self.function(k, name, &[n(a), n(b)])
            }
            Op::WhereNegative(condition, a, b) => {
                let (condition, a, b) = (n(condition), n(a), n(b));
                quote!(R::select(#condition.less(R::splat(0.0)), #a, #b))
            }
            Op::ShareAbove(a, b, epsilon) => self.call("share_above", &[n(a), n(b), n(epsilon)]),
            Op::ShareBelow(a, b, epsilon) => self.call("share_below", &[n(a), n(b), n(epsilon)]),
            Op::Pair { values, reciprocals, logarithms } => {
                let arguments = [values, reciprocals, logarithms].map(|two| self.two(two, names));
                quote!(__piola::Pair::new(#(#arguments),*))
            }
            Op::LnQuotient(pair) => method(n(pair), "ln_quotient"),
            Op::PowerQuotient { pair, powers, exponent } => {
                let (pair, powers, exponent) = (n(pair), self.two(powers, names), n(exponent));
                quote!(#pair.power_quotient(#powers, #exponent))
            }
            Op::ExpQuotient { values: [a, b], exponentials: [a_exp, b_exp] } => {
                self.call("exp_quotient", &[[a, a_exp], [b, b_exp]].map(|two| self.two(two, names)))
            }
            Op::PoleFloor => {
                let stretches = &self.declaration.stretches;
                self.call("pole_floor", &[quote!([#(#stretches),*])])
            }
            Op::Literal(_)
            | Op::Stretch(_)
            | Op::Strain(_)
            | Op::Parameter(_)
            | Op::Entry(_)
            | Op::Epsilon => quote!(),
        }
    }

    /// A call of a function that is a parameter. No expression needs a higher derivative than there is; NaN
    /// would not go unnoticed.
    fn function(&self, parameter: usize, method: Option<&&str>, arguments: &[impl ToTokens]) -> TokenStream {
        let Some(method) = method else { return literal(f64::NAN) };
        let (name, method) = (&self.declaration.parameters[parameter].name, format_ident!("{method}"));
        quote!(::piola::Univariate::#method(&self.#name, #(#arguments),*))
    }

    fn two(&self, values: [Value; 2], names: &Names) -> TokenStream {
        let [a, b] = values.map(|value| names.get(value));
        quote!([#a, #b])
    }

    fn call(&self, kernel: &str, arguments: &[impl ToTokens]) -> TokenStream {
        let kernel = format_ident!("{kernel}");
        quote!(__piola::#kernel(#(#arguments),*))
    }
}

/// The first of the names that the declaration has not taken.
pub(super) fn free_name(declaration: &Declaration, candidates: &[&str]) -> Ident {
    let is_taken = |name: &Ident| {
        declaration.stretches.contains(name) || declaration.parameters.iter().any(|other| other.name == *name)
    };
    candidates
        .iter()
        .map(|name| format_ident!("{name}"))
        .find(|name| !is_taken(name))
        .unwrap_or_else(|| format_ident!("emitted_{}", candidates[0]))
}

/// How each value is written where it is used.
#[derive(Default)]
struct Names(rustc_hash::FxHashMap<Value, TokenStream>);

impl Names {
    fn get(&self, value: Value) -> Option<&TokenStream> {
        self.0.get(&value)
    }

    fn set(&mut self, value: Value, text: TokenStream) {
        self.0.insert(value, text);
    }
}

fn method(receiver: impl ToTokens, name: &str) -> TokenStream {
    let name = format_ident!("{name}");
    quote!(#receiver.#name())
}

fn literal(value: f64) -> TokenStream {
    if !value.is_finite() {
        return quote!(R::splat(f64::NAN));
    }
    let magnitude = Literal::f64_unsuffixed(value.abs());
    if value.is_sign_negative() { quote!(R::splat(-#magnitude)) } else { quote!(R::splat(#magnitude)) }
}
