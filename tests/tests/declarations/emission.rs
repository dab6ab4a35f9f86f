//! Every energy is printed as C, which compilers of C and C++ read without a warning, also where two energies
//! are in one program: the functions that belong to all energies are the same in both.

use std::io::Write;
use std::process::{Command, Stdio};

use piola_declare::emit::{Emission, EmitError, Target};
use piola_tests::declarations::{Sample, slices};
use piola_tests::is_full;

/// Compilers with the language and its standard. The text is compiled alone, so that no function is called:
/// clang warns of these more often than gcc.
const COMPILERS: [[&str; 3]; 3] =
    [["cc", "-xc", "-std=c99"], ["clang", "-xc", "-std=c99"], ["c++", "-xc++", "-std=c++17"]];

const STRICT: [&str; 6] = ["-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"];

/// Judges all functions by all compilers that there are, or, unless all is judged, by one.
pub(crate) fn judge(sample: &Sample) {
    let Some(values) = sample.values().into_iter().next() else { return };
    for inversion in sample.judged.inversions(0.3) {
        let emit = |prefix: &str| {
            let emission = Emission { prefix: Some(prefix.into()), ..Emission::new(Target::C) };
            sample.judged.energy.emit(&slices(&values), inversion, &emission)
        };
        let text = match emit("energy").and_then(|text| Ok(text + &emit("other")?)) {
            Ok(text) => text,
            Err(EmitError::Function(name)) => {
                assert!(sample.has_functions(), "{name} is a function");
                return;
            }
            Err(error) => panic!("{inversion:?}: {error}"),
        };
        for &[compiler, language, standard] in &COMPILERS[..if is_full() { 3 } else { 1 }] {
            let mut command = Command::new(compiler);
            command.args(STRICT).args([language, standard, "-"]).stdin(Stdio::piped());
            let Ok(mut running) = command.spawn() else {
                assert_ne!(compiler, "cc", "a C compiler is needed");
                continue;
            };
            let input = running.stdin.take();
            input.expect("its input").write_all(text.as_bytes()).expect("read by the compiler");
            assert!(running.wait().expect("the compiler").success(), "{compiler}: {text}");
        }
    }
}
