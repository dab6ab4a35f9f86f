//! Blatz–Ko solid.

use piola::material;

/// Blatz–Ko solid: foamed rubber and other compressible elastomers.
///
/// ψ = f μ/2 (I1 − 3 + (J^(−2β) − 1)/β) + (1 − f) μ/2 (Σ λi⁻² − 3 + (J^(2β) − 1)/β).
///
/// Blatz, Ko, *Application of Finite Elastic Theory to the Deformation of Rubbery Materials*, Trans. Soc.
/// Rheol. 6, 1962, eq. 25; β = ν/(1 − 2ν), and Σ λi⁻² is the source's I2/I3. Nothing is added: the source is
/// compressible. Defined for J > 0, continued below a threshold stretch with
/// [`Inversion::Extend`](piola::Inversion::Extend) if f = 1 or β ≥ 1: the polynomial that continues J^(2β)
/// has negative values for β < 1, so that ψ falls without bound as an inverted body grows. For f > 0 and β >
/// 2, J^(−2β) makes an inverted body so stiff that the solver gives up on a third of all single elements.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, f >= 0.0, f <= 1.0, beta > 0.0),
    extend((1.0 - f) * (beta - 1.0) >= 0.0),
    typical(
        "the foamed polyurethane of the source, except for its β = 1/2, that is ν = 1/4, with which \
         it does not extend",
        mu = 2.2e5, f = 0.0, beta = 1.0
    )
)]
pub fn BlatzKo(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Fraction f of the part in I1, dimensionless: 1 for a solid rubber, 0 for a foam.
    f: f64,
    /// β = ν/(1 − 2ν) with Poisson's ratio ν, dimensionless.
    beta: f64,
) -> f64 {
    // f multiplies each power: where it is zero, so is the product, though the power may be out of range.
    let solid = f * (I1 - 3.0) + (f * J.powf(-2.0 * beta) - f) / beta;
    let g = 1.0 - f;
    let foam =
        g * l1.powi(-2) + g * l2.powi(-2) + g * l3.powi(-2) - 3.0 * g + (g * J.powf(2.0 * beta) - g) / beta;
    mu / 2.0 * (solid + foam)
}
