//! Texts of all findings: the mistake, and a correction that is ready to paste.

use quote::ToTokens;

use super::finding::{Finding, Remedy, Stressed, Vanishing, Violation};
use super::source::Source;
use crate::algebra::dimension::Clash;
use crate::algebra::expr::{Elementary, Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::printer::{rust, rust_factor};
use crate::read::diagnostics::Diagnostics;
use crate::read::domain::Volume;
use crate::read::notation::Notation;
use crate::read::parse::identifiers;
use crate::read::spelling::list;

/// The longest term, in bytes, that a message quotes: a longer one is better read in the source.
const QUOTABLE: usize = 40;

/// The longest stress, in bytes, to be appended: a longer one is better avoided than balanced.
const APPENDABLE: usize = 200;

pub(crate) fn report(
    graph: &mut Graph,
    source: &Source<'_>,
    findings: impl IntoIterator<Item = Finding>,
    diagnostics: &mut Diagnostics,
) {
    for finding in findings {
        let message = Explainer { graph, source, notation: diagnostics.notation() }.message(&finding);
        diagnostics.error(finding.tokens, message);
    }
}

struct Explainer<'g, 's> {
    graph: &'g mut Graph,
    source: &'s Source<'s>,
    notation: Notation,
}

impl Explainer<'_, '_> {
    fn message(&mut self, Finding { tokens, violation }: &Finding) -> String {
        match violation {
            Violation::RestExcluded => {
                "this excludes the rest state λ1 = λ2 = λ3 = 1, where every body starts: widen the domain"
                    .into()
            }
            Violation::OnOneStretch => {
                let [l1, l2, l3] = &self.source.declaration.stretches;
                format!(
                    "a domain is symmetric, and stretches come in order, `{l1}` ≥ `{l2}` ≥ `{l3}`: write this condition for the \
                     largest, `{l1}`, if it is an upper limit, or for the smallest, `{l3}`, if it is a lower one"
                )
            }
            Violation::NoSamples => {
                "no parameters were found for which this energy is finite near rest: check its domain \
                and `admissible(…)`"
                    .into()
            }
            Violation::Anisotropic { exchanged, term } => {
                let [i, j] = exchanged.map(|i| &self.source.declaration.stretches[i]);
                let term =
                    term.map(|term| format!("`{}`", self.print(term))).filter(|term| term.len() <= QUOTABLE);
                format!(
                    "an isotropic energy does not change when `{i}` and `{j}` are exchanged, but {} does: write the same \
                     for all three stretches",
                    term.as_deref().unwrap_or("this"),
                )
            }
            Violation::NotInPascals(dimension) => {
                let units = self.units();
                format!("this energy is {}, but an energy density is in Pa: {units}", in_unit(*dimension))
            }
            Violation::UnitsClash(clash) => self.units_clash(**clash),
            Violation::PowerAtRest { power } => format!(
                "the base of `{}` vanishes at rest and is negative nearby, where only whole powers have a value: {}, or a \
                 whole power, such as {}, or the power of a base that stays positive, such as \
                 `(1.0 + b * (I1b - 3.0)).powf(n)`",
                self.print(*power),
                match &self.source.invariants()[..] {
                    [] => "write a power of `I1b - 3.0`, which is never negative".to_owned(),
                    names => format!("write {}, since `I1b - 3.0` is never negative", in_place(names)),
                },
                if self.has_real_exponent(*power) && !self.notation.is_formula() {
                    "`.powi(2)` or `.powi(n)` with `n: u32`"
                } else {
                    "`.powi(2)`"
                },
            ),
            Violation::Rough { exponents } => {
                let remedy = self.above_one(exponents);
                format!(
                    "the stiffness of this is infinite at rest, as that of a power of `I1b - 3.0` is for an exponent below 1: {remedy}"
                )
            }
            Violation::ExtendedPower => {
                "the energy has a real power of an expression that vanishes at rest, which is not continued beyond J > 0: remove `extend`"
                    .into()
            }
            Violation::NoContinuation { stretches: [l1, l2, l3] } => format!(
                "`extend` continues logarithms and powers of stretches below J = 0, but where they make up an argument of \
                 another logarithm, root or real power, this may turn negative, as at the stretches {l1:.3}, {l2:.3} and \
                 {l3}: remove `extend`"
            ),
            Violation::StressNotFinite => {
                "the stress of this is not finite at rest, where λ1 = λ2 = λ3 = 1: divide by \
                nothing that vanishes there, and take no logarithm of it"
                    .into()
            }
            Violation::Stressed(stressed) => self.stressed(stressed),
            Violation::NoValue { sign } if *sign < 0.0 => {
                "this has no value where J < 0, in inverted material: declare `domain(J > 0.0)`".into()
            }
            Violation::NoValue { .. } => {
                "this has no value where J = 0, in flat material: declare `domain(J > 0.0)`, or \
                `domain(J != 0.0)` if the energy should treat inverted elements (J < 0) like upright ones"
                    .into()
            }
            Violation::NoValueCollapsed { power, exponent, vanishing } => {
                let place = match vanishing {
                    1 => "λ3 = 0, in elements collapsed to a sheet",
                    2 => "λ2 = λ3 = 0, in elements collapsed to a line",
                    _ => "λ1 = λ2 = λ3 = 0, in elements collapsed to a point",
                };
                let negative = if exponent.is_some() { "its exponent is negative and " } else { "" };
                let admissible = exponent.and_then(|exponent| self.admissible(exponent)).unwrap_or_default();
                let power = self.print(*power);
                format!(
                    "`{power}` has no value where {negative}{place}: declare {admissible}`domain(J > 0.0)`"
                )
            }
            Violation::Vanishing { arguments, has_value } => self.vanishing(arguments, *has_value),
            Violation::FlatExcluded { stretches: [l1, l2, _] } => {
                let names = identifiers(tokens.clone());
                let has = |words: [&str; 2]| words.iter().any(|word| names.iter().any(|name| name == word));
                let instead = if has(["I1b", "I2b"]) {
                    "bound a quantity that stays moderate there, such as I1 instead of I1b"
                } else if has(["I1", "I2"]) {
                    "this condition, and write `I1b` for `I1` in the energy, which is 3 or more wherever J > 0"
                } else {
                    "this condition"
                };
                format!(
                    "`extend` continues the energy beyond J > 0, but where elements are flat, such as at the stretches {l1}, \
                     {l2} and 0, this does not hold: remove `extend`, or {instead}"
                )
            }
            Violation::NoShearModulus => {
                "the shear modulus of this energy is zero at rest: add a term that resists shear, \
                 such as `mu / 2.0 * (I1b - 3.0)`"
                    .into()
            }
            Violation::Overflow => {
                "the exact fractions in the derivatives of this energy leave 128 bits: use smaller numbers"
                    .into()
            }
            Violation::ExtendWithoutDomain => {
                "`extend` continues an energy beyond `domain(J > 0.0)`: declare that or remove `extend`"
                    .into()
            }
        }
    }

    fn units_clash(&mut self, clash: Clash) -> String {
        match clash {
            Clash::Terms(terms) => {
                let [one, other] = terms.map(|(term, dimension)| self.with_unit(term, dimension));
                let (other, units) = (other.trim_end_matches(','), self.units());
                format!("{one} is added to {other}, but terms of a sum have one unit: {units}")
            }
            Clash::Argument(argument, dimension) => format!(
                "{} stands where only a number without unit can, in a logarithm, an exponential, an exponent, a \
                 power with a parameter as exponent, or a function: divide it by a parameter of the same unit; \
                 or {}",
                self.with_unit(argument, dimension),
                self.units()
            ),
        }
    }

    /// Advice on how to state units, and how not to.
    fn units(&self) -> &'static str {
        self.notation.either(
            "correct the energy, or the units that end the documentation of its parameters, as in \
            `/// Shear modulus, Pa.` and `/// Exponent, dimensionless.`; if a number in the energy has a \
            unit, make it a parameter, or leave the units out",
            "correct the energy, or the units of the values; if a number in the energy has a unit, make it a parameter, \
            or give the values without units",
        )
    }

    /// A quoted term with its unit: `c1 * l1`, in Pa.
    fn with_unit(&mut self, term: Id, dimension: Rational) -> String {
        let is_number = matches!(self.graph.node(term), Node::Linear { .. }) && dimension.is_zero();
        let text = self.print(term);
        match is_number || text.len() > QUOTABLE {
            true if dimension.is_zero() => "a number without unit".to_owned(),
            true => format!("a term {}", in_unit(dimension)),
            false => format!("`{text}`, {},", in_unit(dimension)),
        }
    }

    fn print(&mut self, id: Id) -> String {
        rust(self.graph, self.source.declaration, id)
    }

    fn stressed(&mut self, stressed: &Stressed) -> String {
        let source = self.source;
        let domain = if source.volume == Volume::Positive { "" } else { " with `domain(J > 0.0)`" };
        let isochoric = stressed
            .is_isochoric_free
            .then(|| format!("write {}{domain}, which leaves none", in_place(&source.invariants())));
        // Where elements are flat, isochoric invariants are beyond limits.
        let is_limited = source.declaration.options.extend.is_some() && !source.bounds.is_empty();
        let remedies = match (&stressed.vanishing[..], isochoric) {
            ([Vanishing { remedy: Remedy::Isochoric, .. }, ..], Some(isochoric)) => {
                format!("{isochoric} and has a value wherever J > 0")
            }
            ([], Some(isochoric)) if !is_limited => {
                format!("{}; or {isochoric}", self.balance(stressed))
            }
            _ => self.balance(stressed),
        };
        // In an energy of a compressible solid, a slip is likelier than a missing term.
        let names = identifiers(source.declaration.body.to_token_stream());
        let is_compressible = !source.declaration.options.domain.is_empty()
            || ["J", "I1b", "I2b"].into_iter().any(|word| names.iter().any(|name| name == word));
        let mistyped = if is_compressible {
            " (if the paper's solid is compressible, a factor or a power is mistyped)"
        } else {
            ""
        };
        let meant = self.stress_is_meant();
        let stress = self.print(stressed.stress);
        let is_cut_short =
            is_cut(&stress) || self.limits(&stressed.vanishing).iter().any(|limit| is_cut(limit));
        if stress.len() > APPENDABLE || is_cut_short {
            let instead = match stressed.is_isochoric_free {
                true => in_place(&source.invariants()),
                false if !source.invariants().is_empty() => {
                    return format!(
                        "this leaves stress at rest: remove it by a term in `J.ln()`{domain}{meant}{mistyped}"
                    );
                }
                false => self.isochoric_stretches(),
            };
            return format!(
                "this leaves stress at rest: write {instead}{domain}, which leaves none{meant}{mistyped}"
            );
        }
        let remedies = match names_stretches(source) && !is_limited {
            true => format!("{remedies}; or write {}{domain}, which leaves none", self.isochoric_stretches()),
            false => remedies,
        };
        format!("this leaves the stress `{stress}` at rest: {remedies}{meant}{mistyped}")
    }

    /// The option for an energy whose stress at rest is intended, or is that of an incompressible solid.
    fn stress_is_meant(&self) -> String {
        match self.notation {
            Notation::Formula { free_rest: Some(option) } => {
                format!("; or give the option `{option}`, which appends that term")
            }
            Notation::Formula { free_rest: None } => String::new(),
            Notation::Attribute | Notation::Rust => "; or add `prestressed` to the attribute".to_owned(),
        }
    }

    /// The isochoric stretches instead of the stretches.
    fn isochoric_stretches(&self) -> String {
        let [l1, l2, l3] = &self.source.declaration.stretches;
        format!("`{l1} / J.cbrt()` for `{l1}`, and so on for `{l2}` and `{l3}`")
    }

    /// A term, ready to paste, that makes the rest state stress-free, and the domain that it needs.
    fn balance(&mut self, stressed: &Stressed) -> String {
        let &Stressed { stress, has_logarithm, has_value, .. } = stressed;
        let declaration = self.source.declaration;
        let term = if self.print(stress).starts_with('-') {
            let negated = self.graph.neg(stress);
            format!("+ {}", rust_factor(self.graph, declaration, negated))
        } else {
            format!("- {}", rust_factor(self.graph, declaration, stress))
        };
        let limits = self.limits(&stressed.vanishing);
        let is_limited = !limits.is_empty();
        let domain = format!(" with {}", self.positive_domain(limits));
        if has_logarithm {
            let domain = if is_limited || !has_value { &domain } else { "" };
            return format!("append `{term} * (J - 1.0)`{domain}, or remove the term in `J.ln()`");
        }
        let logarithm = format!("append `{term} * J.ln()`");
        match self.source.volume {
            _ if is_limited => format!("{logarithm}{domain}"),
            Volume::Positive => logarithm,
            _ if !has_value => format!("{logarithm}{domain}"),
            Volume::Nonzero => format!("{logarithm}{domain}, or `{term} * (J - 1.0)` with the declared one"),
            Volume::Any => format!("{logarithm}{domain}, or `{term} * (J - 1.0)` with any domain"),
        }
    }

    fn vanishing(&mut self, arguments: &[Vanishing], has_value: bool) -> String {
        let declaration = self.source.declaration;
        let limits = self.limits(arguments);
        let remedy = if limits.is_empty() {
            let names = self.source.invariants();
            let is = if names.len() == 1 { "is" } else { "are" };
            format!("write {}, which {is} at least 3 wherever J > 0", in_place(&names))
        } else {
            let domain = if has_value {
                let conditions = declaration.options.domain.iter().map(|it| it.to_token_stream().to_string());
                let conditions: Vec<_> = conditions.chain(limits).collect();
                format!("`domain({})`", conditions.join(", "))
            } else {
                self.positive_domain(limits)
            };
            let is_parameter = |&id: &Id| matches!(self.graph.node(id), Node::Parameter(_));
            let all: Vec<_> = arguments.iter().map(|argument| argument.of).collect();
            let has_parameters = self.graph.reachable(&all).iter().any(is_parameter);
            let or = if has_parameters { ", or limit the parameters by `admissible(…)`" } else { "" };
            match is_cut(&domain) {
                true => "limit the domain by conditions under which it does not".to_owned(),
                false => format!("declare {domain}{or}"),
            }
        };
        let texts: Vec<_> = arguments.iter().map(|argument| self.print(argument.of)).collect();
        let (vanish, these) = if texts.len() == 1 { ("vanishes", "this") } else { ("vanish", "the energy") };
        format!("{} {vanish} inside the domain, and there {these} has no value: {remedy}", list(&texts))
    }

    /// The conditions that expressions do not vanish; none if isochoric invariants keep them from it.
    fn limits(&mut self, arguments: &[Vanishing]) -> Vec<String> {
        arguments.iter().filter_map(|&argument| self.limit(argument)).collect()
    }

    /// The condition that an expression does not vanish.
    fn limit(&mut self, Vanishing { of, remedy }: Vanishing) -> Option<String> {
        let side = match remedy {
            Remedy::Isochoric => return None,
            Remedy::Positive => '>',
            Remedy::Negative => '<',
        };
        // Beyond their first zero, these are positive again.
        Some(match *self.graph.node(of) {
            Node::Elementary(Elementary::Sin, a) if side == '>' => format!("{} < PI", self.print(a)),
            Node::Elementary(Elementary::Cos, a) if side == '>' => format!("{} < PI / 2.0", self.print(a)),
            _ => format!("{} {side} 0.0", self.print(of)),
        })
    }

    /// The declared domain where J > 0, with further conditions.
    fn positive_domain(&self, limits: Vec<String>) -> String {
        let conditions =
            self.source.declaration.bounds().map(|condition| condition.to_token_stream().to_string());
        let conditions: Vec<_> =
            std::iter::once("J > 0.0".to_owned()).chain(conditions).chain(limits).collect();
        format!("`domain({})`", conditions.join(", "))
    }

    /// True if parameters enter the exponent of a power.
    fn has_real_exponent(&self, power: Id) -> bool {
        matches!(self.graph.node(power), Node::Product(factors)
            if factors.iter().any(|(_, exponent)| exponent.real.is_some()))
    }

    /// The remedy that exponents are above 1.
    fn above_one(&mut self, exponents: &[Exponent]) -> String {
        let mut conditions: Vec<String> = Vec::new();
        for &exponent in exponents {
            match self.is_above_one(exponent) {
                Some(condition) if conditions.contains(&condition) => {}
                Some(condition) => conditions.push(condition),
                None => return "take a power above 1".to_owned(),
            }
        }
        match conditions.is_empty() {
            true => "take a power above 1".to_owned(),
            false => format!("declare {}", self.with_admissible(conditions)),
        }
    }

    /// The condition that an exponent is above 1, if it can be declared: of `2.0 * n + 1.0` it is `n > 0.0`.
    fn is_above_one(&mut self, exponent: Exponent) -> Option<String> {
        let mut varying = exponent.real?;
        let mut limit = Rational::ONE.checked_add(exponent.rational.negated())?;
        let mut side = '>';
        if let Node::Linear { constant, terms } = self.graph.node(varying)
            && let (true, &[(term, factor)]) = (constant.is_zero(), &terms[..])
        {
            limit = limit.checked_mul(factor.checked_powi(-1)?)?;
            side = if factor.is_negative() { '<' } else { '>' };
            varying = term;
        }
        let limit = self.graph.constant(limit);
        let condition = format!("{} {side} {}", self.print(varying), self.print(limit));
        self.is_declarable(varying, &condition).then_some(condition)
    }

    /// The declared conditions on parameters, with the further one that an exponent is positive.
    fn admissible(&mut self, exponent: Id) -> Option<String> {
        let condition = format!("{} > 0.0", self.print(exponent));
        self.is_declarable(exponent, &condition)
            .then(|| format!("{}, or ", self.with_admissible(vec![condition])))
    }

    /// True if a condition on an expression of parameters can be declared as it is printed: such conditions
    /// have no sums.
    fn is_declarable(&self, of: Id, condition: &str) -> bool {
        !self.graph.contains(of, |node| matches!(node, Node::Sum(..))) && !is_cut(condition)
    }

    /// The declared conditions on parameters with further ones.
    fn with_admissible(&self, further: Vec<String>) -> String {
        let declared = self.source.declaration.options.admissible.iter();
        let declared = declared.map(|condition| condition.to_token_stream().to_string().replace(" [", "["));
        let conditions: Vec<_> = declared.chain(further).collect();
        format!("`admissible({})`", conditions.join(", "))
    }
}

