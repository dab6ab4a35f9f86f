//! piola for programs in Python: the native part of the package `piola`, whose users import it from there.
//!
//! Arrays of numpy in, arrays of numpy out; what is computed, `piola` and its sister crates compute. There is
//! no mathematics here, and no `unsafe`.
//!
//! | file | holds |
//! |---|---|
//! | `material` | materials, by name or declared |
//! | `description` | declarations in words |
//! | `evaluate` | energy, stress and tangent of many points |
//! | `quantity` | which of these, and of which materials |
//! | `columns` | points along trailing axes |
//! | `arrays` | arrays that are taken, and those that results go to |
//! | `shape` | shapes, and how they are broadcast |
//! | `laboratory` | curves, fits, stability, contract |
//! | `body` | bodies of tetrahedra |
//! | `simulation` | bodies in motion |
//! | `settings` | settings and reports as dictionaries |
//! | `errors` | errors of Rust as exceptions |
//! | `threads` | the threads that compute |

mod arrays;
mod body;
mod columns;
mod description;
mod errors;
mod evaluate;
mod laboratory;
mod material;
mod quantity;
mod settings;
mod shape;
mod simulation;
mod threads;

/// The native part of the package `piola`.
#[pyo3::pymodule]
mod _piola {
    #[pymodule_export]
    use crate::body::{Body, box_mesh, turn_tets};
    #[pymodule_export]
    use crate::description::{Description, Parameter, catalogue};
    #[pymodule_export]
    use crate::laboratory::{measurements, treloar};
    #[pymodule_export]
    use crate::material::{Material, declare, describe};
    #[pymodule_export]
    use crate::simulation::Simulation;
    #[pymodule_export]
    use crate::threads::{num_threads, set_num_threads};
}
