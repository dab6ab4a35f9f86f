//! Materials over tiles of points: one dynamic dispatch for each response of a tile.
//!
//! Inside this call [`Backend::run`] selects the instructions, and everything below is inlined into it: a
//! method that computes is `#[inline(always)]`, because only inlined code is compiled for the instructions of
//! the back end. Materials chosen at run time so add no cost for each point.

use crate::kernels::rows::{ROW, Rows, first_bits, for_each_group, to_rows};
use crate::lanes::{Backend, Kernel, Lanes, Mask, Real, Scalar};
use crate::material::{Curvature, Graded, Material, PerPoint, RawTile, ResponseKind};
use crate::point::energy_is_finite;
use crate::status::Status;

pub(crate) use crate::material::properties::Properties;

/// The material of a batch's points: the same for all, or one for each.
trait Points: Send + Sync {
    type Material: Material;

    /// True if each point has a material of its own. They may not [share lanes](Graded::shares_lanes).
    const MAY_DIFFER: bool;

    /// The material on the lanes that begin with a point.
    fn at(&self, point: usize) -> impl Material;

    /// The points of a tile that begins with the point `start`, as bits, whose materials share lanes with
    /// that of its point `first`.
    fn sharing(&self, start: usize, count: usize, first: usize) -> u64;

    /// All the materials: one, or one for each point.
    fn materials(&self) -> &[Self::Material];

    fn properties(&self) -> Properties;
}

impl<M: Material> Points for M {
    type Material = M;

    const MAY_DIFFER: bool = false;

    #[inline(always)]
    fn at(&self, _: usize) -> impl Material {
        self
    }

    fn sharing(&self, _: usize, _: usize, _: usize) -> u64 {
        u64::MAX
    }

    fn materials(&self) -> &[M] {
        std::slice::from_ref(self)
    }

    fn properties(&self) -> Properties {
        Properties::of(self.materials(), None)
    }
}

impl<M: Graded, S: AsRef<[M]> + Send + Sync> Points for PerPoint<M, S> {
    type Material = M;

    const MAY_DIFFER: bool = true;

    #[inline(always)]
    fn at(&self, point: usize) -> impl Material {
        self.from(point)
    }

    fn sharing(&self, start: usize, count: usize, first: usize) -> u64 {
        let materials = &PerPoint::materials(self)[start..start + count];
        let is_apart = |other: &M| !materials[first].shares_lanes(other);
        let apart = materials.iter().enumerate().map(|(point, other)| u64::from(is_apart(other)) << point);
        !apart.fold(0, |bits, bit| bits | bit)
    }

    fn materials(&self) -> &[M] {
        PerPoint::materials(self)
    }

    fn properties(&self) -> Properties {
        self.properties
    }
}

/// Principal stretches of a tile, or its invariants where a method takes these, and how to compute with them.
#[derive(Clone, Copy, Debug)]
pub struct Arguments<'a, E> {
    /// Vector instructions of the kernels.
    pub(crate) backend: Backend,
    /// Index of the tile's first point in the batch.
    pub(crate) start: usize,
    /// Number of points in the tile.
    pub(crate) count: usize,
    /// Derivatives by invariants that are read: [`Properties`] of the materials of all tiles.
    pub(crate) curvature: Curvature,
    pub(crate) has_second_invariant: bool,
    pub(crate) rows: &'a Rows<E, 3>,
}

