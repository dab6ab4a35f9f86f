//! Lines of JSON that carry a checksum, so that a file that was changed or cut off is noticed.
//!
//! ```text
//! {"crc32":"1a2b3c4d","content":{…}}
//! ```
//!
//! The checksum is the CRC-32 of zip files, over the text of `content` as it stands there; in a file of
//! several lines, over the contents of all lines so far, one after the other. It guards against accidents,
//! not against malice.

use crc32fast::Hasher;
use piola::message::printable;
use piola_declare::LARGEST_TEXT;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::ser::Error as _;
use serde::{Deserialize, Serialize};
use serde_json::value::{RawValue, to_raw_value};

/// The longest text in a file, in bytes as it is written: that of an energy, of which ends of lines and
/// quotation marks take two each.
const MAX_TEXT: usize = 2 * LARGEST_TEXT;
/// The longest message about a line that is not as expected, in characters: it may repeat a text of the file.
const MAX_MESSAGE: usize = 1024;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line<'a> {
    /// Eight hexadecimal digits in lower case: another spelling is another text.
    crc32: &'a str,
    #[serde(borrow)]
    content: &'a RawValue,
}

/// Seals the lines of a file, from the first on.
#[derive(Clone, Debug, Default)]
pub struct Sealer {
    sum: Hasher,
}

impl Sealer {
    /// A sealer of a new file.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The next line, with its end.
    ///
    /// # Errors
    /// If JSON cannot say it, or a text in it is too long to be read again.
    pub fn line(&mut self, content: &impl Serialize) -> serde_json::Result<Vec<u8>> {
        let content = to_raw_value(content)?;
        if longest_text(content.get()) > MAX_TEXT {
            return Err(serde_json::Error::custom(SealError::LongText));
        }
        let mut line =
            serde_json::to_vec(&Line { crc32: &next(&mut self.sum, &content), content: &content })?;
        line.push(b'\n');
        Ok(line)
    }
}

/// Reads the lines that a [`Sealer`] has written, in their order.
#[derive(Clone, Debug, Default)]
pub struct Unsealer {
    sum: Hasher,
}

impl Unsealer {
    /// An unsealer of a file from its first line on.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The content of the next line.
    ///
    /// # Errors
    /// [`SealError`], and nothing after it can be read.
    pub fn line<T: DeserializeOwned>(&mut self, text: &str) -> Result<T, SealError> {
        let line: Line<'_> =
            serde_json::from_str(text).map_err(|error| SealError::NotJson(unsealed::<T>(text, error)))?;
        if next(&mut self.sum, line.content) != line.crc32 {
            return Err(SealError::Checksum);
        }
        if longest_text(line.content.get()) > MAX_TEXT {
            return Err(SealError::LongText);
        }
        serde_json::from_str(line.content.get()).map_err(SealError::NotJson)
    }
}

/// Why a line cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SealError {
    /// The line is not sealed JSON, or its content is something else than expected.
    #[error("{}", printable(&shortened(.0.to_string())))]
    NotJson(#[source] serde_json::Error),
    /// The checksum belongs to another content, or to other lines before.
    #[error("the checksum is wrong: the file has been changed or cut off")]
    Checksum,
    /// A text in the content is absurdly long.
    #[error("a text in it is longer than {MAX_TEXT} bytes")]
    LongText,
}

/// A message, cut where it is long.
fn shortened(mut message: String) -> String {
    if let Some((end, _)) = message.char_indices().nth(MAX_MESSAGE) {
        message.truncate(end);
        message.push('…');
    }
    message
}

/// The checksum once this content has been added.
fn next(sum: &mut Hasher, content: &RawValue) -> String {
    sum.update(content.get().as_bytes());
    format!("{:08x}", sum.clone().finalize())
}

