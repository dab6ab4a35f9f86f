//! Names of an expression and their meanings.

use std::f64::consts;

use syn::{Ident, Path};

use super::{Resolver, Scope, advice};
use crate::algebra::expr::{Exponent, Id, Node};
use crate::algebra::rational::Rational;
use crate::read::parse::{Kind, WORDS};
use crate::read::spelling::{list, nearest};

/// The constants of `std::f64::consts` that formulas use.
const CONSTANTS: [(&str, f64); 8] = [
    ("PI", consts::PI),
    ("TAU", consts::TAU),
    ("E", consts::E),
    ("LN_2", consts::LN_2),
    ("LN_10", consts::LN_10),
    ("SQRT_2", consts::SQRT_2),
    ("FRAC_PI_2", consts::FRAC_PI_2),
    ("FRAC_2_SQRT_PI", consts::FRAC_2_SQRT_PI),
];

/// A constant of `std::f64::consts` by its path.
pub(crate) fn constant(path: &Path) -> Option<f64> {
    let mut words = path.segments.iter().rev().map(|word| &word.ident);
    let (name, module) = (words.next()?, words.next()?);
    let is_meant = |(constant, _): &&(&str, f64)| module == "consts" && name == constant;
    CONSTANTS.iter().find(is_meant).map(|&(_, value)| value)
}

