//! Functions of two numbers by each back end, and one number at a time.

use piola::Real;
use piola::lanes::{Backend, Kernel, Lanes, Scalar};

/// A function of two numbers.
pub trait Binary: Copy {
    /// Its value.
    fn of<R: Real>(self, x: R, y: R) -> R;
}

/// The values of a function at all arguments, by each way to compute them, with its name.
pub fn by_every_way<E: Scalar>(
    function: impl Binary,
    arguments: &[(E, E)],
) -> impl Iterator<Item = (&'static str, Vec<E>)> {
    // Whole blocks of lanes.
    let mut padded = arguments.to_vec();
    padded.resize(arguments.len().next_multiple_of(64), arguments[0]);
    let count = arguments.len();
    Backend::available().map(Some).chain([None]).map(move |way| {
        let kernel = Apply { function, arguments: &padded };
        let (name, mut values) = match way {
            Some(backend) => (backend.name(), backend.run(kernel)),
            None => ("scalar", kernel.run::<E>()),
        };
        values.truncate(count);
        (name, values)
    })
}

struct Apply<'a, F, E> {
    function: F,
    arguments: &'a [(E, E)],
}

impl<F: Binary, E: Scalar> Kernel<E> for Apply<'_, F, E> {
    type Output = Vec<E>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Vec<E> {
        let (x, y): (Vec<E>, Vec<E>) = self.arguments.iter().copied().unzip();
        let mut values = vec![E::default(); x.len()];
        for start in (0..x.len()).step_by(R::LANES) {
            let (x, y) = (R::load(&x[start..]), R::load(&y[start..]));
            self.function.of(x, y).store(&mut values[start..]);
        }
        values
    }
}
