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

/// A source with the functions of its calls of `functions!` as C has them, without bodies.
fn expand(source: &str) -> Result<String, String> {
    let mut calls = source.split("\nfunctions! {\n");
    let mut text = calls.next().unwrap_or_default().to_owned();
    for call in calls {
        let expanded = expand_call(call);
        text += &expanded.ok_or("a call of `functions!` has another form than in src/functions.rs")?;
    }
    Ok(text)
}

fn expand_call(call: &str) -> Option<String> {
    let (call, rest) = call.split_once("\n}\n}\n")?;
    // Two types of numbers, and how the second one differs.
    let (types, functions) = match call.strip_prefix("    E = ") {
        Some(call) => {
            let (head, functions) = call.split_once("\";\n")?;
            let (types, difference) = head.split_once(": \"")?;
            (Some((types.split_once(", ")?, difference)), functions)
        }
        None => (None, call),
    };
    let mut text = String::new();
    for function in format!("\n{functions}\n}}\n").split_inclusive("\n}\n") {
        let Some((documentation, function)) = function.split_once("\nfn ") else { continue };
        let (names, arguments) = function.split_once('(')?;
        let (arguments, _) = arguments.split_once(") {\n")?;
        let mut declare = |documentation: &str, name: &str, number: &str| {
            let arguments = arguments.split(',').map(|argument| in_c(argument.trim(), number));
            let arguments = arguments.collect::<Option<Vec<_>>>()?.concat();
            text += &format!(
                "{documentation}\n#[unsafe(no_mangle)]\npub extern \"C\" fn {name}({arguments}) -> Code {{}}\n"
            );
            Some(())
        };
        match types {
            None => declare(documentation, names, "")?,
            Some(((first_type, second_type), difference)) => {
                let (first, second) = names.split_once(", ")?;
                declare(documentation, first, first_type)?;
                declare(&format!("\n/// `{first}`{difference}"), second, second_type)?;
            }
        }
    }
    Some(text + rest)
}

/// An argument, or two, of a function of C, whose numbers `E` are of a type.
fn in_c(argument: &str, number: &str) -> Option<String> {
    /// How a type of Rust begins and ends around T, and what C passes.
    const FORMS: [(&str, &str, &str); 9] = [
        ("&mut [", "]", "NAME: *mut T, NAME_length: usize, "),
        ("&[", "]", "NAME: *const T, NAME_length: usize, "),
        ("&str", "", "NAME: *const c_char, "),
        ("Option<&str>", "", "NAME: *const c_char, "),
        ("&", "", "NAME: *const T, "),
        ("Options", "", "NAME: *const Options, "),
        ("Out<", ">", "NAME: *mut T, "),
        ("New<", ">", "NAME: *mut *mut T, "),
        ("", "", "NAME: T, "),
    ];
    let Some((name, kind)) = argument.split_once(": ") else { return argument.is_empty().then(String::new) };
    let mut forms = FORMS.into_iter().filter_map(|(start, end, form)| {
        let inside = kind.strip_prefix(start)?.strip_suffix(end)?;
        Some((inside, form))
    });
    let (inside, form) = forms.next()?;
    Some(form.replace('T', if inside == "E" { number } else { inside }).replace("NAME", name))
}
