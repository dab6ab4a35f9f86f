//! Mutations of texts: what a disk, an editor, or somebody with a grudge does to a file.

use piola::__private::random::Random;

/// Values that readers stumble over.
const VALUES: &[&str] = &[
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "9",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e400",
    "NaN",
    "inf",
    "-inf",
    "1e103",
    "1e-103",
    "3.5e38",
    "65536",
    "4294967296",
    "18446744073709551615",
    "9223372036854775808",
    "99999999999999999999",
    "0x10",
    "1_000",
    "",
    "null",
    "\"\"",
    "[]",
    "{}",
    "tetrahedron",
];
/// Pieces that do not belong into a text.
const PIECES: &[&str] =
    &["\u{feff}", "\0", "\u{1b}[31m", "\r\n", "\n\n", "\t", "$", "\"", "ü", "\u{202e}", "#", ","];

/// A text with one to four mutations.
#[must_use]
pub fn mutated(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=below(random, 4) {
        mutate(&mut bytes, random);
    }
    bytes
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    let range = |bytes: &[u8], random: &mut Random| {
        let start = below(random, bytes.len() + 1);
        start..start + below(random, (bytes.len() - start).min(40) + 1)
    };
    match below(random, 10) {
        0 if !bytes.is_empty() => {
            let at = below(random, bytes.len());
            bytes[at] ^= 1 << below(random, 8);
        }
        1 => {
            let range = range(bytes, random);
            bytes.drain(range);
        }
        2 => {
            let range = range(bytes, random);
            let (at, piece) = (range.end, bytes[range].to_vec());
            bytes.splice(at..at, piece);
        }
        3 => bytes.truncate(below(random, bytes.len() + 1)),
        4 => {
            let at = below(random, bytes.len() + 1);
            bytes.splice(at..at, PIECES[below(random, PIECES.len())].bytes());
        }
        5 | 6 => lines(bytes, random),
        _ => value(bytes, random),
    }
}

/// Removes, repeats or moves a line.
fn lines(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut lines: Vec<_> = bytes.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
    if lines.is_empty() {
        return;
    }
    let (one, other) = (below(random, lines.len()), below(random, lines.len()));
    match below(random, 3) {
        0 => drop(lines.remove(one)),
        1 => lines.insert(other, lines[one].clone()),
        _ => lines.swap(one, other),
    }
    *bytes = lines.concat();
}

/// Replaces a word or a number by another.
fn value(bytes: &mut Vec<u8>, random: &mut Random) {
    let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-._".contains(byte);
    let mut words = Vec::new();
    let mut start = 0;
    for end in 0..=bytes.len() {
        if end == bytes.len() || !is_word(&bytes[end]) {
            words.extend((start < end).then_some(start..end));
            start = end + 1;
        }
    }
    if words.is_empty() {
        return;
    }
    let word = words.swap_remove(below(random, words.len()));
    bytes.splice(word, VALUES[below(random, VALUES.len())].bytes());
}

/// A random index below a count that is not zero.
fn below(random: &mut Random, count: usize) -> usize {
    (random.uniform(0.0, count as f64) as usize).min(count - 1)
}
