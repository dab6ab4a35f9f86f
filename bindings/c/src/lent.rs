//! Arrays and texts borrowed from callers, with the checks that C allows.

use std::ffi::{CStr, c_char};
use std::marker::PhantomData;
use std::ops::Range;

use piola::batch::LengthError;

use crate::error::{Code, Failure};

/// Types for which every pattern of bits is a value.
///
/// # Safety
/// Says just that.
pub(crate) unsafe trait Plain: Copy {}

macro_rules! plain {
    ($($Type:ty),*) => {$(
        // SAFETY: it is made of numbers, raw pointers and optional functions, of which every pattern is a
        // value.
        unsafe impl $crate::lent::Plain for $Type {}
    )*};
}
pub(crate) use plain;
plain!(f64, f32, u8, i32, i64, usize);

/// The arrays of a call, at most six: none that is written overlaps another one.
pub(crate) struct Arrays<'call> {
    ranges: [Range<usize>; 6],
    /// Number of ranges that are written, the first ones, and of ranges that are read, the last ones.
    written: usize,
    read: usize,
    call: PhantomData<&'call mut ()>,
}

impl<'call> Arrays<'call> {
    #[inline]
    pub(crate) fn new() -> Self {
        Self { ranges: [const { 0..0 }; 6], written: 0, read: 0, call: PhantomData }
    }

    /// An array to read. It may be null if it is empty.
    ///
    /// # Safety
    /// `data` points to `length` initialised values, which nobody changes during the call.
    #[inline]
    pub(crate) unsafe fn input<T: Plain>(
        &mut self,
        name: &str,
        data: *const T,
        length: usize,
    ) -> Result<&'call [T], Failure> {
        let range = range(name, data, length)?;
        let is_written = self.ranges[..self.written].iter().any(|other| overlap(other, &range));
        self.read += 1;
        let at = self.ranges.len() - self.read;
        self.ranges[at] = range;
        match (is_written, length) {
            (true, _) => Err(overlaps(name)),
            (false, 0) => Ok(&[]),
            // SAFETY: the caller vouches for the values; `range` has seen that the pointer is aligned, not
            // null, and that the array does not wrap around.
            (false, _) => Ok(unsafe { std::slice::from_raw_parts(data, length) }),
        }
    }

    /// An array to write. It may be null if it is empty.
    ///
    /// # Safety
    /// `data` points to room for `length` values, which nobody else uses during the call.
    #[inline]
    pub(crate) unsafe fn output<T: Plain>(
        &mut self,
        name: &str,
        data: *mut T,
        length: usize,
    ) -> Result<&'call mut [T], Failure> {
        let range = range(name, data, length)?;
        let (written, read) = (&self.ranges[..self.written], &self.ranges[self.ranges.len() - self.read..]);
        let is_used = written.iter().chain(read).any(|other| overlap(other, &range));
        self.ranges[self.written] = range;
        self.written += 1;
        match (is_used, length) {
            (true, _) => Err(overlaps(name)),
            (false, 0) => Ok(&mut []),
            // SAFETY: as for an input; and no other array of the call has a byte of it.
            (false, _) => Ok(unsafe { std::slice::from_raw_parts_mut(data, length) }),
        }
    }
}

/// The addresses of an array.
#[inline]
fn range<T>(name: &str, data: *const T, length: usize) -> Result<Range<usize>, Failure> {
    if length == 0 {
        return Ok(0..0);
    }
    if data.is_null() {
        return Err(null(name));
    }
    if !data.is_aligned() {
        let alignment = align_of::<T>();
        return Err(Failure::new(
            Code::Pointer,
            format_args!("`{name}` is not aligned to {alignment} bytes"),
        ));
    }
    let size = length.checked_mul(size_of::<T>()).filter(|&size| size <= isize::MAX as usize);
    match size.and_then(|size| data.addr().checked_add(size)) {
        Some(end) => Ok(data.addr()..end),
        None => Err(Failure::new(
            Code::Length,
            format_args!("`{name}` has {length} entries, more than memory can hold"),
        )),
    }
}

#[inline]
fn overlap(one: &Range<usize>, other: &Range<usize>) -> bool {
    one.start < other.end && other.start < one.end
}

#[cold]
fn overlaps(name: &str) -> Failure {
    Failure::new(Code::Pointer, format_args!("`{name}` overlaps another array of the call"))
}

#[cold]
fn null(name: &str) -> Failure {
    Failure::new(Code::Pointer, format_args!("`{name}` is null"))
}

/// A text.
///
/// # Safety
/// `text` is null, or ends with a NUL and is not changed during the call.
pub(crate) unsafe fn text<'call>(name: &str, text: *const c_char) -> Result<&'call str, Failure> {
    if text.is_null() {
        return Err(null(name));
    }
    // SAFETY: the caller vouches for the NUL.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map_err(|error| Failure::new(Code::Text, format_args!("`{name}` is not UTF-8: {error}")))
}

