//! Conditions of a declaration on its parameters, as data that the constructors of compiled and of
//! interpreted materials check.

use std::borrow::Cow;

use super::{Argument, Parameter, Text};

/// A comparison in parameters, such as `mu[p] * alpha[p] > 0`, which holds for every entry of its lists.
#[derive(Clone, Debug)]
pub struct Condition {
    /// The comparison in the usual notation.
    pub text: Text,
    /// Both sides.
    pub sides: [Term; 2],
    /// `>`, `<`, `>=`, `<=` or `!=`.
    pub comparison: &'static str,
    /// A list by whose entries it is written, by its place in the declaration.
    pub list: Option<usize>,
    /// The parameters that it names, by their places in the declaration.
    pub names: Cow<'static, [usize]>,
}

/// An expression in parameters, and in the current entry of those that are lists.
#[derive(Clone, Debug)]
pub enum Term {
    /// A number.
    Number(f64),
    /// A parameter, by its place in the declaration.
    Parameter(usize),
    /// An operator or a method of `f64`, by its name, and its operands; the receiver is the first.
    Call(Text, Cow<'static, [Self]>),
}

impl Condition {
    /// The parameters that it names, those of the first entry for which it does not hold; `None` if it always
    /// does. There is one slice of values for each parameter.
    pub(super) fn violation(&self, parameters: &[Parameter], values: &[&[f64]]) -> Option<Vec<Argument>> {
        let entries = self.list.map_or(1, |list| values.get(list).map_or(0, |entries| entries.len()));
        let entry = (0..entries).find(|&entry| !self.holds(values, entry))?;
        let named = self.names.iter().filter_map(|&k| Some((parameters.get(k)?, number(values, k, entry))));
        Some(named.map(|(parameter, value)| argument(parameter, entry, value)).collect())
    }

    fn holds(&self, values: &[&[f64]], entry: usize) -> bool {
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

impl Term {
    fn value(&self, values: &[&[f64]], entry: usize) -> f64 {
        let value = |term: &Self| term.value(values, entry);
        match self {
            Self::Number(number) => *number,
            Self::Parameter(k) => number(values, *k, entry),
            Self::Call(name, operands) => match &operands[..] {
                [a] => unary(name, value(a)),
                [a, b] => binary(name, value(a), value(b)),
                _ => f64::NAN,
            },
        }
    }
}

/// The value of a parameter: an entry of a list, or a number, which has one.
pub(super) fn number(values: &[&[f64]], parameter: usize, entry: usize) -> f64 {
    let entries = values.get(parameter).copied().unwrap_or_default();
    entries.get(entry).or(entries.first()).copied().unwrap_or(f64::NAN)
}

/// A parameter as given, with its place if it is an entry of a list.
pub(super) fn argument(parameter: &Parameter, index: usize, value: f64) -> Argument {
    Argument { parameter: parameter.name.clone(), index: parameter.is_list().then_some(index), value }
}

/// A method of one number; NaN for one that conditions do not have.
fn unary(name: &str, a: f64) -> f64 {
    match name {
        "-" => -a,
        "ln" => a.ln(),
        "log10" => a.log10(),
        "log2" => a.log2(),
        "exp" => a.exp(),
        "sqrt" => a.sqrt(),
        "cbrt" => a.cbrt(),
        "recip" => a.recip(),
        "ln_1p" => a.ln_1p(),
        "exp_m1" => a.exp_m1(),
        "sinh" => a.sinh(),
        "cosh" => a.cosh(),
        "tanh" => a.tanh(),
        "asinh" => a.asinh(),
        "sin" => a.sin(),
        "cos" => a.cos(),
        "atan" => a.atan(),
        _ => f64::NAN,
    }
}

/// An operator, or a method with one argument; NaN for one that conditions do not have.
fn binary(name: &str, a: f64, b: f64) -> f64 {
    match name {
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        "/" => a / b,
        "powi" => a.powi(b as i32),
        "powf" => a.powf(b),
        "log" => a.log(b),
        _ => f64::NAN,
    }
}
