//! The attribute `#[piola::material]`: a thin shim over `piola-codegen`, which does all the work.

use proc_macro::TokenStream;

/// Declares an isotropic hyperelastic energy as a function of the principal stretches.
///
/// The function becomes a type of its name that implements `piola::Material` and `piola::material::Declared`,
/// with a checked constructor `new(parameters…)`. The first argument of the function names the three
/// stretches, the others are the parameters: numbers `f64`, lists `[f64; N]` or `Vec<f64>`, whole exponents
/// `u32`, `[u32; N]` or `Vec<u32>`, or functions, whose types implement `piola::Univariate`: types of your
/// own, or `piola::Spline`, which approximates by control points. The body is ordinary Rust:
///
/// * numbers, parameters, stretches, `let` bindings, `+ - * /`, parentheses;
/// * `x.ln()`, `x.exp()`, `x.sqrt()`, `x.cbrt()`, `x.recip()`, `x.powi(2)`, `x.powf(alpha)`, `x.exp_m1()`,
///   `x.ln_1p()`, `x.log10()`, `x.log2()`, `x.log(base)`, `x.sinh()`, `x.cosh()`, `x.tanh()`, `x.asinh()`,
///   `x.sin()`, `x.cos()`, `x.atan()`, `x.erf()`, `x.softplus()` for ln(1 + eˣ) and `x.sigmoid()` for 1/(1 +
///   e⁻ˣ);
/// * `x.powi(n)` and `x.powi(n[p])` of whole exponents, from 0 to 64, which are data: Rivlin's series is
///   `sum(|p| c[p] * (I1b - 3.0).powi(i[p]) * (I2b - 3.0).powi(j[p]))`;
/// * `f(l1)` of a parameter that is a function; the energy is defined if each of its functions is
///   (`Univariate::admits`);
/// * `sum(|p| …)` over the entries of the lists that occur in it as `mu[p]`; `sum(|l| …)`, where `l` is read
///   as a number, over the three stretches; `sum(|a, b| …)` over their three pairs;
/// * `PI`, and constants such as `std::f64::consts::LN_2`;
/// * the words `J` = λ1 λ2 λ3, `I1` = Σ λ², `I2` = λ1²λ2² + λ2²λ3² + λ3²λ1², `I1b` = J^(−2/3) I1 and
///   `I2b` = J^(−4/3) I2.
///
/// The lists of one sum have one length: a number, `N` with `const N: usize`, or, for vectors, a length known
/// at run time, which `new` checks. A material with a vector, a whole exponent or a function is `Clone`,
/// others are `Copy`.
///
/// Names may be those of the paper, such as `K`, `C10` or `β`: none of them needs an `allow` on its case.
/// Where a crate's only Greek letters look like Latin ones, as β and α do, the compiler warns by
/// `mixed_script_confusables`; calling the stretches `[λ1, λ2, λ3]` is enough for it.
///
/// Parentheses, blocks, signs and calls may be nested 64 deep; a sum may have thousands of terms.
///
/// A logarithm, a denominator or a real power of an expression that vanishes inside the domain is refused if
/// it vanishes at a usual deformation, and so is a real power of one that vanishes at rest, such as `J -
/// 1.0`: it is negative nearby. Powers of I1b − 3 are accepted, and so are those of I2b − 3 and of
/// combinations such as (1 − β) I1b + β I2b − 3: among these `(I1b - 3.0).powf(n)` has a finite stiffness at
/// rest for n > 1, and they keep their digits there. They are not continued beyond J > 0.
///
/// The documentation of a parameter may end with its unit, as in `/// Shear modulus, Pa.` or `/// Exponent,
/// dimensionless.`: the energy must then be in Pa. Units are `Pa`, `1/Pa` and `dimensionless`; for a
/// function, the unit of its values. Another unit of stress, such as `MPa`, is an error. Without units
/// nothing is checked.
///
/// Arguments of the attribute, all optional:
///
/// * `domain(J > 0.0, …)`: domain of the energy; every deformation if absent. Stretches come in order, `l1`
///   being the largest: a limit of all of them is one of `l1`. `J != 0.0` excludes only flat elements:
///   inverted ones then have an energy like upright ones, and no stress in the mirror image of rest if the
///   energy is even in J;
/// * `admissible(mu > 0.0, alpha[p] != 0.0, …)`: conditions that `new` checks, in addition to finite numbers
///   and a stable rest state;
/// * `extend` or `extend(mu[p] * alpha[p] > 0.0, …)`: the energy can be continued beyond `J > 0`, under these
///   conditions;
/// * `refuse("why")`: the energy cannot be continued;
/// * `typical("natural rubber", mu = 4e5, alpha = [1.3, 5.0])`: parameters of some real material, for
///   documentation and programs;
/// * `prestressed`: stress at rest is intended;
/// * `serde`: the type implements `serde::Serialize` and `serde::Deserialize` (feature `serde` of `piola`),
///   as its parameters, which are checked when they are read; functions among them must implement both as
///   well.
///
/// A mistaken declaration gives one message for each mistake, on its tokens, and none where the material is
/// used.
#[proc_macro_attribute]
pub fn material(arguments: TokenStream, item: TokenStream) -> TokenStream {
    piola_codegen::expand(arguments.into(), item.into()).into()
}
