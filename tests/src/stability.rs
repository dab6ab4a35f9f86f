//! The table of errors over the reference cases, ours and those of the [`baselines`](crate::baselines), as
//! Markdown.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use std::collections::BTreeMap;
use std::fmt::{self, Write as _};
use std::path::Path;

use piola::Inversion;
use piola::material::Response;
use piola::point::{Filter, Matrix3, Tangent, project};
use piola::point::{Svd, decompose};

use crate::baselines::svd_gradients::{self, Regularization};
use crate::baselines::{eigen, quotients};
use crate::cases::{Case, Quantity};
use crate::compiled;
use crate::energies::{self, Format as Judged, Subject};

/// The bound that every result of ours keeps, in units of u (‖X‖ + sens).
pub const BOUND: f64 = 30.0;

/// Gap, relative to the stretches, below which the quotients switch to their limits.
const SWITCH: f64 = 1e-6;

/// A column of the table: a method's error in a quantity.
type Column = (Method, Quantity);

const COLUMNS: [Column; 9] = [
    (Method::Ours, Quantity::Stress),
    (Method::Ours, Quantity::Tangent),
    (Method::Ours, Quantity::Projected),
    (Method::Naive, Quantity::Tangent),
    (Method::Naive, Quantity::Projected),
    (Method::Lhopital, Quantity::Tangent),
    (Method::Lhopital, Quantity::Projected),
    (Method::SvdGradients, Quantity::Tangent),
    (Method::SvdGradients, Quantity::Projected),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Method {
    Ours,
    Naive,
    Lhopital,
    SvdGradients,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Format {
    F64,
    F32,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
        })
    }
}

/// The errors of all columns at one case; `None` where the exact result leaves the format.
type Row = [Option<f64>; COLUMNS.len()];

/// The document that `STABILITY.md` is: all methods at the reference cases, those of ordinary F excepted.
///
/// # Errors
/// Where the cases cannot be read, or one does not fit its material; says which and why.
pub fn document() -> Result<String, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
    let mut cases = Case::read(&folder.join("cases.json"))?;
    cases.extend(Case::read(&folder.join("cases-more.json"))?);
    report(&cases)
}

fn report(cases: &[Case]) -> Result<String, String> {
    let mut rows: BTreeMap<(&str, Format), BTreeMap<&str, Vec<Row>>> = BTreeMap::new();
    for case in cases {
        let Some(energy) = energies::find(&case.material) else {
            return Err(format!("{}: {} is not in the catalogue", case.id, case.material));
        };
        let values = case.values(energy.description())?;
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let subject = energy
            .subject(&values, Inversion::Refuse)
            .map_err(|error| format!("{}: {} {error}", case.id, case.material))?;
        for (format, row) in Measure(case).all(&subject) {
            rows.entry((energy.name, format)).or_default().entry(&case.tag).or_default().push(row);
        }
    }
    let mut text = String::from(INTRODUCTION);
    render(&rows, &mut text).map_err(|error| error.to_string())?;
    Ok(text)
}

const INTRODUCTION: &str = "\
# Stability

Made by `cargo run -p piola-tests --example stability`; `cargo test -p piola-tests --test stability` computes it anew.

Errors ‖X − X*‖ of P, of K = dP/dF and of S, its projection to semidefinite matrices, against reference values of 25 digits
(`tests/reference`), in units of u (‖X*‖ + sens): u = 2⁻⁵³ in f64 and 2⁻²⁴ in f32, norms are Frobenius norms, and sens is what
a relative change of F by one changes in X. A backward-stable method stays below a few tens, however hard the case; 10⁶ means
that six digits are lost beyond what the data forgive. Up to 30 errors are rounded up to whole numbers, above to powers of
ten; ∞ is a result with an infinity or NaN.

All methods get the same F, the same singular value decomposition and the same ψi and ψij:

