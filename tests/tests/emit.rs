//! Energies as C: their results, compiled by a C compiler, have the bits of scalars here.
//!
//! The energies cover polynomials, logarithms, exponentials, real powers in lists, a pole, a locking domain
//! and continuations; deformation gradients are those of all reference cases. That compilers read every other
//! energy is judged by the test `declarations`. The text for CUDA is C as well and has the same bits; other
//! languages are judged by `PIOLA_EMITTED` in the test `reference`.
//! Text in `f32` is judged with the feature `full`, which compiles elements in `f32`.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use piola::__private::record::{evaluate_tetrahedron, evaluate_vertex};
use piola::batch::{Batch, Kernels, Tetrahedra};
use piola::lanes::Backend;
use piola::point::{self, Filter, Matrix3};
use piola::{Inversion, Material, Status};
use piola_declare::emit::{Emission, EmitError, PointFunction, Precision, Target};
use piola_tests::cases::{Case, FILES};
use piola_tests::compiled;
use piola_tests::emitted::bytes;
use piola_tests::energies::{Format, Judged, find};

const STRICT: [&str; 6] = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-ffp-contract=off"];

/// A program that applies all functions of `energy.h` to the deformation gradients of a file.
const PROGRAM: &str = include_str!("../emitted/functions.c");

/// A program that prints the result of the check, then the status and P12 at an F, and 4 for one with NaN.
const TELLTALE: &str = include_str!("../emitted/telltale.c");

/// Dm⁻¹ and the volume of a tetrahedron.
const REST: [f64; 10] = [1.25, -0.5, 0.25, 0.0, 0.75, -0.125, 0.5, 0.25, 1.5, 0.375];

/// The format of texts for a number.
fn precision<R: Format>() -> Precision {
    R::NAME.parse().expect("a format of texts")
}

/// Results at a point: their bytes, and which of them mean nothing.
fn results<R: Format + Kernels>(energy: &Judged, inversion: Inversion, F: &Matrix3<R>) -> Vec<(Vec<R>, u32)> {
    let values = energy.typical();
    let subject = energy.subject(&values, inversion).expect("typical parameters");
    let material = R::of(&subject);
    let bits = |status: Status| {
        u32::from(status.refused)
            | u32::from(status.bounded) << 1
            | u32::from(status.nonfinite) << 2
            | u32::from(status.filtered) << 3
    };
    let at = compiled::evaluate_energy(material, F);
    let mut all = vec![(vec![at.energy], bits(at.status))];
    let at = compiled::evaluate_stress(material, F);
    all.push((at.stress.as_flattened().to_vec(), bits(at.status)));
    for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
        let at = point::evaluate_dense(material, F, filter);
        all.push(([at.stress.as_flattened(), at.tangent.as_flattened()].concat(), bits(at.status)));
    }
    let finite = |numbers: &[R]| numbers.iter().all(|number| number.is_finite());
    let svd = point::svd(F);
    let numbers = [svd.U.as_flattened(), &svd.stretches, svd.V.as_flattened()].concat();
    all.push((numbers, if finite(&svd.stretches) { 0 } else { 4 }));
    let blocks = subject.exact.blocks(svd.stretches);
    let numbers = [&blocks.gradient[..], &blocks.hessian, &blocks.flip, &blocks.twist].concat();
    let refused = u32::from(!subject.exact.admits(svd.stretches));
    let nonfinite = if finite(&numbers) { 0 } else { 4 };
    all.push((numbers, refused | nonfinite));
    let zero = R::splat(0.0);
    let [[f11, f12, f13], [f21, f22, f23], [f31, f32, f33]] = *F;
    let positions = [[zero; 3], [f11, f21, f31], [f12, f22, f32], [f13, f23, f33]];
    let tetrahedra = Tetrahedra::new(4, &[[0, 1, 2, 3]]).expect("four nodes");
    let rest = REST.map(R::splat);
    for filter in [Filter::None, Filter::Clamp] {
        let batch = Batch::new(&subject.exact).with_backend(Backend::portable()).with_filter(filter);
        let (mut gradient, mut stiffness) = (vec![zero; 12], [zero; 144]);
        let survey = batch.stiffnesses_at(tetrahedra, &positions, &rest, &mut gradient, &mut stiffness);
        let survey = survey.expect("one tetrahedron");
        let counts = [survey.refused, survey.bounded, survey.nonfinite, survey.filtered];
        gradient.extend(stiffness);
        all.push((gradient, (0..4).map(|k| (counts[k] as u32) << k).sum()));
    }
    let node = [REST[3], REST[4], REST[5], REST[9]].map(R::splat);
    for filter in [Filter::None, Filter::Clamp] {
        let (gradient, stiffness, status) = evaluate_vertex(&subject.exact, F, node, filter);
        all.push(([&gradient[..], stiffness.as_flattened()].concat(), bits(status)));
    }
    all
}

