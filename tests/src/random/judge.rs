//! One random declaration at hard stretches: compiled, run and judged.

use std::collections::BTreeMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use piola::__private::interpreter::Value;
use piola::__private::pole_floor;
use piola::__private::random::Random;
use piola::interpreter::Interpreted;
use piola::material::PAIRS;
use piola::{Inversion, Material, Real};
use piola_codegen::algebra::expr::Id;
use piola_declare::{Energy, programs};

use super::generator::Declaration;
use super::hard;
use super::oracle::{self, Expected};
use super::quantity::Number;
use crate::declarations::slices;
use crate::declared::{Declared, understood};

/// The constant of |X − X*| ≤ C u scale, as for the reference cases. Where that fails, what the formula as
/// printed loses enters the scale, and then Σ|terms| of the compiled expression: both are counted.
const C: f64 = 30.0;

/// The threshold of extensions, below the stretches at which those are judged.
const EPSILON: f64 = 1e-14;

/// Far below what any modulus leaves of a stress that matters: what is less may have underflowed on the way.
const UNDERFLOW: f64 = 1e-280;

/// Bound on a part of the formula. If a part is larger than this, or smaller than its reciprocal, the powers
/// of it in second derivatives may leave the range of `f64`, and a reciprocal of what has overflowed is zero.
const RANGE: f64 = 1e75;

/// Stretches at which each declaration is judged; a quarter as many strains.
const POINTS: usize = 24;

/// What becomes of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Right up to rounding.
    Right,
    /// Infinite or NaN, as a status reports.
    Flagged,
    /// The same, though the exact value is finite and no part of the formula is near the ends of the range of
    /// `f64`.
    FlaggedNeedlessly,
    /// Digits are lost, but not more than by the formula as printed.
    Lost,
    /// Digits are lost, but not more than by Σ|terms| of the compiled expression.
    LostByTerms,
    /// Wrong, of a formula with a part near the ends of the range of `f64`, or without an exact value.
    OutOfRange,
    /// Wrong.
    Failed,
}

/// What has been judged.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Declarations generated.
    pub declarations: usize,
    /// Messages of rejections, which show the mistakes that the generator does not reach.
    pub refusals: Vec<String>,
    /// Number of values with each verdict.
    pub values: BTreeMap<Verdict, usize>,
    /// Declarations with a failure or a panic, each with its first one.
    pub failures: Vec<String>,
}

impl Tally {
    /// Number of values with any of these verdicts.
    pub fn count(&self, verdicts: &[Verdict]) -> usize {
        verdicts.iter().filter_map(|verdict| self.values.get(verdict)).sum()
    }

