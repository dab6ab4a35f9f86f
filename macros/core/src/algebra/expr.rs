//! The expression graph: every subexpression once, in a normal form that makes equal things identical.
//!
//! A sum is one node with rational coefficients, a product is one node with exponents, and equal nodes have
//! equal [`Id`]s. So common subexpressions are shared by construction, "is this symmetric?" is a comparison
//! of two numbers, and x·x⁻¹ never survives. Products are not multiplied out, and sums with a coefficient
//! other than ±1 stay what they are, so an energy keeps the shape in which it was written.
//!
//! The graph has no derivatives: see [`crate::algebra::diff`] and [`crate::algebra::quotient`].

use std::cell::Cell;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::algebra::rational::Rational;
pub use elementary::Elementary;
pub use exponent::Exponent;

mod elementary;
mod exponent;
mod products;
mod sums;
mod traversal;

/// The number of a node of a [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(u32);

/// Index of a parameter in the order of the declaration.
pub type ParameterIndex = usize;

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
    Parameter(ParameterIndex),
    /// The current entry of a list, inside a [`Node::Sum`].
    Entry(ParameterIndex),
    /// A literal that has no exact fraction in 128 bits; the bits of an `f64`.
    Float(u64),
    /// constant + Σ coefficient · term. No term is itself such a sum with coefficient ±1.
    Linear {
        /// The constant.
        constant: Rational,
        /// Terms with their coefficients, which are not zero, in the order of their ids.
        terms: Vec<(Id, Rational)>,
    },
    /// Π base^exponent, in the order of the bases; rational coefficients live in `Linear`.
    Product(Vec<(Id, Exponent)>),
    /// An expression that is zero at rest and positive elsewhere, as a sum of squares and, for readers, as it
    /// is written. Its value is kept from zero, so that powers of it have a value.
    Excess(Id, Id),
    /// An expression in a form that keeps its digits, for its value, and as it is written, for its
    /// derivatives and for readers.
    Accurate(Id, Id),
    /// The value φ(a) of a function; powers are factors of a `Product`.
    Apply(Function, Id),
    /// Σ over the entries of lists of the given length.
    Sum(Length, Id),
    /// Derivative of the given order of a function of one stretch, ln λ or λ^r, continued below ε by its
    /// quadratic Taylor polynomial at ε.
    Extended(Function, u8, Stretch),
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
    /// The second operand if the first is negative, else the third.
    WhereNegative(Id, Id, Id),
    /// The divided difference (φ(a) − φ(b)) / (a − b) of a function.
    Quotient(Function, Id, Id),
    /// a / max(b, floor), for b that may vanish, which gives the quotient a pole.
    PoleQuotient(Id, Id),
}

impl Node {
    /// True if it is the value of a function that is a parameter, or of its derivative.
    pub(crate) fn is_call(&self) -> bool {
        matches!(self, Self::Apply(Function::Given(..), _))
    }
}

/// The length of the lists that a sum runs over: an index into the lengths of the declaration.
pub type Length = usize;

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// Natural logarithm.
    Ln,
    /// Exponential function.
    Exp,
    /// An elementary function of its own kernel.
    Elementary(Elementary),
    /// x^r.
    Power(Exponent),
    /// Derivative of the given order k of xⁿ, n (n − 1) … (n − k + 1) xⁿ⁻ᵏ, zero for k > n. The exponent n is
    /// a parameter or an entry that is a whole number and not negative.
    WholePower(Id, u8),
    /// Derivative of the given order, 0 … 2, of a function that is a parameter.
    Given(ParameterIndex, u8),
}

/// An expression graph: all nodes, each once.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    ids: FxHashMap<Node, Id>,
    /// Nodes with their stretches replaced.
    substitutions: FxHashMap<(Id, [Id; 3]), Id>,
    overflowed: bool,
    /// The number of nodes and of their operands.
    size: usize,
    /// The number of operands of all sums and products that were requested, whether new or not.
    effort: usize,
    /// The largest size; `None` for no limit except memory.
    most: Option<usize>,
    /// True if more was requested than the limit.
    is_full: Rc<Cell<bool>>,
}

impl Graph {
    /// A graph with a limit on nodes and operands. Beyond it, every node is the first one, so that the
    /// computation ends soon, with invalid results; the cell is then true.
    pub fn with_most(most: Option<usize>) -> (Self, Rc<Cell<bool>>) {
        let graph = Self { most, ..Self::default() };
        let is_full = graph.is_full.clone();
        (graph, is_full)
    }

