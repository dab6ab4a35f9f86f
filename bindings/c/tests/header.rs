//! `include/piola.h` is what the sources say.

use std::path::Path;

#[test]
fn the_header_is_up_to_date() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = folder.join("include/piola.h");
    let mut made = Vec::new();
    cbindgen::Builder::new()
        .with_crate(folder)
        .with_config(cbindgen::Config::from_file(folder.join("cbindgen.toml")).expect("a configuration"))
        .generate()
        .expect("a header")
        .write(&mut made);
    if std::env::var_os("PIOLA_BLESS").is_some() {
        std::fs::write(&file, &made).expect("a folder to write to");
    }
    let kept = std::fs::read(&file).expect("a header");
    assert!(made == kept, "include/piola.h is out of date: `PIOLA_BLESS=1 cargo test -p piola-c` makes it anew");
}
