//! A user-defined energy: everything else follows from it.

use piola::material;
use piola::point::{Filter, evaluate_dense};

// `domain` states where the energy is defined; `extend` can continue it to flat and inverted elements.
/// Compressible neo-Hookean rubber; mu and lambda in Pa.
#[material(domain(J > 0.0), extend)]
pub fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    // I1 and J are predefined: l1² + l2² + l3² and l1 l2 l3.
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Rubber::new(1e6, 5e6)?;

    // Simple shear by 0.2: the first Piola stress P (3×3), and dP/dF (9×9, index 3i+j for F[i][j]) with its
    // negative eigenvalues set to zero.
    let shear: [[f64; 3]; 3] = [[1.0, 0.2, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let point = evaluate_dense(&rubber, &shear, Filter::Clamp);
    assert!((point.stress[0][1] - 0.2e6).abs() < 1e-3);
    assert!((point.tangent[1][1] - 1e6).abs() < 1e-3);

    // Checks for every material: finite differences, symmetry, equal stretches, inversion.
    piola::contract::check(&rubber, &Default::default())?;
    Ok(())
}
