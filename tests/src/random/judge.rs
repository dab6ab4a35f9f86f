//! One random declaration at hard stretches: compiled, run and judged.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use piola::__private::interpreter::{ParameterValues, Programs, Value};
use piola::__private::pole_floor;
use piola::__private::random::Random;
use piola::interpreter::Interpreted;
use piola::material::PAIRS;
use piola::{Inversion, Material, Real};
use piola_codegen::algebra::expr::Id;
use piola_codegen::algebra::interpret::{self, evaluate};
use piola_codegen::model::Model;
use piola_codegen::read::parse;
use piola_declare::programs;

use super::generator::{Declaration, Domain};
use super::hard;
use super::oracle::{self, Expected, Number};

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

/// Counts of judged declarations and values.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Declarations generated.
    pub declarations: usize,
    /// Declarations that the compiler rejects.
    pub refused: usize,
    /// Values judged.
    pub judged: usize,
    /// Judged values that are infinite or NaN, as a status reports.
    pub flagged: usize,
    /// Flagged values that are finite, of formulas with no part near the ends of the range of `f64`.
    pub needless: usize,
    /// Values that lose digits, but not more than the formula as printed does.
    pub lost: usize,
    /// Quotients and derivatives that lose digits, but not more than Σ|terms| of the compiled expression.
    pub terms: usize,
    /// Wrong values of formulas with a part near the ends of the range of `f64`, or without an exact value.
    pub range: usize,
    /// Values that failed.
    pub failed: usize,
    /// Panics.
    pub panics: usize,
    /// Declarations with a failure or a panic, shrunk, each with its first one.
    pub failures: Vec<String>,
    /// Messages of rejections without their quotations, which show the mistakes that the generator does not
    /// reach.
    pub refusals: Vec<String>,
}

impl Tally {
    /// Adds what another one has found.
    pub fn add(&mut self, other: Self) {
        self.declarations += other.declarations;
        self.refused += other.refused;
        self.judged += other.judged;
        self.flagged += other.flagged;
        self.needless += other.needless;
        self.lost += other.lost;
        self.terms += other.terms;
        self.range += other.range;
        self.failed += other.failed;
        self.panics += other.panics;
        self.failures.extend(other.failures);
        self.refusals.extend(other.refusals);
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            declarations, refused, judged, flagged, needless, lost, terms, range, failed, panics, ..
        } = self;
        write!(f, "{declarations} declarations, {refused} refused, {panics} panics; {judged} values, ")?;
        write!(f, "{flagged} flagged ({needless} needlessly), {lost} lost as printed, {terms} by terms, ")?;
        write!(f, "{range} out of range, {failed} failed")
    }
}

/// Judges the declaration of a seed at this many stretches.
#[must_use]
pub fn judge(seed: u64, points: usize) -> Tally {
    let declaration = Declaration::random(seed);
    let mut tally = judge_declaration(&declaration, seed, points);
    if tally.failed + tally.panics > 0 {
        // A simplest declaration that still fails: no single part can be left out.
        let mut smallest = declaration;
        let mut found = tally.clone();
        let fails = |tally: &Tally| tally.failed + tally.panics > 0;
        while let Some((simpler, its)) = smallest
            .shrunk()
            .into_iter()
            .map(|simpler| (judge_declaration(&simpler, seed, points), simpler))
            .find_map(|(its, simpler)| fails(&its).then_some((simpler, its)))
        {
            (smallest, found) = (simpler, its);
        }
        let first = found.failures.first().cloned().unwrap_or_default();
        tally.failures = vec![format!("seed {seed}: {first}\n{}", smallest.source())];
    }
    tally
}

