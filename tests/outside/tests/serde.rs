//! Parameters of materials, written and read again to the last bit.

use outside::Stiffening;

#[test]
fn a_material_is_read_as_it_was_written() -> Result<(), Box<dyn std::error::Error>> {
    let written = outside::stiffening()?;
    let read: Stiffening = serde_json::from_str(&serde_json::to_string(&written)?)?;
    assert_eq!(read, written);
    Ok(())
}

#[test]
fn parameters_are_admitted_as_by_the_constructor() {
    let read = serde_json::from_str::<Stiffening>(r#"{"c10": 1e5, "c20": 1e4}"#);
    assert!(read.is_err_and(|error| error.to_string().contains("kappa")));
}
