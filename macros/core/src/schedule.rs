//! The order of operations: from an expression graph to straight-line programs with loops over lists.
//!
//! Operations are numbered by value: each is computed once, and one that does not change from one entry of a
//! list to the next is computed before the loop. All sums over lists of one length share one loop, unless one
//! needs the result of another. Common parts of products and sums are computed first, if they stay within the
//! range of the number format. Of the powers b^(α+k) with one α, only one is a real power: the others follow
//! by multiplication with b, so that N terms of an Ogden energy need 3N real powers for everything, and all
//! powers of one base are made from one logarithm.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::expr::{Exponent, Function, Graph, Id, Length, Node};
use crate::algebra::rational::Rational;
pub use collect::Collector;
use order::Order;
use parts::Parts;
use passes::{fuse_multiply_add, renumber};
use powers::{Evaluation, Powers};
pub use program::{Block, Op, Program, Value};

mod collect;
pub mod count;
mod degrees;
mod order;
mod parts;
mod passes;
mod powers;
mod program;
mod shifts;

/// Orders the computation of the roots only. The collector keeps its findings for the next program of the
/// same graph.
#[must_use]
pub fn schedule(graph: &mut Graph, collector: &mut Collector, roots: &[Id]) -> Program {
    let powers = Powers::used_by(graph, &graph.reachable(roots));
    let mut roots = collector.collect(graph, roots);
    let mut reachable = graph.reachable(&roots);
    let has_sums = reachable.iter().any(|&id| matches!(graph.node(id), Node::Sum(..)));
    if has_sums {
        roots = shifts::take_out(graph, &powers, &roots);
        // Once more, for the factors that have come out of sums over lists.
        roots = collector.collect(graph, &roots);
        reachable = graph.reachable(&roots);
    }
    let order = Order::of(graph, &mut collector.degrees, &reachable);
    let parts = Parts::of(graph, &reachable);
    let mut scheduler = Scheduler {
        graph,
        powers,
        order,
        parts,
        count: 0,
        blocks: Vec::new(),
        numbers: FxHashMap::default(),
        values: FxHashMap::default(),
        body: None,
        varying: FxHashSet::default(),
    };
    if has_sums {
        scheduler.loops(&reachable);
    }
    let outputs = roots.into_iter().map(|root| scheduler.value(root)).collect();
    let Scheduler { blocks, count, .. } = scheduler;
    renumber(fuse_multiply_add(Program { blocks, outputs }, count), count)
}

struct Scheduler<'g> {
    graph: &'g mut Graph,
    powers: Powers,
    order: Order<'g>,
    parts: Parts,
    count: usize,
    blocks: Vec<Block>,
    numbers: FxHashMap<Op, Value>,
    values: FxHashMap<Id, Value>,
    /// The operations of the open loop, which depend on the current entry.
    body: Option<Vec<(Value, Op)>>,
    /// Their values.
    varying: FxHashSet<Value>,
}

