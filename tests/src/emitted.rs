//! Energies as source text of other languages, compiled and executed by a program of another's.
//!
//! The program is called with the text, a file of points, a file for the results and the number of points. A
//! point is the parameters in the order of their structure (one zero if there are none) and F; its results
//! are ψ, P, P with dP/dF, and P with the projected dP/dF, each followed by its status: numbers in the format
//! of the text, and 32 bits for a status. `emitted/` has such programs.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

use piola::material::Form;
use piola::{Inversion, Status};
use piola_declare::emit::{Emission, PointFunction, Precision, Target};

use crate::cases::Case;
use crate::energies::Judged;

/// A program that executes texts of a language.
#[derive(Clone, Debug)]
pub struct Runner {
    target: Target,
    /// The number format of its texts.
    pub precision: Precision,
    program: PathBuf,
}

/// Results at a point, each with its status: ψ; P alone; P, then dP/dF; P, then dP/dF projected.
pub type Answer = [(Vec<f64>, Status<bool>); 4];

/// Numbers of the results at a point.
const COUNTS: [usize; 4] = [1, 9, 90, 90];

impl Runner {
    /// The program that the variable `PIOLA_EMITTED` names: target, precision, and path.
    pub fn from_environment() -> Result<Option<Self>, String> {
        let Ok(text) = std::env::var("PIOLA_EMITTED") else { return Ok(None) };
        let words: Vec<_> = text.split_ascii_whitespace().collect();
        let [target, precision, program] = words[..] else {
            return Err(format!("PIOLA_EMITTED is `{text}` and not TARGET PRECISION PROGRAM"));
        };
        Ok(Some(Self {
            target: target.parse().map_err(|error| format!("PIOLA_EMITTED: {error}"))?,
            precision: precision.parse().map_err(|error| format!("PIOLA_EMITTED: {error}"))?,
            program: PathBuf::from(program),
        }))
    }

    /// Results of all cases of one energy, in their order.
    pub fn answers(&self, energy: &Judged, cases: &[Case]) -> Result<Vec<Answer>, String> {
        // What the text fixes: lengths of lists and whole exponents.
        let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        let parameters = &energy.description().parameters;
        for (index, case) in cases.iter().enumerate() {
            let values = case.values(energy.description())?;
            let fixed = parameters.iter().zip(&values).map(|(parameter, values)| match parameter.form {
                Form::Exponent | Form::Exponents => format!("{values:?}"),
                _ => values.len().to_string(),
            });
            groups.entry(fixed.collect::<Vec<_>>().join(";")).or_default().push(index);
        }
        let mut answers = vec![None; cases.len()];
        for group in groups.into_values() {
            let cases: Vec<_> = group.iter().map(|&index| &cases[index]).collect();
            for (index, answer) in group.into_iter().zip(self.group(energy, &cases)?) {
                answers[index] = Some(answer);
            }
        }
        answers.into_iter().collect::<Option<_>>().ok_or_else(|| "a case has no answer".to_owned())
    }

    fn group(&self, energy: &Judged, cases: &[&Case]) -> Result<Vec<Answer>, String> {
        let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", energy.name);
        let emission = Emission {
            target: self.target,
            precision: self.precision,
            prefix: Some("energy".into()),
            functions: PointFunction::ALL[..4].to_vec(),
        };
        let parameters = &energy.description().parameters;
        let mut points = Vec::new();
        for case in cases {
            let values = case.values(energy.description())?;
            let before = points.len();
            for (parameter, values) in parameters.iter().zip(&values) {
                if !matches!(parameter.form, Form::Exponent | Form::Exponents) {
                    points.extend(values);
                }
            }
            if points.len() == before {
                points.push(0.0);
            }
            points.extend(case.deformation);
        }
        let values = cases[0].values(energy.description())?;
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let text = energy.energy.emit(&values, Inversion::Refuse, &emission).map_err(|error| fail(&error))?;

        let folder = tempfile::tempdir().map_err(|error| fail(&error))?;
        let [source, from, to] = ["energy.h", "points", "results"].map(|name| folder.path().join(name));
        std::fs::write(&source, text).map_err(|error| fail(&error))?;
        std::fs::write(&from, bytes(points.into_iter(), self.precision)).map_err(|error| fail(&error))?;
        let output = Command::new(&self.program)
            .args([&source, &from, &to])
            .arg(cases.len().to_string())
            .arg(if self.precision == Precision::F32 { "f32" } else { "f64" })
            .output()
            .map_err(|error| format!("{}: {error}", self.program.display()))?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(format!("{}: {} fails: {said}", energy.name, self.program.display()));
        }
        let bytes = std::fs::read(&to).map_err(|error| fail(&error))?;
        let size = if self.precision == Precision::F32 { 4 } else { 8 };
        let of_point: usize = COUNTS.iter().map(|count| count * size + 4).sum();
        if bytes.len() != cases.len() * of_point {
            return Err(fail(&format!("{} bytes of results", bytes.len())));
        }
        Ok(bytes.chunks_exact(of_point).map(|bytes| answer(bytes, size)).collect())
    }
}

/// Numbers in the format of a text.
pub fn bytes(numbers: impl Iterator<Item = f64>, precision: Precision) -> Vec<u8> {
    match precision {
        Precision::F32 => numbers.flat_map(|number| (number as f32).to_ne_bytes()).collect(),
        Precision::F64 => numbers.flat_map(f64::to_ne_bytes).collect(),
    }
}

/// Results at a point, of numbers of this many bytes.
fn answer(mut bytes: &[u8], size: usize) -> Answer {
    COUNTS.map(|count| {
        let (numbers, rest) = bytes.split_at(count * size);
        let (status, rest) = rest.split_at(4);
        bytes = rest;
        let number = |bytes: &[u8]| match bytes {
            &[a, b, c, d] => f64::from(f32::from_ne_bytes([a, b, c, d])),
            bytes => f64::from_ne_bytes(bytes.try_into().expect("eight bytes")),
        };
        let bits = u32::from_ne_bytes(status.try_into().expect("four bytes"));
        let [refused, bounded, nonfinite, filtered] = [0, 1, 2, 3].map(|k| bits >> k & 1 == 1);
        (numbers.chunks_exact(size).map(number).collect(), Status { refused, bounded, nonfinite, filtered })
    })
}
