//! Notation of a declaration, which is also that of all code in messages about it.
//!
//! Messages quote Rust. About a formula, each piece of code in backticks is read as the expression that it is
//! and written as formulas are: `J.powi(2)` as `J^2`, `domain(J > 0.0)` as `where J > 0`.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{BinOp, Expr, ExprCall, ExprMethodCall, Lit, UnOp};

/// The notation in which an energy is declared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Notation {
    /// Rust below the attribute, to be compiled.
    #[default]
    Attribute,
    /// Rust of that form, read at run time.
    Rust,
    /// A formula, from which the declaration has been made.
    Formula {
        /// The option that makes the rest state free of stress, as the user writes it, if there is one.
        free_rest: Option<&'static str>,
    },
}

/// The precedence of a formula, from the loosest.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Level {
    Sum,
    Product,
    Power,
    Atom,
}

/// A stand-in for `…` while a quotation is read as an expression.
const LEFT_OUT: &str = "__";

impl Notation {
    /// True if the declaration is a formula.
    pub(crate) fn is_formula(self) -> bool {
        matches!(self, Self::Formula { .. })
    }

    /// One of two texts: for declarations in Rust, and for formulas.
    pub(crate) fn either<T>(self, rust: T, formula: T) -> T {
        if self.is_formula() { formula } else { rust }
    }

    /// A message about Rust with its code in this notation.
    #[must_use]
    pub fn message(self, message: &str) -> String {
        if !self.is_formula() {
            return message.to_owned();
        }
        let mut parts: Vec<String> = message.split('`').map(str::to_owned).collect();
        // A backtick that opens nothing is text.
        let quotations = (parts.len() - 1) / 2;
        for part in parts.iter_mut().skip(1).step_by(2).take(quotations) {
            *part = quotation(part);
        }
        parts.join("`")
    }
}

/// A name without the mark of one that means something else in declarations, `r#`.
#[must_use]
pub fn plain_name(name: &impl ToString) -> String {
    let name = name.to_string();
    name.strip_prefix("r#").map(str::to_owned).unwrap_or(name)
}

/// A condition in the usual format: `mu[p] * alpha[p] > 0`.
#[must_use]
pub fn condition_text(condition: &Expr) -> String {
    spaced(&condition.to_token_stream()).replace(".0 ", " ").trim_end_matches(".0").replace("r#", "")
}

/// Tokens with the usual spaces: inside of the compiler they are printed with different ones than outside.
#[must_use]
pub fn spaced(tokens: &TokenStream) -> String {
    let printed = tokens.to_string();
    let mut text = String::new();
    let mut characters = printed.chars().peekable();
    while let Some(character) = characters.next() {
        if character != ' ' || characters.peek().is_some_and(|&next| is_space_between(&text, next)) {
            text.push(character);
        }
    }
    text.replace("(| ", "(|").replace(" | ", "| ")
}

/// True if conventional formatting has a space between a text and the next token.
fn is_space_between(text: &str, next: char) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let is_call = "([".contains(next) && text.ends_with(is_name);
    let before_minus = text.strip_suffix('-').map(str::trim_end);
    let is_sign = before_minus.is_some_and(|text| !text.ends_with(|c| is_name(c) || ")]".contains(c)));
    !(is_call || is_sign || text.ends_with(['(', '[', '.']) || ")].,".contains(next))
}

/// Code of a message as a formula; other text stays as it is.
fn quotation(code: &str) -> String {
    match code {
        ".powi(2)" => return "x^2".to_owned(),
        ".powf(alpha)" => return "x^alpha".to_owned(),
        // An option of a command.
        _ if code.starts_with("--") => return code.to_owned(),
        _ => {}
    }
    // A method, or a term with the sign that joins it to others.
    if let Some(name) = code.strip_prefix('.').and_then(|code| code.strip_suffix("()")) {
        return name.to_owned();
    }
    for sign in ["+ ", "- "] {
        if let Some(term) = code.strip_prefix(sign) {
            return format!("{sign}{}", quotation(term));
        }
    }
    let text = code.replace('…', LEFT_OUT);
    let written = syn::parse_str::<Expr>(&text).ok().and_then(|code| formula(&code, Level::Sum));
    match written {
        Some(written) => written.replace(LEFT_OUT, "…"),
        // Words between dots are not an expression.
        None if code.starts_with("sum(|") => {
            code.replacen("sum(|", "sum(", 1).replacen("| ", ", ", 1).replace("r#", "")
        }
        None => code.replace("r#", ""),
    }
}