impl Scheduler<'_> {
    /// Puts sums first, in the order of their dependencies, those of one length together.
    fn loops(&mut self, reachable: &[Id]) {
        let mut depth: FxHashMap<Id, usize> = FxHashMap::default();
        let mut sums: Sorted<(usize, Length), Vec<(Id, Id)>> = Sorted::new();
        for &id in reachable {
            let inner = self.graph.children(id).iter().map(|child| depth[child]).max().unwrap_or(0);
            let own = if let Node::Sum(length, body) = *self.graph.node(id) {
                entry(&mut sums, (inner, length)).push((id, body));
                inner + 1
            } else {
                inner
            };
            depth.insert(id, own);
        }
        for ((_, length), sums) in sums {
            self.body = Some(Vec::new());
            let terms: Vec<_> = sums.iter().map(|&(_, body)| self.value(body)).collect();
            let body = self.body.take().unwrap_or_default();
            // What depends on the entry has no value outside its loop.
            let varying = std::mem::take(&mut self.varying);
            self.numbers.retain(|_, value| !varying.contains(value));
            self.values.retain(|_, value| !varying.contains(value));
            let mut totals = Vec::new();
            for ((sum, _), term) in sums.into_iter().zip(terms) {
                let total = self.fresh();
                totals.push((total, term));
                self.values.insert(sum, total);
            }
            self.blocks.push(Block { length: Some(length), body, totals });
        }
    }

    fn fresh(&mut self) -> Value {
        self.count += 1;
        Value(self.count - 1)
    }

    /// Appends an operation, inside the open loop only if it depends on the entry.
    fn push(&mut self, op: Op) -> Value {
        let op = match op {
            Op::Add(a, b) if b < a => Op::Add(b, a),
            Op::Mul(a, b) if b < a => Op::Mul(b, a),
            op => op,
        };
        if let Some(&value) = self.numbers.get(&op) {
            return value;
        }
        let value = self.fresh();
        let varies =
            matches!(op, Op::Entry(_)) || op.operands().iter().any(|operand| self.varying.contains(operand));
        match &mut self.body {
            Some(body) if varies => {
                body.push((value, op));
                self.varying.insert(value);
            }
            _ => match self.blocks.last_mut().filter(|block| block.length.is_none()) {
                Some(block) => block.body.push((value, op)),
                None => self.blocks.push(Block { body: vec![(value, op)], ..Block::default() }),
            },
        }
        self.numbers.insert(op, value);
        value
    }

    fn value(&mut self, id: Id) -> Value {
        once!(self.values, id, self.compute(id))
    }

    fn literal(&mut self, value: Rational) -> Value {
        self.push(Op::Literal(value.to_f64().to_bits()))
    }

    fn compute(&mut self, id: Id) -> Value {
        let op = match self.graph.node(id).clone() {
            Node::Stretch(i) => Op::Stretch(i),
            Node::Strain(i) => Op::Strain(i),
            Node::Parameter(k) => Op::Parameter(k),
            Node::Entry(k) => Op::Entry(k),
            Node::Float(bits) => Op::Literal(bits),
            Node::Epsilon => Op::Epsilon,
            Node::Linear { constant, terms } => return self.linear(constant, &terms),
            Node::Product(_) => {
                let factors = self.order.balanced(self.graph, id);
                let powers: Vec<_> = factors.iter().map(|&(base, e)| self.power(base, e)).collect();
                return powers
                    .into_iter()
                    .reduce(|a, b| self.push(Op::Mul(a, b)))
                    .unwrap_or_else(|| self.literal(Rational::ONE));
            }
            Node::Excess(squares, _) => Op::AboveZero(self.value(squares)),
            Node::Accurate(value, _) => return self.value(value),
            Node::Apply(Function::Ln, a) => {
                // ln J, which is defined where J itself is out of range.
                if let Node::Product(factors) = self.graph.node(a)
                    && let &[(a, Exponent::ONE), (b, Exponent::ONE), (c, Exponent::ONE)] = &factors[..]
                    && [a, b, c].iter().all(|&id| matches!(self.graph.node(id), Node::Stretch(_)))
                {
                    Op::LnProduct([a, b, c].map(|id| self.value(id)))
                } else {
                    Op::Ln(self.value(a))
                }
            }
            Node::Apply(Function::Exp, a) => Op::Exp(self.value(a)),
            Node::Apply(Function::Elementary(function), a) => Op::Elementary(function, self.value(a)),
            Node::Apply(Function::Power(exponent), a) => return self.power(a, exponent),
            Node::Apply(Function::WholePower(n, order), base) => {
                Op::WholePower(self.value(base), self.value(n), order)
            }
            Node::Apply(Function::Given(k, order), a) => Op::Function(k, order, self.value(a)),
            Node::Quotient(Function::Elementary(function), a, b) => {
                Op::ElementaryQuotient(function, self.value(a), self.value(b))
            }
            Node::Quotient(Function::Given(k, order), a, b) => {
                Op::FunctionQuotient(k, order, self.value(a), self.value(b))
            }
            Node::Quotient(Function::WholePower(n, order), a, b) => {
                Op::WholePowerQuotient([a, b].map(|id| self.value(id)), self.value(n), order)
            }
            Node::Above(i) => Op::Max(self.push(Op::Stretch(i)), self.push(Op::Epsilon)),
            Node::Below(i) => Op::Below(self.push(Op::Stretch(i)), self.push(Op::Epsilon)),
            Node::ShareAbove(i, j) => {
                let [a, b, epsilon] = [Op::Stretch(i), Op::Stretch(j), Op::Epsilon].map(|op| self.push(op));
                Op::ShareAbove(a, b, epsilon)
            }
            Node::ShareBelow(i, j) => {
                let [a, b, epsilon] = [Op::Stretch(i), Op::Stretch(j), Op::Epsilon].map(|op| self.push(op));
                Op::ShareBelow(a, b, epsilon)
            }
            Node::WhereNegative(condition, a, b) => {
                Op::WhereNegative(self.value(condition), self.value(a), self.value(b))
            }
            Node::Quotient(Function::Ln, a, b) => Op::LnQuotient(self.pair(a, b)),
            Node::Quotient(Function::Exp, a, b) => {
                let values = [a, b].map(|id| self.value(id));
                let exponentials = values.map(|value| self.push(Op::Exp(value)));
                Op::ExpQuotient { values, exponentials }
            }
            Node::Quotient(Function::Power(exponent), a, b) => {
                let pair = self.pair(a, b);
                let powers = [a, b].map(|base| self.power(base, exponent));
                Op::PowerQuotient { pair, powers, exponent: self.exponent(exponent) }
            }
            Node::PoleQuotient(numerator, sum) => {
                let (numerator, sum) = (self.value(numerator), self.value(sum));
                let floor = self.push(Op::PoleFloor);
                Op::Div(numerator, self.push(Op::Max(sum, floor)))
            }
            // Sums are computed before the operations that need them, and extended functions are written out
            // before scheduling; NaN would be noticed.
            Node::Sum(..) | Node::Extended(..) => Op::Literal(f64::NAN.to_bits()),
        };
        self.push(op)
    }

    fn linear(&mut self, constant: Rational, terms: &[(Id, Rational)]) -> Value {
        let sum = self.parts.regrouped(constant, terms);
        let (constant, mut groups) = (sum.0, self.parts.groups(&sum));
        // Added terms come first, subtracted ones next, the constant last.
        let is_subtracted = |group: &Vec<(Id, Rational)>| group.iter().all(|(_, c)| c.is_negative());
        groups.sort_by_key(is_subtracted);
        let mut sum: Option<Value> = None;
        for group in &groups {
            let is_subtracted = is_subtracted(group);
            let value = self.multiple(group, is_subtracted);
            sum = Some(match (sum, is_subtracted) {
                (None, false) => value,
                (Some(sum), false) => self.push(Op::Add(sum, value)),
                (Some(sum), true) => self.push(Op::Sub(sum, value)),
                (None, true) if constant.is_zero() || constant.is_negative() => self.push(Op::Neg(value)),
                // A positive constant saves the change of sign.
                (None, true) => {
                    let literal = self.literal(constant);
                    self.push(Op::Sub(literal, value))
                }
            });
        }
        let is_used = groups.first().is_some_and(is_subtracted) && !constant.is_negative();
        match sum {
            None => self.literal(constant),
            Some(sum) if constant.is_zero() || is_used => sum,
            Some(sum) => {
                let literal = self.literal(constant.magnitude());
                self.push(if constant.is_negative() { Op::Sub(sum, literal) } else { Op::Add(sum, literal) })
            }
        }
    }

    /// Terms with one coefficient except for signs, or their negative: c s − c t is c (s − t).
    fn multiple(&mut self, terms: &[(Id, Rational)], is_negated: bool) -> Value {
        let sum = match terms {
            &[(term, _)] => self.value(term),
            terms => {
                let sign =
                    |c: Rational| Rational::integer(if c.is_negative() == is_negated { 1 } else { -1 });
                let signs: Vec<_> = terms.iter().map(|&(term, c)| (term, sign(c))).collect();
                self.linear(Rational::ZERO, &signs)
            }
        };
        match terms.first().map(|(_, c)| c.magnitude()) {
            Some(c) if c != Rational::ONE => {
                let factor = self.literal(c);
                self.push(Op::Mul(sum, factor))
            }
            _ => sum,
        }
    }

    fn power(&mut self, base: Id, exponent: Exponent) -> Value {
        if self.graph.as_constant(base) == Some(Rational::ONE) {
            return self.literal(Rational::ONE);
        }
        let value = self.value(base);
        let Exponent { real, rational } = exponent;
        match self.powers.evaluation(base, exponent) {
            Evaluation::Real(representative) => {
                let computed = self.exponent(Exponent { real, rational: representative });
                let power = self.real_power(value, computed);
                let shift = rational.checked_add(representative.negated()).and_then(Rational::as_integer);
                match shift {
                    Some(0) | None => power,
                    Some(n) => {
                        let factor = self.whole_power(value, n);
                        self.push(Op::Mul(power, factor))
                    }
                }
            }
            Evaluation::Root(degree) => {
                let root = match degree {
                    1 => value,
                    2 => self.push(Op::Sqrt(value)),
                    3 => self.push(Op::Cbrt(value)),
                    _ => {
                        let exponent = self.push(Op::Literal((1.0 / degree as f64).to_bits()));
                        self.real_power(value, exponent)
                    }
                };
                let whole = rational.numerator().checked_mul(degree / rational.denominator());
                self.whole_power(root, whole.and_then(|n| i64::try_from(n).ok()).unwrap_or(i64::MAX))
            }
        }
    }

    fn real_power(&mut self, base: Value, exponent: Value) -> Value {
        let logarithm = self.push(Op::Logarithm(base));
        self.push(Op::Power(logarithm, exponent))
    }

    fn pair(&mut self, a: Id, b: Id) -> Value {
        let values = [a, b].map(|id| self.value(id));
        let reciprocals = [a, b].map(|base| self.power(base, Exponent::integer(-1)));
        let logarithms = values.map(|value| self.push(Op::Logarithm(value)));
        self.push(Op::Pair { values, reciprocals, logarithms })
    }

    fn whole_power(&mut self, base: Value, n: i64) -> Value {
        match n {
            1 => base,
            n if n <= 0 => {
                let one = self.literal(Rational::ONE);
                if n == 0 {
                    return one;
                }
                let reciprocal = self.push(Op::Div(one, base));
                self.whole_power(reciprocal, -n)
            }
            n => {
                let half = self.whole_power(base, n / 2);
                let square = self.push(Op::Mul(half, half));
                if n % 2 == 0 { square } else { self.push(Op::Mul(square, base)) }
            }
        }
    }

    fn exponent(&mut self, exponent: Exponent) -> Value {
        let id = self.graph.exponent_value(exponent);
        self.value(id)
    }
}

/// A short map: a list in the order of its keys. This crate is compiled before every crate that declares a
/// material, and a list is compiled, and searched for one of a few entries, in less time than a tree.
type Sorted<K, V> = Vec<(K, V)>;

/// The value of a key, initially the default.
fn entry<K: Ord, V: Default>(map: &mut Sorted<K, V>, key: K) -> &mut V {
    let k = map.binary_search_by(|(other, _)| other.cmp(&key)).unwrap_or_else(|k| {
        map.insert(k, (key, V::default()));
        k
    });
    &mut map[k].1
}
