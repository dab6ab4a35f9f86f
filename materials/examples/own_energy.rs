//! A material of one's own: the energy, and everything else follows.

use piola::material;
use piola::material::Declared;
use piola::point::Filter;

/// Compressible neo-Hookean solid.
#[material(domain(J > 0.0), extend)]
pub fn Rubber(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Rubber::new(1e6, 5e6)?;
    assert_eq!(rubber.moduli().mu, 1e6);

    // Simple shear by 0.2: stress and tangent are exact, and no derivative was written.
    let deformation: [[f64; 3]; 3] = [[1.0, 0.2, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let point = piola::point::evaluate(&rubber, &deformation, Filter::None);
    assert!((point.stress[0][1] - 0.2e6).abs() < 1e-9 * 1e6);

    // The tangent applied to a further shear is the change of stress.
    let change = point.tangent.apply(&[[0.0, 1.0, 0.0], [0.0; 3], [0.0; 3]]);
    assert!((change[0][1] - 1e6).abs() < 1e-9 * 1e6);

    // The contract every material must pass: finite differences, symmetry, equal stretches, inversion …
    piola::contract::check(&rubber, &Default::default())?;
    Ok(())
}
