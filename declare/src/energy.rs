//! An energy that was declared at run time, and the materials that it makes.

use std::borrow::Cow;
use std::sync::Arc;

use piola::__private::interpreter::{ByInvariants, Programs, Value, Variant};
use piola::__private::{Condition, record};
use piola::contract::Notation;
use piola::interpreter::Interpreted;
use piola::material::{Curvature, Description, Form, MaterialError, Parameter, Text, Typical, Unit};
use piola::{DynMaterial, Inversion, Material, Spline, Univariate};
use piola_codegen::algebra::expr::Id;
use piola_codegen::algebra::invariants;
use piola_codegen::emit::documentation::page;
use piola_codegen::emit::{Texts, condition_text};
use piola_codegen::model::{self, Model};
use piola_codegen::read;
use piola_codegen::read::notation::plain_name;
use piola_codegen::read::parse::{Declaration, Kind};

use crate::constructor::Constructor;
use crate::fit::{self, Constraint, Fit};
use crate::lower::{lower, lower_parts};

/// An elastic energy, compiled from text.
///
/// Cheap to clone: clones share their programs.
///
/// ```
/// use piola::{Inversion, Material};
/// use piola_declare::Energy;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let energy = Energy::from_rust(
///     "/// Compressible neo-Hookean solid.
///      #[material(domain(J > 0.0), admissible(mu > 0.0))]
///      fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///          mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
///      }",
/// )?;
/// let rubber = energy.material(&[&[1e6], &[5e6]], Inversion::Refuse)?;
/// assert_eq!(rubber.gradient([2.0, 1.0, 0.5]), [1.5e6, 0.0, -1.5e6]);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Energy(Arc<Compiled>);

#[derive(Debug)]
struct Compiled {
    description: Description,
    documentation: String,
    text: String,
    source: String,
    notation: Notation,
    programs: Arc<Programs>,
    constructor: Constructor,
    fit: Fit,
}

/// Equal energies are declared by the same text.
impl PartialEq for Energy {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0.text == other.0.text
    }
}

impl Energy {
    /// The energy of a checked declaration; `None` if it needs more registers than there are, or its
    /// derivatives by the parameters leave the limit on its size.
    pub(crate) fn new(
        declaration: &Declaration,
        mut model: Model,
        text: String,
        source: String,
        notation: Notation,
    ) -> Option<Self> {
        let programs = Arc::new(programs(declaration, &mut model)?);
        let texts = Texts::of(declaration, &mut model);
        let documentation = page(declaration, &mut model, &texts);
        let constructor = Constructor::new(declaration, &mut model)?;
        // Last, so that all other programs are those of the compiled type.
        let fit = Fit::new(declaration, &mut model)?;
        if model.graph.is_full() {
            return None;
        }
        Some(Self(Arc::new(Compiled {
            description: description(declaration, &model.units, texts),
            documentation,
            text,
            source,
            notation,
            programs,
            constructor,
            fit,
        })))
    }

