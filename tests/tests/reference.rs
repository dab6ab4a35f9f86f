//! The reference cases, with a table of the worst errors: `cargo test --release -p piola-tests reference`.
//!
//! The variable `PIOLA_CASES` names another file of the same schema.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test with its own main and a table to show"
)]

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use piola::material::Declared;
use piola::point::project::Filter;
use piola::point::{self, Matrix3};
use piola::{Inversion, Real};
use piola_materials::Visitor;
use piola_tests::cases::{Case, Quantity};

/// The constant of the judgement ‖X − X*‖ ≤ C u (‖X*‖ + sens).
const C: f64 = 30.0;

fn main() -> ExitCode {
    // `cargo test NAME` passes the name to every test target; this one is its own only test.
    if std::env::args().skip(1).any(|argument| !argument.starts_with('-') && !"reference".contains(&argument))
    {
        return ExitCode::SUCCESS;
    }
    let file = std::env::var_os("PIOLA_CASES").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/reference/cases.json")),
        PathBuf::from,
    );
    match run(&file) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// The number of judgements that failed.
fn run(file: &std::path::Path) -> Result<usize, String> {
    let cases = Case::read(file)?;
    let mut worst: BTreeMap<(&str, &str, Quantity), Worst> = BTreeMap::new();
    let mut skipped: BTreeMap<&str, usize> = BTreeMap::new();
    let (mut passed, mut failed) = (0, Vec::new());
    for case in &cases {
        let Some(entry) = piola_materials::find(&case.material) else {
            *skipped.entry(&case.material).or_default() += 1;
            continue;
        };
        let values = case.values(&entry.description)?;
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let judgements = entry
            .visit(&values, Inversion::Refuse, Judge(case))
            .map_err(|error| format!("{}: {} {error}", case.id, case.material))?;
        for (precision, quantity, error) in judgements {
            let entry = worst.entry((entry.name, precision, quantity)).or_default();
            if error >= entry.error {
                *entry = Worst { error, case: format!("{} {}", case.id, case.tag) };
            }
            if error <= C {
                passed += 1;
            } else {
                failed.push(format!(
                    "{} {} {precision} {} {quantity:?}: {error:.1}",
                    case.id, case.material, case.tag
                ));
            }
        }
    }
    println!(
        "Worst errors in units of u (‖X‖ + sens), for ψ of u (|ψ| + sens + 2μ + λ); each may reach {C}.\n"
    );
    println!("{:20} {:4} {:10} {:>10}  case", "material", "", "quantity", "error");
    for ((material, precision, quantity), Worst { error, case }) in &worst {
        println!("{material:20} {precision:4} {:10} {error:10.3}  {case}", format!("{quantity:?}"));
    }
    if !skipped.is_empty() {
        let total: usize = skipped.values().sum();
        let names: Vec<_> = skipped.iter().map(|(name, count)| format!("{name} ({count})")).collect();
        println!("\n{total} cases of materials outside the catalogue were skipped: {}", names.join(", "));
    }
    for failure in &failed {
        println!("failed: {failure}");
    }
    println!("\n{passed} passed, {} failed", failed.len());
    Ok(failed.len())
}

#[derive(Default)]
struct Worst {
    error: f64,
    case: String,
}

/// Evaluates one case in every precision that can hold its deformation gradient.
struct Judge<'a>(&'a Case);

impl Visitor for Judge<'_> {
    type Output = Vec<(&'static str, Quantity, f64)>;

    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
        let mut judgements = self.judge(&material, "f64", |value: f64| value);
        if self.0.f32_exact {
            judgements.extend(self.judge(&material, "f32", |value: f32| f64::from(value)));
        }
        judgements
    }
}

impl Judge<'_> {
    fn judge<M: Declared, R: Real<Mask = bool>>(
        &self,
        material: &M,
        precision: &'static str,
        widen: fn(R) -> f64,
    ) -> Vec<(&'static str, Quantity, f64)> {
        let f = self.0.deformation;
        let deformation: Matrix3<R> = [0, 1, 2].map(|i| [0, 1, 2].map(|j| R::splat(f[3 * i + j])));
        let (energy, energy_status) = point::evaluate_energy(material, &deformation);
        let plain = point::evaluate(material, &deformation, Filter::None);
        let clamped = point::evaluate(material, &deformation, Filter::Clamp);
        let flat = |rows: &[[R; 9]; 9]| rows.iter().flatten().map(|&x| widen(x)).collect::<Vec<_>>();
        let results = [
            (Quantity::Energy, vec![widen(energy)]),
            (Quantity::Stress, plain.stress.iter().flatten().map(|&x| widen(x)).collect()),
            (Quantity::Tangent, flat(&plain.tangent.to_matrix())),
            (Quantity::Projected, flat(&clamped.tangent.to_matrix())),
        ];
        // What has no representation in this precision cannot be returned, but the status must say so, and only then.
        let leaves_range =
            |quantity| !self.0.reference(quantity).into_iter().all(|value| R::splat(value).is_finite());
        // ψ has a status of its own; P and dP/dF share theirs.
        let shared = [Quantity::Stress, Quantity::Tangent, Quantity::Projected];
        let status_of = |quantity| match quantity {
            Quantity::Energy => (energy_status, leaves_range(quantity)),
            _ => (plain.status, shared.into_iter().any(leaves_range)),
        };
        let moduli = material.moduli();
        let error = |(quantity, values): (Quantity, Vec<f64>)| {
            // At rest the terms of an energy are of the size of its moduli and cancel.
            let noise =
                if quantity == Quantity::Energy { 2.0 * moduli.mu + moduli.lambda.abs() } else { 0.0 };
            let (status, may_be_nonfinite) = status_of(quantity);
            let error = if status.refused || status.nonfinite && !may_be_nonfinite {
                f64::INFINITY
            } else if leaves_range(quantity) {
                if status.nonfinite { 0.0 } else { f64::INFINITY }
            } else {
                self.0.error(quantity, &values, noise, R::UNIT_ROUNDOFF)
            };
            (precision, quantity, error)
        };
        results.map(error).to_vec()
    }
}