/// An expression as a formula, in parentheses where its surroundings bind more tightly; `None` if formulas do
/// not have it.
fn formula(expression: &Expr, least: Level) -> Option<String> {
    let (level, text) = match expression {
        Expr::Lit(literal) => (Level::Atom, number(&literal.lit)?),
        Expr::Path(path) => {
            let name = path.path.segments.last()?.ident.to_string();
            (Level::Atom, if name == "PI" { "pi".to_owned() } else { plain_name(&name) })
        }
        Expr::Paren(inner) if is_left_out(&inner.expr) => (Level::Atom, format!("({LEFT_OUT})")),
        Expr::Paren(inner) => return formula(&inner.expr, least),
        Expr::Group(inner) => return formula(&inner.expr, least),
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            (Level::Sum, format!("-{}", formula(&unary.expr, Level::Product)?))
        }
        Expr::Binary(binary) => {
            let (level, left, sign, right) = match binary.op {
                BinOp::Add(_) => (Level::Sum, Level::Sum, " + ", Level::Product),
                BinOp::Sub(_) => (Level::Sum, Level::Sum, " - ", Level::Product),
                BinOp::Mul(_) => (Level::Product, Level::Product, "*", Level::Power),
                BinOp::Div(_) => (Level::Product, Level::Product, "/", Level::Power),
                BinOp::Lt(_) => (Level::Sum, Level::Sum, " < ", Level::Sum),
                BinOp::Gt(_) => (Level::Sum, Level::Sum, " > ", Level::Sum),
                BinOp::Le(_) => (Level::Sum, Level::Sum, " <= ", Level::Sum),
                BinOp::Ge(_) => (Level::Sum, Level::Sum, " >= ", Level::Sum),
                BinOp::Ne(_) => (Level::Sum, Level::Sum, " != ", Level::Sum),
                _ => return None,
            };
            let right = formula(&binary.right, right)?;
            match formula(&binary.left, Level::Sum)? {
                // −a b is (−a) b.
                first if first.starts_with('-') && left == Level::Product && is_negated(&binary.left) => {
                    (Level::Sum, format!("{first}{sign}{right}"))
                }
                _ => (level, format!("{}{sign}{right}", formula(&binary.left, left)?)),
            }
        }
        Expr::MethodCall(call) => method(call)?,
        Expr::Index(entry) => {
            let [list, index] = [&entry.expr, &entry.index].map(|part| formula(part, Level::Sum));
            (Level::Atom, format!("{}[{}]", list?, index?))
        }
        Expr::Call(call) => (Level::Atom, function(call)?),
        _ => return None,
    };
    Some(if level < least { format!("({text})") } else { text })
}

/// True if the first factor of a product has a sign.
fn is_negated(expression: &Expr) -> bool {
    match expression {
        Expr::Unary(_) => true,
        Expr::Binary(binary) => {
            matches!(binary.op, BinOp::Mul(_) | BinOp::Div(_)) && is_negated(&binary.left)
        }
        _ => false,
    }
}

fn is_left_out(expression: &Expr) -> bool {
    matches!(expression, Expr::Path(path) if path.path.is_ident(LEFT_OUT))
}

/// The digits and the suffix of a number.
pub(crate) fn digits(literal: &Lit) -> Option<(&str, &str)> {
    match literal {
        Lit::Int(number) => Some((number.base10_digits(), number.suffix())),
        Lit::Float(number) => Some((number.base10_digits(), number.suffix())),
        _ => None,
    }
}