/// True if a printed expression is abbreviated, so that it cannot be pasted.
fn is_cut(text: &str) -> bool {
    text.contains('…')
}

/// True if an energy is written in stretches, and not in their isochoric parts.
fn names_stretches(source: &Source<'_>) -> bool {
    let body = identifiers(source.declaration.body.to_token_stream());
    let is_used = |name: &syn::Ident| body.contains(name);
    source.declaration.stretches.iter().all(is_used)
        && !["J", "I1b", "I2b"].into_iter().any(|word| body.iter().any(|name| name == word))
        && source.invariants().is_empty()
}

/// A unit with its preposition.
fn in_unit(dimension: Rational) -> String {
    match dimension {
        Rational::ONE => "in Pa".to_owned(),
        _ if dimension.is_zero() => "without unit".to_owned(),
        _ if dimension.denominator() == 1 => format!("in Pa^{}", dimension.numerator()),
        _ => format!("in Pa^({}/{})", dimension.numerator(), dimension.denominator()),
    }
}

/// The isochoric invariants in place of the plain ones: `I1b` for `I1`, or both.
fn in_place(names: &[&str]) -> String {
    let isochoric: Vec<_> = names.iter().map(|name| format!("{name}b")).collect();
    format!("{} for {}", list(&isochoric), list(names))
}
