//! Registers of a program, and the views of them that operations use.

use std::any::Any;
use std::cell::{Cell, RefCell};

use super::parameters::{Context, Parameters, number};
use super::program::{Program, Register, Sizes};
use crate::lanes::Real;
use crate::quotient::Pair;

/// Registers of a program, each as many real numbers side by side as there are groups of points.
pub(super) struct Registers<R: Real> {
    /// Constant registers, followed by the other number registers.
    numbers: Vec<R>,
    /// Number of constant registers.
    constants: usize,
    /// The material and the program that the constants in the registers belong to.
    prepared: Option<Prepared>,
    logarithms: Vec<R::Logarithm>,
    pairs: Vec<Pair<R>>,
}

impl<R: Real> Default for Registers<R> {
    fn default() -> Self {
        Self { numbers: Vec::new(), constants: 0, prepared: None, logarithms: Vec::new(), pairs: Vec::new() }
    }
}

/// A material and a program of it, with all that decides on its constants and their places.
#[derive(Clone, Copy, PartialEq)]
struct Prepared {
    /// The number of the material that contains the program.
    material: u64,
    program: *const Program,
    entry: usize,
    groups: usize,
}

impl Prepared {
    /// `None` if the constants differ between points, or belong to no material.
    fn new(program: &Program, context: &Context<'_>, groups: usize) -> Option<Self> {
        let &Context { parameters, entry, material, .. } = context;
        let material = material.filter(|_| parameters.each.is_none())?;
        Some(Self { material, program, entry, groups })
    }
}

/// Number of sets of registers that a thread keeps for single points: for the programs of a few materials,
/// so that their constants are computed once. Tiles share one, which stays in the innermost cache.
const SETS: usize = 16;

thread_local! {
    /// For each type of real number, the sets of registers that a thread does not use at the moment, those
    /// used last at the end.
    static SPARE: RefCell<Vec<Box<dyn Any>>> = const { RefCell::new(Vec::new()) };
}

fn with_spare<R: Real, T>(body: impl FnOnce(&mut Vec<Registers<R>>) -> T) -> T {
    SPARE.with_borrow_mut(|all| {
        let place = all.iter().position(|one| one.is::<Vec<Registers<R>>>()).unwrap_or_else(|| {
            all.push(Box::new(Vec::<Registers<R>>::new()));
            all.len() - 1
        });
        match all[place].downcast_mut::<Vec<Registers<R>>>() {
            Some(spare) => body(spare),
            None => body(&mut Vec::new()),
        }
    })
}

impl<R: Real> Registers<R> {
    /// Registers for a program, with its constants in them where a set of the thread has these; nothing is
    /// allocated once a thread has had them.
    #[inline(never)]
    pub(super) fn take(program: &Program, context: &Context<'_>, groups: usize) -> Self {
        let these = Prepared::new(program, context, groups);
        let spare = with_spare(|sets: &mut Vec<Self>| {
            if R::IS_RECORDED {
                // What is in registers belongs to the program that was being recorded.
                sets.clear();
            }
            let is_ready = |one: &Self| these.is_some() && one.prepared == these;
            match sets.iter().rposition(is_ready) {
                Some(place) => Some(sets.remove(place)),
                None if groups > 1 || these.is_none() => sets.pop(),
                None if sets.len() < SETS => None,
                None => Some(sets.remove(0)),
            }
        });
        let mut registers = spare.unwrap_or_default();
        let Sizes { numbers, constants, logarithms, pairs } = program.sizes;
        registers.constants = constants;
        let one = R::splat(1.0);
        grow(&mut registers.numbers, numbers * groups, || one);
        grow(&mut registers.logarithms, logarithms * groups, || one.logarithm());
        grow(&mut registers.pairs, pairs * groups, || Pair::of(one, one));
        registers
    }

    /// Keeps the registers for the next program of the thread.
    #[inline(never)]
    pub(super) fn give_back(self) {
        with_spare(|sets| sets.push(self));
    }

    /// Returns true if the constants of a program for this number of groups are in their registers, which
    /// they are after it has been executed.
    pub(super) fn prepare(&mut self, program: &Program, context: &Context<'_>, groups: usize) -> bool {
        let these = Prepared::new(program, context, groups);
        let are_there = these.is_some() && self.prepared == these;
        self.prepared = these;
        are_there
    }

