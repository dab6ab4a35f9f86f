//! Conditions on parameters, evaluated as the Rust that they are.

use piola::interpreter::{ParameterValues, Value};
use piola::material::{Argument, Text};
use piola_codegen::emit::condition_text;
use piola_codegen::read::parse::{Declaration, identifiers, indexed_list};
use quote::ToTokens;
use syn::{BinOp, Expr, Lit, UnOp};

/// A comparison in parameters, such as `mu[p] * alpha[p] > 0.0`, which holds for every entry of its lists.
#[derive(Debug)]
pub(crate) struct Condition {
    /// The comparison as people write it.
    pub(crate) text: Text,
    comparison: Comparison,
    sides: [Term; 2],
    /// A list by whose entries it is written, by its place in the declaration.
    list: Option<usize>,
    /// The parameters that it names: their names, places in the declaration, and whether they are lists.
    names: Vec<(Text, usize, bool)>,
}

#[derive(Clone, Copy, Debug)]
enum Comparison {
    Greater,
    Less,
    AtLeast,
    AtMost,
    Different,
}

/// A number that depends on parameters.
#[derive(Debug)]
enum Term {
    Literal(f64),
    /// A parameter, or the current entry of a list.
    Parameter(usize),
    Negative(Box<Term>),
    Sum(Box<[Term; 2]>),
    Difference(Box<[Term; 2]>),
    Product(Box<[Term; 2]>),
    Quotient(Box<[Term; 2]>),
    Function(fn(f64) -> f64, Box<Term>),
    Power(Box<[Term; 2]>),
    Logarithm(Box<[Term; 2]>),
    WholePower(Box<Term>, i32),
}

impl Condition {
    pub(crate) fn new(declaration: &Declaration, condition: &Expr) -> Self {
        let place = |name: &dyn ToString| {
            let name = name.to_string();
            declaration.parameters.iter().position(|parameter| parameter.name == name)
        };
        let (comparison, sides) = match condition {
            Expr::Binary(binary) => {
                let comparison = match binary.op {
                    BinOp::Gt(_) => Comparison::Greater,
                    BinOp::Lt(_) => Comparison::Less,
                    BinOp::Ge(_) => Comparison::AtLeast,
                    BinOp::Le(_) => Comparison::AtMost,
                    _ => Comparison::Different,
                };
                (comparison, [&*binary.left, &*binary.right].map(|side| Term::of(side, &place)))
            }
            // The parser lets nothing but comparisons through; NaN holds in none.
            _ => (Comparison::Greater, [f64::NAN; 2].map(Term::Literal)),
        };
        let named = identifiers(condition.to_token_stream());
        let parameters = declaration.parameters.iter().enumerate();
        let names = parameters.filter(|(_, parameter)| named.contains(&parameter.name));
        Self {
            text: condition_text(condition).into(),
            comparison,
            sides,
            list: indexed_list(condition).and_then(|(list, _)| place(&list)),
            names: names
                .map(|(k, parameter)| (parameter.name.to_string().into(), k, parameter.length().is_some()))
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
        let [left, right] = self.sides.each_ref().map(|side| side.value(values, entry));
        match self.comparison {
            Comparison::Greater => left > right,
            Comparison::Less => left < right,
            Comparison::AtLeast => left >= right,
            Comparison::AtMost => left <= right,
            Comparison::Different => left != right,
        }
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

impl Term {
    fn of(expression: &Expr, place: &impl Fn(&dyn ToString) -> Option<usize>) -> Self {
        let one = |expression: &Expr| Box::new(Self::of(expression, place));
        let two = |a: &Expr, b: &Expr| Box::new([a, b].map(|side| Self::of(side, place)));
        match expression {
            Expr::Lit(literal) => Self::Literal(match &literal.lit {
                Lit::Float(number) => number.base10_parse().unwrap_or(f64::NAN),
                Lit::Int(number) => number.base10_parse().unwrap_or(f64::NAN),
                _ => f64::NAN,
            }),
            Expr::Paren(inner) => Self::of(&inner.expr, place),
            Expr::Group(inner) => Self::of(&inner.expr, place),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => Self::Negative(one(&unary.expr)),
            Expr::Binary(binary) => {
                let sides = two(&binary.left, &binary.right);
                match binary.op {
                    BinOp::Add(_) => Self::Sum(sides),
                    BinOp::Sub(_) => Self::Difference(sides),
                    BinOp::Mul(_) => Self::Product(sides),
                    BinOp::Div(_) => Self::Quotient(sides),
                    _ => Self::Literal(f64::NAN),
                }
            }
            Expr::Index(index) => Self::of(&index.expr, place),
            Expr::Path(path) => match path.path.get_ident().and_then(|name| place(name)) {
                Some(k) => Self::Parameter(k),
                None => Self::Literal(constant(&path.path)),
            },
            Expr::MethodCall(call) => {
                let argument = call.args.first();
                match (call.method.to_string().as_str(), argument) {
                    ("powi", Some(exponent)) => {
                        let exponent = Self::of(exponent, place).value(&ParameterValues::new(Vec::new()), 0);
                        Self::WholePower(one(&call.receiver), exponent as i32)
                    }
                    ("powf", Some(exponent)) => Self::Power(two(&call.receiver, exponent)),
                    ("log", Some(base)) => Self::Logarithm(two(&call.receiver, base)),
                    (name, None) => match function(name) {
                        Some(function) => Self::Function(function, one(&call.receiver)),
                        None => Self::Literal(f64::NAN),
                    },
                    _ => Self::Literal(f64::NAN),
                }
            }
            _ => Self::Literal(f64::NAN),
        }
    }

    fn value(&self, values: &ParameterValues, entry: usize) -> f64 {
        let both = |sides: &[Self; 2]| sides.each_ref().map(|side| side.value(values, entry));
        match self {
            Self::Literal(value) => *value,
            Self::Parameter(k) => number(values, *k, entry),
            Self::Negative(term) => -term.value(values, entry),
            Self::Sum(sides) => both(sides).into_iter().sum(),
            Self::Product(sides) => both(sides).into_iter().product(),
            Self::Difference(sides) => {
                let [a, b] = both(sides);
                a - b
            }
            Self::Quotient(sides) => {
                let [a, b] = both(sides);
                a / b
            }
            Self::Power(sides) => {
                let [a, b] = both(sides);
                a.powf(b)
            }
            Self::Logarithm(sides) => {
                let [a, base] = both(sides);
                a.log(base)
            }
            Self::Function(function, term) => function(term.value(values, entry)),
            Self::WholePower(term, exponent) => term.value(values, entry).powi(*exponent),
        }
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
