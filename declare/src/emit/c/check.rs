//! The check of the parameters in C: the conditions of the constructor.

use std::fmt::Write;

use piola::__private::record::Recording;
use piola::material::Form;

use super::body::Body;
use super::{Printer, safe};
use crate::condition::{Condition, Term};
use crate::emit::Precision;

impl Printer<'_> {
    /// A check of the parameters, by the conditions of the declaration.
    pub(super) fn check(&self) -> String {
        let Self { file, prefix, suffix, .. } = self;
        let description = file.energy.description();
        let mut places = self.parameters.iter();
        let mut all = Vec::new();
        // Each with what is said of it, statements before it, and the condition under which all is well.
        let mut cases: Vec<(String, String, String)> = Vec::new();
        for ((parameter, values), name) in description.parameters.iter().zip(file.values).zip(&self.fields) {
            let numbers: Vec<_> = places.by_ref().take(values.len()).cloned().collect();
            if !matches!(parameter.form, Form::Exponent | Form::Exponents) && !numbers.is_empty() {
                let finite: Vec<_> = numbers.iter().map(|place| format!("isfinite({place})")).collect();
                let meaning = format!("{name} is not finite");
                cases.push((meaning, String::new(), finite.join(" && ")));
            }
            all.push(numbers);
        }
        for condition in file.energy.conditions(file.inversion) {
            let entries = condition.list.map_or(1, |list| all[list].len());
            let holds: Vec<_> = (0..entries).map(|entry| self.condition(condition, &all, entry)).collect();
            if !holds.is_empty() {
                cases.push((format!("not {}", safe(&condition.text)), String::new(), holds.join(" && ")));
            }
        }
        let Recording { program, .. } = &file.rest;
        let body = Body::new(self, program, Vec::new());
        let mut results = program.results.iter().map(|&id| body.operand(id));
        let mut statements = body.statements();
        if let (false, Some(shear), Some(bulk)) = (file.is_prestressed, results.next(), results.next()) {
            // The constructor has the moduli by a formula, without the roundings of derivatives.
            let rounding = if file.precision == Precision::F32 { "1e-5f" } else { "1e-13" };
            let condition =
                format!("{shear} > 0.0{suffix} && {bulk} >= -{rounding} * {shear} && isfinite({bulk})");
            let meaning = "at rest, the solid does not resist shear or changes of volume".to_owned();
            cases.push((meaning, std::mem::take(&mut statements), condition));
        }
        if let Some(inside) = results.next().filter(|inside| inside != "1") {
            cases.push(("the rest state is outside of the domain".to_owned(), statements, inside));
        }
        let mut list =
            "/* Returns 0 if the parameters are admissible, else the first of these that is true:\n"
                .to_owned();
        let mut statements = String::new();
        for (k, (meaning, before, condition)) in cases.iter().enumerate() {
            let _ = writeln!(list, " * {}: {meaning}", k + 1);
            let _ = writeln!(statements, "{before}    if (!({condition})) return {}u;", k + 1);
        }
        if !statements.contains("p->") {
            statements = format!("    (void)p;\n{statements}");
        }
        format!(
            "{list} */\nstatic inline unsigned {prefix}_check(const {prefix}_parameters *p) {{\n{statements}    return 0u;\n}}\n\n"
        )
    }

    /// A condition for an entry of its list.
    fn condition(&self, condition: &Condition, places: &[Vec<String>], entry: usize) -> String {
        let [left, right] = condition.sides.each_ref().map(|side| self.term(side, places, entry));
        format!("{left} {} {right}", condition.comparison)
    }

    /// An expression in parameters, in `double`.
    fn term(&self, term: &Term, places: &[Vec<String>], entry: usize) -> String {
        match term {
            Term::Number(number) => format!("{number:?}").replace("inf", "INFINITY").replace("NaN", "NAN"),
            Term::Parameter(k) => {
                let place = places[*k].get(entry).or(places[*k].first());
                let place = place.cloned().unwrap_or_else(|| "NAN".to_owned());
                if self.file.precision == Precision::F32 { format!("(double){place}") } else { place }
            }
            Term::Negative(term) => format!("(-{})", self.term(term, places, entry)),
            Term::Arithmetic(operator, sides) => {
                let [a, b] = sides.each_ref().map(|side| self.term(side, places, entry));
                format!("({a} {operator} {b})")
            }
            Term::Call(function, arguments) => {
                let terms: Vec<_> = arguments.iter().map(|one| self.term(one, places, entry)).collect();
                let last = terms.last().map_or("NAN", String::as_str);
                (function.in_c)(terms.first().map_or("NAN", String::as_str), last)
            }
        }
    }
}
