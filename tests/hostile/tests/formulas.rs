//! Formulas of 64 kB and less: a material or a refusal, and neither takes long.
//!
//! Time is that of the processor if Linux reports it. Its unit is the time of plain terms: a test in seconds
//! fails where a core is shared; the unit is measured first, and again next to a time that seems too long.

use std::panic::catch_unwind;
use std::time::{Duration, Instant};

use piola_declare::Energy;

/// The longest text of an energy.
const LENGTH: usize = 1 << 16;

/// The longest time of a call, in this unit: 2 s where the longest sum of plain terms takes 0.32 s.
const LONGEST: f64 = 6.25;

/// The time of a sum of plain terms.
fn unit() -> Duration {
    let unit = time_of("plain terms", &sum(LENGTH, |_| "m*(I1b - 3)".to_owned()));
    assert!(unit < Duration::from_secs(5), "plain terms take {unit:?}");
    unit
}

/// A sum of as many terms as fit into a length, free of stress at rest.
fn sum(length: usize, term: impl Fn(usize) -> String) -> String {
    repeated(length, "m*(I1 - 3 - 2*ln(J))", |k| format!(" + {}", term(k)), "")
}

/// A beginning, as many parts as fit, and what closes each of them.
fn repeated(length: usize, before: &str, part: impl Fn(usize) -> String, closing: &str) -> String {
    let mut text = before.to_owned();
    for k in 0.. {
        let part = part(k);
        if text.len() + part.len() + (k + 1) * closing.len() > length {
            return text + &closing.repeat(k);
        }
        text += &part;
    }
    text
}

/// Formulas of about `length` bytes.
fn formulas(length: usize) -> Vec<(&'static str, String)> {
    vec![
        ("terms of one kind", sum(length, |_| "m*(I1b - 3)".to_owned())),
        ("ones", repeated(length, "m*(I1b - 3)*(1", |_| "+1".to_owned(), "") + ")"),
        ("a parameter in each term", sum(length, |k| format!("c{k}*(I1b - 3)^2"))),
        ("a parameter and a power", sum(length, |k| format!("c{k}*(I1b - 3)^{}", 1 + k % 9))),
        ("two parameters in each term", sum(length, |k| format!("c{k}*(exp(a{k}*(I1b - 3)) - 1)"))),
        (
            "Ogden, written out",
            sum(length, |k| format!("c{k}/a{k}*(l1^a{k} + l2^a{k} + l3^a{k} - 3 - a{k}*ln(J))")),
        ),
        ("fractions", sum(length, |k| format!("m*((I1b - 3)/(I1b + {}))^2", k + 2))),
        ("logarithms", sum(length, |k| format!("m*ln(1 + (I1b - 3)/{})^2", k + 2))),
        (
            "neurons",
            sum(length, |k| format!("softplus({}.5*(I1b - 3) - {k})*0 + m*tanh(0.{k}*(I1b - 3))^2", k % 7)),
        ),
        ("coefficients", sum(length, |k| format!("0.{}*m*(I1b - 3)^2*(J - 1)^2", k + 1))),
        ("factors", repeated(length, "m*(I1b - 3)", |k| format!("*(I1b + {k})"), "")),
        ("factors with parameters", repeated(length, "m*(I1b - 3)", |k| format!("*(I1b + c{k})"), "")),
        ("unknown names", repeated(length, "m*(I1b - 3)", |k| format!("*f{k}(J)"), "")),
        ("conditions", repeated(length, "m*(I1b - 3) where J > 0", |k| format!(", I1 < 3 + c{k}"), "")),
        (
            "conditions on parameters",
            repeated(length, "m*(I1b - 3) where m > 0", |k| format!(", m > {k}"), ""),
        ),
        ("parentheses", repeated(length, "m*", |_| "(".to_owned(), ")")),
        ("exponents", repeated(length, "m", |_| "^(1+J".to_owned(), ")")),
        ("signs", repeated(length, "m*(I1b - 3) ", |_| "-".to_owned(), "") + "m*(I1b - 3)^2"),
        ("functions", repeated(length, "m*", |_| "exp(".to_owned(), ")")),
        ("tensors", sum(length, |k| format!("m*(tr(C^{}) - 3)", 2 + k % 9))),
        ("lists", sum(length, |k| format!("sum(p, m{k}[p]*(I1b - 3)^2)"))),
        (
            "sums of sums",
            repeated(length, "sum(p, c[p])", |k| format!("*sum(p, c[p]*(I1b - 3)^{})", 1 + k % 9), ""),
        ),
        ("asymmetric terms", sum(length, |k| format!("m*l1^{}", 1 + k % 60))),
        ("stressed terms", sum(length, |k| format!("c{k}*I1"))),
        (
            "powers of sums",
            sum(length, |k| format!("m*(I1b - 3 + (J - 1)^2 + {k}*(I2b - 3)^2)^{}", 2 + k % 40)),
        ),
        ("roots", sum(length, |k| format!("m*(sqrt(I1b + {k}) - sqrt({}))^2", k + 3))),
        (
            "quotients of stretches",
            sum(length, |k| {
                format!(
                    "m*((l1/l2)^{0} + (l2/l1)^{0} + (l2/l3)^{0} + (l3/l2)^{0} + (l1/l3)^{0} + (l3/l1)^{0} - 6)",
                    k % 30 + 1
                )
            }),
        ),
        (
            "erf of stretches",
            sum(length, |k| format!("m*(erf({k}*(l1 - 1))^2 + erf({k}*(l2 - 1))^2 + erf({k}*(l3 - 1))^2)")),
        ),
        ("commas", ",".repeat(length)),
        ("names alone", repeated(length, "", |k| format!("a{k} "), "")),
        ("numbers", "1234567890".repeat(length / 10)),
        ("one name", "m".repeat(length)),
        ("quotes", "\"".repeat(length)),
        ("lines", "m*(I1b-3)+\n".repeat(length / 11) + "q"),
    ]
}

