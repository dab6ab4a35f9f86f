//! The stages of a batch that know no material, compiled once for each format and back end.
//!
//! Between them and the material's stage a tile's numbers lie in [`Rows`]: frames and stretches, then the fifteen numbers
//! of the energy. Each stage keeps few enough numbers alive for the registers.

#![expect(non_snake_case, reason = "F, U, V, P as in the literature")]

use super::energy::from_numbers;
use super::form::{
    BlockStiffness, Factored, Form, FullStiffness, FullTangent, PackedStiffness, PackedTangent,
};
use super::sink::{Scratch, Sink, Source};
use super::tile::{Rows, first_bits, for_each_group};
use crate::lanes::{Backend, Element, Kernel, Lanes};
use crate::point::{Filter, Matrix3, Svd, respond, stress, stress_is_finite, svd, svd_signed_by_determinant};

/// Frames and stretches of a tile's deformation gradients.
#[derive(Clone, Copy, Debug)]
pub struct Points<E> {
    U: Rows<E, 9>,
    pub(crate) stretches: Rows<E, 3>,
    V: Rows<E, 9>,
}

impl<E: Element> Points<E> {
    pub(crate) fn new() -> Self {
        Self { U: Rows::zero(), stretches: Rows::zero(), V: Rows::zero() }
    }

    #[inline(always)]
    fn get<R: Lanes<Element = E>>(&self, at: usize) -> Svd<R> {
        Svd {
            U: to_matrix(self.U.get_all(at)),
            stretches: self.stretches.get_all(at),
            V: to_matrix(self.V.get_all(at)),
        }
    }

    #[inline(always)]
    fn set<R: Lanes<Element = E>>(&mut self, at: usize, svd: &Svd<R>) {
        self.U.set_all(at, to_numbers(svd.U));
        self.stretches.set_all(at, svd.stretches);
        self.V.set_all(at, to_numbers(svd.V));
    }
}

#[inline(always)]
pub(super) fn to_matrix<R: Copy>([a, b, c, d, e, f, g, h, i]: [R; 9]) -> Matrix3<R> {
    [[a, b, c], [d, e, f], [g, h, i]]
}

#[inline(always)]
pub(super) fn to_numbers<R: Copy>([[a, b, c], [d, e, f], [g, h, i]]: Matrix3<R>) -> [R; 9] {
    [a, b, c, d, e, f, g, h, i]
}

/// What a stage says of the points of a tile, as bits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Marks {
    pub(crate) refused: u64,
    pub(crate) bounded: u64,
    pub(crate) nonfinite: u64,
    pub(crate) filtered: u64,
}

impl Marks {
    /// Without what the lanes beyond the last point say.
    fn of_first(self, count: usize) -> Self {
        let points = first_bits(count);
        Self {
            refused: self.refused & points,
            bounded: self.bounded & points,
            nonfinite: self.nonfinite & points,
            filtered: self.filtered & points,
        }
    }
}

/// The deformation gradients of a tile into frames and stretches.
pub(super) struct Decompose<'a, E> {
    pub(super) F: Source<'a, E, 9>,
    pub(super) count: usize,
    /// Whether the sign of det F decides over the domain.
    pub(super) is_signed: bool,
    pub(super) points: &'a mut Points<E>,
}

impl<E: Element> Kernel<E> for Decompose<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Element = E>>(self) {
        let Self { F, count, is_signed, points } = self;
        if is_signed {
            for_each_group::<R>(count, |at| {
                points.set(at, &svd_signed_by_determinant(&to_matrix(F.get_all::<R>(at))));
            });
        } else {
            for_each_group::<R>(count, |at| points.set(at, &svd(&to_matrix(F.get_all::<R>(at)))));
        }
    }
}

/// Frames and ψi into P.
pub(super) struct Stress<'a, E> {
    pub(super) points: &'a Points<E>,
    pub(super) gradients: &'a Rows<E, 3>,
    pub(super) count: usize,
    pub(super) P: Sink<'a, E>,
}

impl<E: Element> Kernel<E> for Stress<'_, E> {
    type Output = Marks;

    #[inline(always)]
    fn run<R: Lanes<Element = E>>(mut self) -> Marks {
        let mut scratch = Scratch::<E, 9>::new();
        let mut marks = Marks::default();
        for_each_group::<R>(self.count, |at| {
            let svd = self.points.get::<R>(at);
            let P = stress(&svd, self.gradients.get_all(at));
            marks.nonfinite |= R::bits(!stress_is_finite(&svd, &P)) << at;
            self.P.put::<R, 9>(&mut scratch, at, self.count, |to| {
                for (k, number) in to_numbers(P).into_iter().enumerate() {
                    number.store(&mut to[k * E::LINE..]);
                }
            });
        });
        marks.of_first(self.count)
    }
}

/// Frames and blocks, filtered, into a pair of outputs.
pub(super) struct Respond<'a, E, const REST: usize> {
    pub(super) points: &'a Points<E>,
    pub(super) blocks: &'a Rows<E, 15>,
    pub(super) rest: Source<'a, E, REST>,
    pub(super) count: usize,
    pub(super) filter: Filter,
    pub(super) has_pole: bool,
    pub(super) first: Sink<'a, E>,
    pub(super) second: Sink<'a, E>,
}

