//! Traversal of the nodes below a node: their list, in order, and their replacement.

use rustc_hash::FxHashMap;

use super::{Exponent, Extended, Graph, Id, Node, ParameterIndex};

impl Graph {
    /// Direct subexpressions, exponents included.
    #[must_use]
    pub fn children(&self, id: Id) -> Vec<Id> {
        let with_exponent = |base: Id, exponent: &Exponent| [Some(base), exponent.real].into_iter().flatten();
        match self.node(id) {
            Node::Linear { terms, .. } => terms.iter().map(|&(term, _)| term).collect(),
            Node::Product(factors) => factors.iter().flat_map(|(base, e)| with_exponent(*base, e)).collect(),
            Node::Ln(a) | Node::Exp(a) | Node::Elementary(_, a) | Node::Function(.., a) | Node::Sum(_, a) => {
                vec![*a]
            }
            Node::Excess(a, b) if a == b => vec![*a],
            Node::Excess(a, b) | Node::Accurate(a, b) => vec![*a, *b],
            Node::WhereNegative(a, b, c) => vec![*a, *b, *c],
            Node::LnQuotient(a, b)
            | Node::ExpQuotient(a, b)
            | Node::ElementaryQuotient(_, a, b)
            | Node::FunctionQuotient(.., a, b)
            | Node::WholePower(a, b, _)
            | Node::PoleQuotient(a, b) => vec![*a, *b],
            Node::WholePowerQuotient(a, b, n, _) => vec![*a, *b, *n],
            Node::PowerQuotient(a, b, exponent) => [*a, *b].into_iter().chain(exponent.real).collect(),
            Node::Extended(Extended::Power(exponent), ..) => exponent.real.into_iter().collect(),
            _ => Vec::new(),
        }
    }

    /// A node with its subexpressions replaced, in normal form.
    ///
    /// Leaves are returned unchanged: a caller that rewrites leaves does so before this call.
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
        // Most children of most nodes are unchanged, and the node with them.
        let mut is_changed = false;
        let map = &mut |graph: &mut Self, child| {
            let mapped = map(graph, child);
            is_changed |= mapped != child;
            mapped
        };
        if self.is_full() {
            return id;
        }
        let mut node = self.node(id).clone();
        match &mut node {
            Node::Linear { constant, terms } => {
                terms.iter_mut().for_each(|(term, _)| *term = map(self, *term));
                return if is_changed { self.linear(*constant, terms) } else { id };
            }
            Node::Product(factors) => {
                for (base, e) in &mut *factors {
                    (*base, *e) = (map(self, *base), exponent(self, *e, map));
                }
                return if is_changed { self.product(factors) } else { id };
            }
            Node::Ln(a) | Node::Exp(a) | Node::Elementary(_, a) | Node::Function(.., a) | Node::Sum(_, a) => {
                *a = map(self, *a);
            }
            Node::Excess(a, b)
            | Node::Accurate(a, b)
            | Node::LnQuotient(a, b)
            | Node::ExpQuotient(a, b)
            | Node::ElementaryQuotient(_, a, b)
            | Node::FunctionQuotient(.., a, b)
            | Node::WholePower(a, b, _)
            | Node::PoleQuotient(a, b) => (*a, *b) = (map(self, *a), map(self, *b)),
            Node::WhereNegative(a, b, c) | Node::WholePowerQuotient(a, b, c, _) => {
                (*a, *b, *c) = (map(self, *a), map(self, *b), map(self, *c));
            }
            Node::PowerQuotient(a, b, e) => {
                (*a, *b, *e) = (map(self, *a), map(self, *b), exponent(self, *e, map));
            }
            _ => return id,
        }
        match node {
            Node::Ln(a) => self.ln(a),
            Node::Exp(a) => self.exp(a),
            Node::Excess(a, b) => self.excess(a, b),
            Node::Accurate(a, b) => self.accurate(a, b),
            Node::Elementary(function, a) => self.elementary(function, a),
            Node::Sum(length, body) => self.sum(length, body),
            Node::WholePower(base, n, order) => self.whole_power(base, n, order),
            node => self.leaf(node),
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
                // Extended functions are functions of a stretch and of nothing else; NaN would be noticed.
                _ => self.leaf(Node::Float(f64::NAN.to_bits())),
            },
            _ => self.map_children(id, &mut |graph, child| graph.substitute(child, stretches)),
        };
        self.substitutions.insert((id, stretches), result);
        result
    }

    /// The largest number of nodes one inside the other below the roots, roots included.
    #[must_use]
    pub fn depth(&self, roots: &[Id]) -> usize {
        let mut depths: FxHashMap<Id, usize> = FxHashMap::default();
        for id in self.reachable(roots) {
            let inner = self.children(id).iter().map(|child| depths[child]).max().unwrap_or(0);
            depths.insert(id, inner + 1);
        }
        roots.iter().map(|root| depths[root]).max().unwrap_or(0)
    }

    /// For each of these nodes, children before parents, a list with whose entries its value changes from
    /// term to term of a sum.
    #[must_use]
    pub fn lists(&self, order: &[Id]) -> FxHashMap<Id, Option<ParameterIndex>> {
        let mut lists: FxHashMap<Id, Option<ParameterIndex>> = FxHashMap::default();
        for &id in order {
            let list = match *self.node(id) {
                Node::Entry(k) => Some(k),
                // Entries inside a sum are none outside.
                Node::Sum(..) => None,
                _ => self.children(id).iter().find_map(|child| lists.get(child).copied().flatten()),
            };
            lists.insert(id, list);
        }
        lists
    }

    /// True if an expression contains such a node, or is one.
    #[must_use]
    pub fn contains(&self, id: Id, is: impl Fn(&Node) -> bool) -> bool {
        self.reachable(&[id]).into_iter().any(|id| is(self.node(id)))
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
}
