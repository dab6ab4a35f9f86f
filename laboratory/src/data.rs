//! Measured test curves, and the agreement of an energy with them.
//!
//! A self-contained file is a table with a header; lines that begin with `#`, `//` or `**` are comments:
//!
//! ```text
//! mode,stretch,nominal_stress_MPa
//! uniaxial,1.125,0.134351
//! ```
//!
//! The modes are those of [`Mode`](crate::curve::Mode); the column `stretch` has the control, which is γ for
//! `simple_shear` and J for `volumetric`. The stress of each mode is that of
//! [`crate::curve`](mod@crate::curve). Columns may come in any order, among others.
//!
//! # Files of test machines and spreadsheets
//!
//! * Columns are separated by tabs, semicolons, commas or spaces: the first of these in the last line.
//!   Decimals have a point, or in the whole file a comma where another mark separates columns; thousands have
//!   no mark. If every comma could be one of thousands, as in `1,234`, the file is refused. Lines above the
//!   header are skipped; a row of units may stand below it.
//! * A header in plain form is one of these names, in letters of any case:
//!
//! | quantity | header | becomes |
//! |---|---|---|
//! | test | `mode` | |
//! | stretch | `stretch`, `stretch ratio`, `λ`, `lambda` | the control |
//! | nominal strain ε | `strain`, `nominal`, `engineering` or `tensile strain` | λ = 1 + ε; γ = ε in simple shear; J = 1 + ε in a volumetric test |
//! | true strain ε | `true`, `log` or `logarithmic strain` | λ = exp ε |
//! | shear γ | `shear strain`, `shear`, `γ`, `gamma` | γ |
//! | volume ratio | `volume ratio`, `J`, `V/V0` | J |
//! | volume strain ε | `volume` or `volumetric strain` | J = 1 + ε |
//! | nominal stress P | `stress`, `nominal`, `engineering`, `tensile` or `shear stress` | P |
//! | true stress σ | `true` or `Cauchy stress` | P = σ/λ as of an incompressible solid; P = σ in simple shear and volumetric tests |
//! | pressure p | `pressure` | P = −p in a volumetric test |
//!
//! * Units stand after the name, in brackets or behind a space, comma, slash or `_`: [`StressUnit`] for
//!   stresses, `%`, `‰`, `µε` or `mm/mm` for strains. With a unit in the row below, brackets after the name
//!   may hold something else, but no other kind, as in `Stress (true)`. Numbers under `compressive strain`
//!   and `compressive stress` are positive in compression.
//! * A file with another header, without a header, or with several stresses or strains is refused with the
//!   list of its columns. [`ReadOptions`] names the columns of the strain and the stress by their headers or
//!   numbers and, where these do not say it, what they hold.
//! * [`ReadOptions`] also has the test and the unit for a file that names none. [`Reading`] describes in a
//!   line what was used and what was left out, such as a header that returns above another specimen.
//! * [`Measurements::check_curves`] refuses points of several cycles, specimens or materials, before a fit;
//!   [`Measurements::cycle`] chooses one.
//!
//! What may mean two things is an error, with the line and what to write: stretches that are all above 8, or
//! some above 20, without a unit (percent?), stresses of another sign than their strain (strains under
//! `stretch`? compression with positive numbers?), a `stress` of an unnamed kind next to a true strain.
//!
//! Stretches and volumes are from 10⁻⁶ to 10⁶, shears up to 10⁶, stresses 0 or from 10⁻¹⁰⁰ to 10¹⁰⁰ Pa in
//! size: far beyond measurements, and well inside of the range of squares and quotients.

mod heading;
mod measured;
mod options;
mod reader;
mod table;
mod unit;

pub(crate) use measured::short;
pub use measured::{Agreement, Measured, Measurements, PointError};
pub use options::{DataError, NO_TEST, ReadOptions};
pub use reader::Reading;
pub use unit::StressUnit;

/// Vulcanised rubber with 8 % sulphur in uniaxial tension, equibiaxial tension and pure shear, as a file.
///
/// Treloar, *Stress-strain data for vulcanised rubber under various types of deformation*, Trans. Faraday
/// Soc. 40, 1944; digitised, as its comments say.
pub const TRELOAR_1944: &str = include_str!("../data/treloar1944.csv");
