//! Small captions from a built-in alphabet, five by seven pixels a letter.

use super::image::Image;

const WIDTH: usize = 5;
const HEIGHT: usize = 7;
/// Distance from one letter to the next.
const ADVANCE: usize = WIDTH + 1;

/// Writes `text` with its upper left corner at column `x`, row `y`, every dot being `scale` pixels wide.
///
/// The alphabet holds digits, the point and the letters of "frame s"; anything else is left blank.
pub(super) fn write(image: &mut Image, text: &str, [x, y]: [usize; 2], scale: usize, ink: [u8; 3]) {
    for (row, pixels) in image.rows_mut().skip(y).take(HEIGHT * scale).enumerate() {
        for (position, letter) in text.chars().enumerate() {
            let dots = glyph(letter)[row / scale];
            for column in 0..WIDTH * scale {
                let is_set = dots >> (WIDTH - 1 - column / scale) & 1 == 1;
                if let (true, Some(pixel)) = (is_set, pixels.get_mut(x + position * ADVANCE * scale + column))
                {
                    *pixel = ink;
                }
            }
        }
    }
}

/// The rows of a letter from the top, the leftmost dot in bit 4.
fn glyph(letter: char) -> [u8; HEIGHT] {
    match letter {
        '0' => [0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111],
        '3' => [0b01110, 0b10001, 0b00001, 0b00110, 0b00001, 0b10001, 0b01110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100],
        '.' => [0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100],
        'a' => [0b00000, 0b00000, 0b01110, 0b00001, 0b01111, 0b10001, 0b01111],
        'e' => [0b00000, 0b00000, 0b01110, 0b10001, 0b11111, 0b10000, 0b01110],
        'f' => [0b00110, 0b01001, 0b01000, 0b11100, 0b01000, 0b01000, 0b01000],
        'm' => [0b00000, 0b00000, 0b11010, 0b10101, 0b10101, 0b10101, 0b10101],
        'r' => [0b00000, 0b00000, 0b10110, 0b11001, 0b10000, 0b10000, 0b10000],
        's' => [0b00000, 0b00000, 0b01111, 0b10000, 0b01110, 0b00001, 0b11110],
        _ => [0; HEIGHT],
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn letters_differ_and_what_sticks_out_is_cut_off() {
        let picture = |text: &str, place| {
            let mut image = Image::filled(12, 16, [0; 3]);
            write(&mut image, text, place, 2, [255; 3]);
            image
        };
        let letters = "0123456789.aefmrs ";
        let different: HashSet<_> = letters.chars().map(glyph).collect();
        assert_eq!(different.len(), letters.len());
        assert!(picture("888", [8, 12]) != picture("", [0, 0]), "the part inside is drawn");
        assert!(picture("8", [90, 90]) == picture("", [0, 0]), "nothing of it is inside");
    }
}
