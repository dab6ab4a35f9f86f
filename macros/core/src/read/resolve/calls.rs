//! Calls: methods of numbers, and functions that are parameters.

use quote::ToTokens;
use syn::{Expr, ExprCall, ExprMethodCall, Ident, UnOp};

use super::tensors::{self, Tensor};
use super::{Resolver, Scope, paper_notation};
use crate::algebra::expr::{Elementary, Exponent, Function, Id, Node};
use crate::algebra::rational::Rational;
use crate::read::parse::{Kind, identifiers};
use crate::read::spelling::{list, nearest};

/// Methods of numbers, each with an example of a call.
const METHODS: [(&str, &str); 10] = [
    ("powi", ".powi(2)"),
    ("powf", ".powf(alpha)"),
    ("ln", ".ln()"),
    ("exp", ".exp()"),
    ("sqrt", ".sqrt()"),
    ("cbrt", ".cbrt()"),
    ("recip", ".recip()"),
    ("log10", ".log10()"),
    ("log2", ".log2()"),
    ("log", ".log(2.0)"),
];

/// Methods that a message offers if no similar name exists, each with an example; [`Elementary`] has more.
const OFFERED: [&str; 6] = [".powi(2)", ".powf(alpha)", ".ln()", ".exp()", ".sqrt()", ".tanh()"];

/// Functions of `f64` whose derivatives jump.
const KINKED: [&str; 12] = [
    "abs",
    "max",
    "min",
    "clamp",
    "signum",
    "floor",
    "ceil",
    "round",
    "trunc",
    "fract",
    "copysign",
    "rem_euclid",
];