    /// The node of an id.
    #[must_use]
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// True if more nodes were requested than allowed; results are then meaningless.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.is_full.get()
    }

    /// Counts the operands of a sum or a product that is to be made.
    fn work(&mut self, operands: usize) {
        /// The largest effort for each unit of the largest size.
        const EFFORT: usize = 24;
        self.effort += operands;
        if self.most.is_some_and(|most| self.effort > EFFORT * most) {
            self.is_full.set(true);
        }
    }

    /// True if a rational number has left 128 bits; results are then meaningless.
    #[must_use]
    pub fn overflowed(&self) -> bool {
        self.overflowed
    }

    /// True if a rational number has left 128 bits since the last call.
    pub fn take_overflow(&mut self) -> bool {
        std::mem::take(&mut self.overflowed)
    }

    /// The id of a node other than a sum or a product, which need a normal form. The two arguments of a
    /// quotient are put in order.
    pub fn leaf(&mut self, mut node: Node) -> Id {
        if let Node::Quotient(_, a, b) = &mut node
            && b < a
        {
            std::mem::swap(a, b);
        }
        if let Some(&id) = self.ids.get(&node) {
            return id;
        }
        self.size += match &node {
            Node::Linear { terms, .. } => 1 + terms.len(),
            Node::Product(factors) => 1 + factors.len(),
            _ => 2,
        };
        if self.most.is_some_and(|most| self.size > most) {
            self.is_full.set(true);
            return Id(0);
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
    pub(crate) fn as_constant(&self, id: Id) -> Option<Rational> {
        match self.node(id) {
            Node::Linear { constant, terms } if terms.is_empty() => Some(*constant),
            _ => None,
        }
    }

    /// True if a node is 0.
    #[must_use]
    pub fn is_zero(&self, id: Id) -> bool {
        self.as_constant(id).is_some_and(Rational::is_zero)
    }

    /// The value φ(a) of a function.
    pub fn apply(&mut self, function: Function, a: Id) -> Id {
        match function {
            Function::Ln => self.ln(a),
            Function::Exp if self.is_zero(a) => self.integer(1),
            Function::Elementary(function) => self.elementary(function, a),
            Function::Power(exponent) => self.power(a, exponent),
            Function::WholePower(_, 0) if self.as_constant(a) == Some(Rational::ONE) => a,
            Function::Exp | Function::WholePower(..) | Function::Given(..) => {
                self.leaf(Node::Apply(function, a))
            }
        }
    }

    /// The logarithm ln a.
    ///
    /// ln(1 + eˣ) is the softplus function of x, which is finite where eˣ overflows.
    pub fn ln(&mut self, a: Id) -> Id {
        if self.as_constant(a) == Some(Rational::ONE) {
            return self.integer(0);
        }
        if let Node::Linear { constant: Rational::ONE, terms } = self.node(a)
            && let [(term, Rational::ONE)] = terms[..]
            && let Node::Apply(Function::Exp, x) = *self.node(term)
        {
            return self.elementary(Elementary::Softplus, x);
        }
        self.leaf(Node::Apply(Function::Ln, a))
    }

    /// An expression that is zero at rest and positive elsewhere, as a sum of squares, and as it is written.
    pub fn excess(&mut self, squares: Id, written: Id) -> Id {
        if self.is_zero(squares) { squares } else { self.leaf(Node::Excess(squares, written)) }
    }

    /// An expression in a form that keeps its digits, and as it is written.
    pub fn accurate(&mut self, value: Id, written: Id) -> Id {
        if value == written { value } else { self.leaf(Node::Accurate(value, written)) }
    }

    /// An elementary function φ(a).
    pub fn elementary(&mut self, function: Elementary, a: Id) -> Id {
        match function.at_zero().filter(|_| self.is_zero(a)) {
            Some(value) => self.integer(value),
            None => self.leaf(Node::Apply(Function::Elementary(function), a)),
        }
    }

    /// A sum over lists of the given length.
    pub fn sum(&mut self, length: Length, body: Id) -> Id {
        if self.is_zero(body) { body } else { self.leaf(Node::Sum(length, body)) }
    }

    /// The result of exact arithmetic; an overflow of 128 bits is remembered.
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
    fn real_powers_of_products_are_kept_whole() {
        // (x²)^½ is |x|, not x.
        let mut g = Graph::default();
        let x = g.stretch(0);
        let square = g.powi(x, 2);
        let half = Exponent::rational(Rational::new(1, 2).unwrap());
        assert_ne!(g.power(square, half), x);
    }

    #[test]
    fn cube_roots_keep_the_sign() {
        let mut g = Graph::default();
        let x = g.stretch(0);
        let minus = g.neg(x);
        let thirds = |n| Exponent::rational(Rational::new(n, 3).unwrap());
        for n in [-4, -2, 4] {
            assert_eq!(g.power(minus, thirds(n)), g.power(x, thirds(n)));
        }
        for n in [-5, -1, 1] {
            let power = g.power(x, thirds(n));
            assert_eq!(g.power(minus, thirds(n)), g.neg(power));
        }
        // Other roots of expressions that may be negative stay as they are written.
        let fifths = Exponent::rational(Rational::new(2, 5).unwrap());
        assert_ne!(g.power(minus, fifths), g.power(x, fifths));
    }
}
