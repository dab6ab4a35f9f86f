//! The expression graph: every subexpression once, in a normal form that makes equal things identical.
//!
//! A sum is one node with rational coefficients, a product is one node with exponents, and equal nodes have equal
//! [`Id`]s. So common subexpressions are shared by construction, "is this symmetric?" is a comparison of two numbers,
//! and x·x⁻¹ never survives. Products are not multiplied out, and sums with a coefficient other than ±1 stay what they
//! are, so an energy keeps the shape in which it was written.
//!
//! The graph knows no derivative: see [`crate::diff`] and [`crate::quotient`].

use std::collections::{BTreeMap, HashMap};

use crate::rational::Rational;

/// A node of a [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(u32);

/// Index of a parameter in the order of the declaration.
pub type Parameter = usize;

/// Index of a stretch: 0, 1, 2 for λ1, λ2, λ3.
pub type Stretch = usize;

/// A subexpression.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A principal stretch.
    Stretch(Stretch),
    /// A principal strain λk − 1, known more accurately than the stretch.
    Strain(Stretch),
    /// A scalar parameter.
    Parameter(Parameter),
    /// The current entry of a list, inside a [`Node::Sum`].
    Entry(Parameter),
    /// A literal that has no exact fraction in 128 bits; the bits of an `f64`.
    Float(u64),
    /// constant + Σ coefficient · term. No term is itself such a sum with coefficient ±1.
    Linear {
        /// Added to the terms.
        constant: Rational,
        /// In the order of their ids, coefficients not zero.
        terms: Vec<(Id, Rational)>,
    },
    /// Π base^exponent, in the order of the bases; rational coefficients live in `Linear`.
    Product(Vec<(Id, Exponent)>),
    /// Natural logarithm.
    Ln(Id),
    /// Exponential function.
    Exp(Id),
    /// Derivative of the given order, 0 … 2, of a function that is a parameter.
    Function(Parameter, u8, Id),
    /// Σ over the entries of lists of the given length.
    Sum(Length, Id),
    /// Derivative of the given order of a function of one stretch, continued below ε by its quadratic Taylor
    /// polynomial at ε.
    Extended(Extended, u8, Stretch),
    /// The threshold ε of the extension.
    Epsilon,
    /// max(λ, ε).
    Above(Stretch),
    /// min(λ − ε, 0), so that `Above + Below` is λ.
    Below(Stretch),
    /// Fraction of the interval between two stretches that lies above ε.
    ShareAbove(Stretch, Stretch),
    /// Fraction of the interval between two stretches that lies below ε.
    ShareBelow(Stretch, Stretch),
    /// The second where the first is negative, else the third.
    WhereNegative(Id, Id, Id),
    /// (ln a − ln b) / (a − b).
    LnQuotient(Id, Id),
    /// (eᵃ − eᵇ) / (a − b).
    ExpQuotient(Id, Id),
    /// Divided difference of the derivative of the given order of a function that is a parameter.
    FunctionQuotient(Parameter, u8, Id, Id),
    /// (a^r − b^r) / (a − b) for a real exponent.
    PowerQuotient(Id, Id, Exponent),
    /// a / max(b, floor), where b may vanish and the quotient then has a pole.
    PoleQuotient(Id, Id),
}

/// The length of the lists that a sum runs over: an index into the lengths of the declaration.
pub type Length = usize;

/// A function that can be extended below ε.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Extended {
    /// ln λ.
    Ln,
    /// λ^r.
    Power(Exponent),
}

/// An exponent: a fraction, plus an expression in parameters if it is real.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Exponent {
    /// The expression in parameters, without rational part.
    pub real: Option<Id>,
    /// The rational part.
    pub rational: Rational,
}

impl Exponent {
    /// 1.
    pub const ONE: Self = Self::rational(Rational::ONE);

    /// A fraction.
    #[must_use]
    pub const fn rational(rational: Rational) -> Self {
        Self { real: None, rational }
    }

    /// A whole number.
    #[must_use]
    pub const fn integer(value: i64) -> Self {
        Self::rational(Rational::integer(value))
    }

    /// The whole number it is, if it is one.
    #[must_use]
    pub fn as_integer(self) -> Option<i64> {
        if self.real.is_some() { None } else { self.rational.as_integer() }
    }

    fn is_zero(self) -> bool {
        self.real.is_none() && self.rational.is_zero()
    }
}

