//! The reference cases, with a table of the worst errors: `cargo test --release -p piola-tests reference`.
//!
//! Every case of all files is judged, in `f64` and, where its F is exact there, in `f32`, under [`Inversion::Refuse`], as a
//! single point and in batches of every back end (in `f32` those of a few energies): by C u (‖X*‖ + sens), ψ by
//! C u (|ψ*| + sens + Σ|terms|). What has no representation in a format cannot be returned there;
//! its status must then say so, and say so only then. The variable `PIOLA_CASES` names one other file of the same schema.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test with its own main and a table to show"
)]

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;
use std::process::ExitCode;

use piola::batch::{Batch, Energy, LengthError, Stages, Survey};
use piola::lanes::Backend;
use piola::material::{Declared, Status};
use piola::point::Matrix3;
use piola::point::project::Filter;
use piola::{Inversion, Real};
use piola_materials::{CATALOGUE, NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff, Visitor};
use piola_tests::cases::{Case, Quantity};
use piola_tests::compiled::{evaluate, evaluate_energy, evaluate_stress};
use piola_tests::declared;

/// The constant of the judgement ‖X − X*‖ ≤ C u (‖X*‖ + sens).
const C: f64 = 30.0;

/// The files of cases, beside their description.
const FILES: [&str; 3] =
    ["reference/cases.json", "reference/cases-more.json", "reference/cases-ordinary.json"];

/// Energies whose parameters are functions, which no file of cases can hold.
const WITHOUT_CASES: [&str; 1] = ["stretch_spline"];

fn main() -> ExitCode {
    // `cargo test NAME` passes the name to every test target; this one is its own only test.
    if std::env::args().skip(1).any(|argument| !argument.starts_with('-') && !"reference".contains(&argument))
    {
        return ExitCode::SUCCESS;
    }
    let cases = match std::env::var_os("PIOLA_CASES") {
        Some(file) => Case::read(Path::new(&file)),
        None => own_cases(),
    };
    match cases.and_then(|cases| run(&cases)) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// The cases of all files, which leave no energy of the catalogue out.
fn own_cases() -> Result<Vec<Case>, String> {
    let mut cases = Vec::new();
    for file in FILES {
        cases.extend(Case::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(file))?);
    }
    for entry in CATALOGUE {
        if !WITHOUT_CASES.contains(&entry.name) && cases.iter().all(|case| case.material != entry.name) {
            return Err(format!("{} has no reference cases", entry.name));
        }
    }
    Ok(cases)
}