    /// Names, formula, parameters and domain of the declaration.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.0.description
    }

    /// The documentation that the type of the compiled energy would have, in Markdown: parameters, domain,
    /// small-strain moduli, derivatives and quotients as formulas.
    #[must_use]
    pub fn documentation(&self) -> &str {
        &self.0.documentation
    }

    /// The text that the energy was compiled from.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// The declaration in Rust, to be pasted into a crate that depends on `piola`.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.0.source
    }

    /// Notation in which the energy was declared, for
    /// [`Settings::notation`](piola::contract::Settings::notation).
    #[must_use]
    pub fn notation(&self) -> Notation {
        self.0.notation
    }

    /// Typical parameters as declared, one list for each; empty if there are none.
    #[must_use]
    pub fn typical(&self) -> Vec<&[f64]> {
        let typical = self.0.description.typical.iter();
        typical.flat_map(|typical| typical.values.iter().map(|list| &**list)).collect()
    }

    /// The material with these values, one slice for each parameter of the description, in its order: one
    /// number, the entries of a list, or the control points x1, y1, x2, y2, … of a spline.
    ///
    /// # Errors
    /// [`MaterialError`] of the compiled energy's constructor.
    pub fn material(&self, values: &[&[f64]], inversion: Inversion) -> Result<Interpreted, MaterialError> {
        let Compiled { description, programs, constructor, .. } = &*self.0;
        let values = constructor.values(description, values, &[])?;
        constructor.build(description, programs, values, inversion)
    }

    /// The [`material`](Self::material) behind a pointer, for single points, batches and bodies in `f64`. Its
    /// generic code is compiled in this crate; `Box::new` compiles it again in the caller's.
    ///
    /// # Errors
    /// [`MaterialError`] of [`Energy::material`].
    pub fn boxed(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn DynMaterial<f64>>, MaterialError> {
        Ok(Box::new(self.material(values, inversion)?))
    }

    /// Values of the parameters of a material of this energy, one list for each parameter of the description
    /// in its order, in the form of [`with_values`](Self::with_values): numbers and lists as in
    /// [`material`](Self::material), splines as in [`Spline::values`].
    #[must_use]
    pub fn values(&self, material: &Interpreted) -> Vec<Vec<f64>> {
        fit::values(material)
    }

    /// A material of this energy with other values, as [`values`](Self::values) lists them, and without
    /// extension. All else of a spline stays what it is.
    ///
    /// # Errors
    /// [`MaterialError::Shape`] if the lengths do not match; other errors are those of [`Energy::material`] and
    /// of [`Spline::with_values`].
    pub fn with_values(
        &self,
        material: &Interpreted,
        values: &[Vec<f64>],
    ) -> Result<Interpreted, MaterialError> {
        let Compiled { description, programs, constructor, .. } = &*self.0;
        let values: Vec<_> = values.iter().map(Vec::as_slice).collect();
        let values = constructor.values(description, &values, material.values())?;
        constructor.build(description, programs, values, Inversion::Refuse)
    }

    /// ∂ψ1/∂p, ∂ψ2/∂p, ∂ψ3/∂p for each number p among the parameters, in the order of
    /// [`values`](Self::values), lists entry by entry. Pa for each unit of p. Whole exponents do not change,
    /// and have zeros. Derivatives by the values of a spline are central differences of sixth order, with
    /// steps of about 1/128 of each value; NaN if the spline refuses such values.
    ///
    /// For stretches inside the domain: an extension is not used, and outside the domain the numbers are
    /// meaningless and may be NaN.
    ///
    /// ```
    /// use piola::Inversion;
    /// use piola_declare::Energy;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let ogden = Energy::from_rust(
    ///     "/// Σₚ μₚ/αₚ Σ λ^αₚ − (Σₚ μₚ) ln J + κ/2 (J − 1)².
    ///      #[material(domain(J > 0.0))]
    ///      fn Ogden<const N: usize>(
    ///          [l1, l2, l3]: [f64; 3],
    ///          /** Moduli μₚ, Pa. */ mu: [f64; N],
    ///          /** Exponents αₚ. */ alpha: [f64; N],
    ///          /** Volumetric modulus κ, Pa. */ kappa: f64,
    ///      ) -> f64 {
    ///          let shear = sum(|p| mu[p] / alpha[p] * sum(|l| l.powf(alpha[p])));
    ///          shear - sum(|p| mu[p]) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
    ///      }",
    /// )?;
    /// let rubber = ogden.material(&[&[6.3e5, -1e4], &[1.3, -2.0], &[2e7]], Inversion::Refuse)?;
    /// assert_eq!(ogden.values(&rubber), [&[6.3e5, -1e4][..], &[1.3, -2.0], &[2e7]]);
    /// // ψ1 = Σₚ μₚ (λ1^αₚ − 1)/λ1 + κ (J − 1) J/λ1 changes by (λ1^α₂ − 1)/λ1 for each pascal of μ₂, the
    /// // second of five numbers.
    /// let derivatives = ogden.gradient_by_parameters(&rubber, [2.0, 1.0, 0.5]);
    /// assert_eq!(derivatives.len(), 5);
    /// assert!((derivatives[1][0] - (0.25 - 1.0) / 2.0).abs() < 1e-15);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn gradient_by_parameters(&self, material: &Interpreted, stretches: [f64; 3]) -> Vec<[f64; 3]> {
        let gradient = |material: &Interpreted| material.gradient(stretches);
        self.0.fit.gradient.each(&self.without_extension(material), &stretches, &gradient)
    }

    /// Conditions that the constructor checks, except for finite values and `!=`: the comparisons of
    /// `admissible(…)`, one for each entry if they are on entries, and positive moduli at rest unless the
    /// material is `prestressed`.
    ///
    /// ```
    /// use piola::Inversion;
    /// use piola_declare::{Energy, Limit};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let energy = Energy::from_rust(
    ///     "/// Compressible neo-Hookean solid.
    ///      #[material(domain(J > 0.0), admissible(lambda <= 1e7))]
    ///      fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    ///          mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
    ///      }",
    /// )?;
    /// let rubber = energy.material(&[&[6e5], &[1e6]], Inversion::Refuse)?;
    /// let [upper, shear, bulk] = <[_; 3]>::try_from(energy.constraints(&rubber)).expect("three");
    /// assert_eq!((upper.limit, upper.value), (Limit::Admissible("lambda <= 1e7".into()), 9e6));
    /// assert_eq!((shear.limit, shear.value), (Limit::ShearModulus, 6e5));
    /// // K = λ + 2/3 μ
    /// assert_eq!((bulk.limit, bulk.gradient), (Limit::BulkModulus, vec![2.0 / 3.0, 1.0]));
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn constraints(&self, material: &Interpreted) -> Vec<Constraint> {
        fit::constraints(&self.0.fit.constraints, &self.without_extension(material), &[])
    }

    /// Conditions of the domain at stretches λ1 ≥ λ2 ≥ λ3 > 0, except for those on J alone: at stretches that
    /// are kept, these are conditions on the parameters too.
    #[must_use]
    pub fn domain_constraints(&self, material: &Interpreted, stretches: [f64; 3]) -> Vec<Constraint> {
        fit::constraints(&self.0.fit.domain, &self.without_extension(material), &stretches)
    }

    /// The material with each number among its parameters replaced by the value that stands for it in a
    /// recorded program. Whole exponents keep theirs.
    pub(crate) fn with_marked_parameters(&self, material: &Interpreted) -> Interpreted {
        let mut k = 0;
        let mut mark = |number: &f64, is_whole: bool| {
            k += 1;
            if is_whole { *number } else { record::parameter(k - 1) }
        };
        let pairs = material.values().iter().zip(&self.0.programs.are_whole);
        let marked = pairs.map(|(value, &is_whole)| match value {
            Value::Numbers(numbers) => {
                Value::Numbers(numbers.iter().map(|number| mark(number, is_whole)).collect())
            }
            function => function.clone(),
        });
        material.clone_with(marked.collect())
    }

    /// The conditions on the parameters of a material, with those of its extension.
    pub(crate) fn conditions(&self, inversion: Inversion) -> impl Iterator<Item = &Condition> {
        self.0.constructor.conditions(inversion)
    }

    /// True if the rest state may carry a stress.
    pub(crate) fn is_prestressed(&self) -> bool {
        self.0.constructor.is_prestressed
    }

    /// The material without extension.
    pub(crate) fn without_extension(&self, material: &Interpreted) -> Interpreted {
        Interpreted::new(self.0.programs.clone(), material.values().to_vec(), Inversion::Refuse)
    }
}

