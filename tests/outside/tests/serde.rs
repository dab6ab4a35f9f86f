//! Parameters of materials, written and read again to the last bit.

use outside::Stiffening;
use piola::point::{Filter, evaluate};

#[test]
fn a_material_is_read_as_it_was_written() -> Result<(), Box<dyn std::error::Error>> {
    let written = outside::stiffening()?;
    let read: Stiffening = serde_json::from_str(&serde_json::to_string(&written)?)?;
    let deformation: [[f64; 3]; 3] = [[1.2, 0.3, 0.0], [0.0, 0.9, 0.1], [0.0, 0.0, 1.1]];
    let [written, read] =
        [written, read].map(|material| evaluate(&material, &deformation, Filter::None).stress);
    assert_eq!(written, read);
    Ok(())
}
