//! Generator of the header of piola for C: without arguments checks that `include/piola.h` agrees with the
//! sources, with `write` writes it.

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let file = folder.join("include/piola.h");
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml"))?;
    // The sources as cbindgen reads them, which does not expand macros.
    let expanded = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/expanded");
    std::fs::create_dir_all(&expanded)?;
    for source in std::fs::read_dir(folder.join("src"))? {
        let source = source?;
        std::fs::write(expanded.join(source.file_name()), expand(&std::fs::read_to_string(source.path())?)?)?;
    }
    let mut made = Vec::new();
    let sources = cbindgen::Builder::new().with_src(expanded.join("lib.rs"));
    sources.with_config(config).generate()?.write(&mut made);
    if std::env::args().nth(1).is_some_and(|argument| argument == "write") {
        std::fs::write(&file, &made)?;
    } else if made != std::fs::read(&file)? {
        return Err("include/piola.h is out of date: run the same command with `write` to update it".into());
    }
    Ok(())
}

/// A source with the two functions, without bodies, for each function in its calls of `twins!`.
fn expand(source: &str) -> Result<String, String> {
    let mut calls = source.split("\ntwins!(\n    E = ");
    let mut text = calls.next().unwrap_or_default().to_owned();
    for call in calls {
        let parse = || {
            let (call, rest) = call.split_once("\n);\n")?;
            let (head, functions) = call.split_once("\";\n")?;
            let (types, difference) = head.split_once(": \"")?;
            let (first_type, second_type) = types.split_once(", ")?;
            let mut both = String::new();
            for function in functions.split_inclusive("\n}\n") {
                let (documentation, function) = function.split_once("\nfn ")?;
                let (first, function) = function.split_once(", ")?;
                let (second, function) = function.split_once('(')?;
                let (arguments, _) = function.split_once("\n) {")?;
                let of_second = format!("\n/// `{first}`{difference}");
                for (documentation, name, of) in
                    [(documentation, first, first_type), (&of_second, second, second_type)]
                {
                    let arguments = arguments.replace(" E,", &format!(" {of},"));
                    both += &format!(
                        "{documentation}\n#[unsafe(no_mangle)]\npub unsafe extern \"C\" fn {name}({arguments}\n) -> Code {{}}\n"
                    );
                }
            }
            Some(both + rest)
        };
        text += &parse().ok_or("a call of `twins!` has another form than in src/twins.rs")?;
    }
    Ok(text)
}
