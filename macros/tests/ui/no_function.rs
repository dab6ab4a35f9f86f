use piola::material;

#[material(domain(J > 0.0))]
pub struct Solid {
    pub mu: f64,
}

fn main() {
    let solid = Solid { mu: 1e6 };
    assert!(solid.mu > 0.0);
}
