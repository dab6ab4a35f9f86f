//! A user-defined energy: everything else follows from it.

use piola::material;
use piola::point::{Filter, evaluate_dense};

/// Compressible neo-Hookean rubber; mu and lambda in Pa.
#[material(domain(J > 0.0), extend)]
pub fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Rubber::new(1e6, 5e6)?;

    // Simple shear by 0.2: first Piola stress P, and dP/dF projected to the nearest semidefinite matrix.
    let shear: [[f64; 3]; 3] = [[1.0, 0.2, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let point = evaluate_dense(&rubber, &shear, Filter::Clamp);
    assert!((point.stress[0][1] - 0.2e6).abs() < 1e-9 * 1e6);
    assert!(point.tangent[1][1] > 0.99e6);

    // Requirements on every material: finite differences, symmetry, equal stretches, inversion.
    piola::contract::check(&rubber, &Default::default())?;
    Ok(())
}