* **piola**: `piola::point::evaluate`;
* **naive**: quotients (ψi ∓ ψj)/(λi ∓ λj) as they stand;
* **switch**: the same, but the limits ψii ∓ ψij where |λi ∓ λj| < 10⁻⁶ max(|λi|, |λj|);
* **paper**: [SZLSB11] with its misprints mended: derivatives of U, λ and V from 2×2 systems, regularised by (AᵀA + 10⁻¹² I)
  where |λi² − λj²| < 10⁻⁶; its S is that of an eigensolver for 9×9 matrices, on the symmetric part.

Materials run with `Inversion::Refuse`. f32 is judged where F is exact in it, and what leaves the range of a format is left
out. Of the machine, two things matter: fused multiplications and additions (this table was made without, on baseline
x86-64; `-C target-cpu=native` and AArch64 have them) and the platform's ln, exp and pow. They move errors by a unit or two.

[SZLSB11] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*, 2011.
";

fn render(rows: &BTreeMap<(&str, Format), BTreeMap<&str, Vec<Row>>>, text: &mut String) -> fmt::Result {
    for format in [Format::F64, Format::F32] {
        writeln!(text, "\n## Summary, {format}\n")?;
        writeln!(
            text,
            "Worst error of all families and, for K and S, how many results are within {BOUND}.\n"
        )?;
        header(text, "material")?;
        let mut all = Vec::new();
        for ((material, _), families) in rows.iter().filter(|(key, _)| key.1 == format) {
            let of_material: Vec<Row> = families.values().flatten().copied().collect();
            summary(text, material, &of_material)?;
            all.extend(of_material);
        }
        summary(text, "**all**", &all)?;
    }
    for ((material, format), families) in rows {
        writeln!(text, "\n## {material}, {format}\n")?;
        header(text, "family")?;
        for (family, rows) in families {
            write!(text, "| {family} | {} |", rows.len())?;
            for column in 0..COLUMNS.len() {
                write!(text, " {} |", Rounded(worst(rows, column)))?;
            }
            writeln!(text)?;
        }
    }
    Ok(())
}

fn header(text: &mut String, first: &str) -> fmt::Result {
    write!(text, "| {first} | cases |")?;
    for (method, quantity) in COLUMNS {
        let method = match method {
            Method::Ours => "piola",
            Method::Naive => "naive",
            Method::Lhopital => "switch",
            Method::SvdGradients => "paper",
        };
        let quantity = match quantity {
            Quantity::Energy => "ψ",
            Quantity::Stress => "P",
            Quantity::Tangent => "K",
            Quantity::Projected => "S",
        };
        write!(text, " {method} {quantity} |")?;
    }
    writeln!(text, "\n|---|--:|{}", "--:|".repeat(COLUMNS.len()))
}

fn summary(text: &mut String, name: &str, rows: &[Row]) -> fmt::Result {
    write!(text, "| {name} | {} |", rows.len())?;
    for column in 0..COLUMNS.len() {
        let judged = rows.iter().filter_map(|row| row[column]);
        let within = judged.clone().filter(|&error| error <= BOUND).count();
        write!(text, " {} ({within}/{}) |", Rounded(worst(rows, column)), judged.count())?;
    }
    writeln!(text)
}

/// `None` where no case could be judged.
fn worst(rows: &[Row], column: usize) -> Option<f64> {
    rows.iter().filter_map(|row| row[column]).reduce(f64::max)
}

struct Rounded(Option<f64>);

impl fmt::Display for Rounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            None => f.write_str("–"),
            Some(f64::INFINITY) => f.write_str("∞"),
            Some(error) if error <= BOUND => write!(f, "{}", error.ceil()),
            Some(error) => {
                write!(f, "10")?;
                let exponent = error.log10().ceil() as i32;
                exponent.to_string().chars().try_for_each(|digit| f.write_char(superscript(digit)))
            }
        }
    }
}

