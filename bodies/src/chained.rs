//! Two patterns that many types follow, each written once: errors that wrap others, and settings built by
//! chained calls.

/// Implements `source()` and `From` of an error type for its variants that hold another error.
macro_rules! wraps {
    ($Error:ident { $($Variant:ident($Source:ty)),+ }) => {
        impl std::error::Error for $Error {
            fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
                match self {
                    $(Self::$Variant(error) => Some(error),)+
                    _ => None,
                }
            }
        }

        $(impl From<$Source> for $Error {
            fn from(error: $Source) -> Self {
                Self::$Variant(error)
            }
        })+
    };
}

/// Gives a struct of settings a method for each of its fields that replaces it, for chained calls. Such a
/// struct is `#[non_exhaustive]` and has a `Default`, so that a new setting breaks no caller.
macro_rules! chained {
    ($Settings:ident { $($with:ident($field:ident: $Type:ty)),+ $(,)? }) => {
        impl $Settings {
            $(
                #[doc = concat!("Replaces [`", stringify!($field), "`](", stringify!($Settings), "::", stringify!($field), ").")]
                #[must_use]
                pub fn $with(mut self, $field: $Type) -> Self {
                    self.$field = $field;
                    self
                }
            )+
        }
    };
}

pub(crate) use {chained, wraps};
