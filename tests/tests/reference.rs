//! The reference cases, with a table of the worst errors: `cargo test -p piola-tests --test reference`, with
//! `-- NAME` those of the energies whose names contain it.
//!
//! Every case of all files is judged, in `f64` and, where its F is exact there, in `f32`, under
//! [`Inversion::Refuse`], as a single point and in batches of every back end (in `f32` those of a few
//! energies, with the feature `full`): by C u (‖X*‖ + sens), ψ by C u (|ψ*| + sens + Σ|terms|). What has no
//! representation in a format cannot be returned there; its status must then say so, and say so only then.
//! With `PIOLA_EMITTED` the results are those of emitted source text ([`piola_tests::emitted`]):
//! `PIOLA_EMITTED="wgsl f32 PROGRAM"`.

#![expect(clippy::print_stdout, reason = "a table to show")]

use std::collections::BTreeMap;

use piola::batch::{Batch, Kernels, TileMaterial};
use piola::lanes::Backend;
use piola::point::{EnergyPoint, Filter, StressPoint, evaluate_dense};
use piola::{Inversion, Real, Status};
use piola_declare::emit::Precision;
use piola_tests::answers::Answers;
use piola_tests::cases::{Case, FILES, Quantity};
use piola_tests::compiled::{evaluate, evaluate_energy, evaluate_stress};
use piola_tests::declarations::slices;
use piola_tests::declared::Declared;
use piola_tests::emitted::{Answer, Runner};
use piola_tests::energies::{self, ENERGIES, Format, Subject, find, is_asked_for};
use rayon::prelude::*;

/// The constant of the judgement ‖X − X*‖ ≤ C u (‖X*‖ + sens).
const C: f64 = 30.0;

/// Energies whose parameters are functions, which no file of cases can hold.
const WITHOUT_CASES: [&str; 1] = ["stretch_spline"];

fn main() {
    judge_all().unwrap_or_else(|error| panic!("{error}"));
}

/// Judges the cases of each energy and prints the table.
///
/// # Errors
/// The results that fail, one in each line, or why a case cannot be judged.
fn judge_all() -> Result<(), String> {
    let runner = Runner::from_environment()?;
    let mut by_energy: BTreeMap<String, Vec<Case>> = BTreeMap::new();
    for case in all_cases()? {
        by_energy.entry(case.material.clone()).or_default().push(case);
    }
    by_energy.retain(|name, _| is_asked_for(name));
    let energies = by_energy.len();
    let judged: Result<Vec<_>, String> =
        by_energy.into_par_iter().map(|(name, cases)| judge_energy(&name, cases, runner.as_ref())).collect();
    let mut table = Table::default();
    judged?.into_iter().flatten().for_each(|of_case| table.add(of_case));
    table.print(energies);
    if table.failures.is_empty() { Ok(()) } else { Err(table.failures.join("\n")) }
}

/// The cases of all files, which leave no energy of the catalogue out.
fn all_cases() -> Result<Vec<Case>, String> {
    let cases = Case::own(&FILES)?;
    for energy in ENERGIES.iter() {
        if !WITHOUT_CASES.contains(&energy.name) && cases.iter().all(|case| case.material != energy.name) {
            return Err(format!("{} has no reference cases", energy.name));
        }
    }
    Ok(cases)
}

