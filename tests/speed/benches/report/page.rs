//! The page of the results.

use std::fmt::{self, Write};

use piola::Real;
use piola_speed::{RESOLUTION, beats};

use crate::charts::{Chart, best_settings, materials};
use crate::data::{GrowthRow, PointRow, Report, StepRow};
use crate::point::{HARD, ORDINARY, OURS, Work};

/// The page, with the charts by their files' names.
pub(crate) fn tell(report: &Report, charts: &[Chart]) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut text, report, charts);
    text
}

fn write(text: &mut String, report: &Report, charts: &[Chart]) -> fmt::Result {
    let commit = report.commit.as_deref().unwrap_or("unknown");
    writeln!(text, "# Speed against error\n")?;
    writeln!(
        text,
        "Made by `cargo speed-report` on {}, {}, one core unless said otherwise, at commit {commit}.\n",
        report.machine, report.back_end
    )?;
    if !report.rows.is_empty() {
        writeln!(text, "{POINT}")?;
        pictures(text, charts, &["point-", "families-"])?;
        for material in materials(&report.rows) {
            for precision in ["f64", "f32"] {
                methods(text, &report.rows, material, precision)?;
            }
        }
        fronts(text, &report.rows)?;
        paper(text, &report.rows)?;
    }
    if !report.steps.is_empty() {
        writeln!(text, "{STEPS}")?;
        pictures(text, charts, &["steps"])?;
        steps(text, &report.steps)?;
    }
    if !report.growth.is_empty() {
        writeln!(text, "{GROWTH}")?;
        growth(text, &report.growth)?;
    }
    Ok(())
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

fn pictures(text: &mut String, charts: &[Chart], prefixes: &[&str]) -> fmt::Result {
    for chart in charts.iter().filter(|chart| prefixes.iter().any(|prefix| chart.file.starts_with(prefix))) {
        writeln!(text, "![{}]({})\n", chart.caption, chart.file)?;
    }
    Ok(())
}

/// A row for each method: the setting that is best at hard cases.
fn methods(text: &mut String, rows: &[PointRow], material: &str, precision: &str) -> fmt::Result {
    writeln!(text, "### {material}, {precision}\n")?;
    writeln!(
        text,
        "| method | setting | ns | worst, ordinary | worst, hard | median, hard | ns with projection | worst, hard |"
    )?;
    writeln!(text, "|---|---|--:|--:|--:|--:|--:|--:|")?;
    let of = |work: Work, family: &str| {
        let (work, family) = (work.name(), family.to_owned());
        rows.iter().filter(move |row| {
            (row.material, row.precision, row.work) == (material, precision, work) && row.family == family
        })
    };
    let same = |a: &PointRow, b: &PointRow| (a.method, &a.setting) == (b.method, &b.setting);
    let hard: Vec<&PointRow> = of(Work::Tangent, HARD).collect();
    for best in best_settings(&hard) {
        let ordinary = of(Work::Tangent, ORDINARY).find(|row| same(row, best));
        let projected = of(Work::Projected, ORDINARY).find(|row| same(row, best));
        let projected_hard = of(Work::Projected, HARD).find(|row| same(row, best));
        let ns =
            |row: Option<&PointRow>| row.map_or_else(String::new, |row| format!("{:.1}", row.ns_per_element));
        let worst = |row: Option<&PointRow>| row.map_or_else(String::new, |row| error(row.worst_error));
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} |",
            best.method,
            best.setting,
            ns(ordinary),
            worst(ordinary),
            error(best.worst_error),
            error(best.median_error),
            ns(projected),
            worst(projected_hard)
        )?;
    }
    writeln!(text)
}