/// Time of the processor that this thread has used.
fn processor_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

/// Declarations in Rust of about `length` bytes.
fn declarations(length: usize) -> Vec<(&'static str, String)> {
    let declared = |body: String| {
        format!("#[material(domain(J > 0.0))] fn E([l1, l2, l3]: [f64; 3], m: f64) -> f64 {{ {body} }}")
    };
    let named = |value: fn(usize) -> String| {
        let names =
            repeated(length, "let a0 = I1b - 3.0;", |k| format!("let a{} = {};", k + 1, value(k)), "");
        let last = names.matches("let").count() - 1;
        declared(format!("{names} m * a{last} + m * a0"))
    };
    vec![
        ("names of products", named(|k| format!("a{k} * a{k}"))),
        ("names of functions", named(|k| format!("a{k}.tanh()"))),
        ("names of fractions", named(|k| format!("1.0 - 1.0 / (2.0 + a{k})"))),
        ("names of sums", named(|k| format!("a{k} * (I2b - 3.0) + a{}", k / 2))),
        ("ones", declared(repeated(length, "m * (I1b - 3.0) * (1.0", |_| "+1.0".to_owned(), "") + ")")),
        ("factors", declared(repeated(length, "m * (I1b - 3.0)", |_| "*J".to_owned(), ""))),
        ("unknown names", declared(repeated(length, "m * (I1b - 3.0)", |k| format!("+b{k}"), ""))),
    ]
}

/// Time of a call, which may not panic.
#[track_caller]
fn time_of(name: &str, text: &str) -> Duration {
    let (begun, before) = (Instant::now(), processor_time());
    let result = catch_unwind(|| Energy::from_text(text).map(drop).map_err(|mistakes| mistakes.to_string()));
    assert!(result.is_ok(), "{name} panics");
    match (before, processor_time()) {
        (Some(before), Some(after)) => after - before,
        _ => begun.elapsed(),
    }
}

/// Compares the time of a call with a unit, and if it is too long, a second time with a new unit.
#[track_caller]
fn check(name: &str, text: &str, unit: &mut Duration) {
    if time_of(name, text) > unit.mul_f64(LONGEST) {
        *unit = self::unit();
        let (time, longest) = (time_of(name, text), unit.mul_f64(LONGEST));
        assert!(time < longest, "{name} takes {time:?}, more than {longest:?}: {} bytes", text.len());
    }
}

/// The largest accepted energies of each kind, and larger ones, come to an end in time. The largest of all
/// are judged with `PIOLA_FULL`.
#[test]
fn no_formula_takes_long() {
    let is_full = std::env::var_os("PIOLA_FULL").is_some();
    let mut unit = unit();
    for length in [LENGTH, LENGTH / 8, LENGTH / 16].into_iter().skip(usize::from(!is_full)) {
        for (name, text) in formulas(length).into_iter().chain(declarations(length)) {
            check(name, &text, &mut unit);
        }
    }
}
