//! Sums over lists, and entries of lists.

use quote::ToTokens;
use syn::{Expr, ExprCall, ExprIndex, Ident};

use super::stretches::{PAIRS, Summand};
use super::{Resolver, Scope};
use crate::algebra::expr::{Id, Length, Node};
use crate::read::parse::{Kind, indexed_lists};

/// The message about a sum of another form.
const FORMS: &str = "a sum is written `sum(|p| mu[p] * …)` over lists, `sum(|l| l.powi(2))` over the three stretches, \
     `sum(|a, b| (a * b).powi(2))` over their pairs";

pub(super) struct Index {
    pub(super) name: Ident,
    /// The length of the lists that it has indexed so far.
    pub(super) length: Option<Length>,
    /// True if it has indexed a mistaken list, so that the sum is not to blame.
    pub(super) is_excused: bool,
    /// Other names that were taken for it.
    others: Vec<Ident>,
}

impl Index {
    pub(super) fn new(name: Ident) -> Self {
        Self { name, length: None, is_excused: false, others: Vec::new() }
    }
}

impl Resolver<'_> {
    pub(super) fn sum(&mut self, call: &ExprCall) -> Id {
        if self.scope == Scope::Parameters {
            return self
                .mistake(call, "a condition has no sums: written as `mu[p] > 0.0`, it holds for each entry");
        }
        let Some(summand) = Summand::of(call) else {
            return self.mistake(call, FORMS);
        };
        let name = match summand.names[..] {
            [a, b] => return self.sum_over([a, b], summand.body, PAIRS),
            [name] if summand.is_over_stretches() => {
                return self.sum_over([name], summand.body, [[0], [1], [2]]);
            }
            [name] => name,
            _ => return self.mistake(call, FORMS),
        };
        if let Some(outer) = &self.index {
            let message = self.inside(&outer.name, summand.body, name);
            self.excuse();
            return self.mistake(call, &message);
        }
        self.index = Some(Index::new(name.clone()));
        let body = self.expression(summand.body);
        match self.index.take() {
            Some(Index { length: Some(length), .. }) => self.graph.sum(length, body),
            Some(Index { is_excused: true, .. }) => body,
            _ => self.mistake(name, &self.no_list(name)),
        }
    }

    /// The message about a sum over lists inside another one.
    fn inside(&self, outer: &Ident, body: &Expr, index: &Ident) -> String {
        let mut lists = indexed_lists(body.to_token_stream());
        lists.retain(|(list, _)| {
            let place = self.declaration.place(list);
            place.is_some_and(|k| self.declaration.parameters[k].length().is_some())
        });
        if lists.iter().any(|(_, by)| by == index) {
            return "sums over lists cannot stand inside each other: write two sums and multiply them"
                .to_owned();
        }
        // Exponents follow factors.
        let list = lists.iter().rfind(|(_, by)| by == outer);
        let power = list.map_or("powi(2)".to_owned(), |(list, by)| format!("powf({list}[{by}])"));
        format!("a sum over the three stretches names one of them: write `sum(|l| l.{power})`")
    }

    fn no_list(&self, index: &Ident) -> String {
        match self.first_list() {
            Some(list) => format!("this sum does not run over a list: write `{list}[{index}]` in it"),
            None => {
                let list =
                    self.diagnostics.notation().either(", or declare a list, `mu: [f64; N]`, and", ", or");
                format!(
                    "this sum does not run over a list: write it without `sum`{list} write `mu[{index}]` in it"
                )
            }
        }
    }

    /// The parameter, or the entry of a list, that is the whole exponent of a power.
    pub(super) fn whole_exponent(&mut self, argument: &Expr) -> Option<Id> {
        let name = match argument {
            Expr::Index(entry) => plain_name(&entry.expr)?,
            argument => plain_name(argument)?,
        };
        let k = self.declaration.place(name)?;
        let is_number = matches!(self.declaration.parameters[k].kind, Kind::Number);
        if !self.declaration.parameters[k].is_whole || self.scope == Scope::Parameters {
            return None;
        }
        match argument {
            Expr::Index(entry) => Some(self.any_entry(entry)),
            _ if is_number => {
                self.used.insert(name.to_string());
                Some(self.graph.leaf(Node::Parameter(k)))
            }
            _ => None,
        }
    }

    /// An entry of a list instead of a number.
    pub(super) fn entry(&mut self, expression: &ExprIndex) -> Id {
        let entry = self.any_entry(expression);
        match (self.graph.node(entry), plain_name(&expression.expr)) {
            (&Node::Entry(k), Some(list)) if self.declaration.parameters[k].is_whole => {
                self.excuse();
                self.whole_as_number(list, &expression.to_token_stream().to_string().replace(" [", "["))
            }
            _ => entry,
        }
    }

    fn any_entry(&mut self, expression: &ExprIndex) -> Id {
        let Some(list) = plain_name(&expression.expr) else {
            self.excuse();
            return self.mistake(expression, "an entry is written `mu[p]`, inside `sum(|p| …)`");
        };
        let name = list.to_string();
        let position = self.declaration.place(list);
        let length = position.and_then(|k| self.declaration.parameters[k].length());
        let (Some(k), Some(length)) = (position, length) else {
            self.excuse();
            let is_other = position.is_some() || self.is_taken(list);
            if is_other && !self.mistaken.contains(&name) {
                self.used.insert(name.clone());
                let declared = format!(", or declare `{name}: [f64; N]`");
                let declared = self.diagnostics.notation().either(&*declared, "");
                let message = format!("`{name}` is not a list: write `{name}`{declared}");
                return self.mistake(list, &message);
            }
            return self.name(list);
        };
        self.used.insert(name.clone());
        if self.mistaken.contains(&name) {
            self.excuse();
            return self.unknown();
        }
        let Some(index) = plain_name(&expression.index) else {
            self.excuse();
            // One message for the list, however often it occurs.
            self.mistaken.insert(name.clone());
            return self.mistake(expression, &self.not_an_index(&name, &expression.index));
        };
        match &mut self.index {
            Some(around) if around.name == *index => match around.length {
                Some(other) if other != length && around.is_excused => self.graph.leaf(Node::Entry(k)),
                Some(other) if other != length => {
                    around.is_excused = true;
                    let message = format!(
                        "`{name}` has another length than the lists before it in this sum: declare them with the same"
                    );
                    self.mistake(list, &message)
                }
                _ => {
                    around.length = Some(length);
                    self.graph.leaf(Node::Entry(k))
                }
            },
            Some(around) => {
                around.is_excused = true;
                if around.others.contains(index) {
                    return self.unknown();
                }
                around.others.push(index.clone());
                let message = format!("the index here is `{}`", around.name);
                self.mistake(index, &message)
            }
            None => {
                self.mistaken.insert(name.clone());
                self.mistake(expression, &format!("entries are only read inside a sum: `sum(|p| {name}[p])`"))
            }
        }
    }

    /// The message about an index that is not a name.
    fn not_an_index(&self, list: &str, index: &Expr) -> String {
        let place = match self.scope {
            Scope::Parameters => "which holds for each",
            _ => "inside `sum(|p| …)`",
        };
        match index {
            Expr::Lit(_) => format!(
                "single entries of a list cannot be used: declare them as parameters of their own, or write `{list}[p]`, {place}"
            ),
            _ => format!("an entry is written `{list}[p]`, {place}"),
        }
    }

    /// Marks the enclosing sum as correct: an entry in it has a mistake of its own.
    pub(super) fn excuse(&mut self) {
        if let Some(index) = &mut self.index {
            index.is_excused = true;
        }
    }
}

fn plain_name(expression: &Expr) -> Option<&Ident> {
    match expression {
        Expr::Path(path) => path.path.get_ident(),
        _ => None,
    }
}
