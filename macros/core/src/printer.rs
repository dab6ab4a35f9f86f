//! Expressions as text: Unicode formulas for documentation, and Rust for messages whose terms can be pasted.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;

use crate::algebra::expr::{Exponent, Function, Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::read::notation::plain_name;
use crate::read::parse::Declaration;
use crate::read::spelling::greek;

mod shared;

pub use shared::{Formulas, formulas, formulas_by_invariants};

/// A node as a formula, such as `1/2 μ (I1 − 3) − μ ln J`.
#[must_use]
pub fn formula(graph: &mut Graph, declaration: &Declaration, id: Id) -> String {
    Printer::by_stretches(graph, declaration, Notation::Formula).print(id, Context::Sum)
}

/// A node as Rust, such as `mu / 2.0 * (I1 - 3.0)`, with `…` for nodes that a declaration cannot contain.
#[must_use]
pub fn rust(graph: &mut Graph, declaration: &Declaration, id: Id) -> String {
    Printer::by_stretches(graph, declaration, Notation::Rust).print(id, Context::Sum)
}

/// A node as a factor of a product in Rust: a sum is in parentheses.
pub(crate) fn rust_factor(graph: &mut Graph, declaration: &Declaration, id: Id) -> String {
    Printer::by_stretches(graph, declaration, Notation::Rust).print(id, Context::Product)
}

/// Maximum number of nodes of a text before it is cut off: a graph can be exponentially smaller than the
/// formula that it stands for.
const LONGEST: usize = 400;

/// The surroundings of a text, which decide on parentheses.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Context {
    Sum,
    Product,
    /// The base of a power, the receiver of a method.
    Power,
}

#[derive(Clone, Copy, PartialEq)]
enum Notation {
    Formula,
    Rust,
}

impl Notation {
    /// The magnitude of a fraction.
    fn number(self, value: Rational) -> String {
        let value = value.magnitude();
        match (self, value.denominator()) {
            (Self::Formula, _) => value.to_string(),
            (Self::Rust, 1) => format!("{}.0", value.numerator()),
            (Self::Rust, denominator) => format!("{}.0 / {denominator}.0", value.numerator()),
        }
    }

    /// A product with the magnitude of a coefficient.
    fn multiple(self, coefficient: Rational, text: &str) -> String {
        let magnitude = coefficient.magnitude();
        let (numerator, denominator) = (magnitude.numerator(), magnitude.denominator());
        if magnitude == Rational::ONE {
            return text.to_owned();
        }
        if self == Self::Formula {
            return format!("{magnitude} {text}");
        }
        let text = match (numerator, text.strip_prefix("1.0 / ")) {
            (1, _) => text.to_owned(),
            (_, Some(divisor)) => format!("{numerator}.0 / {divisor}"),
            (_, None) => format!("{numerator}.0 * {text}"),
        };
        if denominator == 1 { text } else { format!("{text} / {denominator}.0") }
    }

    /// Text of a sum, with true if it has an operator; each term comes with true if it is subtracted.
    fn sum(self, mut parts: Vec<(bool, String)>, constant: Rational) -> (bool, String) {
        if !constant.is_zero() || parts.is_empty() {
            parts.push((constant.is_negative(), self.number(constant)));
        }
        // Added terms first read better than subtracted ones.
        parts.sort_by_key(|&(is_negative, _)| is_negative);
        let is_sum = parts.len() > 1 || parts[0].0;
        let minus = if self == Self::Formula { "−" } else { "-" };
        let mut text = String::new();
        for (k, (is_negative, part)) in parts.into_iter().enumerate() {
            text += &match (k, is_negative) {
                (0, false) => part,
                (0, true) => format!("{minus}{part}"),
                (_, false) => format!(" + {part}"),
                (_, true) => format!(" {minus} {part}"),
            };
        }
        (is_sum, text)
    }
}

type Factor = (Id, Exponent);

