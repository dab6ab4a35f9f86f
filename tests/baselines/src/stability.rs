//! The table of errors over the reference cases, ours and those of the [baselines](crate), as
//! Markdown.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use std::collections::BTreeMap;

use piola::material::Response;
use piola::point::{Filter, Matrix3, Tangent, decompose, project};
use piola::{Inversion, Real};
use piola_tests::cases::{Case, Quantity};
use piola_tests::compiled;
use piola_tests::energies::{self, Format, Subject};

use crate::quotients::{Change, Plain, Switch};
use crate::svd_gradients::{self, THRESHOLD};
use crate::{LibraryNumber, eigen};

/// The bound that every result of ours keeps, in units of u (‖X‖ + sens).
pub const BOUND: f64 = 30.0;

/// Gap, relative to the stretches, below which the quotients switch to their limits.
const SWITCH: f64 = 1e-6;

/// The columns of the table, each a method's error in a quantity, by their titles.
const COLUMNS: [(&str, Method, Quantity); 9] = [
    ("piola P", Method::Ours, Quantity::Stress),
    ("piola K", Method::Ours, Quantity::Tangent),
    ("piola S", Method::Ours, Quantity::Projected),
    ("naive K", Method::Naive, Quantity::Tangent),
    ("naive S", Method::Naive, Quantity::Projected),
    ("switch K", Method::Lhopital, Quantity::Tangent),
    ("switch S", Method::Lhopital, Quantity::Projected),
    ("paper K", Method::SvdGradients, Quantity::Tangent),
    ("paper S", Method::SvdGradients, Quantity::Projected),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Method {
    Ours,
    Naive,
    Lhopital,
    SvdGradients,
}

/// The errors of all columns at one case; `None` where the exact result leaves the format.
type Row = [Option<f64>; COLUMNS.len()];

/// Rows by energy, by format, `f64` before `f32`, and by family.
type Rows<'a> = BTreeMap<(&'a str, bool), BTreeMap<&'a str, Vec<Row>>>;

fn name_of_format(is_single: bool) -> &'static str {
    if is_single { "f32" } else { "f64" }
}

/// The document that `STABILITY.md` is: all methods at the reference cases, those of ordinary F excepted.
///
/// # Errors
/// Where the cases cannot be read, or one does not fit its material; says which and why.
pub fn document() -> Result<String, String> {
    let cases = Case::own(&["cases", "cases-more"])?;
    let mut rows = Rows::new();
    for case in &cases {
        let Some(energy) = energies::find(&case.material) else {
            return Err(format!("{}: {} is not in the catalogue", case.id, case.material));
        };
        let values = case.values(energy.description())?;
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let subject = energy
            .subject(&values, Inversion::Refuse)
            .map_err(|error| format!("{}: {} {error}", case.id, case.material))?;
        let mut add = |is_single, row| {
            rows.entry((energy.name, is_single)).or_default().entry(&case.tag).or_default().push(row);
        };
        add(false, row::<f64>(case, &subject));
        if case.f32_exact {
            add(true, row::<f32>(case, &subject));
        }
    }
    Ok(INTRODUCTION.to_owned() + &tables(&rows))
}

const INTRODUCTION: &str = include_str!("stability/introduction.md");

fn tables(rows: &Rows<'_>) -> String {
    let mut text = String::new();
    for is_single in [false, true] {
        text += &format!("\n## Summary, {}\n\n", name_of_format(is_single));
        text += &format!(
            "Worst error of all families and, for K and S, number of results within {BOUND}.\n\n{}",
            header("material")
        );
        let within = |rows: &[Row], column: usize| {
            let judged = rows.iter().filter_map(|row| row[column]);
            let within = judged.clone().filter(|&error| error <= BOUND).count();
            format!("{} ({within}/{})", worst(rows, column), judged.count())
        };
        let mut all = Vec::new();
        for ((material, _), families) in rows.iter().filter(|(key, _)| key.1 == is_single) {
            let of_material: Vec<Row> = families.values().flatten().copied().collect();
            text += &line(material, &of_material, within);
            all.extend(of_material);
        }
        text += &line("**all**", &all, within);
    }
    for (&(material, is_single), families) in rows {
        text += &format!("\n## {material}, {}\n\n{}", name_of_format(is_single), header("family"));
        text.extend(families.iter().map(|(family, rows)| line(family, rows, worst)));
    }
    text
}

fn header(first: &str) -> String {
    let titles = COLUMNS.map(|(title, ..)| title).join(" | ");
    format!("| {first} | cases | {titles} |\n|---|--:|{}\n", "--:|".repeat(COLUMNS.len()))
}

/// Name, number of cases, and a cell for each column.
fn line(name: &str, rows: &[Row], cell: impl Fn(&[Row], usize) -> String) -> String {
    let cells: Vec<String> = (0..COLUMNS.len()).map(|column| cell(rows, column)).collect();
    format!("| {name} | {} | {} |\n", rows.len(), cells.join(" | "))
}

/// The worst error: an integer up to the bound, beyond it a power of ten; – where no case could be judged.
fn worst(rows: &[Row], column: usize) -> String {
    match rows.iter().filter_map(|row| row[column]).reduce(f64::max) {
        None => "–".to_owned(),
        Some(f64::INFINITY) => "∞".to_owned(),
        Some(error) if error <= BOUND => error.ceil().to_string(),
        Some(error) => format!("1e{}", error.log10().ceil()),
    }
}

fn row<R: Format + LibraryNumber>(case: &Case, subject: &Subject) -> Row {
    let (material, F) = (<R as Format>::of(subject), case.F::<R>());
    COLUMNS.map(|(_, method, quantity)| {
        let fits = |value: f64| Real::is_finite(<R as Real>::splat(value));
        if !case.reference(quantity).into_iter().all(fits) {
            return None;
        }
        let result = match quantity {
            Quantity::Energy => Some(vec![compiled::evaluate_energy(material, &F).energy]),
            Quantity::Stress => Some(compiled::evaluate_stress(material, &F).stress.concat()),
            Quantity::Tangent => method.tangent(material, &F, Filter::None).map(|matrix| matrix.concat()),
            Quantity::Projected => method.tangent(material, &F, Filter::Clamp).map(|matrix| matrix.concat()),
        };
        let result = result.map(|values| values.into_iter().map(R::widen).collect::<Vec<_>>());
        // No result is as bad as one that is not a number.
        let error = |values: Vec<f64>| case.error(quantity, &values, 0.0, R::UNIT_ROUNDOFF);
        Some(result.map_or(f64::INFINITY, error))
    })
}

impl Method {
    /// dP/dF, filtered; `None` where the method fails.
    fn tangent<R: Format + LibraryNumber>(
        self,
        material: &dyn Response<R>,
        F: &Matrix3<R>,
        filter: Filter,
    ) -> Option<[[R; 9]; 9]> {
        let svd = decompose(material, F);
        let blocks = match self {
            Self::Ours => return Some(compiled::evaluate(material, F, filter).tangent.to_matrix()),
            Self::SvdGradients => {
                let tangent = svd_gradients::tangent(material, &svd, THRESHOLD * THRESHOLD);
                return if filter == Filter::None { Some(tangent) } else { eigen::clamp(&tangent) };
            }
            Self::Naive => Plain.blocks(svd.stretches, material.blocks(svd.stretches)),
            Self::Lhopital => {
                Switch { threshold: SWITCH }.blocks(svd.stretches, material.blocks(svd.stretches))
            }
        };
        let (blocks, _) = project(&blocks, filter);
        Some(Tangent { U: svd.U, V: svd.V, blocks }.to_matrix())
    }
}
