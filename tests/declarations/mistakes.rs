//! Mistaken declarations, each with the messages that it gives and the tokens that they stand on.

//@ error domain => `domain` is given twice: remove one
#[material(domain(J > 0.0), domain(J < 10.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error kappa * (l3 - 1.0).powi(2) => an isotropic energy does not change when `l2` and `l3` are
//@   exchanged, but `kappa * (l3 - 1.0).powi(2)` does: write the same for all three stretches
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln()) + kappa * (l3 - 1.0).powi(2)
}

//@ error kappa / 2.0 * (l1 * l2 - 1.0).powi(2) => an isotropic energy does not change when `l2` and `l3`
//@   are exchanged, but `kappa * (l1 * l2 - 1.0).powi(2) / 2.0` does: write the same for all three stretches
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    let shape = mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln());
    let volume = kappa / 2.0 * (l1 * l2 - 1.0).powi(2);
    shape + volume
}

//@ error mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2)) + mu * (l3 - 1.0) => an isotropic energy does not
//@   change when `l2` and `l3` are exchanged, but this does: write the same for all three stretches
#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2)) + mu * (l3 - 1.0)
}

//@ error if => an energy has no branches, at which its derivatives would jump: a domain is declared by
//@   `domain(…)`, and a function with branches is a parameter whose type implements `piola::Univariate`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    if J > 0.5 { mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln()) } else { mu }
}

//@ error > => an energy has no comparisons: conditions stand in `domain(…)` or `admissible(…)`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln()) * (J > 0.5)
}

//@ error mu => a condition is a comparison such as `mu > 0.0`
//@ error l1 => `l1` is not a parameter: conditions on the deformation stand in `domain(…)`
//@ error 0.5 => `powi` takes a whole number: for this one write `.powf(0.5)`
#[material(domain(J > 0.0), admissible(l1 > 0.0, mu.powi(0.5) > 0, mu))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error I1 < 3.0 => this excludes the rest state λ1 = λ2 = λ3 = 1, where every body starts: widen the
//@   domain
#[material(domain(J > 0.0, I1 < 3.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error mu[0] => single entries of a list cannot be used: declare them as parameters of their own, or
//@   write `mu[p]`, inside `sum(|p| …)`
#[material(domain(J > 0.0))]
pub fn Solid<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N]) -> f64 {
    mu[0] / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error refuse => an energy has either `extend` or `refuse`: remove one
#[material(domain(J > 0.0), extend, refuse("not yet"))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error extend => `extend` continues an energy beyond `domain(J > 0.0)`: declare that or remove `extend`
#[material(extend)]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * (J - 1.0))
}

//@ error I1b - 3.0 < jm => `extend` continues the energy beyond J > 0, but where elements are flat, such as
//@   at the stretches 1, 1 and 0, this does not hold: remove `extend`, or bound a quantity that stays
//@   moderate there, such as I1 instead of I1b
#[material(domain(J > 0.0, I1b - 3.0 < jm), extend)]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, jm: f64, kappa: f64) -> f64 {
    kappa / 2 * (J - 1).powi(2) - mu / 2 * jm * (1 - (I1b - 3) / jm).ln()
}

//@ error mu * 1e30 * 1e30 => the exact fraction here leaves 128 bits: use smaller numbers
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu * 1e30 * 1e30 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error f => `f` is declared as a function: write `f(l1)`, or declare `f: f64`
//@ error f(l1, l2) => a function has one argument: write `f(l1)`
#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], f: Spline) -> f64 {
    f + f(l1, l2)
}

//@ error n => the index `n` only selects entries, as in `a[n]`, and is not a number: write the terms out,
//@   each with a parameter and numbers of its own, two terms for `a: [f64; 2]`; a list of numbers in its
//@   place would be parameters too, which a fit changes; whole exponents alone can be data, `x.powi(k[n])`
//@   with `k: [u32; 2]`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], a: [f64; 2], kappa: f64) -> f64 {
    let shape = sum(|n| a[n] / (2 * n) * (l1.powi(2 * n) + l2.powi(2 * n) + l3.powi(2 * n) - 3 - 2 * n * J.ln()));
    shape + kappa / 2 * (J - 1).powi(2)
}

//@ error max => `max` has a kink, at which stress or stiffness would jump: write a smooth function, such as
//@   a power, or a parameter whose type implements `piola::Univariate`
#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu * (l1.max(1.0) - 1.0).powi(2)
}

//@ error alpha => `alpha` has another length than the lists before it in this sum: declare them with the
//@   same
#[material(domain(J > 0.0))]
pub fn Solid<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; 2]) -> f64 {
    sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0))
}