/// Declares the responses of a tile: for each a method of [`TileMaterial`] and the kernel behind it.
///
/// A kernel writes the rows of a response for the points of a tile, and returns as bits the points outside
/// the domain of the response and, if requested, those where it is not finite.
macro_rules! tile_responses {
    ($(
        $(#[$doc:meta])*
        $tile:ident: $response:ident ($Kind:ident) within $domain:ident,
        $rows:literal rows by $to_rows:expr $(, without row $k:ident of $material:ident if $vanishes:expr)?;
        finite where |$at:pat_param, $result:pat_param| $finite:expr;
    )*) => {
        /// A material over tiles of points: implemented for every [`Material`] and for [`PerPoint`].
        ///
        /// Its methods are internals of [`Batch`](super::Batch).
        pub trait TileMaterial<E: Scalar>: Send + Sync {
            $(
                $(#[$doc])*
                #[doc(hidden)]
                fn $tile(&self, arguments: Arguments<'_, E>, to: &mut Rows<E, $rows>) -> Status<u64>;
            )*

            #[doc(hidden)]
            fn properties(&self) -> Properties;

            /// Largest ψ11 at rest, Pa: a measure of the stiffness, and so of the rounding error of an
            /// energy.
            #[doc(hidden)]
            fn rest_stiffness(&self) -> f64;
        }

        impl<E: Scalar, P: Points> TileMaterial<E> for P {
            $(
                fn $tile(&self, arguments: Arguments<'_, E>, to: &mut Rows<E, $rows>) -> Status<u64> {
                    /// The points `own` of a tile, as bits, whose materials share lanes.
                    struct OnLanes<'a, P, E> {
                        points: &'a P,
                        own: u64,
                        start: usize,
                        count: usize,
                        rows: &'a Rows<E, 3>,
                        to: &'a mut Rows<E, $rows>,
                    }
                    impl<P: Points, E: Scalar> Kernel<E> for OnLanes<'_, P, E> {
                        type Output = Status<u64>;
                        #[inline(always)]
                        fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
                            let Self { points, own, start, count, rows, to } = self;
                            let (others, first) = match P::MAY_DIFFER {
                                true => (!own, own.trailing_zeros() as usize),
                                false => (0, 0),
                            };
                            let (mut admitted, mut finite) = (0, 0);
                            for_each_group!(R, count, but others, |group| {
                                let at = rows.get_all::<R>(group);
                                let is_whole = (others >> group) & first_bits(R::LANES) == 0;
                                let material = points.at(start + if is_whole { group } else { first });
                                let result = $to_rows(material.$response(at));
                                let ($at, $result) = (at, result);
                                finite |= R::bits($finite) << group;
                                for row in 0..$rows {
                                    $(
                                        let ($k, $material) = (row, &material);
                                        if $vanishes {
                                            continue;
                                        }
                                    )?
                                    if is_whole {
                                        to.set(row, group, result[row]);
                                    } else {
                                        let before = to.get(row, group);
                                        to.set(row, group, R::select(mask::<R>(own >> group), result[row], before));
                                    }
                                }
                                admitted |= R::bits(material.$domain(at)) << group;
                            });
                            let status = domain_and_range(count, admitted, finite);
                            if P::MAY_DIFFER { status & own } else { status }
                        }
                    }
                    struct Finite<'a, E>(Arguments<'a, E>, &'a Rows<E, $rows>);
                    impl<E: Scalar> Kernel<E> for Finite<'_, E> {
                        type Output = u64;
                        #[inline(always)]
                        fn run<R: Lanes<Scalar = E>>(self) -> u64 {
                            let Self(Arguments { count, rows, .. }, to) = self;
                            let mut finite = 0;
                            for_each_group!(R, count, |group| {
                                let ($at, $result) = (rows.get_all::<R>(group), to.get_all::<R>(group));
                                finite |= R::bits($finite) << group;
                            });
                            finite
                        }
                    }
                    let Arguments { backend, start, count, rows, .. } = arguments;
                    let mut respond = |own| {
                        if P::Material::RESPONDS_TOGETHER {
                            let admitted = together(self, ResponseKind::$Kind, own, arguments, to);
                            domain_and_range(count, admitted, backend.run(Finite(arguments, to))) & own
                        } else {
                            backend.run(OnLanes { points: self, own, start, count, rows, to })
                        }
                    };
                    if !P::MAY_DIFFER {
                        return respond(u64::MAX);
                    }
                    let (mut left, mut status) = (first_bits(count), Status::default());
                    while left != 0 {
                        let own = self.sharing(start, count, left.trailing_zeros() as usize);
                        left &= !own;
                        status = status | respond(own);
                    }
                    status
                }
            )*

            fn rest_stiffness(&self) -> f64 {
                let stiffness = |material: &P::Material| material.blocks([1.0f64; 3]).hessian[0];
                self.materials().iter().map(stiffness).fold(0.0, f64::max)
            }

            fn properties(&self) -> Properties {
                Points::properties(self)
            }
        }
    };
}

