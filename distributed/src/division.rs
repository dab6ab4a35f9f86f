//! Rows of a level of multigrid that other ranks have copies of, and copies of theirs.
//!
//! Vectors are exchanged by PETSc, lists of numbers by [`Team::exchange`]. The solver of the last level is
//! PETSc's too. This module knows no bodies.

use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

use piola::step::divided::{Division, LastLevel};

use crate::coarse::Coarse;
use crate::error::Error;
use crate::petsc::{GhostedVector, PetscError};
use crate::team::Team;

/// Rows of a level that is always the last. Large bodies have a larger last level, of half the root of the
/// number of their nodes: an aggregate of a small level is most of it, and takes iterations.
const FEW: usize = 64;

/// Rows up to which the last level grows with the body: PETSc takes a second or so to factor them.
const MOST: usize = 512;

/// Rows of a rank, on average, with which a level is the last: fewer would be hardly any aggregates.
const FEW_OF_A_RANK: usize = 32;

/// The first error of exchanges that cannot return one, since it was taken last.
#[derive(Clone, Default)]
pub struct Failure(Rc<RefCell<Option<PetscError>>>);

impl Failure {
    /// Keeps an error unless there is one.
    pub fn note(&self, result: Result<(), PetscError>) {
        if let Err(error) = result {
            self.0.borrow_mut().get_or_insert(error);
        }
    }

    /// Takes the error.
    ///
    /// # Errors
    /// The [`PetscError`] that there was.
    pub fn take(&self) -> Result<(), PetscError> {
        self.0.borrow_mut().take().map_or(Ok(()), Err)
    }
}

/// The rows of a level on one rank: its own, and copies.
pub struct Copies {
    team: Team,
    failure: Failure,
    /// Numbers of the owned rows among those of all ranks.
    owned: Range<u64>,
    /// Number of each copy.
    numbers: Vec<usize>,
    /// For each rank the owned rows that it has copies of.
    sent: Vec<Vec<usize>>,
    /// For each rank the copies of its rows.
    received: Vec<Vec<usize>>,
    /// Of three components, and of six: where they have been asked for.
    vectors: [Option<GhostedVector>; 2],
}

impl Copies {
    /// Division in which this rank owns a number of rows and copies of the rows with these numbers, rank after rank.
    /// Errors of exchanges are noted in `failure`.
    #[must_use]
    pub fn new(team: &Team, failure: &Failure, owned: usize, numbers: Vec<usize>) -> Self {
        let mut starts = vec![0];
        for owned in team.all(owned) {
            starts.push(starts[starts.len() - 1] + owned);
        }
        let mut received = vec![Vec::new(); team.size()];
        let mut asked = vec![Vec::new(); team.size()];
        for (copy, &number) in numbers.iter().enumerate() {
            let rank = starts.partition_point(|&start| start <= number) - 1;
            received[rank].push(copy);
            asked[rank].push((number - starts[rank]) as u64);
        }
        let rows = |rows: Vec<u64>| rows.into_iter().map(|row| row as usize).collect();
        Self {
            failure: failure.clone(),
            owned: starts[team.rank()] as u64..starts[team.rank() + 1] as u64,
            numbers,
            sent: team.exchange(&asked).into_iter().map(rows).collect(),
            received,
            vectors: [None, None],
            team: team.clone(),
        }
    }

    /// Number of each row of this rank, copies included, among those of all ranks.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = usize> {
        self.owned.clone().map(|number| number as usize).chain(self.numbers.iter().copied())
    }

    pub(crate) fn owned(&self) -> usize {
        (self.owned.end - self.owned.start) as usize
    }

    pub(crate) fn team(&self) -> &Team {
        &self.team
    }

    pub(crate) fn failure(&self) -> &Failure {
        &self.failure
    }

    /// Exchanges vectors of N components, on several ranks.
    fn with_vector<const N: usize>(
        &mut self,
        exchange: impl FnOnce(&mut GhostedVector) -> Result<(), PetscError>,
    ) {
        if self.team.size() == 1 {
            return;
        }
        let owned = self.owned();
        let vector = &mut self.vectors[usize::from(N > 3)];
        let exchanged = match vector {
            Some(vector) => exchange(vector),
            None => GhostedVector::new(self.team.library(), N, owned, &self.numbers)
                .and_then(|made| exchange(vector.insert(made))),
        };
        self.failure.note(exchanged);
    }

    /// Sends the lists of some rows to other ranks, and returns those that they send for some rows.
    fn lists(
        &self,
        rows: &[Vec<usize>],
        mut list: impl FnMut(usize, &mut Vec<u64>),
        to: &[Vec<usize>],
    ) -> Vec<(usize, Vec<u64>)> {
        // Each list after its length.
        let mut words = |rows: &Vec<usize>| {
            let mut words = Vec::new();
            for &row in rows {
                let at = words.len();
                words.push(0);
                list(row, &mut words);
                words[at] = (words.len() - at - 1) as u64;
            }
            words
        };
        let outgoing: Vec<Vec<u64>> = rows.iter().map(&mut words).collect();
        let mut lists = Vec::new();
        for (words, rows) in self.team.exchange(&outgoing).iter().zip(to) {
            let mut rest = words.as_slice();
            for &row in rows {
                let Some((&length, after)) = rest.split_first() else { break };
                let (list, after) = after.split_at(length as usize);
                lists.push((row, list.to_vec()));
                rest = after;
            }
        }
        lists
    }
}

impl Division for Copies {
    type Error = Error;
    type Last = Coarse;

    fn copies(&self) -> usize {
        self.numbers.len()
    }

    fn copy<const N: usize>(&mut self, rows: &mut [[f32; N]]) {
        self.with_vector::<N>(|vector| vector.copy(rows.as_flattened_mut()));
    }

    fn sum<const N: usize>(&mut self, rows: &mut [[f32; N]]) {
        self.with_vector::<N>(|vector| vector.sum(rows.as_flattened_mut()));
    }

    fn lists_for_copies(&mut self, list: impl FnMut(usize, &mut Vec<u64>)) -> Vec<Vec<u64>> {
        let mut lists = vec![Vec::new(); self.numbers.len()];
        for (copy, list) in self.lists(&self.sent, list, &self.received) {
            lists[copy] = list;
        }
        lists
    }

    fn lists_for_owners(&mut self, list: impl FnMut(usize, &mut Vec<u64>)) -> Vec<(usize, Vec<u64>)> {
        self.lists(&self.received, list, &self.sent)
    }

    fn total(&self, number: f64) -> f64 {
        self.team.sum([number])[0]
    }

    fn largest(&self, number: f64) -> f64 {
        self.team.max(number)
    }

    fn first(&self, rows: usize) -> u64 {
        self.team.all(rows)[..self.team.rank()].iter().sum::<usize>() as u64
    }

    fn coarse(&self, rows: usize, copies: Vec<u64>) -> Result<Self, Error> {
        let numbers = copies.into_iter().map(|number| number as usize).collect();
        Ok(Self::new(&self.team, &self.failure, rows, numbers))
    }

    fn is_last(&self, rows: usize, nodes: usize) -> bool {
        rows <= (nodes.isqrt() / 2).clamp(FEW, MOST).max(FEW_OF_A_RANK * self.team.size())
    }

    fn last(&self, level: &LastLevel<'_>) -> Result<Coarse, Error> {
        Ok(Coarse::new(self, level)?)
    }
}
