//! Declarations of random energies: expressions that are symmetric in the stretches, as source text.
//!
//! An energy is a sum of a few terms, each of moderate depth and with sane constants, as a paper might print
//! them. An energy without the word `prestressed` has only terms whose stress vanishes at rest.

use piola::__private::random::Random;

use super::polynomial::Function::{
    self, Asinh, Atan, Cbrt, Cos, Cosh, Erf, Exp, ExpM1, Ln, Ln1p, Sigmoid, Sin, Sinh, Softplus, Sqrt, Tanh,
};

/// An invariant by its name in declarations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each is named as in declarations")]
pub enum Invariant {
    I1,
    I2,
    J,
    I1b,
    I2b,
}

/// An expression of an energy.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// A number that is exact in decimal digits, numerator over denominator.
    Number(i32, i32),
    /// A parameter that is a number, by its name.
    Parameter(String),
    /// The current entry of a parameter that is a list, inside of a sum over it.
    Entry(String),
    /// An invariant.
    Invariant(Invariant),
    /// I1b − 3 or I2b − 3 as the base of a real power: a sum of squares, though it is printed as a
    /// difference.
    Excess(Invariant),
    /// A stretch of the sum around: the first name of its closure, or the second.
    Stretch(usize),
    /// a + b.
    Add(Box<Expression>, Box<Expression>),
    /// a − b.
    Sub(Box<Expression>, Box<Expression>),
    /// a b.
    Mul(Box<Expression>, Box<Expression>),
    /// a/b.
    Div(Box<Expression>, Box<Expression>),
    /// A whole power.
    Whole(Box<Expression>, i32),
    /// A real power, whose exponent is made of numbers and parameters.
    Real(Box<Expression>, Box<Expression>),
    /// A function.
    Of(Function, Box<Expression>),
    /// Σ over the three stretches.
    OverStretches(Box<Expression>),
    /// Σ over the pairs of stretches.
    OverPairs(Box<Expression>),
    /// Σ over the entries of lists.
    OverLists(Box<Expression>),
}

use Expression as E;
use Invariant::{I1, I1b, I2, I2b, J};

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its value, or its entries.
    pub values: Vec<f64>,
    /// True if it is a list.
    pub is_list: bool,
    /// A value that it must exceed.
    pub above: Option<f64>,
}

/// The end of the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Domain {
    /// J > 0.
    Positive,
    /// All deformations.
    Whole,
}

/// A declaration of a random energy.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// The terms of the energy.
    pub terms: Vec<Expression>,
    /// Domain of the energy.
    pub domain: Domain,
    /// Words of the attribute besides the domain: `extend`, `prestressed`, `fit`.
    pub words: Vec<&'static str>,
}

impl Declaration {
    /// The declaration of a seed.
    #[must_use]
    pub fn random(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let domain = if random.once_in(6) { Domain::Whole } else { Domain::Positive };
        let is_relaxed = random.once_in(3);
        let mut words = Vec::new();
        if domain == Domain::Positive && random.once_in(5) {
            words.push("extend");
        }
        if !is_relaxed {
            words.push("prestressed");
        }
        if random.once_in(8) {
            words.push("fit");
        }
        let mut maker = Maker { random, parameters: Vec::new(), domain };
        let count = 1 + maker.random.below(4);
        let terms =
            (0..count).map(|_| if is_relaxed { maker.relaxed_term() } else { maker.term() }).collect();
        Self { parameters: maker.parameters, terms, domain, words }.with_used_parameters()
    }

