//! Energies whose small-strain moduli depend on their parameters in different ways.

//@ values 1, 2, 0.1
#[material(domain(J > 0.0))]
fn Differences([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {
    a * (I1b - 3.0) + b / 2.0 * (J - 1.0).powi(2) + (I1b - 3.0).powi(2) * n * n
}

//@ values 1, 2, 0.1
#[material(domain(J > 0.0))]
fn Constants([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {
    (a / 2.0 + 3.0) * (I1 - 3.0 - 2.0 * J.ln()) + b / 2.0 * J.ln().powi(2) + (I1b - 3.0).powi(2) * n * n
}

/// Three parameters.
//@ values 1, 2, 0.1
#[material(domain(J > 0.0))]
fn Three([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {
    (a + n) / 2.0 * (I1 - 3.0 - 2.0 * J.ln()) + b * (J - 1.0).powi(2)
}

/// One parameter.
//@ values 1, 2, 0.1
#[material(domain(J > 0.0))]
fn One([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {
    a * (I1 - 3.0 - 2.0 * J.ln()) + (b + n) * (J - 1.0).powi(4)
}

/// Both in the same proportion.
//@ values 1, 2, 0.1
#[material(domain(J > 0.0))]
fn Proportional([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {
    (a + b) * (I1 - 3.0 - 2.0 * J.ln()) + n * (J - 1.0).powi(4)
}

/// Moduli that are not affine in the parameters.
//@ values 1, 2, 0.1
#[material(domain(J > 0.0))]
fn Product([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {
    a * b * (I1 - 3.0 - 2.0 * J.ln()) + b * (J - 1.0).powi(2) + n * (J - 1.0).powi(4)
}

/// A stressed rest state, which has another response.
//@ values 3, 1, 0.1
#[material(prestressed)]
fn Stressed([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {
    a * I1 + b * J * J + n * (J - 1.0).powi(4)
}
