//! Taylor polynomials in three stretches, and those of functions of one variable.
//!
//! A derivative is a coefficient times a factorial, and the rules are those of polynomials alone: add,
//! multiply, and put one into another.

use std::ops::{Add, Mul};
use std::sync::LazyLock;

use piola::Real;

/// The monomials up to degree 3, in the order of the coefficients; the first [`QUADRATIC`] have degree 2 at
/// most.
pub const MONOMIALS: [[u8; 3]; 20] = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [2, 0, 0],
    [0, 2, 0],
    [0, 0, 2],
    [1, 1, 0],
    [1, 0, 1],
    [0, 1, 1],
    [3, 0, 0],
    [0, 3, 0],
    [0, 0, 3],
    [2, 1, 0],
    [2, 0, 1],
    [1, 2, 0],
    [0, 2, 1],
    [1, 0, 2],
    [0, 1, 2],
    [1, 1, 1],
];

/// Number of coefficients of a polynomial of degree 2.
pub const QUADRATIC: usize = 10;

/// Number of coefficients of a polynomial of degree 3.
pub const CUBIC: usize = 20;

/// Products of monomials: the places of both factors and of the product, by the last one.
static PRODUCTS: LazyLock<Vec<[usize; 3]>> = LazyLock::new(|| {
    let sum = |a: usize, b: usize| std::array::from_fn(|k| MONOMIALS[a][k] + MONOMIALS[b][k]);
    let pairs = (0..CUBIC).flat_map(|a| (0..CUBIC).map(move |b| (a, b)));
    let mut all: Vec<_> =
        pairs.filter_map(|(a, b)| place(sum(a, b)).map(|product| [a, b, product])).collect();
    all.sort_by_key(|[a, b, product]| (*product, *a, *b));
    all
});

fn place(monomial: [u8; 3]) -> Option<usize> {
    MONOMIALS.iter().position(|other| *other == monomial)
}

/// A polynomial in changes of the three stretches, cut off after degree 2 or 3, by its coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Polynomial<R, const N: usize>(pub [R; N]);

impl<R: Real, const N: usize> Polynomial<R, N> {
    /// A constant.
    #[must_use]
    pub fn constant(value: R) -> Self {
        Self(std::array::from_fn(|k| if k == 0 { value } else { R::splat(0.0) }))
    }

    /// A stretch: its value, and one for its change.
    #[must_use]
    pub fn stretch(k: usize, value: R) -> Self {
        let mut stretch = Self::constant(value);
        stretch.0[1 + k] = R::splat(1.0);
        stretch
    }

    /// φ of the polynomial, from the coefficients φ⁽ᵏ⁾/k! of φ at its constant part.
    #[must_use]
    pub fn compose(self, taylor: [R; 4]) -> Self {
        let mut change = self;
        change.0[0] = R::splat(0.0);
        let highest = if N > QUADRATIC { 3 } else { 2 };
        let mut result = Self::constant(taylor[highest]);
        for k in (0..highest).rev() {
            result = result * change + Self::constant(taylor[k]);
        }
        result
    }

    /// The derivative by the stretches of these numbers.
    #[must_use]
    pub fn derivative(&self, by: &[usize]) -> R {
        let mut monomial = [0; 3];
        by.iter().for_each(|&k| monomial[k] += 1);
        let factorials: u8 = monomial.iter().map(|&n| (1..=n).product::<u8>()).product();
        place(monomial).map_or(R::splat(0.0), |k| self.0[k] * R::splat(f64::from(factorials)))
    }
}

impl<R: Real, const N: usize> Add for Polynomial<R, N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<R: Real, const N: usize> Mul for Polynomial<R, N> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let mut product = Self::constant(R::splat(0.0));
        for &[a, b, k] in PRODUCTS.iter().take_while(|product| product[2] < N) {
            product.0[k] = product.0[k] + self.0[a] * other.0[b];
        }
        product
    }
}

/// Declares functions of [`Real`] by their methods.
macro_rules! functions {
    ($($Function:ident $method:ident,)*) => {
        /// A function of one variable.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[expect(missing_docs, reason = "each is named like the method of `f64`")]
        pub enum Function {
            $($Function,)*
        }

        impl Function {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$Function,)*];

            /// Its name as a method.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$Function => stringify!($method),)*
                }
            }

            /// φ at x.
            #[must_use]
            pub fn of<R: Real>(self, x: R) -> R {
                match self {
                    $(Self::$Function => x.$method(),)*
                }
            }
        }
    };
}

functions! {
    Ln ln, Exp exp, Sqrt sqrt, Cbrt cbrt, Sinh sinh, Cosh cosh, Tanh tanh, Asinh asinh, Sin sin, Cos cos,
    Atan atan, Erf erf, ExpM1 exp_m1, Ln1p ln_1p, Softplus softplus, Sigmoid sigmoid,
}