/// A number without the decimal point that Rust requires.
fn number(literal: &Lit) -> Option<String> {
    let (digits, _) = digits(literal)?;
    Some(digits.strip_suffix(".0").unwrap_or(digits).to_owned())
}

/// `x.ln()` as `ln(x)`, `x.powi(2)` as `x^2`.
fn method(call: &ExprMethodCall) -> Option<(Level, String)> {
    let name = call.method.to_string();
    let base = |least| formula(&call.receiver, least);
    Some(match (name.as_str(), call.args.first()) {
        ("powi" | "powf", Some(exponent)) => {
            (Level::Power, format!("{}^{}", base(Level::Atom)?, formula(exponent, Level::Atom)?))
        }
        ("log", Some(of)) => {
            (Level::Product, format!("ln({})/ln({})", base(Level::Sum)?, formula(of, Level::Sum)?))
        }
        ("recip", None) => (Level::Product, format!("1/{}", base(Level::Power)?)),
        (_, None) => (Level::Atom, format!("{name}({})", base(Level::Sum)?)),
        _ => return None,
    })
}

/// The call of a function: a sum, a condition of the attribute, or any other.
fn function(call: &ExprCall) -> Option<String> {
    let Expr::Path(path) = &*call.func else { return None };
    let name = path.path.get_ident()?.to_string();
    if let (true, Some(Expr::Closure(sum))) = (name == "sum", call.args.first()) {
        let index = sum.inputs.first().filter(|_| sum.inputs.len() == 1)?.to_token_stream();
        return Some(format!("sum({index}, {})", formula(&sum.body, Level::Sum)?));
    }
    let arguments: Vec<_> = call.args.iter().map(|part| formula(part, Level::Sum)).collect::<Option<_>>()?;
    let arguments = arguments.join(", ");
    Some(match name.as_str() {
        "domain" | "admissible" => format!("where {arguments}"),
        name => format!("{name}({arguments})"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(message: &str, expected: &str) {
        assert_eq!(Notation::Formula { free_rest: None }.message(message), expected);
        assert_eq!(Notation::Attribute.message(message), message);
        assert_eq!(Notation::Rust.message(message), message);
    }

    #[test]
    fn code_in_messages_is_that_of_formulas() {
        check("write `J.powi(2)`, or `J.powi(-2)`", "write `J^2`, or `J^(-2)`");
        check("append `- mu * x.exp() * J.ln()`", "append `- mu*exp(x)*ln(J)`");
        check("append `+ (a - b) * (J - 1.0)`", "append `+ (a - b)*(J - 1)`");
        check("declare `domain(J > 0.0, I1 < 3.0 + Jm)`", "declare `where J > 0, I1 < 3 + Jm`");
        check("`sum(|p| mu[p] * l1.powf(alpha[p] - 2.0)) / 3.0`", "`sum(p, mu[p]*l1^(alpha[p] - 2))/3`");
        check("write `sum(|p| … mu[p] …)`", "write `sum(p, … mu[p] …)`");
        check("write `x * (…)`", "write `x*(…)`");
        check("`(2.0 * mu / (a * b)).sqrt().powi(2)`", "`sqrt(2*mu/(a*b))^2`");
        check("`-(l1 + l2).powi(2) - -a`", "`-(l1 + l2)^2 - (-a)`");
        check("`-mu / 2.0 * nu - (-mu + nu) * 2.0`", "`-mu/2*nu - (-mu + nu)*2`");
        check("`a / (b / c) * 1e-300`", "`a/(b/c)*1e-300`");
        check("`(J.powi(2)).powf(n)`", "`(J^2)^n`");
        check("did you mean `.ln()`? write `.powi(2)`", "did you mean `ln`? write `x^2`");
        check("`r#type` and `λ` ` alone", "`type` and `λ` ` alone");
    }
}
