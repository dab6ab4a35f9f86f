//! Frames of a motion side by side.

use piola_scenes::scene::Style;
use rayon::prelude::*;

use super::camera::Camera;
use super::image::{Image, encode};
use super::light::Lights;
use super::raster::{DepthBuffer, NOTHING};
use super::{Surface, Vector, label};

/// Size of a tile in pixels, without its caption.
const TILE: [usize; 2] = [480, 390];
/// Height of the strip above a tile that bears its caption.
const CAPTION: usize = 28;
/// Samples along each side of a pixel.
const SAMPLES: usize = 3;
/// Samples of a pixel from its middle outwards.
const FROM_MIDDLE: [usize; SAMPLES * SAMPLES] = [4, 1, 3, 5, 7, 0, 2, 6, 8];
const COLUMNS: usize = 4;
/// Free pixels between the tiles and around them.
const GUTTER: usize = 6;
const PAPER: [u8; 3] = [252, 251, 249];
const INK: [u8; 3] = [92, 92, 100];
/// Linear RGB of the floor near the body and of the haze that it fades into.
const FLOOR: [f32; 3] = [0.80, 0.80, 0.795];
const HAZE: [f32; 3] = [0.90, 0.915, 0.94];

/// One frame of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Its number, for the caption.
    pub number: usize,
    /// Its time in seconds, for the caption.
    pub time: f64,
    /// Deformed positions of the surface's vertices, m.
    pub vertices: Vec<[f32; 3]>,
}

/// Draws frames of a deforming surface as tiles of one picture, seen by one camera that fits them all.
///
/// The floor lies under the lowest point of the body in half of the frames. Vertices that are not finite are
/// left out.
#[must_use]
pub fn contact_sheet(frames: &[Frame], triangles: &[[u32; 3]], style: &Style) -> Image {
    let columns = frames.len().clamp(1, COLUMNS);
    let rows = frames.len().div_ceil(columns).max(1);
    let cell = [TILE[0] + GUTTER, TILE[1] + CAPTION + GUTTER];
    let [width, height] = [GUTTER + columns * cell[0], GUTTER + rows * cell[1]];
    let mut sheet = Image::filled(width, height, PAPER);
    let Some(stage) = Stage::for_motion(frames, style) else { return sheet };
    for (index, frame) in frames.iter().enumerate() {
        let tile = stage.draw(Surface { vertices: &frame.vertices, triangles }, style.colour);
        let [x, y] = [GUTTER + (index % columns) * cell[0], GUTTER + (index / columns) * cell[1]];
        let caption = format!("frame {}   {:.2} s", frame.number, frame.time);
        label::write(&mut sheet, &caption, [x + 10, y + 8], 2, INK);
        sheet.paste(&tile, x, y + CAPTION);
    }
    sheet
}

/// Camera, light and floor, which the tiles share.
#[derive(Debug)]
struct Stage {
    camera: Camera,
    key: Vector,
    centre: Vector,
    radius: f32,
    floor: f32,
}

impl Stage {
    /// None where no vertex is finite.
    fn for_motion(frames: &[Frame], style: &Style) -> Option<Self> {
        let vertices = || {
            let all = frames.iter().flat_map(|frame| &frame.vertices);
            all.filter(|vertex| vertex.iter().all(|x| x.is_finite())).map(|&vertex| Vector::from(vertex))
        };
        let low = vertices().reduce(|low, vertex| low.inf(&vertex))?;
        let high = vertices().reduce(|high, vertex| high.sup(&vertex))?;
        let radius = (0.5 * (high - low).norm()).max(f32::MIN_POSITIVE);
        let (azimuth, elevation) = (style.azimuth.to_radians(), style.elevation.to_radians());
        let from =
            Vector::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
        let camera = Camera::fitting(vertices(), -from, TILE.map(|size| (size * SAMPLES) as f32), 0.1);
        // High over the left shoulder of whoever looks, so that shadows fall to the right and stay short.
        let left = Vector::y().cross(&from).normalize() * -1.0;
        let key = Vector::y() * 1.5 + left * 0.6 + from * 0.75;
        // A frame or two may swing through the floor without lowering it for the others.
        let mut lowest: Vec<f32> = frames
            .iter()
            .map(|frame| frame.vertices.iter().map(|vertex| vertex[1]).fold(f32::INFINITY, f32::min))
            .filter(|height| height.is_finite())
            .collect();
        lowest.sort_unstable_by(f32::total_cmp);
        // A flattened body lies on the floor, not in it.
        let floor = lowest.get(lowest.len() / 2).unwrap_or(&low.y) - 0.004 * radius;
        Some(Self { camera, key, centre: 0.5 * (low + high), radius, floor })
    }