struct Printer<'a> {
    graph: &'a Graph,
    declaration: &'a Declaration,
    notation: Notation,
    /// The names of the three stretches.
    stretches: [String; 3],
    /// The three stretches and J.
    volume: Option<([Id; 3], Id)>,
    /// Sums that have a name, by their terms.
    sums: Vec<(&'static str, [Id; 3])>,
    /// Products that have a name, by their factors.
    products: Vec<(&'static str, Id, [Factor; 2])>,
    /// Nodes that may still be printed.
    budget: Cell<usize>,
    /// Nodes that are printed by a name, and how often each has been.
    named: HashMap<Id, String>,
    uses: RefCell<HashMap<Id, usize>>,
}

impl<'a> Printer<'a> {
    fn new(
        graph: &'a Graph,
        declaration: &'a Declaration,
        notation: Notation,
        stretches: [String; 3],
    ) -> Self {
        Self {
            graph,
            declaration,
            notation,
            stretches,
            volume: None,
            sums: Vec::new(),
            products: Vec::new(),
            budget: Cell::new(LONGEST),
            named: HashMap::new(),
            uses: RefCell::default(),
        }
    }

    fn by_stretches(graph: &'a mut Graph, declaration: &'a Declaration, notation: Notation) -> Self {
        let stretches = [0, 1, 2].map(|i| graph.stretch(i));
        let squares = stretches.map(|stretch| graph.powi(stretch, 2));
        let pairs = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| graph.mul(squares[a], squares[b]));
        let volume = graph.product_of(&stretches);
        let thirds = |n| Rational::new(n, 3).map_or(Exponent::ONE, Exponent::rational);
        let names = match notation {
            Notation::Formula => [0, 1, 2].map(|i| format!("λ{}", subscript(i + 1))),
            Notation::Rust => declaration.stretches.each_ref().map(ToString::to_string),
        };
        let (mut sums, mut products) = (vec![("I1", squares), ("I2", pairs)], Vec::new());
        if notation == Notation::Formula {
            // Sums of products of stretches with one exponent for the k-th, and another one for the others.
            let mut isochoric = |one, other| {
                let factors = |k| [0, 1, 2].map(|i| (stretches[i], thirds(if i == k { one } else { other })));
                [0, 1, 2].map(|k| graph.product(&factors(k)))
            };
            sums.extend([("I1 J^(−2/3)", isochoric(4, -2)), ("I2 J^(−4/3)", isochoric(-4, 2))]);
        } else {
            let mut isochoric = |name, terms: &[Id], exponent| {
                let factors = [(graph.sum_of(terms), Exponent::ONE), (volume, exponent)];
                (name, graph.product(&factors), factors)
            };
            products = vec![isochoric("I1b", &squares, thirds(-2)), isochoric("I2b", &pairs, thirds(-4))];
        }
        Self {
            volume: Some((stretches, volume)),
            sums,
            products,
            ..Self::new(graph, declaration, notation, names)
        }
    }

    fn line(&self, id: Id) -> String {
        self.budget.set(LONGEST);
        self.print(id, Context::Sum)
    }

    fn print(&self, id: Id, context: Context) -> String {
        if self.volume.is_some_and(|(_, volume)| volume == id) {
            return "J".to_owned();
        }
        if let Some((name, ..)) = self.products.iter().find(|&&(_, product, _)| product == id) {
            return (*name).to_owned();
        }
        if let Some(name) = self.named.get(&id) {
            *self.uses.borrow_mut().entry(id).or_default() += 1;
            return name.clone();
        }
        let Some(rest) = self.budget.get().checked_sub(1) else { return "…".to_owned() };
        self.budget.set(rest);
        let is_formula = self.notation == Notation::Formula;
        match self.graph.node(id) {
            Node::Stretch(i) => self.stretches[*i].clone(),
            Node::Parameter(k) => self.parameter(*k),
            Node::Entry(k) => format!("{}{}", self.parameter(*k), if is_formula { "ₚ" } else { "[p]" }),
            Node::Float(bits) => format!("{:?}", f64::from_bits(*bits)),
            Node::Linear { constant, terms } => self.linear(*constant, terms, context),
            Node::Product(factors) => self.product(factors, context),
            Node::Excess(_, written) | Node::Accurate(_, written) => self.print(*written, context),
            Node::Apply(function @ Function::Given(_, order), a) if is_formula || *order == 0 => {
                format!("{}({})", self.name(*function), self.print(*a, Context::Sum))
            }
            Node::Apply(Function::WholePower(n, order), base) if is_formula || *order == 0 => {
                self.whole_power(*base, *n, *order, context)
            }
            Node::Apply(function @ (Function::Ln | Function::Exp | Function::Elementary(_)), a) => {
                self.function(&self.name(*function), *a, context)
            }
            Node::Sum(_, body) if is_formula => {
                parenthesise(format!("Σₚ {}", self.print(*body, Context::Product)), context == Context::Power)
            }
            Node::Sum(_, body) => format!("sum(|p| {})", self.print(*body, Context::Sum)),
            _ if !is_formula => "…".to_owned(),
            Node::Quotient(function, a, b) => {
                let (name, a) = (self.name(*function), self.print(*a, Context::Sum));
                format!("{name}[{a}, {}]", self.print(*b, Context::Sum))
            }
            Node::PoleQuotient(a, b) => {
                format!("{}/{}", self.print(*a, Context::Power), self.print(*b, Context::Power))
            }
            // Of continuations and of strains, no formula is printed.
            _ => "…".to_owned(),
        }
    }

    /// n (n − 1) x^(n − 2), the second derivative of x^n; for x = 0 that is 2 [n = 2], with a bracket that is
    /// 1 where it is true, else 0.
    fn whole_power(&self, base_id: Id, n: Id, order: u8, context: Context) -> String {
        let (base, n) = (self.print(base_id, Context::Power), self.print(n, Context::Sum));
        if self.notation == Notation::Rust {
            return format!("{base}.powi({n})");
        }
        if self.graph.is_zero(base_id) {
            let factorial: u64 = (1..=u64::from(order)).product();
            let factor = if factorial == 1 { String::new() } else { format!("{factorial} ") };
            return format!("{factor}[{n} = {order}]");
        }
        let lowered = |k: u8| if k == 0 { n.clone() } else { format!("({n} − {k})") };
        let factors = (0..order).map(|k| lowered(k) + " ").collect::<String>();
        parenthesise(format!("{factors}{base}^{}", lowered(order)), context == Context::Power)
    }

    fn parameter(&self, k: usize) -> String {
        let name = self.declaration.parameters[k].name.to_string();
        if self.notation == Notation::Formula { symbol(&plain_name(&name)) } else { name }
    }

    fn name(&self, function: Function) -> String {
        let primes = |order: u8| "′".repeat(usize::from(order));
        match function {
            Function::Ln => "ln".to_owned(),
            Function::Exp => "exp".to_owned(),
            Function::Elementary(function) => function.name().to_owned(),
            Function::Power(exponent) => format!("pow{}", self.superscript(exponent)),
            Function::WholePower(n, order) => format!("pow^{}{}", self.print(n, Context::Sum), primes(order)),
            Function::Given(k, order) => self.parameter(k) + &primes(order),
        }
    }

    fn function(&self, name: &str, argument: Id, context: Context) -> String {
        if self.notation == Notation::Rust {
            return format!("{}.{name}()", self.print(argument, Context::Power));
        }
        let inner = self.print(argument, Context::Sum);
        let is_long = inner.contains([' ', '+', '−', '/', '^']);
        let call = if is_long { format!("{name}({inner})") } else { format!("{name} {inner}") };
        parenthesise(call, context == Context::Power)
    }

    fn linear(&self, constant: Rational, terms: &[(Id, Rational)], context: Context) -> String {
        let mut terms = terms.to_vec();
        let mut parts = Vec::new();
        for (name, named) in &self.sums {
            let coefficient = |id: &Id| terms.iter().find(|(term, _)| term == id).map(|&(_, c)| c);
            let shared =
                coefficient(&named[0]).filter(|&c| named.iter().all(|id| coefficient(id) == Some(c)));
            if let Some(c) = shared {
                terms.retain(|(term, _)| !named.contains(term));
                parts.push((c.is_negative(), self.notation.multiple(c, name)));
            }
        }
        for (term, c) in terms {
            parts.push((c.is_negative(), self.notation.multiple(c, &self.print(term, Context::Product))));
        }
        let (is_sum, text) = self.notation.sum(parts, constant);
        let is_atom = !is_sum && !text.contains([' ', '/']);
        parenthesise(text, is_sum && context > Context::Sum || !is_atom && context == Context::Power)
    }

    fn product(&self, factors: &[Factor], context: Context) -> String {
        let mut factors = self.with_volume(factors);
        for &(_, product, parts) in &self.products {
            if parts.iter().all(|part| factors.contains(part)) {
                factors.retain(|factor| !parts.contains(factor));
                factors.push((product, Exponent::ONE));
            }
        }
        // Parameters, then sums.
        factors.sort_by_key(|&(base, _)| match self.graph.node(base) {
            Node::Parameter(_) | Node::Entry(_) => 0,
            Node::Linear { .. } => 1,
            Node::Stretch(_) => 2,
            _ => 3,
        });
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for (base, exponent) in factors {
            match exponent.as_integer() {
                Some(n) if n < 0 => below.push(self.power(base, Exponent::integer(-n))),
                _ => above.push(self.power(base, exponent)),
            }
        }
        let (times, one, is_atom) = match self.notation {
            Notation::Formula => (" ", "1", false),
            Notation::Rust => (" * ", "1.0", above.len() == 1 && below.is_empty()),
        };
        let numerator = if above.is_empty() { one.to_owned() } else { above.join(times) };
        let text = match (&below[..], self.notation) {
            ([], _) => numerator,
            ([single], Notation::Formula) if !is_open(single) => format!("{numerator}/{single}"),
            (several, Notation::Formula) => format!("{numerator}/({})", several.join(" ")),
            (several, Notation::Rust) => format!("{numerator} / {}", several.join(" / ")),
        };
        parenthesise(text, !is_atom && context == Context::Power)
    }

    /// Factors with a power of J in place of powers of the three stretches, which those of J become in the
    /// graph: of equal ones, and of fractions that differ by whole numbers, λ₁^(4/3) λ₂^(−2/3) λ₃^(−2/3)
    /// being J^(−2/3) λ₁².
    fn with_volume(&self, factors: &[Factor]) -> Vec<Factor> {
        let mut factors = factors.to_vec();
        let Some((stretches, volume)) = self.volume else { return factors };
        let exponent = |id: &Id| factors.iter().find(|(base, _)| base == id).map(|&(_, exponent)| exponent);
        let exponents: Vec<_> = stretches.iter().filter_map(exponent).collect();
        let Ok(exponents) = <[Exponent; 3]>::try_from(exponents) else { return factors };
        let Some((shared, left)) = shared_power(exponents) else { return factors };
        factors.retain(|(base, _)| !stretches.contains(base));
        factors.push((volume, shared));
        let left = stretches.iter().zip(left).filter(|(_, n)| *n != 0);
        factors.extend(left.map(|(&stretch, n)| (stretch, Exponent::integer(n))));
        factors
    }

    fn power(&self, base: Id, exponent: Exponent) -> String {
        if exponent == Exponent::ONE {
            // A factor after Σ would seem to belong to it.
            let is_open =
                self.notation == Notation::Formula && matches!(self.graph.node(base), Node::Sum(..));
            return self.print(base, if is_open { Context::Power } else { Context::Product });
        }
        let text = self.print(base, Context::Power);
        let Exponent { real, rational } = exponent;
        match (exponent.as_integer(), real, rational.numerator(), rational.denominator()) {
            _ if self.notation == Notation::Formula => format!("{text}{}", self.superscript(exponent)),
            (Some(n), ..) if n.abs() <= 64 => format!("{text}.powi({n})"),
            (_, None, 1, 2) => format!("{text}.sqrt()"),
            (_, None, 1, 3) => format!("{text}.cbrt()"),
            _ => format!("{text}.powf({})", self.exponent(exponent)),
        }
    }

    fn superscript(&self, exponent: Exponent) -> String {
        if let Some(n) = exponent.as_integer() {
            let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
            let digit = |c: char| c.to_digit(10).map_or('⁻', |digit| digits[digit as usize]);
            return n.to_string().chars().map(digit).collect();
        }
        let text = self.exponent(exponent);
        let is_short = text.chars().count() <= 3 && !text.contains(['/', ' ']);
        if is_short { format!("^{text}") } else { format!("^({text})") }
    }

    fn exponent(&self, Exponent { real, rational }: Exponent) -> String {
        let real = real.map(|real| (false, self.print(real, Context::Sum)));
        self.notation.sum(real.into_iter().collect(), rational).1
    }
}

