//! Codes, messages, and the end of every unwinding.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

use piola::NoSuchNode;
use piola::batch::CsrError;
use piola::batch::LengthError;
use piola::material::{MaterialError, PerPointError};
use piola_bodies::mesh::MeshError;
use piola_bodies::step::{NewtonError, SetupError, StepError};
use piola_bodies::system::BodyError;
use piola_declare::Mistakes;

/// Result of a function: 0, or the kind of the error. `piola_error_message` returns its text.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// Success.
    Ok = 0,
    /// A pointer is null or not aligned, or an array that is written overlaps another one.
    Pointer = 1,
    /// The lengths of arrays do not match.
    Length = 2,
    /// A text is not UTF-8.
    Text = 3,
    /// An option, a setting or an entry of an array has a value that is not allowed.
    Value = 4,
    /// No energy has this name, these parameters, or these values of them.
    Material = 5,
    /// A text does not declare an energy; the message shows each mistake at its place.
    Energy = 6,
    /// Nodes, tetrahedra, parts and densities are not a valid body.
    Body = 7,
    /// A sparse matrix does not fit the stiffnesses of these tetrahedra.
    Matrix = 8,
    /// A step finds no admissible next state. The state before is untouched.
    Step = 9,
    /// A user-defined function has returned a value other than 0.
    Callback = 10,
    /// Another call uses this handle. Nothing has been done.
    Busy = 11,
    /// A bug in piola. A handle that was being changed can only be freed.
    Panic = 12,
}

/// Reason why a call fails.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) code: Code,
    pub(crate) message: String,
}

impl Failure {
    pub(crate) fn new(code: Code, message: impl Display) -> Self {
        Self { code, message: message.to_string() }
    }
}

/// Codes of the errors of piola, the messages of which are kept.
macro_rules! codes {
    ($($Error:ty => $code:ident,)*) => {$(
        impl From<$Error> for Failure {
            fn from(error: $Error) -> Self {
                Self::new(Code::$code, error)
            }
        }
    )*};
}
codes! {
    LengthError => Length,
    NoSuchNode => Value,
    serde_json::Error => Value,
    SetupError => Value,
    MaterialError => Material,
    PerPointError => Material,
    piola_scenes::error::Error => Material,
    Mistakes => Energy,
    MeshError => Body,
    BodyError => Body,
    CsrError => Matrix,
    StepError => Step,
    NewtonError => Step,
}

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// The message of the last call of this thread that did not return 0: UTF-8, one or several lines; empty
/// before the first. Valid until the next such call of this thread. Never null.
#[unsafe(no_mangle)]
pub extern "C" fn piola_error_message() -> *const c_char {
    // A thread that ends has no message any more.
    MESSAGE.try_with(|message| message.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

/// Runs the body of a call: returns its code, and keeps its message for the thread; panics end here.
///
/// State that a panic leaves half changed is behind a lock, which is poisoned by it.
#[inline]
pub(crate) fn guard(body: impl FnOnce() -> Result<(), Failure>) -> Code {
    let failure = match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => return Code::Ok,
        Ok(Err(failure)) => failure,
        Err(payload) => Failure::new(Code::Panic, format_args!("a mistake in piola: {}", text_of(&*payload))),
    };
    keep(&failure)
}

/// Keeps the message of a failure for the thread.
#[cold]
fn keep(failure: &Failure) -> Code {
    let text = c_string(&failure.message);
    // There is nobody left to read it if this fails.
    let _ = MESSAGE.try_with(|message| message.replace(text));
    failure.code
}

fn text_of(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or(payload.downcast_ref::<&str>().copied()).unwrap_or("unknown")
}

/// A text for C, which ends at the first NUL.
pub(crate) fn c_string(text: &str) -> CString {
    let bytes: Vec<u8> = text.bytes().take_while(|&byte| byte != 0).collect();
    CString::new(bytes).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::ffi::CStr;

    use super::*;

    fn message() -> String {
        let message = piola_error_message();
        // SAFETY: it is a text of this thread, read before the next call.
        unsafe { CStr::from_ptr(message) }.to_string_lossy().into_owned()
    }

    #[test]
    fn a_panic_is_a_code_with_a_message() {
        let code = guard(|| {
            let nothing: Vec<u8> = Vec::new();
            let index = nothing.len();
            assert_ne!(nothing[index], 0);
            Ok(())
        });
        assert_eq!(code, Code::Panic);
        assert!(message().starts_with("a mistake in piola: index out of bounds"), "{}", message());
        assert_eq!(guard(|| Err(Failure::new(Code::Text, "one\0two"))), Code::Text);
        assert_eq!(message(), "one");
    }
}
