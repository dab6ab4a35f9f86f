//! Expressions as a declaration writes them, for messages whose terms can be pasted.

use std::cell::Cell;

use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::read::parse::Declaration;

/// A node as the Rust of a declaration, such as `mu / 2.0 * (I1 - 3.0)`; `…` for what none can write.
#[must_use]
pub fn source(graph: &mut Graph, declaration: &Declaration, id: Id) -> String {
    printer(graph, declaration).print(id, Context::Sum)
}

/// The same to be multiplied: a sum is in parentheses.
#[must_use]
pub fn factor(graph: &mut Graph, declaration: &Declaration, id: Id) -> String {
    printer(graph, declaration).print(id, Context::Product)
}

fn printer<'a>(graph: &'a mut Graph, declaration: &'a Declaration) -> Printer<'a> {
    let stretches = [0, 1, 2].map(|i| graph.stretch(i));
    let squares = stretches.map(|stretch| graph.powi(stretch, 2));
    let pairs = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| graph.mul(squares[a], squares[b]));
    let volume = graph.product_of(&stretches);
    let invariants =
        [("I1", "I1b", -2, squares), ("I2", "I2b", -4, pairs)].map(|(name, isochoric, thirds, terms)| {
            Invariant { name, isochoric, thirds, terms, sum: graph.sum_of(&terms) }
        });
    Printer { graph, declaration, stretches, volume, invariants, budget: Cell::new(LONGEST) }
}

/// Nodes after which an expression is cut off: a graph can be exponentially smaller than what it stands for.
const LONGEST: usize = 400;

/// What stands around, to decide on parentheses.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Context {
    Sum,
    Product,
    /// To the right of `/`, or to the left of a method.
    Operand,
}

/// A sum that has a name, and so has its product with a power of J.
struct Invariant {
    name: &'static str,
    isochoric: &'static str,
    /// That power, in thirds.
    thirds: i128,
    terms: [Id; 3],
    sum: Id,
}

struct Printer<'a> {
    graph: &'a Graph,
    declaration: &'a Declaration,
    stretches: [Id; 3],
    /// J.
    volume: Id,
    invariants: [Invariant; 2],
    /// Nodes that may still be printed.
    budget: Cell<usize>,
}