fn judge_declaration(declaration: &Declaration, seed: u64, points: usize) -> Tally {
    let mut tally = Tally { declarations: 1, ..Tally::default() };
    let outcome = catch_unwind(AssertUnwindSafe(|| compile_and_run(declaration, seed, points, &mut tally)));
    match outcome {
        Ok(Ok(())) => {}
        Ok(Err(refusal)) => {
            tally.refused = 1;
            tally.refusals.push(refusal);
        }
        Err(payload) => {
            let text = payload.downcast_ref::<String>().cloned();
            let text = text.or_else(|| payload.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            tally.panics = 1;
            tally.failures.push(format!("panic: {}", text.unwrap_or_default()));
        }
    }
    tally
}

/// # Errors
/// The message of a refusal.
fn compile_and_run(
    declaration: &Declaration,
    seed: u64,
    points: usize,
    tally: &mut Tally,
) -> Result<(), String> {
    let tokens = |text: &str| text.parse().map_err(|error| format!("not Rust: {error}"));
    let (arguments, item) = (tokens(&declaration.arguments())?, tokens(&declaration.item())?);
    let (read, mut model) =
        piola_codegen::analyse(arguments, item, None).map_err(|error| error.to_string())?;
    let programs = programs(&read, &mut model).ok_or("too many registers")?;
    let subject = Subject::new(&read, declaration, model, programs);
    let mut random = Random::new(!seed);
    let is_whole = declaration.domain == Domain::Whole;
    for stretches in hard::stretches(&mut random, points, is_whole) {
        judge_stretches(declaration, &subject, stretches, tally);
    }
    for strains in hard::strains(&mut random, points.div_ceil(4)) {
        let expected = oracle::at_strains(declaration, strains);
        let at = format!("strains {strains:?}");
        for (i, value) in subject.plain.gradient_at_strains(strains).into_iter().enumerate() {
            let name = || format!("ψ{} by strains", i + 1);
            let root = subject.model.at_strains[i];
            let terms = || subject.terms(root, strains.map(|strain| 1.0 + strain));
            let found = Found { name: &name, at: &at, value, range: 1.0, terms: &terms };
            tally.value(&found, &expected[i]);
        }
    }
    Ok(())
}

/// A compiled declaration with its parameters: its programs, which the interpreter executes with the bits of
/// generated code, and its expressions.
struct Subject {
    model: Model,
    /// Values and lengths of the parameters, and the threshold of extensions.
    point: interpret::Point,
    plain: Interpreted,
    extended: Interpreted,
}

impl Subject {
    fn new(read: &parse::Declaration, declaration: &Declaration, model: Model, programs: Programs) -> Self {
        let values: Vec<_> = declaration.parameters.iter().map(|one| one.values.clone()).collect();
        let mut lengths = vec![0; read.lengths.len()];
        for (parameter, list) in read.parameters.iter().zip(&values) {
            if let Some(length) = parameter.length() {
                lengths[length] = list.len();
            }
        }
        let numbers = ParameterValues::new(values.iter().cloned().map(Value::Numbers).collect());
        let programs = Arc::new(programs);
        let material = |inversion| Interpreted::new(programs.clone(), numbers.clone(), inversion);
        let point =
            interpret::Point { stretches: [1.0; 3], parameters: values.into(), lengths, epsilon: EPSILON };
        Self {
            model,
            point,
            plain: material(Inversion::Refuse),
            extended: material(Inversion::Extend { epsilon: EPSILON }),
        }
    }

    /// Σ|terms| of an expression, every subtraction replaced by an addition of magnitudes.
    fn terms(&self, root: Id, stretches: [f64; 3]) -> f64 {
        let point = interpret::Point { stretches, ..self.point.clone() };
        evaluate(&self.model.graph, root, &point).magnitude
    }
}

/// Judges all programs at stretches.
fn judge_stretches(declaration: &Declaration, subject: &Subject, stretches: [f64; 3], tally: &mut Tally) {
    let plain = Some(("", &subject.model.plain, &subject.plain));
    let extended = subject.model.extended.as_ref().map(|variant| (" extended", variant, &subject.extended));
    let point = oracle::at_stretches(declaration, stretches);
    let at = format!("{stretches:?}");
    for (word, variant, material) in plain.into_iter().chain(extended) {
        let mut value = |name: &str, value: f64, expected: &Expected, root: Id| {
            let name = || format!("{name}{word}");
            let terms = || subject.terms(root, stretches);
            tally.value(&Found { name: &name, at: &at, value, range: point.range, terms: &terms }, expected);
        };
        let (gradient, blocks) = (material.gradient(stretches), material.blocks(stretches));
        value("ψ", material.energy(stretches), &point.energy, variant.energy);
        for i in 0..3 {
            let (expected, root) = (&point.gradient[i], variant.gradient[i]);
            value(["ψ1", "ψ2", "ψ3"][i], gradient[i], expected, root);
            value(["ψ1 of blocks", "ψ2 of blocks", "ψ3 of blocks"][i], blocks.gradient[i], expected, root);
        }
        for k in 0..6 {
            let name = ["ψ11", "ψ22", "ψ33", "ψ12", "ψ13", "ψ23"][k];
            value(name, blocks.hessian[k], &point.hessian[k], variant.hessian[k]);
        }
        for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
            value(["D-12", "D-13", "D-23"][pair], blocks.flip[pair], &point.flip[pair], variant.flip[pair]);
            // At a pole the value is bounded, and the status reports it.
            if !(variant.has_pole && stretches[i] + stretches[j] < pole_floor(stretches)) {
                value(
                    ["D+12", "D+13", "D+23"][pair],
                    blocks.twist[pair],
                    &point.twist[pair],
                    variant.twist[pair],
                );
            }
        }
    }
}

/// A value to be judged, and its circumstances.
struct Found<'a> {
    name: &'a dyn Fn() -> String,
    at: &'a str,
    value: f64,
    range: f64,
    /// Σ|terms| of the compiled expression.
    terms: &'a dyn Fn() -> f64,
}

impl Tally {
    fn value(&mut self, found: &Found<'_>, expected: &Expected) {
        let Expected { value, scale, printed } = *expected;
        self.judged += 1;
        if !found.value.is_finite() {
            self.flagged += 1;
            self.needless += usize::from(value.is_finite() && found.range <= RANGE);
            return;
        }
        if !value.is_finite() {
            self.range += 1;
            return;
        }
        let distance = (Number::splat(found.value) - value).abs().to_f64();
        let units = |scale: f64| (distance - UNDERFLOW).max(0.0) / scale / f64::UNIT_ROUNDOFF;
        if distance <= UNDERFLOW || units(scale) <= C {
            return;
        }
        if found.range > RANGE {
            self.range += 1;
        } else if units(scale + printed) <= C {
            self.lost += 1;
        } else if units(scale + printed + (found.terms)()) <= C {
            self.terms += 1;
        } else {
            self.failed += 1;
            if self.failures.is_empty() {
                let (name, at, value) = ((found.name)(), found.at, found.value);
                let exact = expected.value.to_f64();
                let (flat, all) = (units(scale), units(scale + printed + (found.terms)()));
                self.failures.push(format!(
                    "{name} at {at} is {value:e}, not {exact:e}: {flat:.1e} u of its scale, {all:.1e} u with all terms"
                ));
            }
        }
    }
}
