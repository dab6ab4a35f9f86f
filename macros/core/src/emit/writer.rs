//! Programs as Rust statements.

use proc_macro2::{Literal, Punct, Spacing, TokenStream};
use quote::{ToTokens, format_ident, quote};
use rustc_hash::FxHashMap;
use syn::Ident;

use crate::read::parse::{Declaration, Parameter};
use crate::schedule::{Op, Program, Value};

/// Writes programs with the names of one declaration.
#[derive(Clone)]
pub(super) struct Writer<'a> {
    pub(super) declaration: &'a Declaration,
    /// Names of the three stretches of the graph, or of other variables that they stand for.
    pub(super) variables: [Ident; 3],
    /// The material whose parameters are read.
    pub(super) material: Ident,
    /// Prefix of the number of a value; such that no declared name looks like a value.
    pub(super) prefix: &'static str,
    /// The index of sums.
    pub(super) index: Ident,
    /// The threshold of the extension.
    pub(super) threshold: Ident,
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
        let material = format_ident!("self");
        Self { declaration, variables, material, prefix, index, threshold, strains }
    }

    /// The text for the material inside its domain, or else for the one that is continued beyond it.
    pub(super) fn by_inversion(&self, plain: TokenStream, extended: Option<TokenStream>) -> TokenStream {
        let Some(extended) = extended else { return plain };
        let threshold = &self.threshold;
        quote! {
            match self.inversion {
                __p::Inversion::Refuse => { #plain }
                __p::Inversion::Extend { epsilon: #threshold } => {
                    let #threshold = R::splat(#threshold);
                    #extended
                }
            }
        }
    }

    /// The statements of a program and its outputs as expressions.
    pub(super) fn program(&self, program: &Program) -> (TokenStream, Vec<TokenStream>) {
        let mut lines = Lines::new(self, program);
        for block in &program.blocks {
            let before = block.length.map(|length| (length, lines.take()));
            block.body.iter().for_each(|(value, op)| lines.push(*value, op));
            let Some((length, before)) = before else { continue };
            let length = self.declaration.lengths[length].of(&self.material);
            let index = &self.index;
            let body = lines.take();
            let (mut starts, mut additions) = (Vec::new(), Vec::new());
            for &(total, term) in &block.totals {
                let name = self.name(total);
                let term = lines.names.argument(term);
                starts.push(quote!(let mut #name = R::splat(0.0);));
                additions.push(quote!(#name = #name + #term;));
                lines.names.set(total, name);
            }
            lines.statements = quote! {
                #before
                #(#starts)*
                for #index in 0..#length {
                    #body
                    #(#additions)*
                }
            };
        }
        lines.take_in(&program.outputs);
        let statements = lines.take();
        let outputs = program.outputs.iter().map(|&output| lines.names.argument(output).to_token_stream());
        (statements, outputs.collect())
    }

    fn name(&self, value: Value) -> Ident {
        format_ident!("{}{}", self.prefix, value.0)
    }

    fn expression(&self, op: &Op, names: &Names) -> TokenStream {
        let n = |value: Value| names.argument(value);
        let o = |value: Value| names.operand(value);
        let binary = |a: Value, operator: char, b: Value| {
            let (a, operator, b) = (o(a), Punct::new(operator, Spacing::Alone), o(b));
            quote!(#a #operator #b)
        };
        match *op {
            Op::Neg(a) => {
                let a = o(a);
                quote!(-#a)
            }
            Op::Add(a, b) => binary(a, '+', b),
            Op::Sub(a, b) => binary(a, '-', b),
            Op::Mul(a, b) => binary(a, '*', b),
            Op::Div(a, b) => binary(a, '/', b),
            Op::MulAdd(a, b, c) => method(o(a), "mul_add", &[n(b), n(c)]),
            // A change of sign costs nothing: it is part of the fused instruction.
            Op::NegMulAdd(a, b, c) => {
                let a = o(a);
                method(quote!((-#a)), "mul_add", &[n(b), n(c)])
            }
            Op::MulSub(a, b, c) => {
                let (a, b, c) = (o(a), n(b), o(c));
                quote!(#a.mul_add(#b, -#c))
            }
            Op::Sqrt(a) => method(o(a), "sqrt", &[]),
            Op::Cbrt(a) => method(o(a), "cbrt", &[]),
            Op::Ln(a) => method(o(a), "ln", &[]),
            Op::Exp(a) => method(o(a), "exp", &[]),
            Op::Elementary(function, a) => method(o(a), function.name(), &[]),
            Op::ElementaryQuotient(function, a, b) => {
                self.call(&format!("{}_quotient", function.name()), &[n(a), n(b)])
            }
            Op::LnProduct(factors) => {
                let factors = factors.map(n);
                self.call("ln_product", &[quote!([#(#factors),*])])
            }
            Op::Logarithm(a) => method(o(a), "logarithm", &[]),
            Op::Power(logarithm, exponent) => {
                let (logarithm, exponent) = (n(logarithm), n(exponent));
                quote!(R::power(#logarithm, #exponent))
            }
            Op::Max(a, b) => method(o(a), "max", &[n(b)]),
            Op::AboveZero(a) => self.call("above_zero", &[n(a)]),
            Op::Below(a, b) => {
                let (a, b) = (o(a), o(b));
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
            Op::WholePower(base, exponent, order) => {
                let (base, exponent, order) = (n(base), n(exponent), Literal::u8_unsuffixed(order));
                self.call("whole_power", &[quote!(#base, #exponent, #order)])
            }
            Op::WholePowerQuotient(bases, exponent, order) => {
                let (bases, exponent) = (self.two(bases, names), n(exponent));
                let order = Literal::u8_unsuffixed(order);
                self.call("whole_power_quotient", &[quote!(#bases, #exponent, #order)])
            }
            Op::WhereNegative(condition, a, b) => {
                let (condition, a, b) = (o(condition), n(a), n(b));
                quote!(R::select(#condition.less(R::splat(0.0)), #a, #b))
            }
            Op::ShareAbove(a, b, epsilon) => self.call("share_above", &[n(a), n(b), n(epsilon)]),
            Op::ShareBelow(a, b, epsilon) => self.call("share_below", &[n(a), n(b), n(epsilon)]),
            Op::Pair { values, reciprocals, logarithms } => {
                let arguments = [values, reciprocals, logarithms].map(|two| self.two(two, names));
                quote!(__p::Pair::new(#(#arguments),*))
            }
            Op::LnQuotient(pair) => method(o(pair), "ln_quotient", &[]),
            Op::PowerQuotient { pair, powers, exponent } => {
                let (pair, powers, exponent) = (o(pair), self.two(powers, names), n(exponent));
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

    /// A call of a function that is a parameter. No expression needs a derivative of higher order than
    /// exists; NaN would be noticed.
    fn function(&self, parameter: usize, method: Option<&&str>, arguments: &[impl ToTokens]) -> TokenStream {
        let Some(method) = method else { return literal(f64::NAN) };
        let (name, method) = (&self.declaration.parameters[parameter].name, format_ident!("{method}"));
        let material = &self.material;
        quote!(::piola::Univariate::#method(&#material.#name, #(#arguments),*))
    }

    fn two(&self, values: [Value; 2], names: &Names) -> TokenStream {
        let [a, b] = values.map(|value| names.argument(value));
        quote!([#a, #b])
    }

    fn call(&self, kernel: &str, arguments: &[impl ToTokens]) -> TokenStream {
        let kernel = format_ident!("{kernel}");
        quote!(__p::#kernel(#(#arguments),*))
    }
}

/// Greek letters that rustc's lint `confusable_idents` takes for Latin ones.
const LOOKALIKES: [(&str, &str); 8] =
    [("α", "a"), ("γ", "y"), ("ι", "i"), ("ν", "v"), ("ο", "o"), ("ρ", "p"), ("σ", "o"), ("υ", "u")];

/// The first of the names that the declaration has not taken, and that resembles none that it has.
pub(super) fn free_name(declaration: &Declaration, candidates: &[&str]) -> Ident {
    let parameters = declaration.parameters.iter().map(|parameter| &parameter.name);
    let taken: Vec<_> = declaration.stretches.iter().chain(parameters).collect();
    let is_taken = |name: &Ident| {
        let looks_like =
            |other: &Ident| LOOKALIKES.iter().any(|&(greek, latin)| *other == greek && *name == latin);
        taken.iter().any(|&other| other == name || looks_like(other))
    };
    candidates
        .iter()
        .map(|name| format_ident!("{name}"))
        .find(|name| !is_taken(name))
        .unwrap_or_else(|| format_ident!("emitted_{}", candidates[0]))
}

/// The statements of a program as they are written, in the order of the program.
///
/// A value that is read once, by the next statement to be written, is written there and needs no name:
/// operations still take place in their order, except for operands of one operation.
struct Lines<'a> {
    writer: &'a Writer<'a>,
    statements: TokenStream,
    names: Names,
    reads: FxHashMap<Value, usize>,
    /// Values read once, with their expressions, which the next statements may take in.
    waiting: Vec<(Value, Text)>,
}

impl<'a> Lines<'a> {
    /// Longest expression, in characters, to be taken in by another: with what is around it, about a line.
    const LONGEST: usize = 72;

    fn new(writer: &'a Writer<'a>, program: &Program) -> Self {
        let mut reads = FxHashMap::default();
        program.each_read(|value| *reads.entry(value).or_insert(0) += 1);
        Self { writer, statements: TokenStream::new(), names: Names::default(), reads, waiting: Vec::new() }
    }

    /// Writes an operation: literals and inputs where they are read, the rest as a `let` or where it is read.
    fn push(&mut self, value: Value, op: &Op) {
        let writer = self.writer;
        match *op {
            Op::Literal(bits) => self.names.set(value, literal(f64::from_bits(bits))),
            Op::Stretch(i) => self.names.set(value, &writer.variables[i]),
            Op::Strain(i) => {
                let (strains, i) = (&writer.strains, Literal::usize_unsuffixed(i));
                self.names.set(value, quote!(#strains[#i]));
            }
            Op::Epsilon => self.names.set(value, &writer.threshold),
            Op::Parameter(k) => self.parameter(value, k, &TokenStream::new()),
            Op::Entry(k) => {
                let index = &writer.index;
                self.parameter(value, k, &quote!([#index]));
            }
            _ => self.operation(value, op),
        }
    }

    /// Reads a parameter from the material, as a number of type `R`.
    fn parameter(&mut self, value: Value, k: usize, index: &TokenStream) {
        let Writer { declaration, material, .. } = self.writer;
        let Parameter { name, is_whole, .. } = &declaration.parameters[k];
        let field = quote!(#material.#name #index);
        // A whole exponent is not a value of type `R`: it is read from the material where it is needed.
        if *is_whole {
            return self.names.set(value, field);
        }
        let number = match declaration.is_plain() {
            true => quote!(__p::ParameterValue::on(&#field)),
            false => quote!(R::splat(#field)),
        };
        self.statements.extend(quote!(let #name: R = #number;));
        self.names.set(value, name);
    }

    fn operation(&mut self, value: Value, op: &Op) {
        self.take_in(&op.operands());
        let text = Text {
            tokens: self.writer.expression(op, &self.names),
            is_operand: !matches!(op, Op::Neg(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..)),
        };
        let is_read_once = self.reads.get(&value) == Some(&1);
        let is_short = || text.tokens.to_string().chars().filter(|c| *c != ' ').count() <= Self::LONGEST;
        if is_read_once && is_short() {
            self.waiting.push((value, text));
        } else {
            self.flush();
            self.name(value, &text);
        }
    }

    /// Writes those of the values that wait where they are read, if they are the last of all that wait; else
    /// names all that wait.
    fn take_in(&mut self, read: &[Value]) {
        let is_read = |(value, _): &(Value, Text)| read.contains(value);
        let first = self.waiting.len() - self.waiting.iter().filter(|one| is_read(one)).count();
        if self.waiting[first..].iter().all(is_read) {
            self.names.0.extend(self.waiting.drain(first..));
        } else {
            self.flush();
        }
    }

    fn name(&mut self, value: Value, Text { tokens, .. }: &Text) {
        let name = self.writer.name(value);
        self.statements.extend(quote!(let #name = #tokens;));
        self.names.set(value, name);
    }

    /// Names the values that wait.
    fn flush(&mut self) {
        for (value, text) in std::mem::take(&mut self.waiting) {
            self.name(value, &text);
        }
    }

    /// The statements up to here, with a name for each value that is still read.
    fn take(&mut self) -> TokenStream {
        self.flush();
        std::mem::take(&mut self.statements)
    }
}

/// A value where it is read.
struct Text {
    tokens: TokenStream,
    /// True if it can be an operand without parentheses.
    is_operand: bool,
}

/// Text of each value where it is read.
#[derive(Default)]
struct Names(FxHashMap<Value, Text>);

impl Names {
    fn set(&mut self, value: Value, name: impl ToTokens) {
        self.0.insert(value, Text { tokens: name.into_token_stream(), is_operand: true });
    }

    /// The value between commas.
    fn argument(&self, value: Value) -> Option<&TokenStream> {
        self.0.get(&value).map(|text| &text.tokens)
    }

    /// The value next to an operator, or as the receiver of a method.
    fn operand(&self, value: Value) -> Option<TokenStream> {
        self.0.get(&value).map(|Text { tokens, is_operand }| match is_operand {
            true => tokens.clone(),
            false => quote!((#tokens)),
        })
    }
}

fn method(receiver: impl ToTokens, name: &str, arguments: &[Option<&TokenStream>]) -> TokenStream {
    let name = format_ident!("{name}");
    quote!(#receiver.#name(#(#arguments),*))
}

fn literal(value: f64) -> TokenStream {
    if !value.is_finite() {
        return quote!(R::splat(f64::NAN));
    }
    let magnitude = Literal::f64_unsuffixed(value.abs());
    if value.is_sign_negative() { quote!(R::splat(-#magnitude)) } else { quote!(R::splat(#magnitude)) }
}
