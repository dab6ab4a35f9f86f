//! Several energies fitted to the same measurements and put in an order, as reviews of rubber do.
//!
//! Each energy is fitted as an incompressible solid, and is compared by four figures:
//!
//! * *n*, the number of fitted parameters: lists count by their entries, and parameters without effect at
//!   constant volume, such as a bulk modulus, do not count;
//! * *R²* of all points together, and of the points of each test ([`Measurements::agreement`]);
//! * *R²/n*, R² divided by the number of parameters, so that among two energies with equal agreement the one
//!   with fewer parameters is ahead. It compares energies with similar R²: a single parameter with R² = 0.5
//!   has a larger R²/n than two with R² = 0.99;
//! * *stability*, the place at which each inequality of a stable solid is lost first on the way from rest to
//!   the ends of the data ([`constant_volume`]).

use std::fmt;

use rayon::prelude::*;

use crate::curve::{Mode, Volume};
use crate::data::{Measurements, short};
use crate::fit::{Candidate, Fit, FitError, FitSettings, Standing, TrialError, fit_parameters};
use crate::stability::constant_volume;

/// An energy with the parameters from which its fit begins.
pub struct Contender {
    /// The name under which it is ranked.
    pub name: String,
    /// The energy.
    pub candidate: Candidate,
}

/// Energies in the order of their agreement with the same measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranking {
    /// Energies that were fitted, by falling R² of all points.
    pub places: Vec<Place>,
    /// Energies that could not be fitted, in the order in which they were given.
    pub failures: Vec<(String, FitError)>,
}

/// An energy that was fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The name under which it is ranked.
    pub name: String,
    /// Its best parameters, with R² of each mode and of all.
    pub fit: Fit,
    /// Test and control, λ or γ, at which criteria are lost nearest to rest, between rest and the ends of the
    /// data, such as `Hill, SE lost at uniaxial 2.13`, or `kept`.
    pub stability: String,
}

impl Place {
    /// n, the number of parameters that were fitted.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.fit.numbers.iter().filter(|number| number.standing == Standing::Free).count()
    }

    /// R²/n of all points; `None` if their stresses do not vary.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        // A fit without a free parameter is an error.
        self.fit.agreement.total.map(|total| total / self.parameters() as f64)
    }
}

/// Fits every contender to the data at constant volume and ranks them by R².
///
/// The [volume](FitSettings::volume) of the settings is ignored. The fits run on all processors; the result
/// does not depend on how many there are.
///
/// ```
/// use piola_laboratory::data::{Measurements, TRELOAR_1944};
/// use piola::Inversion;
/// use piola_declare::Energy;
/// use piola_laboratory::fit::{Candidate, FitSettings};
/// use piola_laboratory::ranking::{Contender, rank};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let contender = |name: &str, formula: &str, values: &[&[f64]]| {
///     let energy = Energy::from_formula(formula)?;
///     let material = energy.material(values, Inversion::Refuse)?;
///     Ok::<_, Box<dyn std::error::Error>>(Contender {
///         name: name.into(),
///         candidate: Candidate { energy, material },
///     })
/// };
/// let contenders = [
///     contender("neo-Hookean", "mu/2*(I1b - 3) + kappa/2*(J - 1)^2", &[&[4e5], &[2e7]])?,
///     contender(
///         "Gent",
///         "-mu*Jm/2*ln(1 - (I1b - 3)/Jm) + kappa/2*(J - 1)^2 where J > 0, I1b < 3 + Jm, Jm > 0",
///         &[&[3e5], &[80.0], &[2e7]],
///     )?,
/// ];
/// let settings = FitSettings { floor: 1.0, restarts: 2, ..FitSettings::default() };
/// let ranking = rank(&contenders, &Measurements::read(TRELOAR_1944)?, &settings);
/// let names: Vec<_> = ranking.places.iter().map(|place| (&*place.name, place.parameters())).collect();
/// assert_eq!(names, [("Gent", 2), ("neo-Hookean", 1)]);
/// # Ok(())
/// # }
/// ```
#[must_use]
pub fn rank(contenders: &[Contender], data: &Measurements, settings: &FitSettings) -> Ranking {
    let settings = FitSettings { volume: Volume::Kept, ..settings.clone() };
    let fitted = |contender| place(contender, data, &settings);
    let results: Vec<_> = contenders.par_iter().map(fitted).collect();

    let mut ranking = Ranking { places: Vec::new(), failures: Vec::new() };
    for (contender, result) in contenders.iter().zip(results) {
        match result {
            Ok(place) => ranking.places.push(place),
            Err(error) => ranking.failures.push((contender.name.clone(), error)),
        }
    }
    let determination = |place: &Place| place.fit.agreement.total.unwrap_or(f64::NEG_INFINITY);
    // Those that are equal keep the order in which they were given.
    ranking.places.sort_by(|one, other| determination(other).total_cmp(&determination(one)));
    ranking
}

