//! A line of JSON with a checksum, by which changes and truncation are detected.
//!
//! ```text
//! {"crc32":"1a2b3c4d","content":{…}}
//! ```
//!
//! The checksum is the CRC-32 of zip files, over the text of `content` as it stands there. It guards against
//! accidents, not against malice.

use piola::__private::message::printable;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::value::{RawValue, to_raw_value};

/// Longest message about an unexpected line, in characters: it may repeat a text of the file.
const MAX_MESSAGE: usize = 1024;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line<'a> {
    /// Eight hexadecimal digits in lower case: another spelling is another text.
    crc32: &'a str,
    #[serde(borrow)]
    content: &'a RawValue,
}

/// A content as a line with its checksum and its end.
///
/// # Errors
/// If it cannot be represented in JSON.
pub fn seal(content: &impl Serialize) -> serde_json::Result<Vec<u8>> {
    let content = to_raw_value(content)?;
    let mut line = serde_json::to_vec(&Line { crc32: &checksum(&content), content: &content })?;
    line.push(b'\n');
    Ok(line)
}

/// The content of a line that [`seal`] has written.
///
/// # Errors
/// The reason why it is none, or has another content.
pub fn unseal<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let unexpected = |error: serde_json::Error| {
        printable(&error.to_string().chars().take(MAX_MESSAGE).collect::<String>())
    };
    let line: Line<'_> = serde_json::from_str(text).map_err(unexpected)?;
    if checksum(line.content) != line.crc32 {
        return Err("the checksum is wrong: the file has been changed or cut off".into());
    }
    serde_json::from_str(line.content.get()).map_err(unexpected)
}

fn checksum(content: &RawValue) -> String {
    format!("{:08x}", crc32fast::hash(content.get().as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_sealed_comes_back() {
        for given in [vec![0.1, -1e-300], vec![], vec![f64::MAX]] {
            let line = String::from_utf8(seal(&given).expect("JSON")).expect("text");
            assert_eq!(unseal::<Vec<f64>>(&line).expect("sealed"), given);
        }
        // Known from elsewhere: crc32 of `[]`.
        assert_eq!(seal(&Vec::<f64>::new()).expect("JSON"), b"{\"crc32\":\"0d4cbb29\",\"content\":[]}\n");
    }

    #[test]
    fn every_bit_and_every_cut_is_noticed() {
        let whole = seal(&[0.1, 2.0]).expect("JSON");
        let is_taken =
            |bytes: &[u8]| std::str::from_utf8(bytes).is_ok_and(|text| unseal::<Vec<f64>>(text).is_ok());
        assert!(is_taken(&whole));
        for bit in 0..8 * whole.len() {
            let mut changed = whole.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            assert!(!is_taken(&changed), "bit {bit}");
        }
        // Nothing is missing without the line end.
        assert!((0..whole.len() - 1).all(|length| !is_taken(&whole[..length])));
    }

    #[test]
    fn messages_are_short() {
        let name = format!("{{\"{}\":1}}", "y".repeat(1 << 20));
        let message = unseal::<Vec<f64>>(&name).expect_err("no list");
        assert!(message.chars().count() <= MAX_MESSAGE, "{message}");
    }
}
