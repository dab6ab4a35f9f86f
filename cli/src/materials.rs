//! `piola materials`: formula, parameters with typical values, domain and small-strain moduli of each
//! material.

use piola::material::Description;
use piola_laboratory::AtRest;
use piola_laboratory::curve::Volume;
use piola_materials::DECLARATIONS;
use piola_scenes::error::Error;
use piola_scenes::material::MaterialSpec;
use rayon::prelude::*;

use crate::bench::as_options;

/// A page for a material, or for each one of the catalogue, separated by blank lines.
pub(crate) fn pages(name: Option<&str>) -> Result<String, Error> {
    if let Some(name) = name {
        return page(name);
    }
    let pages: Vec<_> =
        DECLARATIONS.par_iter().map(|declaration| page(declaration.name)).collect::<Result<_, _>>()?;
    Ok(pages.join("\n"))
}

fn page(name: &str) -> Result<String, Error> {
    let material = MaterialSpec::typical(name)?;
    let Description { summary, formula, parameters, domain, extends, refusal, admissible, moduli, .. } =
        material.description()?;
    let mut text = format!("{name}\n  {summary}\n  ψ = {formula}\n");
    for parameter in parameters.iter() {
        let list = if parameter.is_list() { " One for each term." } else { "" };
        text += &format!("  {:12} {}{list}\n", parameter.name, parameter.doc);
    }
    if !admissible.is_empty() {
        text += &format!("  admissible   {}\n", admissible.join(", "));
    }
    text += &format!("  typical      {}\n", as_options(&material)?.replace("--param ", ""));
    let beyond = match refusal {
        _ if *extends => ", can be extended beyond".to_owned(),
        Some(reason) => format!(", not extended: {reason}"),
        None => String::new(),
    };
    text += &format!("  domain       {domain}{beyond}\n");
    text += &format!("  small strain μ = {}, λ = {}\n", moduli[0], moduli[1]);
    text +=
        &format!("  at rest      {}\n", AtRest { moduli: material.build()?.moduli, volume: Volume::Free });
    Ok(text)
}
