//! Fits: those whose answer is known, at edges of the admissible parameters, with other minima, of
//! exponentials.

mod edges;
mod exponentials;
mod known;
mod minima;

use nalgebra::{DMatrix, DVector};
use piola::Inversion;
use piola_declare::Energy;
use piola_laboratory::curve::{Mode, Volume, respond};
use piola_laboratory::data::{Measured, Measurements, TRELOAR_1944};
use piola_laboratory::fit::{Candidate, Fit, FitSettings, Warning};
use piola_materials::DECLARATIONS;

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// The material of an energy that a text declares, with these values.
fn candidate(text: &str, values: &[&[f64]]) -> Outcome<Candidate> {
    let energy = Energy::from_rust(text)?;
    let material = energy.material(values, Inversion::Refuse)?;
    Ok(Candidate { energy, material })
}

/// The same of an energy whose parameters are all numbers.
fn of_numbers(text: &str, values: &[f64]) -> Outcome<Candidate> {
    candidate(text, &values.iter().map(std::slice::from_ref).collect::<Vec<_>>())
}

/// A rubber of the catalogue, with parameters that are all numbers.
fn rubber(name: &str, values: &[f64]) -> Outcome<Candidate> {
    of_numbers(catalogue(name), values)
}

/// The text of an energy of the catalogue.
fn catalogue(name: &str) -> &'static str {
    let known = DECLARATIONS.iter().find(|declaration| declaration.name == name);
    known.expect("an energy of the catalogue").source
}

fn treloar() -> Measurements {
    Measurements::read(TRELOAR_1944).expect("a table")
}

/// As if measured in tension along one axis.
fn tension(points: &[(f64, f64)]) -> Measurements {
    let point = |&(control, stress)| Measured { mode: Mode::Uniaxial, control, stress };
    Measurements { points: points.iter().map(point).collect() }
}

/// What a material answers in these tests, as if measured.
fn synthetic(
    Candidate { material, .. }: &Candidate,
    volume: Volume,
    modes: &[Mode],
    controls: &[f64],
) -> Measurements {
    let mut points = Vec::new();
    for &mode in modes {
        for &control in controls {
            let stress = respond(material, mode, volume, control).expect("a stress").stress;
            points.push(Measured { mode, control, stress });
        }
    }
    Measurements { points }
}

fn by(floor: f64) -> FitSettings {
    FitSettings { floor, ..FitSettings::default() }
}

/// What the warnings of one kind tell.
fn told<'a, T>(fit: &'a Fit, of_kind: impl Fn(&'a Warning) -> Option<T>) -> Vec<T> {
    fit.warnings.iter().filter_map(of_kind).collect()
}

/// All warnings as they are printed.
fn text(fit: &Fit) -> String {
    fit.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Contribution of each term of a stress that is linear in its parameters to the difference at each point,
/// and Σ r² of parameters.
struct Linear {
    matrix: DMatrix<f64>,
    wanted: DVector<f64>,
}

impl Linear {
    /// By the stress along axes 1 to 3 for each of the parameters at some stretches, at constant volume.
    fn new<const N: usize>(
        data: &Measurements,
        floor: f64,
        terms: impl Fn([f64; 3]) -> [[f64; N]; 3],
    ) -> Self {
        let greatest = data.points.iter().fold(0.0_f64, |greatest, point| greatest.max(point.stress));
        let points: Vec<_> = data.points.iter().filter(|point| !point.is_rest()).collect();
        let size = |row: usize| points[row].stress.abs().max(floor * greatest);
        let stress = |row: usize, term: usize| {
            let s = points[row].control;
            let stretches = match points[row].mode {
                Mode::Uniaxial => [s, s.powf(-0.5), s.powf(-0.5)],
                Mode::Equibiaxial => [s, s, s.powi(-2)],
                Mode::PureShear => [s, 1.0, 1.0 / s],
                mode => unreachable!("{mode} is not in the data"),
            };
            let [along, _, across] = terms(stretches);
            along[term] - across[term] * stretches[2] / s
        };
        Self {
            matrix: DMatrix::from_fn(points.len(), N, |row, term| stress(row, term) / size(row)),
            wanted: DVector::from_fn(points.len(), |row, _| points[row].stress / size(row)),
        }
    }

    fn squares(&self, parameters: &DVector<f64>) -> f64 {
        (&self.matrix * parameters - &self.wanted).norm_squared()
    }

    /// The parameters with the least Σ r² in what the columns of `basis` span from `origin`.
    fn best(&self, origin: &DVector<f64>, basis: &DMatrix<f64>) -> DVector<f64> {
        let matrix = &self.matrix * basis;
        let lengths = DVector::from_fn(matrix.ncols(), |column, _| matrix.column(column).norm());
        let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| {
            matrix[(row, column)] / lengths[column]
        });
        let rest = &self.wanted - &self.matrix * origin;
        let solution = scaled.svd(true, true).solve(&rest, 0.0).expect("all vectors");
        origin + basis * solution.component_div(&lengths)
    }

    /// The parameters with the least Σ r² of all, and their standard errors if those of the points are
    /// uncorrelated.
    fn best_of_all(&self) -> (DVector<f64>, DVector<f64>) {
        let (points, terms) = self.matrix.shape();
        let best = self.best(&DVector::zeros(terms), &DMatrix::identity(terms, terms));
        let inverse = (self.matrix.transpose() * &self.matrix).try_inverse().expect("independent terms");
        let variance = self.squares(&best) / (points - terms) as f64;
        (best, inverse.diagonal().map(|entry| (variance * entry).sqrt()))
    }
}
