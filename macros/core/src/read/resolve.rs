//! The resolver: from the syntax of an energy, whose names get their meaning, to an expression graph.

use std::collections::{HashMap, HashSet};

use quote::ToTokens;
use syn::{BinOp, Expr, Ident, Lit, Pat, Stmt, UnOp};

use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::power_sums::without_stretches;
use crate::algebra::rational::Rational;
use crate::read::diagnostics::Diagnostics;
use crate::read::notation::digits;
use crate::read::parse::{Declaration, identifiers, indexed_list, is_f64};
use crate::read::spelling::taken;
pub(crate) use names::constant;
pub use paper_notation::advice;
use sums::Index;

mod calls;
mod names;
mod paper_notation;
mod stretches;
mod sums;
mod tensors;

/// A resolver of the names of one declaration.
pub struct Resolver<'a> {
    declaration: &'a Declaration,
    graph: &'a mut Graph,
    diagnostics: &'a mut Diagnostics,
    /// The names that may be used.
    scope: Scope,
    /// let-bindings in scope.
    bindings: HashMap<String, Id>,
    /// Names of all let-bindings so far.
    bound: HashSet<String>,
    /// The index of the enclosing sum.
    index: Option<Index>,
    /// Names that were used or reported.
    used: HashSet<String>,
    /// Names whose own declaration is a mistake.
    mistaken: HashSet<String>,
    /// The nodes of all resolved expressions.
    pub(crate) nodes: Nodes,
}

/// Terms of a sum that is built and underlined as a whole, and not from the sum of all terms but the last.
pub(crate) const LONG_SUM: usize = 64;

/// The node of a mistake: NaN, which no literal has.
const UNKNOWN: Node = Node::Float(f64::NAN.to_bits());

/// The message about a power in the notation of another language.
const POWER: &str = "a power is written `x.powi(2)` or `x.powf(alpha)`";

/// The message about a closure or a function inside the body.
const NO_HELPERS: &str = "an energy has no helpers: write a sum over the three stretches as `sum(|l| …)`, and name \
     parts by `let`, also in a sum: `sum(|p| { let s = …; … })`";

/// The energy with I1, I2, J in the places of the three stretches, the bounds of its domain, and true if the
/// energy is written in the invariants, and not in sums over the stretches that they determine; `None` if a
/// stretch is named outside of such sums. The declaration must be free of mistakes.
pub fn resolve_by_invariants(declaration: &Declaration, graph: &mut Graph) -> Option<(Id, Vec<Id>, bool)> {
    let mut diagnostics = Diagnostics::default();
    let mut resolver =
        Resolver { scope: Scope::Invariants, ..Resolver::new(declaration, graph, &mut diagnostics) };
    let written = resolver.energy();
    let bounds: Vec<_> = declaration.bounds().filter_map(|condition| resolver.bound(condition)).collect();
    if !diagnostics.is_clean() {
        return None;
    }
    let energy = without_stretches(graph, written)?;
    let bounds = bounds.into_iter().map(|bound| without_stretches(graph, bound)).collect::<Option<_>>()?;
    Some((energy, bounds, energy == written))
}

/// The energy with I1b, I2b in the places of I1, I2. The declaration must be free of mistakes.
pub fn isochoric(declaration: &Declaration, graph: &mut Graph) -> Id {
    let mut diagnostics = Diagnostics::default();
    Resolver { scope: Scope::Isochoric, ..Resolver::new(declaration, graph, &mut diagnostics) }.energy()
}

/// The variables of an expression.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Scope {
    /// λ1, λ2, λ3 and the parameters.
    Stretches,
    /// λ1, λ2, λ3 and the parameters, with I1b and I2b wherever I1 and I2 are written.
    Isochoric,
    /// I1, I2, J and the parameters, with strains in the places of λ1, λ2, λ3.
    Invariants,
    /// The parameters alone, in a condition that the constructor evaluates.
    Parameters,
}

/// The node of each expression of a declaration, found by its address: declarations do not move.
#[derive(Debug, Default)]
pub struct Nodes(HashMap<*const Expr, Id>);

impl Nodes {
    /// The node of an expression of the declaration.
    #[must_use]
    pub fn of(&self, expression: &Expr) -> Option<Id> {
        self.0.get(&std::ptr::from_ref(expression)).copied()
    }

    pub(crate) fn replace(&mut self, mut with: impl FnMut(Id) -> Id) {
        self.0.values_mut().for_each(|id| *id = with(*id));
    }
}

