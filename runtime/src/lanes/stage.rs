//! Stages: parts of a computation that have a name. Numbers compute a stage in place; the one that records,
//! [`Recorded`](super::recorded::Recorded), writes it down once as a function and then calls it.

/// `stage!(R, "name", (inputs) => body)`: a stage of the numbers `R`, whose body uses these variables and
/// what is the same in all its calls, but no other number.
///
/// A macro, because the body must be in the function itself: as a closure, it would not have the instructions
/// of a kernel.
macro_rules! stage {
    ($R:ty, $name:expr, ($($input:ident),*) => $body:expr) => {
        if <$R as $crate::lanes::Real>::IS_RECORDED {
            <$R as $crate::lanes::Real>::stage($name, ($($input,)*), |($($input,)*)| $body)
        } else {
            $body
        }
    };
}
pub(crate) use stage;
