//! The page of the results.

use piola::Real;
use piola_speed::{RESOLUTION, beats};

use crate::Report;
use crate::charts::{Chart, best_settings};
use crate::growth::GrowthRow;
use crate::markdown::table;
use crate::point::{ENERGIES, HARD, ORDINARY, OURS, PointRow};
use crate::steps::StepRow;

/// The page, with the charts by their files' names.
pub(crate) fn tell(report: &Report, charts: &[Chart]) -> String {
    let commit = report.commit.as_deref().unwrap_or("unknown");
    let mut text = format!(
        "# Speed against error\n\nMade by `cargo speed-report` on {}, {}, one core unless said otherwise, at commit {commit}.\n\n",
        report.machine, report.back_end
    );
    if !report.rows.is_empty() {
        text += POINT;
        text += &pictures(charts, &["point-", "families-"]);
        for (material, _) in ENERGIES {
            for precision in ["f64", "f32"] {
                text += &methods(&report.rows, material, precision);
            }
        }
        text += &fronts(&report.rows);
        text += &paper(&report.rows);
    }
    if !report.steps.is_empty() {
        text += STEPS;
        text += &pictures(charts, &["steps"]);
        text += &steps(&report.steps);
    }
    if !report.growth.is_empty() {
        text += GROWTH;
        text += &growth(&report.growth);
    }
    text
}

const POINT: &str = "\
## A point: P and dP/dF

All methods get the same F in the same run, in turns; the time is the least of the repeats, for a tile of 64 points. The error is
the worst ‖X − X*‖/(‖X*‖ + sens) of P and dP/dF beside reference values of 25 digits, sens being what a relative change of F by one
changes in X; ∞ where an entry is infinite or NaN, or the exact answer zero and the method's not. *Ordinary*: F = I + 0.3 X with entries of X uniform in [−1, 1), 32 of them. *Hard*: the families of `tests/reference/cases.json`.
Methods with a setting run with many; charts and tables show the one of least error, `report.json` has all. Lanes: `piola`, plain
quotients, the switch, [ITF04], Jacobi and the invariants without SVD compute 8 or 16 points side by side; the others a point at a time,
compiled for the same instructions where their libraries let them.

";

const STEPS: &str = "\
## A trajectory

A dinosaur of rubber is drawn by half its height and let go, without damping: wall time of the solver for a second of motion, one
thread, against the largest distance of a node from the reference, in body heights. The reference has steps of 1/960 s by SDIRK3;
the row `reference` is its distance from one with 1/1920 s. Newton's method to 3 % of a step's error, except for one iteration.

";

const GROWTH: &str = "\
## Growth

A cube of rubber under its own weight: a step of 1/100 s with one iteration of Newton's method, the least of four, and the
equilibrium, to a residual of 1e-6. Memory is all that is allocated, the mesh included.

";

fn pictures(charts: &[Chart], prefixes: &[&str]) -> String {
    let is_meant = |chart: &&Chart| prefixes.iter().any(|prefix| chart.file.starts_with(prefix));
    let picture = |chart: &Chart| format!("![{}]({})\n\n", chart.caption, chart.file);
    charts.iter().filter(is_meant).map(picture).collect()
}

/// A row for each method: the setting that is best at hard cases.
fn methods(rows: &[PointRow], material: &str, precision: &str) -> String {
    let numbers =
        ["ns", "worst, ordinary", "worst, hard", "median, hard", "ns with projection", "worst, hard"];
    let of = |work: &'static str, family: &'static str| {
        rows.iter().filter(move |row| {
            (row.material, row.precision, row.work) == (material, precision, work) && row.family == family
        })
    };
    let same = |a: &PointRow, b: &PointRow| (a.method, &a.setting) == (b.method, &b.setting);
    let hard: Vec<&PointRow> = of("tangent", HARD).collect();
    let rows = best_settings(&hard).into_iter().map(|best| {
        let find = |work, family| of(work, family).find(|row| same(row, best));
        let ns =
            |row: Option<&PointRow>| row.map_or_else(String::new, |row| format!("{:.1}", row.ns_per_element));
        let worst = |row: Option<&PointRow>| row.map_or_else(String::new, |row| error(row.worst_error));
        vec![
            best.method.to_owned(),
            best.setting.clone(),
            ns(find("tangent", ORDINARY)),
            worst(find("tangent", ORDINARY)),
            error(best.worst_error),
            error(best.median_error),
            ns(find("projected", ORDINARY)),
            worst(find("projected", HARD)),
        ]
    });
    format!("### {material}, {precision}\n\n{}\n", table(&["method", "setting"], &numbers, rows))
}