impl<'a> Resolver<'a> {
    /// A resolver for the body and the conditions of one declaration.
    pub fn new(declaration: &'a Declaration, graph: &'a mut Graph, diagnostics: &'a mut Diagnostics) -> Self {
        for i in 0..3 {
            graph.stretch(i);
        }
        Self {
            declaration,
            graph,
            diagnostics,
            scope: Scope::Stretches,
            bindings: HashMap::new(),
            bound: HashSet::new(),
            index: None,
            used: HashSet::new(),
            mistaken: declaration.mistaken.iter().map(Ident::to_string).collect(),
            nodes: Nodes::default(),
        }
    }

    /// The energy of the body; unused names are mistakes.
    pub fn energy(&mut self) -> Id {
        let energy = self.block(&self.declaration.body);
        for parameter in &self.declaration.parameters {
            if !self.used.contains(&parameter.name.to_string()) {
                self.diagnostics.error(
                    &parameter.name,
                    format!("`{}` does not occur in the energy: use it or remove it", parameter.name),
                );
            }
        }
        energy
    }

    /// The difference that a comparison of the domain requires to be positive, `left − right` or `right −
    /// left`.
    pub fn bound(&mut self, comparison: &Expr) -> Option<Id> {
        let difference = self.difference(comparison);
        if difference.is_none() {
            self.error(
                comparison,
                "only a volume can be left out of a domain, `J != 0.0`: write others with `<` or `>`",
            );
        }
        difference
    }

    /// The difference that a comparison of parameters requires to be positive. A comparison of entries
    /// `mu[p]` is summed: enough to steer samples, which use equal signs for all entries.
    pub fn condition(&mut self, comparison: &Expr) -> Option<Id> {
        let outer = std::mem::replace(&mut self.scope, Scope::Parameters);
        self.index = indexed_list(comparison).map(|(_, index)| Index::new(index));
        let difference = self.difference(comparison);
        self.scope = outer;
        match self.index.take() {
            Some(Index { length: Some(length), .. }) => {
                difference.map(|difference| self.graph.sum(length, difference))
            }
            _ => difference,
        }
    }

    fn difference(&mut self, comparison: &Expr) -> Option<Id> {
        let Expr::Binary(binary) = comparison else { return None };
        let (left, right) = (self.expression(&binary.left), self.expression(&binary.right));
        match binary.op {
            BinOp::Gt(_) | BinOp::Ge(_) => Some(self.graph.sub(left, right)),
            BinOp::Lt(_) | BinOp::Le(_) => Some(self.graph.sub(right, left)),
            _ => None,
        }
    }

    fn block(&mut self, block: &syn::Block) -> Id {
        let outer = self.bindings.clone();
        let mut locals: Vec<Ident> = Vec::new();
        let mut result = None;
        for (k, statement) in block.stmts.iter().enumerate() {
            let is_last = k + 1 == block.stmts.len();
            match statement {
                Stmt::Local(local) => locals.extend(self.binding(local)),
                Stmt::Expr(expression, None) if is_last => result = Some(self.expression(expression)),
                Stmt::Expr(expression, Some(semicolon)) if is_last => {
                    result = Some(self.expression(expression));
                    if !matches!(expression, Expr::Return(_)) {
                        self.error(semicolon, "the last line of an energy is its value: remove this `;`");
                    }
                }
                Stmt::Item(syn::Item::Fn(helper)) => {
                    self.mistaken.insert(helper.sig.ident.to_string());
                    self.error(helper, NO_HELPERS);
                }
                other => self.error(other, "an energy is `let` bindings and one expression at the end"),
            }
        }
        let result = result.unwrap_or_else(|| match block.stmts.last() {
            Some(last) => self.mistake(last, "after this line an energy ends with its value, without `;`"),
            None => self.mistake(block, "an energy is missing here, such as `mu / 2.0 * (I1 - 3.0)`"),
        });
        for name in locals {
            if !self.used.contains(&name.to_string()) {
                self.error(&name, &format!("`{name}` is not used: remove it"));
            }
        }
        self.bindings = outer;
        result
    }