/// True if a formula has a space outside of parentheses, so that a divisor `a b` needs them.
fn is_open(text: &str) -> bool {
    let mut depth = 0;
    text.chars().any(|c| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        c == ' ' && depth == 0
    })
}

/// The power of J in powers of the three stretches, and the whole powers that are left.
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

fn parenthesise(text: String, needed: bool) -> String {
    if needed { format!("({text})") } else { text }
}

fn subscript(n: usize) -> char {
    ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'].get(n).copied().unwrap_or('?')
}

/// Greek letters by their names, alone or before an underscore or digits.
fn symbol(name: &str) -> String {
    let (head, tail) =
        name.split_at(name.find(|c: char| c == '_' || c.is_ascii_digit()).unwrap_or(name.len()));
    match greek(head) {
        Some(letter) => format!("{letter}{tail}"),
        None => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use super::*;
    use crate::analyse;
    use crate::read::diagnostics::Diagnostics;
    use crate::read::parse::parse_declaration;
    use crate::read::resolve::Resolver;

    #[test]
    fn powers_of_the_volume_are_printed_as_such() {
        let check = |energy: &str, expected: &str| {
            let body: syn::Expr = syn::parse_str(energy).unwrap();
            let item = quote!(fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu * (#body) });
            let (declaration, mut model) = analyse(quote!(domain(J > 0.0), prestressed), item).unwrap();
            assert_eq!(formula(&mut model.graph, &declaration, model.energy), expected);
        };
        check("I1 + J.powi(2) - 2 * J", "μ (I1 + J² − 2 J)");
        check("I1 / J", "μ I1/J");
        check("I1 + I2 / J.powi(2)", "μ (I1 + I2/J²)");
        check("(I2 / J.powi(2)).powf(mu)", "μ (I2/J²)^μ");
        check("J.powi(2).powf(mu) + l1 * l2 + l2 * l3 + l3 * l1", "μ ((J²)^μ + λ₁ λ₂ + λ₂ λ₃ + λ₁ λ₃)");
    }

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
            let mut diagnostics = Diagnostics::default();
            let declaration = parse_declaration(quote!(), item, &mut diagnostics).unwrap();
            let energy = Resolver::new(&declaration, graph, &mut diagnostics).energy();
            (rust(graph, &declaration, energy), energy)
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
        check("f(l1) * (I1 - 3) + 0.5 * I2 - J", "I2 / 2.0 + (I1 - 3.0) * f(l1) - J");
        check("mu * I1b * J.powi(-2) + J.ln() * (I2b - 3)", "mu * I1b / J.powi(2) + (I2b - 3.0) * J.ln()");
        check(
            "1 - mu * I1 / 3 + 1e-300 * J.powf(-2.0 / 3.0)",
            "J.powf(-2.0 / 3.0) * 1e-300 + 1.0 - mu * I1 / 3.0",
        );
    }
}
