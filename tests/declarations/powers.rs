//! Powers whose whole exponents are parameters. The harness writes the terms of the first line of each body
//! out, with numbers as exponents, and compares.

/// A series in the isochoric invariants.
//@ values [1, 2, 3], [1, 0, 3], [0, 2, 1], 0.7
//@ exponents [1, 0, 3], [0, 2, 1]
#[material(domain(J > 0.0), extend)]
fn Isochoric([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, k: f64) -> f64 {
    sum(|p| c[p] * (I1b - 3.0).powi(i[p]) * (I2b - 3.0).powi(j[p]))
        + k * (J - 1.0).powi(2)
}

/// Rivlin's series up to the third order.
//@ values [1.8e5, 2.1e4, 3e3, 1.1e3, 5e2, 7e2, 1.3e2, 22, 40], [1, 0, 2, 1, 0, 3, 2, 1, 0],
//@   [0, 1, 0, 1, 2, 0, 1, 2, 3], 1e6
//@ exponents [1, 0, 2, 1, 0, 3, 2, 1, 0], [0, 1, 0, 1, 2, 0, 1, 2, 3]
#[material(domain(J > 0.0), extend)]
fn Rivlin([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, k: f64) -> f64 {
    sum(|p| c[p] * (I1b - 3.0).powi(i[p]) * (I2b - 3.0).powi(j[p]))
        + k / 2.0 * (J - 1.0).powi(2)
}

/// A series in I1 and the volume.
//@ values [1, 2, 3], [1, 0, 3], [0, 2, 1], 0.7
//@ exponents [1, 0, 3], [0, 2, 1]
#[material(prestressed)]
fn Stressed([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, k: f64) -> f64 {
    sum(|p| c[p] * (I1 - 3.0).powi(i[p]) * (J - 1.0).powi(j[p]))
        + k * I2
}

/// Products of powers of each stretch.
//@ values [1, 2, 3], [1, 0, 3], [0, 2, 1], 0.7
//@ exponents [1, 0, 3], [0, 2, 1]
#[material(prestressed)]
fn OfEach([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, k: f64) -> f64 {
    sum(|p| c[p] * sum(|l| (l - 1.0).powi(i[p]) * (l * l - 1.0).powi(j[p])))
        + k * I2
}

/// The same, for positive volumes.
//@ values [1, 2, 3], [1, 0, 3], [0, 2, 1], 0.7
//@ exponents [1, 0, 3], [0, 2, 1]
#[material(prestressed, domain(J > 0.0))]
fn OfEachInside([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, k: f64) -> f64 {
    sum(|p| c[p] * sum(|l| (l - 1.0).powi(i[p]) * (l * l - 1.0).powi(j[p])))
        + k * I2
}

/// Products of powers of a sum and of the volume.
//@ values [1, 2, 3], [1, 0, 3], [0, 2, 1], 0.7
//@ breaks shear is resisted there
//@ exponents [1, 0, 3], [0, 2, 1]
#[material(prestressed, domain(J > 0.0))]
fn OfSum([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, k: f64) -> f64 {
    sum(|p| c[p] * (l1 + l2 + l3 - 3.0).powi(i[p]) * (l1 * l2 * l3.powi(3) * l2.powi(2) * l1.powi(2)).powi(j[p]))
        + k * I2
}

/// An exponent of no list, and the formulas of both.
//@ formula Σₚ cₚ (I1 J^(−2/3) − 3)^iₚ + (J − 1)^n
//@ shear-modulus 2 Σₚ cₚ [iₚ = 1] − 1/2 [n = 1]
#[material(domain(J > 0.0), prestressed)]
fn Formula([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, n: u32) -> f64 {
    sum(|p| c[p] * (I1b - 3.0).powi(i[p])) + (J - 1.0).powi(n)
}

/// x^n is odd for some n and even for others: the draws have both.
//@ pole
#[material(prestressed)]
fn Odd([l1, l2, l3]: [f64; 3], c: Vec<f64>, n: Vec<u32>, k: f64) -> f64 {
    sum(|p| c[p] * sum(|l| l.powi(2 * 1) * l.powi(n[p]))) + k * I1
}

//@ no-pole
#[material(prestressed)]
fn Even([l1, l2, l3]: [f64; 3], c: f64, n: u32, k: f64) -> f64 {
    c * sum(|l| l.powi(2).powi(n)) + k * I1
}