//@ error 'a => only lengths of lists can be generic: write `const N: usize` and a parameter `[f64; N]`
//@ error &'a [f64] => a material owns its lists: write `Vec<f64>`, or `[f64; N]` with `const N: usize`
#[material(domain(J > 0.0))]
pub fn Solid<'a>([l1, l2, l3]: [f64; 3], mu: &'a [f64]) -> f64 {
    sum(|p| mu[p]) * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error 2 / beta / (1 - beta * I1b / 3) => `1.0 - beta * I1b / 3.0` vanishes inside the domain, and there
//@   this has no value: declare `domain(J > 0.0, 1.0 - beta * I1b / 3.0 > 0.0)`, or limit the parameters by
//@   `admissible(…)`
#[material(domain(J > 0.0), admissible(beta > 0.0, beta < 1.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], g: f64, beta: f64, kappa: f64) -> f64 {
    let chains = 2 / beta / (1 - beta * I1b / 3);
    g / 6 * (I1b + chains) + kappa / 2.0 * (J - 1.0).powi(2)
}

//@ error mu => `mu` is a list: write `sum(|p| … mu[p] …)`
#[material(domain(J > 0.0))]
pub fn Solid<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N]) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error len => unknown function `len`: did you mean `.ln()`?
mod solids {
    #[material(domain(J > 0.0))]
    pub(crate) fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
        mu / 2.0 * (I1 - 3.0 - 2.0 * J.len())
    }
}

//@ error [1.0, 2.0] => lists are parameters, as `mu: [f64; N]`: numbers of the energy itself are written
//@   out, term by term
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], a: [f64; 2], kappa: f64) -> f64 {
    let n = [1.0, 2.0];
    let shape = sum(|p| a[p] / n[p] * (l1.powf(n[p]) + l2.powf(n[p]) + l3.powf(n[p]) - 3 - n[p] * J.ln()));
    shape * n[0] + kappa / (n - 1.0) * (J - 1).powi(2)
}

//@ error async => an energy is a plain function: remove this
#[material(domain(J > 0.0))]
pub async fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error mu => the name `mu` is taken already: choose another one
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    let mu = mu / 2.0;
    mu * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error Solid => no parameters were found for which this energy is finite near rest: check its domain and
//@   `admissible(…)`
#[material(domain(J > 0.0), admissible(mu > 0.0, mu < -1.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error Solid => an energy density is a number: write `-> f64` before the body
//@ error ; => the last line of an energy is its value: remove this `;`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln());
}

//@ error mu / 2.0 * (J - 1.0).powi(2) => the shear modulus of this energy is zero at rest: add a term that
//@   resists shear, such as `mu / 2.0 * (I1b - 3.0)`
#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (J - 1.0).powi(2)
}

//@ error 1e400 => this number is not finite in `f64`: write a smaller one
//@ error f64::INFINITY => the numbers of an energy are finite: write one
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln()) + kappa * 1e400 * f64::INFINITY * (J - 1.0).powi(2)
}

//@ error mu => the name `mu` is taken already: choose another one
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error (b * (I1 - 3.0)).powf(n) => the base of `(b * (I1 - 3.0)).powf(n)` vanishes at rest and is
//@   negative nearby, where only whole powers have a value: write `I1b` for `I1`, since `I1b - 3.0` is never
//@   negative, or a whole power, such as `.powi(2)` or `.powi(n)` with `n: u32`, or the power of a base that
//@   stays positive, such as `(1.0 + b * (I1b - 3.0)).powf(n)`
#[material(domain(J > 0.0), admissible(n >= 1.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, b: f64, n: f64, kappa: f64) -> f64 {
    let shape = (b * (I1 - 3.0)).powf(n);
    mu * (I1b - 3.0) + shape + kappa / 2.0 * (J - 1.0).powi(2)
}

//@ error 99999999999999999999 => a whole power is at most 64: for larger ones use `.powf(…)`
#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu * (I1 - 3.0 * (J - 1.0) - 3.0 * J.powi(99999999999999999999))
}

//@ error R => `R` is reserved: choose another name
//@ error J => `J` is reserved: choose another name
//@ error energy => `energy` is reserved: choose another name
#[material(domain(J > 0.0))]
pub fn Solid<const R: usize>([J, l2, l3]: [f64; 3], energy: f64, mu: [f64; R]) -> f64 {
    energy * sum(|p| mu[p]) * (I1 - 3.0)
}

//@ error (I1 - 3.0).sqrt() => the base of `(I1 - 3.0).sqrt()` vanishes at rest and is negative nearby,
//@   where only whole powers have a value: write `I1b` for `I1`, since `I1b - 3.0` is never negative, or a
//@   whole power, such as `.powi(2)`, or the power of a base that stays positive, such as `(1.0 + b * (I1b -
//@   3.0)).powf(n)`
#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu * (I1 - 3.0).sqrt()
}

//@ error mu / 2.0 * (I1 - 3.0) => this leaves the stress `mu` at rest: append `- mu * J.ln()`; or write
//@   `I1b` for `I1`, which leaves none; or add `prestressed` to the attribute (if the paper's solid is
//@   compressible, a factor or a power is mistyped)
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0) + kappa / 2.0 * (J - 1.0).powi(2)
}

