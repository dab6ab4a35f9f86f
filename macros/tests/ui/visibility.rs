mod solids {
    use piola::material;

    #[material(domain(J > 0.0))]
    fn Private([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
        mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
    }

    pub mod inner {
        use piola::material;

        #[material(domain(J > 0.0))]
        pub(super) fn Inner([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
            mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
        }

        #[material(domain(J > 0.0))]
        pub(crate) fn Shared([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
            mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
        }
    }

    pub fn shear_moduli() -> Result<[f64; 2], piola::material::MaterialError> {
        Ok([Private::new(1e6)?.mu(), inner::Inner::new(1e6)?.mu()])
    }
}

fn main() -> Result<(), piola::material::MaterialError> {
    let shared = solids::inner::Shared::new(1e6)?;
    assert_eq!(solids::shear_moduli()?, [shared.mu(); 2]);
    solids::Private::new(1e6)?;
    solids::inner::Inner::new(1e6)?;
    Ok(())
}
