//! Writes `tests/STABILITY.md`; the test `stability` compares it with what would be written.

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../STABILITY.md");
    std::fs::write(&path, piola_baselines::stability::document()?)?;
    Ok(())
}
