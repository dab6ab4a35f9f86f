//! The order in which a recorded program is printed, with branches where code may be skipped.
//!
//! A selection by a mask that the computation has tested is a branch: it contains the operations that only
//! one of its values needs. Otherwise the order of the record is kept.

use std::collections::BTreeSet;

use piola::__private::record::{Id, RecordedOperation, RecordedProgram};

/// A statement, or two lists of them of which one is executed.
pub(super) enum Step {
    /// Computes an operation.
    Compute(Id),
    /// Selections by a mask, each with its values where that holds and where it does not, and the statements
    /// that compute these.
    Branch { mask: Id, selections: Vec<(Id, [Id; 2])>, inner: [Vec<Step>; 2] },
}

/// The statements of a program, and the conditions under which each operation is needed.
pub(super) struct Steps {
    pub(super) all: Vec<Step>,
    pub(super) needed: Vec<Path>,
}

/// True if an operation needs no statement because it is written where it is used.
pub(super) fn is_inline(operation: &RecordedOperation) -> bool {
    use RecordedOperation::{Argument, Literal, Parameter, Part, Truth};
    matches!(operation, Argument(_) | Parameter(_) | Literal(_) | Truth(_) | Part(..))
}

impl Steps {
    pub(super) fn of(program: &RecordedProgram) -> Self {
        let mut order = Order::new(program);
        let all: BTreeSet<Id> = (0..program.operations.len() as Id).collect();
        let all = order.steps(&[], &all);
        Self { all, needed: order.needed }
    }
}

/// Conditions under which operations are needed: masks that hold or do not, the outermost first.
pub(super) type Path = Vec<(Id, bool)>;

struct Order<'a> {
    program: &'a RecordedProgram,
    /// The conditions under which each operation is needed.
    needed: Vec<Path>,
    is_done: Vec<bool>,
}

impl<'a> Order<'a> {
    fn new(program: &'a RecordedProgram) -> Self {
        let count = program.operations.len();
        let mut needed: Vec<Option<Path>> = vec![None; count];
        for &result in &program.results {
            needed[result as usize] = Some(Path::new());
        }
        for k in (0..count).rev() {
            let path = needed[k].clone().unwrap_or_default();
            let mut need = |id: Id, path: &[(Id, bool)]| {
                let old = needed[id as usize].take();
                needed[id as usize] = Some(old.map_or(path.to_vec(), |old| common(&old, path)));
            };
            match guarded(program, k as Id) {
                Some((mask, yes, no)) => {
                    need(mask, &path);
                    need(yes, &within(&path, mask, true));
                    need(no, &within(&path, mask, false));
                }
                None => program.operations[k].for_each_operand(|id| need(id, &path)),
            }
        }
        let needed = needed.into_iter().map(Option::unwrap_or_default).collect();
        Self { program, needed, is_done: vec![false; count] }
    }

    /// Statements under conditions, of these operations.
    fn steps(&mut self, path: &[(Id, bool)], operations: &BTreeSet<Id>) -> Vec<Step> {
        let mut steps = Vec::new();
        let here: Vec<_> =
            operations.iter().copied().filter(|&id| self.needed[id as usize] == path).collect();
        for &id in &here {
            if self.is_done[id as usize] {
                continue;
            }
            let Some((mask, ..)) = guarded(self.program, id) else {
                self.is_done[id as usize] = true;
                if !is_inline(&self.program.operations[id as usize]) {
                    steps.push(Step::Compute(id));
                }
                continue;
            };
            let mut selections = Vec::new();
            let mut inside = [BTreeSet::new(), BTreeSet::new()];
            for &other in here.iter().filter(|&&other| !self.is_done[other as usize]) {
                let same = guarded(self.program, other).filter(|&(other_mask, ..)| other_mask == mask);
                let Some((_, yes, no)) = same else { continue };
                let mut further = inside.clone();
                let is_ready = |(value, inside): (Id, &mut BTreeSet<Id>)| self.collect(value, path, inside);
                if [yes, no].into_iter().zip(&mut further).all(is_ready) {
                    selections.push((other, [yes, no]));
                    inside = further;
                }
            }
            let inner = [true, false].map(|holds| {
                let within = within(path, mask, holds);
                match within == path {
                    true => Vec::new(),
                    false => self.steps(&within, &inside[usize::from(!holds)]),
                }
            });
            // What a branch defines is not known after it: another one that needs it computes it again.
            for &id in inside.iter().flatten() {
                self.is_done[id as usize] = false;
            }
            for &(selection, _) in &selections {
                self.is_done[selection as usize] = true;
            }
            steps.push(Step::Branch { mask, selections, inner });
        }
        steps
    }

    /// Collects what a value needs under further conditions than these; false if it needs more that has not
    /// been computed.
    fn collect(&self, id: Id, path: &[(Id, bool)], to: &mut BTreeSet<Id>) -> bool {
        let mut open = vec![id];
        while let Some(id) = open.pop() {
            if self.is_done[id as usize] || to.contains(&id) {
                continue;
            }
            let (operation, needed) = (&self.program.operations[id as usize], &self.needed[id as usize]);
            if needed.len() > path.len() && needed.starts_with(path) {
                to.insert(id);
            } else if !is_inline(operation) {
                return false;
            }
            operation.for_each_operand(|operand| open.push(operand));
        }
        true
    }
}

/// Mask and values of a selection that is a branch.
pub(super) fn guarded(program: &RecordedProgram, id: Id) -> Option<(Id, Id, Id)> {
    match program.operations[id as usize] {
        RecordedOperation::Select(mask, yes, no) if program.guards.contains(&mask) => Some((mask, yes, no)),
        _ => None,
    }
}

/// These conditions and that a mask holds or not, unless they decide on it already.
fn within(path: &[(Id, bool)], mask: Id, holds: bool) -> Path {
    let is_decided = path.iter().any(|&(known, _)| known == mask);
    path.iter().copied().chain((!is_decided).then_some((mask, holds))).collect()
}

/// The conditions that both are within.
fn common(one: &[(Id, bool)], other: &[(Id, bool)]) -> Path {
    one.iter().zip(other).take_while(|(one, other)| one == other).map(|(&one, _)| one).collect()
}
