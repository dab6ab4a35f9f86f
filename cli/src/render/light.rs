//! Light that reaches a point: a soft key light and a sky, both as bundles of distant lamps with shadow maps.

use std::f32::consts::TAU;

use rayon::prelude::*;

use super::camera::Camera;
use super::raster::DepthBuffer;
use super::{Surface, Vector};

/// Pixels along a side of a shadow map.
const MAP: usize = 320;
/// Lamps in the key light, on a disc wide enough for a soft penumbra.
const KEY_LAMPS: usize = 16;
/// Lamps in the sky; fewer would show as separate shadows on the floor.
const SKY_LAMPS: usize = 40;
/// The angular radius of the key light as the tangent of half its opening.
const KEY_RADIUS: f32 = 0.10;
/// Linear RGB irradiance on open floor: they add up to about white.
const KEY_COLOUR: [f32; 3] = [0.66, 0.61, 0.53];
const SKY_COLOUR: [f32; 3] = [0.34, 0.39, 0.47];

/// All lamps with the shadows that one surface casts from each.
#[derive(Debug)]
pub(super) struct Lights {
    lamps: Vec<Lamp>,
    /// Towards the key light, unit length.
    pub(super) key: Vector,
    /// Points are lifted off their surface by this much before they look for shadows, so that none shades
    /// itself.
    lift: f32,
    open_floor: Vector,
}

#[derive(Debug)]
struct Lamp {
    /// Towards the lamp, unit length.
    direction: Vector,
    /// Irradiance on a plane facing it.
    power: Vector,
    is_key: bool,
    camera: Camera,
    map: DepthBuffer,
}

/// The light at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Received {
    /// Linear RGB; one each on open floor.
    pub(super) irradiance: Vector,
    /// The share of the key light that is not in shadow.
    pub(super) key_share: f32,
}

impl Lights {
    /// The lamps around `surface`, whose vertices lie in the sphere about `centre`; `key` points towards the
    /// key light.
    pub(super) fn around(surface: Surface<'_>, centre: Vector, radius: f32, key: Vector) -> Self {
        let key = key.normalize();
        let lamps = lamps(key)
            .into_par_iter()
            .map(|(direction, power, is_key)| {
                let camera = Camera::parallel(centre, radius, -direction, MAP as f32);
                Lamp { direction, power, is_key, camera, map: DepthBuffer::of(surface, &camera, MAP, MAP) }
            })
            .collect::<Vec<_>>();
        let open_floor = lamps.iter().map(|lamp| lamp.power * lamp.direction.y).sum();
        Self { lamps, key, lift: 3.0 * radius / MAP as f32, open_floor }
    }

    /// The light that a surface at `point` receives from the side of its unit normal `normal`.
    pub(super) fn at(&self, point: Vector, normal: Vector) -> Received {
        let point = point + normal * self.lift;
        let mut irradiance = Vector::zeros();
        let mut key_share = 0.0;
        for lamp in &self.lamps {
            let cosine = normal.dot(&lamp.direction);
            if cosine > 0.0 && lamp.reaches(point) {
                irradiance += lamp.power * cosine;
                key_share += if lamp.is_key { 1.0 / KEY_LAMPS as f32 } else { 0.0 };
            }
        }
        Received { irradiance: irradiance.component_div(&self.open_floor), key_share }
    }
}

impl Lamp {
    fn reaches(&self, point: Vector) -> bool {
        let [x, y, nearness] = self.camera.project(point);
        if x < 0.0 || y < 0.0 || x >= MAP as f32 || y >= MAP as f32 {
            return true;
        }
        nearness >= self.map.nearness[y as usize * MAP + x as usize]
    }
}

/// Direction, power and kind of every lamp.
///
/// The sky's are spread evenly over the upper half sphere by the golden-angle spiral, the key light's
/// likewise over its disc.
fn lamps(key: Vector) -> Vec<(Vector, Vector, bool)> {
    let golden_angle = TAU * (2.0 - 1.618_034);
    let across = key.cross(&Vector::y()).normalize();
    let over = across.cross(&key);
    let key_power = Vector::from(KEY_COLOUR) / (KEY_LAMPS as f32 * key.y);
    let key_lamps = (0..KEY_LAMPS).map(move |k| {
        let radius = KEY_RADIUS * ((k as f32 + 0.5) / KEY_LAMPS as f32).sqrt();
        let (sine, cosine) = (golden_angle * k as f32).sin_cos();
        ((key + (across * cosine + over * sine) * radius).normalize(), key_power, true)
    });
    // Heights uniform in (0, 1) are uniform in solid angle; their mean cosine with the floor is 1/2.
    let sky_power = Vector::from(SKY_COLOUR) * 2.0 / SKY_LAMPS as f32;
    let sky_lamps = (0..SKY_LAMPS).map(move |k| {
        let height = (k as f32 + 0.5) / SKY_LAMPS as f32;
        let (sine, cosine) = (golden_angle * k as f32).sin_cos();
        let radius = (1.0 - height * height).sqrt();
        (Vector::new(radius * cosine, height, radius * sine), sky_power, false)
    });
    key_lamps.chain(sky_lamps).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A horizontal square at height one.
    const SQUARE: ([[f32; 3]; 4], [[u32; 3]; 2]) =
        ([[-1.0, 1.0, -1.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]], [[0, 1, 2], [0, 2, 3]]);

    #[test]
    fn open_floor_is_white_and_floor_under_a_roof_is_dark() {
        let surface = Surface { vertices: &SQUARE.0, triangles: &SQUARE.1 };
        let lights = Lights::around(surface, Vector::y(), 2.0, Vector::new(-0.3, 1.0, 0.3));
        let open = lights.at(Vector::new(40.0, 0.0, 0.0), Vector::y());
        // One rounding per lamp.
        assert!((open.irradiance - Vector::repeat(1.0)).amax() < 1e-5, "{open:?}");
        assert!((open.key_share - 1.0).abs() < 1e-5, "{open:?}");
        let under = lights.at(Vector::new(0.0, 0.8, 0.0), Vector::y());
        assert!(under.key_share == 0.0 && under.irradiance.amax() < 0.2, "{under:?}");
        let above = lights.at(Vector::y(), Vector::y());
        assert!((above.irradiance - Vector::repeat(1.0)).amax() < 1e-5, "shades itself: {above:?}");
    }
}
