//! Terms of the energy that the caller computes, such as contact.

use std::ffi::c_void;
use std::sync::atomic::{AtomicI32, Ordering};

use piola_bodies::step::NodeBlocks;

use crate::error::{Code, Failure, guard};
use crate::lent::{self, Arrays, plain};

/// A potential energy of the positions of all nodes, which a simulation adds to that of deformation.
///
/// Its functions get `context` and the positions of the `nodes` nodes, three numbers each, m; the same
/// positions must give the same bits. They return 0, or another number, which ends the step with
/// PIOLA_CODE_CALLBACK. No exception may leave them. They are called by one thread at a time, not necessarily
/// the one that called the library, and must not call functions with the handle of the simulation.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Term {
    /// First argument of the functions. It must live as long as the simulation has this term.
    pub context: *mut c_void,
    /// Writes the energy, J; infinity outside of its domain, which no step will enter.
    pub energy: Option<
        unsafe extern "C" fn(
            context: *mut c_void,
            positions: *const f64,
            nodes: usize,
            energy: *mut f64,
        ) -> i32,
    >,
    /// Adds the gradient of the energy, N, to three numbers for each node.
    pub add_gradient: Option<
        unsafe extern "C" fn(
            context: *mut c_void,
            positions: *const f64,
            nodes: usize,
            gradient: *mut f64,
        ) -> i32,
    >,
    /// Adds the second derivatives of the energy, N/m, by calls of `piola_blocks_add`. Newton's method
    /// converges if they are positive semidefinite, so that negative eigenvalues are best left out.
    pub add_second_derivatives: Option<
        unsafe extern "C" fn(
            context: *mut c_void,
            positions: *const f64,
            nodes: usize,
            blocks: *mut Blocks<'_>,
        ) -> i32,
    >,
    /// Writes the largest share of a displacement, three numbers for each node, with which a line search may
    /// begin, above 0 and at most 1: for barriers that a long step could jump over. May be null: 1.
    pub longest_step: Option<
        unsafe extern "C" fn(
            context: *mut c_void,
            positions: *const f64,
            displacement: *const f64,
            nodes: usize,
            share: *mut f64,
        ) -> i32,
    >,
}
plain!(Term);

/// Second derivatives of a term, valid during the call that receives it.
pub struct Blocks<'a>(&'a mut NodeBlocks);

/// Adds the block of second derivatives by the positions of two nodes, nine numbers row by row, N/m, and, for
/// two different nodes, its transpose as the block of `column` and `row`: add each pair of nodes once.
///
/// The two need not share a tetrahedron. A pair that neither a tetrahedron nor an earlier step has joined
/// costs a new symbolic analysis. A node that does not exist ends the step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_blocks_add(
    blocks: *mut Blocks<'_>,
    row: usize,
    column: usize,
    entries: *const f64,
) -> Code {
    guard(|| {
        // SAFETY: what a term is handed, which no other thread has, and nine numbers.
        unsafe {
            let entries = Arrays::new().input("entries", entries, 9)?;
            let entries = std::array::from_fn(|a| std::array::from_fn(|c| entries[3 * a + c]));
            lent::value_mut("blocks", blocks)?.0.add(row, column, entries);
        }
        Ok(())
    })
}

/// A term with functions of the caller.
pub(crate) struct Callbacks {
    term: Term,
    /// Nonzero value that a function has returned, or 0; after a nonzero value no function is called.
    returned: AtomicI32,
}

// SAFETY: the functions may be called by another thread than that which has set them, one call at a time.
unsafe impl Send for Callbacks {}
// SAFETY: a simulation evaluates its terms one after the other.
unsafe impl Sync for Callbacks {}

impl Callbacks {
    /// # Safety
    /// The functions do what the documentation of [`Term`] requires, as long as this value lives.
    pub(crate) unsafe fn new(term: Term) -> Result<Self, Failure> {
        for (name, is_given) in [
            ("energy", term.energy.is_some()),
            ("add_gradient", term.add_gradient.is_some()),
            ("add_second_derivatives", term.add_second_derivatives.is_some()),
        ] {
            if !is_given {
                return Err(Failure::new(Code::Pointer, format_args!("`terms[].{name}` is null")));
            }
        }
        Ok(Self { term, returned: AtomicI32::new(0) })
    }

    /// Nonzero value that a function of the term has returned since the last call, if any.
    pub(crate) fn take_returned(&self) -> Option<i32> {
        match self.returned.swap(0, Ordering::Relaxed) {
            0 => None,
            returned => Some(returned),
        }
    }

    /// True if a function is given and returns 0, and no earlier call has returned anything else.
    fn succeeds<F>(&self, function: Option<F>, call: impl FnOnce(F, *mut c_void) -> i32) -> bool {
        let may_call = self.returned.load(Ordering::Relaxed) == 0;
        let Some(function) = function.filter(|_| may_call) else { return false };
        let returned = call(function, self.term.context);
        self.returned.store(returned, Ordering::Relaxed);
        returned == 0
    }
}

impl piola_bodies::step::Term for Callbacks {
    fn energy(&self, positions: &[[f64; 3]]) -> Option<f64> {
        let mut energy = f64::NAN;
        let (x, nodes) = (positions.as_flattened().as_ptr(), positions.len());
        // SAFETY: three numbers for each node, and room for one.
        let succeeds =
            self.succeeds(self.term.energy, |find, context| unsafe { find(context, x, nodes, &mut energy) });
        Some(energy).filter(|energy| succeeds && energy.is_finite())
    }

    /// If the function fails, so does the step: its gradient is not finite.
    fn add_gradient(&self, positions: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        let (x, nodes) = (positions.as_flattened().as_ptr(), positions.len());
        let to = gradient.as_flattened_mut().as_mut_ptr();
        // SAFETY: three numbers for each node, twice.
        if !self.succeeds(self.term.add_gradient, |add, context| unsafe { add(context, x, nodes, to) }) {
            gradient.fill([f64::NAN; 3]);
        }
    }

    /// If the function fails, so does the step: its next energy is not finite.
    fn add_second_derivatives(&self, positions: &[[f64; 3]], blocks: &mut NodeBlocks) {
        let (x, nodes) = (positions.as_flattened().as_ptr(), positions.len());
        let mut blocks = Blocks(blocks);
        // SAFETY: three numbers for each node, and blocks that live during the call.
        self.succeeds(self.term.add_second_derivatives, |add, context| unsafe {
            add(context, x, nodes, &mut blocks)
        });
    }

    fn longest_step(&self, positions: &[[f64; 3]], displacement: &[[f64; 3]]) -> f64 {
        let [x, d] = [positions, displacement].map(|vectors| vectors.as_flattened().as_ptr());
        let (mut share, nodes) = (1.0, positions.len());
        // SAFETY: three numbers for each node, twice, and room for one.
        self.succeeds(self.term.longest_step, |find, context| unsafe {
            find(context, x, d, nodes, &mut share)
        });
        share
    }
}