    fn binding(&mut self, local: &syn::Local) -> Option<Ident> {
        let pattern = match &local.pat {
            Pat::Type(typed) if is_f64(&typed.ty) => &*typed.pat,
            pattern => pattern,
        };
        let name = match pattern {
            Pat::Ident(name) if name.mutability.is_none() && name.by_ref.is_none() => Some(&name.ident),
            _ => None,
        };
        let (Some(name), Some(init)) = (name, &local.init) else {
            let names = identifiers(local.pat.to_token_stream()).into_iter().map(|name| name.to_string());
            self.mistaken.extend(names);
            self.error(local, "write `let name = expression;`");
            return None;
        };
        let value = self.expression(&init.expr);
        if self.is_taken(name) {
            self.error(name, &taken(name));
            return None;
        }
        self.bindings.insert(name.to_string(), value);
        self.bound.insert(name.to_string());
        if self.is_unknown(value) {
            self.mistaken.insert(name.to_string());
            return None;
        }
        Some(name.clone())
    }

    fn expression(&mut self, expression: &Expr) -> Id {
        let id = self.resolve(expression);
        self.note(expression, id)
    }

    /// Records the node of an expression.
    fn note(&mut self, expression: &Expr, mut id: Id) -> Id {
        // The innermost expression that overflows reports it and is marked as a mistake.
        if self.graph.take_overflow() {
            id = self.mistake(expression, "the exact fraction here leaves 128 bits: use smaller numbers");
        }
        self.nodes.0.insert(std::ptr::from_ref(expression), id);
        id
    }

