//! Declarations of random energies: expressions that are symmetric in the stretches, as source text.
//!
//! An energy is a sum of a few terms, each of moderate depth and with sane constants, as a paper might print
//! them. An energy without the word `prestressed` has only terms whose stress vanishes at rest.

use piola::__private::random::Random;

use super::expression::Invariant::{self, I1, I1b, I2, I2b, J};
use super::expression::{
    Expression, add, div, entry, excess, invariant, mul, number, of, over_lists, over_pairs, over_stretches,
    parameter, real, stretch, sub, whole,
};
use super::polynomial::Function::{
    self, Asinh, Atan, Cbrt, Cos, Cosh, Erf, Exp, ExpM1, Ln, Ln1p, Sigmoid, Sin, Sinh, Softplus, Sqrt, Tanh,
};

/// A parameter.
#[derive(Clone)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its value, or the two entries of a list.
    pub values: Vec<f64>,
    /// A value that it must exceed.
    pub above: Option<f64>,
}

/// A declaration of a random energy.
pub struct Declaration {
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// The terms of the energy.
    pub terms: Vec<Expression>,
    /// True if the domain is J > 0, false if it is all deformations.
    pub is_positive: bool,
    /// Words of the attribute besides the domain: `extend`, `prestressed`.
    pub words: Vec<&'static str>,
    /// True if its derivatives by the parameters are compiled as well.
    pub is_fitted: bool,
}

impl Declaration {
    /// The declaration of a seed.
    pub fn random(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let is_positive = !random.once_in(6);
        let is_relaxed = random.once_in(3);
        let mut words = Vec::new();
        if is_positive && random.once_in(5) {
            words.push("extend");
        }
        if !is_relaxed {
            words.push("prestressed");
        }
        let is_fitted = random.once_in(8);
        let mut maker = Maker { random, parameters: Vec::new(), is_positive };
        let count = 1 + maker.random.below(4);
        let terms: Vec<_> =
            (0..count).map(|_| if is_relaxed { maker.relaxed_term() } else { maker.term() }).collect();
        // Some are drawn for alternatives that are not taken.
        let is_used = |parameter: &Parameter| terms.iter().any(|term| term.text.contains(&parameter.name));
        let parameters = maker.parameters.into_iter().filter(is_used).collect();
        Self { parameters, terms, is_positive, words, is_fitted }
    }

    /// The declaration as it can be pasted, with the values of its parameters.
    pub fn source(&self) -> String {
        let above = |Parameter { name, values, above }: &Parameter| {
            let index = if values.len() > 1 { "[p]" } else { "" };
            above.map(|bound| format!("{name}{index} > {bound:?}"))
        };
        let conditions: Vec<_> = self.parameters.iter().filter_map(above).collect();
        let domain = self.is_positive.then(|| "domain(J > 0.0)".to_owned());
        let admissible = (!conditions.is_empty()).then(|| format!("admissible({})", conditions.join(", ")));
        let words = self.words.iter().map(|&word| word.to_owned());
        let arguments: Vec<_> = domain.into_iter().chain(admissible).chain(words).collect();
        let (mut parameters, mut remarks) = (String::new(), String::new());
        for Parameter { name, values, .. } in &self.parameters {
            parameters += &match values.len() {
                1 => format!(", {name}: f64"),
                count => format!(", {name}: [f64; {count}]"),
            };
            remarks += &format!("// {name} = {values:?}\n");
        }
        let terms: Vec<_> = self.terms.iter().map(|term| term.text.as_str()).collect();
        let (arguments, terms) = (arguments.join(", "), terms.join(" + "));
        format!(
            "#[material({arguments})]\n\
             pub fn Random([l1, l2, l3]: [f64; 3]{parameters}) -> f64 {{ {terms} }}\n{remarks}"
        )
    }
}

/// The meaning of a parameter, which decides its values.
#[derive(Clone, Copy)]
enum Meaning {
    Modulus,
    Exponent,
    /// An exponent of I1b − 3, where stress and stiffness exist from 1 on.
    ExponentAboveOne,
    /// A factor of an argument.
    Rate,
}

struct Maker {
    random: Random,
    parameters: Vec<Parameter>,
    is_positive: bool,
}

/// Functions whose derivatives are known everywhere.
const SMOOTH: [Function; 11] = [Exp, Sinh, Cosh, Tanh, Asinh, Sin, Cos, Atan, Erf, ExpM1, Softplus];

