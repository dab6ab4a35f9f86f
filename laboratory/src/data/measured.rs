//! Points of measured curves, and the agreement of an energy with them.

use std::fmt;

use piola::__private::message::number;

use crate::Specimen;
use crate::curve::{Mode, Response, ResponseError, Volume, respond};

/// A reading of a testing machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The test.
    pub mode: Mode,
    /// The control that the machine had set: λ, γ or J.
    pub control: f64,
    /// The stress, Pa.
    pub stress: f64,
}

impl Measured {
    /// True if this is the rest state, which carries no information.
    #[must_use]
    pub fn is_rest(&self) -> bool {
        self.control == self.mode.rest()
    }

    /// Checks that a reading is in the range that the [module](super) states.
    pub(crate) fn check(&self) -> Result<(), String> {
        let Self { mode, control, stress } = *self;
        let (controls, requirement) = match mode {
            Mode::SimpleShear => (-1e6..=1e6, "finite, and at most 1e6"),
            _ => (
                1e-6..=1e6,
                "positive, at least 1e-6 and at most 1e6; a strain is written under `strain`, one in percent under \
                 `strain [%]`",
            ),
        };
        if !controls.contains(&control) {
            return Err(format!("{} is {}; it must be {requirement}", mode.quantity(), number(control)));
        }
        let is_stress = stress == 0.0 || (1e-100..=1e100).contains(&stress.abs());
        let requirement = "at most 1e100 Pa, and at least 1e-100 Pa if it is not 0: is its unit right?";
        match is_stress {
            true => Ok(()),
            false => Err(format!("the stress in Pa is {}; it must be {requirement}", number(stress))),
        }
    }

    /// The response of a specimen at this point, to be compared with the stress.
    pub(crate) fn response(
        &self,
        specimen: &dyn Specimen<f64>,
        volume: Volume,
    ) -> Result<Response, PointError> {
        let response = respond(specimen, self.mode, volume, self.control);
        response.map_err(|reason| PointError { point: *self, reason })
    }
}

/// Readings of one material in one or several tests.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurements {
    /// Points in the order of the file; those of several files one after the other.
    pub points: Vec<Measured>,
}

impl Measurements {
    /// The modes in which there are points other than rest, in the order of [`Mode::ALL`].
    pub fn modes(&self) -> impl Iterator<Item = Mode> {
        let is_used = |mode: &Mode| self.of(*mode).any(|point| !point.is_rest());
        Mode::ALL.into_iter().filter(is_used)
    }

    /// The points of a mode.
    pub fn of(&self, mode: Mode) -> impl Iterator<Item = &Measured> {
        self.points.iter().filter(move |point| point.mode == mode)
    }

    /// The least and the greatest control that was measured in a mode, rest included.
    #[must_use]
    pub fn range(&self, mode: Mode) -> [f64; 2] {
        let controls = self.of(mode).map(|point| point.control);
        controls.fold([mode.rest(); 2], |[least, most], control| [least.min(control), most.max(control)])
    }

    /// Agreement of the specimen with the points: the coefficient of determination
    ///
    /// ```text
    /// R² = 1 − Σ (P − P̂)² / Σ (P − P̄)²
    /// ```
    ///
    /// of the stresses P with mean P̄, P̂ being those of the specimen. All points count, the rest state among
    /// them, as in a spreadsheet. 1 is agreement; below 0 the mean would be a better guess. It is undefined
    /// if all stresses are equal, such as a single one.
    ///
    /// # Errors
    /// [`PointError`] of the first point at which the specimen has no stress.
    pub fn agreement(&self, specimen: &dyn Specimen<f64>, volume: Volume) -> Result<Agreement, PointError> {
        let pair =
            |point: &Measured| point.response(specimen, volume).map(|response| (*point, response.stress));
        let pairs = self.points.iter().map(pair).collect::<Result<Vec<_>, _>>()?;
        let of = |mode: Mode| {
            let pairs: Vec<_> = pairs.iter().filter(|(point, _)| point.mode == mode).copied().collect();
            (mode, determination(&pairs))
        };
        Ok(Agreement { modes: self.modes().map(of).collect(), total: determination(&pairs) })
    }
}

/// R² by mode and of all points together.
#[derive(Clone, Debug, PartialEq)]
pub struct Agreement {
    /// R² of each mode by itself; `None` if its stresses do not vary.
    pub modes: Vec<(Mode, Option<f64>)>,
    /// R² of the points of all modes; `None` if their stresses do not vary.
    pub total: Option<f64>,
}

impl fmt::Display for Agreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |found: &Option<f64>| found.map_or_else(|| "undefined (equal stresses)".into(), short);
        for (mode, determination) in &self.modes {
            write!(f, "{mode} {}, ", shown(determination))?;
        }
        write!(f, "all {}", shown(&self.total))
    }
}

/// R² with five digits behind the point, and one that is far below 0 with an exponent.
pub(crate) fn short(determination: f64) -> String {
    if determination > -1e6 { format!("{determination:.5}") } else { format!("{determination:.1e}") }
}

/// A measured point at which a specimen has no stress.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{} at {} = {}: {reason}", point.mode, point.mode.letter(), number(point.control))]
pub struct PointError {
    /// The point.
    pub point: Measured,
    /// Reason why the specimen has no stress there.
    #[source]
    pub reason: ResponseError,
}

fn determination(pairs: &[(Measured, f64)]) -> Option<f64> {
    let (first, _) = pairs.first()?;
    if pairs.iter().all(|(point, _)| point.stress == first.stress) {
        return None;
    }
    let mean = pairs.iter().map(|(point, _)| point.stress).sum::<f64>() / pairs.len() as f64;
    let unexplained: f64 = pairs.iter().map(|(point, stress)| (point.stress - stress).powi(2)).sum();
    let all: f64 = pairs.iter().map(|(point, _)| (point.stress - mean).powi(2)).sum();
    Some(1.0 - unexplained / all).filter(|determination| determination.is_finite())
}
