//! Points that are one curve of one solid, among those of cycles and of several specimens.

use piola::__private::message::number;

use crate::curve::Mode;
use crate::data::{Measured, Measurements};

/// Share of the greatest stress by which points of one curve may differ at one stretch.
const SCATTER: f64 = 0.1;
/// Share of the range of a control below which a turn of it is noise.
const JITTER: f64 = 0.02;

impl Measurements {
    /// The points of each test that are one curve of one solid: those from the beginning of a cycle, counted
    /// from 1, to where its control turns, or all. On its way to another specimen the control turns, too.
    ///
    /// # Errors
    /// A message if there is no such cycle. If none is chosen: two points between which the stress falls by
    /// more than a tenth of the greatest, rest being one of them, or a start without stress far from rest.
    pub fn one_curve(self, cycle: Option<usize>) -> Result<Self, String> {
        let Some(cycle) = cycle else {
            self.modes().try_for_each(|mode| self.check(mode))?;
            return Ok(self);
        };
        let mut points = Vec::new();
        for mode in Mode::ALL {
            let all: Vec<_> = self.of(mode).copied().collect();
            let bounds = [vec![0], self.reversals(mode), vec![all.len()]].concat();
            let of_cycle = bounds.chunks_exact(2).nth(cycle.wrapping_sub(1));
            points.extend(of_cycle.iter().flat_map(|bounds| &all[bounds[0]..bounds[1]]).copied());
        }
        let none = || format!("there is no cycle {cycle}; they are counted from 1");
        if points.is_empty() { Err(none()) } else { Ok(Self { points }) }
    }

    fn check(&self, mode: Mode) -> Result<(), String> {
        let said = |Measured { control, stress, .. }: &Measured| {
            format!("{} Pa at {} = {}", number(*stress), mode.letter(), number(*control))
        };
        let rest = Measured { mode, control: mode.rest(), stress: 0.0 };
        let peak = self.of(mode).fold(0.0_f64, |peak, point| peak.max(point.stress.abs()));
        let away = |point: &Measured| (point.control - rest.control).abs();
        let nearest = self.of(mode).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(&rest);
        if away(nearest) > SCATTER && nearest.stress.abs() < 0.01 * peak {
            let begin = said(nearest);
            return Err(format!(
                "{mode} begins with {begin}, far from rest: are the strains stretches? If not, add rest, without stress"
            ));
        }
        let mut points: Vec<_> = self.of(mode).chain([&rest]).collect();
        points.sort_by(|a, b| a.control.total_cmp(&b.control).then(b.stress.total_cmp(&a.stress)));
        let mut highest = points[0];
        for point in points {
            if point.stress >= highest.stress {
                highest = point;
            } else if highest.stress - point.stress > SCATTER * peak {
                let (turns, highest, point) = (self.reversals(mode).len(), said(highest), said(point));
                return Err(format!(
                    "{mode} has {highest} and {point}, and turns {turns} times: this is not one curve of one solid. Choose one \
                     of its cycles or specimens (`--cycle first`, `Measurements::one_curve`); give each of several materials, \
                     temperatures, directions or stretches across by itself; or is a strain a stretch, or a sign wrong?"
                ));
            }
        }
        Ok(())
    }

    /// Indices among the points of a mode before which the control turns.
    pub(crate) fn reversals(&self, mode: Mode) -> Vec<usize> {
        let controls: Vec<f64> = self.of(mode).map(|point| point.control).collect();
        let [least, most] = self.range(mode);
        let is_step = |step: &f64| step.abs() > JITTER * (most - least);
        let first = controls.iter().map(|control| control - controls[0]).find(is_step);
        let (mut sign, mut extreme, mut turns) = (first.map_or(1.0, f64::signum), 0, Vec::new());
        for (index, control) in controls.iter().enumerate() {
            let step = sign * (control - controls[extreme]);
            if step > 0.0 {
                extreme = index;
            } else if is_step(&step) {
                turns.push(extreme + 1);
                (sign, extreme) = (-sign, index);
            }
        }
        turns
    }
}
