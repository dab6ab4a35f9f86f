//! The values of the parameters of an interpreted material, at one point or at many.

use crate::lanes::Real;
use crate::univariate::Spline;

/// The values of all parameters, in the order of the declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterValues(Vec<Value>);

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, as one entry, or the entries of a list; whole exponents too.
    Numbers(Vec<f64>),
    /// A function.
    Function(Spline),
}

impl ParameterValues {
    /// One value for each parameter of the declaration.
    #[must_use]
    pub fn new(values: Vec<Value>) -> Self {
        Self(values)
    }

    /// The values, one for each parameter.
    #[must_use]
    pub fn all(&self) -> &[Value] {
        &self.0
    }

    /// Entry of a list, or the value of a number; NaN if there is none.
    #[inline(always)]
    pub(super) fn number(&self, parameter: usize, entry: usize) -> f64 {
        match self.0.get(parameter) {
            Some(Value::Numbers(numbers)) => numbers.get(entry).copied().unwrap_or(f64::NAN),
            _ => f64::NAN,
        }
    }

    /// The number of entries of a list.
    pub(super) fn length(&self, parameter: usize) -> usize {
        match self.0.get(parameter) {
            Some(Value::Numbers(numbers)) => numbers.len(),
            _ => 0,
        }
    }

    /// True if both differ in real numbers only, so that lanes can hold values of both.
    pub(super) fn are_alike(&self, other: &Self, is_whole: &[bool]) -> bool {
        let mut pairs = self.0.iter().zip(&other.0).zip(is_whole);
        pairs.all(|((one, other), &is_whole)| match (one, other) {
            (Value::Numbers(one), Value::Numbers(other)) if !is_whole => one.len() == other.len(),
            (one, other) => one == other,
        })
    }
}

/// The parameters of the materials at all points of a program.
#[derive(Clone, Copy)]
pub(super) struct Parameters<'a> {
    /// Values of one of the points; lengths, functions and whole exponents are the same at all points.
    pub(super) some: &'a ParameterValues,
    /// Values of each point if these differ, in real numbers only.
    pub(super) each: Option<&'a dyn Fn(usize) -> &'a ParameterValues>,
    /// The number of points side by side in a group.
    pub(super) lanes: usize,
    /// The first point of the first group.
    pub(super) start: usize,
}

impl<'a> Parameters<'a> {
    /// ParameterValues that are the same at all points.
    pub(super) fn same(values: &'a ParameterValues) -> Self {
        Self { some: values, each: None, lanes: 1, start: 0 }
    }

    /// An entry of a list, or a number, at a group of points.
    #[inline(always)]
    pub(super) fn number<R: Real>(&self, parameter: usize, entry: usize, group: usize) -> R {
        match self.each {
            None => R::splat(self.some.number(parameter, entry)),
            Some(each) => {
                R::from_fn(|lane| each(self.start + group * self.lanes + lane).number(parameter, entry))
            }
        }
    }

    /// A whole exponent, or the entry of a list of them.
    pub(super) fn whole(&self, parameter: usize, entry: usize) -> u32 {
        let entry = if self.length(parameter) == 1 { 0 } else { entry };
        self.some.number(parameter, entry) as u32
    }

    /// A function, if the parameter is one.
    pub(super) fn function(&self, parameter: usize) -> Option<&'a Spline> {
        match self.some.all().get(parameter) {
            Some(Value::Function(function)) => Some(function),
            _ => None,
        }
    }

    /// The number of entries of a list.
    pub(super) fn length(&self, parameter: usize) -> usize {
        self.some.length(parameter)
    }
}

/// Parameters, the entry of lists that a program reads outside of sums, and the threshold of an extension.
#[derive(Clone, Copy)]
pub(super) struct Context<'a> {
    /// The number of the material, if the program is its own.
    pub(super) material: Option<u64>,
    pub(super) parameters: Parameters<'a>,
    pub(super) entry: usize,
    pub(super) epsilon: f64,
}
