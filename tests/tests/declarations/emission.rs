//! Every energy is printed as C, which compilers of C and C++ read without a warning, also in one program
//! with another energy: the functions that belong to all energies are the same in both.

use std::io::Write;
use std::process::{Command, Stdio};
use std::sync::LazyLock;

use piola::Inversion;
use piola_declare::emit::{Emission, EmitError, Target};
use piola_tests::declarations::{Sample, slices};
use piola_tests::energies::find;
use piola_tests::is_full;

/// Compilers with the language and its standard. The text is compiled alone, so that no function is called:
/// clang warns of these more often than gcc.
const COMPILERS: [[&str; 3]; 3] =
    [["cc", "-xc", "-std=c99"], ["clang", "-xc", "-std=c99"], ["c++", "-xc++", "-std=c++17"]];

const STRICT: [&str; 6] = ["-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"];

/// Another energy, whose functions come first in each program.
static OGDEN: LazyLock<String> = LazyLock::new(|| of_catalogue("ogden", Target::C));

fn of_catalogue(name: &str, target: Target) -> String {
    let energy = find(name).expect("in the catalogue");
    let emission = Emission { prefix: Some(format!("of_{name}")), ..Emission::new(target) };
    energy.energy.emit(&energy.typical(), Inversion::Refuse, &emission).expect("text")
}

/// Messages of a compiler for a text, if there is that compiler.
fn messages([compiler, language, standard]: [&str; 3], text: &str) -> Option<String> {
    let mut command = Command::new(compiler);
    command.args(STRICT).args([language, standard, "-"]).stdin(Stdio::piped()).stderr(Stdio::piped());
    let Ok(mut running) = command.spawn() else {
        assert_ne!(compiler, "cc", "a C compiler is needed");
        return None;
    };
    let input = running.stdin.take();
    input.expect("its input").write_all(text.as_bytes()).expect("read by the compiler");
    let output = running.wait_with_output().expect("the compiler");
    Some(String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Judges all functions by all compilers that there are, or, unless all is judged, by one.
pub(crate) fn judge(sample: &Sample) {
    let Some(values) = sample.values().into_iter().next() else { return };
    for inversion in sample.judged.inversions(0.3) {
        let emission = Emission { prefix: Some("energy".into()), ..Emission::new(Target::C) };
        let text = match sample.judged.energy.emit(&slices(&values), inversion, &emission) {
            Ok(text) => OGDEN.clone() + &text,
            Err(EmitError::Function(name)) => {
                assert!(sample.has_functions(), "{name} is a function");
                return;
            }
            Err(error) => panic!("{inversion:?}: {error}"),
        };
        for &compiler in &COMPILERS[..if is_full() { 3 } else { 1 }] {
            if let Some(messages) = messages(compiler, &text) {
                assert_eq!(messages, "", "{compiler:?}: {text}");
            }
        }
    }
}

/// Files of one program have one target, and in C++ one namespace.
pub(crate) fn files_of_a_program_have_one_target_and_one_namespace() {
    let other = of_catalogue("neo_hookean", Target::C);
    let both = OGDEN.clone() + &of_catalogue("neo_hookean", Target::Cuda);
    let mistake = messages(COMPILERS[0], &both).expect("a C compiler");
    assert!(mistake.contains("one release and one --target"), "{mistake}");
    let headers = "#include <float.h>\n#include <math.h>\n#include <string.h>\n";
    let within = |between| {
        messages(COMPILERS[2], &format!("{headers}namespace one {{\n{}{between}{other}}}\n", *OGDEN))
    };
    assert_eq!(within("").unwrap_or_default(), "");
    assert_ne!(within("}\nnamespace other {\n"), Some(String::new()));
}
