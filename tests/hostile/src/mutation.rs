//! Mutations of texts: what a disk, an editor, or somebody with a grudge does to a file.

use piola::__private::random::Random;

/// Values that readers stumble over, separated by spaces; one of them is empty.
const VALUES: &str = "0 -0 -1 1 2 9 1e308 -1e308 1e-308 5e-324 1e400 NaN inf -inf 1e103 1e-103 3.5e38 65536 \
    4294967296 18446744073709551615 9223372036854775808 99999999999999999999 0x10 1_000  null \"\" [] {} tetrahedron";

/// Pieces that do not belong into a text.
const PIECES: &[&str] =
    &["\u{feff}", "\0", "\u{1b}[31m", "\r\n", "\n\n", "\t", "$", "\"", "ü", "\u{202e}", "#", ","];

/// A text with one to four mutations.
#[must_use]
pub fn mutated(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=random.below(4) {
        mutate(&mut bytes, random);
    }
    bytes
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    let start = random.below(bytes.len() + 1);
    let end = start + random.below((bytes.len() - start).min(40) + 1);
    match random.below(10) {
        0 if start < bytes.len() => bytes[start] ^= 1 << random.below(8),
        1 => drop(bytes.drain(start..end)),
        2 => {
            let piece = bytes[start..end].to_vec();
            drop(bytes.splice(end..end, piece));
        }
        3 => bytes.truncate(start),
        4 => drop(bytes.splice(start..start, PIECES[random.below(PIECES.len())].bytes())),
        5 | 6 => lines(bytes, random),
        _ => {
            // The word or number around `start`.
            let is_border = |byte: &u8| !byte.is_ascii_alphanumeric() && !b"+-._".contains(byte);
            let end = bytes[start..].iter().position(is_border).map_or(bytes.len(), |length| start + length);
            let start = bytes[..start].iter().rposition(is_border).map_or(0, |before| before + 1);
            let values: Vec<&str> = VALUES.split(' ').collect();
            drop(bytes.splice(start..end, values[random.below(values.len())].bytes()));
        }
    }
}

/// Removes, repeats or moves a line.
fn lines(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut lines: Vec<_> = bytes.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
    if lines.is_empty() {
        return;
    }
    let (one, other) = (random.below(lines.len()), random.below(lines.len()));
    match random.below(3) {
        0 => drop(lines.remove(one)),
        1 => lines.insert(other, lines[one].clone()),
        _ => lines.swap(one, other),
    }
    *bytes = lines.concat();
}
