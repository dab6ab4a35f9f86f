//! Every energy is printed as C, which a C compiler reads without a warning.

use std::io::Write;
use std::process::{Command, Stdio};

use piola_declare::emit::{Emission, EmitError, PointFunction, Target};
use piola_tests::declarations::{Sample, slices};
use piola_tests::is_full;

const STRICT: [&str; 7] =
    ["-fsyntax-only", "-xc", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"];

/// `tests/emit.rs` judges those of the catalogue.
pub(crate) fn judge(sample: &Sample) {
    if sample.is_of_catalogue {
        return;
    }
    let Some(values) = sample.values().into_iter().next() else { return };
    for inversion in sample.judged.inversions(0.3) {
        let mut emission = Emission::new(Target::C).with_prefix("energy");
        if !is_full() {
            // By invariants and by a decomposition, and the energy as it is.
            emission = emission.with_functions([PointFunction::Tangent, PointFunction::Blocks]);
        }
        let text = match sample.judged.energy.emit(&slices(&values), inversion, &emission) {
            Ok(text) => text,
            Err(EmitError::Function(name)) => {
                assert!(sample.has_functions(), "{name} is a function");
                return;
            }
            Err(error) => panic!("{inversion:?}: {error}"),
        };
        let mut compiler =
            Command::new("cc").args(STRICT).arg("-").stdin(Stdio::piped()).spawn().expect("a C compiler");
        compiler.stdin.take().expect("its input").write_all(text.as_bytes()).expect("read by the compiler");
        assert!(compiler.wait().expect("a C compiler").success(), "{text}");
    }
}
