//! The rules that an energy can break, as values: their texts are in [`explain`](super::explain).

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::Expr;

use super::source::Source;
use crate::algebra::dimension::Clash;
use crate::algebra::expr::{Exponent, Id};
use crate::algebra::rational::Rational;

/// A broken rule, at the tokens that break it.
pub(crate) struct Finding {
    pub(crate) tokens: TokenStream,
    pub(crate) violation: Violation,
}

/// A rule that an energy breaks, with the data of its message.
pub(crate) enum Violation {
    /// A condition of the domain excludes the rest state.
    RestExcluded,
    /// A condition of the domain is on the second stretch, and not on all three alike.
    OnOneStretch,
    /// No parameters were found for which the energy is finite.
    NoSamples,
    /// Two stretches cannot be exchanged. The term is `None` if it is the whole energy.
    Anisotropic { exchanged: [usize; 2], term: Option<Id> },
    /// Parts with inconsistent units.
    UnitsClash(Box<Clash>),
    /// The energy is in another power of Pa than the first.
    NotInPascals(Rational),
    /// The base of a power that is not whole vanishes at rest.
    PowerAtRest { power: Id },
    /// The stiffness grows without bound towards rest, as that of powers of an excess with these exponents
    /// does.
    Rough { exponents: Vec<Exponent> },
    /// `extend` of an energy with a real power of an excess.
    ExtendedPower,
    /// The stress at rest is not finite.
    StressNotFinite,
    /// Stress at rest.
    Stressed(Stressed),
    /// The energy has no value where J has this sign, −1 or 0.
    NoValue { sign: f64 },
    /// A power or logarithm has no value where some stretches vanish, unless its exponent, if that is real,
    /// is positive.
    NoValueCollapsed { power: Id, exponent: Option<Id>, vanishing: usize },
    /// Arguments vanish inside the domain. `has_value`: the energy has a value for all volumes of its domain.
    Vanishing { arguments: Vec<Vanishing>, has_value: bool },
    /// A condition excludes flat elements, such as one with these stretches, where an extension begins.
    FlatExcluded { stretches: [f64; 3] },
    /// The shear modulus is zero.
    NoShearModulus,
    /// The exact fractions leave 128 bits.
    Overflow,
    /// A continuation without a value at these stretches.
    NoContinuation { stretches: [f64; 3] },
    /// `extend` without `domain(J > 0.0)`.
    ExtendWithoutDomain,
}

/// Stress at rest, with the data that decide how it can be removed.
pub(crate) struct Stressed {
    /// ψ1 at rest.
    pub(crate) stress: Id,
    /// True if the energy contains the stress times ln J, so that subtracting it would only remove that term.
    pub(crate) has_logarithm: bool,
    /// True if replacing I1 and I2 by I1b and I2b removes the stress.
    pub(crate) is_isochoric_free: bool,
    /// The arguments that vanish inside the domain.
    pub(crate) vanishing: Vec<Vanishing>,
    /// True if the energy has a value for all volumes of its domain.
    pub(crate) has_value: bool,
}

/// An expression that must not vanish inside the domain but does.
#[derive(Clone, Copy)]
pub(crate) struct Vanishing {
    pub(crate) of: Id,
    pub(crate) remedy: Remedy,
}

/// A change of the declaration after which an expression does not vanish inside the domain.
#[derive(Clone, Copy)]
pub(crate) enum Remedy {
    /// I1b, I2b in place of I1, I2.
    Isochoric,
    /// The condition that the expression is positive.
    Positive,
    /// The condition that the expression is negative.
    Negative,
}

impl Finding {
    pub(crate) fn new(tokens: impl ToTokens, violation: Violation) -> Self {
        Self { tokens: tokens.into_token_stream(), violation }
    }
}

impl Violation {
    /// True if correcting this may change stress or stiffness at rest.
    pub(crate) fn affects_rest(&self) -> bool {
        matches!(
            self,
            Self::PowerAtRest { .. }
                | Self::Rough { .. }
                | Self::StressNotFinite
                | Self::Stressed(_)
                | Self::Overflow
        )
    }
}

/// Collects findings about the parts of an energy.
///
/// A part that breaks one rule often breaks others by the same token: the root of an expression that vanishes
/// at rest has no finite stress there, and no value on one side of it. Such a part is reported once, by the
/// first rule.
pub(crate) struct Findings<'a> {
    pub(crate) source: &'a Source<'a>,
    pub(crate) found: Vec<Finding>,
    blamed: Vec<Id>,
}

impl<'a> Findings<'a> {
    pub(crate) fn new(source: &'a Source<'a>) -> Self {
        Self { source, found: Vec::new(), blamed: Vec::new() }
    }

    /// True if a part that has already been reported breaks this rule too.
    pub(crate) fn is_known(&self, breaks: impl FnMut(Id) -> bool) -> bool {
        self.blamed.iter().copied().any(breaks)
    }

    /// Adds the finding about a part, or about the whole energy.
    pub(crate) fn add(&mut self, part: Option<&Expr>, violation: Violation) {
        self.blamed.push(part.and_then(|part| self.source.nodes.of(part)).unwrap_or(self.source.energy));
        self.found.push(Finding::new(part, violation));
    }
}
