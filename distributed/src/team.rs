//! Communication of all ranks of a run: sums, exchanges, and errors that are sent to all ranks.
//!
//! This module does not depend on bodies. All ranks must call every function, in the same order.

use std::cell::RefCell;
use std::rc::Rc;

use mpi::collective::SystemOperation;
use mpi::datatype::{Partition, PartitionMut};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Root};
use mpi::{Count, Rank};

use crate::error::Error;
use crate::petsc::Library;

/// Team of all ranks of a run, on one rank.
#[derive(Clone)]
pub struct Team {
    /// Library that runs on all ranks.
    pub(crate) library: Library,
    /// Number of this rank, from 0.
    pub rank: usize,
    /// Number of ranks.
    pub(crate) size: usize,
    /// First error, since the last call of [`Team::take_failure`], of functions that cannot return it.
    failure: Rc<RefCell<Option<Error>>>,
}

impl Team {
    /// Team of all ranks that run the library.
    #[must_use]
    pub fn new(library: &Library) -> Self {
        let world = library.world();
        let (rank, size) = (world.rank() as usize, world.size() as usize);
        Self { library: library.clone(), rank, size, failure: Rc::default() }
    }

    fn world(&self) -> &SimpleCommunicator {
        self.library.world()
    }

    /// Sum of each entry over the ranks.
    pub(crate) fn sum<const N: usize>(&self, entries: [f64; N]) -> [f64; N] {
        let mut total = [0.0; N];
        self.world().all_reduce_into(&entries[..], &mut total[..], SystemOperation::sum());
        total
    }

    /// Sum of a number over the ranks.
    pub(crate) fn count(&self, number: usize) -> usize {
        let mut total = 0_u64;
        self.world().all_reduce_into(&(number as u64), &mut total, SystemOperation::sum());
        total as usize
    }

    /// Largest value of any rank; NaN if a value is NaN.
    pub(crate) fn max(&self, number: f64) -> f64 {
        // MPI does not define the maximum of NaN.
        let mut total = [0.0; 2];
        let own =
            [if number.is_nan() { f64::NEG_INFINITY } else { number }, f64::from(u8::from(number.is_nan()))];
        self.world().all_reduce_into(&own[..], &mut total[..], SystemOperation::max());
        if total[1] > 0.0 { f64::NAN } else { total[0] }
    }

    /// Smallest value of any rank; NaN if a value is NaN.
    pub(crate) fn min(&self, number: f64) -> f64 {
        -self.max(-number)
    }

    /// Values of all ranks.
    #[must_use]
    pub fn all(&self, number: usize) -> Vec<usize> {
        let mut numbers = vec![0_u64; self.size];
        self.world().all_gather_into(&(number as u64), &mut numbers[..]);
        numbers.into_iter().map(|number| number as usize).collect()
    }

    /// Waits until all ranks have called this function.
    pub(crate) fn wait(&self) {
        self.world().barrier();
    }

    /// Sends a list of integers to each rank, and returns the list received from each rank.
    pub(crate) fn exchange(&self, outgoing: &[Vec<u64>]) -> Vec<Vec<u64>> {
        let lengths: Vec<Count> = outgoing.iter().map(|list| list.len() as Count).collect();
        let mut incoming = vec![0 as Count; self.size];
        self.world().all_to_all_into(&lengths[..], &mut incoming[..]);
        let mut received = vec![0_u64; incoming.iter().map(|&length| length as usize).sum()];
        {
            let (sent, starts_of_sent) = (outgoing.concat(), starts(&lengths));
            let from = Partition::new(&sent[..], lengths, starts_of_sent);
            let mut to = PartitionMut::new(&mut received[..], incoming.clone(), starts(&incoming));
            self.world().all_to_all_varcount_into(&from, &mut to);
        }
        let mut rest = received.as_slice();
        let next = |length: Count| {
            let (list, after) = rest.split_at(length as usize);
            rest = after;
            list.to_vec()
        };
        incoming.into_iter().map(next).collect()
    }

    /// Sends each row of integers to its rank, and returns the rows received from each rank.
    pub(crate) fn send<const N: usize>(
        &self,
        rows: impl IntoIterator<Item = (usize, [u64; N])>,
    ) -> Vec<Vec<[u64; N]>> {
        let mut outgoing: Vec<Vec<u64>> = vec![Vec::new(); self.size];
        rows.into_iter().for_each(|(rank, row)| outgoing[rank].extend(row));
        let incoming = self.exchange(&outgoing);
        drop(outgoing);
        incoming.into_iter().map(|list| list.as_chunks().0.to_vec()).collect()
    }

    /// Bytes of a rank, sent to all ranks.
    pub(crate) fn broadcast(&self, rank: usize, mut bytes: Vec<u8>) -> Vec<u8> {
        let root = self.world().process_at_rank(rank as Rank);
        let mut length = bytes.len() as u64;
        root.broadcast_into(&mut length);
        bytes.resize(length as usize, 0);
        root.broadcast_into(&mut bytes[..]);
        bytes
    }

    /// Result of this rank if all ranks succeed; otherwise, on all ranks, the error of the first rank that
    /// failed.
    ///
    /// # Errors
    /// [`Error::OnRank`].
    pub fn agree<T>(&self, result: Result<T, Error>) -> Result<T, Error> {
        let own = if result.is_err() { self.rank as u64 } else { u64::MAX };
        let mut first = 0_u64;
        self.world().all_reduce_into(&own, &mut first, SystemOperation::min());
        if first == u64::MAX {
            return result;
        }
        let message = match &result {
            Err(Error::OnRank { message, .. }) => message.clone().into_bytes(),
            Err(error) => error.to_string().into_bytes(),
            Ok(_) => Vec::new(),
        };
        let message = self.broadcast(first as usize, message);
        Err(Error::OnRank { rank: first as usize, message: String::from_utf8_lossy(&message).into_owned() })
    }

    /// Result of rank 0, which alone does this work; an empty result on the other ranks. If rank 0 fails, all
    /// ranks do.
    pub(crate) fn on_first<T: Default>(&self, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        self.agree(if self.rank == 0 { work() } else { Ok(T::default()) })
    }

    /// Value of a result of this rank; an error is kept, unless an earlier one is.
    pub(crate) fn note<T, E: Into<Error>>(&self, result: Result<T, E>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                self.failure.borrow_mut().get_or_insert_with(|| error.into());
                None
            }
        }
    }

    /// True if an error of this rank is kept.
    pub(crate) fn has_failed(&self) -> bool {
        self.failure.borrow().is_some()
    }

    /// Removes the error that is kept, and returns it.
    pub(crate) fn take_failure(&self) -> Result<(), Error> {
        self.failure.borrow_mut().take().map_or(Ok(()), Err)
    }

    /// Ends all ranks at once, after an error that cannot be sent to the others.
    pub fn abort(&self) -> ! {
        self.world().abort(1)
    }
}

fn starts(lengths: &[Count]) -> Vec<Count> {
    let mut start = 0;
    lengths
        .iter()
        .map(|length| {
            let here = start;
            start += length;
            here
        })
        .collect()
}