/// The number of judgements that failed.
fn run(cases: &[Case]) -> Result<usize, String> {
    let mut declared: BTreeMap<&str, declared::Declared> = BTreeMap::new();
    let mut worst: BTreeMap<(&str, &str, Quantity), Worst> = BTreeMap::new();
    let (mut passed, mut flagged, mut failed) = (0, 0, Vec::new());
    for case in cases {
        let entry = piola_materials::find(&case.material)
            .ok_or_else(|| format!("{}: {} is not in the catalogue", case.id, case.material))?;
        let values = case.values(&entry.description)?;
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let declaration = match declared.entry(entry.name) {
            Entry::Occupied(found) => found.into_mut(),
            Entry::Vacant(vacant) => {
                let read = declared::Declared::read(&entry.description, &values, Inversion::Refuse)?;
                vacant.insert(read)
            }
        };
        let terms = declaration.energy_terms(&values, case.stretches()?);
        let judge = Judge { case, terms };
        let refused = |error| format!("{}: {} {error}", case.id, case.material);
        let mut judgements = entry.visit(&values, Inversion::Refuse, judge).map_err(refused)?;
        let elements = entry.elements(&values, Inversion::Refuse).map_err(refused)?;
        judgements.extend(judge.batches(&*elements, "f64 lanes", |value| value, |value| value));
        if case.f32_exact
            && let Some(elements) = in_single_precision(entry.name, &values).map_err(refused)?
        {
            judgements.extend(judge.batches(&*elements, "f32 lanes", |value| value as f32, f64::from));
        }
        for Judgement { precision, quantity, verdict } in judgements {
            let complaint = match verdict {
                Verdict::Error(error) => {
                    let entry = worst.entry((entry.name, precision, quantity)).or_default();
                    if error >= entry.error {
                        *entry = Worst { error, case: format!("{} {}", case.id, case.tag) };
                    }
                    (error > C).then(|| format!("{error:.1}"))
                }
                Verdict::Flagged => {
                    flagged += 1;
                    continue;
                }
                Verdict::Status(complaint) => Some(complaint.to_owned()),
            };
            match complaint {
                None => passed += 1,
                Some(complaint) => failed.push(format!(
                    "{} {} {precision} {} {quantity:?}: {complaint}",
                    case.id, case.material, case.tag
                )),
            }
        }
    }
    println!(
        "Worst errors in units of u (‖X‖ + sens), for ψ of u (|ψ| + sens + Σ|terms|); each may reach {C}.\n"
    );
    println!("{:21} {:9} {:10} {:>10}  case", "material", "", "quantity", "error");
    for ((material, precision, quantity), Worst { error, case }) in &worst {
        println!("{material:21} {precision:9} {:10} {error:10.3}  {case}", format!("{quantity:?}"));
    }
    for failure in &failed {
        println!("failed: {failure}");
    }
    println!(
        "\n{} cases of {} energies: {passed} results passed, {} failed;",
        cases.len(),
        declared.len(),
        failed.len()
    );
    println!("{flagged} more have no representation in their format, and their status says so");
    Ok(failed.len())
}

#[derive(Default)]
struct Worst {
    error: f64,
    case: String,
}

/// One result of one case.
struct Judgement {
    precision: &'static str,
    quantity: Quantity,
    verdict: Verdict,
}

enum Verdict {
    /// In units of what the arithmetic can reach.
    Error(f64),
    /// Beyond the format, and the status says so.
    Flagged,
    /// The status says something else than it should.
    Status(&'static str),
}

/// A few energies for batches in single precision: polynomial, logarithmic, with real powers, with a pole.
fn in_single_precision(
    name: &str,
    values: &[&[f64]],
) -> Result<Option<Box<dyn Energy<f32>>>, piola::material::Inadmissible> {
    fn boxed<M: Declared + 'static>(
        values: &[&[f64]],
    ) -> Result<Option<Box<dyn Energy<f32>>>, piola::material::Inadmissible> {
        Ok(Some(Box::new(M::from_values(values, Inversion::Refuse)?)))
    }
    match name {
        "st_venant_kirchhoff" => boxed::<StVenantKirchhoff>(values),
        "neo_hookean" => boxed::<NeoHookean>(values),
        "ogden" if values[0].len() == 3 => boxed::<Ogden<3>>(values),
        "rotated_linear" => boxed::<RotatedLinear>(values),
        _ => Ok(None),
    }
}

/// Evaluates one case in every precision that can hold its deformation gradient.
#[derive(Clone, Copy)]
struct Judge<'a> {
    case: &'a Case,
    /// Σ|terms| of ψ.
    terms: f64,
}

