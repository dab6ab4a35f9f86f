//! Functions for C, by what they are lent.

/// Defines functions for C as functions of Rust, whose arguments are checked before the body runs.
///
/// | argument | in C | in the body |
/// |---|---|---|
/// | `a: &[T]`, `a: &mut [T]` | `T *a, size_t a_length` | an [array](crate::lent::Arrays) |
/// | `a: &T` | `T *a` | the value behind the pointer, such as that of a handle |
/// | `a: &str`, `a: Option<&str>` | `char *a` | a text; `None` for null |
/// | `a: Options` | `piola_options *a` | options, read and checked |
/// | `a: Out<T>`, `a: New<T>` | `T *a`, `T **a` | [place](crate::lent::Out) of a result, or of a new handle |
/// | any other | itself | itself |
///
/// A body returns `Result<(), Failure>`, also by `?`.
///
/// After `E = f64, f32: "difference";` each function exists twice, for two types of numbers, which its text
/// calls `E`. The second one has a name of its own, and a documentation that refers to the first one.
///
/// cbindgen does not expand macros: `header/main.rs` does it for the header, and relies on calls with braces,
/// and on functions in them, that begin and end at the start of a line.
macro_rules! functions {
    (@ [$name:ident $body:block $($doc:tt)*] $arrays:ident [$($signature:tt)*] [$($arg:ident = $read:expr;)*]) => {
        $($doc)*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($signature)*) -> $crate::error::Code {
            $crate::error::guard(|| {
                #[allow(unused_mut, unused_variables, reason = "many functions have no array")]
                let mut $arrays = $crate::lent::Arrays::new();
                // SAFETY: the requirements of the header on its caller.
                $(let $arg = unsafe { $read };)*
                $body
            })
        }
    };
    // One argument after the other: what C passes, and what the body gets.
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: &mut [$Type:ty] $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* data: *mut $Type, length: usize,]
            [$($read)* $arg = $arrays.output::<$Type>(stringify!($arg), data, length)?;] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: &[$Type:ty] $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* data: *const $Type, length: usize,]
            [$($read)* $arg = $arrays.input::<$Type>(stringify!($arg), data, length)?;] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: &str $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* text: *const std::ffi::c_char,]
            [$($read)* $arg = $crate::lent::text(stringify!($arg), text)?;] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: Option<&str> $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* text: *const std::ffi::c_char,]
            [$($read)* $arg = $crate::lent::optional_text(stringify!($arg), text)?;] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: &$Type:ty $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* value: *const $Type,]
            [$($read)* $arg = $crate::lent::value(stringify!($arg), value)?;] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: Options $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* options: *const $crate::options::Options,]
            [$($read)* $arg = $crate::options::read(options, &mut $arrays)?;] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: Out<$Type:ty> $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* to: *mut $Type,]
            [$($read)* $arg = $crate::lent::Out::new(stringify!($arg), to);] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] [$($read:tt)*] $arg:ident: New<$Type:ty> $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* to: *mut *mut $Type,]
            [$($read)* $arg = $crate::lent::Out::new(stringify!($arg), to);] $($($rest)*)?);
    };
    (@ $f:tt $arrays:ident [$($c:tt)*] $read:tt $arg:ident: $Type:ty $(, $($rest:tt)*)?) => {
        $crate::functions::functions!(@ $f $arrays [$($c)* $arg: $Type,] $read $($($rest)*)?);
    };
    ($E:ident = $First:ty, $Second:ty: $difference:literal;
     $($(#[$doc:meta])* fn $first:ident, $second:ident($($arguments:tt)*) $body:block)*) => {$(
        const _: () = {
            type $E = $First;
            $crate::functions::functions!($(#[$doc])* fn $first($($arguments)*) $body);
        };
        const _: () = {
            type $E = $Second;
            $crate::functions::functions!(
                #[doc = concat!(" `", stringify!($first), "`", $difference)]
                fn $second($($arguments)*) $body
            );
        };
    )*};
    ($($(#[$doc:meta])* fn $name:ident($($arguments:tt)*) $body:block)*) => {$(
        $crate::functions::functions!(@ [$name $body $(#[$doc])*] arrays [] [] $($arguments)*);
    )*};
}
pub(crate) use functions;