/// Cases in which no other method for any energy is both faster and more accurate, and cases in which one is.
fn fronts(rows: &[PointRow]) -> String {
    let (together, ours): (Vec<&PointRow>, Vec<&PointRow>) =
        rows.iter().filter(|row| row.method == OURS).partition(|row| row.family == HARD);
    let on_front = |rows: &[&PointRow]| rows.iter().filter(|row| row.is_on_front).count();
    let beaten = ours.iter().filter(|row| !row.is_on_front).filter_map(|lost| {
        let beats = |other: &&PointRow| {
            let same =
                (other.work, other.material, other.precision) == (lost.work, lost.material, lost.precision);
            let pair = |row: &PointRow| (row.ns_per_element, row.worst_error);
            same && other.family == lost.family
                && other.is_general
                && beats(pair(other), pair(lost), unit(lost.precision))
        };
        let rivals = rows.iter().filter(beats);
        let rival = rivals.min_by(|a, b| a.ns_per_element.total_cmp(&b.ns_per_element))?;
        Some(vec![
            lost.work.to_owned(),
            lost.material.to_owned(),
            lost.precision.to_owned(),
            lost.family.replace('_', " "),
            format!("{:.1}", lost.ns_per_element),
            error(lost.worst_error),
            format!("{} {}", rival.method, rival.setting).trim_end().to_owned(),
            format!("{:.1}", rival.ns_per_element),
            error(rival.worst_error),
        ])
    });
    let words = ["work", "energy", "precision", "family", "piola", "error", "faster"];
    format!(
        "### Who is on the front\n\nOf {} contests (an energy, a precision, with or without projection, at ordinary F or \
         at a hard family) piola is on the front of the methods for any ψ(λ) in {}, each of these with the setting \
         that is best for that family, and times within {:.0} % and errors within a unit roundoff counting as equal. \
         In the others a method is faster and its error no larger, or its error smaller in the same time:\n\n{}\n\
         With one setting for all hard families together, piola is on the front in {} of {}.\n\n",
        ours.len(),
        on_front(&ours),
        100.0 * RESOLUTION,
        table(&words, &["ns", "error"], beaten),
        on_front(&together),
        together.len()
    )
}

fn unit(precision: &str) -> f64 {
    if precision == "f64" { f64::UNIT_ROUNDOFF } else { f32::UNIT_ROUNDOFF }
}

/// The comparison of [SZLSB11], rebuilt.
fn paper(rows: &[PointRow]) -> String {
    let time = |method: &str| {
        let of_method = rows.iter().filter(|row| {
            (row.material, row.precision, row.work) == ("Saint Venant–Kirchhoff", "f64", "tangent")
                && row.family == ORDINARY
                && row.method == method
        });
        of_method.map(|row| row.ns_per_element).reduce(f64::min)
    };
    let (Some(stretches), Some(invariants), Some(ours)) = (time("[SZLSB11]"), time("[TSIF05]"), time(OURS))
    else {
        return String::new();
    };
    format!(
        "### The paper's comparison\n\nSaint Venant–Kirchhoff, f64, ordinary F, the same decomposition: by stretches and \
         gradients of the decomposition [SZLSB11] {stretches:.0} ns a point, by invariants [TSIF05] {invariants:.0} ns, \
         a ratio of {:.2} (the paper: 2.64 ms and 3.33 ms for a mesh, 1.26). piola: {ours:.1} ns.\n\n",
        invariants / stretches
    )
}

fn steps(rows: &[StepRow]) -> String {
    let numbers = [
        "h",
        "ms per second",
        "Newton iterations a step",
        "linear iterations a step",
        "error",
        "error at the end",
    ];
    let rows = rows.iter().map(|step| {
        let per_step = |count: usize| count as f64 / step.steps as f64;
        vec![
            step.setting.to_owned(),
            format!("1/{:.0}", 1.0 / step.h),
            format!("{:.0}", step.milliseconds()),
            format!("{:.2}", per_step(step.newton_iterations)),
            format!("{:.1}", per_step(step.linear_iterations)),
            error(step.error),
            error(step.final_error),
        ]
    });
    table(&["setting"], &numbers, rows) + "\n"
}

fn growth(rows: &[GrowthRow]) -> String {
    let numbers = ["threads", "elements", "s", "growth", "Newton iterations", "linear iterations", "MiB"];
    let rows = rows.iter().enumerate().map(|(index, now)| {
        let before = index.checked_sub(1).map(|before| &rows[before]);
        let smaller = before.filter(|before| (before.way, before.threads) == (now.way, now.threads));
        let growth = smaller.map_or(String::new(), |before| {
            let ratio = now.elements as f64 / before.elements as f64;
            format!("n^{:.2}", (now.seconds / before.seconds).ln() / ratio.ln())
        });
        vec![
            now.way.to_owned(),
            now.threads.to_string(),
            now.elements.to_string(),
            format!("{:.4}", now.seconds),
            growth,
            now.newton_iterations.to_string(),
            now.linear_iterations.to_string(),
            format!("{:.1}", now.peak_bytes as f64 / f64::from(1 << 20)),
        ]
    });
    table(&["what"], &numbers, rows) + "\n"
}

fn error(error: f64) -> String {
    if error.is_finite() { format!("{error:.1e}") } else { "∞".to_owned() }
}
