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
//! # Files of test machines, spreadsheets and decks
//!
//! * Columns are separated by commas, semicolons, tabs or spaces; decimals have a point or a comma. Lines
//!   above the header are skipped; a row of units may stand below it.
//! * The words of a header name the quantity of a column, in letters of any case, with the words in any
//!   order:
//!
//! | quantity | words, of which one is enough | becomes |
//! |---|---|---|
//! | test | `mode`, `test`, `type`, `test type`, `loading` | |
//! | stretch | `stretch`, `λ`, `lambda`, `extension ratio` | the control |
//! | nominal strain ε | `strain`, `ε`, `eps`, `Dehnung`; `elongation` in % | λ = 1 + ε; γ = ε in simple shear; J = 1 + ε in a volumetric test |
//! | true strain ε | those with `true`, `log`, `ln`, `Hencky`, `wahre`; `LE11` | λ = exp ε |
//! | shear γ | `strain` with `shear`; `γ`, `gamma` | γ |
//! | volume ratio | `J`, `V/V0`, `volume ratio` | J |
//! | volume strain ε | `strain` with `volume` or `volumetric` | J = 1 + ε |
//! | nominal stress P | `stress`, `σ`, `sigma`, `P`, `Spannung`, with or without `nominal`, `engineering`, `tensile`, `shear` | P |
//! | true stress σ | those with `true`, `Cauchy`, `wahre`; `S11` | P = σ/λ as of an incompressible solid; P = σ in simple shear and volumetric tests |
//! | pressure p | `pressure` | P = −p in a volumetric test |
//!
//! * Units stand after the name, in brackets or after a space, comma, slash or `_`: [`StressUnit`] for
//!   stresses, `%`, `‰`, `µε` or `mm/mm` for strains; percent may also stand before the name or after each
//!   number. A strain with another unit is refused. Numbers under `compressive strain` and `compressive
//!   stress` are positive in compression.
//! * Of several kinds of stress or strain the first of this table is used; two columns of one kind are
//!   refused. Forces and elongations are refused without a stress or a strain, since they need the size of
//!   the specimen; columns such as `strain rate` and `maximum stress` are neither strains nor stresses.
//! * Two columns without a header are stretch and nominal stress.
//! * In input decks the blocks `*UNIAXIAL TEST DATA`, `*BIAXIAL …`, `*PLANAR …`, `*SIMPLE SHEAR …` have
//!   nominal stress and nominal strain, `*VOLUMETRIC TEST DATA` pressure and J.
//! * A first line `sep=;`, as spreadsheets write and read it, names the separator.
//! * [`ReadOptions`] has the test and the unit for a file that names none. [`Reading`] describes in a line
//!   what was used and what was left out: with a test in the options also a column `Test` whose cells name
//!   none.
//!
//! Ambiguous data are errors: stretches that are all above 8, or some above 20, without a unit (percent?),
//! stresses of another sign than their strain (strains under `stretch`? compression with positive numbers?),
//! a stress of an unnamed kind next to a true strain, numbers with commas and points.
//!
//! Stretches and volumes are from 10⁻⁶ to 10⁶, shears up to 10⁶, stresses 0 or from 10⁻¹⁰⁰ to 10¹⁰⁰ Pa in
//! size: far beyond measurements, and well inside of the range of squares and quotients.

mod encoding;
mod fault;
mod heading;
mod layout;
mod measured;
mod options;
mod plausible;
mod reader;
mod section;
mod table;
mod test;
mod unit;

pub use encoding::decoded;
pub use fault::{DataError, Fault};
pub(crate) use measured::short;
pub use measured::{Agreement, Measured, Measurements, PointError};
pub use options::ReadOptions;
pub use reader::Reading;
pub use test::Test;
pub use unit::{StressUnit, StressUnitError};

