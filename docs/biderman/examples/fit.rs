//! The parameters with which Biderman's energy agrees best with Treloar's rubber.

use piola::Inversion;
use piola_declare::Energy;
use piola_laboratory::data::{Measurements, TRELOAR_1944};
use piola_laboratory::fit::{Candidate, FitSettings, fit_parameters};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The same declaration as a text, of which the derivatives with respect to the parameters are made.
    let energy = Energy::from_rust(include_str!("../src/lib.rs"))?;
    // Where the search begins: a shear modulus of 0.4 MPa, and a little of each.
    let material = energy.material(&[&[1.9e5], &[1e4], &[1e2], &[1e2], &[2e7]], Inversion::Refuse)?;
    let start = Candidate { energy, material };
    let data = Measurements::read(TRELOAR_1944)?;
    let fitted = fit_parameters(&start, &data, &FitSettings::default())?;

    for number in &fitted.numbers {
        println!("{:8} {:>10.3e}", number.name, number.value);
    }
    println!("R²: {}", fitted.agreement);
    for warning in &fitted.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
