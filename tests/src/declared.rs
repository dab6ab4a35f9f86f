//! An energy of the catalogue in the form that its compiler reads, for checks of its expressions.

use std::fmt::Display;
use std::path::PathBuf;

use piola::Inversion;
use piola::material::Description;
use piola_codegen::algebra::interpret::{Memo, Point, evaluate, evaluate_with};
use piola_codegen::model::{Model, model};
use piola_codegen::read::parse::{Declaration, parse};

/// All declarations of the catalogue's sources.
///
/// # Errors
/// Where a file cannot be read or its declaration is not understood; says which and why.
pub fn declarations() -> Result<Vec<Declaration>, String> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../materials/src");
    let mut found = Vec::new();
    for file in std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))? {
        let path = file.map_err(|error| format!("{}: {error}", folder.display()))?.path();
        let text = |error: &dyn Display| format!("{}: {error}", path.display());
        let source = std::fs::read_to_string(&path).map_err(|error| text(&error))?;
        for (arguments, item) in piola_codegen::declarations(&source).map_err(|error| text(&error))? {
            found.push(parse(arguments, item).map_err(|error| text(&error))?);
        }
    }
    Ok(found)
}

/// An energy with parameters, as expressions.
#[derive(Debug)]
pub struct Declared {
    model: Model,
    /// Length of the list of each parameter; `None` for scalars.
    lengths: Vec<Option<usize>>,
    point: Point,
    is_extended: bool,
}

impl Declared {
    /// Reads the declaration from the catalogue's sources.
    ///
    /// # Errors
    /// Where it is not found or not understood; says which and why.
    pub fn read(description: &Description, values: &[&[f64]], inversion: Inversion) -> Result<Self, String> {
        let declaration = declarations()?
            .into_iter()
            .find(|declaration| declaration.name == description.name)
            .ok_or_else(|| format!("{}: not declared", description.name))?;
        let lengths = declaration.parameters.iter().map(|parameter| parameter.length()).collect();
        let (is_extended, epsilon) = match inversion {
            Inversion::Refuse => (false, 0.0),
            Inversion::Extend { epsilon } => (true, epsilon),
        };
        let model = model(&declaration).map_err(|error| format!("{}: {error}", description.name))?;
        let point = Point { epsilon, ..Point::default() };
        let declared = Self { model, lengths, point, is_extended };
        Ok(Self { point: declared.point(values, [1.0; 3]), ..declared })
    }

    fn point(&self, values: &[&[f64]], stretches: [f64; 3]) -> Point {
        let mut lengths = vec![0; self.lengths.iter().flatten().max().map_or(0, |last| last + 1)];
        for (&length, list) in self.lengths.iter().zip(values) {
            if let Some(length) = length {
                lengths[length] = list.len();
            }
        }
        let parameters = values.iter().map(|list| list.to_vec()).collect::<Vec<_>>().into();
        Point { stretches, parameters, lengths, epsilon: self.point.epsilon }
    }

    /// Σ|terms| of ψ as written inside its domain, for any parameters: every subtraction in the formula
    /// replaced by an addition of magnitudes, J/m³.
    #[must_use]
    pub fn energy_terms(&self, values: &[&[f64]], stretches: [f64; 3]) -> f64 {
        evaluate(&self.model.graph, self.model.energy, &self.point(values, stretches)).magnitude
    }

    /// Σ|terms| of the flips and twists of the pairs, every subtraction inside them replaced by an addition
    /// of magnitudes, Pa.
    #[must_use]
    pub fn terms(&self, stretches: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let variant = match &self.model.extended {
            Some(extended) if self.is_extended => extended,
            _ => &self.model.plain,
        };
        let point = Point { stretches, ..self.point.clone() };
        let mut memo = Memo::default();
        let mut terms = |id| evaluate_with(&self.model.graph, id, &point, &mut memo).magnitude;
        (variant.flip.map(&mut terms), variant.twist.map(&mut terms))
    }
}