//@ error mu * (I1 - 3 + c.powi(2)).powf(n) => this leaves the stress `2.0 * mu * n * c.powi(2).powf(n -
//@   1.0)` at rest: write `I1b` for `I1`, which leaves none and has a value wherever J > 0; or add
//@   `prestressed` to the attribute (if the paper's solid is compressible, a factor or a power is mistyped)
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, c: f64, n: f64, kappa: f64) -> f64 {
    mu * (I1 - 3 + c.powi(2)).powf(n) + kappa / 2 * (J - 1).powi(2)
}

//@ error (I1 - 3 + c.powi(2)).sqrt() => `I1 + c.powi(2) - 3.0` vanishes inside the domain, and there this
//@   has no value: write `I1b` for `I1`, which is at least 3 wherever J > 0
#[material(domain(J > 0.0))]
pub fn Free([l1, l2, l3]: [f64; 3], mu: f64, c: f64, kappa: f64) -> f64 {
    let root = (I1 - 3 + c.powi(2)).sqrt();
    mu * root - mu / c * J.ln() + kappa / 2 * (J - 1).powi(2)
}

//@ error kappa * J.ln() => this leaves the stress `-kappa` at rest: append `+ kappa * (J - 1.0)`, or remove
//@   the term in `J.ln()`; or add `prestressed` to the attribute (if the paper's solid is compressible, a
//@   factor or a power is mistyped)
#[material(domain(J > 0.0))]
pub fn Pulled([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu * ((l1 - 1).powi(2) + (l2 - 1).powi(2) + (l3 - 1).powi(2)) - kappa * J.ln()
}

//@ error c10 * (I1 - 3) + c01 * (I2 - 3).powi(2) + c01 * (I2 - 3) => this leaves the stress `2.0 * c10 +
//@   4.0 * c01` at rest: append `- (2.0 * c10 + 4.0 * c01) * J.ln()` with `domain(J > 0.0)`, or `- (2.0 * c10
//@   + 4.0 * c01) * (J - 1.0)` with any domain; or write `I1b`, `I2b` for `I1`, `I2` with `domain(J > 0.0)`,
//@   which leaves none; or add `prestressed` to the attribute (if the paper's solid is compressible, a factor
//@   or a power is mistyped)
#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], c10: f64, c01: f64, kappa: f64) -> f64 {
    c10 * (I1 - 3) + c01 * (I2 - 3).powi(2) + c01 * (I2 - 3) + kappa / 2 * (J - 1).powi(2)
}

//@ error [l1, l2]: [f64; 2] => the first argument names the three stretches: `[l1, l2, l3]: [f64; 3]`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2]: [f64; 2], mu: f64) -> f64 {
    mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2))
}

//@ error p => this sum does not run over a list: write it without `sum`, or declare a list, `mu: [f64; N]`,
//@   and write `mu[p]` in it
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    sum(|p| mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln()))
}

//@ error T => only lengths of lists can be generic: write `const N: usize` and a parameter `[f64; N]`
#[material(domain(J > 0.0))]
pub fn Solid<T>([l1, l2, l3]: [T; 3], mu: T) -> T {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error domein => unknown argument `domein`: did you mean `domain(J > 0.0)`?
#[material(domein(J > 0.0), admissible(mu > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error log => `log` takes one argument, the base; the natural logarithm is `.ln()`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.log())
}

//@ error M => the length of a list is a number such as `3`, or `N` with `const N: usize`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: [f64; M]) -> f64 {
    sum(|p| mu[p]) / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error my => unknown name `my`: did you mean `mu`?
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    my / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error kappa => `kappa` does not occur in the energy: use it or remove it
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error n => the length of a list is a constant: begin its name with a capital, such as `N`
//@ error None => `None` is reserved: choose another name
//@ error Some => `Some` is reserved: choose another name
//@ error Ok => `Ok` is reserved: choose another name
#[material(domain(J > 0.0))]
pub fn Solid<const n: usize>(
    [None, l2, l3]: [f64; 3],
    Some: f64,
    Ok: [f64; n],
    r#type: f64,
) -> f64 {
    Some * sum(|p| Ok[p]) * r#type * (I1 - 3.0)
}

//@ error l1 != 2.0 => only a volume can be left out of a domain, `J != 0.0`: write others with `<` or `>`
#[material(domain(J > 0.0, l1 != 2.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

//@ error powi => `powi` takes one argument, the exponent
//@ error ln => `ln` takes no argument
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1.powi() - 3.0 - 2.0 * J.ln(10.0))
}

//@ error f32 => a parameter is a number `mu: f64`, a list `mu: [f64; N]` or `mu: Vec<f64>`, a whole
//@   exponent `n: u32` or a function `f: F`, with `F: piola::Univariate`
#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f32) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}
