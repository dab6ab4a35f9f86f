//! Measured points as curves of one solid: one cycle of several, and points that are several curves.

use crate::curve::Mode;
use crate::data::{Measured, Measurements};
use crate::rest::{digits, pascals};

/// Share of the greatest stress by which points of one curve scatter about it, root mean square.
const SCATTER: f64 = 0.03;
/// Distance of a control from rest, and the share of the greatest stress that a solid has there at least.
const FAR: (f64, f64) = (0.1, 0.01);
/// Share of the range of a control below which a turn of it is noise.
const JITTER: f64 = 0.02;

impl Measurements {
    /// The points of each test from the beginning of a cycle, counted from 1, to where its control turns. On
    /// its way to another specimen the control turns, too.
    ///
    /// # Errors
    /// A message if a test has no such cycle.
    pub fn cycle(&self, number: usize) -> Result<Self, String> {
        let mut chosen = Self::default();
        for mode in self.modes() {
            let all: Vec<_> = self.of(mode).copied().collect();
            let bounds = [vec![0], self.reversals(mode), vec![all.len()]].concat();
            let Some(bounds) = bounds.chunks_exact(2).nth(number.wrapping_sub(1)) else {
                let last = bounds.len() / 2;
                return Err(format!(
                    "there is no cycle {number} of {mode}; they are counted from 1 to {last}"
                ));
            };
            chosen.points.extend(&all[bounds[0]..bounds[1]]);
        }
        Ok(chosen)
    }

    /// Checks that the points of each test are one curve of one solid, whose stress does not fall while the
    /// control grows.
    ///
    /// # Errors
    /// A message if points, with rest if it was not measured, scatter by more than 3 % of the greatest
    /// stress, root mean square, about every such curve; or if they begin without stress far from rest.
    pub fn check_curves(&self) -> Result<(), String> {
        self.modes().try_for_each(|mode| self.check_curve(mode))
    }

    fn check_curve(&self, mode: Mode) -> Result<(), String> {
        let said = |Measured { control, stress, .. }: &Measured| {
            format!("{} at {} = {}", pascals(*stress), mode.letter(), digits(*control))
        };
        let rest = Measured { mode, control: mode.rest(), stress: 0.0 };
        let peak = self.of(mode).fold(0.0_f64, |peak, point| peak.max(point.stress.abs()));
        let away = |point: &Measured| (point.control - rest.control).abs();
        let nearest = self.of(mode).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(&rest);
        if away(nearest) > FAR.0 && nearest.stress.abs() < FAR.1 * peak {
            let begin = said(nearest);
            return Err(format!(
                "{mode} begins with {begin}, far from rest: are the strains stretches? If not, add rest, without stress"
            ));
        }
        // A stress at rest is that of a preload.
        let mut points: Vec<_> = self.of(mode).chain((away(nearest) > 0.0).then_some(&rest)).collect();
        points.sort_by(|a, b| a.control.total_cmp(&b.control).then(b.stress.total_cmp(&a.stress)));
        // The nearest stresses that do not fall are means of neighbours: sums, and numbers of points.
        let mut means: Vec<(f64, f64)> = Vec::new();
        let (mut highest, mut fall) = (points[0], [points[0]; 2]);
        for &point in &points {
            let mut mean = (point.stress, 1.0);
            while let Some((sum, count)) = means.pop_if(|below| below.0 / below.1 >= mean.0 / mean.1) {
                mean = (mean.0 + sum, mean.1 + count);
            }
            means.push(mean);
            if point.stress > highest.stress {
                highest = point;
            }
            if highest.stress - point.stress > fall[0].stress - fall[1].stress {
                fall = [highest, point];
            }
        }
        let squares: f64 = points.iter().map(|point| point.stress * point.stress).sum();
        let of_means: f64 = means.iter().map(|(sum, count)| sum * sum / count).sum();
        // NaN, which is not above, if rounding makes the difference negative.
        let scatter = ((squares - of_means) / points.len() as f64).sqrt();
        if scatter > SCATTER * peak {
            let (turns, percent, [high, low]) =
                (self.reversals(mode).len(), 100.0 * scatter / peak, fall.map(said));
            return Err(format!(
                "{mode} turns {turns} times, and scatters by {percent:.0} % of its greatest stress, with {high} and {low}: this \
                 is not one curve of one solid. Choose one of its cycles or specimens (`--cycle first`, \
                 `Measurements::cycle`), which is used as it is, also if it is noisy or softens; give each of several \
                 materials, temperatures, directions or stretches across by itself; leave out what follows rupture; or is a \
                 strain a stretch, or a sign wrong?"
            ));
        }
        Ok(())
    }

    /// Indices among the points of a mode before which the control turns: at the end of a loading behind its
    /// last point, at the beginning of the next one before its first.
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
                let is_end = turns.len() % 2 == 0;
                turns.push(extreme + usize::from(is_end));
                (sign, extreme) = (-sign, index);
            }
        }
        turns
    }
}
