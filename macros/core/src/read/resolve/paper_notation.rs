//! Notation of papers that a declaration writes in another way.

use super::tensors;
use crate::read::spelling::plain;

/// The advice for a name that papers use.
pub(super) fn name(name: &str) -> Option<&'static str> {
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
        "PI" | "pi" => "write the number, `3.141592653589793`",
        _ => return None,
    })
}

/// The advice for a function that papers use.
pub(super) fn function(name: &str) -> Option<&'static str> {
    Some(match name {
        "pow" => "write `.powi(2)` or `.powf(alpha)`",
        "log" | "log10" | "log2" => "write `.ln()`",
        "exp2" | "exp_m1" => "write `.exp()`",
        "ln_1p" => "write `(1.0 + x).ln()`",
        "cosh" => "write `(x.exp() + (-x).exp()) / 2.0`",
        "sinh" => "write `(x.exp() - (-x).exp()) / 2.0`",
        "tanh" => "write `1.0 - 2.0 / ((2.0 * x).exp() + 1.0)`",
        "sin" | "cos" | "tan" | "asin" | "acos" | "atan" | "erf" | "asinh" | "acosh" | "atanh" => {
            "give it as a parameter, `f: piola::Spline`, and write `f(x)`"
        }
        _ => return None,
    })
}