    /// Adds what another one has found.
    pub fn add(&mut self, other: Self) {
        self.declarations += other.declarations;
        self.refusals.extend(other.refusals);
        self.failures.extend(other.failures);
        for (verdict, count) in other.values {
            *self.values.entry(verdict).or_default() += count;
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { declarations, refusals, values, failures } = self;
        write!(f, "{declarations} declarations, {} refused, {} failed; ", refusals.len(), failures.len())?;
        write!(f, "{} values: {values:?}", values.values().sum::<usize>())
    }
}

/// Judges the declaration of a seed.
pub fn judge(seed: u64) -> Tally {
    let declaration = Declaration::random(seed);
    let mut tally = Tally { declarations: 1, ..Tally::default() };
    match catch_unwind(AssertUnwindSafe(|| compile_and_run(&declaration, seed, &mut tally))) {
        Ok(Ok(())) => {}
        Ok(Err(refusal)) => tally.refusals.push(refusal),
        Err(payload) => {
            let text = payload.downcast_ref::<String>().cloned();
            let text = text.or_else(|| payload.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            tally.failures = vec![format!("panic: {}", text.unwrap_or_default())];
        }
    }
    for failure in &mut tally.failures {
        *failure = format!("seed {seed}: {failure}\n{}", declaration.source());
    }
    tally
}

/// Returns the message of a refusal.
fn compile_and_run(declaration: &Declaration, seed: u64, tally: &mut Tally) -> Result<(), String> {
    let (read, mut model) = understood(&declaration.source())?;
    if declaration.is_fitted {
        Energy::from_rust(&declaration.source()).map_err(|mistakes| mistakes.to_string())?;
    }
    // The interpreter executes the programs with the bits of generated code.
    let programs = Arc::new(programs(&read, &mut model).ok_or("too many registers")?);
    let values: Vec<_> = declaration.parameters.iter().map(|one| one.values.clone()).collect();
    let numbers: Vec<_> = values.iter().cloned().map(Value::Numbers).collect();
    let extend = Inversion::Extend { epsilon: EPSILON };
    let declared = Declared::new(&read, model, &slices(&values), extend);
    let [plain, extended] = [Inversion::Refuse, extend]
        .map(|inversion| Interpreted::new(programs.clone(), numbers.clone(), inversion));
    let mut random = Random::new(!seed);
    for stretches in hard::stretches(&mut random, POINTS, !declaration.is_positive) {
        judge_stretches(declaration, &declared, [&plain, &extended], stretches, tally);
    }
    for strains in hard::strains(&mut random, POINTS / 4) {
        let (gradient, expected) =
            (plain.gradient_at_strains(strains), oracle::at_strains(declaration, strains));
        for i in 0..3 {
            let root = declared.model.at_strains[i];
            let terms = || declared.terms_of(root, strains.map(|strain| 1.0 + strain));
            let name = || format!("ψ{} by strains {strains:?}", i + 1);
            tally.value(name, gradient[i], &expected[i], 1.0, terms);
        }
    }
    Ok(())
}

/// A name, values, what they must be, and their expressions.
type Group<'a> = (&'a str, &'a [f64], &'a [Expected], &'a [Id]);

fn judge_stretches(
    declaration: &Declaration,
    declared: &Declared,
    [plain, extended]: [&Interpreted; 2],
    stretches: [f64; 3],
    tally: &mut Tally,
) {
    let model = &declared.model;
    let plain = Some(("", &model.plain, plain));
    let extended = model.extended.as_ref().map(|variant| ("extended ", variant, extended));
    let point = oracle::at_stretches(declaration, stretches);
    for (word, variant, material) in plain.into_iter().chain(extended) {
        let (energy, gradient, blocks) =
            (material.energy(stretches), material.gradient(stretches), material.blocks(stretches));
        let groups: [Group<'_>; 6] = [
            ("ψ", &[energy], &[point.energy], &[variant.energy]),
            ("ψi", &gradient, &point.gradient, &variant.gradient),
            ("ψi of blocks", &blocks.gradient, &point.gradient, &variant.gradient),
            ("ψij", &blocks.hessian, &point.hessian, &variant.hessian),
            ("D-", &blocks.flip, &point.flip, &variant.flip),
            ("D+", &blocks.twist, &point.twist, &variant.twist),
        ];
        for (name, found, expected, roots) in groups {
            for k in 0..found.len() {
                let (i, j) = PAIRS[k % 3];
                // At a pole the value is bounded, and the status reports it.
                let is_at_pole = variant.has_pole && stretches[i] + stretches[j] < pole_floor(stretches);
                if name == "D+" && is_at_pole {
                    continue;
                }
                let name = || format!("{word}{name}, entry {k}, at {stretches:?}");
                let terms = || declared.terms_of(roots[k], stretches);
                tally.value(name, found[k], &expected[k], point.range, terms);
            }
        }
    }
}

impl Tally {
    /// Judges a value of a formula whose parts have this range; `terms` is Σ|terms| of its expression.
    fn value(
        &mut self,
        name: impl Fn() -> String,
        found: f64,
        expected: &Expected,
        range: f64,
        terms: impl Fn() -> f64,
    ) {
        let Expected { value, scale, printed } = *expected;
        let distance = (Number::splat(found) - value).abs().to_f64();
        let units = |scale: f64| (distance - UNDERFLOW).max(0.0) / scale / f64::UNIT_ROUNDOFF;
        let verdict = if !found.is_finite() {
            let is_needless = value.is_finite() && range <= RANGE;
            if is_needless { Verdict::FlaggedNeedlessly } else { Verdict::Flagged }
        } else if !value.is_finite() {
            Verdict::OutOfRange
        } else if distance <= UNDERFLOW || units(scale) <= C {
            Verdict::Right
        } else if range > RANGE {
            Verdict::OutOfRange
        } else if units(scale + printed) <= C {
            Verdict::Lost
        } else if units(scale + printed + terms()) <= C {
            Verdict::LostByTerms
        } else {
            Verdict::Failed
        };
        *self.values.entry(verdict).or_default() += 1;
        if verdict == Verdict::Failed && self.failures.is_empty() {
            let (exact, flat, all) = (value.to_f64(), units(scale), units(scale + printed + terms()));
            self.failures.push(format!(
                "{} is {found:e}, not {exact:e}: {flat:.1e} u of its scale, {all:.1e} u with all terms",
                name()
            ));
        }
    }
}