/// All nodes, each once.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    ids: HashMap<Node, Id>,
    /// What nodes become when their stretches are replaced: nodes never change, so neither does this.
    substitutions: HashMap<(Id, [Id; 3]), Id>,
    overflowed: bool,
}

impl Graph {
    /// The node of an id.
    #[must_use]
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// Whether a rational number has left 128 bits; results are then meaningless.
    #[must_use]
    pub fn overflowed(&self) -> bool {
        self.overflowed
    }

    /// The id of a node that is in normal form by its nature: anything but sums and products.
    pub fn leaf(&mut self, node: Node) -> Id {
        if let Some(&id) = self.ids.get(&node) {
            return id;
        }
        let id = Id(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push(node.clone());
        self.ids.insert(node, id);
        id
    }

    /// A stretch.
    pub fn stretch(&mut self, i: Stretch) -> Id {
        self.leaf(Node::Stretch(i))
    }

    /// A fraction.
    pub fn constant(&mut self, constant: Rational) -> Id {
        self.leaf(Node::Linear { constant, terms: Vec::new() })
    }

    /// A whole number.
    pub fn integer(&mut self, value: i64) -> Id {
        self.constant(Rational::integer(value))
    }

    /// The fraction a node is, if it is one.
    #[must_use]
    pub fn as_constant(&self, id: Id) -> Option<Rational> {
        match self.node(id) {
            Node::Linear { constant, terms } if terms.is_empty() => Some(*constant),
            _ => None,
        }
    }

    /// Whether a node is 0.
    #[must_use]
    pub fn is_zero(&self, id: Id) -> bool {
        self.as_constant(id).is_some_and(Rational::is_zero)
    }

    /// a + b.
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        self.linear(Rational::ZERO, &[(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// a − b.
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        self.linear(Rational::ZERO, &[(a, Rational::ONE), (b, Rational::integer(-1))])
    }

    /// −a.
    pub fn neg(&mut self, a: Id) -> Id {
        self.scale(a, Rational::integer(-1))
    }

    /// factor · a.
    pub fn scale(&mut self, a: Id, factor: Rational) -> Id {
        self.linear(Rational::ZERO, &[(a, factor)])
    }

    /// Sum of several.
    pub fn sum_of(&mut self, terms: &[Id]) -> Id {
        let terms: Vec<_> = terms.iter().map(|&term| (term, Rational::ONE)).collect();
        self.linear(Rational::ZERO, &terms)
    }

    /// constant + Σ coefficient · term, brought to normal form.
    pub fn linear(&mut self, constant: Rational, terms: &[(Id, Rational)]) -> Id {
        let mut total = constant;
        let mut collected: BTreeMap<Id, Rational> = BTreeMap::new();
        for &(term, factor) in terms {
            self.collect(term, factor, &mut total, &mut collected);
        }
        collected.retain(|_, coefficient| !coefficient.is_zero());
        let terms: Vec<_> = collected.into_iter().collect();
        match terms[..] {
            [(term, Rational::ONE)] if total.is_zero() => term,
            _ => self.leaf(Node::Linear { constant: total, terms }),
        }
    }

    fn collect(
        &mut self,
        term: Id,
        factor: Rational,
        total: &mut Rational,
        into: &mut BTreeMap<Id, Rational>,
    ) {
        if let Node::Linear { constant, terms } = self.node(term).clone() {
            let is_plain_multiple = constant.is_zero() && terms.len() == 1;
            let is_unit = factor == Rational::ONE || factor == Rational::integer(-1);
            if terms.is_empty() || is_plain_multiple || is_unit {
                let shift = self.exact(constant.checked_mul(factor));
                *total = self.exact(total.checked_add(shift));
                for (inner, coefficient) in terms {
                    let coefficient = self.exact(coefficient.checked_mul(factor));
                    if is_plain_multiple {
                        self.collect(inner, coefficient, total, into);
                    } else {
                        self.collect_one(inner, coefficient, into);
                    }
                }
                return;
            }
        }
        self.collect_one(term, factor, into);
    }

    fn collect_one(&mut self, term: Id, coefficient: Rational, into: &mut BTreeMap<Id, Rational>) {
        let old = into.get(&term).copied().unwrap_or(Rational::ZERO);
        let new = self.exact(old.checked_add(coefficient));
        into.insert(term, new);
    }

    /// a · b.
    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        self.product(&[(a, Exponent::ONE), (b, Exponent::ONE)])
    }

    /// Product of several.
    pub fn product_of(&mut self, factors: &[Id]) -> Id {
        let factors: Vec<_> = factors.iter().map(|&factor| (factor, Exponent::ONE)).collect();
        self.product(&factors)
    }

    /// a / b.
    pub fn div(&mut self, a: Id, b: Id) -> Id {
        self.product(&[(a, Exponent::ONE), (b, Exponent::integer(-1))])
    }

    /// a^exponent.
    pub fn power(&mut self, a: Id, exponent: Exponent) -> Id {
        self.product(&[(a, exponent)])
    }

    /// a^n.
    pub fn powi(&mut self, a: Id, n: i64) -> Id {
        self.power(a, Exponent::integer(n))
    }

    /// Π base^exponent, brought to normal form.
    pub fn product(&mut self, factors: &[(Id, Exponent)]) -> Id {
        let mut coefficient = Rational::ONE;
        let mut collected: BTreeMap<Id, Exponent> = BTreeMap::new();
        for &(base, exponent) in factors {
            self.gather(base, exponent, &mut coefficient, &mut collected);
        }
        collected.retain(|_, exponent| !exponent.is_zero());
        let factors: Vec<_> = collected.into_iter().collect();
        let product = match factors[..] {
            [] => return self.constant(coefficient),
            [(base, Exponent::ONE)] => base,
            _ => self.leaf(Node::Product(factors)),
        };
        if coefficient == Rational::ONE { product } else { self.scale(product, coefficient) }
    }

    fn gather(
        &mut self,
        base: Id,
        exponent: Exponent,
        coefficient: &mut Rational,
        into: &mut BTreeMap<Id, Exponent>,
    ) {
        match self.node(base).clone() {
            // Numbers: 0 and 1 have every power, others the whole ones.
            Node::Linear { constant, terms } if terms.is_empty() => {
                if let Some(n) = exponent.as_integer() {
                    let power = self.exact(constant.checked_powi(n));
                    *coefficient = self.exact(coefficient.checked_mul(power));
                    return;
                }
                if constant == Rational::ONE {
                    return;
                }
            }
            // c·t and Π have whole powers factor by factor; real ones only where every factor is known positive.
            Node::Linear { constant, terms } if constant.is_zero() && terms.len() == 1 => {
                if let Some(n) = exponent.as_integer() {
                    let (term, factor) = terms[0];
                    let power = self.exact(factor.checked_powi(n));
                    *coefficient = self.exact(coefficient.checked_mul(power));
                    self.gather(term, exponent, coefficient, into);
                    return;
                }
            }
            // A compound such as J^(−2/3) I1 is of moderate size where its factors are not: its powers are kept whole.
            Node::Product(factors) => {
                let is_compound =
                    factors.iter().any(|&(factor, _)| matches!(self.node(factor), Node::Linear { .. }));
                if let Some(n) = exponent.as_integer()
                    && (n <= 1 || !is_compound)
                {
                    for (factor, inner) in factors {
                        let power = self.scale_exponent(inner, n);
                        self.gather_one(factor, power, into);
                    }
                    return;
                }
            }
            _ => {}
        }
        self.gather_one(base, exponent, into);
    }

    fn gather_one(&mut self, base: Id, exponent: Exponent, into: &mut BTreeMap<Id, Exponent>) {
        let sum = match into.get(&base) {
            Some(&old) => self.add_exponents(old, exponent),
            None => exponent,
        };
        into.insert(base, sum);
    }

    /// Sum of two exponents.
    pub fn add_exponents(&mut self, a: Exponent, b: Exponent) -> Exponent {
        let real = match (a.real, b.real) {
            (Some(a), Some(b)) => Some(self.add(a, b)).filter(|&sum| !self.is_zero(sum)),
            (real, None) | (None, real) => real,
        };
        Exponent { real, rational: self.exact(a.rational.checked_add(b.rational)) }
    }

    fn scale_exponent(&mut self, exponent: Exponent, n: i64) -> Exponent {
        let factor = Rational::integer(n);
        Exponent {
            real: exponent.real.filter(|_| n != 0).map(|real| self.scale(real, factor)),
            rational: self.exact(exponent.rational.checked_mul(factor)),
        }
    }

    /// An expression in parameters as an exponent.
    pub fn exponent(&mut self, id: Id) -> Exponent {
        if let Node::Linear { constant, terms } = self.node(id).clone() {
            let real = (!terms.is_empty()).then(|| self.linear(Rational::ZERO, &terms));
            return Exponent { real, rational: constant };
        }
        Exponent { real: Some(id), rational: Rational::ZERO }
    }

    /// An exponent as an expression.
    pub fn exponent_value(&mut self, exponent: Exponent) -> Id {
        let terms: Vec<_> = exponent.real.iter().map(|&real| (real, Rational::ONE)).collect();
        self.linear(exponent.rational, &terms)
    }

    /// ln a.
    pub fn ln(&mut self, a: Id) -> Id {
        if self.as_constant(a) == Some(Rational::ONE) { self.integer(0) } else { self.leaf(Node::Ln(a)) }
    }

    /// eᵃ.
    pub fn exp(&mut self, a: Id) -> Id {
        if self.is_zero(a) { self.integer(1) } else { self.leaf(Node::Exp(a)) }
    }

    /// Σ over lists of the given length.
    pub fn sum(&mut self, length: Length, body: Id) -> Id {
        if self.is_zero(body) { body } else { self.leaf(Node::Sum(length, body)) }
    }

    /// The factors of a node, itself if it is not a product; without its rational coefficient, which comes first.
    #[must_use]
    pub fn factors(&self, id: Id) -> (Rational, Vec<(Id, Exponent)>) {
        match self.node(id) {
            Node::Product(factors) => (Rational::ONE, factors.clone()),
            Node::Linear { constant, terms } if constant.is_zero() && terms.len() == 1 => {
                let (term, coefficient) = terms[0];
                let (_, factors) = self.factors(term);
                (coefficient, factors)
            }
            _ => (Rational::ONE, vec![(id, Exponent::ONE)]),
        }
    }

    /// Direct subexpressions, exponents included.
    #[must_use]
    pub fn children(&self, id: Id) -> Vec<Id> {
        let with_exponent = |base: Id, exponent: &Exponent| [Some(base), exponent.real].into_iter().flatten();
        match self.node(id) {
            Node::Linear { terms, .. } => terms.iter().map(|&(term, _)| term).collect(),
            Node::Product(factors) => factors.iter().flat_map(|(base, e)| with_exponent(*base, e)).collect(),
            Node::Ln(a) | Node::Exp(a) | Node::Function(.., a) | Node::Sum(_, a) => vec![*a],
            Node::WhereNegative(a, b, c) => vec![*a, *b, *c],
            Node::LnQuotient(a, b)
            | Node::ExpQuotient(a, b)
            | Node::FunctionQuotient(.., a, b)
            | Node::PoleQuotient(a, b) => vec![*a, *b],
            Node::PowerQuotient(a, b, exponent) => [*a, *b].into_iter().chain(exponent.real).collect(),
            Node::Extended(Extended::Power(exponent), ..) => exponent.real.into_iter().collect(),
            _ => Vec::new(),
        }
    }

    /// The same node over other subexpressions, in normal form.
    ///
    /// Leaves are returned as they are: who rewrites leaves treats them before calling this.
    pub fn map_children(&mut self, id: Id, map: &mut impl FnMut(&mut Self, Id) -> Id) -> Id {
        let exponent = |graph: &mut Self, e: Exponent, map: &mut dyn FnMut(&mut Self, Id) -> Id| match e.real
        {
            Some(real) => {
                let real = map(graph, real);
                let shift = graph.exponent(real);
                graph.add_exponents(Exponent::rational(e.rational), shift)
            }
            None => e,
        };
        match self.node(id).clone() {
            Node::Linear { constant, terms } => {
                let terms: Vec<_> = terms.into_iter().map(|(term, c)| (map(self, term), c)).collect();
                self.linear(constant, &terms)
            }
            Node::Product(factors) => {
                let factors: Vec<_> =
                    factors.into_iter().map(|(base, e)| (map(self, base), exponent(self, e, map))).collect();
                self.product(&factors)
            }
            Node::Ln(a) => {
                let a = map(self, a);
                self.ln(a)
            }
            Node::Exp(a) => {
                let a = map(self, a);
                self.exp(a)
            }
            Node::Function(f, order, a) => {
                let a = map(self, a);
                self.leaf(Node::Function(f, order, a))
            }
            Node::FunctionQuotient(f, order, a, b) => {
                let node = Node::FunctionQuotient(f, order, map(self, a), map(self, b));
                self.leaf(node)
            }
            Node::Sum(length, body) => {
                let body = map(self, body);
                self.sum(length, body)
            }
            Node::WhereNegative(condition, a, b) => {
                let node = Node::WhereNegative(map(self, condition), map(self, a), map(self, b));
                self.leaf(node)
            }
            Node::LnQuotient(a, b) => {
                let node = Node::LnQuotient(map(self, a), map(self, b));
                self.leaf(node)
            }
            Node::ExpQuotient(a, b) => {
                let node = Node::ExpQuotient(map(self, a), map(self, b));
                self.leaf(node)
            }
            Node::PowerQuotient(a, b, e) => {
                let node = Node::PowerQuotient(map(self, a), map(self, b), exponent(self, e, map));
                self.leaf(node)
            }
            Node::PoleQuotient(a, b) => {
                let node = Node::PoleQuotient(map(self, a), map(self, b));
                self.leaf(node)
            }
            _ => id,
        }
    }

    /// The expression with every stretch replaced.
    pub fn substitute(&mut self, id: Id, stretches: [Id; 3]) -> Id {
        if let Some(&done) = self.substitutions.get(&(id, stretches)) {
            return done;
        }
        let result = match *self.node(id) {
            Node::Stretch(i) => stretches[i],
            Node::Extended(function, order, i) => match *self.node(stretches[i]) {
                Node::Stretch(j) => self.leaf(Node::Extended(function, order, j)),
                // Extended functions are functions of a stretch and of nothing else; NaN would not go unnoticed.
                _ => self.leaf(Node::Float(f64::NAN.to_bits())),
            },
            _ => self.map_children(id, &mut |graph, child| graph.substitute(child, stretches)),
        };
        self.substitutions.insert((id, stretches), result);
        result
    }

    /// All nodes below the roots, roots included, children before parents.
    #[must_use]
    pub fn reachable(&self, roots: &[Id]) -> Vec<Id> {
        let mut order = Vec::new();
        let mut seen = vec![false; self.nodes.len()];
        let mut stack: Vec<(Id, bool)> = roots.iter().rev().map(|&root| (root, false)).collect();
        while let Some((id, expanded)) = stack.pop() {
            if expanded {
                order.push(id);
            } else if !std::mem::replace(&mut seen[id.0 as usize], true) {
                stack.push((id, true));
                stack.extend(self.children(id).into_iter().rev().map(|child| (child, false)));
            }
        }
        order
    }

    fn exact(&mut self, value: Option<Rational>) -> Rational {
        value.unwrap_or_else(|| {
            self.overflowed = true;
            Rational::ONE
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_expressions_are_identical() {
        let mut g = Graph::default();
        let (x, y) = (g.stretch(0), g.stretch(1));
        let (left, right) = (g.add(x, y), g.add(y, x));
        assert_eq!(left, right);
        let (left, right) = (g.mul(x, y), g.mul(y, x));
        assert_eq!(left, right);
        let square = g.powi(left, 2);
        let (xx, yy) = (g.powi(x, 2), g.powi(y, 2));
        assert_eq!(square, g.mul(xx, yy));
    }

    #[test]
    fn sums_and_products_cancel() {
        let mut g = Graph::default();
        let (x, y) = (g.stretch(0), g.stretch(1));
        let sum = g.add(x, y);
        let left = g.sub(sum, y);
        assert_eq!(left, x);
        let product = g.mul(x, y);
        assert_eq!(g.div(product, y), x);
        let difference = g.sub(sum, sum);
        assert!(g.is_zero(difference));
    }

    #[test]
    fn real_exponents_merge_with_whole_ones() {
        let mut g = Graph::default();
        let (x, alpha) = (g.stretch(0), g.leaf(Node::Parameter(0)));
        let exponent = g.exponent(alpha);
        let power = g.power(x, exponent);
        let over = g.div(power, x);
        let minus_one = g.integer(-1);
        let shifted = g.add(alpha, minus_one);
        let exponent = g.exponent(shifted);
        assert_eq!(over, g.power(x, exponent));
    }

    #[test]
    fn real_powers_of_products_are_kept_whole() {
        // (x²)^½ is |x|, not x.
        let mut g = Graph::default();
        let x = g.stretch(0);
        let square = g.powi(x, 2);
        let half = Exponent::rational(Rational::new(1, 2).unwrap());
        assert_ne!(g.power(square, half), x);
    }

    #[test]
    fn overflow_is_reported() {
        let mut g = Graph::default();
        let big = g.integer(i64::MAX);
        g.powi(big, 3);
        assert!(g.overflowed());
    }
}
