//! Text from the bytes of a file in any encoding of spreadsheets and test machines.

use std::borrow::Cow;

/// The text of a file in UTF-8, in UTF-16 with its mark, as spreadsheets write "Unicode text", or else in
/// Latin-1, as older test machines do.
///
/// ```
/// use piola_laboratory::data::decoded;
///
/// assert_eq!(decoded(b"Pr\xfcfzeit"), "Prüfzeit");
/// assert_eq!(decoded(b"\xff\xfe1\0;\0"), "1;");
/// ```
#[must_use]
pub fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let units = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
        Cow::Owned(String::from_utf16_lossy(&units))
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => units(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => units(rest, u16::from_be_bytes),
        _ => match str::from_utf8(bytes) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => Cow::Owned(bytes.iter().copied().map(char::from).collect()),
        },
    }
}
