#![allow(private_interfaces)]

mod solids {
    use piola::material;

    #[material(domain(J > 0.0), extend)]
    fn Private([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
        mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln()) + kappa / 2.0 * (J - 1.0).powi(2)
    }

    pub type Alias = Private;

    pub fn private() -> Result<Private, piola::material::MaterialError> {
        Private::new(1e6, 1e7)
    }
}

fn main() -> Result<(), piola::material::MaterialError> {
    let _ = solids::Alias::new(1e6, 1e7)?;
    let _ = solids::private()?.with_inversion(piola::Inversion::Refuse)?;
    let _ = solids::private()?.mu();
    Ok(())
}
