//! Simulation of elastic bodies that are too large for one machine: piola's elements, divided among the ranks
//! of MPI, with the solvers of PETSc.
//!
//! The mathematics of materials and elements, and the steps, are piola's: each rank runs a simulation of its
//! part of the body by [`piola_bodies::step`]. This crate contains the division of a mesh ([`portion`],
//! [`share`]), the messages between ranks ([`team`], `division`), and the linear systems (`system`,
//! [`petsc`]). Its program is `piola-mpi`; public items are those that program and tests use.
//!
//! Every rank calls every function, in the same order. An error on one rank is sent to all ranks, and ends
//! them together.
//!
//! Contact, and surfaces embedded in the tetrahedra, are not supported.

pub mod checkpoint;
mod coarse;
pub mod command;
mod division;
pub mod error;
mod output;
pub mod part;
pub mod petsc;
pub mod portion;
pub mod run;
mod setting;
pub mod share;
mod simulation;
mod system;
pub mod team;
