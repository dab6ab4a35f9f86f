//! Lists of values by key, one after the other in memory.

use super::linear::LinearError;
use super::memory::filled;

/// The values of each key, in the order in which they are given.
#[derive(Clone, Debug)]
pub(crate) struct Lists<T> {
    /// Start of each list among the values, and the end of the last.
    pub(super) starts: Vec<usize>,
    pub(super) values: Vec<T>,
}

impl<T> Lists<T> {
    /// No lists; the values of the next one are pushed before it [ends](Self::end).
    pub(crate) fn none() -> Self {
        Self { starts: vec![0], values: Vec::new() }
    }

    pub(crate) fn end(&mut self) {
        self.starts.push(self.values.len());
    }

    pub(crate) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub(crate) fn of(&self, key: usize) -> &[T] {
        &self.values[self.starts[key]..self.starts[key + 1]]
    }
}

impl<T: Copy + Default> Lists<T> {
    /// Sorts pairs of a key below `keys` and a value by their keys; `pairs` is called twice.
    pub(crate) fn new<I: Iterator<Item = (usize, T)>>(
        keys: usize,
        pairs: impl Fn() -> I,
    ) -> Result<Self, LinearError> {
        let mut starts = filled(keys + 1, 0)?;
        pairs().for_each(|(key, _)| starts[key + 1] += 1);
        for key in 0..keys {
            starts[key + 1] += starts[key];
        }
        let mut next = starts.clone();
        let mut values = filled(starts[keys], T::default())?;
        for (key, value) in pairs() {
            values[next[key]] = value;
            next[key] += 1;
        }
        Ok(Self { starts, values })
    }
}