impl Resolver<'_> {
    pub(super) fn method(&mut self, call: &ExprMethodCall) -> Id {
        let name = call.method.to_string();
        let form = form(&name);
        if form.is_none()
            && let Some(tensor) = self.tensor(&call.receiver)
        {
            return self.tensor_function(call, tensor);
        }
        let receiver = self.expression(&call.receiver);
        let Some(form) = form else {
            self.excuse_names(&call.args);
            return self.unknown_function(&call.method, None);
        };
        let expected = usize::from(!form.ends_with("()"));
        if call.args.len() != expected {
            self.excuse_names(&call.args);
            let what = match name.as_str() {
                "log" => "one argument, the base; the natural logarithm is `.ln()`",
                _ if expected == 0 => "no argument",
                _ => "one argument, the exponent",
            };
            return self.mistake(&call.method, &format!("`{name}` takes {what}"));
        }
        let graph = &mut *self.graph;
        if let Some(function) = Elementary::named(&name) {
            // The constructor has the functions of `f64`.
            if self.scope == Scope::Parameters
                && matches!(function, Elementary::Erf | Elementary::Sigmoid | Elementary::Softplus)
            {
                let rust = self
                    .diagnostics
                    .notation()
                    .either("is plain Rust, whose numbers have", "on parameters has");
                let message = format!("a condition {rust} no `{name}`");
                return self.mistake(&call.method, &message);
            }
            return graph.elementary(function, receiver);
        }
        match name.as_str() {
            "ln" | "log10" | "log2" | "log"
                if graph.as_constant(receiver).is_some_and(|x| x.is_zero() || x.is_negative()) =>
            {
                self.mistake(call, "this logarithm is of a number that is not positive")
            }
            "log10" => self.logarithm(receiver, std::f64::consts::LOG10_E),
            "log2" => self.logarithm(receiver, std::f64::consts::LOG2_E),
            "log" => {
                let base = self.expression(&call.args[0]);
                let (value, base) = (self.graph.ln(receiver), self.graph.ln(base));
                if self.graph.is_zero(base) {
                    return self.mistake(&call.args[0], "a logarithm has no base 1: division by zero");
                }
                self.graph.div(value, base)
            }
            "ln" => graph.ln(receiver),
            "exp" => graph.apply(Function::Exp, receiver),
            "sqrt" => graph.power(receiver, Rational::new(1, 2).map_or(Exponent::ONE, Exponent::rational)),
            "cbrt" => graph.power(receiver, Rational::new(1, 3).map_or(Exponent::ONE, Exponent::rational)),
            "recip" if graph.is_zero(receiver) => self.mistake(&call.receiver, "division by zero"),
            "recip" => graph.powi(receiver, -1),
            "powi" => self.whole_power(receiver, &call.args[0]),
            _ => self.real_power(receiver, &call.args[0]),
        }
    }

    /// ln x times a factor.
    fn logarithm(&mut self, of: Id, factor: f64) -> Id {
        let (ln, factor) = (self.graph.ln(of), self.graph.leaf(Node::Float(factor.to_bits())));
        self.graph.mul(factor, ln)
    }

    /// A function of a tensor, which has no value by itself: one message, on the function or on the name of
    /// the tensor.
    fn tensor_function(&mut self, call: &ExprMethodCall, of: Tensor) -> Id {
        self.excuse_names(call);
        if tensors::function(&call.method.to_string(), None).is_some() {
            return self.unknown_function(&call.method, Some(of));
        }
        self.expression(&call.receiver)
    }

    /// The tensor that an expression stands for in papers, unless the declaration defines one of its names.
    fn tensor(&self, expression: &Expr) -> Option<Tensor> {
        let names = identifiers(expression.to_token_stream());
        let has_meaning = |name: &Ident| self.is_taken(name) || self.mistaken.contains(&name.to_string());
        tensors::tensor(expression).filter(|_| !names.iter().any(has_meaning))
    }

    fn unknown_function(&mut self, method: &Ident, of: Option<Tensor>) -> Id {
        let name = method.to_string();
        let notation = self.diagnostics.notation();
        if KINKED.contains(&name.as_str()) {
            let or = ", or a parameter whose type implements `piola::Univariate`";
            let message = format!(
                "`{name}` has a kink, at which stress or stiffness would jump: write a smooth function, such as a power{}",
                notation.either(or, "")
            );
            return self.mistake(method, &message);
        }
        let known = || METHODS.into_iter().map(|(known, _)| known).chain(Elementary::names());
        let near = || nearest(&name, known()).and_then(form);
        let hint = match tensors::function(&name, of).or_else(|| paper_notation::function(&name, notation)) {
            Some(hint) => hint.to_owned(),
            None => match near() {
                Some(form) => format!("did you mean `{form}`?"),
                None => {
                    let other = notation.either(
                        "another one is a parameter `f: F`, with `F` that implements `piola::Univariate`",
                        "for a product write `*` before the parenthesis",
                    );
                    format!("there are {}, …; {other}", list(&OFFERED))
                }
            },
        };
        self.mistake(method, &format!("unknown function `{name}`: {hint}"))
    }

    fn whole_power(&mut self, base: Id, argument: &Expr) -> Id {
        if let Some(exponent) = self.whole_exponent(argument) {
            let function = Function::WholePower(exponent, 0);
            return if self.is_unknown(base) { base } else { self.graph.apply(function, base) };
        }
        if let Some(message) = self.no_whole_exponent(argument) {
            self.excuse();
            return self.mistake(argument, &message);
        }
        let exponent = self.expression(argument);
        if self.is_unknown(exponent) {
            return exponent;
        }
        let Some(exponent) = self.graph.as_constant(exponent).filter(|exponent| exponent.denominator() == 1)
        else {
            let exponent = argument.to_token_stream().to_string().replace(" [", "[");
            let name = exponent.split('[').next().unwrap_or_default();
            let parameter = self.declaration.parameters.iter().find(|parameter| parameter.name == name);
            let ty = match parameter.map(|parameter| (&parameter.kind, self.declaration.is_vector(parameter)))
            {
                Some((Kind::Number, _)) => ": u32",
                Some((Kind::List(_), false)) => ": [u32; N]",
                Some((Kind::List(_), true)) => ": Vec<u32>",
                _ => "",
            };
            let whole = if ty.is_empty() { String::new() } else { format!(", or declare `{name}{ty}`") };
            let message =
                format!("`powi` takes a whole number: for this one write `.powf({exponent})`{whole}");
            return self.mistake(argument, &message);
        };
        if self.scope == Scope::Parameters && !is_number(argument) {
            return self.mistake(argument, "in a condition `powi` takes one number, such as `2`");
        }
        match exponent.as_integer() {
            Some(n) if n < 0 && self.graph.is_zero(base) => self.mistake(argument, "division by zero"),
            Some(n) if n.abs() <= 64 => self.graph.powi(base, n),
            _ => self.mistake(argument, "a whole power is at most 64: for larger ones use `.powf(…)`"),
        }
    }

    /// The message about an exponent that is computed from whole ones.
    fn no_whole_exponent(&self, argument: &Expr) -> Option<String> {
        if let Expr::Paren(inner) = argument {
            return self.no_whole_exponent(&inner.expr);
        }
        // What is misunderstood of a parameter that stands alone is its place.
        if self.scope == Scope::Parameters || !matches!(argument, Expr::Binary(_) | Expr::Unary(_)) {
            return None;
        }
        let names = identifiers(argument.to_token_stream());
        let mut whole = self.declaration.parameters.iter().filter(|parameter| parameter.is_whole);
        let parameter = whole.find(|parameter| names.contains(&parameter.name))?;
        let name = &parameter.name;
        let written = |part: &dyn ToTokens| part.to_token_stream().to_string().replace(" [", "[");
        if let Expr::Unary(negated) = argument {
            let inner = written(&negated.expr);
            return Some(format!(
                "whole exponents that are parameters are not negative: write `.recip().powi({inner})`, or declare `{name}` with \
                 `f64` and write `.powf(-{inner})`"
            ));
        }
        let text = written(argument);
        let holder = match parameter.length() {
            Some(_) => format!("the list `{name}` hold the values of `{text}` themselves"),
            None => format!("`{name}` be the value of `{text}` itself"),
        };
        Some(format!(
            "`powi` takes a whole exponent that is a parameter as it is: let {holder}, or declare `{name}` with `f64` and write \
             `.powf({text})`"
        ))
    }

    fn real_power(&mut self, base: Id, argument: &Expr) -> Id {
        let exponent = self.expression(argument);
        if self.is_unknown(base) {
            return base;
        }
        if self.graph.contains(exponent, |node| matches!(node, Node::Stretch(_))) {
            return self.mistake(argument, "an exponent is made of numbers and parameters, not of stretches");
        }
        let is_negative = self.graph.as_constant(exponent).is_some_and(Rational::is_negative);
        if is_negative && self.graph.is_zero(base) {
            return self.mistake(argument, "division by zero");
        }
        let exponent = self.graph.exponent(exponent);
        self.graph.power(base, exponent)
    }

    pub(super) fn call(&mut self, call: &ExprCall) -> Id {
        let name = match &*call.func {
            Expr::Path(path) => path.path.segments.last().map(|last| last.ident.clone()),
            _ => None,
        };
        let Some(name) = name else {
            self.excuse_names(call);
            let message = match &*call.func {
                Expr::Lit(number) => {
                    let number = number.to_token_stream();
                    format!("`{number}` is not a function: write `{number} * (…)` for a product")
                }
                _ => "this is not a function: write `*` after it for a product".into(),
            };
            return self.mistake(&call.func, &message);
        };
        let text = name.to_string();
        if self.mistaken.contains(&text) {
            self.excuse_names(call);
            self.excuse();
            return self.unknown();
        }
        match self.declaration.place(&name) {
            Some(k) if self.declaration.parameters[k].is_function() => return self.function(k, call),
            Some(_) => {
                return self.mistake(
                    call,
                    &format!("`{name}` is not a function: write `{name} * (…)` for a product"),
                );
            }
            None => {}
        }
        match text.as_str() {
            "sum" => self.sum(call),
            known if form(known).is_some() => {
                self.excuse_names(call);
                let form = form(known).unwrap_or_default();
                self.mistake(&call.func, &format!("`{known}` is called on a number: write `x{form}`"))
            }
            _ => {
                self.excuse_names(call);
                let tensor = call.args.first().and_then(|argument| self.tensor(argument));
                self.unknown_function(&name, tensor)
            }
        }
    }

    /// The call of a function that is a parameter.
    fn function(&mut self, k: usize, call: &ExprCall) -> Id {
        let name = self.declaration.parameters[k].name.to_string();
        if self.scope == Scope::Parameters {
            return self.mistake(call, "a function is checked by its own constructor: remove this condition");
        }
        self.used.insert(name.clone());
        let [argument] = call.args.iter().collect::<Vec<_>>()[..] else {
            return self.mistake(call, &format!("a function has one argument: write `{name}(l1)`"));
        };
        let argument = self.expression(argument);
        self.graph.apply(Function::Given(k, 0), argument)
    }
}

/// An example of a call of a method.
fn form(name: &str) -> Option<String> {
    let method = METHODS.into_iter().find(|(known, _)| *known == name).map(|(_, form)| form.to_owned());
    method.or_else(|| Elementary::named(name).map(|function| format!(".{}()", function.name())))
}

/// True if an exponent is a literal with or without a sign.
fn is_number(exponent: &Expr) -> bool {
    match exponent {
        Expr::Lit(_) => true,
        Expr::Unary(unary) => matches!(unary.op, UnOp::Neg(_)) && is_number(&unary.expr),
        Expr::Paren(inner) => is_number(&inner.expr),
        Expr::Group(inner) => is_number(&inner.expr),
        _ => false,
    }
}
