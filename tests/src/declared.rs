//! An energy of the catalogue as its compiler understands it, for what only the expressions can say.

use std::collections::HashMap;
use std::fmt::Display;
use std::path::PathBuf;

use piola::Inversion;
use piola::material::Description;
use piola_codegen::interpret::{Point, evaluate_with};
use piola_codegen::model::{Model, model};
use piola_codegen::parse::parse;

/// An energy with parameters, as expressions.
#[derive(Debug)]
pub struct Declared {
    model: Model,
    point: Point,
    is_extended: bool,
}

impl Declared {
    /// Reads the declaration from the catalogue's sources.
    ///
    /// # Errors
    /// Where it is not found or not understood; says which and why.
    pub fn read(description: &Description, values: &[&[f64]], inversion: Inversion) -> Result<Self, String> {
        let text = |error: &dyn Display| format!("{}: {error}", description.name);
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../materials/src");
        for file in std::fs::read_dir(&folder).map_err(|error| text(&error))? {
            let path = file.map_err(|error| text(&error))?.path();
            let source = std::fs::read_to_string(&path).map_err(|error| text(&error))?;
            for (arguments, item) in piola_codegen::declarations(&source).map_err(|error| text(&error))? {
                let declaration = parse(arguments, item).map_err(|error| text(&error))?;
                if declaration.name != description.name {
                    continue;
                }
                let mut lengths = vec![0; declaration.lengths.len()];
                for (parameter, list) in declaration.parameters.iter().zip(values) {
                    if let Some(length) = parameter.length() {
                        lengths[length] = list.len();
                    }
                }
                let (is_extended, epsilon) = match inversion {
                    Inversion::Refuse => (false, 0.0),
                    Inversion::Extend { epsilon } => (true, epsilon),
                };
                let parameters = values.iter().map(|list| list.to_vec()).collect();
                let point = Point { stretches: [1.0; 3], parameters, lengths, epsilon };
                let model = model(&declaration).map_err(|error| text(&error))?;
                return Ok(Self { model, point, is_extended });
            }
        }
        Err(text(&"not declared"))
    }

    /// Σ|terms| of the flips and twists of the pairs, every subtraction inside them replaced by an addition of magnitudes, Pa.
    #[must_use]
    pub fn terms(&self, stretches: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let variant = match &self.model.extended {
            Some(extended) if self.is_extended => extended,
            _ => &self.model.plain,
        };
        let point = Point { stretches, ..self.point.clone() };
        let mut memo = HashMap::new();
        let mut terms = |id| evaluate_with(&self.model.graph, id, &point, &mut memo).magnitude;
        (variant.flip.map(&mut terms), variant.twist.map(&mut terms))
    }
}
