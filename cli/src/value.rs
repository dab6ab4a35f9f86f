//! Values of options that have a notation of their own: parameters, and how inverted material is treated.

use piola::Inversion;

/// Reads `NAME=V,V,V`.
pub(crate) fn parameter(text: &str) -> Result<(String, Vec<f64>), String> {
    let (name, values) = text.split_once('=').ok_or("write NAME=VALUE, or NAME=V,V,V for a list")?;
    let number = |value: &str| value.trim().parse().map_err(|_| format!("`{value}` is not a number"));
    Ok((name.trim().into(), values.split(',').map(number).collect::<Result<_, _>>()?))
}

/// Reads `refuse` or the stretch where an extension begins.
pub(crate) fn inversion(text: &str) -> Result<Inversion, String> {
    if text == "refuse" {
        return Ok(Inversion::Refuse);
    }
    let epsilon = text.parse().map_err(|_| "write `refuse`, or a stretch between 0 and 1")?;
    Ok(Inversion::Extend { epsilon })
}
