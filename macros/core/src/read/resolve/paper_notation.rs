//! Notation of papers that has another form in declarations.

use super::tensors;
use crate::read::notation::Notation;
use crate::read::spelling::plain;

/// The advice for a name that papers use for an expression with another notation in declarations, such as
/// `trC`.
#[must_use]
pub fn advice(name: &str) -> Option<&'static str> {
    Some(match plain(name).as_str() {
        "I3" | "III" | "IIIC" => "write `J.powi(2)`, and `J` for its root",
        "I1bar" | "Ibar1" | "I1iso" | "Ib1" => "write `I1b`",
        "I2bar" | "Ibar2" | "I2iso" | "Ib2" => "write `I2b`",
        "trC" | "IC" => "write `I1`",
        "IIC" => "write `I2`, or `I1.powi(2) - 2.0 * I2` for C : C",
        "detF" => "write `J`",
        "lnJ" | "logJ" => "write `J.ln()`",
        plain if tensors::named(plain).is_some() => {
            "an energy is written in the stretches or in `I1`, `I2`, `J`: C has eigenvalues `l1.powi(2)` and so on, the Green strain E \
             `(l1.powi(2) - 1.0) / 2.0`"
        }
        "e" => "write `x.exp()` for eˣ",
        "pi" => "write `PI`",
        "I4" | "I5" | "I6" | "I7" | "I8" | "I4b" | "J4" | "IV" => {
            "it belongs to fibres, and an energy is isotropic here: it depends on the three stretches alone"
        }
        _ => return None,
    })
}

/// The advice for a function that papers use.
pub(super) fn function(name: &str, notation: Notation) -> Option<&'static str> {
    Some(match name {
        "pow" => "write `.powi(2)` or `.powf(alpha)`",
        "exp2" => "write `2.0.ln()` times x, then `.exp()`",
        "expm1" => "write `.exp_m1()`",
        "log1p" | "ln1p" => "write `.ln_1p()`",
        "arctan" | "arctg" => "write `.atan()`",
        "arsinh" | "arcsinh" => "write `.asinh()`",
        "tan" => "write `x.sin() / x.cos()`, and a domain in which the cosine stays positive",
        "coth" => "write `x.cosh() / x.sinh()`, and a domain in which x stays positive",
        "erfc" => "write `1.0 - x.erf()`",
        "atanh" | "artanh" | "arctanh" => {
            "write `((1.0 + x) / (1.0 - x)).ln() / 2.0`, and a domain in which it has a value"
        }
        "acosh" | "arcosh" => {
            "write `(x + (x.powi(2) - 1.0).sqrt()).ln()`, and a domain in which it has a value"
        }
        "logistic" => "write `.sigmoid()`",
        "langevin" => "write `x.cosh() / x.sinh() - 1.0 / x`",
        "asin" | "acos" | "erfi" | "gamma" => notation.either(
            "give it as a parameter `f: F`, with a type of your own that implements `piola::Univariate`, and write `f(x)`",
            "formulas do not have it",
        ),
        _ => return None,
    })
}
