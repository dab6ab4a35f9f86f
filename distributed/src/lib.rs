//! Simulation of elastic bodies that are too large for one machine: piola's elements, divided among the ranks
//! of MPI, with the solvers of PETSc.
//!
//! The mathematics of materials and elements, and the steps, are piola's: each rank runs a simulation of its
//! part of the body by [`piola_bodies::step`]. This crate contains the division of a mesh ([`portion`],
//! [`share`]), the messages between ranks ([`team`], [`division`]), and the linear systems ([`system`],
//! [`petsc`]).
//!
//! Every rank calls every function, in the same order. An error on one rank is sent to all ranks, and ends
//! them together.
//!
//! Contact, and surfaces embedded in the tetrahedra, are not supported.

pub mod checkpoint;
pub mod coarse;
pub mod command;
pub mod division;
pub mod error;
pub mod output;
pub mod part;
pub mod petsc;
pub mod portion;
pub mod run;
pub mod setting;
pub mod share;
pub mod simulation;
pub mod system;
pub mod team;