impl Printer<'_> {
    fn print(&self, id: Id, context: Context) -> String {
        let Some(rest) = self.budget.get().checked_sub(1) else { return "…".to_owned() };
        self.budget.set(rest);
        match self.graph.node(id) {
            Node::Stretch(i) => self.declaration.stretches[*i].to_string(),
            Node::Parameter(k) => self.parameter(*k),
            Node::Entry(k) => format!("{}[p]", self.parameter(*k)),
            Node::Float(bits) => format!("{:?}", f64::from_bits(*bits)),
            Node::Linear { constant, terms } => self.linear(*constant, terms, context),
            Node::Product(factors) => self.product(factors, context),
            Node::Ln(a) => format!("{}.ln()", self.print(*a, Context::Operand)),
            Node::Exp(a) => format!("{}.exp()", self.print(*a, Context::Operand)),
            Node::Function(k, 0, a) => format!("{}({})", self.parameter(*k), self.print(*a, Context::Sum)),
            Node::Sum(_, body) => format!("sum(|p| {})", self.print(*body, Context::Sum)),
            _ => "…".to_owned(),
        }
    }

    fn parameter(&self, k: usize) -> String {
        self.declaration.parameters[k].name.to_string()
    }

    fn linear(&self, constant: Rational, terms: &[(Id, Rational)], context: Context) -> String {
        let mut terms = terms.to_vec();
        let mut parts = Vec::new();
        for Invariant { name, terms: named, .. } in &self.invariants {
            let coefficient = |id: &Id| terms.iter().find(|(term, _)| term == id).map(|&(_, c)| c);
            let shared =
                coefficient(&named[0]).filter(|&c| named.iter().all(|id| coefficient(id) == Some(c)));
            if let Some(c) = shared {
                terms.retain(|(term, _)| !named.contains(term));
                parts.push((c.is_negative(), multiple(c, (*name).to_owned())));
            }
        }
        for (term, c) in terms {
            parts.push((c.is_negative(), multiple(c, self.print(term, Context::Product))));
        }
        if !constant.is_zero() || parts.is_empty() {
            parts.push((constant.is_negative(), number(constant.magnitude())));
        }
        // What is added first reads better than what is subtracted.
        parts.sort_by_key(|&(is_negative, _)| is_negative);
        let is_operand = match &parts[..] {
            [(is_negative, text)] => !is_negative && !text.contains(' '),
            _ => false,
        };
        let is_sum = parts.len() > 1 || parts[0].0;
        let mut text = String::new();
        for (k, (is_negative, part)) in parts.into_iter().enumerate() {
            text.push_str(match (k, is_negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            });
            text.push_str(&part);
        }
        parenthesise(text, is_sum && context > Context::Sum || !is_operand && context == Context::Operand)
    }

    fn product(&self, factors: &[(Id, Exponent)], context: Context) -> String {
        let mut factors = factors.to_vec();
        let (mut above, mut below) = (Vec::new(), Vec::new());
        // Parameters come first, then what has a name.
        let is_parameter = |id| matches!(self.graph.node(id), Node::Parameter(_) | Node::Entry(_));
        factors.sort_by_key(|&(base, _)| !is_parameter(base));
        let mut named = Vec::new();
        for Invariant { isochoric, thirds, sum, .. } in &self.invariants {
            let volume = (self.volume, Rational::new(*thirds, 3).map_or(Exponent::ONE, Exponent::rational));
            let both = [(*sum, Exponent::ONE), volume];
            if both.iter().all(|factor| factors.contains(factor)) {
                factors.retain(|factor| !both.contains(factor));
                named.push(((*isochoric).to_owned(), Exponent::ONE));
            }
        }
        let exponent = |id: &Id| factors.iter().find(|(base, _)| base == id).map(|&(_, exponent)| exponent);
        let shared = exponent(&self.stretches[0])
            .filter(|&first| self.stretches.iter().all(|id| exponent(id) == Some(first)));
        if let Some(shared) = shared {
            factors.retain(|(base, _)| !self.stretches.contains(base));
            named.push(("J".to_owned(), shared));
        }
        let first = factors.iter().take_while(|&&(base, _)| is_parameter(base)).count();
        let printed = |&(base, exponent): &(Id, Exponent)| {
            let context = if exponent == Exponent::ONE { Context::Product } else { Context::Operand };
            (self.print(base, context), exponent)
        };
        let (parameters, others) = factors.split_at(first);
        for (text, exponent) in parameters.iter().map(printed).chain(named).chain(others.iter().map(printed))
        {
            match exponent.as_integer() {
                Some(n) if n < 0 => below.push(self.power(text, Exponent::integer(-n))),
                _ => above.push(self.power(text, exponent)),
            }
        }
        let is_operand = above.len() == 1 && below.is_empty();
        let numerator = if above.is_empty() { "1.0".to_owned() } else { above.join(" * ") };
        let text = below.iter().fold(numerator, |text, divisor| format!("{text} / {divisor}"));
        parenthesise(text, !is_operand && context == Context::Operand)
    }

    /// A power of what is an operand.
    fn power(&self, base: String, exponent: Exponent) -> String {
        let third = Rational::new(1, 3).map(Exponent::rational);
        let half = Rational::new(1, 2).map(Exponent::rational);
        match exponent.as_integer() {
            Some(1) => base,
            Some(n) if n.abs() <= 64 => format!("{base}.powi({n})"),
            _ if Some(exponent) == half => format!("{base}.sqrt()"),
            _ if Some(exponent) == third => format!("{base}.cbrt()"),
            _ => format!("{base}.powf({})", self.exponent(exponent)),
        }
    }

    fn exponent(&self, Exponent { real, rational }: Exponent) -> String {
        let shift = number(rational.magnitude());
        match (real.map(|real| self.print(real, Context::Sum)), rational) {
            (None, rational) if rational.is_negative() => format!("-{shift}"),
            (None, _) => shift,
            (Some(real), rational) if rational.is_zero() => real,
            (Some(real), rational) if rational.is_negative() => format!("{real} - {shift}"),
            (Some(real), _) => format!("{real} + {shift}"),
        }
    }
}

