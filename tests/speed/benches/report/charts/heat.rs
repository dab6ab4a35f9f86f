//! Heat map of lost digits: methods against families of deformation gradients.

use std::collections::{BTreeMap, BTreeSet};

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Chart;
use super::panel::{failed, headed};
use super::point::best_settings;
use crate::point::{ENERGIES, HARD, ORDINARY, PointRow};

const CELL: [i32; 2] = [46, 26];
const LEFT: i32 = 240;
const TOP: i32 = 130;

pub(super) fn draw(rows: &[PointRow]) -> Result<Vec<Chart>, String> {
    ["f64", "f32"].into_iter().map(|precision| of(precision, rows)).collect()
}

fn of(precision: &str, rows: &[PointRow]) -> Result<Chart, String> {
    let tangents = || rows.iter().filter(|row| row.precision == precision && row.work == "tangent");
    // The setting of each method that is best over all hard families of an energy is shown for all families.
    let mut errors: BTreeMap<(&str, &str), f64> = BTreeMap::new();
    let mut methods: Vec<&str> = Vec::new();
    for (material, _) in ENERGIES {
        let hard: Vec<&PointRow> =
            tangents().filter(|row| row.material == material && row.family == HARD).collect();
        for best in best_settings(&hard) {
            if !methods.contains(&best.method) {
                methods.push(best.method);
            }
            let same = |row: &&PointRow| {
                (row.material, row.method, &row.setting) == (material, best.method, &best.setting)
                    && row.family != HARD
            };
            for row in tangents().filter(same) {
                let worst = errors.entry((row.method, &row.family)).or_insert(0.0);
                *worst = worst.max(row.worst_error);
            }
        }
    }
    let hard: BTreeSet<&str> = errors.keys().map(|key| key.1).filter(|family| *family != ORDINARY).collect();
    let families: Vec<&str> = [ORDINARY].into_iter().chain(hard).collect();
    let width = LEFT + CELL[0] * families.len() as i32 + 30;
    let height = 66 + TOP + CELL[1] * methods.len() as i32 + 24;
    let title = format!("Digits lost: worst relative error of P and dP/dF, {precision}");
    let note = "Decimal exponent of the worst error of all energies that a method takes; each energy with the setting that is \
                best for it. 0: exact. ∞: infinite or not a number.";
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (width.unsigned_abs(), height.unsigned_abs()));
        let root = headed(&root.into_drawing_area(), &title, note)?;
        let font = |size: i32| ("sans-serif", size).into_font();
        for (column, family) in families.iter().enumerate() {
            let x = LEFT + CELL[0] * column as i32 + CELL[0] / 2;
            let style = font(13).transform(FontTransform::Rotate270).color(&BLACK);
            let style = style.pos(Pos::new(HPos::Left, VPos::Center));
            root.draw(&Text::new(family.replace('_', " "), (x, TOP - 6), style)).map_err(failed)?;
        }
        for (line, method) in methods.iter().enumerate() {
            let y = TOP + CELL[1] * line as i32;
            let style = font(14).color(&BLACK).pos(Pos::new(HPos::Right, VPos::Center));
            root.draw(&Text::new(method.to_string(), (LEFT - 8, y + CELL[1] / 2), style)).map_err(failed)?;
            for (column, family) in families.iter().enumerate() {
                let Some(&error) = errors.get(&(*method, *family)) else { continue };
                let x = LEFT + CELL[0] * column as i32;
                let (colour, ink, text) = cell(error, precision);
                let corners = [(x + 1, y + 1), (x + CELL[0] - 1, y + CELL[1] - 1)];
                root.draw(&Rectangle::new(corners, colour.filled())).map_err(failed)?;
                let style = font(13).color(&ink).pos(Pos::new(HPos::Center, VPos::Center));
                let middle = (x + CELL[0] / 2, y + CELL[1] / 2);
                root.draw(&Text::new(text, middle, style)).map_err(failed)?;
            }
        }
        root.present().map_err(failed)?;
    }
    let caption =
        format!("How many digits each method loses at which family of deformation gradients, {precision}");
    Ok(Chart { file: format!("families-{precision}.svg"), svg, caption })
}

/// Colour, ink and text of an error: from blue, as good as the format, over white to red, no digit right.
/// Lightness alone distinguishes the two ends from the middle, and the number distinguishes them from each
/// other.
fn cell(error: f64, precision: &str) -> (RGBColor, RGBColor, String) {
    if !error.is_finite() {
        return (RGBColor(40, 40, 40), WHITE, "∞".to_owned());
    }
    let best = if precision == "f64" { -16.0 } else { -7.5 };
    let (exponent, text) = match error {
        0.0 => (best, "0".to_owned()),
        _ => (error.log10(), format!("{:.0}", error.log10())),
    };
    let share = ((exponent - best) / -best).clamp(0.0, 1.0);
    const STOPS: [[f64; 3]; 3] = [[0.0, 90.0, 160.0], [245.0, 245.0, 235.0], [180.0, 50.0, 0.0]];
    let (from, to, t) =
        if share < 0.5 { (STOPS[0], STOPS[1], 2.0 * share) } else { (STOPS[1], STOPS[2], 2.0 * share - 1.0) };
    let channel = |k: usize| (from[k] + t * (to[k] - from[k])).round() as u8;
    let ink = if (0.2..0.8).contains(&share) { BLACK } else { WHITE };
    (RGBColor(channel(0), channel(1), channel(2)), ink, text)
}
