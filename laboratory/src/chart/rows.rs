//! A ranking as a chart: a row for each energy, with a mark for each R² over an axis of ln (1 − R²), so that
//! 0.99 and 0.999 are as far apart as 0.9 and 0.99.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::panel::colour;
use super::picture::{Area, ChartError, EMPTY, GREY, HEAD, dot, failed, head, picture, write};
use crate::ranking::{Place, Ranking};

const WIDTH: i32 = 1200;
/// Pixels for the legend.
const LEGEND: i32 = 34;
const ROW: i32 = 22;
/// Pixels below the last row, for the axis.
const FOOT: i32 = 56;

/// Columns, from the left: names and n end here, marks lie between, numbers end, words begin.
const NAME: i32 = 196;
const COUNT: i32 = 226;
const MARKS: (i32, i32) = (256, 720);
const TOTAL: i32 = 800;
const SHARE: i32 = 872;
const STABILITY: i32 = 896;

/// R² with a line across the rows.
const TICKS: [f64; 13] = [0.0, 0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995, 0.998, 0.999, 0.9995, 0.9998, 0.9999];

/// The SVG text of a ranking with a title and a line that explains.
///
/// # Errors
/// [`ChartError`] if nothing was ranked, or the library of charts fails.
pub fn rows(title: &str, note: &str, ranking: &Ranking) -> Result<String, ChartError> {
    let axis = Axis::of(ranking).ok_or_else(|| ChartError(EMPTY.into()))?;
    let below = LEGEND + ROW * ranking.places.len() as i32;
    picture((WIDTH as u32, HEAD + (below + FOOT) as u32), |root, above| {
        let area = head(root, title, note)?;
        explain(&area, ranking)?;
        for row in (1..ranking.places.len() as i32).step_by(2) {
            let top = LEGEND + ROW * row;
            let shade = RGBColor(244, 244, 244).filled();
            area.draw(&Rectangle::new([(16, top), (WIDTH - 16, top + ROW)], shade)).map_err(failed)?;
        }
        for tick in TICKS.into_iter().filter(|tick| axis.holds(*tick)) {
            let x = axis.x(tick).round() as i32;
            let line = PathElement::new([(x, LEGEND), (x, below)], RGBColor(216, 216, 216).stroke_width(1));
            area.draw(&line).map_err(failed)?;
            write(&area, &tick.to_string(), (x, below + 12), HPos::Center, 13, &BLACK)?;
        }
        let middle = (MARKS.0 + MARKS.1) / 2;
        write(&area, "R², in equal steps of ln (1 − R²)", (middle, below + 34), HPos::Center, 15, &BLACK)?;
        for (row, place) in ranking.places.iter().enumerate() {
            draw(&area, place, LEGEND + ROW * row as i32 + ROW / 2, &axis, above)?;
        }
        Ok(())
    })
}

/// Explains the marks and the columns.
fn explain(area: &Area<'_>, ranking: &Ranking) -> Result<(), ChartError> {
    let y = LEGEND / 2;
    let mut x = MARKS.0;
    mark(area, (x + 6, y))?;
    write(area, "all", (x + 16, y), HPos::Left, 14, &BLACK)?;
    x += 56;
    for (mode, _) in ranking.places.first().into_iter().flat_map(|place| &place.fit.agreement.modes) {
        area.draw(&Circle::new((x, y), 4, colour(*mode).filled())).map_err(failed)?;
        let name = mode.name().replace('_', " ");
        write(area, &name, (x + 9, y), HPos::Left, 14, &BLACK)?;
        x += 34 + 8 * name.len() as i32;
    }
    for (text, x) in [("n", COUNT), ("R²", TOTAL), ("R²/n", SHARE)] {
        write(area, text, (x, y), HPos::Right, 14, &BLACK)?;
    }
    write(area, "stability", (STABILITY, y), HPos::Left, 14, &BLACK)
}

fn draw(area: &Area<'_>, place: &Place, y: i32, axis: &Axis, above: &mut String) -> Result<(), ChartError> {
    let number = |determination: Option<f64>| match determination {
        Some(determination) => format!("{determination:.4}"),
        None => "–".into(),
    };
    let agreement = &place.fit.agreement;
    write(area, &place.name, (NAME, y), HPos::Right, 14, &BLACK)?;
    write(area, &place.parameters().to_string(), (COUNT, y), HPos::Right, 14, &BLACK)?;
    write(area, &number(agreement.total), (TOTAL, y), HPos::Right, 14, &BLACK)?;
    write(area, &number(place.share()), (SHARE, y), HPos::Right, 14, &BLACK)?;
    let style = if place.lost.iter().all(Option::is_none) { &BLACK } else { &GREY };
    write(area, &place.stability(), (STABILITY, y), HPos::Left, 13, style)?;
    for (mode, determination) in &agreement.modes {
        if let Some(determination) = determination {
            *above += &dot((axis.x(*determination), f64::from(HEAD as i32 + y)), 4, colour(*mode));
        }
    }
    agreement.total.map_or(Ok(()), |total| mark(area, (axis.x(total).round() as i32, y)))
}

/// The mark of all points together: a bar across the row.
fn mark(area: &Area<'_>, (x, y): (i32, i32)) -> Result<(), ChartError> {
    area.draw(&Rectangle::new([(x - 1, y - 8), (x + 1, y + 8)], BLACK.filled())).map_err(failed)
}

/// The decades of 1 − R² between the ends of the axis.
struct Axis {
    from: f64,
    to: f64,
}

impl Axis {
    /// Axis from the worst R² to the best; those below 0 stand at the left end, where R² is 0.
    fn of(ranking: &Ranking) -> Option<Self> {
        let agreements = ranking.places.iter().map(|place| &place.fit.agreement);
        let all = agreements.flat_map(|a| a.modes.iter().filter_map(|(_, r)| *r).chain(a.total));
        let decades = all.map(decades);
        let (from, to) =
            decades.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), x| (least.min(x), most.max(x)));
        from.is_finite().then(|| Self { from: (from - 0.1).max(0.0), to: to + 0.1 })
    }

    fn holds(&self, determination: f64) -> bool {
        (self.from..=self.to).contains(&decades(determination))
    }

    fn x(&self, determination: f64) -> f64 {
        let share = (decades(determination) - self.from) / (self.to - self.from);
        f64::from(MARKS.0) + share.clamp(0.0, 1.0) * f64::from(MARKS.1 - MARKS.0)
    }
}

/// −log₁₀ (1 − R²), between those of 0 and 0.999999.
fn decades(determination: f64) -> f64 {
    -(1.0 - determination.clamp(0.0, 0.999_999)).log10()
}
