//! The spellings that formulas may have: one table, which the parser reads and `docs/formulas.md` prints.
//!
//! A name with a value is a parameter in any spelling; the table has all other names.

use Meaning::{Function, Name, OfTensors, Power};

/// Meaning of a name.
#[derive(Clone, Copy)]
pub(super) enum Meaning {
    /// An expression in Rust. Its spellings may have underscores anywhere: `I_1` is `I1`.
    Name(&'static str),
    /// A function of one argument: its method.
    Function(&'static str),
    /// A function of two arguments: the first to the power of the second.
    Power,
    /// A function of tensors.
    OfTensors(Invariant),
}

/// All names that are not parameters: their meaning, its words for the documentation, and their spellings.
const SPELLINGS: [(Meaning, &str, &str); 34] = [
    (Name("l1"), "principal stretch λ1", "l1 λ1 lambda1 lam1 lmbda1"),
    (Name("l2"), "principal stretch λ2", "l2 λ2 lambda2 lam2 lmbda2"),
    (Name("l3"), "principal stretch λ3", "l3 λ3 lambda3 lam3 lmbda3"),
    (Name("J"), "J = λ1λ2λ3", "J detF"),
    (Name("I1"), "I1 = Σλ²", "I1 trC IC Ic I1C"),
    (Name("I2"), "I2 = λ1²λ2² + λ2²λ3² + λ3²λ1²", "I2 I2C"),
    (Name("I1b"), "J^(−2/3) I1", "I1b I1bar Ibar1 barI1 Ib1 I1iso Ī1 I\u{304}1 I\u{305}1"),
    (Name("I2b"), "J^(−4/3) I2", "I2b I2bar Ibar2 barI2 Ib2 I2iso Ī2 I\u{304}2 I\u{305}2"),
    (Name("(l1 / J.cbrt())"), "J^(−1/3) λ1", "l1bar lambdabar1 lambda1bar λbar1 λ\u{304}1 λ\u{305}1"),
    (Name("(l2 / J.cbrt())"), "J^(−1/3) λ2", "l2bar lambdabar2 lambda2bar λbar2 λ\u{304}2 λ\u{305}2"),
    (Name("(l3 / J.cbrt())"), "J^(−1/3) λ3", "l3bar lambdabar3 lambda3bar λbar3 λ\u{304}3 λ\u{305}3"),
    (Name("(J.ln())"), "ln(J)", "lnJ logJ"),
    (Name("PI"), "π", "pi π PI Pi"),
    (Function("ln"), "natural logarithm", "ln log Log"),
    (Function("log10"), "decimal logarithm", "log10"),
    (Function("exp"), "exponential", "exp Exp"),
    (Function("sqrt"), "square root", "sqrt Sqrt"),
    (Function("cbrt"), "cube root", "cbrt"),
    (Function("sinh"), "hyperbolic sine", "sinh Sinh"),
    (Function("cosh"), "hyperbolic cosine", "cosh Cosh"),
    (Function("tanh"), "hyperbolic tangent", "tanh Tanh"),
    (Function("asinh"), "inverse hyperbolic sine", "asinh arsinh arcsinh ArcSinh"),
    (Function("sin"), "sine", "sin Sin"),
    (Function("cos"), "cosine", "cos Cos"),
    (Function("atan"), "arc tangent", "atan arctan arctg ArcTan"),
    (Function("erf"), "error function", "erf Erf"),
    (Function("ln_1p"), "ln(1 + x)", "ln_1p ln1p log1p"),
    (Function("exp_m1"), "exp(x) − 1", "exp_m1 expm1"),
    (Function("softplus"), "ln(1 + exp(x))", "softplus"),
    (Function("sigmoid"), "1/(1 + exp(−x))", "sigmoid logistic expit"),
    (Power, "power", "pow power Power"),
    (
        OfTensors(Invariant::Trace),
        "trace of a tensor: `tr(C)` is I1; `tr(E)^2` and `tr(E^2)` are accepted",
        "tr trace Tr",
    ),
    (OfTensors(Invariant::Determinant), "determinant: `det(F)` is J, `det(C)` is J²", "det Det"),
    (OfTensors(Invariant::Product), "product A : B of tensors: `inner(E, E)` is `tr(E^2)`", "inner ddot"),
];

/// The products of F with its transpose that stand for C or b, without spaces.
const RIGHT_AND_LEFT: [&str; 14] = [
    "F^T*F",
    "F^TF",
    "F.T*F",
    "F.T@F",
    "transpose(F)*F",
    "dot(F.T,F)",
    "dot(transpose(F),F)",
    "F.transpose()*F",
    "F*F^T",
    "FF^T",
    "F*F.T",
    "F@F.T",
    "F*transpose(F)",
    "dot(F,F.T)",
];

/// Modules whose name may stand before functions and constants, as in `np.log`, `std::log`.
pub(super) const MODULES: [&str; 14] = [
    "np", "numpy", "jnp", "jax", "math", "cmath", "Math", "std", "sp", "sympy", "ufl", "torch", "tf",
    "special",
];

/// Function from tensors to a number.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Invariant {
    Trace,
    Determinant,
    /// Sum of the products of all entries of two equal tensors, or of two powers of one.
    Product,
}

/// The meaning of a name in a formula.
pub(super) fn meaning(name: &str) -> Option<Meaning> {
    let bare = name.replace('_', "");
    let is_meant = |&&(meaning, _, spellings): &&(Meaning, &str, &str)| {
        let name = if let Name(_) = meaning { bare.as_str() } else { name };
        spellings.split(' ').any(|spelling| spelling == name)
    };
    SPELLINGS.iter().find(is_meant).map(|&(meaning, ..)| meaning)
}

/// The name that stands for each stretch in the sums of traces.
const EACH: &str = "each";

/// A tensor with stretches for principal values, or functions of them.
#[derive(Clone, Copy, PartialEq)]
enum Tensor {
    /// C and b.
    CauchyGreen,
    /// U and V.
    Stretch,
    /// E.
    Green,
    /// F.
    Gradient,
}

/// The Rust for an invariant of tensors, given as text without spaces, or advice.
pub(super) fn of_tensors(
    invariant: Invariant,
    text: &str,
    is_given: impl Fn(&str) -> bool,
) -> Result<String, &'static str> {
    const KNOWN: &str = "the tensors of a formula are `C` and `b`, `U` and `V`, `E`, their powers and inverses, and \
                         `F` in `det(F)`, `tr(F^T*F)` and `inner(F, F)`";
    let read = |text: &str| tensor(text, &is_given).ok_or(KNOWN);
    if invariant == Invariant::Product {
        let (one, other) =
            text.split_once(',').ok_or("a product of tensors has two of them, as in `inner(E, E)`")?;
        let ((one, n), (other, m)) = (read(one)?, read(other)?);
        return match one {
            _ if one != other => Err("both tensors of a product are powers of one, as in `inner(E, E)`"),
            Tensor::Gradient if (n, m) == (1, 1) => Ok(trace(Tensor::CauchyGreen, 1)),
            Tensor::Gradient => Err(KNOWN),
            tensor => Ok(trace(tensor, n + m)),
        };
    }
    match (invariant, read(text)?) {
        (Invariant::Determinant, (Tensor::Gradient | Tensor::Stretch, 1)) => Ok("J".to_owned()),
        (Invariant::Determinant, (Tensor::Gradient | Tensor::Stretch, n)) => Ok(format!("J.powi({n})")),
        (Invariant::Determinant, (Tensor::CauchyGreen, n)) => Ok(format!("J.powi({})", 2 * n)),
        (Invariant::Determinant, (Tensor::Green, _)) => {
            Err("write out the product of the principal values of E, `(l1^2 - 1)/2` and so on")
        }
        (_, (Tensor::Gradient, _)) => Err(
            "the trace of F changes with rotations: `tr(C)` is that of FᵀF, `tr(U)` the sum of the stretches",
        ),
        (_, (tensor, n)) => Ok(trace(tensor, n)),
    }
}

