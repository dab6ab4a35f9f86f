//! Generator of the header of piola for C: without arguments checks that `include/piola.h` agrees with the
//! sources, with `write` writes it.

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let file = folder.join("include/piola.h");
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml"))?;
    let mut made = Vec::new();
    cbindgen::Builder::new().with_crate(&folder).with_config(config).generate()?.write(&mut made);
    if std::env::args().nth(1).is_some_and(|argument| argument == "write") {
        std::fs::write(&file, &made)?;
    } else if made != std::fs::read(&file)? {
        return Err("include/piola.h is out of date: run the same command with `write` to update it".into());
    }
    Ok(())
}
