//! Single points of a material whose type is known, inlined into the caller, compared with those behind a
//! pointer, which the other judges take: equal bits.
//!
//! The energies cover polynomials, logarithms, real powers in lists, a pole and an exponential. Deformation
//! gradients are those of the first file of reference cases, refused ones included.

#![expect(non_snake_case, reason = "F as in the literature")]

use piola::material::{Declared, MaterialError, Response};
use piola::point::{
    DisplacementGradient, Filter, Matrix3, evaluate, evaluate_dense, evaluate_energy, evaluate_stress,
};
use piola_materials::{Fung, NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff};
use piola_tests::cases::Case;
use piola_tests::energies::{Format, Subject, find};

/// The bits of all results: the text of a floating-point number is that of its bits, except for NaN.
fn results<R: Format>(material: &(impl Response<R> + ?Sized), F: &Matrix3<R>) -> [String; 6] {
    let H = DisplacementGradient(F);
    [
        format!("{:?}", evaluate_energy(material, F)),
        format!("{:?}", evaluate_stress(material, F)),
        format!("{:?}", evaluate_energy(material, H)),
        format!("{:?}", evaluate_stress(material, H)),
        format!("{:?}", evaluate_dense(material, F, Filter::None)),
        format!("{:?}", evaluate(material, F, Filter::Clamp)),
    ]
}

fn check<M: Declared, R: Format>(name: &str, material: &M, subject: &Subject, F: &Matrix3<R>) {
    assert_eq!(results(material, F), results(R::of(subject), F), "{name} in {} at {F:?}", R::NAME);
}

fn check_energy<M: Declared + 'static>(name: &str, cases: &[Case]) -> Result<(), MaterialError> {
    let energy = find(name).expect("in the catalogue");
    for inversion in energy.inversions(0.1) {
        let (values, material) = (energy.typical(), M::from_values(&energy.typical(), inversion)?);
        let subject = energy.subject(&values, inversion)?;
        for case in cases {
            check(name, &material, &subject, &case.F::<f64>());
            check(name, &material, &subject, &case.F::<f32>());
        }
    }
    Ok(())
}

#[test]
fn points_have_the_bits_of_those_behind_a_pointer() -> Result<(), Box<dyn std::error::Error>> {
    let cases = Case::own(&["cases"])?;
    check_energy::<StVenantKirchhoff>("st_venant_kirchhoff", &cases)?;
    check_energy::<NeoHookean>("neo_hookean", &cases)?;
    check_energy::<Ogden<3>>("ogden", &cases)?;
    check_energy::<RotatedLinear>("rotated_linear", &cases)?;
    check_energy::<Fung>("fung", &cases)?;
    Ok(())
}
