//! From the syntax of an energy to its expression graph: names get their meaning.

use std::collections::{HashMap, HashSet};

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, Ident, Lit, Pat, Stmt, UnOp};

use crate::diagnostics::Diagnostics;
use crate::expr::{Exponent, Graph, Id, Length, Node};
use crate::parse::{Declaration, WORDS};
use crate::rational::Rational;

/// Functions that can be called on a number, with what to write.
const METHODS: [&str; 7] = ["powi", "powf", "ln", "exp", "sqrt", "cbrt", "recip"];

/// Gives names their meaning in one declaration.
pub struct Resolver<'a> {
    declaration: &'a Declaration,
    graph: &'a mut Graph,
    diagnostics: &'a mut Diagnostics,
    /// What the three stretches of the graph stand for.
    arguments: Arguments,
    /// let-bindings in scope.
    bindings: HashMap<String, Id>,
    /// The index of the sum around, with the length of the lists it has indexed so far.
    index: Option<(Ident, Option<Length>)>,
    /// Names that were read.
    used: HashSet<String>,
}

/// What an energy is a function of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Arguments {
    /// λ1, λ2, λ3.
    Stretches,
    /// I1, I2, J.
    Invariants,
}

impl<'a> Resolver<'a> {
    /// For the body and the conditions of one declaration.
    pub fn new(declaration: &'a Declaration, graph: &'a mut Graph, diagnostics: &'a mut Diagnostics) -> Self {
        for i in 0..3 {
            graph.stretch(i);
        }
        let arguments = Arguments::Stretches;
        let (bindings, index, used) = (HashMap::new(), None, HashSet::new());
        Self { declaration, graph, diagnostics, arguments, bindings, index, used }
    }

    /// The same with I1, I2, J in the places of the three stretches, whose names are mistakes.
    pub fn of_invariants(
        declaration: &'a Declaration,
        graph: &'a mut Graph,
        diagnostics: &'a mut Diagnostics,
    ) -> Self {
        Self { arguments: Arguments::Invariants, ..Self::new(declaration, graph, diagnostics) }
    }

    /// The energy of the body; unused names are mistakes.
    pub fn energy(&mut self) -> Id {
        let energy = self.block(&self.declaration.body);
        for parameter in &self.declaration.parameters {
            if !self.used.contains(&parameter.name.to_string()) {
                self.diagnostics.error(
                    parameter.name.span(),
                    format!("`{}` does not occur in the energy: use it or remove it", parameter.name),
                );
            }
        }
        energy
    }