/// A case of an energy, and its results.
type Judged = (&'static str, Case, Vec<Judgement>);

fn judge_energy(name: &str, mut cases: Vec<Case>, runner: Option<&Runner>) -> Result<Vec<Judged>, String> {
    let energy = find(name).ok_or_else(|| format!("{name} is not in the catalogue"))?;
    if runner.is_some_and(|runner| runner.precision == Precision::F32) {
        cases.retain(|case| case.f32_exact);
    }
    let first = cases.first().ok_or_else(|| format!("{name} has no reference cases"))?;
    let values = first.values(energy.description())?;
    let declared = Declared::read(energy.energy.text(), &slices(&values), Inversion::Refuse)?;
    let mut answers = runner.map(|runner| runner.answers(energy, &cases)).transpose()?.map(Vec::into_iter);
    let judge = |case: Case| {
        let values = case.values(energy.description())?;
        let terms = declared.energy_terms(&slices(&values), case.stretches()?);
        let judge = Judge { case: &case, terms };
        let judgements = match (runner, answers.as_mut().and_then(Iterator::next)) {
            (Some(runner), Some(answer)) => judge.answer(runner.precision, answer),
            _ => judge.subject(energy, &slices(&values))?,
        };
        Ok((energy.name, case, judgements))
    };
    cases.into_iter().map(judge).collect()
}

/// Counts and worst errors of results.
#[derive(Default)]
struct Table {
    cases: usize,
    passed: usize,
    flagged: usize,
    /// The results that fail, each with what is wrong with it.
    failures: Vec<String>,
    /// The largest error of each energy, format and quantity, with its case.
    worst: BTreeMap<(&'static str, &'static str, Quantity), (f64, String)>,
}

impl Table {
    fn add(&mut self, (energy, case, judgements): Judged) {
        let Case { id, tag, .. } = &case;
        self.cases += 1;
        for Judgement { precision, quantity, verdict } in judgements {
            if let Ok(Some(error)) = verdict {
                let worst = self.worst.entry((energy, precision, quantity)).or_default();
                if error >= worst.0 {
                    *worst = (error, format!("{id} {tag}"));
                }
            }
            let complaint = match verdict {
                Ok(None) => {
                    self.flagged += 1;
                    continue;
                }
                Ok(Some(error)) if error <= C => {
                    self.passed += 1;
                    continue;
                }
                // A NaN is not an error within the bound.
                Ok(Some(error)) => format!("{error:.1}"),
                Err(complaint) => complaint.to_owned(),
            };
            self.failures.push(format!("{id} {energy} {precision} {tag} {quantity:?}: {complaint}"));
        }
    }

    fn print(&self, energies: usize) {
        println!(
            "Worst errors in units of u (‖X‖ + sens), for ψ of u (|ψ| + sens + Σ|terms|); each may reach {C}.\n"
        );
        println!("{:21} {:9} {:10} {:>10}  case", "material", "", "quantity", "error");
        for ((material, precision, quantity), (error, case)) in &self.worst {
            println!("{material:21} {precision:9} {:10} {error:10.3}  {case}", format!("{quantity:?}"));
        }
        let Self { cases, passed, flagged, failures, .. } = self;
        let failed = failures.len();
        println!("\n{cases} cases of {energies} energies: {passed} results passed, {failed} failed;");
        println!("{flagged} more have no representation in their format, and their status says so");
    }
}

struct Judgement {
    precision: &'static str,
    quantity: Quantity,
    /// The error in units of what the arithmetic can reach, none if the result is beyond the format and its
    /// status says so; or what is wrong with the status.
    verdict: Result<Option<f64>, &'static str>,
}

/// Evaluates one case in every precision that can hold its deformation gradient.
#[derive(Clone, Copy)]
struct Judge<'a> {
    case: &'a Case,
    /// Σ|terms| of ψ.
    terms: f64,
}

