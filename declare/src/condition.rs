//! Conditions on parameters, evaluated as the Rust that they are.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use piola::__private::interpreter::{ParameterValues, Value};
use piola::material::{Argument, Text};
use piola_codegen::emit::condition_text;
use piola_codegen::read::notation::plain_name;
use piola_codegen::read::parse::{Declaration, identifiers, indexed_list};
use quote::ToTokens;
use syn::{BinOp, Expr, Lit, UnOp};

/// A comparison in parameters, such as `mu[p] * alpha[p] > 0.0`, which holds for every entry of its lists.
pub(crate) struct Condition {
    /// The comparison as people write it.
    pub(crate) text: Text,
    sides: [Term; 2],
    holds: fn(&f64, &f64) -> bool,
    /// A list by whose entries it is written, by its place in the declaration.
    list: Option<usize>,
    /// The parameters that it names: their names, places in the declaration, and whether they are lists.
    names: Vec<(Text, usize, bool)>,
}

impl fmt::Debug for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A number that depends on parameters, and on the current entry of those that are lists.
type Term = Box<dyn Fn(&ParameterValues, usize) -> f64 + Send + Sync>;

impl Condition {
    pub(crate) fn new(declaration: &Declaration, condition: &Expr) -> Self {
        let place = |name: &dyn ToString| {
            let name = name.to_string();
            declaration.parameters.iter().position(|parameter| parameter.name == name)
        };
        // The parser lets nothing but comparisons through; NaN holds in none.
        let (holds, sides): (fn(&f64, &f64) -> bool, _) = match condition {
            Expr::Binary(binary) => {
                let holds = match binary.op {
                    BinOp::Gt(_) => f64::gt,
                    BinOp::Lt(_) => f64::lt,
                    BinOp::Ge(_) => f64::ge,
                    BinOp::Le(_) => f64::le,
                    _ => f64::ne,
                };
                (holds, [&*binary.left, &*binary.right].map(|side| term(side, &place)))
            }
            _ => (f64::gt, [literal(f64::NAN), literal(f64::NAN)]),
        };
        let named = identifiers(condition.to_token_stream());
        let parameters = declaration.parameters.iter().enumerate();
        let names = parameters.filter(|(_, parameter)| named.contains(&parameter.name));
        Self {
            text: condition_text(condition).into(),
            sides,
            holds,
            list: indexed_list(condition).and_then(|(list, _)| place(&list)),
            names: names
                .map(|(k, parameter)| (plain_name(&parameter.name).into(), k, parameter.length().is_some()))
                .collect(),
        }
    }

    /// The parameters of the first entry for which the condition does not hold; `None` if it always does.
    pub(crate) fn violation(&self, values: &ParameterValues) -> Option<Vec<Argument>> {
        let entries = self.list.map_or(1, |list| entries(values, list).len());
        let violated = (0..entries).find(|&entry| !self.holds(values, entry))?;
        let argument = |(name, k, is_list): &(Text, usize, bool)| match is_list {
            true => Argument::entry(name.clone(), violated, number(values, *k, violated)),
            false => Argument::scalar(name.clone(), number(values, *k, 0)),
        };
        Some(self.names.iter().map(argument).collect())
    }

    /// The numbers that the condition names, lists left out.
    pub(crate) fn numbers(&self, values: &ParameterValues) -> Vec<Argument> {
        let numbers = self.names.iter().filter(|(_, _, is_list)| !is_list);
        numbers.map(|(name, k, _)| Argument::scalar(name.clone(), number(values, *k, 0))).collect()
    }

    fn holds(&self, values: &ParameterValues, entry: usize) -> bool {
        let [left, right] = self.sides.each_ref().map(|side| side(values, entry));
        (self.holds)(&left, &right)
    }
}

fn entries(values: &ParameterValues, parameter: usize) -> &[f64] {
    match values.all().get(parameter) {
        Some(Value::Numbers(numbers)) => numbers,
        _ => &[],
    }
}