impl Function {
    /// φ, φ′, φ″/2, φ‴/6 at x.
    #[must_use]
    pub fn taylor<R: Real>(self, x: R) -> [R; 4] {
        let n = R::splat;
        let one = n(1.0);
        let [value, first, second, third] = match self {
            Self::Ln => {
                let r = one / x;
                [x.ln(), r, -r * r, n(2.0) * r * r * r]
            }
            Self::Ln1p => {
                let r = one / (one + x);
                [x.ln_1p(), r, -r * r, n(2.0) * r * r * r]
            }
            Self::Exp => [x.exp(); 4],
            Self::ExpM1 => {
                let e = x.exp();
                [x.exp_m1(), e, e, e]
            }
            Self::Sqrt => {
                let y = x.sqrt();
                let r = one / x;
                [y, n(0.5) * y * r, n(-0.25) * y * r * r, n(0.375) * y * r * r * r]
            }
            Self::Cbrt => {
                let y = x.cbrt();
                let (r, ninth) = (one / x, y / n(9.0));
                [y, n(3.0) * ninth * r, n(-2.0) * ninth * r * r, n(10.0) / n(3.0) * ninth * r * r * r]
            }
            Self::Sinh => {
                let (s, c) = (x.sinh(), x.cosh());
                [s, c, s, c]
            }
            Self::Cosh => {
                let (s, c) = (x.sinh(), x.cosh());
                [c, s, c, s]
            }
            Self::Tanh => {
                let t = x.tanh();
                let q = (n(-2.0) * x.abs()).exp();
                let slope = n(4.0) * q / ((one + q) * (one + q));
                [t, slope, n(-2.0) * t * slope, slope * (n(4.0) - n(6.0) * slope)]
            }
            Self::Sigmoid => {
                let (slope, bend) = sigmoid_slopes(x);
                [x.sigmoid(), slope, bend, slope * (one - n(6.0) * slope)]
            }
            Self::Softplus => {
                let (slope, bend) = sigmoid_slopes(x);
                [x.softplus(), x.sigmoid(), slope, bend]
            }
            Self::Asinh => {
                let square = x * x;
                let w = one / (one + square).sqrt();
                let cube = w * w * w;
                [x.asinh(), w, -x * cube, (n(2.0) * square - one) * cube * w * w]
            }
            Self::Atan => {
                let square = x * x;
                let v = one / (one + square);
                [x.atan(), v, n(-2.0) * x * v * v, (n(6.0) * square - n(2.0)) * v * v * v]
            }
            Self::Erf => {
                let square = x * x;
                let slope = (-square).exp() / one.atan().sqrt();
                [x.erf(), slope, n(-2.0) * x * slope, (n(4.0) * square - n(2.0)) * slope]
            }
            Self::Sin => {
                let (s, c) = (x.sin(), x.cos());
                [s, c, -s, -c]
            }
            Self::Cos => {
                let (s, c) = (x.sin(), x.cos());
                [c, -s, -c, s]
            }
        };
        [value, first, second / n(2.0), third / n(6.0)]
    }
}

/// σ′ and σ″ of the sigmoid.
fn sigmoid_slopes<R: Real>(x: R) -> (R, R) {
    let one = R::splat(1.0);
    let q = (-x.abs()).exp();
    let slope = q / ((one + q) * (one + q));
    (slope, slope * (q - one).copysign(-x) * (one / (one + q)))
}

/// xʳ, and its derivatives over factorials, for a real exponent r and x > 0.
#[must_use]
pub fn real_power<R: Real>(x: R, exponent: R) -> [R; 4] {
    let reciprocal = R::splat(1.0) / x;
    let mut coefficients = [x.powf(exponent); 4];
    for k in 1..4 {
        let before = R::splat(f64::from(k as u8) - 1.0);
        coefficients[k] =
            coefficients[k - 1] * (exponent - before) * reciprocal / R::splat(f64::from(k as u8));
    }
    coefficients
}

/// xⁿ, and its derivatives over factorials, for a whole exponent n.
#[must_use]
pub fn whole_power<R: Real>(x: R, n: i32) -> [R; 4] {
    let one = R::splat(1.0);
    let power = |n: i32| {
        let product = (0..n.abs()).fold(one, |product, _| product * x);
        if n < 0 { one / product } else { product }
    };
    let mut binomial = 1.0;
    std::array::from_fn(|k| {
        let k = k as i32;
        if k > 0 {
            binomial *= f64::from(n - k + 1) / f64::from(k);
        }
        if binomial == 0.0 { R::splat(0.0) } else { R::splat(binomial) * power(n - k) }
    })
}
