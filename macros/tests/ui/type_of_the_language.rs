use piola::material;

#[material(domain(J > 0.0))]
pub fn f64([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu * (I1 - 3.0 - 2.0 * J.ln())
}

fn main() {
    assert!(f64::from(1.0f32) > 0.0);
}
