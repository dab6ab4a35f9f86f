//! Energies of papers that the catalogue does not have.
//!
//! Where a paper's solid is incompressible, a term of volume is added. A function that a paper gives by a
//! derivative or an integral is a spline here: its numbers are arbitrary.

/// Rubber as a gas of chains [Kilian, *Equation of state of real networks*, Polymer 22, 1981].
//@ values 4e5, 10.0, 0.3, 0.2, 2e7
#[material(
    domain(J > 0.0, (1.0 - beta) * I1b + beta * I2b < lambda_m.powi(2)),
    admissible(lambda_m.powi(2) > 3.0, beta >= 0.0, beta <= 1.0)
)]
fn VanDerWaals([l1, l2, l3]: [f64; 3], mu: f64, lambda_m: f64, a: f64, beta: f64, kappa: f64) -> f64 {
    let limit = lambda_m.powi(2) - 3.0;
    let strain = (1.0 - beta) * I1b + beta * I2b - 3.0;
    let near = strain.powf(0.5) / limit.sqrt();
    let chains = -limit * ((1.0 - near).ln() + near);
    mu * (chains - 2.0 / 3.0 * a * (strain / 2.0).powf(1.5)) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// A constitutive relation for rubberlike materials [Alexander, Int. J. Eng. Sci. 6, 1968]; its
/// integral of exp(k (I1 − 3)²) is a spline.
//@ values [1.0, 1e5, 3.0, 1e5, 10.0, 1.4e5, 40.0, 9e5], 2e5, 0.7, 1e4, 2e7
#[material(domain(J > 0.0), admissible(gamma > 0.0))]
fn Alexander([l1, l2, l3]: [f64; 3], f: Spline, c2: f64, gamma: f64, c3: f64, kappa: f64) -> f64 {
    let y = I2b - 3.0;
    f(I1b) + c2 * (1.0 + y / gamma).ln() + c3 * y + kappa / 2.0 * (J - 1.0).powi(2)
}

/// A sum over the stretches [Shariff, *Strain energy function for filled and unfilled rubberlike
/// material*, Rubber Chem. Technol. 73, 2000].
//@ values [0.1, -4e5, 0.5, -1.5e5, 1.0, 0.0, 2.0, 1.2e5, 5.0, 4e5], 2e7
#[material(domain(J > 0.0))]
fn Shariff([l1, l2, l3]: [f64; 3], phi: Spline, kappa: f64) -> f64 {
    sum(|l| phi(l / J.cbrt())) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// A function of each invariant [Lambert-Diani, Rey, *New phenomenological behavior laws for rubbers
/// and thermoplastic elastomers*, Eur. J. Mech. A 18, 1999].
//@ values [1.0, 2e5, 3.0, 1.8e5, 10.0, 1.6e5, 50.0, 5e5], [1.0, 3e4, 3.0, 2e4, 20.0, 4e3], 2e7
#[material(domain(J > 0.0))]
fn DianiRey([l1, l2, l3]: [f64; 3], f: Spline, g: Spline, kappa: f64) -> f64 {
    f(I1b) + g(I2b) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}

/// A real power of the first invariant [Yamashita, Kawabata, *Approximated form of the strain
/// energy-density function of carbon-black filled rubbers*, Int. Polym. Sci. Technol. 20, 1993].
//@ values 2e5, 3e4, 5e3, 0.6, 2e7
#[material(domain(J > 0.0), admissible(n > 0.0))]
fn YamashitaKawabata([l1, l2, l3]: [f64; 3], C1: f64, C2: f64, C3: f64, n: f64, kappa: f64) -> f64 {
    let shape = C1 * (I1b - 3.0) + C2 * (I2b - 3.0) + C3 / (n + 1.0) * (I1b - 3.0).powf(n + 1.0);
    shape + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Filled rubber [Gregory, *The stress/strain behaviour of filled rubbers at moderate strains*,
/// Plast. Rubber Mater. Appl. 4, 1979].
//@ values 2e5, 1e4, 0.1, 1.5, 0.5, 1.0, 2e7
#[material(domain(J > 0.0), admissible(C > 0.0, D > 0.0, n < 2.0, m > -2.0))]
fn Gregory([l1, l2, l3]: [f64; 3], A: f64, B: f64, C: f64, D: f64, n: f64, m: f64, kappa: f64) -> f64 {
    let x = I1b - 3.0;
    let soft = A / (2.0 - n) * (x + C * C).powf(1.0 - n / 2.0);
    let stiff = B / (2.0 + m) * (x + D * D).powf(1.0 + m / 2.0);
    soft + stiff + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Neo-Hookean shape with the volume of Simo, Taylor [*Penalty function formulations for
/// incompressible nonlinear elastostatics*, Comput. Methods Appl. Mech. Eng. 35, 1982].
#[material(domain(J > 0.0), extend(mu > 0.0, kappa > 0.0), typical("arbitrary", mu = 4e5, kappa = 2e6))]
fn SimoTaylor([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu / 2.0 * (I1b - 3.0) + kappa / 4.0 * ((J - 1.0).powi(2) + J.ln().powi(2))
}

/// The volume by a hyperbolic cosine [Hartmann, Neff, *Polyconvexity of generalized polynomial-type
/// hyperelastic strain energy functions for near-incompressibility*, Int. J. Solids Struct. 40,
/// 2003, table 4].
//@ values 4e5, 2e6
#[material(domain(J > 0.0))]
fn HyperbolicVolume([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu / 2.0 * (I1b - 3.0) + kappa / 4.0 * ((2.0 * J.ln()).cosh() - 1.0)
}

/// A small network, convex in the invariants [Thakolkaran, Joshi, Zheng, Flaschel, De Lorenzis,
/// Kumar, *NN-EUCLID*, J. Mech. Phys. Solids 169, 2022].
//@ values [2e5, 4e4], [0.7, 0.1], [0.1, 0.6], [-0.3, 0.2], 2e6
#[material(domain(J > 0.0))]
fn InputConvexNetwork(
    [l1, l2, l3]: [f64; 3],
    w: Vec<f64>,
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
    kappa: f64,
) -> f64 {
    let layer = sum(|p| w[p] * (a[p] * (I1b - 3.0) + b[p] * (I2b - 3.0) + c[p]).softplus());
    layer + kappa / 2.0 * (J - 1.0).powi(2)
}

/// A constitutive artificial neural network [Linka, Kuhl, *A new family of constitutive artificial
/// neural networks*, Comput. Methods Appl. Mech. Eng. 403, 2023, eq. 36].
//@ values 1e5, 2e4, 1e3, 5e2, 3e4, 1e4, 2e3, 1e2, 0.2, 0.01, 0.1, 0.005, 2e7
#[material(domain(J > 0.0))]
fn ConstitutiveNetwork(
    [l1, l2, l3]: [f64; 3],
    w1: f64,
    w2: f64,
    w3: f64,
    w4: f64,
    w5: f64,
    w6: f64,
    w7: f64,
    w8: f64,
    v2: f64,
    v4: f64,
    v6: f64,
    v8: f64,
    kappa: f64,
) -> f64 {
    let x = I1b - 3.0;
    let y = I2b - 3.0;
    let first = w1 * x + w2 * (v2 * x).exp_m1() + w3 * x.powi(2) + w4 * (v4 * x.powi(2)).exp_m1();
    let second = w5 * y + w6 * (v6 * y).exp_m1() + w7 * y.powi(2) + w8 * (v8 * y.powi(2)).exp_m1();
    first + second + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Averages over a network [Khiêm, Itskov, *Analytical network-averaging of the tube model*, J.
/// Mech. Phys. Solids 95, 2016].
//@ values 1e5, 40.0, 1.1, 3e5, 2e7
#[material(domain(J > 0.0, (I1b / 3.0).powf(q / 2.0) < k.sqrt()), admissible(k > 4.0, q > 0.0))]
fn KhiemItskov([l1, l2, l3]: [f64; 3], mu_c: f64, k: f64, q: f64, mu_t: f64, kappa: f64) -> f64 {
    let at_rest = PI / k.sqrt();
    let stretch = (I1b / 3.0).powf(q / 2.0);
    let chains = mu_c * k * (at_rest.sin() * stretch / (at_rest * stretch).sin()).ln();
    chains + mu_t * ((I2b / 3.0).sqrt() - 1.0) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// The eight-chain solid with the inverse Langevin function of Cohen [*A Padé approximant to the
/// inverse Langevin function*, Rheol. Acta 30, 1991].
//@ values 3e5, 20.0, 2e7
#[material(domain(J > 0.0, I1b < 3.0 * n), admissible(n > 1.0))]
fn EightChainsByCohen([l1, l2, l3]: [f64; 3], mu: f64, n: f64, kappa: f64) -> f64 {
    let square = I1b / (3.0 * n);
    mu * n * (square / 2.0 - (1.0 - square).ln()) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// A spline of each logarithmic strain [Sussman, Bathe, *A model of incompressible isotropic
/// hyperelastic material behavior using spline interpolations of tension–compression test data*,
/// Commun. Numer. Methods Eng. 25, 2009].
// The rule on quotients integrates between two stretches, which is not exact across a knot.
//@ breaks flips and twists keep their digits
//@ values [-2.0, -2e6, -0.5, -4e5, 0.0, 0.0, 0.5, 3e5, 2.0, 4e6], 2e7
#[material(domain(J > 0.0))]
fn SussmanBathe([l1, l2, l3]: [f64; 3], w: Spline, kappa: f64) -> f64 {
    sum(|l| w(l.ln())) + kappa / 2.0 * J.ln().powi(2)
}

/// The elastic part of a clay: stiffer under pressure [Borja, Tamagnini, *Cam-Clay plasticity part
/// III*, Comput. Methods Appl. Mech. Eng. 155, 1998, eq. 2.3].
//@ range 0.85 1.2
//@ values 1e5, 0.02, 2e6, 20.0
#[material(domain(J > 0.0), prestressed, admissible(k > 0.0, p > 0.0))]
fn CamClay([l1, l2, l3]: [f64; 3], p: f64, k: f64, mu: f64, alpha: f64) -> f64 {
    let volume = J.ln();
    let shear = sum(|a, b| (a / b).ln().powi(2)) * 2.0 / 9.0;
    let pressed = (-volume / k).exp();
    p * k * pressed + 3.0 / 2.0 * (mu + alpha * p * pressed) * shear
}

/// Stiffer in compression than in tension [Ambartsumyan, *The axisymmetric problem of a circular
/// cylindrical shell made of materials with different stiffness in tension and compression*, 1965],
/// by a spline with a bend at rest.
//@ values [0.2, -8e5, 0.9, -1e5, 1.0, 0.0, 1.1, 4e4, 4.0, 1.2e6], 1e6
#[material(domain(J > 0.0))]
fn Bimodular([l1, l2, l3]: [f64; 3], f: Spline, lambda: f64) -> f64 {
    sum(|l| f(l)) + lambda / 2.0 * J.ln().powi(2)
}

/// Terms of both invariants, as many as there are data [Rivlin, *Large elastic deformations of
/// isotropic materials IV*, Phil. Trans. R. Soc. A 241, 1948].
//@ values [2e5, 1e4, -5e2, 3e1], [1, 0, 1, 3], [0, 1, 1, 0], 2e7
#[material(domain(J > 0.0))]
fn Rivlin([l1, l2, l3]: [f64; 3], C: Vec<f64>, i: Vec<u32>, j: Vec<u32>, kappa: f64) -> f64 {
    let shape = sum(|p| C[p] * (I1b - 3.0).powi(i[p]) * (I2b - 3.0).powi(j[p]));
    shape + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Resistance to extension and to its inverse [Gao, *Large deformation field near a crack tip in
/// rubber-like material*, Theor. Appl. Fract. Mech. 26, 1997].
#[material(
    domain(J > 0.0),
    admissible(n > 0.0),
    extend(a > 0.0, n > 1.0),
    typical("arbitrary", a = 2e5, n = 1.4)
)]
fn Gao([l1, l2, l3]: [f64; 3], a: f64, n: f64) -> f64 {
    a * (I1.powf(n) + (I2 / J.powi(2)).powf(n))
}

/// Roots within roots and logarithms of sums, of no paper.
//@ values 4e5, 2e6
#[material(domain(J > 0.0))]
fn NestedRoots([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    let root = (1.0 + (I1b + I2b.sqrt()).sqrt()).ln();
    mu * (I1b / 2.0 + root) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Hooke's law of any strain of the family [Hill, *On constitutive inequalities for simple
/// materials*, J. Mech. Phys. Solids 16, 1968].
//@ values 4e5, 1e6, 0.4
#[material(domain(J > 0.0), admissible(m != 0.0))]
fn SethHill([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64, m: f64) -> f64 {
    let squares = sum(|l| ((l.powf(2.0 * m) - 1.0) / (2.0 * m)).powi(2));
    let trace = sum(|l| (l.powf(2.0 * m) - 1.0) / (2.0 * m));
    mu * squares + lambda / 2.0 * trace.powi(2)
}

/// A modulus that saturates by a hyperbolic tangent and an arctangent, of no paper.
//@ values 4e5, 3.0, 2e6
#[material(domain(J > 0.0))]
fn Saturating([l1, l2, l3]: [f64; 3], mu: f64, c: f64, kappa: f64) -> f64 {
    let x = (I1b - 3.0) / c;
    mu * c / 2.0 * (x + 0.5 * x.tanh() + 0.25 * x.atan()) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// A volume that a drawn barrier keeps from vanishing [Li et al., *Incremental potential contact*,
/// ACM Trans. Graph. 39, 2020, has such barriers of distances].
//@ values 4e5, [0.0, -9e6, 0.2, -2e6, 0.6, -2e5, 1.0, 0.0, 2.0, 1e6]
#[material(domain(J > 0.0))]
fn Barrier([l1, l2, l3]: [f64; 3], mu: f64, b: Spline) -> f64 {
    mu / 2.0 * (I1b - 3.0) + b(J)
}