/// [`Respond`] with outputs of a form.
struct Shaped<'a, E, F, const REST: usize, const FIRST: usize, const SECOND: usize>(Respond<'a, E, REST>, F);

impl<E, F, const REST: usize, const FIRST: usize, const SECOND: usize> Kernel<E>
    for Shaped<'_, E, F, REST, FIRST, SECOND>
where
    E: Element,
    F: Form<REST, FIRST, SECOND>,
{
    type Output = Marks;

    #[inline(always)]
    fn run<R: Lanes<Element = E>>(self) -> Marks {
        let Respond { points, blocks, rest, count, filter, has_pole, mut first, mut second } = self.0;
        let (mut first_scratch, mut second_scratch) =
            (Scratch::<E, FIRST>::new(), Scratch::<E, SECOND>::new());
        let mut marks = Marks::default();
        for_each_group::<R>(count, |at| {
            let svd = points.get::<R>(at);
            let mut point = respond(&svd, &from_numbers(blocks.get_all(at)), has_pole, filter);
            let rest = rest.get_all(at);
            F::prepare(&mut point, &rest, has_pole);
            marks.bounded |= R::bits(point.status.bounded) << at;
            marks.nonfinite |= R::bits(point.status.nonfinite) << at;
            marks.filtered |= R::bits(point.filtered) << at;
            first.put::<R, FIRST>(&mut first_scratch, at, count, |to| {
                F::first(&point, &rest, |k, number: R| number.store(&mut to[k * E::LINE..]));
            });
            second.put::<R, SECOND>(&mut second_scratch, at, count, |to| {
                F::second(&point, &rest, |k, number: R| number.store(&mut to[k * E::LINE..]));
            });
        });
        marks.of_first(count)
    }
}

/// dP = (dP/dF) dF from what [`Factored`] has stored.
pub(super) struct Product<'a, E> {
    pub(super) stored: Source<'a, E, 30>,
    pub(super) dF: Source<'a, E, 9>,
    pub(super) count: usize,
    pub(super) dP: Sink<'a, E>,
}

impl<E: Element> Kernel<E> for Product<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Element = E>>(mut self) {
        let mut scratch = Scratch::<E, 9>::new();
        for_each_group::<R>(self.count, |at| {
            let tangent = Factored::restore(self.stored.get_all::<R>(at));
            let dP = tangent.apply(&to_matrix(self.dF.get_all(at)));
            self.dP.put::<R, 9>(&mut scratch, at, self.count, |to| {
                for (k, number) in to_numbers(dP).into_iter().enumerate() {
                    number.store(&mut to[k * E::LINE..]);
                }
            });
        });
    }
}

/// The second output of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TangentForm {
    Full,
    Packed,
    Factored,
}

/// The second output of an element's response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StiffnessForm {
    Full,
    Packed,
    Blocks,
}

/// The kernels above for one format: no function is generic, so that each is compiled once, here.
#[expect(private_interfaces, reason = "sealed: only this crate can name what the functions take")]
pub trait Stages: Element {
    #[doc(hidden)]
    fn decompose(backend: Backend, kernel: Decompose<'_, Self>);
    #[doc(hidden)]
    fn stress(backend: Backend, kernel: Stress<'_, Self>) -> Marks;
    #[doc(hidden)]
    fn tangent(backend: Backend, form: TangentForm, kernel: Respond<'_, Self, 0>) -> Marks;
    #[doc(hidden)]
    fn stiffness(backend: Backend, form: StiffnessForm, kernel: Respond<'_, Self, 10>) -> Marks;
    #[doc(hidden)]
    fn product(backend: Backend, kernel: Product<'_, Self>);
}

macro_rules! stages {
    ($($Number:ident)*) => {$(
        #[expect(private_interfaces, reason = "as in the trait")]
        impl Stages for $Number {
            fn decompose(backend: Backend, kernel: Decompose<'_, Self>) {
                backend.run(kernel);
            }

            fn stress(backend: Backend, kernel: Stress<'_, Self>) -> Marks {
                backend.run(kernel)
            }

            fn tangent(backend: Backend, form: TangentForm, kernel: Respond<'_, Self, 0>) -> Marks {
                match form {
                    TangentForm::Full => backend.run(Shaped(kernel, FullTangent)),
                    TangentForm::Packed => backend.run(Shaped(kernel, PackedTangent)),
                    TangentForm::Factored => backend.run(Shaped(kernel, Factored)),
                }
            }

            fn stiffness(backend: Backend, form: StiffnessForm, kernel: Respond<'_, Self, 10>) -> Marks {
                match form {
                    StiffnessForm::Full => backend.run(Shaped(kernel, FullStiffness)),
                    StiffnessForm::Packed => backend.run(Shaped(kernel, PackedStiffness)),
                    StiffnessForm::Blocks => backend.run(Shaped(kernel, BlockStiffness)),
                }
            }

            fn product(backend: Backend, kernel: Product<'_, Self>) {
                backend.run(kernel);
            }
        }
    )*};
}
stages!(f64 f32);
