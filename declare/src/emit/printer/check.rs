//! The check of the parameters: the conditions of the constructor.

use std::fmt::Write;

use piola::__private::{Condition, Term};
use piola::material::Form;

use super::{Printer, safe};
use crate::emit::Precision;
use crate::emit::language::Kind;

impl Printer<'_> {
    /// A check of the parameters, by the conditions of the declaration.
    pub(super) fn check(&self) -> String {
        let Self { file, language, .. } = self;
        let description = file.energy.description();
        let mut places = self.parameters.iter();
        let mut all = Vec::new();
        // Each with what is said of it, statements before it, and the condition under which all is well. The
        // others mean something only with the arithmetic that the first tests.
        let meaning = "options of the compiler change sums or comparisons, see above".to_owned();
        let mut cases = vec![(meaning, String::new(), format!("{}()", language.name_of("is_exact", false)))];
        for ((parameter, values), name) in description.parameters.iter().zip(file.values).zip(&self.fields) {
            let numbers: Vec<_> = places.by_ref().take(values.len()).cloned().collect();
            if !matches!(parameter.form, Form::Exponent | Form::Exponents) && !numbers.is_empty() {
                // Whole exponents have no place in the structure.
                cases[0].1 = language.start(&numbers[0]);
                let finite: Vec<_> = numbers.iter().map(|place| language.is_finite(place)).collect();
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
        let mut statements = language.variables(Kind::Number, &["shear".into(), "bulk".into()], "    ");
        let call = format!("{}(p, &shear, &bulk)", language.name_of("at_rest", true));
        let _ = writeln!(statements, "    {}", language.constant(Kind::Truth, "is_inside", &call));
        if !file.energy.is_prestressed() {
            // The constructor has the moduli by a formula, without the roundings of derivatives.
            let rounding = language.literal(if file.precision == Precision::F32 { 1e-5 } else { 1e-13 });
            let (zero, is_finite) = (language.literal(0.0), language.is_finite("bulk"));
            let condition = format!("shear > {zero} && bulk >= -{rounding} * shear && {is_finite}");
            let meaning = "at rest, the solid does not resist shear or changes of volume".to_owned();
            cases.push((meaning, std::mem::take(&mut statements), condition));
        }
        let meaning = "the rest state is outside of the domain".to_owned();
        cases.push((meaning, statements, "is_inside".to_owned()));
        let mut list =
            "/* Returns 0 if the parameters are admissible, else the first of these that is true:\n"
                .to_owned();
        let mut statements = String::new();
        for (k, (meaning, before, condition)) in cases.iter().enumerate() {
            let _ = writeln!(list, " * {}: {meaning}", k + 1);
            statements += before;
            statements += &language.return_unless(condition, k + 1);
        }
        let head = language.head(&file.signatures["check"], false);
        format!("{list} */\n{head}\n{statements}    return 0u;\n}}\n\n")
    }

    /// A condition for an entry of its list.
    fn condition(&self, condition: &Condition, places: &[Vec<String>], entry: usize) -> String {
        let [left, right] = condition.sides.each_ref().map(|side| self.term(side, places, entry));
        format!("{left} {} {right}", condition.comparison)
    }

    /// An expression in parameters.
    fn term(&self, term: &Term, places: &[Vec<String>], entry: usize) -> String {
        match term {
            Term::Number(number) => self.language.number_in_condition(*number),
            Term::Parameter(k) => {
                let place = places[*k].get(entry).or(places[*k].first());
                match place {
                    Some(place) => self.language.parameter_in_condition(place.clone()),
                    None => self.language.number_in_condition(f64::NAN),
                }
            }
            Term::Call(name, operands) => {
                let operands: Vec<_> = operands.iter().map(|one| self.term(one, places, entry)).collect();
                match (&**name, &operands[..]) {
                    ("-", [a]) => format!("(-{a})"),
                    ("+" | "-" | "*" | "/", [a, b]) => format!("({a} {name} {b})"),
                    // Of one operand, the second is the first once more.
                    (name, [a, ..]) => {
                        let b = &operands[operands.len() - 1];
                        self.language.call_in_condition(name, a, b)
                    }
                    (_, []) => self.language.number_in_condition(f64::NAN),
                }
            }
        }
    }
}
