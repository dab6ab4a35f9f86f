//! The folder `declarations/`: energies as text, ordinary Rust sources of the macro, which no compiler but
//! that of [`Energy`] reads.
//!
//! Declarations are separated by empty lines. Lines before a declaration that begin with `//@` are remarks
//! for its judges, each a word and what follows it; two more spaces continue a remark.

use std::path::PathBuf;

use piola::material::Form;
use piola_declare::Energy;
use serde_json::Value;

use crate::energies::Judged;

/// Values of all parameters, one list for each.
pub type Values = Vec<Vec<f64>>;

/// A declaration of a file, with the remarks about it.
#[derive(Clone, Debug)]
pub struct Text {
    /// The declaration.
    pub source: String,
    remarks: Vec<String>,
}

impl Text {
    fn of(source: &str) -> Self {
        let mut remarks: Vec<String> = Vec::new();
        for remark in source.lines().filter_map(|line| line.trim_start().strip_prefix("//@")) {
            match remark.strip_prefix("   ") {
                Some(more) => *remarks.last_mut().expect("a remark to continue") += &format!(" {more}"),
                None => remarks.push(remark.trim().to_owned()),
            }
        }
        Self { source: source.to_owned(), remarks }
    }

    /// The rest of each remark that begins with a word.
    pub fn remarks<'a>(&'a self, word: &'a str) -> impl Iterator<Item = &'a str> {
        let split = |remark: &'a String| remark.split_once(' ').unwrap_or((remark, ""));
        self.remarks.iter().map(split).filter(move |(first, _)| *first == word).map(|(_, rest)| rest)
    }

    /// The numbers that follow a word, if it is among the remarks.
    pub fn numbers<const N: usize>(&self, word: &str) -> Option<[f64; N]> {
        let mut numbers = self.remarks(word).next()?.split(' ').map(|number| number.parse().ok());
        Some(std::array::from_fn(|_| numbers.next().flatten().expect("numbers")))
    }
}

/// Values as a remark has them: numbers, `"inf"` and `"NaN"` among them, and lists of these.
pub fn values(text: &str) -> Values {
    let number = |value: &Value| match value {
        Value::String(word) => word.parse().expect("inf or NaN"),
        value => value.as_f64().expect("a number"),
    };
    let list = |value: &Value| match value {
        Value::Array(entries) => entries.iter().map(number).collect(),
        value => vec![number(value)],
    };
    let all: Vec<Value> = serde_json::from_str(&format!("[{text}]")).expect("values of parameters");
    all.iter().map(list).collect()
}

/// Slices of values, as constructors take them.
pub fn slices(values: &Values) -> Vec<&[f64]> {
    values.iter().map(Vec::as_slice).collect()
}

/// All declarations of a file of the folder.
pub fn texts(file: &str) -> Vec<Text> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("declarations").join(format!("{file}.rs"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let parts = text.split("\n\n").filter(|part| !part.starts_with("//!"));
    parts.map(Text::of).collect()
}

/// An energy with the parameters that judges give it.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The energy.
    pub judged: &'static Judged,
    /// The declaration with its remarks; none of the catalogue has any.
    pub text: Text,
    /// True if the catalogue has it.
    pub is_of_catalogue: bool,
}

impl Sample {
    /// An energy of the catalogue.
    pub fn of_catalogue(judged: &'static Judged) -> Self {
        let text = Text { source: judged.energy.text().to_owned(), remarks: Vec::new() };
        Self { judged, text, is_of_catalogue: true }
    }

    fn declared(file: &str, text: Text) -> Self {
        let energy = Energy::from_rust(&text.source).unwrap_or_else(|mistakes| panic!("{file}: {mistakes}"));
        let name = format!("{file}::{}", energy.description().name);
        let judged = Judged { name: name.leak(), compiled: None, energy };
        Self { judged: Box::leak(Box::new(judged)), text, is_of_catalogue: false }
    }

    /// The sets of parameters that are to be judged: the typical one, and those of the remarks.
    pub fn values(&self) -> Vec<Values> {
        let typical: Values = self.judged.typical().into_iter().map(<[f64]>::to_vec).collect();
        let is_given = self.judged.description().parameters.len() == typical.len();
        let typical = Some(typical).filter(|_| is_given);
        typical.into_iter().chain(self.text.remarks("values").map(values)).collect()
    }

    /// True if these are the typical values.
    pub fn is_typical(&self, values: &Values) -> bool {
        self.judged.typical() == slices(values)
    }

    /// True if a parameter is a function.
    pub fn has_functions(&self) -> bool {
        let mut parameters = self.judged.description().parameters.iter();
        parameters.any(|parameter| matches!(parameter.form, Form::Function | Form::Points))
    }
}

/// The energies of the files.
pub fn samples(files: &[&str]) -> Vec<Sample> {
    let of =
        |file: &&str| texts(file).into_iter().map(|text| Sample::declared(file, text)).collect::<Vec<_>>();
    files.iter().flat_map(of).collect()
}

/// The energy of that name in a file.
pub fn find(file: &str, name: &str) -> Sample {
    let text = texts(file).into_iter().find(|text| text.source.contains(&format!("fn {name}")));
    Sample::declared(file, text.unwrap_or_else(|| panic!("{file}: {name}")))
}
