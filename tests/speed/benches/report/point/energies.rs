//! The energies of the report.

use piola::Inversion;
use piola::material::Declared;
use piola::point::Filter;
use piola_materials::{Hencky, NeoHookean, Ogden, StVenantKirchhoff};
use piola_tests::cases::Case;
use piola_tests::declarations::slices;
use piola_tests::energies::find;

use super::contestant::{Contestant, Number};
use super::methods;

/// Names of the energies: in the report and in the catalogue.
pub(crate) const ENERGIES: [(&str, &str); 5] = [
    ("Saint Venant–Kirchhoff", "st_venant_kirchhoff"),
    ("neo-Hookean", "neo_hookean"),
    ("Ogden, three terms", "ogden"),
    ("rotated linear", "rotated_linear"),
    ("Hencky", "hencky"),
];

/// All methods for the energy and the parameters of a case.
pub(crate) fn contestants<E: Number>(case: &Case, filter: Filter) -> Result<Vec<Contestant<E>>, String> {
    let energy = find(&case.material).ok_or_else(|| format!("{}: not in the catalogue", case.id))?;
    let values = case.values(energy.description())?;
    let values = slices(&values);
    Ok(match energy.name {
        "st_venant_kirchhoff" => methods::with_invariants(made::<StVenantKirchhoff>(case, &values)?, filter),
        "neo_hookean" => methods::with_invariants(made::<NeoHookean>(case, &values)?, filter),
        "rotated_linear" => methods::with_polar(made(case, &values)?, filter),
        "hencky" => methods::all(made::<Hencky>(case, &values)?, filter),
        "ogden" => {
            // Terms that a case does not have get a modulus of zero, and any exponent.
            let [mut mu, mut alpha] = [0, 1].map(|k| values[k].to_vec());
            mu.resize(3, 0.0);
            alpha.resize(3, 2.0);
            methods::all(made::<Ogden<3>>(case, &[&mu, &alpha, values[2]])?, filter)
        }
        name => return Err(format!("{}: no method for {name}", case.id)),
    })
}

fn made<M: Declared>(case: &Case, values: &[&[f64]]) -> Result<M, String> {
    M::from_values(values, Inversion::Refuse).map_err(|error| format!("{}: {error}", case.id))
}
