/// A solid drawn by hand.
#[material(domain(J > 0.0))]
pub fn Drawn([l1, l2, l3]: [f64; 3], /** Pa. */ f: Spline, /** Pa. */ kappa: f64) -> f64 {
    f(l1) + f(l2) + f(l3) + kappa / 2.0 * (J - 1.0).powi(2)
}