/// Compiles with the C compiler that Rust links with.
fn compile(folder: &Path, arguments: &[&str]) {
    let output = Command::new("cc").args(STRICT).args(arguments).current_dir(folder).output();
    let output = output.expect("a compiler");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn print<R: Format>(energy: &Judged, target: Target, inversion: Inversion) -> Result<String, EmitError> {
    let (prefix, precision) = (Some("energy".into()), precision::<R>());
    let emission = Emission { prefix, precision, ..Emission::new(target) };
    energy.energy.emit(&energy.typical(), inversion, &emission)
}

fn check<R: Format + Kernels>(name: &str, target: Target) {
    let precision = precision::<R>();
    let (in_c, level) = if precision == Precision::F64 { ("double", "-O1") } else { ("float", "-O0") };
    let energy = find(name).expect("in the catalogue");
    let folder = tempfile::tempdir().expect("a folder");
    let cases = Case::own(&FILES).expect("reference cases");
    assert_eq!(cases.len(), 1213);
    let points: Vec<Matrix3<R>> = cases.iter().map(Case::F).collect();
    for inversion in energy.inversions(0.1) {
        let text = print::<R>(energy, target, inversion).expect("an energy that can be printed");
        std::fs::write(folder.path().join("energy.h"), text).expect("a file");
        let rest = format!("{REST:?}").replace('[', "{").replace(']', "}");
        let program = PROGRAM.replace("NUMBER", in_c).replace("REST", &rest);
        std::fs::write(folder.path().join("main.c"), program).expect("a file");
        let numbers = points.as_flattened().as_flattened().iter().map(|number| number.widen());
        std::fs::write(folder.path().join("points"), bytes(numbers, precision)).expect("a file");
        compile(folder.path(), &["-std=c99", level, "main.c", "-lm", "-o", "main"]);
        let status = Command::new(folder.path().join("main")).current_dir(folder.path()).status();
        assert!(status.expect("the program").success());

        let found = std::fs::read(folder.path().join("results")).expect("results");
        let mut found = &found[..];
        let mut different = String::new();
        for F in &points {
            for (function, (numbers, status)) in results(energy, inversion, F).into_iter().enumerate() {
                let wanted = bytes(numbers.into_iter().map(R::widen), precision);
                let (results, rest) = found.split_at(wanted.len());
                let (word, rest) = rest.split_at(4);
                found = rest;
                let means_something = status & 5 == 0;
                if word != status.to_ne_bytes() || means_something && results != wanted {
                    let _ = writeln!(different, "function {function} at {F:?}: {word:?} and not {status}");
                }
            }
        }
        assert!(
            found.is_empty() && different.is_empty(),
            "{name} in {}, {inversion:?}:\n{different}",
            R::NAME
        );
    }
}

macro_rules! same_bits {
    ($($energy:ident)*) => {$(
        // Where scalars fuse products and sums, the compiler of C does so elsewhere.
        #[cfg(not(any(target_feature = "fma", target_arch = "aarch64")))]
        #[test]
        fn $energy() {
            check::<f64>(stringify!($energy), Target::C);
            #[cfg(feature = "full")]
            check::<f32>(stringify!($energy), Target::C);
        }
    )*};
}
#[cfg(not(any(target_feature = "fma", target_arch = "aarch64")))]
#[test]
fn text_for_cuda_has_the_bits_of_c() {
    check::<f64>("hencky", Target::Cuda);
    #[cfg(feature = "full")]
    check::<f32>("stable_neo_hookean", Target::Cuda);
}

same_bits! { neo_hookean st_venant_kirchhoff ogden hencky gent fung rotated_linear stable_neo_hookean }

/// With any option of a compiler a file is right, or refused: when it is compiled, or by its check.
#[test]
fn no_option_of_a_compiler_changes_results_in_silence() {
    // P12 by mpmath.
    const RIGHT: &str = "0 0 -206512.206 4";
    let folder = tempfile::tempdir().expect("a folder");
    let ogden = find("ogden").expect("in the catalogue");
    let (prefix, functions) = (Some("energy".into()), vec![PointFunction::Stress]);
    let emission = Emission { prefix, functions, ..Emission::new(Target::C) };
    let text = ogden.energy.emit(&ogden.typical(), Inversion::Refuse, &emission).expect("text");
    std::fs::write(folder.path().join("energy.h"), text).expect("a file");
    std::fs::write(folder.path().join("main.c"), TELLTALE).expect("a file");
    // As if the compiler had none of these macros, and no pragma.
    let removed =
        "-U__FAST_MATH__ -U__ASSOCIATIVE_MATH__ -U__RECIPROCAL_MATH__ -U__FINITE_MATH_ONLY__ -U__clang__";
    for compiler in ["gcc", "clang", "icx"] {
        for options in [
            "-O1",
            "-O2 -march=native",
            "-O2 -freciprocal-math",
            "-O2 -funsafe-math-optimizations",
            "-O2 -funsafe-math-optimizations -march=native",
            "-O2 -ffast-math -fno-finite-math-only",
            "-O2 -fassociative-math -fno-signed-zeros -fno-trapping-math",
            "-O2 -ffinite-math-only",
            "-Ofast",
        ] {
            for undefined in ["", removed] {
                let line = format!("{compiler} {options} {undefined} main.c -lm -o main && ./main");
                let output = Command::new("sh").args(["-c", &line]).current_dir(&folder).output();
                let output = output.expect("a shell");
                if output.status.code() == Some(127) {
                    continue;
                }
                let [found, messages] =
                    [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
                let is_exact = compiler != "icx" && !options.contains("-f") && options != "-Ofast";
                let is_refused = found.starts_with("1 ") || messages.contains("compile without -ffast-math");
                let is_well = found == RIGHT || is_refused && !is_exact;
                assert!(is_well, "{line}: {found}{messages}");
            }
        }
    }
}

#[test]
fn mistakes_say_what_to_do() {
    let energy = find("neo_hookean").expect("in the catalogue");
    let emit = |emission: Emission| {
        let result = energy.energy.emit(&energy.typical(), Inversion::Refuse, &emission);
        result.expect_err("a mistake").to_string()
    };
    let first = Emission { prefix: Some("1st".into()), ..Emission::new(Target::C) };
    assert!(emit(first).starts_with("`1st` is not a name"));
    let nothing = Emission { functions: Vec::new(), ..Emission::new(Target::C) };
    assert!(emit(nothing).contains("energy, stress, tangent"));
    let unknown = |word: &str| word.parse::<PointFunction>().expect_err("unknown").to_string();
    assert_eq!(
        unknown("forces"),
        "unknown function `forces`; known are: energy, stress, tangent, projected, absolute, tetrahedron, \
         projected_tetrahedron, vertex, projected_vertex, blocks, svd"
    );
    assert!("fortran".parse::<Target>().expect_err("unknown").to_string().contains("known are: c"));
    let double = emit(Emission { precision: Precision::F64, ..Emission::new(Target::Wgsl) });
    assert!(double.contains("choose the precision f32"), "{double}");
    assert!("f16".parse::<Precision>().expect_err("unknown").to_string().contains("f32, f64"));
}

/// Every parameter in turn out of its bounds: the check of the file and the constructor agree.
#[test]
fn a_file_checks_parameters_as_the_constructor_does() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, inversion) in [
        ("gent", Inversion::Refuse),
        ("ogden", Inversion::Extend { epsilon: 0.1 }),
        ("neo_hookean", Inversion::Refuse),
        ("fung", Inversion::Refuse),
    ] {
        let energy = find(name).expect("in the catalogue");
        let typical: Vec<Vec<f64>> = energy.typical().iter().map(|list| list.to_vec()).collect();
        let mut all = vec![typical.clone()];
        for (k, list) in typical.iter().enumerate() {
            for entry in 0..list.len() {
                for other in [0.0, -list[entry], 1e150, f64::NAN, f64::INFINITY] {
                    let mut changed = typical.clone();
                    changed[k][entry] = other;
                    all.push(changed);
                }
            }
        }
        let number = |x: &f64| format!("{x:?}").replace("inf", "INFINITY").replace("NaN", "NAN");
        let in_c = |values: &Vec<Vec<f64>>| {
            let lists = values.iter().map(|list| list.iter().map(number).collect::<Vec<_>>().join(", "));
            let is_list = |k: usize| energy.description().parameters[k].is_list();
            let lists =
                lists.enumerate().map(|(k, list)| if is_list(k) { format!("{{{list}}}") } else { list });
            format!("{{{}}}", lists.collect::<Vec<_>>().join(", "))
        };
        let sets = all.iter().map(in_c).collect::<Vec<_>>().join(",\n");
        let text = print::<f64>(energy, Target::C, inversion).expect("an energy that can be printed");
        std::fs::write(folder.path().join("energy.h"), text).expect("a file");
        let program = format!(
            "#include \"energy.h\"\n#include <stdio.h>\nint main(void) {{\nstatic const energy_parameters all[] = {{\n{sets}}};\n\
             for (unsigned k = 0; k < {}; k++) printf(\"%u\\n\", energy_check(all + k));\nreturn 0;\n}}\n",
            all.len()
        );
        std::fs::write(folder.path().join("main.c"), program).expect("a file");
        compile(folder.path(), &["-std=c99", "-O0", "main.c", "-lm", "-o", "main"]);
        let output = Command::new(folder.path().join("main")).output().expect("the program");
        let found = String::from_utf8(output.stdout).expect("text");
        assert_eq!(found.lines().count(), all.len());
        let mut refused = 0;
        for (values, found) in all.iter().zip(found.lines()) {
            let lists: Vec<_> = values.iter().map(Vec::as_slice).collect();
            let built = energy.energy.material(&lists, inversion);
            assert_eq!(found == "0", built.is_ok(), "{name} with {values:?}: {found}, {:?}", built.err());
            refused += usize::from(found != "0");
        }
        assert!(refused > 2, "{name}: {refused}");
    }
}

