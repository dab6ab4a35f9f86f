//! Taylor polynomials in three stretches, and those of functions of one variable.
//!
//! A derivative is a coefficient times a factorial, and the rules are those of polynomials alone: add,
//! multiply, and put one into another.

use std::ops::{Add, Mul};
use std::sync::LazyLock;

use piola::Real;

/// The monomials up to degree 3, in the order of the coefficients; the first [`QUADRATIC`] have degree 2 at
/// most. The digits are the exponents of the stretches, so that a product of monomials is a sum.
const MONOMIALS: [u32; CUBIC] = [
    0x000, 0x100, 0x010, 0x001, 0x200, 0x020, 0x002, 0x110, 0x101, 0x011, 0x300, 0x030, 0x003, 0x210, 0x201,
    0x120, 0x021, 0x102, 0x012, 0x111,
];

/// Number of coefficients of a polynomial of degree 2.
pub const QUADRATIC: usize = 10;

/// Number of coefficients of a polynomial of degree 3.
pub const CUBIC: usize = 20;

/// Products of monomials: the places of both factors and of the product, by the last one.
static PRODUCTS: LazyLock<Vec<[usize; 3]>> = LazyLock::new(|| {
    let pairs = (0..CUBIC).flat_map(|a| (0..CUBIC).map(move |b| [a, b]));
    let product = |[a, b]: [usize; 2]| Some([a, b, place(MONOMIALS[a] + MONOMIALS[b])?]);
    let mut all: Vec<_> = pairs.filter_map(product).collect();
    all.sort_by_key(|[a, b, product]| (*product, *a, *b));
    all
});

fn place(monomial: u32) -> Option<usize> {
    MONOMIALS.iter().position(|other| *other == monomial)
}

/// A polynomial in changes of the three stretches, cut off after degree 2 or 3, by its coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Polynomial<R, const N: usize>(pub [R; N]);

impl<R: Real, const N: usize> Polynomial<R, N> {
    /// A constant.
    pub fn constant(value: R) -> Self {
        Self(std::array::from_fn(|k| if k == 0 { value } else { R::splat(0.0) }))
    }

    /// A stretch: its value, and one for its change.
    pub fn stretch(k: usize, value: R) -> Self {
        let mut stretch = Self::constant(value);
        stretch.0[1 + k] = R::splat(1.0);
        stretch
    }

    /// φ of the polynomial, from the coefficients φ⁽ᵏ⁾/k! of φ at its constant part.
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
    pub fn derivative(&self, by: &[usize]) -> R {
        let monomial: u32 = by.iter().map(|&k| MONOMIALS[1 + k]).sum();
        let factorials = [8, 4, 0].map(|digit| (1..=monomial >> digit & 0xf).product::<u32>());
        let factor = R::splat(f64::from(factorials.into_iter().product::<u32>()));
        place(monomial).map_or(R::splat(0.0), |k| self.0[k] * factor)
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
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$Function => stringify!($method),)*
                }
            }

            /// φ at x.
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
    pub fn taylor<R: Real>(self, x: R) -> [R; 4] {
        let n = R::splat;
        let (one, square) = (n(1.0), x * x);
        let [first, second, third] = match self {
            Self::Sqrt => return binomial_series(x.sqrt(), x, n(0.5)),
            Self::Cbrt => return binomial_series(x.cbrt(), x, one / n(3.0)),
            Self::Ln | Self::Ln1p => {
                let r = one / if self == Self::Ln { x } else { one + x };
                [r, -r * r, n(2.0) * r * r * r]
            }
            Self::Exp | Self::ExpM1 => [x.exp(); 3],
            Self::Sinh | Self::Cosh => {
                let (s, c) = (x.sinh(), x.cosh());
                if self == Self::Sinh { [c, s, c] } else { [s, c, s] }
            }
            Self::Tanh => {
                let q = (n(-2.0) * x.abs()).exp();
                let slope = n(4.0) * q / ((one + q) * (one + q));
                [slope, n(-2.0) * x.tanh() * slope, slope * (n(4.0) - n(6.0) * slope)]
            }
            Self::Sigmoid => {
                let (slope, bend) = sigmoid_slopes(x);
                [slope, bend, slope * (one - n(6.0) * slope)]
            }
            Self::Softplus => {
                let (slope, bend) = sigmoid_slopes(x);
                [x.sigmoid(), slope, bend]
            }
            Self::Asinh => {
                let w = one / (one + square).sqrt();
                let cube = w * w * w;
                [w, -x * cube, (n(2.0) * square - one) * cube * w * w]
            }
            Self::Atan => {
                let v = one / (one + square);
                [v, n(-2.0) * x * v * v, (n(6.0) * square - n(2.0)) * v * v * v]
            }
            Self::Erf => {
                let slope = (-square).exp() / one.atan().sqrt();
                [slope, n(-2.0) * x * slope, (n(4.0) * square - n(2.0)) * slope]
            }
            Self::Sin | Self::Cos => {
                let (s, c) = (x.sin(), x.cos());
                if self == Self::Sin { [c, -s, -c] } else { [-s, -c, s] }
            }
        };
        [self.of(x), first, second / n(2.0), third / n(6.0)]
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
pub fn real_power<R: Real>(x: R, exponent: R) -> [R; 4] {
    binomial_series(x.powf(exponent), x, exponent)
}

fn binomial_series<R: Real>(power: R, x: R, exponent: R) -> [R; 4] {
    let reciprocal = R::splat(1.0) / x;
    let mut coefficients = [power; 4];
    for k in 1..4 {
        let before = exponent - R::splat(f64::from(k as u8) - 1.0);
        coefficients[k] = coefficients[k - 1] * before * reciprocal / R::splat(f64::from(k as u8));
    }
    coefficients
}

/// xⁿ, and its derivatives over factorials, for a whole exponent n.
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
