//! Conditions on parameters, evaluated as the Rust that they are.

use std::fmt;

use piola::__private::interpreter::{ParameterValues, Value};
use piola::material::{Argument, Text};
use piola_codegen::emit::condition_text;
use piola_codegen::read::notation::plain_name;
use piola_codegen::read::parse::{Declaration, identifiers, indexed_list};
use quote::ToTokens;
use syn::{BinOp, Expr, Lit, UnOp};

/// A comparison in parameters, such as `mu[p] * alpha[p] > 0.0`, which holds for every entry of its lists.
pub(crate) struct Condition {
    /// The comparison in the usual notation.
    pub(crate) text: Text,
    pub(crate) sides: [Term; 2],
    /// `>`, `<`, `>=`, `<=` or `!=`.
    pub(crate) comparison: &'static str,
    /// A list by whose entries it is written, by its place in the declaration.
    pub(crate) list: Option<usize>,
    /// The parameters that it names: their names, places in the declaration, and whether they are lists.
    names: Vec<(Text, usize, bool)>,
}

impl fmt::Debug for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// An expression in parameters, and in the current entry of those that are lists.
#[derive(Debug)]
pub(crate) enum Term {
    Number(f64),
    /// A parameter, by its place in the declaration.
    Parameter(usize),
    Negative(Box<Term>),
    /// A sum, difference, product or quotient.
    Arithmetic(char, Box<[Term; 2]>),
    /// A function of the standard library.
    Call(&'static Function, Vec<Term>),
}

/// A function of the standard library that conditions may call.
#[derive(Debug)]
pub(crate) struct Function {
    /// Its name in Rust.
    pub(crate) name: &'static str,
    /// A call in C. The second argument of a function of one argument is the first once more, here and below.
    pub(crate) in_c: fn(&str, &str) -> String,
    value: fn(f64, f64) -> f64,
}

impl Term {
    fn value(&self, values: &ParameterValues, entry: usize) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Parameter(k) => number(values, *k, entry),
            Self::Negative(term) => -term.value(values, entry),
            Self::Arithmetic(operator, sides) => {
                let [a, b] = sides.each_ref().map(|side| side.value(values, entry));
                match operator {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    _ => a / b,
                }
            }
            Self::Call(function, arguments) => {
                let values: Vec<_> = arguments.iter().map(|argument| argument.value(values, entry)).collect();
                match values[..] {
                    [a] => (function.value)(a, a),
                    [a, b, ..] => (function.value)(a, b),
                    [] => f64::NAN,
                }
            }
        }
    }
}

impl Condition {
    pub(crate) fn new(declaration: &Declaration, condition: &Expr) -> Self {
        let place = |name: &dyn ToString| {
            let name = name.to_string();
            declaration.parameters.iter().position(|parameter| parameter.name == name)
        };
        // The parser lets nothing but comparisons through; NaN holds in none.
        let (comparison, sides) = match condition {
            Expr::Binary(binary) => {
                let comparison = match binary.op {
                    BinOp::Gt(_) => ">",
                    BinOp::Lt(_) => "<",
                    BinOp::Ge(_) => ">=",
                    BinOp::Le(_) => "<=",
                    _ => "!=",
                };
                (comparison, [&*binary.left, &*binary.right].map(|side| term(side, &place)))
            }
            _ => (">", [Term::Number(f64::NAN), Term::Number(f64::NAN)]),
        };
        let named = identifiers(condition.to_token_stream());
        let parameters = declaration.parameters.iter().enumerate();
        let names = parameters.filter(|(_, parameter)| named.contains(&parameter.name));
        Self {
            text: condition_text(condition).into(),
            sides,
            comparison,
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
        let [left, right] = self.sides.each_ref().map(|side| side.value(values, entry));
        match self.comparison {
            ">" => left > right,
            "<" => left < right,
            ">=" => left >= right,
            "<=" => left <= right,
            _ => left != right,
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

/// An expression as Rust evaluates it, with parameters by their places; NaN for text that the parser rejects.
fn term(expression: &Expr, place: &impl Fn(&dyn ToString) -> Option<usize>) -> Term {
    let read = |expression: &Expr| term(expression, place);
    let call = |name: &str, arguments: &[&Expr]| match FUNCTIONS.iter().find(|one| one.name == name) {
        Some(function) => Term::Call(function, arguments.iter().map(|&argument| read(argument)).collect()),
        None => Term::Number(f64::NAN),
    };
    match expression {
        Expr::Lit(number) => Term::Number(match &number.lit {
            Lit::Float(number) => number.base10_parse().unwrap_or(f64::NAN),
            Lit::Int(number) => number.base10_parse().unwrap_or(f64::NAN),
            _ => f64::NAN,
        }),
        Expr::Paren(inner) => read(&inner.expr),
        Expr::Group(inner) => read(&inner.expr),
        Expr::Index(index) => read(&index.expr),
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => Term::Negative(Box::new(read(&unary.expr))),
        Expr::Binary(binary) => {
            let operator = match binary.op {
                BinOp::Add(_) => '+',
                BinOp::Sub(_) => '-',
                BinOp::Mul(_) => '*',
                BinOp::Div(_) => '/',
                _ => return Term::Number(f64::NAN),
            };
            Term::Arithmetic(operator, Box::new([read(&binary.left), read(&binary.right)]))
        }
        Expr::Path(path) => match path.path.get_ident().and_then(|name| place(name)) {
            Some(k) => Term::Parameter(k),
            None => Term::Number(constant(&path.path)),
        },
        Expr::MethodCall(method) => match method.args.first() {
            Some(other) => call(&method.method.to_string(), &[&*method.receiver, other]),
            None => call(&method.method.to_string(), &[&*method.receiver]),
        },
        _ => Term::Number(f64::NAN),
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

macro_rules! functions {
    ($($name:literal $in_c:literal |$a:ident $(, $b:ident)?| $value:expr;)*) => {
        [$(Function {
            name: $name,
            in_c: |$a, functions!(@ $($b)?)| format!($in_c),
            value: |$a, functions!(@ $($b)?)| $value,
        }),*]
    };
    (@) => { _ };
    (@ $b:ident) => { $b };
}

static FUNCTIONS: [Function; 19] = functions! {
    "powi" "pow({a}, {b})" |a, b| a.powi(b as i32);
    "powf" "pow({a}, {b})" |a, b| a.powf(b);
    "log" "(log({a}) / log({b}))" |a, b| a.log(b);
    "ln" "log({a})" |a| a.ln();
    "log10" "log10({a})" |a| a.log10();
    "log2" "log2({a})" |a| a.log2();
    "exp" "exp({a})" |a| a.exp();
    "sqrt" "sqrt({a})" |a| a.sqrt();
    "cbrt" "cbrt({a})" |a| a.cbrt();
    "recip" "(1.0 / {a})" |a| a.recip();
    "ln_1p" "log1p({a})" |a| a.ln_1p();
    "exp_m1" "expm1({a})" |a| a.exp_m1();
    "sinh" "sinh({a})" |a| a.sinh();
    "cosh" "cosh({a})" |a| a.cosh();
    "tanh" "tanh({a})" |a| a.tanh();
    "asinh" "asinh({a})" |a| a.asinh();
    "sin" "sin({a})" |a| a.sin();
    "cos" "cos({a})" |a| a.cos();
    "atan" "atan({a})" |a| a.atan();
};
