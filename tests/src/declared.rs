//! An energy in the form that its compiler reads, for checks of its expressions.

use piola::Inversion;
use piola_codegen::algebra::expr::Id;
use piola_codegen::algebra::interpret::{Point, evaluate};
use piola_codegen::model::Model;
use piola_codegen::read::parse::Declaration;

/// The declaration of a text, and its expressions.
pub fn understood(text: &str) -> Result<(Declaration, Model), String> {
    let mut all = piola_codegen::declarations(text).map_err(|error| format!("{error}: {text}"))?;
    let (Some((arguments, item)), true) = (all.pop(), all.is_empty()) else {
        return Err(format!("not one declaration: {text}"));
    };
    piola_codegen::analyse(arguments, item).map_err(|error| format!("{error}: {text}"))
}

/// An energy with parameters, as expressions.
#[derive(Debug)]
pub struct Declared {
    /// The expressions.
    pub model: Model,
    /// Length of the list of each parameter; `None` for scalars.
    lengths: Vec<Option<usize>>,
    point: Point,
    is_extended: bool,
}

impl Declared {
    /// Reads the declaration of a text.
    pub fn read(text: &str, values: &[&[f64]], inversion: Inversion) -> Result<Self, String> {
        let (declaration, model) = understood(text)?;
        Ok(Self::new(&declaration, model, values, inversion))
    }

    /// Values for the parameters of a declaration.
    pub fn new(declaration: &Declaration, model: Model, values: &[&[f64]], inversion: Inversion) -> Self {
        let lengths = declaration.parameters.iter().map(|parameter| parameter.length()).collect();
        let (is_extended, epsilon) = match inversion {
            Inversion::Refuse => (false, 0.0),
            Inversion::Extend { epsilon } => (true, epsilon),
        };
        let point = Point { epsilon, ..Point::default() };
        let declared = Self { model, lengths, point, is_extended };
        Self { point: declared.point(values, [1.0; 3]), ..declared }
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
    pub fn energy_terms(&self, values: &[&[f64]], stretches: [f64; 3]) -> f64 {
        evaluate(&self.model.graph, self.model.energy, &self.point(values, stretches)).magnitude
    }

    /// Σ|terms| of an expression of the model.
    pub fn terms_of(&self, root: Id, stretches: [f64; 3]) -> f64 {
        evaluate(&self.model.graph, root, &Point { stretches, ..self.point.clone() }).magnitude
    }

    /// Σ|terms| of the flips, then of the twists, of the pairs, Pa.
    pub fn terms(&self, stretches: [f64; 3]) -> [[f64; 3]; 2] {
        let variant = match &self.model.extended {
            Some(extended) if self.is_extended => extended,
            _ => &self.model.plain,
        };
        [variant.flip, variant.twist].map(|ids| ids.map(|id| self.terms_of(id, stretches)))
    }
}
