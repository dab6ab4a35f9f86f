//! Maps of the criteria of stability in two planes through the space of stretches, as a picture.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::picture::{Area, ChartError, FONT, failed, picture};
use crate::curve::lateral::{Side, release};
use crate::stability::criteria::Judgement;
use crate::stability::{Path, SurveySettings};
use crate::{Specimen, specimen};

/// Plane of stretches λ1, λ2, and the condition on the third.
struct Plane {
    title: &'static str,
    stretches: Stretches,
    /// Lines in this plane with their names.
    lines: [(&'static str, Line); 3],
}

/// The three stretches at a point of a plane; `None` if no thickness makes a sheet free of stress.
type Stretches = fn(&dyn Specimen<f64>, [f64; 2]) -> Option<[f64; 3]>;

/// λ2 by λ1 along a line of the picture; `None` where nothing makes the sides free of stress.
type Line = fn(&dyn Specimen<f64>, f64) -> Option<f64>;

static PLANES: [Plane; 2] = [
    Plane {
        title: "sheet: no stress through its thickness",
        stretches: sheet,
        lines: [
            ("uniaxial", |specimen, first| second(Path::Uniaxial, specimen, first)),
            ("equibiaxial", |specimen, first| second(Path::Equibiaxial, specimen, first)),
            ("pure shear", |specimen, first| second(Path::PureShear, specimen, first)),
        ],
    },
    Plane {
        title: "plane strain: λ3 = 1",
        stretches: |_, [l1, l2]| Some([l1, l2, 1.0]),
        lines: [
            ("constant volume", |_, first| Some(1.0 / first)),
            ("equibiaxial", |_, first| Some(first)),
            ("confined", |_, _| Some(1.0)),
        ],
    },
];

/// The stretches of a sheet without stress through its thickness.
fn sheet(specimen: &dyn Specimen<f64>, [l1, l2]: [f64; 2]) -> Option<[f64; 3]> {
    let thickness = |strain: f64| {
        let strains = [l1 - 1.0, l2 - 1.0, strain];
        let [.., stress] = specimen::gradient(specimen, strains)?;
        Some(Side { stress, slope: specimen::hessian(specimen, strains)[2][2] })
    };
    let strain = release(thickness, 1.0 / (l1 * l2) - 1.0)?;
    Some([l1, l2, 1.0 + strain])
}

/// λ2 of a test by its λ1.
fn second(path: Path, specimen: &dyn Specimen<f64>, first: f64) -> Option<f64> {
    path.stretches(specimen, first).map(|[_, second, _]| second)
}

/// Kinds of the cells of the picture, with colours of Okabe and Ito, which stay apart for all kinds of colour
/// vision; pale where all criteria are kept.
const KINDS: [(&str, RGBColor); 6] = [
    ("all criteria hold", RGBColor(222, 240, 233)),
    ("Hill lost", RGBColor(86, 180, 233)),
    ("strong ellipticity lost", RGBColor(240, 228, 66)),
    ("Hill and strong ellipticity lost", RGBColor(230, 159, 0)),
    ("all lost, Baker–Ericksen too", RGBColor(213, 94, 0)),
    ("outside the domain, or no equilibrium", RGBColor(190, 190, 190)),
];

/// The kind of a cell, an index of [`KINDS`].
fn kind(judgement: Option<Judgement>) -> usize {
    match judgement.map(|judgement| judgement.kept) {
        Some([true, true, true]) => 0,
        Some([true, false, true]) => 1,
        Some([true, true, false]) => 2,
        Some([true, false, false]) => 3,
        Some([false, ..]) => 4,
        None => 5,
    }
}

/// Cells along each side of a plane.
const CELLS: usize = 120;
/// Points along a line.
const POINTS: usize = 121;
const SIZE: (u32, u32) = (1100, 680);

/// Map of the criteria in a sheet and in plane strain, side by side under a title, as SVG.
///
/// The picture has 120 × 120 cells in a plane, regardless of the resolution of the box.
///
/// # Errors
/// [`ChartError`] if the settings are out of range, or the library of charts fails.
pub fn map(
    specimen: &dyn Specimen<f64>,
    settings: &SurveySettings,
    title: &str,
) -> Result<String, ChartError> {
    settings.check().map_err(|error| ChartError(error.to_string()))?;
    picture(SIZE, |root, _| {
        root.draw(&Text::new(title.to_owned(), (20, 14), (FONT, 20).into_font())).map_err(failed)?;
        let (upper, legend) = root.margin(44, 10, 10, 10).split_vertically(540);
        for (plane, area) in PLANES.iter().zip(upper.split_evenly((1, 2))) {
            panel(specimen, settings, plane, &area)?;
        }
        explain(&legend)
    })
}

fn panel(
    specimen: &dyn Specimen<f64>,
    settings: &SurveySettings,
    plane: &Plane,
    area: &Area<'_>,
) -> Result<(), ChartError> {
    // Round numbers in equal steps of their logarithm; 3 · 10⁻¹ is one rounding more than 0.3.
    let (start, end) = (settings.from * (1.0 - 1e-12), settings.to * (1.0 + 1e-12));
    let decades = (-6..6).map(|exponent| 10f64.powi(exponent));
    let round = decades.flat_map(|decade| [1.0, 1.5, 2.0, 3.0, 5.0, 7.0].map(|digit| digit * decade));
    let round: Vec<_> = round.filter(|stretch| start <= *stretch && *stretch <= end).collect();
    let axis = || (settings.from..settings.to).log_scale().with_key_points(round.clone());
    let label = |stretch: &f64| ((stretch * 1e9).round() / 1e9).to_string();
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .caption(plane.title, (FONT, 16))
        .x_label_area_size(44)
        .y_label_area_size(54)
        .build_cartesian_2d(axis(), axis())
        .map_err(failed)?;

    let cells = cells(specimen, settings, plane);
    let edges = settings.stretches(CELLS + 1);
    for (i, column) in cells.chunks(CELLS).enumerate() {
        let mut start = 0;
        for run in column.chunk_by(|one, next| one == next) {
            let corners = [(edges[i], edges[start]), (edges[i + 1], edges[start + run.len()])];
            let run_of_cells = Rectangle::new(corners, KINDS[run[0]].1.filled());
            chart.draw_series([run_of_cells]).map_err(failed)?;
            start += run.len();
        }
    }
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc("λ1")
        .y_desc("λ2")
        .axis_desc_style((FONT, 15))
        .label_style((FONT, 13))
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .draw()
        .map_err(failed)?;

    for (name, second) in plane.lines {
        let point = |first: &f64| {
            let second = second(specimen, *first)?;
            (settings.from <= second && second <= settings.to).then_some((*first, second))
        };
        let points: Vec<_> = settings.stretches(POINTS).iter().map(point).collect();
        // A line has gaps where the test has no equilibrium or leaves the picture.
        for line in points.split(Option::is_none) {
            let line: Vec<_> = line.iter().copied().flatten().collect();
            chart.draw_series([PathElement::new(line, BLACK)]).map_err(failed)?;
        }
        // Where there is room for a name, away from the frame.
        let share = (settings.to / settings.from).powf(0.07);
        let has_room = |place: &&(f64, f64)| settings.from * share < place.1 && place.1 < settings.to / share;
        let mut inside = points[..POINTS * 19 / 20].iter().rev().flatten().filter(has_room);
        if let (Some(&place), Some(&before)) = (inside.next(), inside.next()) {
            // To the left of a line's last point, and on the side that the line does not come from.
            let (side, shift) = if place.1 < before.1 { (VPos::Top, 4) } else { (VPos::Bottom, -4) };
            // White around the letters keeps them readable over every colour and line.
            let around = [(-1, 0), (1, 0), (0, -1), (0, 1)].map(|shift| (shift, WHITE));
            for ((x, y), colour) in around.into_iter().chain([((0, 0), BLACK)]) {
                let style = (FONT, 14).into_font().color(&colour).pos(Pos::new(HPos::Right, side));
                let text = EmptyElement::at(place) + Text::new(name, (x - 4, y + shift), style);
                chart.draw_series([text]).map_err(failed)?;
            }
        }
    }
    chart.draw_series([Circle::new((1.0, 1.0), 4, BLACK.filled())]).map_err(failed)?;
    Ok(())
}

/// The kinds of all cells, column by column, from the least stretches to the greatest.
fn cells(specimen: &dyn Specimen<f64>, settings: &SurveySettings, plane: &Plane) -> Vec<usize> {
    // The middles of the cells are every other one of these.
    let stretches = settings.stretches(2 * CELLS + 1);
    let mut cells = vec![0; CELLS * CELLS];
    for i in 0..CELLS {
        for j in 0..=i {
            let pair = [stretches[2 * i + 1], stretches[2 * j + 1]];
            let judgement = (plane.stretches)(specimen, pair).and_then(|all| Judgement::of(specimen, all));
            cells[CELLS * i + j] = kind(judgement);
            cells[CELLS * j + i] = cells[CELLS * i + j];
        }
    }
    cells
}

/// Colours and what they mean, three in a row.
fn explain(area: &Area<'_>) -> Result<(), ChartError> {
    let style = (FONT, 14).into_font().color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center));
    for (k, (name, colour)) in KINDS.into_iter().enumerate() {
        let (x, y) = (64 + 330 * (k as i32 % 3), 14 + 30 * (k as i32 / 3));
        let corners = [(x, y), (x + 24, y + 16)];
        area.draw(&Rectangle::new(corners, colour.filled())).map_err(failed)?;
        area.draw(&Rectangle::new(corners, RGBColor(120, 120, 120))).map_err(failed)?;
        area.draw(&Text::new(name, (x + 34, y + 9), style.clone())).map_err(failed)?;
    }
    Ok(())
}
