//! The executor: the operations of a program, each at many points before the next.
//!
//! An operation is read once for all registers of a tile, so that reading it costs little compared with
//! computing. Each is the one that the emitted Rust of the same declaration performs, in the same order, so
//! that results have the same bits.

use piola_codegen::schedule::Op;

use super::compute::compute;
use super::domain::VolumeBound;
use super::parameters::Context;
use super::program::{Loop, Operation, Program};
use super::registers::{Files, Registers};
use crate::lanes::{Backend, ByFormat, Kernel, Lanes, Real, Scalar};
use crate::material::RawTile;

/// Executes a program for one point, or one register of points.
///
/// Not inlined into the function of a back end, and so slow on lanes: see [`execute_tile`].
#[inline(never)]
pub(super) fn execute_alone<R: Real>(
    program: &Program,
    context: Context<'_>,
    arguments: &[R],
    registers: &mut Registers<R>,
) {
    let is_prepared = registers.prepare(program, &context, 1);
    let file = Files::<R, 1>::new(registers, &context.parameters);
    for &(register, k) in &program.arguments {
        file.number(register).set(0, arguments[k]);
    }
    execute(program, context, &file, is_prepared);
}

/// Executes a program for a tile of points. Returns the points at which its bounds are positive and whose
/// volume is inside the domain, as bits.
///
/// One kernel for all programs, in each format: what differs between them is data.
pub(super) fn execute_tile<E: Scalar>(
    program: &Program,
    context: Context<'_>,
    volume: VolumeBound,
    tile: RawTile<'_, E>,
) -> u64 {
    let RawTile { backend, count, materials, stride, arguments, results, unread } = tile;
    match E::by_format(arguments, results) {
        ByFormat::F64(arguments, results) => {
            let tile = RawTile { backend, count, materials, stride, arguments, results, unread };
            execute_in_f64(backend, Execution { program, context, volume, tile })
        }
        #[cfg(feature = "f32")]
        ByFormat::F32(arguments, results) => {
            let tile = RawTile { backend, count, materials, stride, arguments, results, unread };
            execute_in_f32(backend, Execution { program, context, volume, tile })
        }
        // There are no batches in `f32`.
        #[cfg(not(feature = "f32"))]
        ByFormat::F32(..) => 0,
    }
}

// Not generic: compiled in this crate and not in each that has a material of this kind.
#[inline(never)]
fn execute_in_f64(backend: Backend, execution: Execution<'_, '_, f64>) -> u64 {
    backend.run(execution)
}

#[cfg(feature = "f32")]
#[inline(never)]
fn execute_in_f32(backend: Backend, execution: Execution<'_, '_, f32>) -> u64 {
    backend.run(execution)
}

/// [`execute_tile`] on the lanes of a back end.
struct Execution<'a, 'c, E> {
    program: &'a Program,
    context: Context<'c>,
    /// The volumes inside the domain.
    volume: VolumeBound,
    tile: RawTile<'a, E>,
}

impl<E: Scalar> Kernel<E> for Execution<'_, '_, E> {
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        // As many groups together as make a tile, or one after the other where there are few points.
        if self.tile.count <= 2 * R::LANES {
            return self.by_groups::<R, 1>();
        }
        // A constant by itself, so that the compiler forgets the other numbers at once.
        match const { 64 / R::LANES } {
            4 => self.by_groups::<R, 4>(),
            8 => self.by_groups::<R, 8>(),
            16 => self.by_groups::<R, 16>(),
            _ => self.by_groups::<R, 32>(),
        }
    }
}

impl<E: Scalar> Execution<'_, '_, E> {
    /// Executes the program for G groups of lanes at a time.
    #[inline(always)]
    fn by_groups<R: Lanes<Scalar = E>, const G: usize>(self) -> u64 {
        let Self { program, mut context, volume, tile } = self;
        let RawTile { count, stride, arguments, results, unread, .. } = tile;
        context.parameters.lanes = R::LANES;
        let mut registers = Registers::<R>::take(program, &context, G);
        let mut admitted = if volume.is_any() && program.bounds.is_empty() { u64::MAX } else { 0 };
        let mut start = 0;
        while start < count {
            context.parameters.start = start;
            let is_prepared = registers.prepare(program, &context, G);
            let file = Files::<R, G>::new(&mut registers, &context.parameters);
            for &(register, k) in &program.arguments {
                let from = &arguments[k * stride + start..][..G * R::LANES];
                let to = file.number(register);
                for group in 0..G {
                    to.set(group, R::load(&from[group * R::LANES..]));
                }
            }
            execute(program, context, &file, is_prepared);
            for (k, &register) in program.results.iter().enumerate() {
                if unread >> k & 1 == 1 {
                    continue;
                }
                let to = &mut results[k * stride + start..][..G * R::LANES];
                let from = file.number(register);
                for group in 0..G {
                    from.get(group).store(&mut to[group * R::LANES..]);
                }
            }
            if admitted != u64::MAX {
                for group in 0..G {
                    let at = start + group * R::LANES;
                    let argument = |k: usize| R::load(&arguments[k * stride + at..]);
                    let mut is_inside = volume.holds([argument(0), argument(1), argument(2)]);
                    for &bound in &program.bounds {
                        is_inside = is_inside & R::splat(0.0).less(file.number(bound).get(group));
                    }
                    admitted |= R::bits(is_inside) << at;
                }
            }
            start += G * R::LANES;
        }
        registers.give_back();
        admitted
    }
}

/// Executes a program whose arguments are in their registers, and its constants if it is prepared, for G
/// groups of points.
#[inline(always)]
fn execute<R: Real, const G: usize>(
    program: &Program,
    context: Context<'_>,
    file: &Files<'_, R, G>,
    is_prepared: bool,
) {
    let Context { ref parameters, mut entry, epsilon, .. } = context;
    let mut next = program.preparations;
    if !is_prepared {
        next = 0;
        for &(register, constant) in &program.filled {
            match constant {
                Op::Literal(bits) => file.number(register).fill(R::splat(f64::from_bits(bits))),
                Op::Epsilon => file.number(register).fill(R::splat(epsilon)),
                Op::Parameter(parameter) => file.load(register, parameters, parameter, 0),
                Op::Entry(list) => file.load(register, parameters, list, entry),
                _ => {}
            }
        }
    }
    let outside = entry;
    while let Some(operation) = program.operations.get(next) {
        next += 1;
        match *operation {
            Operation::Begin(place) => {
                let Loop { list, entries, totals, length } = &program.loops[place];
                totals.iter().for_each(|&(total, _)| file.number(total).fill(R::splat(0.0)));
                entry = 0;
                if parameters.length(*list) == 0 {
                    entry = outside;
                    next += length + 1;
                } else {
                    for &(register, list) in entries {
                        file.load(register, parameters, list, 0);
                    }
                }
            }
            Operation::End(place) => {
                let Loop { list, entries, totals, length } = &program.loops[place];
                for &(total, term) in totals {
                    let (total, term) = (file.number(total), file.number(term));
                    for group in 0..G {
                        total.set(group, total.get(group) + term.get(group));
                    }
                }
                entry += 1;
                if entry < parameters.length(*list) {
                    for &(register, list) in entries {
                        file.load(register, parameters, list, entry);
                    }
                    next -= length + 1;
                } else {
                    entry = outside;
                }
            }
            operation => compute(program, operation, file, parameters, entry),
        }
    }
}