    /// Declarations that are simpler by one term.
    #[must_use]
    pub fn shrunk(&self) -> Vec<Self> {
        let without = |k: usize| {
            let mut shrunk = self.clone();
            shrunk.terms.remove(k);
            shrunk.with_used_parameters()
        };
        let inner = |k: usize| {
            let parts = match &self.terms[k] {
                E::Mul(a, b) if !matches!(**a, E::Parameter(_)) => vec![a.clone(), b.clone()],
                E::Add(a, b) | E::Sub(a, b) => vec![a.clone(), b.clone()],
                E::Mul(_, b) | E::Div(b, _) => vec![b.clone()],
                E::Of(_, a) | E::Whole(a, _) => vec![a.clone()],
                _ => Vec::new(),
            };
            let replaced = parts.into_iter().map(move |part| {
                let mut shrunk = self.clone();
                shrunk.terms[k] = *part;
                shrunk.with_used_parameters()
            });
            replaced.collect::<Vec<_>>()
        };
        // A smaller energy may need the word in order not to be refused.
        let stressed = (!self.words.contains(&"prestressed")).then(|| {
            let words = self.words.iter().copied().chain(["prestressed"]).collect();
            Self { words, ..self.clone() }
        });
        let all = 0..self.terms.len();
        let fewer = all.clone().filter(|_| self.terms.len() > 1).map(without);
        fewer.chain(all.flat_map(inner)).chain(stressed).collect()
    }

    /// The arguments of the attribute.
    #[must_use]
    pub fn arguments(&self) -> String {
        let domain = (self.domain == Domain::Positive).then(|| "domain(J > 0.0)".to_owned());
        let above = |parameter: &Parameter| {
            let index = if parameter.is_list { "[p]" } else { "" };
            parameter.above.map(|bound| format!("{}{index} > {bound:?}", parameter.name))
        };
        let conditions: Vec<_> = self.parameters.iter().filter_map(above).collect();
        let admissible = (!conditions.is_empty()).then(|| format!("admissible({})", conditions.join(", ")));
        let words = self.words.iter().map(|word| (*word).to_owned());
        domain.into_iter().chain(admissible).chain(words).collect::<Vec<_>>().join(", ")
    }

    /// The function.
    #[must_use]
    pub fn item(&self) -> String {
        let parameter = |Parameter { name, values, is_list, .. }: &Parameter| match is_list {
            true => format!(", {name}: [f64; {}]", values.len()),
            false => format!(", {name}: f64"),
        };
        let parameters: String = self.parameters.iter().map(parameter).collect();
        let terms: Vec<_> = self.terms.iter().map(text).collect();
        format!("pub fn Random([l1, l2, l3]: [f64; 3]{parameters}) -> f64 {{ {} }}", terms.join(" + "))
    }

    /// The declaration as it can be pasted, with the values of its parameters.
    #[must_use]
    pub fn source(&self) -> String {
        let value = |Parameter { name, values, .. }: &Parameter| format!("// {name} = {values:?}\n");
        let values: String = self.parameters.iter().map(value).collect();
        format!("#[material({})]\n{}\n{values}", self.arguments(), self.item())
    }

    /// Removes the parameters that no term names.
    fn with_used_parameters(mut self) -> Self {
        let terms: String = self.terms.iter().map(text).collect();
        self.parameters.retain(|parameter| terms.contains(&parameter.name));
        self
    }
}