/// The programs of all responses; `None` if one needs more registers than there are.
#[doc(hidden)]
#[must_use]
pub fn programs(declaration: &Declaration, model: &mut Model) -> Option<Programs> {
    let program = |model: &mut Model, roots: &[Id]| lower(declaration, &model.program(roots));
    let within = |model: &mut Model, roots: &[Id], bounds: &[Id]| {
        lower_parts(declaration, &[&model.program(roots), &model.program(bounds)])
    };
    let (plain, extended) = (model.plain.clone(), model.extended.clone());
    let plain = variant(declaration, model, &plain)?;
    let extended = match extended {
        Some(extended) => Some(variant(declaration, model, &extended)?),
        None => None,
    };
    let by_invariants = match model.invariants.clone() {
        None => None,
        Some(by) => Some(ByInvariants {
            energy: if by.has_energy { Some(within(model, &[by.energy], &by.bounds)?) } else { None },
            gradient: within(model, &by.gradient, &by.bounds)?,
            derivatives: within(model, &[&by.gradient[..], &by.hessian].concat(), &by.bounds)?,
            bounds: program(model, &by.bounds)?,
            has_second_invariant: !model.graph.is_zero(by.gradient[1]),
            curvature: match by.curvature(&model.graph) {
                invariants::Curvature::First => Curvature::First,
                invariants::Curvature::Volume => Curvature::Volume,
                invariants::Curvature::Separate => Curvature::Separate,
                invariants::Curvature::All => Curvature::All,
            },
        }),
    };
    Some(Programs {
        plain,
        extended,
        at_strains: program(model, &model.at_strains.clone())?,
        bounds: program(model, &model.bounds.clone())?,
        volume: model.volume,
        by_invariants,
        moduli: program(model, &model.moduli.clone())?,
        are_whole: declaration.parameters.iter().map(|parameter| parameter.is_whole).collect(),
    })
}

