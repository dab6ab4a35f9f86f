//! A picture in memory.

use std::io::Write;

/// A picture of 8-bit sRGB pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Image {
    /// A picture of one colour.
    #[must_use]
    pub fn filled(width: usize, height: usize, colour: [u8; 3]) -> Self {
        Self { width, height, pixels: vec![colour; width * height] }
    }

    /// The rows from the top, each as long as the picture is wide.
    pub(super) fn rows_mut(&mut self) -> std::slice::ChunksExactMut<'_, [u8; 3]> {
        self.pixels.chunks_exact_mut(self.width.max(1))
    }

    /// Copies `tile` with its upper left corner to column `x`, row `y`. What sticks out is cut off.
    pub(super) fn paste(&mut self, tile: &Self, x: usize, y: usize) {
        let width = tile.width.min(self.width.saturating_sub(x));
        for (target, source) in
            self.rows_mut().skip(y).zip(tile.pixels.chunks_exact(tile.width.max(1))).take(tile.height)
        {
            target[x..x + width].copy_from_slice(&source[..width]);
        }
    }

    /// Writes the picture as PNG.
    ///
    /// # Errors
    /// If `target` cannot be written to, or a side of the picture is zero.
    pub fn write_png(&self, target: impl Write) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(target, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        writer.finish()
    }
}

/// Linear light in [0, 1] as sRGB.
pub(super) fn encode(linear: f32) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}
