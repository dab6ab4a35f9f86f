//! Secret token that opens the page; it is part of the printed address.

use std::{fmt, io};

use data_encoding::HEXLOWER;
use subtle::ConstantTimeEq;

use crate::error::Error;

/// A random number of 128 bits, as hexadecimal digits.
#[derive(Clone)]
pub(super) struct Token(String);

impl Token {
    /// A number that nobody can guess.
    ///
    /// # Errors
    /// [`Error::System`].
    pub(super) fn new() -> Result<Self, Error> {
        let mut bytes = [0; 16];
        let filled = getrandom::fill(&mut bytes).map_err(|error| io::Error::other(error.to_string()));
        filled.map_err(Error::system("make a token for the page"))?;
        Ok(Self(HEXLOWER.encode(&bytes)))
    }

    /// True if a request with this query, the part of an address behind `?`, contains the token exactly once.
    /// The time of the comparison does not depend on the number of correct characters.
    pub(super) fn is_in(&self, query: Option<&str>) -> bool {
        let mut tokens = query.unwrap_or_default().split('&').filter_map(|pair| pair.strip_prefix("token="));
        match (tokens.next(), tokens.next()) {
            (Some(token), None) => token.as_bytes().ct_eq(self.0.as_bytes()).into(),
            _ => false,
        }
    }
}

impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