impl Resolver<'_> {
    pub(super) fn name(&mut self, name: &Ident) -> Id {
        let text = name.to_string();
        self.used.insert(text.clone());
        if self.mistaken.contains(&text) {
            return self.unknown();
        }
        if let Some(&bound) = self.bindings.get(&text) {
            return bound;
        }
        if let Some(i) = self.declaration.stretches.iter().position(|stretch| stretch == name) {
            return match self.scope {
                Scope::Stretches | Scope::Isochoric | Scope::Invariants => self.stretch(i),
                Scope::Parameters => self.deformation(name),
            };
        }
        if let Some(k) = self.declaration.place(name) {
            return match &self.declaration.parameters[k].kind {
                Kind::Number if self.declaration.parameters[k].is_whole => self.whole_as_number(name, &text),
                Kind::Number => self.graph.leaf(Node::Parameter(k)),
                Kind::List(_) if self.scope == Scope::Parameters => self
                    .mistake(name, &format!("`{text}` is a list: write `{text}[p]` for each of its entries")),
                Kind::List(_) => {
                    self.mistake(name, &format!("`{text}` is a list: write `sum(|p| … {text}[p] …)`"))
                }
                Kind::Function(_) if self.scope == Scope::Parameters => {
                    self.mistake(name, "a function is checked by its own constructor: remove this condition")
                }
                Kind::Function(_) => self.mistake(
                    name,
                    &format!(
                        "`{text}` is declared as a function: write `{text}(l1)`, or declare `{text}: f64`"
                    ),
                ),
            };
        }
        if WORDS.contains(&text.as_str()) && self.scope == Scope::Parameters {
            return self.deformation(name);
        }
        if let Some(word) = self.word(&text) {
            return word;
        }
        if text == "PI" && self.scope == Scope::Parameters {
            return self.mistake(name, "a condition is plain Rust: write `std::f64::consts::PI`");
        }
        if text == "PI" {
            return self.graph.leaf(Node::Float(consts::PI.to_bits()));
        }
        if self.index.as_ref().is_some_and(|index| index.name == *name) {
            // One message for the name, however often it occurs.
            self.mistaken.insert(text.clone());
            return self.mistake(name, &self.index_as_number(&text));
        }
        if self.declaration.generics.contains(name) {
            return self
                .mistake(name, &format!("`{text}` is the length of lists: a number needs a parameter"));
        }
        if self.bound.contains(&text) {
            return self.mistake(
                name,
                &format!(
                    "`{text}` is known only in the `{{ … }}` of its `let`: write out here what it stands for"
                ),
            );
        }
        let known = self.known_names();
        let hint = match (advice(&text), nearest(&text, known.iter().map(String::as_str))) {
            (Some(hint), _) if self.scope != Scope::Parameters => hint.to_owned(),
            (_, Some(near)) => {
                // The likely name counts as used.
                self.used.insert(near.to_owned());
                format!("did you mean `{near}`?")
            }
            (_, None) => format!("known are {}", list(&known)),
        };
        self.mistake(name, &format!("unknown name `{text}`: {hint}"))
    }

    /// Error for an integer exponent used where a number is required.
    pub(super) fn whole_as_number(&mut self, name: &Ident, text: &str) -> Id {
        let message = if self.scope == Scope::Parameters {
            "the constructor checks that exponents are at most 64: remove this condition".to_owned()
        } else {
            format!(
                "`{text}` is a whole exponent and nothing else: write `x.powi({text})`, or declare it with `f64`"
            )
        };
        self.mistake(name, &message)
    }

    pub(super) fn first_list(&self) -> Option<&Ident> {
        let mut parameters = self.declaration.parameters.iter();
        parameters.find(|parameter| parameter.length().is_some()).map(|parameter| &parameter.name)
    }

    /// The message about the index of a sum used as a number.
    fn index_as_number(&self, index: &str) -> String {
        let list = self.first_list().map_or("mu".to_owned(), Ident::to_string);
        let exponents = if index == "n" { "k" } else { "n" };
        let message = format!(
            "the index `{index}` only selects entries, as in `{list}[{index}]`, and is not a number: write the terms out, each with \
             a parameter and numbers of its own"
        );
        let in_rust = format!(
            ", two terms for `{list}: [f64; 2]`; a list of numbers in its place would be parameters too, which a fit changes; \
             whole exponents alone can be data, `x.powi({exponents}[{index}])` with `{exponents}: [u32; 2]`"
        );
        message + self.diagnostics.notation().either(&in_rust, "")
    }

    /// Error for a name of the deformation in a condition on parameters.
    fn deformation(&mut self, name: &Ident) -> Id {
        let message =
            format!("`{name}` is not a parameter: conditions on the deformation stand in `domain(…)`");
        self.mistake(name, &message)
    }

    fn known_names(&self) -> Vec<String> {
        let parameters = self.declaration.parameters.iter().map(|parameter| parameter.name.to_string());
        if self.scope == Scope::Parameters {
            return parameters.collect();
        }
        let stretches = self.declaration.stretches.iter().map(Ident::to_string);
        let mut names: Vec<_> = stretches.chain(parameters).chain(WORDS.map(String::from)).collect();
        let mut bound: Vec<_> = self.bindings.keys().cloned().collect();
        bound.sort();
        names.extend(bound);
        names
    }

    /// The value of J = λ1 λ2 λ3, I1 = Σ λ², I2 = λ1²λ2² + λ2²λ3² + λ3²λ1², I1b = J^(−2/3) I1, I2b = J^(−4/3)
    /// I2.
    fn word(&mut self, word: &str) -> Option<Id> {
        let graph = &mut *self.graph;
        let [i1, i2, j] = match self.scope {
            Scope::Invariants => [0, 1, 2].map(|i| graph.stretch(i)),
            Scope::Stretches | Scope::Isochoric | Scope::Parameters => graph.invariants(),
        };
        let mut isochoric = |invariant: Id, numerator: i128| {
            let exponent = Rational::new(numerator, 3).map(Exponent::rational)?;
            let power = graph.power(j, exponent);
            Some(graph.mul(power, invariant))
        };
        let word = match (word, self.scope) {
            ("I1", Scope::Isochoric) => "I1b",
            ("I2", Scope::Isochoric) => "I2b",
            (word, _) => word,
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

    /// A path of several words.
    pub(super) fn constant(&mut self, path: &Path) -> Id {
        let last = path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
        if ["NAN", "INFINITY", "NEG_INFINITY"].contains(&last.as_str()) {
            return self.mistake(path, "the numbers of an energy are finite: write one");
        }
        if let Some(value) = constant(path) {
            return self.graph.leaf(Node::Float(value.to_bits()));
        }
        self.mistake(
            path,
            "what has a name here is a parameter, a stretch or a `let` binding: write constants as numbers",
        )
    }

    pub(super) fn is_taken(&self, name: &Ident) -> bool {
        let text = name.to_string();
        WORDS.contains(&text.as_str())
            || text == "sum"
            || self.bindings.contains_key(&text)
            || self.declaration.stretches.contains(name)
            || self.declaration.place(name).is_some()
    }
}