/// The error of a line that is not sealed. One without a checksum may be of an older format, and its content
/// says so.
fn unsealed<T: DeserializeOwned>(text: &str, error: serde_json::Error) -> serde_json::Error {
    #[derive(Deserialize)]
    struct Probe {
        crc32: Option<IgnoredAny>,
    }
    match (serde_json::from_str(text), serde_json::from_str::<T>(text)) {
        (Ok(Probe { crc32: None }), Err(meaning)) => meaning,
        _ => error,
    }
}

/// Length of the longest string of JSON, in bytes as it is written.
fn longest_text(json: &str) -> usize {
    let (mut longest, mut start, mut is_escaped) = (0, None, false);
    for (at, byte) in json.bytes().enumerate() {
        match (start, byte) {
            (Some(_), _) if is_escaped => is_escaped = false,
            (Some(_), b'\\') => is_escaped = true,
            (Some(first), b'"') => {
                longest = longest.max(at - first);
                start = None;
            }
            (None, b'"') => start = Some(at + 1),
            _ => {}
        }
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(contents: &[Vec<f64>]) -> Vec<String> {
        let mut sealer = Sealer::new();
        let line = |content| String::from_utf8(sealer.line(content).expect("JSON")).expect("text");
        contents.iter().map(line).collect()
    }

    fn contents(lines: &[String]) -> Result<Vec<Vec<f64>>, SealError> {
        let mut unsealer = Unsealer::new();
        lines.iter().map(|line| unsealer.line(line)).collect()
    }

    #[test]
    fn what_was_sealed_comes_back() {
        let given = [vec![0.1, -1e-300], vec![], vec![f64::MAX]];
        assert_eq!(contents(&lines(&given)).expect("sealed"), given);
        // Known from elsewhere: crc32 of `[]`.
        assert_eq!(lines(&[vec![]]), ["{\"crc32\":\"0d4cbb29\",\"content\":[]}\n"]);
    }

    #[test]
    fn lines_that_are_removed_moved_or_repeated_are_noticed() {
        let whole = lines(&[vec![1.0], vec![2.0], vec![3.0]]);
        assert!(contents(&whole[..2]).is_ok(), "a beginning is readable");
        for order in [&[0, 2][..], &[1, 2], &[0, 2, 1], &[0, 0], &[0, 1, 1]] {
            let changed: Vec<_> = order.iter().map(|&line| whole[line].clone()).collect();
            assert!(matches!(contents(&changed), Err(SealError::Checksum)), "{order:?}");
        }
    }

    #[test]
    fn every_bit_counts() {
        let line = lines(&[vec![0.25, 17.0]]).remove(0).into_bytes();
        for bit in 0..8 * line.len() {
            let mut changed = line.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            let Ok(changed) = String::from_utf8(changed) else { continue };
            assert!(contents(std::slice::from_ref(&changed)).is_err(), "{changed}");
        }
    }

    #[test]
    fn a_line_without_a_checksum_is_judged_by_what_it_says() {
        let message = |text: &str| Unsealer::new().line::<Vec<f64>>(text).expect_err(text).to_string();
        assert!(message("{\"colour\":1}").contains("map"), "{}", message("{\"colour\":1}"));
        assert!(message("{\"crc32\":\"00000000\"}").contains("content"));
        assert!(message("[1.0]").contains("invalid"), "{}", message("[1.0]"));
    }

    #[test]
    fn long_texts_are_neither_written_nor_read() {
        let text = |length| "é\\\"".repeat(length);
        let mut sealer = Sealer::new();
        assert!(sealer.line(&text(MAX_TEXT / 8)).is_ok());
        assert!(sealer.line(&text(MAX_TEXT)).is_err());
        assert_eq!(longest_text(r#"{"a":["b\\","","\"cd"],"ef":1}"#), 4);
        let name = format!("{{\"{}\":1}}", "y".repeat(MAX_TEXT));
        let message = Unsealer::new().line::<Vec<f64>>(&name).expect_err("no list").to_string();
        assert!(message.chars().count() <= MAX_MESSAGE + 1, "{message}");
    }
}
