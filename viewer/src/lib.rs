//! Viewer of a scene that is pulled with the mouse: requests of a page, the body in motion, and messages to
//! the page.
//!
//! From the body outwards: [`session`] is the body with the acts on it, the same bits for the same acts;
//! [`driver`] makes its steps when they are due and never waits for a page; [`conversation`] turns messages
//! of the [`protocol`] into orders for it, and its answers into messages. [`state`] is the file.
//!
//! The crate opens no socket and starts no thread. The program around it, a server on this machine or a page
//! without one, provides the time, and threads if it has any.

pub mod conversation;
pub mod driver;
pub mod protocol;
pub mod session;
mod show;
pub mod state;
mod typed;

pub use show::topology;
