//! Functions of tensors in papers, such as tr C⁻¹, which a declaration writes in invariants.

use quote::ToTokens;
use syn::Expr;

use crate::read::spelling::plain;

/// The advice for a function of tensors, given the tensor of its argument if that is one.
pub(super) fn function(name: &str, of: Option<Tensor>) -> Option<&'static str> {
    Some(match (name, of) {
        ("tr" | "trace", Some(Tensor::CauchyGreen)) => "write `I1` for the trace of C",
        ("tr" | "trace", Some(Tensor::Inverse)) => "write `I2 / J.powi(2)` for the trace of C⁻¹",
        ("tr" | "trace", _) => {
            "write the sum of the eigenvalues, of C `l1.powi(2)` and so on, of the Green strain E `(l1.powi(2) - 1.0) / 2.0`"
        }
        ("det" | "determinant", Some(Tensor::CauchyGreen)) => "write `J.powi(2)` for the determinant of C",
        ("det" | "determinant", Some(Tensor::Inverse)) => "write `J.powi(-2)` for the determinant of C⁻¹",
        ("det" | "determinant", _) => "write `J` for the determinant of F",
        _ => return None,
    })
}

/// A tensor of which papers take traces and determinants.
pub(super) enum Tensor {
    /// C, or b, which has the same eigenvalues.
    CauchyGreen,
    /// C⁻¹ or b⁻¹.
    Inverse,
    /// Any other tensor.
    Other,
}

/// The tensor that an expression stands for in papers.
pub(super) fn tensor(expression: &Expr) -> Option<Tensor> {
    let inverse = |of: &Expr| {
        Some(match tensor(of)? {
            Tensor::CauchyGreen => Tensor::Inverse,
            Tensor::Inverse => Tensor::CauchyGreen,
            Tensor::Other => Tensor::Other,
        })
    };
    let other = |of: &Expr| tensor(of).map(|_| Tensor::Other);
    match expression {
        Expr::Paren(inner) => tensor(&inner.expr),
        Expr::Group(inner) => tensor(&inner.expr),
        Expr::Reference(inner) => tensor(&inner.expr),
        Expr::Path(path) => named(&plain(path.path.get_ident()?)),
        Expr::MethodCall(call) => match call.method.to_string().as_str() {
            name if is_inversion(name) => inverse(&call.receiver),
            "powi" | "powf" | "pow" if call.args.first().is_some_and(is_minus_one) => inverse(&call.receiver),
            _ => other(&call.receiver),
        },
        Expr::Call(call) => match (&*call.func, call.args.first()) {
            (Expr::Path(path), Some(of))
                if path.path.get_ident().is_some_and(|name| is_inversion(&name.to_string())) =>
            {
                inverse(of)
            }
            _ => None,
        },
        Expr::Unary(unary) => other(&unary.expr),
        Expr::Binary(binary) => other(&binary.left).or_else(|| other(&binary.right)),
        _ => None,
    }
}

fn is_inversion(function: &str) -> bool {
    matches!(function, "inverse" | "try_inverse" | "inv" | "recip")
}

fn is_minus_one(exponent: &Expr) -> bool {
    let text = exponent.to_token_stream().to_string().replace([' ', '(', ')'], "");
    matches!(text.as_str(), "-1" | "-1." | "-1.0")
}

/// The tensor that papers denote by a name, given without underscores.
pub(super) fn named(name: &str) -> Option<Tensor> {
    Some(match name {
        "C" | "B" | "b" => Tensor::CauchyGreen,
        "Cinv" | "invC" | "Cinverse" | "Cm1" | "Binv" | "invB" | "Binverse" | "Bm1" | "binv" | "invb"
        | "binverse" | "bm1" => Tensor::Inverse,
        "E" | "F" | "U" | "S" => Tensor::Other,
        _ => return None,
    })
}
