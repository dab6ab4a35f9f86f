//! What it costs to come within an error, from trajectories with several time steps.

use crate::data::StepRow;

/// With the time step that just comes within the error.
pub(crate) struct Arrival {
    pub(crate) setting: String,
    /// s.
    pub(crate) h: f64,
    /// Of Newton's method, in a second of motion.
    pub(crate) iterations: f64,
    /// In a second of motion.
    pub(crate) milliseconds: f64,
}

/// Of each setting over the time step that comes within an error with its shortest steps, in their order.
pub(crate) fn arrivals(
    rows: &[StepRow],
    scene: &str,
    within: f64,
    error: fn(&StepRow) -> f64,
) -> Vec<Arrival> {
    let mut settings: Vec<&str> = Vec::new();
    let over_h: Vec<&StepRow> = rows.iter().filter(|row| row.scene == scene && row.axis == "h").collect();
    for row in &over_h {
        if !settings.contains(&row.setting.as_str()) {
            settings.push(&row.setting);
        }
    }
    let of = |setting: &str| {
        let mut rows: Vec<&StepRow> = over_h.iter().copied().filter(|row| row.setting == setting).collect();
        rows.sort_unstable_by(|a, b| b.h.total_cmp(&a.h));
        // From the step on from which all shorter ones are within it as well.
        let outside = rows.iter().rposition(|row| !(error(row) <= within));
        let inside = *rows.get(outside.map_or(0, |outside| outside + 1))?;
        let outside = outside.map(|index| rows[index]).filter(|row| error(row).is_finite());
        Some(between(outside.unwrap_or(inside), inside, within, error))
    };
    settings.into_iter().filter_map(of).collect()
}

/// On the line in logarithms from a row outside of the error to one within.
fn between(outside: &StepRow, inside: &StepRow, within: f64, error: fn(&StepRow) -> f64) -> Arrival {
    let way = (error(outside) / error(inside)).ln();
    let share = if way > 0.0 { (error(outside) / within).ln() / way } else { 1.0 };
    let at = |number: fn(&StepRow) -> f64| {
        (number(outside).ln() + share * (number(inside).ln() - number(outside).ln())).exp()
    };
    let seconds = |row: &StepRow| row.steps as f64 * row.h;
    Arrival {
        setting: inside.setting.clone(),
        h: at(|row| row.h),
        iterations: at(|row| row.newton_iterations as f64) / seconds(inside),
        milliseconds: at(|row| 1e3 * row.seconds) / seconds(inside),
    }
}
