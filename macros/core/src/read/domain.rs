//! The domain of a declaration: the volumes J for which its energy is defined, and its other conditions.

use syn::{BinOp, Expr};

use crate::read::notation::digits;
use crate::read::parse::Declaration;

/// The volumes J for which an energy is defined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Volume {
    /// All of them.
    #[default]
    Any,
    /// J > 0.
    Positive,
    /// J ≠ 0.
    Nonzero,
}

impl Declaration {
    /// The volumes of the domain.
    #[must_use]
    pub fn volume(&self) -> Volume {
        self.options.domain.iter().find_map(volume).unwrap_or_default()
    }

    /// The conditions of the domain except those on the sign of J.
    pub fn bounds(&self) -> impl Iterator<Item = &Expr> {
        self.options.domain.iter().filter(|condition| volume(condition).is_none())
    }
}

/// `J > 0.0` or `J != 0.0`: conditions that are emitted as ones on the sign of the last stretch.
fn volume(condition: &Expr) -> Option<Volume> {
    let is_j = |e: &Expr| matches!(e, Expr::Path(path) if path.path.is_ident("J"));
    let is_zero = |e: &Expr| {
        matches!(e, Expr::Lit(number)
            if digits(&number.lit).is_some_and(|(digits, _)| digits.parse::<f64>() == Ok(0.0)))
    };
    let Expr::Binary(binary) = condition else { return None };
    let (forward, backward) =
        (is_j(&binary.left) && is_zero(&binary.right), is_zero(&binary.left) && is_j(&binary.right));
    match binary.op {
        BinOp::Gt(_) if forward => Some(Volume::Positive),
        BinOp::Lt(_) if backward => Some(Volume::Positive),
        BinOp::Ne(_) if forward || backward => Some(Volume::Nonzero),
        _ => None,
    }
}