/// The trace of a power of a tensor.
fn trace(tensor: Tensor, n: i64) -> String {
    match (tensor, n) {
        (Tensor::CauchyGreen, 1) => "I1".to_owned(),
        (Tensor::CauchyGreen, -1) => "(I2 / J.powi(2))".to_owned(),
        (Tensor::CauchyGreen, n) => format!("sum(|{EACH}| {EACH}.powi({}))", 2 * n),
        (Tensor::Green, 1) => "((I1 - 3.0) / 2.0)".to_owned(),
        (Tensor::Green, n) => format!("sum(|{EACH}| (({EACH}.powi(2) - 1.0) / 2.0).powi({n}))"),
        (_, n) => format!("sum(|{EACH}| {EACH}.powi({n}))"),
    }
}

/// The tensor that a text without spaces is a power of, and the exponent.
fn tensor(text: &str, is_given: &impl Fn(&str) -> bool) -> Option<(Tensor, i64)> {
    /// Longer than any tensor, and nested no deeper than texts may be.
    const LONGEST: usize = 40;
    if text.len() > LONGEST {
        return None;
    }
    let inner = |text: &str, function: &str| {
        let inside = text.strip_prefix(function)?.strip_prefix('(')?.strip_suffix(')')?;
        let mut depth = 0;
        let closes = inside.chars().any(|c| {
            depth += i32::from(c == '(') - i32::from(c == ')');
            depth < 0
        });
        (!closes).then(|| inside.to_owned())
    };
    if RIGHT_AND_LEFT.contains(&text) {
        return (!is_given("F")).then_some((Tensor::CauchyGreen, 1));
    }
    if let Some(inside) = inner(text, "") {
        return tensor(&inside, is_given);
    }
    if let Some(inside) = inner(text, "inv").or_else(|| inner(text, "inverse")) {
        let (tensor, n) = tensor(&inside, is_given)?;
        return Some((tensor, -n));
    }
    if let Some((one, other)) = text.split_once("**").or_else(|| text.split_once('^')) {
        let (tensor, n) = tensor(one, is_given)?;
        let exponent: i64 = other.trim_matches(['(', ')']).parse().ok()?;
        // Beyond, powers of stretches are larger than whole powers may be.
        return (n.abs() * exponent.abs() <= 32).then_some((tensor, n * exponent));
    }
    let product = inner(text, "dot").map(|pair| pair.replacen(',', "*", 1));
    if let Some((one, other)) = product.as_deref().unwrap_or(text).split_once(['*', '@']) {
        let (tensor, n) = tensor(one, is_given).filter(|_| one == other)?;
        return Some((tensor, 2 * n));
    }
    let tensor = match text {
        "C" | "B" | "b" => Tensor::CauchyGreen,
        "U" | "V" => Tensor::Stretch,
        "E" => Tensor::Green,
        "F" => Tensor::Gradient,
        _ => return None,
    };
    (!is_given(text)).then_some((tensor, 1))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// A spelling as code. Barred letters look alike, so that a combining mark is named.
    fn quoted(name: &&str) -> String {
        match name.split_once(|letter| ('\u{300}'..='\u{36f}').contains(&letter)) {
            Some((letter, _)) => {
                let mark = name[letter.len()..].chars().next().map_or(0, u32::from);
                format!("`{name}` ({letter} followed by U+{mark:04X})")
            }
            None => format!("`{name}`"),
        }
    }

    /// The table as Markdown.
    fn table() -> String {
        let code = |names: &[&str]| names.iter().map(quoted).collect::<Vec<_>>().join(", ");
        let mut text = "| spelling | meaning |\n|---|---|\n".to_owned();
        let mut row = |spelling: String, meaning: &str| text += &format!("| {spelling} | {meaning} |\n");
        let all = |spellings: &'static str| code(&spellings.split(' ').collect::<Vec<_>>());
        for (meaning, words, spellings) in SPELLINGS {
            match meaning {
                Function(_) => row(all(spellings), &format!("{words}, a function")),
                Power => {
                    let calls: Vec<_> = spellings.split(' ').map(|name| format!("`{name}(x, n)`")).collect();
                    row(format!("`x^n`, `x**n`, {}", calls.join(", ")), words);
                    row("`.*`, `./`, `.^`".to_owned(), "`*`, `/`, `^`");
                }
                Name(_) | OfTensors(_) => row(all(spellings), words),
            }
        }
        row(code(&RIGHT_AND_LEFT), "the tensor C or b, as an argument of these functions");
        row(
            format!("{}, before `.` or `::`", code(&MODULES)),
            "a module, which is ignored: `np.log(J)` is `log(J)`",
        );
        text
    }

    /// Set `PIOLA_BLESS=1` to write a new table.
    #[test]
    fn the_documentation_has_the_table() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/formulas.md");
        let text = std::fs::read_to_string(&path).expect("the documentation");
        let begin = text.find("| spelling | meaning |").expect("a table");
        let end = begin + text[begin..].find("\n\n").expect("its end") + 1;
        if std::env::var_os("PIOLA_BLESS").is_some() {
            std::fs::write(&path, text[..begin].to_owned() + &table() + &text[end..])
                .expect("the documentation");
        } else {
            assert_eq!(text[begin..end], table());
        }
    }

    #[test]
    fn no_spelling_has_two_meanings() {
        let names = SPELLINGS.into_iter().flat_map(|(.., spellings)| spellings.split(' '));
        let mut all: Vec<_> = names.chain(MODULES).collect();
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}
