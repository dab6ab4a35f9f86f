//! The picture of a run.

use std::io;

use piola_scenes::output::PICTURE_FILE;
use piola_scenes::run::Finished;
use piola_scenes::settings::Settings;

use crate::render::{Frame, contact_sheet};

/// Tiles of the contact sheet.
const TILES: usize = 12;

pub(crate) fn add(finished: &mut Finished, settings: &Settings) {
    let frame = |number: usize| -> io::Result<Frame> {
        let vertices = finished.surface_in(number)?;
        Ok(Frame { number, time: number as f64 * finished.summary.dt, vertices })
    };
    let frames: io::Result<Vec<_>> = tiles(&finished.motion).into_iter().map(frame).collect();
    let triangles = finished.geometry.triangles.clone();
    finished.add(PICTURE_FILE, |file| {
        contact_sheet(&frames?, &triangles, &settings.body.style).write_png(file).map_err(io::Error::from)
    });
}

/// Numbers of the frames for the tiles, from the mean distance that nodes have moved up to each frame.
///
/// Half of the spacing follows time and half the motion, of which most may happen in few frames.
fn tiles(motion: &[f64]) -> Vec<usize> {
    let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
    let last = motion.len().saturating_sub(1) as f64;
    let way = motion.last().copied().unwrap_or_default();
    let progress: Vec<_> =
        (0..motion.len()).map(|frame| share(frame as f64, last) + share(motion[frame], way)).collect();
    evenly_spread(&progress, TILES)
}

/// Indices of at most `count` of these ascending numbers, as evenly spaced as different ones can be, both
/// ends among them: of two as near the first.
fn evenly_spread(progress: &[f64], count: usize) -> Vec<usize> {
    let (Some(first), Some(last)) = (progress.first(), progress.last()) else { return Vec::new() };
    let count = count.min(progress.len());
    let mut chosen: Vec<usize> = Vec::with_capacity(count);
    for k in 0..count {
        let wanted = first + (last - first) * k as f64 / (count - 1).max(1) as f64;
        let distance = |index: usize| (progress[index] - wanted).abs();
        // Enough must be left for those still to come, and of equal numbers at the end the last is wanted.
        let next = chosen.last().map_or(0, |index| index + 1);
        let latest = progress.len() - (count - k);
        let nearest = (next..=latest).min_by(|&one, &other| distance(one).total_cmp(&distance(other)));
        chosen.push(nearest.filter(|_| k + 1 < count).unwrap_or(latest));
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