    fn draw(&self, surface: Surface<'_>, colour: [f32; 3]) -> Image {
        let [width, height] = TILE.map(|size| size * SAMPLES);
        let lights = Lights::around(surface, self.centre, 1.02 * self.radius, self.key);
        let seen = DepthBuffer::of(surface, &self.camera, width, height);
        let normals = vertex_normals(surface);
        let light = |triangle: u32, [row, column]: [usize; 2]| {
            let (eye, direction) = self.camera.ray(column as f32 + 0.5, row as f32 + 0.5);
            match triangle {
                NOTHING => self.floor_light(&lights, eye, direction),
                triangle => body_light(surface, &normals, &lights, triangle as usize, eye, direction, colour),
            }
        };
        let mut tile = Image::filled(TILE[0], TILE[1], PAPER);
        tile.rows_mut().collect::<Vec<_>>().into_par_iter().enumerate().for_each(|(row, pixels)| {
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let places: [_; SAMPLES * SAMPLES] =
                    std::array::from_fn(|k| [row * SAMPLES + k / SAMPLES, column * SAMPLES + k % SAMPLES]);
                let seen = places.map(|[row, column]| seen.triangle[row * width + column]);
                // Light hardly changes over a pixel: it is computed once for the body and once for the floor.
                let nearest = |is_floor: bool| {
                    let k = FROM_MIDDLE.into_iter().find(|&k| (seen[k] == NOTHING) == is_floor);
                    k.map_or_else(Vector::zeros, |k| light(seen[k], places[k]))
                };
                let floor = seen.iter().filter(|&&triangle| triangle == NOTHING).count();
                let floor = floor as f32 / seen.len() as f32;
                *pixel = nearest(false).lerp(&nearest(true), floor).map(encode).into();
            }
        });
        tile
    }

    /// The floor with the body's shadow, fading into haze far away.
    fn floor_light(&self, lights: &Lights, eye: Vector, direction: Vector) -> Vector {
        let haze = Vector::from(HAZE);
        let distance = (self.floor - eye.y) / direction.y;
        if !(distance > 0.0 && distance.is_finite()) {
            return haze;
        }
        let point = eye + direction * distance;
        let away = (point - self.centre).xz().norm() / self.radius;
        let clear = (-0.16 * away * away).exp();
        let light = if away < 6.0 { lights.at(point, Vector::y()).irradiance } else { Vector::repeat(1.0) };
        haze.lerp(&Vector::from(FLOOR).component_mul(&light), clear)
    }
}

/// Light that a body of dull clay sends towards the eye from the point where the ray meets `triangle`.
fn body_light(
    surface: Surface<'_>,
    normals: &[Vector],
    lights: &Lights,
    triangle: usize,
    eye: Vector,
    direction: Vector,
    colour: [f32; 3],
) -> Vector {
    let [a, b, c] = surface.corners(triangle);
    let across = (b - a).cross(&(c - a));
    let facing = across.dot(&direction);
    let distance = across.dot(&(a - eye)) / facing;
    let point = eye + direction * distance;
    let shares = [(b, c), (c, a), (a, b)].map(|(p, q)| (p - point).cross(&(q - point)).dot(&across));
    // Both sides are visible; the normal is that of the side in view.
    let side = if facing > 0.0 { -1.0 } else { 1.0 };
    let flat = across.normalize() * side;
    let smooth: Vector = surface.triangles[triangle]
        .iter()
        .zip(shares)
        .map(|(&vertex, share)| normals[vertex as usize] * (share * side))
        .sum();
    // Where the surface is crumpled, the mean of opposite normals means nothing.
    let smooth = smooth.try_normalize(0.0).filter(|smooth| smooth.dot(&flat) > 0.2).unwrap_or(flat);
    let received = lights.at(point, smooth);
    // The floor throws some of its light back from below.
    let bounce = Vector::from(FLOOR) * (0.13 * (1.0 - smooth.y));
    let half_way = (lights.key - direction).normalize();
    let gloss = 0.10 * received.key_share * smooth.dot(&half_way).max(0.0).powi(36);
    Vector::from(colour).component_mul(&(received.irradiance + bounce)) + Vector::repeat(gloss)
}

/// Unit normals at the vertices, the mean of the triangles' around each weighted by area.
fn vertex_normals(surface: Surface<'_>) -> Vec<Vector> {
    let mut normals = vec![Vector::zeros(); surface.vertices.len()];
    for (index, triangle) in surface.triangles.iter().enumerate() {
        let [a, b, c] = surface.corners(index);
        let across = (b - a).cross(&(c - a));
        if across.iter().all(|x| x.is_finite()) {
            triangle.iter().for_each(|&vertex| normals[vertex as usize] += across);
        }
    }
    normals.into_iter().map(|normal| normal.try_normalize(0.0).unwrap_or_default()).collect()
}
