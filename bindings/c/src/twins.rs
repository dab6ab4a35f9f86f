//! Functions that exist for two types of numbers.

/// Defines each function twice, for two types of numbers, which its text calls `E`. The second one has a
/// name of its own, and a documentation that refers to the first one.
///
/// cbindgen does not expand macros: `header/main.rs` does it for the header, and relies on functions that
/// begin and end at the start of a line.
macro_rules! twins {
    ($E:ident = $First:ty, $Second:ty: $difference:literal;
     $($(#[doc = $documentation:literal])*
     fn $first:ident, $second:ident($($argument:ident: $Type:ty,)*) $body:block)*) => {$(
        const _: () = {
            type $E = $First;
            $(#[doc = $documentation])*
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $first($($argument: $Type,)*) -> $crate::error::Code $body
        };
        const _: () = {
            type $E = $Second;
            #[doc = concat!(" `", stringify!($first), "`", $difference)]
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $second($($argument: $Type,)*) -> $crate::error::Code $body
        };
    )*};
}
pub(crate) use twins;