/// A text; `None` behind a null pointer.
///
/// # Safety
/// As of [`text`].
pub(crate) unsafe fn optional_text<'call>(
    name: &str,
    text: *const c_char,
) -> Result<Option<&'call str>, Failure> {
    // SAFETY: that of this function.
    if text.is_null() { Ok(None) } else { unsafe { self::text(name, text) }.map(Some) }
}

/// A value behind a pointer; `None` behind a null pointer.
///
/// # Safety
/// `value` is null, or points to a value that nobody changes during the call.
#[inline]
pub(crate) unsafe fn optional<'call, T>(name: &str, value: *const T) -> Result<Option<&'call T>, Failure> {
    if !value.is_null() {
        range(name, value, 1)?;
    }
    // SAFETY: aligned, and the caller vouches for the value.
    Ok(unsafe { value.as_ref() })
}

/// A value behind a pointer.
///
/// # Safety
/// As of [`optional`].
#[inline]
pub(crate) unsafe fn value<'call, T>(name: &str, value: *const T) -> Result<&'call T, Failure> {
    // SAFETY: that of this function.
    unsafe { optional(name, value) }?.ok_or_else(|| null(name))
}

/// A value behind a pointer, to be changed.
///
/// # Safety
/// `value` is null, or points to a value that nobody else uses during the call.
pub(crate) unsafe fn value_mut<'call, T>(name: &str, value: *mut T) -> Result<&'call mut T, Failure> {
    range(name, value, 1)?;
    // SAFETY: aligned and not null, and the caller vouches for the value.
    Ok(unsafe { &mut *value })
}

/// Place of a result, which may be null.
pub(crate) struct Out<T> {
    name: &'static str,
    to: *mut T,
}

impl<T> Out<T> {
    /// # Safety
    /// `to` is null, or there is room for a value, which nobody else uses during the call.
    #[inline]
    pub(crate) unsafe fn new(name: &'static str, to: *mut T) -> Self {
        Self { name, to }
    }

    /// Fails if the place is null.
    pub(crate) fn demand(&self) -> Result<(), Failure> {
        if self.to.is_null() { Err(null(self.name)) } else { Ok(()) }
    }

    /// Writes a result, unless the place is null.
    #[inline]
    pub(crate) fn write(&self, result: T) -> Result<(), Failure> {
        if !self.to.is_null() {
            range(self.name, self.to, 1)?;
            // SAFETY: aligned, and the caller vouches for the memory; the old bytes are not a value to be
            // dropped.
            unsafe { self.to.write(result) };
        }
        Ok(())
    }
}

/// Rows of N numbers: vectors of nodes, or nodes of tetrahedra.
pub(crate) fn rows<'a, T, const N: usize>(
    slice: &'static str,
    numbers: &'a [T],
) -> Result<&'a [[T; N]], Failure> {
    demand_length(slice, numbers.len(), N, numbers.len() / N)?;
    Ok(numbers.as_chunks().0)
}

/// Checks that an array has this number of components for each point.
pub(crate) fn demand_length(
    slice: &'static str,
    found: usize,
    components: usize,
    points: usize,
) -> Result<(), LengthError> {
    if Some(found) == points.checked_mul(components) {
        return Ok(());
    }
    Err(LengthError { slice, found, components, points, group: 1 })
}

/// The value that a number of C stands for.
#[inline]
pub(crate) fn choice<T: Copy, const N: usize>(name: &str, number: i32, values: [T; N]) -> Result<T, Failure> {
    usize::try_from(number).ok().and_then(|at| values.get(at)).copied().ok_or_else(|| {
        Failure::new(Code::Value, format_args!("`{name}` is {number}; it must be one of 0 to {}", N - 1))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the result of a call with two arrays in one memory of ten numbers.
    #[track_caller]
    fn check(read: Range<usize>, written: Range<usize>, expected: Result<(), &str>) {
        let mut memory = [0.0; 10];
        let start = memory.as_mut_ptr();
        for input_first in [true, false] {
            let mut arrays = Arrays::new();
            let result = (|| {
                let [read_from, write_to] = [read.start, written.start].map(|at| start.wrapping_add(at));
                // SAFETY: ranges of at most ten numbers, whose slices are not used.
                unsafe {
                    if input_first {
                        arrays.input("F", read_from, read.len())?;
                        arrays.output("P", write_to, written.len())?;
                    } else {
                        arrays.output("P", write_to, written.len())?;
                        arrays.input("F", read_from, read.len())?;
                    }
                }
                Ok(())
            })();
            let message = result.map_err(|failure: Failure| (failure.code, failure.message));
            let name = if input_first { "P" } else { "F" };
            let expected = expected.map_err(|text| (Code::Pointer, text.replace('_', name)));
            assert_eq!(message, expected);
        }
    }

    #[test]
    fn what_is_written_overlaps_nothing() {
        check(0..5, 5..10, Ok(()));
        check(5..10, 0..5, Ok(()));
        check(3..3, 0..10, Ok(()));
        check(0..5, 4..10, Err("`_` overlaps another array of the call"));
        check(0..10, 9..10, Err("`_` overlaps another array of the call"));
        check(3..4, 0..10, Err("`_` overlaps another array of the call"));
    }
}