/// Vulcanised rubber with 8 % sulphur in uniaxial tension, equibiaxial tension and pure shear, as a file.
///
/// Treloar, *Stress-strain data for vulcanised rubber under various types of deformation*, Trans. Faraday
/// Soc. 40, 1944; digitised, as its comments say.
pub const TRELOAR_1944: &str = include_str!("../data/treloar1944.csv");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Mode;

    #[track_caller]
    fn check(text: &str, line: u64, words: &[&str]) {
        let error = Measurements::read(text).expect_err("nonsense");
        assert_eq!(error.line, line, "{error}");
        for word in words {
            assert!(error.to_string().contains(word), "`{word}` is not in: {error}");
        }
    }

    const HEADER: &str = "mode,stretch,nominal_stress_kPa\n";

    #[test]
    fn mistakes_are_named_with_their_line() {
        check("", 1, &["mode,stretch,nominal_stress_MPa"]);
        check("# nothing\n", 1, &["no table"]);
        check("# by hand\nmode,angle,nominal_stress_Pa\n", 2, &["`stretch`", "angle"]);
        check("mode,stretch,nominal_stress_stone\n", 1, &["nominal_stress_stone", "--unit"]);
        check("mode,stretch,stretch,nominal_stress_Pa\n", 1, &["both of stretch", "`stretch`"]);
        check(HEADER, 1, &["uniaxial,1.5,0.37"]);
        check(&format!("{HEADER}uniaxial,1,0\n"), 1, &["no point but rest"]);
        check(&format!("{HEADER}# twist\ntorsion,1,0\n"), 3, &["`torsion`", "`pure_shear`"]);
        check(&format!("{HEADER}uniaxial,1,0\n\nuniaxial,2\n"), 4, &["2 fields", "3"]);
        check(&format!("{HEADER}uniaxial,1.1,1e999\n"), 2, &["1e999", "`nominal_stress_kPa`"]);
        check(&format!("{HEADER}uniaxial,-1.1,1\n"), 2, &["-1.1", "positive"]);
    }

    #[test]
    fn numbers_beyond_all_bounds_are_named_with_their_line() {
        // 1e303 MPa is infinite in Pa, 1e-320 MPa a subnormal number.
        let megapascals = "mode,stretch,nominal_stress_MPa\nuniaxial,2,0.5\n";
        check(&format!("{megapascals}uniaxial,3,1e303\n"), 3, &["stress is inf Pa", "at most 1e100 Pa"]);
        check(&format!("{megapascals}uniaxial,3,-1e200\n"), 3, &["stress is -1e206 Pa", "right unit"]);
        check(&format!("{megapascals}uniaxial,3,1e-320\n"), 3, &["at least 1e-100 Pa"]);
        for (mode, control) in [("uniaxial", "1e-7"), ("volumetric", "1e7"), ("simple_shear", "-1e300")] {
            check(
                &format!("{megapascals}{mode},{control},1\n"),
                3,
                &[&format!("is {control};"), "at most 1e6"],
            );
        }
        let megapascals = megapascals.replace("stretch", "stretch [-]");
        let edge = format!("{megapascals}uniaxial,1e6,1e94\nsimple_shear,-1e6,0\nequibiaxial,1e-6,-1e-105\n");
        assert_eq!(Measurements::read(&edge).map(|read| read.points.len()), Ok(4));
    }

    /// The mark is not a part of the first header, nor of a comment before it.
    #[test]
    fn a_byte_order_mark_is_skipped() {
        let text = format!("# by hand\n{HEADER}uniaxial,2,1\n");
        assert_eq!(Measurements::read(&format!("\u{feff}{text}")), Measurements::read(&text));
        check(&format!("\u{feff}{text}uniaxial,x,1\n"), 4, &["`x`"]);
    }

    #[test]
    fn messages_quote_nothing_that_a_terminal_obeys() {
        let hostile = format!("\u{1b}[2J\u{202e}{}", "x".repeat(1_000_000));
        for text in [
            format!("{hostile}\n"),
            format!("mode,stretch,nominal_stress{hostile}\n"),
            format!("{HEADER}{hostile},1,2\n"),
            format!("{HEADER}uniaxial,{hostile},2\n"),
            format!("{HEADER}uniaxial,2,{hostile}\n"),
            format!("{HEADER}\"{hostile}\n"),
        ] {
            let error = Measurements::read(&text).expect_err("nonsense").to_string();
            assert!(error.chars().all(|c| !c.is_control() && c != '\u{202e}'), "{error:?}");
            assert!(error.len() < 600, "{error}");
        }
    }

    #[test]
    fn columns_may_come_in_any_order_with_more_beside_them() -> Result<(), DataError> {
        let text =
            "nominal_stress_kPa, sample, mode, stretch\n-3, A, Simple Shear, -0.5\n2, B, planar, 1.5\n";
        let read = Measurements::read(text)?;
        let first = Measured { mode: Mode::SimpleShear, control: -0.5, stress: -3e3 };
        assert_eq!(read.points[0], first);
        assert_eq!(read.modes().collect::<Vec<_>>(), [Mode::PureShear, Mode::SimpleShear]);
        Ok(())
    }
}
