//! Parameters that follow from Young's modulus and Poisson's ratio.
//!
//! These two determine the small-strain moduli μ and λ. An energy has a constructor from them if μ and λ are
//! affine in exactly two scalar parameters, with a nonzero determinant, and depend on no other parameter:
//!
//! ```text
//! μ = a₁ p₁ + a₂ p₂ + a₀,   λ = b₁ p₁ + b₂ p₂ + b₀
//! ```

use crate::algebra::expr::{Graph, Id, Node, ParameterIndex};
use crate::algebra::rational::Rational;

/// The two parameters, in the order of the declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct YoungPoisson(pub [Determined; 2]);

/// A parameter that is mu μ + lambda λ + constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Determined {
    /// The index of the parameter.
    pub parameter: ParameterIndex,
    /// The coefficient of the shear modulus.
    pub mu: Rational,
    /// The coefficient of the first Lamé parameter.
    pub lambda: Rational,
    /// The constant, Pa.
    pub constant: Rational,
}

impl YoungPoisson {
    /// The parameter, if it is one of the two.
    #[must_use]
    pub fn of(&self, parameter: ParameterIndex) -> Option<&Determined> {
        self.0.iter().find(|determined| determined.parameter == parameter)
    }
}

/// The parameters that follow from the small-strain moduli μ and λ, if exactly two do.
pub fn young_poisson(graph: &Graph, moduli: [Id; 2]) -> Option<YoungPoisson> {
    let [p, q] = <[ParameterIndex; 2]>::try_from(entering(graph, moduli)?).ok()?;
    let [shear, lame] = moduli.map(|modulus| affine(graph, modulus, [p, q]));
    let ((a, shear), (b, lame)) = (shear?, lame?);
    // Cramer's rule for a₁ p₁ + a₂ p₂ = μ − a₀, b₁ p₁ + b₂ p₂ = λ − b₀.
    let minor = |x: Rational, y: Rational, z: Rational, w: Rational| {
        x.checked_mul(y)?.checked_add(z.checked_mul(w)?.negated())
    };
    let over = minor(a[0], b[1], a[1], b[0])?.checked_powi(-1)?;
    let determined = |parameter, mu: Rational, lambda: Rational| {
        let (mu, lambda) = (mu.checked_mul(over)?, lambda.checked_mul(over)?);
        let constant = mu.checked_mul(shear)?.checked_add(lambda.checked_mul(lame)?)?.negated();
        Some(Determined { parameter, mu, lambda, constant })
    };
    Some(YoungPoisson([determined(p, b[1], a[1].negated())?, determined(q, b[0].negated(), a[0])?]))
}

/// The parameters that enter the moduli in the order of the declaration; `None` if one is a list.
fn entering(graph: &Graph, moduli: [Id; 2]) -> Option<Vec<ParameterIndex>> {
    let mut found = Vec::new();
    for id in graph.reachable(&moduli) {
        match graph.node(id) {
            Node::Parameter(k) => found.push(*k),
            Node::Entry(_) => return None,
            _ => {}
        }
    }
    found.sort_unstable();
    Some(found)
}

/// The coefficients of both parameters and the constant, if the modulus is affine in them.
fn affine(graph: &Graph, modulus: Id, [p, q]: [ParameterIndex; 2]) -> Option<([Rational; 2], Rational)> {
    match graph.node(modulus) {
        Node::Parameter(k) => {
            let coefficient = |of| if of == *k { Rational::ONE } else { Rational::ZERO };
            Some(([coefficient(p), coefficient(q)], Rational::ZERO))
        }
        Node::Linear { constant, terms } => {
            let start = ([Rational::ZERO; 2], *constant);
            terms.iter().try_fold(start, |([a, b], c), &(term, factor)| {
                let ([inner_a, inner_b], inner_c) = affine(graph, term, [p, q])?;
                let plus = |sum: Rational, inner: Rational| sum.checked_add(inner.checked_mul(factor)?);
                Some(([plus(a, inner_a)?, plus(b, inner_b)?], plus(c, inner_c)?))
            })
        }
        _ => None,
    }
}
