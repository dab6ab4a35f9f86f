//! Conditions on parameters as data, which constructors check.

use quote::ToTokens;
use syn::{BinOp, Expr, UnOp};

use super::condition_text;
use crate::read::notation::digits;
use crate::read::parse::{Declaration, identifiers, indexed_list};
use crate::read::resolve::constant;

/// A comparison, such as `mu[p] * alpha[p] > 0.0`, with its sides in some form.
#[derive(Debug)]
pub struct Condition<T> {
    /// The comparison in the usual notation.
    pub text: String,
    /// Both sides.
    pub sides: [T; 2],
    /// `>`, `<`, `>=`, `<=` or `!=`.
    pub comparison: &'static str,
    /// A list by whose entries it is written, by its place in the declaration.
    pub list: Option<usize>,
    /// The parameters that it names, by their places in the declaration.
    pub names: Vec<usize>,
}

/// An expression in parameters, and in the current entry of those that are lists; its parts are in some form.
#[derive(Debug)]
pub enum Term<T> {
    /// A number, not negative; NaN for what the resolver rejects.
    Number(f64),
    /// A parameter, by its place in the declaration.
    Parameter(usize),
    /// An operator or a method of `f64`, by its name, and its operands; the receiver is the first.
    Call(String, Vec<T>),
}

impl<T> Condition<T> {
    /// A condition whose sides are put into the form term by term.
    #[must_use]
    pub fn new(declaration: &Declaration, condition: &Expr, form: &dyn Fn(Term<T>) -> T) -> Self {
        // The parser lets nothing but comparisons through; NaN holds in none.
        let (comparison, sides) = match condition {
            Expr::Binary(binary) => {
                let comparison = match binary.op {
                    BinOp::Gt(_) => ">",
                    BinOp::Lt(_) => "<",
                    BinOp::Ge(_) => ">=",
                    BinOp::Le(_) => "<=",
                    _ => "!=",
                };
                (comparison, [&*binary.left, &*binary.right].map(|side| term(declaration, side, form)))
            }
            _ => (">", [f64::NAN; 2].map(|nan| form(Term::Number(nan)))),
        };
        Self {
            text: condition_text(condition),
            sides,
            comparison,
            list: indexed_list(condition).and_then(|(list, _)| declaration.place(&list)),
            names: named(declaration, condition),
        }
    }
}

/// The places of the parameters that a condition names.
#[must_use]
pub fn named(declaration: &Declaration, condition: &Expr) -> Vec<usize> {
    let names = identifiers(condition.to_token_stream());
    (0..declaration.parameters.len()).filter(|&k| names.contains(&declaration.parameters[k].name)).collect()
}

fn term<T>(declaration: &Declaration, expression: &Expr, form: &dyn Fn(Term<T>) -> T) -> T {
    let read = |expression: &Expr| term(declaration, expression, form);
    let call = |name: &str, operands: Vec<T>| Term::Call(name.to_owned(), operands);
    form(match expression {
        Expr::Paren(inner) => return read(&inner.expr),
        Expr::Group(inner) => return read(&inner.expr),
        Expr::Index(entry) => return read(&entry.expr),
        Expr::Lit(number) => {
            let value = digits(&number.lit).and_then(|(digits, _)| digits.parse().ok());
            Term::Number(value.unwrap_or(f64::NAN))
        }
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => call("-", vec![read(&unary.expr)]),
        Expr::Binary(binary) => {
            let operator = binary.op.to_token_stream().to_string();
            call(&operator, vec![read(&binary.left), read(&binary.right)])
        }
        Expr::Path(path) => match path.path.get_ident().and_then(|name| declaration.place(name)) {
            Some(k) => Term::Parameter(k),
            None => Term::Number(constant(&path.path).unwrap_or(f64::NAN)),
        },
        Expr::MethodCall(method) => {
            let operands = std::iter::once(&*method.receiver).chain(&method.args);
            call(&method.method.to_string(), operands.map(read).collect())
        }
        _ => Term::Number(f64::NAN),
    })
}
