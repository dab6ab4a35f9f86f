//! Settings built by chained calls.

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

pub(crate) use chained;