tile_responses! {
    /// ψ, Pa, from signed principal stretches.
    tile_energies: energy (Energy) within admits,
    1 rows by |energy| [energy]; finite where |stretches, [energy]| energy_is_finite(stretches, energy);

    /// ψ1, ψ2, ψ3, Pa.
    tile_gradients: gradient (Gradient) within admits,
    3 rows by |gradient| gradient; finite where |at, _| anywhere(at);

    /// The fifteen components of [`Blocks`], Pa, in the order of its fields.
    tile_blocks: blocks (Blocks) within admits,
    15 rows by |blocks| to_rows(&blocks); finite where |at, _| anywhere(at);

    /// ψ, Pa, from I1, I2, J.
    tile_energies_by_invariants: energy_by_invariants (EnergyByInvariants) within admits_invariants,
    1 rows by |energy| [energy]; finite where |_, [energy]| energy.is_finite();

    /// W1, W2, WJ, Pa, from I1, I2, J.
    tile_gradients_by_invariants: gradient_by_invariants (GradientByInvariants) within admits_invariants,
    3 rows by |gradient| gradient; finite where |at, _| anywhere(at);

    /// W1, W2, WJ, W11, W22, WJJ, W12, W1J, W2J, Pa, from I1, I2, J, except for those that the material's
    /// [`curvature_by_invariants`](Material::curvature_by_invariants) leaves out.
    tile_derivatives_by_invariants: derivatives_by_invariants (DerivativesByInvariants) within admits_invariants,
    9 rows by |derivatives| derivatives, without row k of material if
    material.curvature_by_invariants().leaves_out(k, material.has_second_invariant());
    finite where |at, _| anywhere(at);
}

/// Passes the points `own` of a tile, as bits, whose materials share lanes, to the material, all at once.
/// Returns those inside the domain as bits.
fn together<E: Scalar, P: Points, const N: usize>(
    points: &P,
    response: ResponseKind,
    own: u64,
    Arguments { backend, start, count, curvature, has_second_invariant, rows }: Arguments<'_, E>,
    to: &mut Rows<E, N>,
) -> u64 {
    let materials = points.materials();
    // The other points stand in with the material of the first.
    let first = own.trailing_zeros() as usize;
    let place = |point: usize| start + if own >> point & 1 == 1 { point } else { first };
    let unread = match response {
        ResponseKind::DerivativesByInvariants => {
            (0..9).filter(|&k| curvature.leaves_out(k, has_second_invariant)).fold(0, |bits, k| bits | 1 << k)
        }
        _ => 0,
    };
    let respond = |to: &mut Rows<E, N>| {
        P::Material::respond_together(
            |point| &materials[if P::MAY_DIFFER { place(point) } else { 0 }],
            response,
            RawTile {
                backend,
                count,
                materials: if P::MAY_DIFFER { count } else { 1 },
                stride: ROW,
                arguments: rows.0.as_flattened(),
                results: to.0.as_flattened_mut(),
                unread,
            },
        )
    };
    if !own & first_bits(count) == 0 {
        return respond(to);
    }
    let mut all = *to;
    let admitted = respond(&mut all);
    for (to, from) in to.0.iter_mut().zip(&all.0) {
        for point in (0..count).filter(|point| own >> point & 1 == 1) {
            to[point] = from[point];
        }
    }
    admitted
}

/// The lanes whose bits are set.
#[inline(always)]
fn mask<R: Real>(bits: u64) -> R::Mask {
    R::splat(0.5).less(R::from_fn(|lane| (bits >> lane & 1) as f64))
}

/// Placeholder for a check of finiteness: accepts every point.
#[inline(always)]
fn anywhere<R: Real>(_: [R; 3]) -> R::Mask {
    R::Mask::splat(true)
}

/// The status of a tile's points from the bits of those that are admitted and of those that are finite.
#[inline(always)]
fn domain_and_range(count: usize, admitted: u64, finite: u64) -> Status<u64> {
    let points = first_bits(count);
    Status { refused: !admitted & points, nonfinite: !finite & points, ..Status::default() }
}