fn place(contender: &Contender, data: &Measurements, settings: &FitSettings) -> Result<Place, FitError> {
    let fit = fit_parameters(&contender.candidate, data, settings)?;
    let Candidate { energy, material } = &contender.candidate;
    let fitted = energy.with_values(material, &fit.values).map_err(TrialError::Inadmissible)?;
    let mut lost: [Option<Loss>; 3] = [None; 3];
    for mode in data.modes() {
        for end in data.range(mode) {
            let losses = constant_volume::lost(&fitted, mode, end);
            for (first, control) in lost.iter_mut().zip(losses) {
                let loss = control.map(|control| (mode, control));
                let is_nearer = |loss: &Loss| first.is_none_or(|first| strain(*loss) < strain(first));
                *first = loss.filter(is_nearer).or(*first);
            }
        }
    }
    Ok(Place { name: contender.name.clone(), fit, stability: stability(lost) })
}

/// Test and control at which a criterion is lost.
type Loss = (Mode, f64);

/// Distance of the specimen from rest: ln λ of its greatest stretch along the axes that the machine moves.
fn strain((mode, control): Loss) -> f64 {
    match mode {
        Mode::SimpleShear => (0.5 * control).asinh().abs(),
        _ => control.ln().abs(),
    }
}

/// The losses of the criteria in a line.
fn stability(lost: [Option<Loss>; 3]) -> String {
    let mut groups: Vec<(String, String)> = Vec::new();
    // `Criterion::ALL` in few letters.
    for (name, lost) in ["BE", "Hill", "SE"].into_iter().zip(lost) {
        let Some((mode, control)) = lost else { continue };
        let at = format!("{mode} {control:.2}");
        match groups.iter_mut().find(|(_, place)| *place == at) {
            Some((names, _)) => *names += &format!(", {name}"),
            None => groups.push((name.into(), at)),
        }
    }
    if groups.is_empty() {
        return "kept".into();
    }
    let groups: Vec<_> = groups.into_iter().map(|(names, at)| format!("{names} lost at {at}")).collect();
    groups.join("; ")
}

impl fmt::Display for Ranking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(first) = self.places.first() {
            write!(f, "{:24} {:>2} {:>9}", "energy", "n", "R²")?;
            for (mode, _) in &first.fit.agreement.modes {
                write!(f, " {mode:>12}")?;
            }
            writeln!(f, " {:>9}  stability", "R²/n")?;
        }
        for place in &self.places {
            let agreement = &place.fit.agreement;
            write!(f, "{:24} {:>2} {:>9}", place.name, place.parameters(), shown(agreement.total))?;
            for (_, determination) in &agreement.modes {
                write!(f, " {:>12}", shown(*determination))?;
            }
            writeln!(f, " {:>9}  {}", shown(place.share()), place.stability)?;
        }
        for (name, error) in &self.failures {
            writeln!(f, "{name:24} not fitted: {error}")?;
        }
        Ok(())
    }
}

/// R², or a dash where it is undefined.
fn shown(determination: Option<f64>) -> String {
    determination.map_or_else(|| "–".into(), short)
}
