//! The values of the parameters of an interpreted material, at one point or at many.

use crate::lanes::Real;
use crate::univariate::Spline;

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, as one entry, or the entries of a list; whole exponents too.
    Numbers(Vec<f64>),
    /// A function, which is defined everywhere and so ends no domain.
    Function(Spline),
}

impl Value {
    /// The entries of a list, or a number as one; none of a function.
    #[must_use]
    #[inline(always)]
    pub fn numbers(&self) -> &[f64] {
        match self {
            Self::Numbers(numbers) => numbers,
            Self::Function(_) => &[],
        }
    }
}

/// Entry of a list, or the value of a number; NaN if there is none.
#[inline(always)]
pub(super) fn number(values: &[Value], parameter: usize, entry: usize) -> f64 {
    values.get(parameter).and_then(|value| value.numbers().get(entry)).copied().unwrap_or(f64::NAN)
}

/// True if the values of two materials differ in real numbers only, so that lanes can hold both.
pub(super) fn are_alike(one: &[Value], other: &[Value], is_whole: &[bool]) -> bool {
    let mut pairs = one.iter().zip(other).zip(is_whole);
    pairs.all(|((one, other), &is_whole)| match (one, other) {
        (Value::Numbers(one), Value::Numbers(other)) if !is_whole => one.len() == other.len(),
        (one, other) => one == other,
    })
}

/// The parameters of the materials at all points of a program.
#[derive(Clone, Copy)]
pub(super) struct Parameters<'a> {
    /// Values of one of the points; lengths, functions and whole exponents are the same at all points.
    pub(super) some: &'a [Value],
    /// Values of each point if these differ, in real numbers only.
    pub(super) each: Option<&'a dyn Fn(usize) -> &'a [Value]>,
    /// The number of points side by side in a group.
    pub(super) lanes: usize,
    /// The first point of the first group.
    pub(super) start: usize,
}

impl<'a> Parameters<'a> {
    /// Values that are the same at all points.
    pub(super) fn same(values: &'a [Value]) -> Self {
        Self { some: values, each: None, lanes: 1, start: 0 }
    }

    /// An entry of a list, or a number, at a group of points.
    #[inline(always)]
    pub(super) fn number<R: Real>(&self, parameter: usize, entry: usize, group: usize) -> R {
        match self.each {
            None => R::splat(number(self.some, parameter, entry)),
            Some(each) => {
                R::from_fn(|lane| number(each(self.start + group * self.lanes + lane), parameter, entry))
            }
        }
    }

    /// A whole exponent, or the entry of a list of them.
    pub(super) fn whole(&self, parameter: usize, entry: usize) -> u32 {
        let entry = if self.length(parameter) == 1 { 0 } else { entry };
        number(self.some, parameter, entry) as u32
    }

    /// A function, if the parameter is one.
    pub(super) fn function(&self, parameter: usize) -> Option<&'a Spline> {
        match self.some.get(parameter) {
            Some(Value::Function(function)) => Some(function),
            _ => None,
        }
    }

    /// The number of entries of a list.
    pub(super) fn length(&self, parameter: usize) -> usize {
        self.some.get(parameter).map_or(0, |value| value.numbers().len())
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
