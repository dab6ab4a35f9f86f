//! A catalogue of isotropic hyperelastic energies, each declared once with
//! [`#[piola::material]`](macro@piola::material), one file each: citation, formula, domain, deviation from
//! the source.
//!
//! Each energy is a type with a checked constructor; all of them can also be chosen by name at run time, from
//! [`CATALOGUE`].
//!
//! ```
//! use piola::{Inversion, Material};
//! use piola_materials::NeoHookean;
//!
//! # fn main() -> Result<(), piola::material::MaterialError> {
//! let rubber = NeoHookean::new(1e6, 5e6)?.with_inversion(Inversion::Extend { epsilon: 0.1 })?;
//! assert_eq!(rubber.energy([1.0, 1.0, 1.0]), 0.0);
//! assert!(rubber.energy([1.1, 1.0, -0.2]) > 0.0); // inverted, and defined
//! # Ok(())
//! # }
//! ```
//!
//! # Energies
//!
//! [`CATALOGUE`] lists them with their names and features; the page of each type has its domain and its
//! extension beyond J > 0, if any. Each energy has a cargo feature. Eight are on by default, and the
//! feature `all` compiles all 55. A program that needs one compiles one:
//!
//! ```toml
//! piola-materials = { version = "0.1", default-features = false, features = ["neo-hookean"] }
//! ```
//!
//! The texts of all declarations are in [`DECLARATIONS`] regardless of features: the crate `piola-declare`
//! makes energies of them at run time, with the bits of compiled ones.
//!
//! Those that extend do so below a threshold stretch ε, with [`Inversion::Extend`](piola::Inversion::Extend);
//! some only for parameters with which the extension restores, as documented. A point of an extended material
//! returned from every inverted or collapsed state that was tried, if ε is small enough for its
//! incompressibility: if −ln J alone keeps the volume from vanishing, in `ciarlet_geymonat`,
//! `ciarlet_neo_hookean` and those with an isochoric part, an ε above about 2μ/κ leaves a second equilibrium,
//! a wide disc of hardly any thickness.
//!
//! # Typical parameters
//!
//! Each energy is declared with parameters of some real material and their source; [`Entry::description`] has
//! them for programs. Those *fitted to Treloar 1944* are least squares of the relative difference between the
//! nominal stresses of the incompressible solid and those that Treloar, *Stress-strain data for vulcanised
//! rubber under various types of deformation*, Trans. Faraday Soc. 40, 1944, measured in uniaxial tension,
//! equibiaxial tension and pure shear. With them goes a bulk modulus of 20 MPa, Poisson's ratio 0.49, as is
//! common in simulation; rubber itself has about 2 GPa. The command `piola fit NAME --data treloar` prints
//! them with more digits; if some were held or stretches left out, the source notes it.
//!
//! The crate holds no derivative and no algorithm: those come from the macro and from `piola`.

mod catalogue;
mod matching;

pub use catalogue::{Declaration, Entry, Visitor, find};
pub use matching::matching;

use catalogue::catalogue;

catalogue! {
    "anssari-benam-bucchi" anssari_benam_bucchi::AnssariBenamBucchi for rubber,
    "arap" arap::Arap,
    "arruda-boyce" arruda_boyce::ArrudaBoyce for rubber,
    "attard-hunt" attard_hunt::AttardHunt for rubber,
    "bazant" bazant::Bazant,
    "blatz-ko" blatz_ko::BlatzKo,
    "carroll" carroll::Carroll for rubber,
    "ciarlet-geymonat" ciarlet_geymonat::CiarletGeymonat for rubber,
    "ciarlet-neo-hookean" ciarlet_neo_hookean::CiarletNeoHookean for rubber,
    "davidson-goulbourne" davidson_goulbourne::DavidsonGoulbourne for rubber,
    "dobrynin-carrillo" dobrynin_carrillo::DobryninCarrillo for rubber,
    "edwards-vilgis" edwards_vilgis::EdwardsVilgis for rubber,
    "exponentiated-hencky" exponentiated_hencky::ExponentiatedHencky for rubber,
    "extended-tube" extended_tube::ExtendedTube for rubber,
    "fixed-corotated" fixed_corotated::FixedCorotated,
    "flory-erman" flory_erman::FloryErman for rubber,
    "fung" fung::Fung,
    "gent" gent::Gent for rubber,
    "gent-gent" gent_gent::GentGent for rubber,
    "gent-thomas" gent_thomas::GentThomas for rubber,
    "haines-wilson" haines_wilson::HainesWilson for rubber,
    "hartmann-neff" hartmann_neff::HartmannNeff for rubber,
    "hencky" hencky::Hencky,
    "horgan-saccomandi" horgan_saccomandi::HorganSaccomandi for rubber,
    "hoss-marczak" hoss_marczak::HossMarczak for rubber,
    "isihara" isihara::Isihara for rubber,
    "isochoric-neo-hookean" isochoric_neo_hookean::IsochoricNeoHookean for rubber,
    "isochoric-ogden" isochoric_ogden::IsochoricOgden<1, 2, 3> for rubber,
    "james-green-simpson" james_green_simpson::JamesGreenSimpson for rubber,
    "khajehsaeid" khajehsaeid::Khajehsaeid for rubber,
    "knowles" knowles::Knowles for rubber,
    "levinson-burgess" levinson_burgess::LevinsonBurgess for rubber,
    "lopez-pamies" lopez_pamies::LopezPamies<1, 2, 3> for rubber,
    "mansouri-darijani" mansouri_darijani::MansouriDarijani for rubber,
    "mips" mips::Mips,
    "mooney-rivlin" mooney_rivlin::MooneyRivlin for rubber,
    "mooney-rivlin-coupled" mooney_rivlin_coupled::MooneyRivlinCoupled for rubber,
    "murnaghan" murnaghan::Murnaghan,
    "neo-hookean" neo_hookean::NeoHookean for rubber,
    "ogden" ogden::Ogden<1, 2, 3> for rubber,
    "peng-landel" peng_landel::PengLandel for rubber,
    "rotated-linear" rotated_linear::RotatedLinear,
    "st-venant-kirchhoff" st_venant_kirchhoff::StVenantKirchhoff,
    "stable-neo-hookean" stable_neo_hookean::StableNeoHookean,
    "storakers" storakers::Storakers<1, 2, 3>,
    "stretch-spline" stretch_spline::StretchSpline,
    "swanson" swanson::Swanson<1, 2, 3> for rubber,
    "symmetric-arap" symmetric_arap::SymmetricArap,
    "symmetric-dirichlet" symmetric_dirichlet::SymmetricDirichlet,
    "three-chain" three_chain::ThreeChain for rubber,
    "valanis-landel" valanis_landel::ValanisLandel for rubber,
    "varga" varga::Varga for rubber,
    "veronda-westmann" veronda_westmann::VerondaWestmann,
    "yeoh" yeoh::Yeoh for rubber,
    "yeoh-fleming" yeoh_fleming::YeohFleming for rubber,
}