    /// The difference that a comparison wants positive, `left − right` or `right − left`.
    pub fn condition(&mut self, comparison: &Expr) -> Option<Id> {
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
                other => {
                    self.error(other.span(), "an energy is `let` bindings and one expression at the end")
                }
            }
        }
        let result = result.unwrap_or_else(|| {
            self.error(block.span(), "the last line of an energy is its value, without `;`");
            self.graph.integer(0)
        });
        for name in locals {
            if !self.used.contains(&name.to_string()) {
                self.error(name.span(), &format!("`{name}` is not used: remove it"));
            }
        }
        self.bindings = outer;
        result
    }

    fn binding(&mut self, local: &syn::Local) -> Option<Ident> {
        let name = match &local.pat {
            Pat::Ident(name) if name.mutability.is_none() && name.by_ref.is_none() => Some(&name.ident),
            _ => None,
        };
        let (Some(name), Some(init)) = (name, &local.init) else {
            self.error(local.span(), "write `let name = expression;`");
            return None;
        };
        let value = self.expression(&init.expr);
        let text = name.to_string();
        if self.is_taken(name) {
            self.error(name.span(), &format!("the name `{text}` is taken already"));
            return None;
        }
        self.bindings.insert(text, value);
        Some(name.clone())
    }

    fn is_taken(&self, name: &Ident) -> bool {
        let text = name.to_string();
        WORDS.contains(&text.as_str())
            || text == "sum"
            || self.declaration.stretches.contains(name)
            || self.declaration.parameters.iter().any(|parameter| parameter.name == *name)
    }

    fn expression(&mut self, expression: &Expr) -> Id {
        match expression {
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Path(path) => match path.path.get_ident() {
                Some(name) => self.name(name),
                None => self.mistake(path.span(), "a name here is a parameter, a stretch or a `let` binding"),
            },
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Group(inner) => self.expression(&inner.expr),
            Expr::Block(inner) => self.block(&inner.block),
            Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) => {
                    let value = self.expression(&unary.expr);
                    self.graph.neg(value)
                }
                _ => self.mistake(unary.span(), "only `-` stands before a number"),
            },
            Expr::Binary(binary) => self.binary(binary),
            Expr::MethodCall(call) => self.method(call),
            Expr::Index(index) => self.entry(index),
            Expr::Call(call) => self.call(call),
            Expr::If(_) | Expr::Match(_) => self.mistake(
                expression.span(),
                "an energy has no branches: its derivatives would jump; a domain is declared by `domain(…)`",
            ),
            other => self.mistake(
                other.span(),
                "an energy is made of numbers, parameters, stretches, `+ - * /`, `sum(|p| …)` and calls such as `x.ln()`",
            ),
        }
    }

    fn binary(&mut self, binary: &syn::ExprBinary) -> Id {
        let (left, right) = (self.expression(&binary.left), self.expression(&binary.right));
        match binary.op {
            BinOp::Add(_) => self.graph.add(left, right),
            BinOp::Sub(_) => self.graph.sub(left, right),
            BinOp::Mul(_) => self.graph.mul(left, right),
            BinOp::Div(_) if self.graph.is_zero(right) => {
                self.mistake(binary.right.span(), "division by zero")
            }
            BinOp::Div(_) => self.graph.div(left, right),
            BinOp::BitXor(_) => {
                self.mistake(binary.op.span(), "a power is written `x.powi(2)` or `x.powf(alpha)`")
            }
            _ => self.mistake(binary.op.span(), "only `+ - * /` connect numbers in an energy"),
        }
    }

    fn literal(&mut self, literal: &Lit) -> Id {
        let (digits, suffix) = match literal {
            Lit::Float(number) => (number.base10_digits().to_owned(), number.suffix()),
            Lit::Int(number) => (number.base10_digits().to_owned(), number.suffix()),
            _ => return self.mistake(literal.span(), "a literal in an energy is a number"),
        };
        if !matches!(suffix, "" | "f64") {
            return self.mistake(literal.span(), "numbers of an energy are `f64`: remove the suffix");
        }
        if let Some(exact) = Rational::from_decimal(&digits) {
            return self.graph.constant(exact);
        }
        match digits.parse::<f64>() {
            Ok(value) if value.is_finite() => self.graph.leaf(Node::Float(value.to_bits())),
            _ => self.mistake(literal.span(), "this number is not finite in `f64`"),
        }
    }

    fn name(&mut self, name: &Ident) -> Id {
        let text = name.to_string();
        self.used.insert(text.clone());
        if let Some(&bound) = self.bindings.get(&text) {
            return bound;
        }
        if let Some(i) = self.declaration.stretches.iter().position(|stretch| stretch == name) {
            if self.arguments == Arguments::Invariants {
                return self.mistake(name.span(), &format!("`{text}` is no function of I1, I2 and J"));
            }
            return self.graph.stretch(i);
        }
        if let Some(k) = self.declaration.parameters.iter().position(|parameter| parameter.name == *name) {
            if self.declaration.parameters[k].length().is_some() {
                return self
                    .mistake(name.span(), &format!("`{text}` is a list: write `sum(|p| … {text}[p] …)`"));
            }
            if self.declaration.parameters[k].is_function() {
                return self.mistake(name.span(), &format!("`{text}` is a function: write `{text}(l1)`"));
            }
            return self.graph.leaf(Node::Parameter(k));
        }
        if let Some(word) = self.word(&text) {
            return word;
        }
        if self.index.as_ref().is_some_and(|(index, _)| index == name) {
            return self
                .mistake(name.span(), &format!("the index `{text}` only selects entries: `mu[{text}]`"));
        }
        let known = self.known_names();
        let hint = match nearest(&text, known.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("known are {}", list(&known)),
        };
        self.mistake(name.span(), &format!("unknown name `{text}`: {hint}"))
    }

    fn known_names(&self) -> Vec<String> {
        let stretches = self.declaration.stretches.iter().map(Ident::to_string);
        let parameters = self.declaration.parameters.iter().map(|parameter| parameter.name.to_string());
        let mut names: Vec<_> = stretches.chain(parameters).chain(WORDS.map(String::from)).collect();
        let mut bound: Vec<_> = self.bindings.keys().cloned().collect();
        bound.sort();
        names.extend(bound);
        names
    }

    /// J = λ1 λ2 λ3, I1 = Σ λ², I2 = λ1²λ2² + λ2²λ3² + λ3²λ1², I1b = J^(−2/3) I1, I2b = J^(−4/3) I2.
    fn word(&mut self, word: &str) -> Option<Id> {
        let graph = &mut *self.graph;
        let stretches = [0, 1, 2].map(|i| graph.stretch(i));
        let [i1, i2, j] = match self.arguments {
            Arguments::Invariants => stretches,
            Arguments::Stretches => {
                let squares = stretches.map(|stretch| graph.powi(stretch, 2));
                let pairs = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| graph.mul(squares[a], squares[b]));
                [graph.sum_of(&squares), graph.sum_of(&pairs), graph.product_of(&stretches)]
            }
        };
        let mut isochoric = |invariant: Id, numerator: i128| {
            let exponent = Rational::new(numerator, 3).map(Exponent::rational)?;
            let power = graph.power(j, exponent);
            Some(graph.mul(power, invariant))
        };
        match word {
            "J" => Some(j),
            "I1" => Some(i1),
            "I2" => Some(i2),
            "I1b" => isochoric(i1, -2),
            "I2b" => isochoric(i2, -4),
            _ => None,
        }
    }

    fn method(&mut self, call: &syn::ExprMethodCall) -> Id {
        let name = call.method.to_string();
        let receiver = self.expression(&call.receiver);
        let expected = match name.as_str() {
            "powi" | "powf" => 1,
            name if METHODS.contains(&name) => 0,
            _ => {
                let hint = match (name.as_str(), nearest(&name, METHODS.into_iter())) {
                    ("pow", _) => "write `.powi(2)` or `.powf(alpha)`".to_owned(),
                    ("log" | "log10" | "log2", _) => "write `.ln()`".to_owned(),
                    (_, Some(near)) => format!("did you mean `.{near}(…)`?"),
                    _ => format!("there are {}", list(&METHODS.map(String::from))),
                };
                return self.mistake(call.method.span(), &format!("unknown function `{name}`: {hint}"));
            }
        };
        if call.args.len() != expected {
            let what = if expected == 0 { "no argument" } else { "one argument, the exponent" };
            return self.mistake(call.method.span(), &format!("`{name}` takes {what}"));
        }
        let graph = &mut *self.graph;
        match name.as_str() {
            "ln" => graph.ln(receiver),
            "exp" => graph.exp(receiver),
            "sqrt" => graph.power(receiver, Rational::new(1, 2).map_or(Exponent::ONE, Exponent::rational)),
            "cbrt" => graph.power(receiver, Rational::new(1, 3).map_or(Exponent::ONE, Exponent::rational)),
            "recip" => graph.powi(receiver, -1),
            "powi" => self.whole_power(receiver, &call.args[0]),
            _ => self.real_power(receiver, &call.args[0]),
        }
    }

    fn whole_power(&mut self, base: Id, argument: &Expr) -> Id {
        let exponent = self.expression(argument);
        match self.graph.as_constant(exponent).and_then(Rational::as_integer) {
            Some(n) if n.abs() <= 64 => self.graph.powi(base, n),
            Some(_) => {
                self.mistake(argument.span(), "a whole power is at most 64; for larger ones use `.powf(…)`")
            }
            None => self.mistake(argument.span(), "`powi` takes a whole number; for others use `.powf(…)`"),
        }
    }

    fn real_power(&mut self, base: Id, argument: &Expr) -> Id {
        let exponent = self.expression(argument);
        if self.depends_on_stretches(exponent) {
            return self
                .mistake(argument.span(), "an exponent is made of numbers and parameters, not of stretches");
        }
        let exponent = self.graph.exponent(exponent);
        self.graph.power(base, exponent)
    }

    fn depends_on_stretches(&self, id: Id) -> bool {
        self.graph.reachable(&[id]).into_iter().any(|id| matches!(self.graph.node(id), Node::Stretch(_)))
    }

    fn call(&mut self, call: &syn::ExprCall) -> Id {
        let functions = self.declaration.parameters.iter().position(|parameter| {
            parameter.is_function()
                && matches!(&*call.func, Expr::Path(path) if path.path.is_ident(&parameter.name))
        });
        if let Some(k) = functions {
            self.used.insert(self.declaration.parameters[k].name.to_string());
            let [argument] = call.args.iter().collect::<Vec<_>>()[..] else {
                return self.mistake(call.span(), "a function has one argument");
            };
            let argument = self.expression(argument);
            return self.graph.leaf(Node::Function(k, 0, argument));
        }
        let closure = match (&*call.func, call.args.first()) {
            (Expr::Path(path), Some(Expr::Closure(closure))) if path.path.is_ident("sum") => Some(closure),
            _ => None,
        };
        let index = closure.filter(|closure| closure.inputs.len() == 1).and_then(|closure| {
            match &closure.inputs[0] {
                Pat::Ident(name) => Some(name.ident.clone()),
                _ => None,
            }
        });
        let (Some(closure), Some(index)) = (closure, index) else {
            return self.mistake(
                call.span(),
                "the only functions called by name are `sum(|p| mu[p] * …)` and parameters such as `f: piola::Spline`; others \
                 are called on a number: `x.ln()`",
            );
        };
        if self.index.is_some() {
            return self.mistake(call.span(), "sums cannot stand inside sums");
        }
        self.index = Some((index.clone(), None));
        let body = self.expression(&closure.body);
        match self.index.take() {
            Some((_, Some(length))) => self.graph.sum(length, body),
            _ => {
                self.mistake(index.span(), &format!("this sum runs over no list: write `mu[{index}]` in it"))
            }
        }
    }

    fn entry(&mut self, expression: &syn::ExprIndex) -> Id {
        let (Expr::Path(list), Expr::Path(index)) = (&*expression.expr, &*expression.index) else {
            return self.mistake(expression.span(), "write `mu[p]` inside `sum(|p| …)`");
        };
        let position =
            self.declaration.parameters.iter().position(|parameter| list.path.is_ident(&parameter.name));
        let Some(k) = position else {
            return match list.path.get_ident() {
                Some(name) => self.name(name),
                None => self.mistake(list.span(), "only a parameter has entries"),
            };
        };
        let parameter = &self.declaration.parameters[k];
        self.used.insert(parameter.name.to_string());
        let Some(length) = parameter.length() else {
            return self.mistake(
                list.span(),
                &format!("`{0}` is a number, not a list: write `{0}`", parameter.name),
            );
        };
        match &mut self.index {
            Some((name, seen)) if index.path.is_ident(name) => match *seen {
                Some(other) if other != length => {
                    self.mistake(expression.span(), "the lists in one sum must have the same length")
                }
                _ => {
                    *seen = Some(length);
                    self.graph.leaf(Node::Entry(k))
                }
            },
            Some((name, _)) => {
                let message = format!("the index of this sum is `{name}`");
                self.mistake(index.span(), &message)
            }
            None => self.mistake(expression.span(), "entries are only read inside `sum(|p| …)`"),
        }
    }

    fn mistake(&mut self, span: Span, message: &str) -> Id {
        self.error(span, message);
        self.graph.integer(1)
    }

    fn error(&mut self, span: Span, message: &str) {
        self.diagnostics.error(span, message);
    }
}

fn list(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The known name within a third of the letters, if there is one.
fn nearest<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    known
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .min()
        .filter(|&(distance, candidate)| distance <= 1.max(candidate.len().min(name.len()) / 3))
        .filter(|&(distance, candidate)| distance < candidate.len())
        .map(|(_, candidate)| candidate)
}

fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, &y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(!x.eq_ignore_ascii_case(&y));
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
