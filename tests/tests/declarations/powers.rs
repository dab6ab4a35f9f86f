//! Powers whose whole exponents are parameters, compared with the same energies with the exponents written
//! out.

use piola::material::{Blocks, Moduli};
use piola::{Inversion, Material};
use piola_codegen::algebra::expr::Id;
use piola_codegen::algebra::interpret::{Estimate, Point, evaluate};
use piola_codegen::model::Model;
use piola_declare::Energy;
use piola_tests::declarations::{Sample, Text, Values, find, slices, values};
use piola_tests::declared::understood;

/// Stretches apart, pairwise equal, at rest, nearly at rest, and flat.
const STRETCHES: [[f64; 3]; 7] = [
    [1.7, 1.2, 0.6],
    [1.3, 1.3, 0.8],
    [1.1, 0.9, 0.9],
    [1.0, 1.0, 1.0],
    [1.0 + 1e-7, 1.0, 1.0 - 2e-7],
    [1.5, 0.8, 1e-5],
    [2.0, 1e-6, 1e-6],
];

/// The declaration with the terms of its first line, `sum(|p| c[p] * …)`, written out.
fn written(text: &Text, exponents: &Values) -> String {
    let is_sum = |line: &&str| line.trim_start().starts_with("sum(|p| c[p] * ");
    let line = text.source.lines().find(is_sum).expect("a sum over all terms");
    let term = line.trim().strip_prefix("sum(|p| c[p] * ").and_then(|rest| rest.strip_suffix(')'));
    let term = term.expect("one term on a line of its own");
    let number = |list: &[f64], k: usize| list[k].to_string();
    let terms = (0..exponents[0].len()).map(|k| {
        let [i, j] = [0, 1].map(|n| number(&exponents[n], k));
        format!("c{k} * {}", term.replace("i[p]", &i).replace("j[p]", &j))
    });
    let coefficients: Vec<_> = (0..exponents[0].len()).map(|k| format!("c{k}: f64")).collect();
    text.source
        .replace(line, &terms.collect::<Vec<_>>().join(" + "))
        .replace("c: Vec<f64>, i: Vec<u32>, j: Vec<u32>", &coefficients.join(", "))
}

/// Values of a declaration that is written out.
fn values_of_written(values: &Values) -> Values {
    values[0].iter().chain(&values[3]).map(|&value| vec![value]).collect()
}

/// All that is emitted of an energy inside its domain, and continued.
fn results(model: &Model) -> Vec<Id> {
    let mut all = vec![model.plain.energy];
    all.extend(model.plain.blocks());
    all.extend(model.at_strains);
    all.extend(model.moduli);
    all.extend(
        model.extended.iter().flat_map(|extended| [vec![extended.energy], extended.blocks()].concat()),
    );
    all
}

/// Compares a series with its terms written out, if a remark says its exponents.
pub(crate) fn judge(sample: &Sample, lists: &Model) {
    let Some(exponents) = sample.text.remarks("exponents").next().map(values) else { return };
    let (_, written) = understood(&written(&sample.text, &exponents)).expect("one declaration");
    assert_eq!(lists.plain.has_pole, written.plain.has_pole);
    assert_eq!(lists.invariants.is_some(), written.invariants.is_some());
    assert_eq!(results(lists).len(), results(&written).len());
    let values = sample.values().remove(0);
    for stretches in STRETCHES {
        let epsilon = 1e-3;
        let lengths = vec![exponents[0].len()];
        let with_terms =
            Point { stretches, parameters: values_of_written(&values).into(), lengths: vec![], epsilon };
        let with_lists = Point { stretches, parameters: values.clone().into(), lengths, epsilon };
        let pairs = results(lists).into_iter().zip(results(&written));
        for (n, (found, expected)) in pairs.enumerate() {
            let found = evaluate(&lists.graph, found, &with_lists);
            let Estimate { value, magnitude } = evaluate(&written.graph, expected, &with_terms);
            // Both are evaluated in a few dozen operations.
            let tolerance = 64.0 * f64::EPSILON * (magnitude + found.magnitude);
            let error = (found.value - value).abs();
            assert!(error <= tolerance, "result {n} at {stretches:?}: {} for {value}", found.value);
        }
    }
}

/// Stretches near rest at strains of 10⁻¹ … 10⁻¹⁴, equal ones, and flat ones.
fn stretches() -> Vec<[f64; 3]> {
    let near = (1..=14).flat_map(|digits| {
        let strain = 10f64.powi(-digits);
        let of = |direction: [f64; 3]| direction.map(|part| 1.0 + strain * part);
        [of([1.0, 0.3, -0.7]), of([1.0, 1.0, -2.0]), of([0.5, -0.25, -0.25])]
    });
    let far = [
        [1.0; 3],
        [1.2; 3],
        [1.7, 1.7, 0.4],
        [1.5, 0.8, 0.8],
        [2.0, 0.9, 0.5],
        [1.3, 1.1, 1e-2],
        [1.1, 2e-2, 1e-2],
    ];
    near.chain(far).collect()
}