impl Judge<'_> {
    /// Judges the energy as it is here, in all its formats.
    fn subject(self, energy: &energies::Judged, values: &[&[f64]]) -> Result<Vec<Judgement>, String> {
        let subject = energy
            .subject(values, Inversion::Refuse)
            .map_err(|error| format!("{}: {} {error}", self.case.id, energy.name))?;
        let mut judgements = self.points::<f64>(&subject);
        judgements.extend(self.batches::<f64>(&*subject.double, "f64 lanes"));
        if self.case.f32_exact {
            judgements.extend(self.points::<f32>(&subject));
            // A polynomial, a logarithm, a pole and real powers. Compiled, these have the same bits at the
            // points of `interpreted.rs`.
            #[cfg(feature = "full")]
            if ["st_venant_kirchhoff", "neo_hookean", "rotated_linear"].contains(&energy.name)
                || energy.name == "ogden" && values[0].len() == 3
            {
                judgements.extend(self.batches::<f32>(&subject.exact, "f32 lanes"));
            }
        }
        Ok(judgements)
    }

    /// Judges what a program has answered.
    fn answer(self, precision: Precision, answer: Answer) -> Vec<Judgement> {
        let (name, unit_roundoff, holds): (_, _, fn(f64) -> bool) = match precision {
            Precision::F64 => ("f64", f64::UNIT_ROUNDOFF, f64::is_finite),
            Precision::F32 => ("f32", f32::UNIT_ROUNDOFF, |x| (x as f32).is_finite()),
        };
        let [(energy, of_energy), (stress, of_stress), (plain, of_plain), (clamped, of_clamped)] = answer;
        let results = [
            (Quantity::Energy, of_energy, energy),
            (Quantity::Stress, of_stress, stress),
            (Quantity::Stress, of_plain, plain[..9].to_vec()),
            (Quantity::Tangent, of_plain, plain[9..].to_vec()),
            (Quantity::Projected, of_clamped, clamped[9..].to_vec()),
        ];
        self.verdicts(name, unit_roundoff, holds, results)
    }

    fn points<R: Format>(self, subject: &Subject) -> Vec<Judgement> {
        let material = R::of(subject);
        let deformation = self.case.F::<R>();
        let EnergyPoint { energy, status: of_energy } = evaluate_energy(material, &deformation);
        let StressPoint { stress, status: of_stress } = evaluate_stress(material, &deformation);
        let plain = evaluate(material, &deformation, Filter::None);
        let clamped = evaluate(material, &deformation, Filter::Clamp);
        let dense = evaluate_dense(material, &deformation, Filter::None);
        let wide = |values: &[R]| values.iter().map(|&x| x.widen()).collect::<Vec<_>>();
        let results = [
            (Quantity::Energy, of_energy, wide(&[energy])),
            (Quantity::Stress, of_stress, wide(stress.as_flattened())),
            (Quantity::Stress, plain.status, wide(plain.stress.as_flattened())),
            (Quantity::Tangent, plain.status, wide(plain.tangent.to_matrix().as_flattened())),
            (Quantity::Projected, clamped.status, wide(clamped.tangent.to_matrix().as_flattened())),
            (Quantity::Stress, dense.status, wide(dense.stress.as_flattened())),
            (Quantity::Tangent, dense.status, wide(dense.tangent.as_flattened())),
        ];
        self.verdicts(R::NAME, R::UNIT_ROUNDOFF, |x| R::splat(x).is_finite(), results)
    }

    /// Results of a batch of one point, with every back end.
    fn batches<E: Kernels>(self, energy: &dyn TileMaterial<E>, precision: &'static str) -> Vec<Judgement> {
        let f = self.case.deformation.map(E::splat);
        let wide = |values: &[E]| values.iter().map(|&x| x.into()).collect::<Vec<f64>>();
        let judge = |backend| {
            let [plain, clamped] = [Filter::None, Filter::Clamp]
                .map(|filter| Answers::of(Batch::new(energy).with_backend(backend).with_filter(filter), &f));
            let ([of_energy, of_stress, of_plain], [_, _, of_clamped]) =
                (plain.statuses[0], clamped.statuses[0]);
            let results = [
                (Quantity::Energy, of_energy, wide(&plain.energies)),
                (Quantity::Stress, of_stress, wide(&plain.stresses)),
                (Quantity::Stress, of_plain, wide(&plain.beside)),
                (Quantity::Tangent, of_plain, wide(&plain.tangents)),
                (Quantity::Projected, of_clamped, wide(&clamped.tangents)),
            ];
            self.verdicts(precision, E::UNIT_ROUNDOFF, |x| E::splat(x).is_finite(), results)
        };
        Backend::available().flat_map(judge).collect()
    }

    /// `holds` is whether the format has a finite number near one. The first two results are energy and
    /// stress, each computed alone; the others are of points with both stress and tangent.
    fn verdicts<const N: usize>(
        &self,
        precision: &'static str,
        unit_roundoff: f64,
        holds: impl Fn(f64) -> bool,
        results: [(Quantity, Status<bool>, Vec<f64>); N],
    ) -> Vec<Judgement> {
        let leaves = |quantity| !self.case.reference(quantity).into_iter().all(&holds);
        let judgement = |(index, (quantity, status, values)): (usize, (_, Status<bool>, Vec<f64>))| {
            let something_leaves = match index {
                0 | 1 => leaves(quantity),
                // The one status of a point speaks for both.
                _ => leaves(Quantity::Stress) || leaves(Quantity::Tangent),
            };
            let verdict = match status {
                Status { refused: true, .. } => Err("refused, though inside the domain"),
                Status { nonfinite: true, .. } if !something_leaves => {
                    Err("flagged, though the format holds it")
                }
                Status { nonfinite: true, .. } if leaves(quantity) => Ok(None),
                _ if leaves(quantity) => Err("not flagged as beyond the format"),
                _ => {
                    let noise = if quantity == Quantity::Energy { self.terms } else { 0.0 };
                    Ok(Some(self.case.error(quantity, &values, noise, unit_roundoff)))
                }
            };
            Judgement { precision, quantity, verdict }
        };
        results.into_iter().enumerate().map(judgement).collect()
    }
}