/// An expression as it is printed.
fn text(expression: &Expression) -> String {
    match expression {
        E::Number(numerator, denominator) => {
            format!("{:?}", f64::from(*numerator) / f64::from(*denominator))
        }
        E::Parameter(name) => name.clone(),
        E::Entry(name) => format!("{name}[p]"),
        E::Invariant(invariant) => format!("{invariant:?}"),
        E::Excess(invariant) => format!("({invariant:?} - 3.0)"),
        E::Stretch(k) => ["a", "b"][*k].to_owned(),
        E::Add(a, b) => format!("({} + {})", text(a), text(b)),
        E::Sub(a, b) => format!("({} - {})", text(a), text(b)),
        E::Mul(a, b) => format!("({} * {})", text(a), text(b)),
        E::Div(a, b) => format!("({} / {})", text(a), text(b)),
        E::Whole(a, n) => format!("{}.powi({n})", text(a)),
        E::Real(a, r) => format!("{}.powf({})", text(a), text(r)),
        E::Of(function, a) => format!("{}.{}()", text(a), function.name()),
        E::OverStretches(body) => format!("sum(|a| {})", text(body)),
        E::OverPairs(body) => format!("sum(|a, b| {})", text(body)),
        E::OverLists(body) => format!("sum(|p| {})", text(body)),
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
    domain: Domain,
}

/// Functions whose derivatives are known everywhere.
const SMOOTH: [Function; 11] = [Exp, Sinh, Cosh, Tanh, Asinh, Sin, Cos, Atan, Erf, ExpM1, Softplus];

impl Maker {
    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.random.below(all.len())]
    }

    fn number(&mut self) -> Expression {
        let (numerator, denominator) =
            self.one_of(&[(1, 2), (1, 4), (3, 2), (2, 1), (3, 1), (3, 10), (7, 10), (5, 4), (1, 8), (6, 1)]);
        E::Number(numerator, denominator)
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

    fn parameter(&mut self, meaning: Meaning, is_list: bool) -> String {
        let k = self.parameters.len();
        let letter = match meaning {
            Meaning::Modulus => "mu",
            Meaning::Exponent | Meaning::ExponentAboveOne => "alpha",
            Meaning::Rate => "rate",
        };
        let above = match meaning {
            Meaning::Modulus | Meaning::Rate => Some(0.0),
            Meaning::ExponentAboveOne => Some(1.0),
            Meaning::Exponent => None,
        };
        let count = if is_list { 2 } else { 1 };
        let values = (0..count).map(|_| self.value(meaning)).collect();
        // No name is a part of another one.
        let name = format!("{letter}{k:02}");
        self.parameters.push(Parameter { name: name.clone(), values, is_list, above });
        name
    }

    fn factor(&mut self, meaning: Meaning) -> Expression {
        match self.random.once_in(2) {
            true => E::Parameter(self.parameter(meaning, false)),
            false => self.number(),
        }
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
        let (mu, alpha) = (self.parameter(Meaning::Modulus, true), self.parameter(Meaning::Exponent, true));
        let (mu, alpha) = (E::Entry(mu), E::Entry(alpha));
        let body = match self.random.below(if self.domain == Domain::Positive { 4 } else { 2 }) {
            0 => real(E::Invariant(I1), alpha.clone()),
            1 => {
                let base = self.positive(false);
                real(base, alpha.clone())
            }
            2 => sub(E::OverStretches(Box::new(real(E::Stretch(0), alpha.clone()))), E::Number(3, 1)),
            _ => {
                let powers = E::OverStretches(Box::new(real(E::Stretch(0), alpha.clone())));
                let third = div(mul(E::Number(-1, 1), alpha.clone()), E::Number(3, 1));
                mul(real(E::Invariant(J), third), powers)
            }
        };
        E::OverLists(Box::new(mul(div(mu, alpha), body)))
    }

    fn invariant(&mut self) -> Invariant {
        match self.domain {
            Domain::Positive => self.one_of(&[I1, I2, J, I1b, I2b]),
            Domain::Whole => self.one_of(&[I1, I2, J]),
        }
    }

    /// A quantity of the order of 1 near rest.
    fn quantity(&mut self, depth: usize) -> Expression {
        match self.random.below(7) {
            0 | 1 => {
                let invariant = self.invariant();
                let at_rest = if invariant == J { 1 } else { 3 };
                let rate = self.factor(Meaning::Rate);
                mul(rate, sub(E::Invariant(invariant), E::Number(at_rest, 1)))
            }
            2 => div(E::Invariant(self.invariant()), E::Number(4, 1)),
            3 if self.domain == Domain::Positive => of(Ln, E::Invariant(J)),
            4 => mul(E::Number(1, 2), self.over_stretches()),
            5 => mul(E::Number(1, 4), self.over_pairs()),
            _ if depth > 0 => self.shape(depth - 1),
            _ => E::Invariant(self.invariant()),
        }
    }

    /// A positive quantity.
    fn positive(&mut self, may_be_excess: bool) -> Expression {
        let is_positive = self.domain == Domain::Positive;
        match self.random.below(7) {
            0 if may_be_excess && is_positive => E::Excess(self.one_of(&[I1b, I2b])),
            0 | 1 if is_positive => E::Invariant(self.invariant()),
            2 => E::OverStretches(Box::new(of(Cosh, E::Stretch(0)))),
            3 => of(Cosh, sub(E::Invariant(self.invariant()), E::Number(1, 1))),
            4 => {
                let inner = self.quantity(0);
                add(E::Number(1, 1), whole(inner, 2))
            }
            5 => {
                let inner = self.quantity(0);
                add(E::Number(1, 1), of(Exp, inner))
            }
            _ => add(E::Invariant(I1), E::Number(1, 2)),
        }
    }

    fn shape(&mut self, depth: usize) -> Expression {
        match self.random.below(11) {
            0 | 1 => {
                let function = self.one_of(&SMOOTH);
                of(function, self.quantity(depth.saturating_sub(1)))
            }
            2 => {
                let n = self.one_of(&[2, 2, 3, 4, 5]);
                whole(self.quantity(depth.saturating_sub(1)), n)
            }
            3 => {
                let function = self.one_of(&[Ln, Sqrt, Cbrt, Ln1p, Sigmoid]);
                let base = self.positive(false);
                of(function, base)
            }
            4 => {
                let n = self.one_of(&[-1, -2, -3]);
                whole(self.positive(false), n)
            }
            5 | 6 => {
                let base = self.positive(true);
                let meaning = match base {
                    E::Excess(_) => Meaning::ExponentAboveOne,
                    _ => Meaning::Exponent,
                };
                let exponent = match self.random.once_in(2) {
                    true => E::Parameter(self.parameter(meaning, false)),
                    false => {
                        let (numerator, denominator) =
                            self.one_of(&[(3, 2), (5, 4), (5, 2), (17, 10), (11, 10)]);
                        E::Number(numerator, denominator)
                    }
                };
                real(base, exponent)
            }
            7 => self.over_stretches(),
            8 => self.over_pairs(),
            9 => {
                let (numerator, denominator) = (self.quantity(depth.saturating_sub(1)), self.positive(false));
                div(numerator, denominator)
            }
            _ => {
                let (a, b) = (self.quantity(depth.saturating_sub(1)), self.quantity(depth.saturating_sub(1)));
                mul(a, b)
            }
        }
    }

    /// Σ f(a).
    fn over_stretches(&mut self) -> Expression {
        let is_positive = self.domain == Domain::Positive;
        let stretch = || E::Stretch(0);
        let strain = || sub(stretch(), E::Number(1, 1));
        let body = match self.random.below(if is_positive { 11 } else { 6 }) {
            0 => whole(stretch(), self.one_of(&[2, 3, 4])),
            1 => whole(strain(), self.one_of(&[2, 4])),
            2 | 3 => of(self.one_of(&SMOOTH), stretch()),
            4 => of(self.one_of(&SMOOTH), strain()),
            5 => {
                let function = self.one_of(&SMOOTH);
                of(function, mul(self.factor(Meaning::Rate), whole(stretch(), 2)))
            }
            6 => whole(of(Ln, stretch()), self.one_of(&[1, 2, 4])),
            7 => real(stretch(), self.factor(Meaning::Exponent)),
            8 => of(self.one_of(&SMOOTH), of(Ln, stretch())),
            9 => of(self.one_of(&[Sqrt, Cbrt, Ln1p, Sigmoid]), stretch()),
            _ => mul(stretch(), of(Ln, stretch())),
        };
        E::OverStretches(Box::new(body))
    }

    /// Σ f(a, b) with f(a, b) = f(b, a).
    fn over_pairs(&mut self) -> Expression {
        let is_positive = self.domain == Domain::Positive;
        let [a, b] = [E::Stretch(0), E::Stretch(1)];
        let product = mul(a.clone(), b.clone());
        let body = match self.random.below(if is_positive { 8 } else { 5 }) {
            0 => whole(product, 2),
            1 => whole(sub(a, b), self.one_of(&[2, 4])),
            2 => of(self.one_of(&SMOOTH), product),
            3 => of(self.one_of(&SMOOTH), add(a, b)),
            4 => of(self.one_of(&[Cosh, Cos]), sub(a, b)),
            5 => whole(of(Ln, div(a, b)), 2),
            6 => real(product, self.factor(Meaning::Exponent)),
            _ => of(Ln, add(a, b)),
        };
        E::OverPairs(Box::new(body))
    }

    /// A term with a minimum or another stationary point at rest.
    fn relaxed_term(&mut self) -> Expression {
        let quantity = self.stationary();
        let shape = match self.random.below(6) {
            0 => quantity,
            1 => of(self.one_of(&[ExpM1, Sinh, Atan, Tanh, Erf]), quantity),
            2 => whole(quantity, self.one_of(&[2, 3])),
            3 => of(Ln, add(E::Number(1, 1), whole(quantity, 2))),
            4 => div(quantity, add(E::Number(2, 1), E::OverStretches(Box::new(whole(E::Stretch(0), 2))))),
            _ => match self.domain {
                Domain::Positive => {
                    let base = E::Excess(self.one_of(&[I1b, I2b]));
                    let power = match self.random.once_in(2) {
                        true => E::Parameter(self.parameter(Meaning::ExponentAboveOne, false)),
                        false => E::Number(5, 4),
                    };
                    real(base, power)
                }
                Domain::Whole => quantity,
            },
        };
        let modulus = self.factor(Meaning::Modulus);
        mul(modulus, shape)
    }

    /// A quantity that is zero and stationary at rest.
    fn stationary(&mut self) -> Expression {
        let stretch = || E::Stretch(0);
        let strain = || sub(stretch(), E::Number(1, 1));
        let volume = || E::Invariant(J);
        match self.random.below(if self.domain == Domain::Positive { 10 } else { 4 }) {
            0 => E::OverStretches(Box::new(whole(strain(), 2))),
            1 => whole(sub(volume(), E::Number(1, 1)), 2),
            2 => E::OverStretches(Box::new(whole(sub(whole(stretch(), 2), E::Number(1, 1)), 2))),
            3 => E::OverPairs(Box::new(whole(sub(E::Stretch(0), E::Stretch(1)), 2))),
            4 => sub(E::Invariant(I1b), E::Number(3, 1)),
            5 => sub(E::Invariant(I2b), E::Number(3, 1)),
            6 => whole(of(Ln, volume()), 2),
            7 => E::OverStretches(Box::new(whole(of(Ln, stretch()), 2))),
            8 => {
                let square = whole(volume(), 2);
                sub(div(sub(square, E::Number(1, 1)), E::Number(2, 1)), of(Ln, volume()))
            }
            _ => sub(sub(E::Invariant(I1), E::Number(3, 1)), mul(E::Number(2, 1), of(Ln, volume()))),
        }
    }
}

fn add(a: Expression, b: Expression) -> Expression {
    E::Add(Box::new(a), Box::new(b))
}

fn sub(a: Expression, b: Expression) -> Expression {
    E::Sub(Box::new(a), Box::new(b))
}

fn mul(a: Expression, b: Expression) -> Expression {
    E::Mul(Box::new(a), Box::new(b))
}

fn div(a: Expression, b: Expression) -> Expression {
    E::Div(Box::new(a), Box::new(b))
}

fn whole(a: Expression, n: i32) -> Expression {
    E::Whole(Box::new(a), n)
}

fn real(a: Expression, exponent: Expression) -> Expression {
    E::Real(Box::new(a), Box::new(exponent))
}

fn of(function: Function, a: Expression) -> Expression {
    E::Of(function, Box::new(a))
}