    fn resolve(&mut self, expression: &Expr) -> Id {
        match expression {
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Path(path) => match path.path.get_ident() {
                Some(name) => self.name(name),
                None => self.constant(&path.path),
            },
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Group(inner) => self.expression(&inner.expr),
            Expr::Block(inner) if self.scope == Scope::Parameters => {
                self.excuse_names(inner);
                self.mistake(inner, "a condition has no `{ … }`: write out here what its names stand for")
            }
            Expr::Block(inner) => self.block(&inner.block),
            Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) => {
                    let value = self.expression(&unary.expr);
                    self.graph.neg(value)
                }
                UnOp::Deref(_) => self.mistake(unary.op, POWER),
                _ => self.mistake(unary.op, "only `-` stands before a number"),
            },
            Expr::Binary(binary) => self.binary(binary),
            Expr::MethodCall(call) => self.method(call),
            Expr::Index(index) => self.entry(index),
            Expr::Call(call) => self.call(call),
            Expr::If(syn::ExprIf { if_token: word, .. }) => self.branch(word, expression),
            Expr::Match(syn::ExprMatch { match_token: word, .. }) => self.branch(word, expression),
            Expr::Cast(cast) => {
                self.excuse_names(cast);
                self.mistake(&cast.ty, "all numbers of an energy are `f64`: remove the cast")
            }
            Expr::Return(syn::ExprReturn { return_token, expr: Some(value), .. }) => {
                self.error(return_token, "the last line of an energy is its value: write it without `return` and `;`");
                self.expression(value)
            }
            Expr::Array(array) if array.elems.len() == 1 => {
                self.mistake(expression, "parentheses are round in an energy: write `( … )`")
            }
            Expr::Array(_) | Expr::Repeat(_) => self.mistake(
                expression,
                "lists are parameters, as `mu: [f64; N]`: numbers of the energy itself are written out, term by term",
            ),
            Expr::Closure(closure) => self.mistake(closure, NO_HELPERS),
            other => self.mistake(
                other,
                "an energy is made of numbers, parameters, stretches, `+ - * /`, `sum(|p| …)` and calls such as `x.ln()`",
            ),
        }
    }

    fn branch(&mut self, word: impl ToTokens, expression: &Expr) -> Id {
        self.excuse_names(expression);
        self.mistake(
            word,
            "an energy has no branches, at which its derivatives would jump: a domain is declared by `domain(…)`, and a function with \
             branches is a parameter whose type implements `piola::Univariate`",
        )
    }

    /// A loop along the left sides, which nest as deep as a sum has terms.
    fn binary(&mut self, binary: &syn::ExprBinary) -> Id {
        let mut left_sides = Vec::new();
        let mut leftmost = &*binary.left;
        while let Expr::Binary(left) = leftmost {
            left_sides.push((leftmost, left));
            leftmost = &left.left;
        }
        let is_long = left_sides.len() >= LONG_SUM;
        let mut value = self.expression(leftmost);
        // Terms of a long sum, which is not built once more for each of them.
        let mut pending = Vec::new();
        for (k, (expression, left)) in left_sides.into_iter().rev().enumerate() {
            if let (true, Some(sign)) = (is_long, sign(left)) {
                pending.push((self.expression(&left.right), sign));
                if k % LONG_SUM > 0 {
                    continue;
                }
            }
            let sum = self.with_terms(value, &mut pending);
            let id = if is_long && sign(left).is_some() { sum } else { self.connect(sum, left) };
            value = self.note(expression, id);
        }
        let value = self.with_terms(value, &mut pending);
        self.connect(value, binary)
    }

    fn with_terms(&mut self, sum: Id, terms: &mut Vec<(Id, Rational)>) -> Id {
        if terms.is_empty() {
            return sum;
        }
        terms.push((sum, Rational::ONE));
        self.graph.linear(Rational::ZERO, &std::mem::take(terms))
    }

    /// The value of a binary expression whose left side has this one.
    fn connect(&mut self, left: Id, binary: &syn::ExprBinary) -> Id {
        let right = self.expression(&binary.right);
        match binary.op {
            BinOp::Add(_) => self.graph.add(left, right),
            BinOp::Sub(_) => self.graph.sub(left, right),
            BinOp::Mul(_) => self.graph.mul(left, right),
            BinOp::Div(_) if self.graph.is_zero(right) => self.mistake(&binary.right, "division by zero"),
            BinOp::Div(_) => self.graph.div(left, right),
            BinOp::BitXor(_) => self.mistake(binary.op, POWER),
            BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Eq(_) | BinOp::Ne(_) => self
                .mistake(
                    binary.op,
                    "an energy has no comparisons: conditions stand in `domain(…)` or `admissible(…)`",
                ),
            _ => self.mistake(binary.op, "only `+ - * /` connect numbers in an energy"),
        }
    }

    fn literal(&mut self, literal: &Lit) -> Id {
        let Some((digits, suffix)) = digits(literal) else {
            return self.mistake(literal, "a literal in an energy is a number");
        };
        match suffix {
            "" | "f64" => {}
            _ if is_numeric_type(suffix) => {
                return self.mistake(literal, "numbers of an energy are `f64`: remove the suffix");
            }
            // Papers write products in this way.
            name => {
                self.used.insert(name.to_owned());
                let message =
                    format!("`{digits}{name}` is not a number: write `{digits} * {name}` for a product");
                return self.mistake(literal, &message);
            }
        }
        if let Some(exact) = Rational::from_decimal(digits) {
            return self.graph.constant(exact);
        }
        match digits.parse::<f64>() {
            Ok(value) if value.is_finite() => self.graph.leaf(Node::Float(value.to_bits())),
            _ => {
                let limit = self.diagnostics.notation().either("not finite in `f64`", "too large");
                self.mistake(literal, &format!("this number is {limit}: write a smaller one"))
            }
        }
    }

    fn mistake(&mut self, tokens: impl ToTokens, message: &str) -> Id {
        self.error(tokens, message);
        self.unknown()
    }

    /// The node of a mistake: NaN, so that nothing cancels it and no rule for numbers applies.
    fn unknown(&mut self) -> Id {
        self.graph.leaf(UNKNOWN)
    }

    /// True if a value depends on a mistake.
    fn is_unknown(&self, value: Id) -> bool {
        self.graph.contains(value, |node| *node == UNKNOWN)
    }

    fn error(&mut self, tokens: impl ToTokens, message: &str) {
        self.excuse_names(&tokens);
        self.diagnostics.error(tokens, message);
    }

    /// Marks the names in a construct that was already rejected as used, so that they are not reported again
    /// as unused.
    fn excuse_names(&mut self, tokens: impl ToTokens) {
        let names = identifiers(tokens.into_token_stream());
        self.used.extend(names.iter().map(Ident::to_string));
    }
}

/// The sign of the right side in a sum.
fn sign(binary: &syn::ExprBinary) -> Option<Rational> {
    match binary.op {
        BinOp::Add(_) => Some(Rational::ONE),
        BinOp::Sub(_) => Some(Rational::ONE.negated()),
        _ => None,
    }
}

fn is_numeric_type(suffix: &str) -> bool {
    const BITS: [&str; 6] = ["8", "16", "32", "64", "128", "size"];
    suffix.strip_prefix(['i', 'u']).is_some_and(|bits| BITS.contains(&bits))
        || matches!(suffix, "f16" | "f32" | "f64" | "f128")
}
