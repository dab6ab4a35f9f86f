//! The frames of a run that its picture shows.

use piola_scenes::geometry::Geometry;
use piola_scenes::measure;
use piola_scenes::run::Snapshot;
use piola_scenes::settings::Settings;

use crate::render::{Frame, Image, contact_sheet};

/// The contact sheet.
pub(crate) const PICTURE_FILE: &str = "frames.png";

/// Tiles of the contact sheet.
const TILES: usize = 12;
/// How many frames are kept in memory to choose the tiles from.
const CANDIDATES: usize = 400;

/// Frames of a run from which some are chosen at its end.
pub(crate) struct Picture {
    dt: f64,
    last: usize,
    /// Node positions of the frame before, m.
    before: Vec<[f64; 3]>,
    /// Sum over all steps of the mean distance that nodes have moved, m.
    path: f64,
    /// Candidates for tiles, and the path up to each. Only the frames that `stride` divides are kept, and the
    /// last.
    candidates: Vec<(Frame, f64)>,
    stride: usize,
}

impl Picture {
    pub(crate) fn new(settings: &Settings) -> Self {
        let (dt, last) = (settings.dt, settings.frames);
        Self { dt, last, before: Vec::new(), path: 0.0, candidates: Vec::new(), stride: 1 }
    }

    pub(crate) fn add(&mut self, Snapshot { frame, nodes, surface }: Snapshot<'_>) {
        self.path += measure::mean_distance(&self.before, nodes);
        self.before.clear();
        self.before.extend_from_slice(nodes);
        if frame.is_multiple_of(self.stride) || frame == self.last {
            let frame = Frame { number: frame, time: frame as f64 * self.dt, vertices: surface.to_vec() };
            self.candidates.push((frame, self.path));
        }
        if self.candidates.len() > CANDIDATES {
            self.stride *= 2;
            self.candidates.retain(|(frame, _)| frame.number.is_multiple_of(self.stride));
        }
    }

    pub(crate) fn draw(&self, geometry: &Geometry, settings: &Settings) -> Image {
        // Half of the spacing follows time and half the motion, of which most may happen in few frames.
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let progress: Vec<_> = self
            .candidates
            .iter()
            .map(|(frame, path)| share(frame.number as f64, self.last as f64) + share(*path, self.path))
            .collect();
        let chosen = evenly_spread(&progress, TILES);
        let tiles: Vec<_> = chosen.into_iter().map(|index| self.candidates[index].0.clone()).collect();
        contact_sheet(&tiles, &geometry.triangles, &settings.body.style)
    }
}

/// Indices of at most `count` of these ascending numbers, as evenly spaced as different ones can be, both
/// ends among them.
fn evenly_spread(progress: &[f64], count: usize) -> Vec<usize> {
    let (Some(first), Some(last)) = (progress.first(), progress.last()) else { return Vec::new() };
    let count = count.min(progress.len());
    let mut chosen = Vec::with_capacity(count);
    let mut next = 0;
    for k in 0..count {
        let wanted = first + (last - first) * k as f64 / (count - 1).max(1) as f64;
        let after = progress.partition_point(|&other| other < wanted);
        let nearest = match after {
            0 => 0,
            after if after == progress.len() => after - 1,
            after if wanted - progress[after - 1] < progress[after] - wanted => after - 1,
            after => after,
        };
        // Enough must be left for those still to come, and of equal numbers at the end the last is wanted.
        let latest = progress.len() - (count - k);
        let index = if k + 1 == count { latest } else { nearest.clamp(next, latest) };
        chosen.push(index);
        next = index + 1;
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_frames_are_spread_from_first_to_last() {
        let steady: Vec<_> = (0..=150).map(f64::from).collect();
        assert_eq!(evenly_spread(&steady, 12), [0, 14, 27, 41, 55, 68, 82, 95, 109, 123, 136, 150]);
        assert_eq!(evenly_spread(&steady[..4], 12), [0, 1, 2, 3]);
        assert_eq!(evenly_spread(&[0.0, 8.0, 9.0, 9.5, 10.0], 3), [0, 1, 4]);
        assert_eq!(evenly_spread(&[0.0, 10.0, 10.0, 10.0], 3), [0, 1, 3]);
        assert_eq!(evenly_spread(&[], 3), [0; 0]);
    }
}
