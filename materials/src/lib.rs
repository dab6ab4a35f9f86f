//! A catalogue of isotropic hyperelastic energies, each declared once with `#[piola::material]`.

mod fixed_corotated;
mod neo_hookean;
mod ogden;
mod rotated_linear;
mod st_venant_kirchhoff;
mod stable_neo_hookean;

pub use fixed_corotated::FixedCorotated;
pub use neo_hookean::NeoHookean;
pub use ogden::Ogden;
pub use rotated_linear::RotatedLinear;
pub use st_venant_kirchhoff::StVenantKirchhoff;
pub use stable_neo_hookean::StableNeoHookean;
