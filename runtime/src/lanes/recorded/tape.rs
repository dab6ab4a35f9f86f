//! Operations under construction, each of them once and as simple as has the same bits.

use std::collections::{HashMap, HashSet};

use super::program::{Binary, Id, RecordedOperation, RecordedProgram};
use crate::lanes::real::Real;

/// Operations under construction.
#[derive(Default)]
pub(super) struct Tape {
    pub(super) operations: Vec<RecordedOperation>,
    places: HashMap<RecordedOperation, Id>,
    pub(super) guards: HashSet<Id>,
}

impl Tape {
    fn push(&mut self, operation: RecordedOperation) -> Id {
        let Self { operations, places, .. } = self;
        *places.entry(operation).or_insert_with_key(|operation| {
            operations.push(operation.clone());
            operations.len() as Id - 1
        })
    }

    pub(super) fn literal(&self, id: Id) -> Option<f64> {
        match self.operations[id as usize] {
            RecordedOperation::Literal(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    pub(super) fn truth(&self, id: Id) -> Option<bool> {
        match self.operations[id as usize] {
            RecordedOperation::Truth(truth) => Some(truth),
            _ => None,
        }
    }

    /// The guard of which a truth value is the negation.
    fn guard_of_negation(&self, id: Id) -> Option<Id> {
        match self.operations[id as usize] {
            RecordedOperation::Not(guard) if self.guards.contains(&guard) => Some(guard),
            _ => None,
        }
    }

    /// The values of a selection, which may be selections by the same mask.
    fn selected(&self, mask: Id, [yes, no]: [Id; 2]) -> [Id; 2] {
        let inner = |id: Id| match self.operations[id as usize] {
            RecordedOperation::Select(other, yes, no) if other == mask => [yes, no],
            _ => [id; 2],
        };
        [inner(yes)[0], inner(no)[1]]
    }

    /// A truth value where a guard does not hold, false where it does.
    fn unless(&mut self, guard: Id, truth: Id) -> Id {
        let never = self.push(RecordedOperation::Truth(false));
        self.push(RecordedOperation::Select(guard, never, truth))
    }

    /// The operation, or a simpler one with the same bits.
    pub(super) fn simplified(&mut self, is_single: bool, operation: RecordedOperation) -> Id {
        use super::program::Binary::{Divide, Multiply};
        use super::program::Unary::Negate;
        use RecordedOperation::{And, Binary, Less, Literal, Not, Or, Select, Truth, Unary};
        let computed = match operation {
            Unary(Negate, a) => self.literal(a).map(|a| -a),
            Binary(operator, a, b) => match (self.literal(a), self.literal(b)) {
                (Some(a), Some(b)) if is_single => arithmetic::<f32>(operator, a, b).map(f64::from),
                (Some(a), Some(b)) => arithmetic::<f64>(operator, a, b),
                // Exact for any other operand.
                (_, Some(1.0)) if matches!(operator, Multiply | Divide) => return a,
                (Some(1.0), _) if operator == Multiply => return b,
                _ => None,
            },
            Less(a, b) => match (self.literal(a), self.literal(b)) {
                (Some(a), Some(b)) => return self.push(Truth(a < b)),
                _ => None,
            },
            Not(a) => match self.operations[a as usize] {
                Truth(truth) => return self.push(Truth(!truth)),
                Not(a) => return a,
                _ => None,
            },
            And(a, b) | Or(a, b) => {
                let decides = matches!(operation, Or(..));
                match (self.truth(a), self.truth(b)) {
                    (Some(truth), _) => return if truth == decides { a } else { b },
                    (_, Some(truth)) => return if truth == decides { b } else { a },
                    _ if a == b => return a,
                    // A test under the negation of a guard needs no result where the guard holds.
                    _ if !decides => match (self.guard_of_negation(a), self.guard_of_negation(b)) {
                        (Some(guard), _) => return self.unless(guard, b),
                        (_, Some(guard)) => return self.unless(guard, a),
                        _ => None,
                    },
                    _ => None,
                }
            }
            Select(mask, yes, no) if self.selected(mask, [yes, no]) != [yes, no] => {
                let [yes, no] = self.selected(mask, [yes, no]);
                return self.simplified(is_single, Select(mask, yes, no));
            }
            Select(_, yes, no) if yes == no => return yes,
            Select(mask, yes, no) => match self.operations[mask as usize] {
                Truth(truth) => return if truth { yes } else { no },
                Not(mask) => return self.push(Select(mask, no, yes)),
                Select(guard, never, inner) if self.truth(never) == Some(false) => {
                    let selected = self.simplified(is_single, Select(inner, yes, no));
                    return self.push(Select(guard, no, selected));
                }
                _ => None,
            },
            _ => None,
        };
        self.push(computed.map_or(operation, |value| Literal(value.to_bits())))
    }

    /// The operations that the results need, in order.
    pub(super) fn into_program(self, results: Vec<Id>) -> RecordedProgram {
        let mut is_needed = vec![false; self.operations.len()];
        for &result in &results {
            is_needed[result as usize] = true;
        }
        for (k, operation) in self.operations.iter().enumerate().rev() {
            if is_needed[k] {
                operation.for_each_operand(|id| is_needed[id as usize] = true);
            }
        }
        let mut places = vec![0; self.operations.len()];
        let mut operations = Vec::new();
        for (k, operation) in self.operations.into_iter().enumerate().filter(|&(k, _)| is_needed[k]) {
            places[k] = operations.len() as Id;
            operations.push(operation.with_operands(|id| places[id as usize]));
        }
        let moved = |id: Id| places[id as usize];
        RecordedProgram {
            operations,
            results: results.into_iter().map(moved).collect(),
            guards: self.guards.into_iter().filter(|&id| is_needed[id as usize]).map(moved).collect(),
        }
    }
}

/// The result of an operation on literals, if it is one of arithmetic.
fn arithmetic<R: Real>(operator: Binary, a: f64, b: f64) -> Option<R> {
    let (a, b) = (R::splat(a), R::splat(b));
    match operator {
        Binary::Add => Some(a + b),
        Binary::Subtract => Some(a - b),
        Binary::Multiply => Some(a * b),
        Binary::Divide => Some(a / b),
        Binary::CopySign => None,
    }
}
