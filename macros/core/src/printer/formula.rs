//! Expressions as one line of Unicode, for documentation and messages.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;

use crate::algebra::expr::{Exponent, Extended, Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::read::parse::Declaration;

mod shared;

pub use shared::{Formulas, formulas, formulas_by_invariants};

/// A node as a formula, such as `1/2 μ (I1 − 3) − μ ln J`.
#[must_use]
pub fn formula(graph: &mut Graph, declaration: &Declaration, id: Id) -> String {
    by_stretches(graph, declaration).line(id)
}

fn by_stretches<'a>(graph: &'a mut Graph, declaration: &'a Declaration) -> Printer<'a> {
    let stretches = [0, 1, 2].map(|i| graph.stretch(i));
    let squares = stretches.map(|stretch| graph.powi(stretch, 2));
    let pairs = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| graph.mul(squares[a], squares[b]));
    let volume = graph.product_of(&stretches);
    let names = ["λ₁", "λ₂", "λ₃"];
    // Sums of products of stretches with one exponent for the k-th, and another for the rest.
    let mut isochoric = |one: i128, rest: i128| {
        let [one, rest] =
            [one, rest].map(|thirds| Rational::new(thirds, 3).map_or(Exponent::ONE, Exponent::rational));
        let factors = |k| [0, 1, 2].map(|i| (stretches[i], if i == k { one } else { rest }));
        [0, 1, 2].map(|k| graph.product(&factors(k))).to_vec()
    };
    let invariants = vec![
        ("I1", squares.to_vec()),
        ("I2", pairs.to_vec()),
        ("I1 J^(−2/3)", isochoric(4, -2)),
        ("I2 J^(−4/3)", isochoric(-4, 2)),
    ];
    let volume = Some(Volume { stretches, product: volume });
    Printer { volume, invariants, ..Printer::new(graph, declaration, names) }
}

fn by_invariants<'a>(graph: &'a Graph, declaration: &'a Declaration) -> Printer<'a> {
    Printer::new(graph, declaration, ["I1", "I2", "J"])
}

/// Nodes after which a formula is cut off: a graph can be exponentially smaller than what it stands for.
const LONGEST: usize = 400;

/// What stands around, to decide on parentheses.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Context {
    Sum,
    Product,
    Power,
}

/// J.
struct Volume {
    stretches: [Id; 3],
    product: Id,
}