fn superscript(digit: char) -> char {
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    digit.to_digit(10).map_or(digit, |digit| SUPERSCRIPTS[digit as usize])
}

/// All methods at one case, in every format that can hold its deformation gradient.
struct Measure<'a>(&'a Case);

/// A projection of 9×9 matrices.
type Clamp<R> = fn(&[[R; 9]; 9]) -> Option<[[R; 9]; 9]>;

impl Measure<'_> {
    fn all(&self, subject: &Subject) -> Vec<(Format, Row)> {
        let mut rows = vec![(Format::F64, self.row::<f64>(subject, eigen::clamp))];
        if self.0.f32_exact {
            rows.push((Format::F32, self.row::<f32>(subject, eigen::clamp)));
        }
        rows
    }

    fn row<R: Judged>(&self, subject: &Subject, clamp: Clamp<R>) -> Row {
        let material = R::of(subject);
        let deformation: Matrix3<R> =
            std::array::from_fn(|i| std::array::from_fn(|j| R::splat(self.0.deformation[3 * i + j])));
        COLUMNS.map(|(method, quantity)| {
            let fits = |value: f64| R::splat(value).is_finite();
            if !self.0.reference(quantity).into_iter().all(fits) {
                return None;
            }
            let result = match quantity {
                Quantity::Energy => Some(vec![compiled::evaluate_energy(material, &deformation).energy]),
                Quantity::Stress => Some(
                    compiled::evaluate_stress(material, &deformation).stress.into_iter().flatten().collect(),
                ),
                Quantity::Tangent => Some(method.tangent(material, &deformation).concat()),
                Quantity::Projected => {
                    method.projected(material, &deformation, clamp).map(|matrix| matrix.concat())
                }
            };
            let result = result.map(|values| values.into_iter().map(R::widen).collect::<Vec<_>>());
            // No result is as bad as one that is not a number.
            let error = |values: Vec<f64>| self.0.error(quantity, &values, 0.0, R::UNIT_ROUNDOFF);
            Some(result.map_or(f64::INFINITY, error))
        })
    }
}

impl Method {
    /// dP/dF.
    fn tangent<R: Judged>(self, material: &dyn Response<R>, F: &Matrix3<R>) -> [[R; 9]; 9] {
        match self {
            Self::SvdGradients => by_svd_gradients(material, F),
            Self::Ours | Self::Naive | Self::Lhopital => self.blocks(material, F, Filter::None),
        }
    }

    /// dP/dF made semidefinite; `None` where the method fails.
    fn projected<R: Judged>(
        self,
        material: &dyn Response<R>,
        F: &Matrix3<R>,
        clamp: Clamp<R>,
    ) -> Option<[[R; 9]; 9]> {
        match self {
            Self::SvdGradients => clamp(&by_svd_gradients(material, F)),
            Self::Ours | Self::Naive | Self::Lhopital => Some(self.blocks(material, F, Filter::Clamp)),
        }
    }

    /// From flips and twists.
    fn blocks<R: Judged>(self, material: &dyn Response<R>, F: &Matrix3<R>, filter: Filter) -> [[R; 9]; 9] {
        let Svd { U, stretches, V } = decompose(material, F);
        let blocks = match self {
            Self::Naive => quotients::naive(material, stretches),
            Self::Lhopital => quotients::lhopital(material, stretches, SWITCH),
            Self::Ours | Self::SvdGradients => {
                return compiled::evaluate(material, F, filter).tangent.to_matrix();
            }
        };
        let (blocks, _) = project(&blocks, filter);
        Tangent { U, V, blocks }.to_matrix()
    }
}

/// dP/dF by \[SZLSB11\], regularised as it says.
fn by_svd_gradients<R: Judged>(material: &dyn Response<R>, F: &Matrix3<R>) -> [[R; 9]; 9] {
    svd_gradients::tangent(material, &decompose(material, F), Regularization::default())
}