/// Cases in which no other method for any energy is both faster and more accurate, and cases in which one is.
fn fronts(text: &mut String, rows: &[PointRow]) -> fmt::Result {
    writeln!(text, "### Who is on the front\n")?;
    let ours: Vec<&PointRow> = rows.iter().filter(|row| row.method == OURS && row.family != HARD).collect();
    let on_front = ours.iter().filter(|row| row.is_on_front).count();
    writeln!(
        text,
        "Of {} contests (an energy, a precision, with or without projection, at ordinary F or at a hard family) piola is on the front of the \
         methods for any ψ(λ) in {on_front}, each of these with the setting that is best for that family, and times within {:.0} % and errors within a unit roundoff counting as equal. In \
         the others a method is faster and its error no larger, or its error smaller in the same time:\n",
        ours.len(),
        100.0 * RESOLUTION
    )?;
    writeln!(text, "| work | energy | precision | family | piola | error | faster | ns | error |")?;
    writeln!(text, "|---|---|---|---|--:|--:|---|--:|--:|")?;
    let together = rows.iter().filter(|row| row.method == OURS && row.family == HARD);
    let (on, all) = together.fold((0, 0), |(on, all), row| (on + usize::from(row.is_on_front), all + 1));
    let lost: Vec<&&PointRow> = ours.iter().filter(|row| !row.is_on_front).collect();
    for row in lost {
        let beats = |other: &&PointRow| {
            let same =
                (other.work, other.material, other.precision) == (row.work, row.material, row.precision);
            let pair = |row: &PointRow| (row.ns_per_element, row.worst_error);
            same && other.family == row.family
                && other.is_general
                && beats(pair(other), pair(row), unit(row.precision))
        };
        let rivals = rows.iter().filter(beats);
        let Some(rival) = rivals.min_by(|a, b| a.ns_per_element.total_cmp(&b.ns_per_element)) else {
            continue;
        };
        let setting = if rival.setting.is_empty() { String::new() } else { format!(" {}", rival.setting) };
        writeln!(
            text,
            "| {} | {} | {} | {} | {:.1} | {} | {}{setting} | {:.1} | {} |",
            row.work,
            row.material,
            row.precision,
            row.family.replace('_', " "),
            row.ns_per_element,
            error(row.worst_error),
            rival.method,
            rival.ns_per_element,
            error(rival.worst_error)
        )?;
    }
    writeln!(
        text,
        "\nWith one setting for all hard families together, piola is on the front in {on} of {all}.\n"
    )
}

fn unit(precision: &str) -> f64 {
    if precision == "f64" { f64::UNIT_ROUNDOFF } else { f32::UNIT_ROUNDOFF }
}

/// The comparison of [SZLSB11], rebuilt.
fn paper(text: &mut String, rows: &[PointRow]) -> fmt::Result {
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
        return Ok(());
    };
    writeln!(
        text,
        "### The paper's comparison\n\nSaint Venant–Kirchhoff, f64, ordinary F, the same decomposition: by stretches and gradients of the \
         decomposition [SZLSB11] {stretches:.0} ns a point, by invariants [TSIF05] {invariants:.0} ns, a ratio of {:.2} (the paper: 2.64 ms \
         and 3.33 ms for a mesh, 1.26). piola: {ours:.1} ns.\n",
        invariants / stretches
    )
}

fn steps(text: &mut String, rows: &[StepRow]) -> fmt::Result {
    writeln!(
        text,
        "| setting | h | ms per second | Newton iterations a step | linear iterations a step | error | error at the end |"
    )?;
    writeln!(text, "|---|--:|--:|--:|--:|--:|--:|")?;
    for row in rows {
        let per_step = |count: usize| count as f64 / row.steps as f64;
        writeln!(
            text,
            "| {} | 1/{:.0} | {:.0} | {:.2} | {:.1} | {} | {} |",
            row.setting,
            1.0 / row.h,
            row.milliseconds(),
            per_step(row.newton_iterations),
            per_step(row.linear_iterations),
            error(row.error),
            error(row.final_error)
        )?;
    }
    writeln!(text)
}

fn growth(text: &mut String, rows: &[GrowthRow]) -> fmt::Result {
    writeln!(
        text,
        "| what | threads | elements | s | growth | Newton iterations | linear iterations | MiB |"
    )?;
    writeln!(text, "|---|--:|--:|--:|--:|--:|--:|--:|")?;
    let mut before: Option<&GrowthRow> = None;
    for row in rows {
        let smaller = before.filter(|before| (before.way, before.threads) == (row.way, row.threads));
        let growth = smaller.map_or(String::new(), |before| {
            let ratio = row.elements as f64 / before.elements as f64;
            format!("n^{:.2}", (row.seconds / before.seconds).ln() / ratio.ln())
        });
        writeln!(
            text,
            "| {} | {} | {} | {:.4} | {growth} | {} | {} | {:.1} |",
            row.way,
            row.threads,
            row.elements,
            row.seconds,
            row.newton_iterations,
            row.linear_iterations,
            row.peak_bytes as f64 / f64::from(1 << 20)
        )?;
        before = Some(row);
    }
    writeln!(text)
}

fn error(error: f64) -> String {
    if error.is_finite() { format!("{error:.1e}") } else { "∞".to_owned() }
}