/// A computation that only one branch needs is inside that branch: a point at which invariants suffice is not
/// decomposed.
#[test]
fn branches_hold_what_only_they_need() {
    let energy = find("neo_hookean").expect("in the catalogue");
    for function in [PointFunction::Stress, PointFunction::Tangent] {
        let (prefix, functions) = (Some("energy".into()), vec![function]);
        let emission = Emission { prefix, functions, ..Emission::new(Target::C) };
        let text = energy.energy.emit(&energy.typical(), Inversion::Refuse, &emission).expect("text");
        let (_, body) = text.split_once(&format!("energy_{}(const", function.name())).expect("the function");
        let (body, _) = body.split_once("\n}\n").expect("its end");
        let is_call = |line: &&str| ["energy_", "piola_f64_"].iter().any(|prefix| line.contains(prefix));
        let calls = body.lines().skip(1).filter(is_call);
        let (served, others): (Vec<_>, Vec<_>) = calls.partition(|line| line.contains("invariants"));
        assert!(served.len() > 2 && others.len() > 3, "{function:?}: {served:?} {others:?}");
        assert!(others.iter().all(|line| line.starts_with("        ")), "{function:?}: {others:?}");
    }
}

/// Gradient and stiffness of one node are the same parts of those of the whole tetrahedron.
#[test]
fn a_vertex_is_a_part_of_its_tetrahedron() {
    let cases = Case::own(&FILES).expect("reference cases");
    let mut points: Vec<Matrix3<f64>> = cases.iter().map(Case::F).collect();
    // Next to the pole of a twist quotient, which is bounded there.
    points.extend([1e-5, 1e-12].map(|gap| [[10.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, gap - 1.0]]));
    const KINKED: [&str; 2] = ["rotated_linear", "arap"];
    for name in
        ["neo_hookean", "st_venant_kirchhoff", "ogden", "stable_neo_hookean"].into_iter().chain(KINKED)
    {
        let energy = find(name).expect("in the catalogue");
        let subject = energy.subject(&energy.typical(), Inversion::Refuse).expect("typical parameters");
        // Dm is the identity, so that the columns of F are the positions of the nodes. The stiffness between
        // nodes 1 to 3 has the norm of its terms, at most 9 times the largest entry. Forces are sums of three
        // numbers. The errors are about four roundings of the terms.
        let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0; 3]];
        let rest = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.375];
        let (mut judged, mut bounded) = (0, 0);
        for F in &points {
            let [[a, b, c], [d, e, f], [g, h, i]] = *F;
            let positions = [[0.0; 3], [a, d, g], [b, e, h], [c, f, i]];
            let (forces, whole, of_whole) =
                evaluate_tetrahedron(&subject.exact, positions, rest, Filter::Clamp);
            let largest = |numbers: &[f64]| numbers.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
            let bounds =
                [3.0 * largest(&forces), 9.0 * largest(&whole)].map(|size| 2.0 * f64::EPSILON * size);
            for node in 0..4 {
                let [g1, g2, g3] = rows[(node + 3) % 4];
                let (force, part, status) =
                    evaluate_vertex(&subject.exact, F, [g1, g2, g3, rest[9]], Filter::Clamp);
                let [found, wanted] = [status, of_whole].map(|one| (one.refused, one.bounded, one.filtered));
                assert_eq!(found, wanted, "{name} at {F:?}");
                if status.refused || status.nonfinite || of_whole.nonfinite {
                    continue;
                }
                (judged, bounded) = (judged + 1, bounded + usize::from(status.bounded));
                for a in 0..3 {
                    let force = (force[a] - forces[3 * node + a]).abs();
                    let row = 12 * (3 * node + a) + 3 * node;
                    let stiffness = (0..3).map(|c| (part[a][c] - whole[row + c]).abs()).fold(0.0, f64::max);
                    assert!(force <= bounds[0] && stiffness <= bounds[1], "{name} at {F:?}: {stiffness}");
                }
            }
        }
        assert!(judged > 4000 && (bounded > 0) == KINKED.contains(&name), "{name}: {judged}, {bounded}");
    }
}