impl Maker {
    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.random.below(all.len())]
    }

    fn number(&mut self) -> Expression {
        let fractions = [(1, 2), (1, 4), (3, 2), (2, 1), (3, 1), (3, 10), (7, 10), (5, 4), (1, 8), (6, 1)];
        number(self.one_of(&fractions))
    }

    fn value(&mut self, meaning: Meaning) -> f64 {
        match meaning {
            Meaning::Modulus => 10f64.powf(self.random.uniform(-1.0, 2.0)),
            Meaning::Exponent => {
                let (low, high) = self.one_of(&[(-3.0, -0.3), (0.2, 1.8), (2.0, 4.5)]);
                self.random.uniform(low, high)
            }
            Meaning::ExponentAboveOne => self.random.uniform(1.05, 3.0),
            Meaning::Rate => self.random.uniform(0.05, 1.0),
        }
    }

    /// A new parameter, with one value or, for a list, two.
    fn values(&mut self, meaning: Meaning, count: usize) -> Parameter {
        let (letter, above) = match meaning {
            Meaning::Modulus => ("mu", Some(0.0)),
            Meaning::Exponent => ("alpha", None),
            Meaning::ExponentAboveOne => ("alpha", Some(1.0)),
            Meaning::Rate => ("rate", Some(0.0)),
        };
        // No name is a part of another one.
        let name = format!("{letter}{:02}", self.parameters.len());
        let values = (0..count).map(|_| self.value(meaning)).collect();
        let made = Parameter { name, values, above };
        self.parameters.push(made.clone());
        made
    }

    fn parameter(&mut self, meaning: Meaning) -> Expression {
        let made = self.values(meaning, 1);
        parameter(&made.name, made.values[0])
    }

    fn entry(&mut self, meaning: Meaning) -> Expression {
        let made = self.values(meaning, 2);
        entry(&made.name, made.values)
    }

    fn factor(&mut self, meaning: Meaning) -> Expression {
        if self.random.once_in(2) { self.parameter(meaning) } else { self.number() }
    }

    /// A term of any energy.
    fn term(&mut self) -> Expression {
        if self.random.once_in(6) {
            return self.over_lists();
        }
        let shape = self.shape(2);
        let factor = self.factor(Meaning::Modulus);
        mul(factor, shape)
    }

    /// Σ mu[p] … with an exponent for each entry.
    fn over_lists(&mut self) -> Expression {
        let (mu, alpha) = (self.entry(Meaning::Modulus), self.entry(Meaning::Exponent));
        let powers = over_stretches(real(stretch(0), alpha.clone()));
        let body = match self.random.below(if self.is_positive { 4 } else { 2 }) {
            0 => real(invariant(I1), alpha.clone()),
            1 => real(self.positive(), alpha.clone()),
            2 => sub(powers, number((3, 1))),
            _ => {
                let third = div(mul(number((-1, 1)), alpha.clone()), number((3, 1)));
                mul(real(invariant(J), third), powers)
            }
        };
        over_lists(mul(div(mu, alpha), body))
    }

    fn invariant(&mut self) -> Invariant {
        if self.is_positive { self.one_of(&[I1, I2, J, I1b, I2b]) } else { self.one_of(&[I1, I2, J]) }
    }

    /// A quantity of the order of 1 near rest.
    fn quantity(&mut self, depth: usize) -> Expression {
        match self.random.below(7) {
            0 | 1 => {
                let drawn = self.invariant();
                let at_rest = if drawn == J { 1 } else { 3 };
                mul(self.factor(Meaning::Rate), sub(invariant(drawn), number((at_rest, 1))))
            }
            2 => div(invariant(self.invariant()), number((4, 1))),
            3 if self.is_positive => of(Ln, invariant(J)),
            4 => mul(number((1, 2)), self.over_stretches()),
            5 => mul(number((1, 4)), self.over_pairs()),
            _ if depth > 0 => self.shape(depth - 1),
            _ => invariant(self.invariant()),
        }
    }

    fn positive(&mut self) -> Expression {
        let kind = self.random.below(7);
        self.positive_of(kind)
    }

    fn positive_of(&mut self, kind: usize) -> Expression {
        match kind {
            0 | 1 if self.is_positive => invariant(self.invariant()),
            2 => over_stretches(of(Cosh, stretch(0))),
            3 => of(Cosh, sub(invariant(self.invariant()), number((1, 1)))),
            4 => add(number((1, 1)), whole(self.quantity(0), 2)),
            5 => add(number((1, 1)), of(Exp, self.quantity(0))),
            _ => add(invariant(I1), number((1, 2))),
        }
    }

    /// A base of real powers, and the meaning of its exponents.
    fn base(&mut self) -> (Expression, Meaning) {
        match self.random.below(7) {
            0 if self.is_positive => (excess(self.one_of(&[I1b, I2b])), Meaning::ExponentAboveOne),
            kind => (self.positive_of(kind), Meaning::Exponent),
        }
    }

    fn shape(&mut self, depth: usize) -> Expression {
        let below = depth.saturating_sub(1);
        match self.random.below(11) {
            0 | 1 => of(self.one_of(&SMOOTH), self.quantity(below)),
            2 => {
                let n = self.one_of(&[2, 2, 3, 4, 5]);
                whole(self.quantity(below), n)
            }
            3 => of(self.one_of(&[Ln, Sqrt, Cbrt, Ln1p, Sigmoid]), self.positive()),
            4 => {
                let n = self.one_of(&[-1, -2, -3]);
                whole(self.positive(), n)
            }
            5 | 6 => {
                let (base, meaning) = self.base();
                let exponent = match self.random.once_in(2) {
                    true => self.parameter(meaning),
                    false => number(self.one_of(&[(3, 2), (5, 4), (5, 2), (17, 10), (11, 10)])),
                };
                real(base, exponent)
            }
            7 => self.over_stretches(),
            8 => self.over_pairs(),
            9 => div(self.quantity(below), self.positive()),
            _ => mul(self.quantity(below), self.quantity(below)),
        }
    }

    /// Σ f(a).
    fn over_stretches(&mut self) -> Expression {
        let (l, strain) = (stretch(0), sub(stretch(0), number((1, 1))));
        over_stretches(match self.random.below(if self.is_positive { 11 } else { 6 }) {
            0 => whole(l, self.one_of(&[2, 3, 4])),
            1 => whole(strain, self.one_of(&[2, 4])),
            2 | 3 => of(self.one_of(&SMOOTH), l),
            4 => of(self.one_of(&SMOOTH), strain),
            5 => of(self.one_of(&SMOOTH), mul(self.factor(Meaning::Rate), whole(l, 2))),
            6 => whole(of(Ln, l), self.one_of(&[1, 2, 4])),
            7 => real(l, self.factor(Meaning::Exponent)),
            8 => of(self.one_of(&SMOOTH), of(Ln, l)),
            9 => of(self.one_of(&[Sqrt, Cbrt, Ln1p, Sigmoid]), l),
            _ => mul(l.clone(), of(Ln, l)),
        })
    }

    /// Σ f(a, b) with f(a, b) = f(b, a).
    fn over_pairs(&mut self) -> Expression {
        let [a, b] = [0, 1].map(stretch);
        let product = mul(a.clone(), b.clone());
        over_pairs(match self.random.below(if self.is_positive { 8 } else { 5 }) {
            0 => whole(product, 2),
            1 => whole(sub(a, b), self.one_of(&[2, 4])),
            2 => of(self.one_of(&SMOOTH), product),
            3 => of(self.one_of(&SMOOTH), add(a, b)),
            4 => of(self.one_of(&[Cosh, Cos]), sub(a, b)),
            5 => whole(of(Ln, div(a, b)), 2),
            6 => real(product, self.factor(Meaning::Exponent)),
            _ => of(Ln, add(a, b)),
        })
    }

    /// A term with a minimum or another stationary point at rest.
    fn relaxed_term(&mut self) -> Expression {
        let quantity = self.stationary();
        let shape = match self.random.below(6) {
            1 => of(self.one_of(&[ExpM1, Sinh, Atan, Tanh, Erf]), quantity),
            2 => whole(quantity, self.one_of(&[2, 3])),
            3 => of(Ln, add(number((1, 1)), whole(quantity, 2))),
            4 => div(quantity, add(number((2, 1)), over_stretches(whole(stretch(0), 2)))),
            5 if self.is_positive => {
                let base = excess(self.one_of(&[I1b, I2b]));
                let power = match self.random.once_in(2) {
                    true => self.parameter(Meaning::ExponentAboveOne),
                    false => number((5, 4)),
                };
                real(base, power)
            }
            _ => quantity,
        };
        mul(self.factor(Meaning::Modulus), shape)
    }

    /// A quantity that is zero and stationary at rest.
    fn stationary(&mut self) -> Expression {
        let (one, l, volume) = (number((1, 1)), stretch(0), invariant(J));
        match self.random.below(if self.is_positive { 10 } else { 4 }) {
            0 => over_stretches(whole(sub(l, one), 2)),
            1 => whole(sub(volume, one), 2),
            2 => over_stretches(whole(sub(whole(l, 2), one), 2)),
            3 => over_pairs(whole(sub(l, stretch(1)), 2)),
            4 => sub(invariant(I1b), number((3, 1))),
            5 => sub(invariant(I2b), number((3, 1))),
            6 => whole(of(Ln, volume), 2),
            7 => over_stretches(whole(of(Ln, l), 2)),
            8 => sub(div(sub(whole(volume.clone(), 2), one), number((2, 1))), of(Ln, volume)),
            _ => sub(sub(invariant(I1), number((3, 1))), mul(number((2, 1)), of(Ln, volume))),
        }
    }
}
