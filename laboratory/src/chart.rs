//! Test curves and measured points as charts in SVG.
//!
//! Curves over a stretch share one panel; those over a shear or a volume have their own. A curve has a gap
//! where the material has no stress. [`map`](fn@map) draws the stability of a solid.

mod map;
mod panel;
mod picture;

use crate::curve::{Mode, Response, ResponseError};
use crate::data::{Agreement, Measurements};
use panel::Panel;
use picture::{HEAD, head, picture};

pub use map::map;
pub use picture::ChartError;

/// A curve to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The test.
    pub mode: Mode,
    /// Its points, in the order of their controls.
    pub points: Vec<Result<Response, ResponseError>>,
}

/// Pixels of a panel.
const WIDTH: u32 = 640;
const HEIGHT: u32 = 520;

/// The SVG text of a chart with a title, an explanatory line, and R² of each mode if there are data.
///
/// # Errors
/// [`ChartError`] if there is neither a point of a curve nor one of the data, if one is too large for an
/// axis, or the library of charts fails.
pub fn draw(
    title: &str,
    note: &str,
    curves: &[Curve],
    data: Option<(&Measurements, &Agreement)>,
) -> Result<String, ChartError> {
    let panels: Vec<_> = GROUPS.iter().filter_map(|group| Panel::of(group, curves, data)).collect();
    if panels.is_empty() {
        let empty = "there is no point to draw: the material has no stress at any of them";
        return Err(ChartError(empty.into()));
    }
    picture((WIDTH * panels.len() as u32, HEAD + HEIGHT), |root, above| {
        let areas = head(root, title, note)?.split_evenly((1, panels.len()));
        panels.iter().zip(areas).try_for_each(|(panel, area)| panel.draw(&area, above))
    })
}

/// Modes with axes in common.
struct Group {
    modes: &'static [Mode],
    /// Label of the control.
    control: &'static str,
    /// Label of the stress.
    stress: &'static str,
}

const GROUPS: [Group; 3] = [
    Group {
        modes: &[Mode::Uniaxial, Mode::Equibiaxial, Mode::PureShear],
        control: "stretch λ",
        stress: "nominal stress",
    },
    Group { modes: &[Mode::SimpleShear], control: "shear γ", stress: "shear stress P12" },
    Group { modes: &[Mode::Volumetric], control: "volume ratio J", stress: "mean Cauchy stress" },
];
