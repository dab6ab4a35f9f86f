//! Traversal of the nodes below a node: their list, in order, and their replacement.

use rustc_hash::FxHashMap;

use super::{Function, Graph, Id, Node, ParameterIndex};

impl Node {
    /// The ids of the direct subexpressions, those of exponents included.
    fn children_mut(&mut self) -> Vec<&mut Id> {
        match self {
            Self::Linear { terms, .. } => terms.iter_mut().map(|(term, _)| term).collect(),
            Self::Product(factors) => {
                factors.iter_mut().flat_map(|(base, e)| [Some(base), e.real.as_mut()]).flatten().collect()
            }
            Self::Sum(_, a) => vec![a],
            Self::Excess(a, b) | Self::Accurate(a, b) | Self::PoleQuotient(a, b) => vec![a, b],
            Self::WhereNegative(a, b, c) => vec![a, b, c],
            Self::Apply(function, a) => [a].into_iter().chain(function.exponent_mut()).collect(),
            Self::Quotient(function, a, b) => [a, b].into_iter().chain(function.exponent_mut()).collect(),
            Self::Extended(function, ..) => function.exponent_mut().into_iter().collect(),
            _ => Vec::new(),
        }
    }
}

impl Function {
    /// The expression in the exponent of a power, or in its real part.
    fn exponent_mut(&mut self) -> Option<&mut Id> {
        match self {
            Self::Power(exponent) => exponent.real.as_mut(),
            Self::WholePower(n, _) => Some(n),
            _ => None,
        }
    }
}

impl Graph {
    /// Direct subexpressions, exponents included.
    #[must_use]
    pub fn children(&self, id: Id) -> Vec<Id> {
        match self.node(id) {
            Node::Linear { terms, .. } => terms.iter().map(|&(term, _)| term).collect(),
            Node::Excess(a, b) if a == b => vec![*a],
            node => node.clone().children_mut().into_iter().map(|child| *child).collect(),
        }
    }

    /// A node with its subexpressions replaced, in normal form.
    ///
    /// Leaves are returned unchanged, and so are extended functions: a caller that rewrites those does so
    /// before this call.
    pub fn map_children(&mut self, id: Id, map: &mut impl FnMut(&mut Self, Id) -> Id) -> Id {
        if self.is_full() || matches!(self.node(id), Node::Extended(..)) {
            return id;
        }
        let mut node = self.node(id).clone();
        let mut is_changed = false;
        for child in node.children_mut() {
            let mapped = map(self, *child);
            is_changed |= mapped != *child;
            *child = mapped;
        }
        // Most children of most nodes are unchanged, and the node with them.
        if !is_changed {
            return id;
        }
        match node {
            Node::Linear { constant, terms } => self.linear(constant, &terms),
            Node::Product(mut factors) => {
                factors.iter_mut().for_each(|(_, exponent)| *exponent = self.normal_exponent(*exponent));
                self.product(&factors)
            }
            Node::Quotient(Function::Power(exponent), a, b) => {
                let exponent = self.normal_exponent(exponent);
                self.leaf(Node::Quotient(Function::Power(exponent), a, b))
            }
            Node::Apply(function, a) => self.apply(function, a),
            Node::Excess(a, b) => self.excess(a, b),
            Node::Accurate(a, b) => self.accurate(a, b),
            Node::Sum(length, body) => self.sum(length, body),
            node => self.leaf(node),
        }
    }

    /// The expression with every stretch replaced.
    pub fn substitute(&mut self, id: Id, stretches: [Id; 3]) -> Id {
        once!(
            self.substitutions,
            (id, stretches),
            match *self.node(id) {
                Node::Stretch(i) => stretches[i],
                Node::Extended(function, order, i) => match *self.node(stretches[i]) {
                    Node::Stretch(j) => self.leaf(Node::Extended(function, order, j)),
                    // Extended functions are functions of a stretch alone; NaN would be noticed.
                    _ => self.leaf(Node::Float(f64::NAN.to_bits())),
                },
                _ => self.map_children(id, &mut |graph, child| graph.substitute(child, stretches)),
            }
        )
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