/// Compares to a few u of the largest of the numbers that are compared together, whose terms are of its size.
#[track_caller]
fn check(found: &[f64], expected: &[f64], scale: f64, what: &str) {
    let largest = expected.iter().fold(scale, |largest, value| largest.max(value.abs()));
    assert_eq!(found.len(), expected.len(), "{what}");
    for (found, expected) in found.iter().zip(expected) {
        // Nine terms of a dozen operations each, summed up in two orders.
        let tolerance = 32.0 * f64::EPSILON * largest;
        assert!((found - expected).abs() <= tolerance, "{what}: {found:e} for {expected:e}");
    }
}

pub(crate) fn a_series_has_the_digits_of_its_terms() {
    let sample = find("powers", "Rivlin");
    let values = sample.values().remove(0);
    let text = written(&sample.text, &vec![values[1].clone(), values[2].clone()]);
    let (lists, written) = (&sample.judged.energy, Energy::from_rust(&text).expect("the same energy"));
    let series = lists.material(&slices(&values), Inversion::Refuse).expect("admissible");
    let terms = values_of_written(&values);
    let terms = written.material(&slices(&terms), Inversion::Refuse).expect("admissible");
    // I1b − 3 is known to u.
    let scale = 3.0 * values[0][0];
    for stretches in stretches() {
        let what = format!("{stretches:?}");
        check(&[series.energy(stretches)], &[terms.energy(stretches)], scale, &what);
        check(&series.gradient(stretches), &terms.gradient(stretches), scale, &what);
        let all = |Blocks { gradient, hessian, flip, twist }: Blocks<f64>| {
            [&gradient[..], &hessian, &flip, &twist].concat()
        };
        let [a, b] = [all(series.blocks(stretches)), all(terms.blocks(stretches))];
        check(&a[..3], &b[..3], scale, &what);
        check(&a[3..], &b[3..], scale, &what);
        let found = lists.gradient_by_parameters(&series, stretches);
        let (coefficients, others) = found.split_at(9);
        let (exponents, bulk) = others.split_at(18);
        assert!(exponents.iter().all(|derivative| *derivative == [0.0; 3]));
        let expected = written.gradient_by_parameters(&terms, stretches);
        assert_eq!(expected.len(), 10);
        for (found, expected) in coefficients.iter().chain(bulk).zip(&expected) {
            check(found, expected, 3.0, &what);
        }
    }
    // At strains nothing is of the order of 1: the stress is known to a few u of itself.
    for digits in 1..=14 {
        let strains = [1.0, 0.3, -0.7].map(|part| 10f64.powi(-digits) * part);
        let [a, b] = [series.gradient_at_strains(strains), terms.gradient_at_strains(strains)];
        check(&a, &b, 0.0, &format!("{strains:?}"));
    }
    let [a, b] = [Moduli::of(&series), Moduli::of(&terms)];
    check(&[a.mu, a.lambda], &[b.mu, b.lambda], 0.0, "moduli");
}

pub(crate) fn a_constant_term_counts_as_written() {
    let series = find("compiled", "Series");
    let values = [&[5.0, 1.0][..], &[0.0, 1.0], &[0.0, 0.0], &[2.0]];
    let constant = series.judged.energy.material(&values, Inversion::Refuse).expect("admissible");
    assert_eq!(constant.energy([1.0; 3]), 5.0);
    assert_eq!(constant.gradient([1.0; 3]), [0.0; 3]);
}

/// ψ1 = n sⁿ⁻¹ tᵐ + m sⁿ tᵐ⁻¹ 2 (1 + s) with t = 2 s + s², to a few u of each term.
pub(crate) fn small_ones_keep_their_digits() {
    let products = find("compiled", "Products");
    for (n, m) in [(2, 0), (3, 0), (0, 2), (0, 4), (2, 1), (1, 2), (3, 3)] {
        let values = [&[1.0][..], &[f64::from(n)], &[f64::from(m)]];
        let products = products.judged.energy.material(&values, Inversion::Refuse).expect("admissible");
        for digits in 1..=14 {
            let s = 10f64.powi(-digits);
            let of = |x: f64, n: i32| (x.powi(n), f64::from(n) * x.powi(n - 1));
            let (of_s, of_t) = (of(s, n), of(s * (2.0 + s), m));
            let expected = of_s.1 * of_t.0 + of_s.0 * of_t.1 * 2.0 * (1.0 + s);
            let [found, ..] = products.gradient_at_strains([s, 0.0, 0.0]);
            check(&[found], &[expected], 0.0, &format!("s^{n} t^{m} at {s}"));
        }
    }
}
