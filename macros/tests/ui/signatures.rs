//! Mistaken signatures, each of which is used as if it were right.

use piola::{Material, Spline, material};

#[material(domain(J > 0.0))]
pub fn Borrowed<'a>([l1, l2, l3]: [f64; 3], mu: &'a [f64]) -> f64 {
    sum(|p| mu[p]) * (I1 - 3.0 - 2.0 * J.ln())
}

#[material(domain(J > 0.0))]
pub fn Generic<T>([l1, l2, l3]: [T; 3], mu: T) -> T {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

#[material(domain(J > 0.0))]
pub fn Flat([l1, l2]: [f64; 2], mu: f64) -> f64 {
    mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2))
}

#[material(domain(J > 0.0))]
pub fn Nothing([l1, l2, l3]: [f64; 3], mu: f64) {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln());
}

#[material(domain(J > 0.0))]
pub fn Reserved<const n: usize>([None, l2, l3]: [f64; 3], Some: f64, Ok: [f64; n], r#type: f64) -> f64 {
    Some * sum(|p| Ok[p]) * r#type * (I1 - 3.0)
}

#[material]
pub fn Drawn([l1, l2, l3]: [f64; 3], f: Spline) -> f64 {
    f + f(l1, l2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    assert!(Borrowed::new(&[1e6, 2e6])?.energy([1.0; 3]) > Generic::new(1e6)?.energy([1.0; 3]));
    assert!(Nothing::new(1e6)?.mu() < Flat::new(1e6)?.energy([1.0; 3]));
    assert!(Reserved::new(1e6, [2e6; 3], 1.0)?.energy([1.0; 3]) > 0.0);
    assert!(Drawn::new(Spline::through(&[[0.5, -1.0], [2.0, 1.0]])?)?.energy([1.0; 3]) > 0.0);
    Ok(())
}