fn parenthesise(text: String, needed: bool) -> String {
    if needed { format!("({text})") } else { text }
}

/// A fraction that is not negative.
fn number(value: Rational) -> String {
    match value.denominator() {
        1 => format!("{}.0", value.numerator()),
        denominator => format!("{}.0 / {denominator}.0", value.numerator()),
    }
}

/// A product with the magnitude of its coefficient.
fn multiple(coefficient: Rational, text: String) -> String {
    let magnitude = coefficient.magnitude();
    let text = match (magnitude.numerator(), text.strip_prefix("1.0 / ")) {
        (1, _) => text,
        (numerator, Some(divisor)) => format!("{numerator}.0 / {divisor}"),
        (numerator, None) => format!("{numerator}.0 * {text}"),
    };
    match magnitude.denominator() {
        1 => text,
        denominator => format!("{text} / {denominator}.0"),
    }
}

#[cfg(test)]
mod tests {
    use quote::{ToTokens, quote};

    use super::*;
    use crate::read::diagnostics::Diagnostics;
    use crate::read::parse::parse;
    use crate::read::resolve::Resolver;

    /// The energy as text, and as text once more after that has been read.
    #[track_caller]
    fn check(energy: &str, expected: &str) {
        let read = |graph: &mut Graph, text: &str| {
            let body: syn::Expr = syn::parse_str(text).unwrap();
            let item = quote! {
                fn E<const N: usize>(
                    [l1, l2, l3]: [f64; 3], mu: f64, nu: f64, m: [f64; N], a: [f64; N], f: piola::Spline
                ) -> f64 {
                    #body
                }
            };
            let declaration = parse(quote!(), item.to_token_stream()).unwrap();
            let energy = Resolver::new(&declaration, graph, &mut Diagnostics::default()).energy();
            (source(graph, &declaration, energy), energy)
        };
        let mut graph = Graph::default();
        let (text, energy) = read(&mut graph, energy);
        assert_eq!(text, expected);
        assert_eq!(read(&mut graph, &text), (text.clone(), energy), "{text}");
    }

    #[test]
    fn what_is_written_can_be_read() {
        check("2 * mu + 4 * nu", "2.0 * mu + 4.0 * nu");
        check("-mu / 2 - nu", "-mu / 2.0 - nu");
        check("-(mu - nu) / 3", "(nu - mu) / 3.0");
        check("2 * (-mu).exp() * nu.powi(2)", "2.0 * nu.powi(2) * (-mu).exp()");
        check("mu / (2 * nu * (1 - nu))", "mu / nu / (1.0 - nu) / 2.0");
        check("2 / mu", "2.0 / mu");
        check(
            "(2 * mu).sqrt() + (mu * nu).cbrt() + 3.0.sqrt()",
            "(2.0 * mu).sqrt() + (mu * nu).cbrt() + 3.0.sqrt()",
        );
        check("(mu / nu).ln() + (1 / nu).exp()", "(mu / nu).ln() + (1.0 / nu).exp()");
        check("l1.powf(mu - 2) * l2.powf(-nu)", "l1.powf(mu - 2.0) * l2.powf(-nu)");
        check("sum(|p| m[p] * a[p]) + sum(|q| m[q]).powi(2)", "sum(|p| m[p] * a[p]) + sum(|p| m[p]).powi(2)");
        check("f(l1) * (I1 - 3) + 0.5 * I2 - J", "I2 / 2.0 + f(l1) * (I1 - 3.0) - J");
        check("mu * I1b * J.powi(-2) + J.ln() * (I2b - 3)", "mu * I1b / J.powi(2) + J.ln() * (I2b - 3.0)");
        check(
            "1 - mu * I1 / 3 + 1e-300 * J.powf(-2.0 / 3.0)",
            "J.powf(-2.0 / 3.0) * 1e-300 + 1.0 - mu * I1 / 3.0",
        );
    }
}