struct Printer<'a> {
    graph: &'a Graph,
    declaration: &'a Declaration,
    /// What the three stretches are called.
    names: [&'static str; 3],
    volume: Option<Volume>,
    /// Sums that have a name, by their terms.
    invariants: Vec<(&'static str, Vec<Id>)>,
    /// Nodes that may still be printed.
    budget: Cell<usize>,
    /// Nodes that stand under a name, and how often each has done so.
    named: HashMap<Id, String>,
    uses: RefCell<HashMap<Id, usize>>,
}

impl<'a> Printer<'a> {
    fn new(graph: &'a Graph, declaration: &'a Declaration, names: [&'static str; 3]) -> Self {
        Self {
            graph,
            declaration,
            names,
            volume: None,
            invariants: Vec::new(),
            budget: Cell::new(LONGEST),
            named: HashMap::new(),
            uses: RefCell::default(),
        }
    }

    fn line(&self, id: Id) -> String {
        self.budget.set(LONGEST);
        self.print(id, Context::Sum)
    }

    fn print(&self, id: Id, context: Context) -> String {
        if self.volume.as_ref().is_some_and(|volume| volume.product == id) {
            return "J".to_owned();
        }
        if let Some(name) = self.named.get(&id) {
            *self.uses.borrow_mut().entry(id).or_default() += 1;
            return name.clone();
        }
        let Some(rest) = self.budget.get().checked_sub(1) else { return "…".to_owned() };
        self.budget.set(rest);
        match self.graph.node(id) {
            Node::Stretch(i) => self.names[*i].to_owned(),
            Node::Strain(i) => format!("(λ{} − 1)", subscript(i + 1)),
            Node::Parameter(k) => symbol(&self.declaration.parameters[*k].name.to_string()),
            Node::Entry(k) => format!("{}ₚ", symbol(&self.declaration.parameters[*k].name.to_string())),
            Node::Float(bits) => f64::from_bits(*bits).to_string(),
            Node::Linear { constant, terms } => self.linear(*constant, terms, context),
            Node::Product(factors) => self.product(factors, context),
            Node::Ln(a) => self.function("ln", *a, context),
            Node::Exp(a) => self.function("exp", *a, context),
            Node::Function(k, order, a) => {
                let name = symbol(&self.declaration.parameters[*k].name.to_string());
                format!("{name}{}({})", "′".repeat(usize::from(*order)), self.print(*a, Context::Sum))
            }
            Node::FunctionQuotient(k, order, a, b) => {
                let name = symbol(&self.declaration.parameters[*k].name.to_string());
                self.quotient(&format!("{name}{}", "′".repeat(usize::from(*order))), *a, *b)
            }
            Node::Sum(_, body) => {
                parenthesise(format!("Σₚ {}", self.print(*body, Context::Product)), context >= Context::Power)
            }
            Node::Epsilon => "ε".to_owned(),
            Node::Above(i) => format!("max(λ{}, ε)", subscript(i + 1)),
            Node::Below(i) => format!("min(λ{} − ε, 0)", subscript(i + 1)),
            Node::ShareAbove(i, j) => format!("above(λ{}, λ{})", subscript(i + 1), subscript(j + 1)),
            Node::ShareBelow(i, j) => format!("below(λ{}, λ{})", subscript(i + 1), subscript(j + 1)),
            Node::Extended(function, order, i) => {
                let name = match function {
                    Extended::Ln => "ln".to_owned(),
                    Extended::Power(e) => format!("pow{}", self.exponent(*e)),
                };
                format!("{name}{}(λ{})", "′".repeat(usize::from(*order)), subscript(i + 1))
            }
            Node::WhereNegative(condition, a, b) => {
                let [condition, a, b] = [condition, a, b].map(|&id| self.print(id, Context::Sum));
                format!("({condition} < 0 ? {a} : {b})")
            }
            Node::LnQuotient(a, b) => self.quotient("ln", *a, *b),
            Node::ExpQuotient(a, b) => self.quotient("exp", *a, *b),
            Node::PowerQuotient(a, b, e) => self.quotient(&format!("pow{}", self.exponent(*e)), *a, *b),
            Node::PoleQuotient(a, b) => {
                format!("{}/{}", self.print(*a, Context::Power), self.print(*b, Context::Power))
            }
        }
    }

    fn quotient(&self, name: &str, a: Id, b: Id) -> String {
        format!("{name}[{}, {}]", self.print(a, Context::Sum), self.print(b, Context::Sum))
    }

    fn function(&self, name: &str, argument: Id, context: Context) -> String {
        let inner = self.print(argument, Context::Sum);
        let call = if inner.chars().any(|c| " +−/^".contains(c)) {
            format!("{name}({inner})")
        } else {
            format!("{name} {inner}")
        };
        parenthesise(call, context >= Context::Power)
    }

    fn linear(&self, constant: Rational, terms: &[(Id, Rational)], context: Context) -> String {
        let mut terms = terms.to_vec();
        let mut parts: Vec<(bool, String)> = Vec::new();
        for (name, squares) in &self.invariants {
            let coefficient = |id: &Id| terms.iter().find(|(term, _)| term == id).map(|&(_, c)| c);
            let shared =
                coefficient(&squares[0]).filter(|&c| squares.iter().all(|id| coefficient(id) == Some(c)));
            if let Some(c) = shared {
                terms.retain(|(term, _)| !squares.contains(term));
                parts.push((c.is_negative(), multiple(c, (*name).to_owned())));
            }
        }
        for (term, c) in terms {
            let inner = self.print(term, if c == Rational::ONE { Context::Sum } else { Context::Product });
            parts.push((c.is_negative(), multiple(c, inner)));
        }
        let (is_sum, text) = signed(parts, constant);
        let is_fraction = !is_sum && text.contains('/');
        parenthesise(text, is_sum && context > Context::Sum || is_fraction && context >= Context::Power)
    }

    fn product(&self, factors: &[(Id, Exponent)], context: Context) -> String {
        // Parameters, then plain factors, then sums; denominators last.
        let rank = |&(base, exponent): &(Id, Exponent)| {
            let is_denominator = exponent.as_integer().is_some_and(|n| n < 0);
            let kind = match self.graph.node(base) {
                Node::Parameter(_) | Node::Entry(_) => 0,
                Node::Linear { .. } => 1,
                Node::Stretch(_) => 2,
                _ => 3,
            };
            (is_denominator, kind)
        };
        let mut sorted = self.with_volume(factors);
        sorted.sort_by_key(rank);
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for factor @ (base, exponent) in sorted {
            match exponent.as_integer() {
                Some(n) if rank(&factor).0 => below.push(self.power(base, Exponent::integer(-n))),
                _ => above.push(self.power(base, exponent)),
            }
        }
        let numerator = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
        let text = match &below[..] {
            [] => numerator,
            [single] => format!("{numerator}/{single}"),
            several => format!("{numerator}/({})", several.join(" ")),
        };
        parenthesise(text, context >= Context::Power)
    }

    /// The same with a power of J for powers of the three stretches, which those of J become in the graph: for equal ones, and
    /// for fractions that whole powers of stretches are left of, λ₁^(4/3) λ₂^(−2/3) λ₃^(−2/3) being J^(−2/3) λ₁².
    fn with_volume(&self, factors: &[(Id, Exponent)]) -> Vec<(Id, Exponent)> {
        let mut factors = factors.to_vec();
        let Some(Volume { stretches, product }) = &self.volume else { return factors };
        let exponent = |id: &Id| factors.iter().find(|(base, _)| base == id).map(|&(_, exponent)| exponent);
        let exponents: Vec<_> = stretches.iter().filter_map(exponent).collect();
        let Ok(exponents) = <[Exponent; 3]>::try_from(exponents) else { return factors };
        let Some((shared, left)) = shared_power(exponents) else { return factors };
        factors.retain(|(base, _)| !stretches.contains(base));
        factors.push((*product, shared));
        let left = stretches.iter().zip(left).filter(|(_, n)| *n != 0);
        factors.extend(left.map(|(&stretch, n)| (stretch, Exponent::integer(n))));
        factors
    }

    fn power(&self, base: Id, exponent: Exponent) -> String {
        if exponent == Exponent::ONE {
            // What follows a sum would seem to belong to it.
            let is_sum = matches!(self.graph.node(base), Node::Sum(..));
            return self.print(base, if is_sum { Context::Power } else { Context::Product });
        }
        format!("{}{}", self.print(base, Context::Power), self.exponent(exponent))
    }

    fn exponent(&self, exponent: Exponent) -> String {
        match exponent.as_integer() {
            Some(n) => superscript(n),
            None => {
                let mut text = exponent.real.map(|real| self.print(real, Context::Sum)).unwrap_or_default();
                let Exponent { rational, .. } = exponent;
                if text.is_empty() {
                    text =
                        format!("{}{}", if rational.is_negative() { "−" } else { "" }, magnitude(rational));
                } else if !rational.is_zero() {
                    text = format!(
                        "{text} {} {}",
                        if rational.is_negative() { "−" } else { "+" },
                        magnitude(rational)
                    );
                }
                if text.chars().count() <= 3 && !text.contains(['/', ' ']) {
                    format!("^{text}")
                } else {
                    format!("^({text})")
                }
            }
        }
    }
}

/// The power of J in powers of the three stretches, and which whole ones are left.
fn shared_power(exponents: [Exponent; 3]) -> Option<(Exponent, [i64; 3])> {
    let [a, b, c] = exponents;
    if a == b && b == c {
        return Some((a, [0; 3]));
    }
    if exponents.iter().any(|exponent| exponent.real.is_some() || exponent.as_integer().is_some()) {
        return None;
    }
    let mut sorted = exponents.map(|exponent| exponent.rational);
    sorted.sort_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    let [_, shared, _] = sorted;
    let left = exponents.map(|exponent| exponent.rational.checked_add(shared.negated())?.as_integer());
    let [Some(a), Some(b), Some(c)] = left else { return None };
    Some((Exponent::rational(shared), [a, b, c]))
}

/// Σ coefficient · name + constant.
#[must_use]
pub fn combination(terms: &[(&str, Rational)], constant: Rational) -> String {
    let terms = terms.iter().filter(|(_, coefficient)| !coefficient.is_zero());
    let parts = terms.map(|&(name, c)| (c.is_negative(), multiple(c, name.to_owned()))).collect();
    let (_, text) = signed(parts, constant);
    text
}

/// Terms, each with whether it is subtracted, and a constant: whether that is more than one term without sign, and its text.
fn signed(parts: Vec<(bool, String)>, constant: Rational) -> (bool, String) {
    // Σ first reads better than − first.
    let (subtracted, mut parts): (Vec<_>, Vec<_>) = parts.into_iter().partition(|part| part.0);
    parts.extend(subtracted);
    if !constant.is_zero() || parts.is_empty() {
        parts.push((constant.is_negative(), magnitude(constant)));
    }
    let is_sum = parts.len() > 1 || parts[0].0;
    let mut text = String::new();
    for (k, (is_negative, part)) in parts.into_iter().enumerate() {
        text.push_str(match (k, is_negative) {
            (0, false) => "",
            (0, true) => "−",
            (_, false) => " + ",
            (_, true) => " − ",
        });
        text.push_str(&part);
    }
    (is_sum, text)
}

fn parenthesise(text: String, needed: bool) -> String {
    if needed { format!("({text})") } else { text }
}

fn magnitude(number: Rational) -> String {
    (if number.is_negative() { number.negated() } else { number }).to_string()
}

fn multiple(coefficient: Rational, text: String) -> String {
    match magnitude(coefficient).as_str() {
        "1" => text,
        number => format!("{number} {text}"),
    }
}

fn subscript(n: usize) -> char {
    ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'].get(n).copied().unwrap_or('?')
}

fn superscript(n: i64) -> String {
    n.to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '0' => '⁰',
            digit => char::from_u32(digit as u32 - '4' as u32 + '⁴' as u32).unwrap_or(digit),
        })
        .collect()
}