/// An entry of a list, or a number, which has one.
fn number(values: &ParameterValues, parameter: usize, entry: usize) -> f64 {
    let entries = entries(values, parameter);
    entries.get(entry).or(entries.first()).copied().unwrap_or(f64::NAN)
}

fn literal(value: f64) -> Term {
    Box::new(move |_, _| value)
}

/// An expression as Rust evaluates it, with parameters by their places; NaN for what the parser refuses.
fn term(expression: &Expr, place: &impl Fn(&dyn ToString) -> Option<usize>) -> Term {
    let one = |expression: &Expr, function: fn(f64) -> f64| -> Term {
        let term = term(expression, place);
        Box::new(move |values, entry| function(term(values, entry)))
    };
    let two = |a: &Expr, b: &Expr, function: fn(f64, f64) -> f64| -> Term {
        let [a, b] = [a, b].map(|side| term(side, place));
        Box::new(move |values, entry| function(a(values, entry), b(values, entry)))
    };
    match expression {
        Expr::Lit(number) => literal(match &number.lit {
            Lit::Float(number) => number.base10_parse().unwrap_or(f64::NAN),
            Lit::Int(number) => number.base10_parse().unwrap_or(f64::NAN),
            _ => f64::NAN,
        }),
        Expr::Paren(inner) => term(&inner.expr, place),
        Expr::Group(inner) => term(&inner.expr, place),
        Expr::Index(index) => term(&index.expr, place),
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => one(&unary.expr, f64::neg),
        Expr::Binary(binary) => {
            let function = match binary.op {
                BinOp::Add(_) => f64::add,
                BinOp::Sub(_) => f64::sub,
                BinOp::Mul(_) => f64::mul,
                BinOp::Div(_) => f64::div,
                _ => |_, _| f64::NAN,
            };
            two(&binary.left, &binary.right, function)
        }
        Expr::Path(path) => match path.path.get_ident().and_then(|name| place(name)) {
            Some(k) => Box::new(move |values, entry| number(values, k, entry)),
            None => literal(constant(&path.path)),
        },
        Expr::MethodCall(call) => match (call.method.to_string().as_str(), call.args.first()) {
            ("powi", Some(exponent)) => {
                let base = term(&call.receiver, place);
                let exponent = term(exponent, place)(&ParameterValues::new(Vec::new()), 0) as i32;
                Box::new(move |values, entry| base(values, entry).powi(exponent))
            }
            ("powf", Some(exponent)) => two(&call.receiver, exponent, f64::powf),
            ("log", Some(base)) => two(&call.receiver, base, f64::log),
            (name, None) => one(&call.receiver, function(name).unwrap_or(|_| f64::NAN)),
            _ => literal(f64::NAN),
        },
        _ => literal(f64::NAN),
    }
}

/// A constant of `std::f64::consts`.
fn constant(path: &syn::Path) -> f64 {
    use std::f64::consts;
    match path.segments.last().map(|last| last.ident.to_string()).as_deref() {
        Some("PI") => consts::PI,
        Some("TAU") => consts::TAU,
        Some("E") => consts::E,
        Some("LN_2") => consts::LN_2,
        Some("LN_10") => consts::LN_10,
        Some("SQRT_2") => consts::SQRT_2,
        Some("FRAC_PI_2") => consts::FRAC_PI_2,
        Some("FRAC_2_SQRT_PI") => consts::FRAC_2_SQRT_PI,
        _ => f64::NAN,
    }
}

/// A function of the standard library that conditions may call.
fn function(name: &str) -> Option<fn(f64) -> f64> {
    Some(match name {
        "ln" => f64::ln,
        "log10" => f64::log10,
        "log2" => f64::log2,
        "exp" => f64::exp,
        "sqrt" => f64::sqrt,
        "cbrt" => f64::cbrt,
        "recip" => f64::recip,
        "ln_1p" => f64::ln_1p,
        "exp_m1" => f64::exp_m1,
        "sinh" => f64::sinh,
        "cosh" => f64::cosh,
        "tanh" => f64::tanh,
        "asinh" => f64::asinh,
        "sin" => f64::sin,
        "cos" => f64::cos,
        "atan" => f64::atan,
        _ => return None,
    })
}
