//! Exchange of nodes, and of the rows of a multigrid level, between ranks: owned rows, and copies of rows of
//! other ranks.
//!
//! Vectors are exchanged by PETSc, lists of integers by [`Team::exchange`]. PETSc also solves the last level.
//! This module does not depend on bodies.

use std::ops::Range;

use piola::lanes::Real;
use piola_bodies::step::divided::{Division, LastLevel};

use crate::coarse::Coarse;
use crate::error::Error;
use crate::petsc::{PetscError, Vector};
use crate::team::Team;

/// Largest number of rows of a level that is always the last. Large bodies have a larger last level, with
/// half the square root of the number of nodes as the number of rows: on a small level, one aggregate would
/// contain most rows, which would increase the number of iterations.
const FEW: usize = 64;

/// Maximum number of rows of a last level that grows with the body; PETSc factors them in about a second.
const MOST: usize = 512;

/// Average number of rows on a rank at which a level is the last: fewer rows would give hardly any
/// aggregates.
const FEW_OF_A_RANK: usize = 32;

/// Rows of a level on one rank: owned rows, and copies of rows of other ranks.
pub(crate) struct RowsOfRank {
    team: Team,
    /// Global numbers of the owned rows.
    owned: Range<usize>,
    /// Global number of each copy.
    numbers: Vec<usize>,
    /// Owned rows, for each rank, of which that rank has copies.
    sent: Vec<Vec<usize>>,
    /// Copies, for each rank, of rows of that rank.
    received: Vec<Vec<usize>>,
    /// Vectors of three and of six components, created when they are first used.
    vectors: [Option<Vector>; 2],
}

impl RowsOfRank {
    /// Division with a number of owned rows on this rank, and copies of the rows with the global numbers
    /// `numbers`, which are counted rank after rank. Errors of exchanges are noted by the team.
    pub(crate) fn new(team: &Team, owned: usize, numbers: Vec<usize>) -> Self {
        let mut starts = vec![0];
        for owned in team.all(owned) {
            starts.push(starts[starts.len() - 1] + owned);
        }
        let mut received = vec![Vec::new(); team.size];
        let mut asked = vec![Vec::new(); team.size];
        for (copy, &number) in numbers.iter().enumerate() {
            let rank = starts.partition_point(|&start| start <= number) - 1;
            received[rank].push(copy);
            asked[rank].push((number - starts[rank]) as u64);
        }
        let rows = |rows: Vec<u64>| rows.into_iter().map(|row| row as usize).collect();
        Self {
            owned: starts[team.rank]..starts[team.rank + 1],
            numbers,
            sent: team.exchange(&asked).into_iter().map(rows).collect(),
            received,
            vectors: [None, None],
            team: team.clone(),
        }
    }

    /// Exchanges a vector of N components, if there are several ranks.
    fn with_vector<const N: usize>(&mut self, exchange: impl FnOnce(&mut Vector) -> Result<(), PetscError>) {
        if self.team.size == 1 {
            return;
        }
        let owned = self.owned.len();
        let vector = &mut self.vectors[usize::from(N > 3)];
        let exchanged = match vector {
            Some(vector) => exchange(vector),
            None => Vector::new(&self.team.library, N, owned, &self.numbers)
                .and_then(|made| exchange(vector.insert(made))),
        };
        self.team.note(exchanged);
    }

    /// Sends the lists of the rows `rows` to other ranks, and returns the lists received for the rows `to`.
    fn lists(
        &self,
        rows: &[Vec<usize>],
        mut list: impl FnMut(usize, &mut Vec<u64>),
        to: &[Vec<usize>],
    ) -> Vec<(usize, Vec<u64>)> {
        // Each list follows its length.
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

impl Division for RowsOfRank {
    type Error = Error;
    type Last = Coarse;

    fn copies(&self) -> usize {
        self.numbers.len()
    }

    fn copy<E: Real + Into<f64>, const N: usize>(&mut self, rows: &mut [[E; N]]) {
        self.with_vector::<N>(|vector| vector.copy(rows.as_flattened_mut()));
    }

    fn sum<E: Real + Into<f64>, const N: usize>(&mut self, rows: &mut [[E; N]]) {
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

    fn totals<const N: usize>(&self, numbers: [f64; N]) -> [f64; N] {
        self.team.sum(numbers)
    }

    fn largest(&self, number: f64) -> f64 {
        self.team.max(number)
    }

    fn first(&self, rows: usize) -> u64 {
        self.team.all(rows)[..self.team.rank].iter().sum::<usize>() as u64
    }

    fn coarse(&self, rows: usize, copies: Vec<u64>) -> Result<Self, Error> {
        let numbers = copies.into_iter().map(|number| number as usize).collect();
        Ok(Self::new(&self.team, rows, numbers))
    }

    fn is_last(&self, rows: usize, nodes: usize) -> bool {
        rows <= (nodes.isqrt() / 2).clamp(FEW, MOST).max(FEW_OF_A_RANK * self.team.size)
    }

    fn last(&self, level: &LastLevel<'_>) -> Result<Coarse, Error> {
        let numbers: Vec<usize> = self.owned.clone().chain(self.numbers.iter().copied()).collect();
        Ok(Coarse::new(&self.team, self.owned.len(), &numbers, level)?)
    }
}