/// The text that `docs/emit.md` shows.
#[test]
fn the_page_shows_a_file_as_it_is() {
    let energy = find("st_venant_kirchhoff").expect("in the catalogue");
    let functions = vec![PointFunction::Stress, PointFunction::Projected];
    let emission = Emission { prefix: Some("stvk".into()), functions, ..Emission::new(Target::C) };
    let text = energy.energy.emit(&energy.typical(), Inversion::Refuse, &emission).expect("text");
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/emit.md"));
    let page = page.expect("the page");
    let (shared, own) = text.split_at(text.find("typedef struct").expect("the parameters"));
    for part in [shared, own] {
        assert!(page.contains(part.trim_end()), "docs/emit.md shows another text than:\n{part}");
    }
}

#[test]
fn no_text_of_a_declaration_leaves_its_comment() {
    let folder = tempfile::tempdir().expect("a folder");
    let declared = r#"
        /// Of */ int x; /* and a*\lambda, \* and ??/
        #[material(domain(J > 0.0), admissible(-(-float) > 0.0))]
        fn Hostile(
            [l1, l2, l3]: [f64; 3],
            /// Pa, *\ ??/ {example}
            float: f64,
            float_: f64,
            é: f64,
            ue9: f64,
            I: f64,
            void: Vec<f64>,
        ) -> f64 {
            float / 2.0 * (I1 - 3.0) - float * J.ln() + (float_ + é + ue9 + I) / 2.0 * J.ln().powi(2)
                + sum(|p| void[p] * J.ln().powi(2))
        }
    "#;
    let energy = piola_declare::Energy::from_rust(declared).expect("an energy");
    let emit = |void: &[f64], precision| {
        let emission = Emission { precision, ..Emission::new(Target::C) };
        energy.emit(&[&[1e6], &[1e6], &[0.0], &[0.0], &[0.0], void], Inversion::Refuse, &emission)
    };
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    let text = emit(&[], Precision::F64).expect("text");
    assert!(text.contains("hostile_stress"), "the name in lower case");
    assert!(text.contains("{example}"), "the words of a template are text");
    write("one.h", &text);
    write("other.h", &emit(&[1.0], Precision::F64).expect("text"));
    // The first header defines `I`.
    let included = "#include <complex.h>\n#include \"one.h\"\n#include \"one.h\"\n";
    write("main.c", &format!("{included}int main(void) {{ return 0; }}\n"));
    compile(folder.path(), &["-std=c99", "-fsyntax-only", "main.c"]);
    // Two files of one prefix would hide each other.
    write("both.c", "#include \"one.h\"\n#include \"other.h\"\nint main(void) { return 0; }\n");
    let both = Command::new("cc").args(["-fsyntax-only", "both.c"]).current_dir(folder.path()).output();
    assert!(String::from_utf8_lossy(&both.expect("cc").stderr).contains("give one of them another name"));
    // Beyond the numbers of `f32`.
    assert!(matches!(emit(&[1e39], Precision::F32), Err(EmitError::Parameters(_))));
}