impl Visitor for Judge<'_> {
    type Output = Vec<Judgement>;

    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
        let mut judgements = self.judge(&material, "f64", |value: f64| value);
        if self.case.f32_exact {
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
    ) -> Vec<Judgement> {
        let f = self.case.deformation;
        let deformation: Matrix3<R> = [0, 1, 2].map(|i| [0, 1, 2].map(|j| R::splat(f[3 * i + j])));
        let (energy, of_energy) = evaluate_energy(material, &deformation);
        let (stress, of_stress) = evaluate_stress(material, &deformation);
        let plain = evaluate(material, &deformation, Filter::None);
        let clamped = evaluate(material, &deformation, Filter::Clamp);
        let wide = |values: &[R]| values.iter().map(|&x| widen(x)).collect::<Vec<_>>();
        let results = [
            (Quantity::Energy, of_energy, wide(&[energy])),
            (Quantity::Stress, of_stress, wide(stress.as_flattened())),
            (Quantity::Stress, plain.status, wide(plain.stress.as_flattened())),
            (Quantity::Tangent, plain.status, wide(plain.tangent.to_matrix().as_flattened())),
            (Quantity::Projected, clamped.status, wide(clamped.tangent.to_matrix().as_flattened())),
        ];
        self.verdicts(precision, R::UNIT_ROUNDOFF, |x| R::splat(x).is_finite(), results)
    }

    /// The same of a batch of one point, with every back end.
    fn batches<E: Stages>(
        self,
        energy: &dyn Energy<E>,
        precision: &'static str,
        narrow: fn(f64) -> E,
        widen: fn(E) -> f64,
    ) -> Vec<Judgement> {
        let f = self.case.deformation.map(narrow);
        let wide = |values: &[E]| values.iter().map(|&x| widen(x)).collect::<Vec<_>>();
        let status = |survey: Result<Survey, LengthError>| {
            let survey = survey.expect("the slices are of one point");
            Status {
                refused: survey.refused > 0,
                bounded: survey.bounded > 0,
                nonfinite: survey.nonfinite > 0,
            }
        };
        let judge = |backend| {
            let plain = Batch { backend, ..Batch::new(energy) };
            let clamped = Batch { filter: Filter::Clamp, ..plain };
            let zero = narrow(0.0);
            let (mut psi, mut stress) = ([zero], [zero; 9]);
            let (mut stress_beside, mut tangent, mut projected) = ([zero; 9], [zero; 81], [zero; 81]);
            let of_energy = status(plain.energies(&f, &mut psi));
            let of_stress = status(plain.stresses(&f, &mut stress));
            let of_clamped = status(clamped.tangents(&f, &mut stress_beside, &mut projected));
            let of_plain = status(plain.tangents(&f, &mut stress_beside, &mut tangent));
            let results = [
                (Quantity::Energy, of_energy, wide(&psi)),
                (Quantity::Stress, of_stress, wide(&stress)),
                (Quantity::Stress, of_plain, wide(&stress_beside)),
                (Quantity::Tangent, of_plain, wide(&tangent)),
                (Quantity::Projected, of_clamped, wide(&projected)),
            ];
            self.verdicts(precision, E::UNIT_ROUNDOFF, |x| widen(narrow(x)).is_finite(), results)
        };
        Backend::available().flat_map(judge).collect()
    }

    /// `holds` is whether the format has a finite number near one.
    fn verdicts(
        &self,
        precision: &'static str,
        unit_roundoff: f64,
        holds: impl Fn(f64) -> bool,
        results: [(Quantity, Status<bool>, Vec<f64>); 5],
    ) -> Vec<Judgement> {
        let leaves = |quantity| !self.case.reference(quantity).into_iter().all(&holds);
        // A point with a tangent computes the stress too, and its one status speaks for both.
        let point_leaves = leaves(Quantity::Stress) || leaves(Quantity::Tangent);
        let something_leaves =
            [leaves(Quantity::Energy), leaves(Quantity::Stress), point_leaves, point_leaves, point_leaves];
        let judgement =
            |((quantity, status, values), something_leaves): ((_, Status<bool>, Vec<f64>), bool)| {
                let verdict = match status {
                    Status { refused: true, .. } => Verdict::Status("refused, though inside the domain"),
                    Status { nonfinite: true, .. } if !something_leaves => {
                        Verdict::Status("flagged, though the format holds it")
                    }
                    Status { nonfinite, .. } if leaves(quantity) => {
                        if nonfinite {
                            Verdict::Flagged
                        } else {
                            Verdict::Status("not flagged as beyond the format")
                        }
                    }
                    _ => {
                        let noise = if quantity == Quantity::Energy { self.terms } else { 0.0 };
                        Verdict::Error(self.case.error(quantity, &values, noise, unit_roundoff))
                    }
                };
                Judgement { precision, quantity, verdict }
            };
        results.into_iter().zip(something_leaves).map(judgement).collect()
    }
}