    /// The number in a register, where there is one group of points.
    #[inline(always)]
    pub(super) fn number(&self, register: Register) -> R {
        self.numbers[usize::from(register)]
    }
}

fn grow<T: Clone>(list: &mut Vec<T>, length: usize, entry: impl FnOnce() -> T) {
    if list.len() < length {
        list.resize(length, entry());
    }
}

/// The registers of each kind, as cells: an operand may be in the register of the result.
pub(super) struct Files<'a, R: Real, const G: usize> {
    numbers: &'a [[Cell<R>; G]],
    /// Number of constants among the numbers; only the first group of a constant is in use.
    constants: usize,
    logarithms: &'a [[Cell<R::Logarithm>; G]],
    pairs: &'a [[Cell<Pair<R>>; G]],
}

/// The cells of a register, with a value of its own at each group.
#[derive(Clone, Copy)]
pub(super) struct Each<'a, T, const G: usize>(pub(super) &'a [Cell<T>; G]);

impl<T: Copy, const G: usize> Each<'_, T, G> {
    #[inline(always)]
    pub(super) fn get(self, group: usize) -> T {
        self.0[group].get()
    }

    #[inline(always)]
    pub(super) fn set(self, group: usize, value: T) {
        self.0[group].set(value);
    }
}

/// The cells of a register for numbers, or of a constant.
#[derive(Clone, Copy)]
pub(super) struct Numbers<'a, R, const G: usize> {
    pub(super) cells: &'a [Cell<R>; G],
    /// A mask for the index of a group, which it makes zero where the first cell stands for all. No
    /// condition, for each of which the compiler would make another loop.
    mask: usize,
}

impl<R: Real, const G: usize> Numbers<'_, R, G> {
    #[inline(always)]
    pub(super) fn is_constant(self) -> bool {
        self.mask == 0
    }

    #[inline(always)]
    pub(super) fn get(self, group: usize) -> R {
        self.cells[group & self.mask].get()
    }

    #[inline(always)]
    pub(super) fn set(self, group: usize, value: R) {
        self.cells[group].set(value);
    }

    /// Sets all groups.
    #[inline(always)]
    pub(super) fn fill(self, value: R) {
        if self.is_constant() {
            return self.set(0, value);
        }
        for group in 0..G {
            self.set(group, value);
        }
    }
}

impl<'a, R: Real, const G: usize> Files<'a, R, G> {
    #[inline(always)]
    pub(super) fn new(registers: &'a mut Registers<R>, parameters: &Parameters<'_>) -> Self {
        Self {
            numbers: Cell::from_mut(&mut registers.numbers[..]).as_slice_of_cells().as_chunks().0,
            constants: if parameters.each.is_none() { registers.constants } else { 0 },
            logarithms: Cell::from_mut(&mut registers.logarithms[..]).as_slice_of_cells().as_chunks().0,
            pairs: Cell::from_mut(&mut registers.pairs[..]).as_slice_of_cells().as_chunks().0,
        }
    }

    #[inline(always)]
    pub(super) fn number(&self, register: Register) -> Numbers<'a, R, G> {
        let place = usize::from(register);
        Numbers { cells: &self.numbers[place], mask: usize::from(place >= self.constants).wrapping_neg() }
    }

    #[inline(always)]
    pub(super) fn logarithm(&self, register: Register) -> Each<'a, R::Logarithm, G> {
        Each(&self.logarithms[usize::from(register)])
    }

    #[inline(always)]
    pub(super) fn pair(&self, register: Register) -> Each<'a, Pair<R>, G> {
        Each(&self.pairs[usize::from(register)])
    }

    /// Sets a constant to a parameter, or to an entry of a list.
    #[inline(always)]
    pub(super) fn load(
        &self,
        register: Register,
        parameters: &Parameters<'_>,
        parameter: usize,
        entry: usize,
    ) {
        let to = self.number(register);
        if to.is_constant() {
            return to.set(0, R::splat(number(parameters.some, parameter, entry)));
        }
        for group in 0..G {
            to.set(group, parameters.number(parameter, entry, group));
        }
    }
}
