//! The energies of the report.

use std::fmt::Display;

use piola::material::MaterialError;
use piola::point::Filter;
use piola_baselines::{automatic, invariants, polar};
use piola_materials::{Hencky, NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff};
use piola_tests::cases::Case;
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
    let misfit = |reason: &dyn Display| format!("{}: {reason}", case.id);
    let refused = |error: MaterialError| misfit(&error);
    let energy = find(&case.material).ok_or_else(|| misfit(&"not in the catalogue"))?;
    let values = case.values(energy.description())?;
    let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
    Ok(match (energy.name, &values[..]) {
        ("st_venant_kirchhoff", &[&[mu], &[lambda]]) => {
            let material = StVenantKirchhoff::new(mu, lambda).map_err(refused)?;
            methods::with_invariants(material, invariants::StVenantKirchhoff { mu, lambda }, filter)
        }
        ("neo_hookean", &[&[mu], &[lambda]]) => {
            let material = NeoHookean::new(mu, lambda).map_err(refused)?;
            methods::with_invariants(material, invariants::NeoHookean { mu, lambda }, filter)
        }
        ("rotated_linear", &[&[mu], &[lambda]]) => {
            let by_hand = polar::RotatedLinear { mu, lambda };
            let mut all = methods::all(RotatedLinear::new(mu, lambda).map_err(refused)?, by_hand, filter);
            all.push(methods::by_polar(by_hand, filter));
            all
        }
        ("hencky", &[&[mu], &[lambda]]) => {
            let material = Hencky::new(mu, lambda).map_err(refused)?;
            methods::all(material, automatic::Hencky { mu, lambda }, filter)
        }
        ("ogden", &[mu, alpha, &[kappa]]) => {
            // Terms that a case does not have get a modulus of zero, and any exponent.
            let filled = |list: &[f64], with| std::array::from_fn(|p| list.get(p).copied().unwrap_or(with));
            let (mu, alpha): ([f64; 3], _) = (filled(mu, 0.0), filled(alpha, 2.0));
            let material = Ogden::new(mu, alpha, kappa).map_err(refused)?;
            methods::all(material, automatic::Ogden { mu, alpha, kappa }, filter)
        }
        (name, _) => return Err(misfit(&format_args!("no method for {name} with these parameters"))),
    })
}