fn variant(declaration: &Declaration, model: &mut Model, of: &model::Variant) -> Option<Variant> {
    let model::Variant { energy, gradient, has_pole, .. } = *of;
    let bounds = model.program(&model.bounds.clone());
    let mut within = |roots: &[Id]| lower_parts(declaration, &[&model.program(roots), &bounds]);
    Some(Variant {
        energy: within(&[energy])?,
        gradient: within(&gradient)?,
        blocks: within(&of.blocks())?,
        has_pole,
    })
}

/// Names, texts and forms of a declaration as data.
fn description(declaration: &Declaration, units: &[Option<read::unit::Unit>], texts: Texts) -> Description {
    let options = &declaration.options;
    let parameters = declaration.parameters.iter().zip(units).map(|(parameter, unit)| {
        let unit = unit.map(|unit| match unit {
            read::unit::Unit::Pascal => Unit::Pascal,
            read::unit::Unit::PerPascal => Unit::PerPascal,
            read::unit::Unit::Dimensionless => Unit::Dimensionless,
        });
        let form = match parameter.kind {
            Kind::Number if parameter.is_whole => Form::Exponent,
            Kind::List(_) if parameter.is_whole => Form::Exponents,
            Kind::Number => Form::Number,
            Kind::List(_) => Form::List,
            Kind::Function(_) => Spline::FORM,
        };
        let (name, doc) = (plain_name(&parameter.name).into(), parameter.doc.clone().into());
        Parameter { name, doc, unit, form }
    });
    let Texts { formula, domain, defined, moduli, summary } = texts;
    let typical = options.typical.as_ref().map(|typical| Typical {
        values: typical.values.iter().map(|(_, values)| Cow::Owned(values.numbers.clone())).collect(),
        source: typical.source.value().into(),
    });
    Description {
        name: declaration.name.to_string().into(),
        summary: summary.into(),
        formula: formula.into(),
        parameters: parameters.collect(),
        domain: [domain, defined].join(" ").trim_end().to_owned().into(),
        extends: options.extend.is_some(),
        refusal: options.refusal().map(Text::from),
        admissible: options.admissible.iter().map(|condition| condition_text(condition).into()).collect(),
        moduli: moduli.map(Text::from),
        typical,
    }
}
