//! Points on the portable lanes, for programs that start this one: on the processor itself, or in node as
//! WebAssembly.
//!
//! Each line of standard input is a request in JSON, and each line of standard output its answer;
//! `--functions` writes checksums instead, and reads nothing:
//!
//! ```text
//! {"material": "gent", "parameters": {"mu": [1.0], …}, "single": false, "F": [[…9…], …]}
//! ```

use std::collections::BTreeMap;
use std::error::Error;
use std::io::{Write, stdin, stdout};

use piola::Inversion;
use piola::batch::{Batch, Kernels, TileMaterial};
use piola::lanes::Backend;
use piola::point::Filter;
use piola_declare::Energy;
use piola_materials::DECLARATIONS;
use serde::{Deserialize, Serialize};

mod functions;

fn main() -> Result<(), Box<dyn Error>> {
    let mut to = stdout().lock();
    match std::env::args().nth(1).as_deref() {
        None => {
            for line in stdin().lines() {
                let request: Request = serde_json::from_str(&line?)?;
                writeln!(to, "{}", serde_json::to_string(&request.answer()?)?)?;
            }
        }
        Some("--functions") => {
            for line in functions::checksums() {
                writeln!(to, "{line}")?;
            }
        }
        Some(other) => return Err(format!("`{other}` is not `--functions`").into()),
    }
    Ok(())
}

/// Points of one material.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Request {
    /// Name in the catalogue.
    material: String,
    /// All values of each parameter, several for a list.
    parameters: BTreeMap<String, Vec<f64>>,
    /// True to compute in single precision.
    single: bool,
    /// Deformation gradients, row by row.
    #[serde(rename = "F")]
    deformations: Vec<[f64; 9]>,
}

/// Results, point after point; NaN and ∞ are `null`. Numbers are written with all their bits.
#[derive(Serialize)]
struct Answer {
    /// True if ψ, P or dP/dF of a point has no finite value in this format.
    nonfinite: Vec<bool>,
    psi: Vec<f64>,
    #[serde(rename = "P")]
    stress: Vec<f64>,
    #[serde(rename = "dPdF")]
    tangent: Vec<f64>,
    #[serde(rename = "dPdF_psd")]
    projected: Vec<f64>,
}

impl Request {
    fn answer(&self) -> Result<Answer, Box<dyn Error>> {
        let known = DECLARATIONS.iter().find(|known| known.name == self.material);
        let known = known.ok_or_else(|| format!("there is no material `{}`", self.material))?;
        let energy = Energy::from_rust(known.source)?;
        let parameters = &energy.description().parameters;
        let values = parameters.iter().map(|parameter| {
            let values = self.parameters.get(&*parameter.name);
            values
                .map(Vec::as_slice)
                .ok_or_else(|| format!("{}: no value for `{}`", known.name, parameter.name))
        });
        let values: Vec<&[f64]> = values.collect::<Result<_, _>>()?;
        let material = energy.material(&values, Inversion::Refuse)?;
        if self.single {
            self.compute::<f32>(&material, |x| x as f32)
        } else {
            self.compute::<f64>(&material, |x| x)
        }
    }

    fn compute<E: Kernels + Into<f64>>(
        &self,
        material: &dyn TileMaterial<E>,
        narrow: fn(f64) -> E,
    ) -> Result<Answer, Box<dyn Error>> {
        let plain = Batch::new(material).with_backend(Backend::portable());
        let deformations: Vec<E> = self.deformations.iter().flatten().map(|&x| narrow(x)).collect();
        let count = self.deformations.len();
        let room = |components: usize| vec![narrow(0.0); components * count];
        let (mut psi, mut stress, mut tangent, mut projected) = (room(1), room(9), room(81), room(81));
        let statuses: Vec<_> = (0..count).map(|_| Default::default()).collect();
        plain.energies(&deformations, &mut psi)?;
        plain.with_filter(Filter::Clamp).tangents(&deformations, &mut stress, &mut projected)?;
        plain.with_statuses(&statuses).tangents(&deformations, &mut stress, &mut tangent)?;
        let wide = |values: Vec<E>| values.into_iter().map(Into::into).collect();
        Ok(Answer {
            nonfinite: statuses.iter().map(|status| status.get().nonfinite).collect(),
            psi: wide(psi),
            stress: wide(stress),
            tangent: wide(tangent),
            projected: wide(projected),
        })
    }
}
