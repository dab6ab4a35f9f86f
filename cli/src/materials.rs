//! `piola materials`: formula, parameters with typical values, domain and small-strain moduli of each
//! material.

use piola::material::Description;
use piola_materials::{CATALOGUE, Entry};

/// A page for each material of the catalogue, separated by blank lines.
pub(crate) fn pages() -> String {
    CATALOGUE.iter().map(page).collect::<Vec<_>>().join("\n")
}

fn page(entry: &Entry) -> String {
    let Description { summary, formula, parameters, domain, extends, refusal, admissible, moduli, .. } =
        &entry.description;
    let mut text = format!("{}\n  {summary}\n  ψ = {formula}\n", entry.name);
    for parameter in parameters.iter() {
        let list = if parameter.is_list() { " One for each term." } else { "" };
        text += &format!("  {:12} {}{list}\n", parameter.name, parameter.doc);
    }
    if !admissible.is_empty() {
        text += &format!("  admissible   {}\n", admissible.join(", "));
    }
    let typical = parameters.iter().zip(entry.typical()).map(|(parameter, values)| {
        let values: Vec<_> = values.iter().map(f64::to_string).collect();
        format!("{}={}", parameter.name, values.join(","))
    });
    text += &format!("  typical      {}\n", typical.collect::<Vec<_>>().join(" "));
    let beyond = match refusal {
        _ if *extends => ", can be extended beyond".to_owned(),
        Some(reason) => format!(", not extended: {reason}"),
        None => String::new(),
    };
    text + &format!("  domain       {domain}{beyond}\n  small strain μ = {}, λ = {}\n", moduli[0], moduli[1])
}