/// Greek letters by their names, alone or before an underscore or digits.
fn symbol(name: &str) -> String {
    const GREEK: [(&str, &str); 14] = [
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("delta", "δ"),
        ("epsilon", "ε"),
        ("eta", "η"),
        ("theta", "θ"),
        ("kappa", "κ"),
        ("lambda", "λ"),
        ("mu", "μ"),
        ("nu", "ν"),
        ("rho", "ρ"),
        ("tau", "τ"),
        ("omega", "ω"),
    ];
    let (head, tail) =
        name.split_at(name.find(|c: char| c == '_' || c.is_ascii_digit()).unwrap_or(name.len()));
    match GREEK.iter().find(|(word, _)| *word == head) {
        Some((_, letter)) => format!("{letter}{tail}"),
        None => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use super::*;
    use crate::model::model;
    use crate::read::parse::parse;

    #[test]
    fn formulas_read_like_the_declaration() {
        let item = quote! {
            fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; N], kappa: f64) -> f64 {
                sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0))
                    - sum(|p| mu[p]) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2) + kappa * (I1b - 3.0)
            }
        };
        let declaration = parse(quote!(domain(J > 0.0)), item).unwrap();
        let mut model = model(&declaration).unwrap();
        let mut print = |id| formula(&mut model.graph, &declaration, id);
        assert_eq!(
            print(model.energy),
            "Σₚ μₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3)/αₚ + 1/2 κ (J − 1)² + κ (I1 J^(−2/3) − 3) − (Σₚ μₚ) ln J"
        );
        assert_eq!(model.moduli.map(&mut print), ["2 κ + 1/2 Σₚ μₚ αₚ", "−1/3 κ"]);
    }

    #[test]
    fn moduli_gather_powers_of_numbers() {
        let item = quote! {
            fn E([l1, l2, l3]: [f64; 3], A: f64, n: f64) -> f64 { A * (I1.powf(n) + (I2 / J.powi(2)).powf(n)) }
        };
        let declaration = parse(quote!(domain(J > 0.0)), item).unwrap();
        let mut model = model(&declaration).unwrap();
        let moduli = model.moduli.map(|modulus| formula(&mut model.graph, &declaration, modulus));
        assert_eq!(moduli, ["4/3 A n 3^n", "8/9 A n² 3^n − 8/9 A n 3^n"]);
    }

    #[test]
    fn powers_of_the_volume_are_printed_as_such() {
        let check = |energy: &str, expected: &str| {
            let body: syn::Expr = syn::parse_str(energy).unwrap();
            let item = quote!(fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu * (#body) });
            let declaration = parse(quote!(domain(J > 0.0), prestressed), item).unwrap();
            let mut model = model(&declaration).unwrap();
            assert_eq!(formula(&mut model.graph, &declaration, model.energy), expected);
        };
        check("I1 + J.powi(2) - 2 * J", "μ (I1 + J² − 2 J)");
        check("I1 / J", "μ I1/J");
        check("I1 + I2 / J.powi(2)", "μ (I1 + I2/J²)");
        check("(I2 / J.powi(2)).powf(mu)", "μ (I2/J²)^μ");
        check("J.powi(2).powf(mu) + l1 * l2 + l2 * l3 + l3 * l1", "μ ((J²)^μ + λ₁ λ₂ + λ₂ λ₃ + λ₁ λ₃)");
    }
}
