//! The model of a material, everything that is emitted of it, and the table of contents of the compiler.

use std::rc::Rc;

use rustc_hash::FxHashMap;
use syn::{BinOp, Expr};

use crate::algebra::cancellation::{lossy, over_one_denominator};
use crate::algebra::diff::derivatives;
use crate::algebra::expand::expand_products;
use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::extension;
use crate::algebra::increment::{Increments, substitute_rest};
use crate::algebra::interpret::Point;
use crate::algebra::invariants::ByInvariants;
use crate::algebra::quotient::{Quotients, Reflection};
use crate::algebra::rational::Rational;
use crate::algebra::simplify::simplify;
use crate::algebra::volume::with_limits;
use crate::judge::{self, Derived, Source};
use crate::read::diagnostics::Diagnostics;
use crate::read::domain::Volume;
use crate::read::parse::Declaration;
use crate::read::resolve::{self, Resolver};
use crate::read::unit::Unit;
use crate::schedule::count::Count;
use crate::schedule::{Collector, Program, schedule};
pub use by_parameters::{ByParameters, Constraint, Limit};
use forms::{Evaluated, Prepared};

mod by_parameters;
mod forms;

/// Pairs of stretches, in the order of `piola::material::PAIRS`.
pub const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

/// A declared energy with its derivatives.
#[derive(Debug)]
pub struct Model {
    /// All expressions.
    pub graph: Graph,
    /// The energy as written.
    pub energy: Id,
    /// The energy and its derivatives inside the domain.
    pub plain: Variant,
    /// ψ1, ψ2, ψ3 inside the domain by principal strains instead of stretches.
    pub at_strains: [Id; 3],
    /// The energy and its derivatives continued beyond the volumes of the domain.
    pub extended: Option<Variant>,
    /// The energy by invariants, if ψ is a function of these alone.
    pub invariants: Option<ByInvariants>,
    /// Expressions that are positive inside the domain, J apart.
    pub bounds: Vec<Id>,
    /// Values at rest of the bounds that depend on parameters there, with their places.
    pub bounds_at_rest: Vec<(usize, Id)>,
    /// The volumes J for which the energy is defined.
    pub volume: Volume,
    /// The unit of each parameter, stated or inferred.
    pub units: Vec<Option<Unit>>,
    /// Small-strain μ and λ.
    pub moduli: [Id; 2],
    /// Sums that cancel on flat, thin or huge elements and cost digits there.
    pub lossy: Vec<Id>,
    /// Points of the domain with admissible parameters.
    pub samples: Vec<Point>,
    /// The conditions on the parameters that the constructor checks, as expressions; `None` for those
    /// without one.
    constrained: Vec<Option<Id>>,
    programs: FxHashMap<Vec<Id>, Rc<Program>>,
    collector: Collector,
}

impl Model {
    /// The program of the roots, scheduled at the first call.
    pub fn program(&mut self, roots: &[Id]) -> Rc<Program> {
        if let Some(done) = self.programs.get(roots) {
            return done.clone();
        }
        let program = Rc::new(schedule(&mut self.graph, &mut self.collector, roots));
        self.programs.insert(roots.to_vec(), program.clone());
        program
    }

    /// The operations of each result of a material, by its name: inside the domain, and last the blocks of an
    /// energy continued beyond it. Blocks make up a tangent: gradient, Hessian, flip and twist.
    #[must_use]
    pub fn counts(&mut self) -> Vec<(&'static str, Count)> {
        let Variant { energy, gradient, hessian, flip, twist, .. } = &self.plain;
        let mut results = vec![
            ("energy", vec![*energy]),
            ("gradient", gradient.to_vec()),
            ("energy, gradient and Hessian", [&[*energy], &gradient[..], hessian].concat()),
            ("flip", flip.to_vec()),
            ("twist", twist.to_vec()),
            ("blocks", self.plain.blocks()),
        ];
        results.extend(self.extended.as_ref().map(|extended| ("blocks, continued", extended.blocks())));
        let count = |(name, roots): (_, Vec<_>)| (name, Count::of(&self.program(&roots)));
        results.into_iter().map(count).collect()
    }
}

/// One energy with its derivatives, ready for scheduling.
#[derive(Clone, Debug)]
pub struct Variant {
    /// ψ.
    pub energy: Id,
    /// ψ1, ψ2, ψ3.
    pub gradient: [Id; 3],
    /// ψ11, ψ22, ψ33, ψ12, ψ13, ψ23.
    pub hessian: [Id; 6],
    /// D⁻ of the pairs.
    pub flip: [Id; 3],
    /// D⁺ of the pairs.
    pub twist: [Id; 3],
    /// True if a twist has a pole at λi + λj = 0.
    pub has_pole: bool,
}

impl Variant {
    /// The blocks of a tangent: gradient, Hessian, flip and twist.
    #[must_use]
    pub fn blocks(&self) -> Vec<Id> {
        [&self.gradient[..], &self.hessian, &self.flip, &self.twist].concat()
    }
}

/// Maximum number of parameters of an energy whose size is limited: each needs a register.
pub const MOST_PARAMETERS: usize = 512;

/// Maximum depth of expressions in an energy whose size is limited: algebra descends into them.
const DEEPEST: usize = 256;

/// The model of a declaration: resolved, checked and differentiated. Its expressions, derivatives included,
/// have at most this size; `None` for no limit except memory. If the declaration has mistakes of form, only
/// its names are resolved and checked.
pub fn read(declaration: &Declaration, diagnostics: &mut Diagnostics, most: Option<usize>) -> Option<Model> {
    let parameters = declaration.parameters.len();
    if most.is_some() && parameters > MOST_PARAMETERS {
        let message = format!(
            "this energy has {parameters} parameters, and one that is compiled at run time at most {MOST_PARAMETERS}: write \
             lists of them, as in `sum(|p| mu[p] * …)`"
        );
        diagnostics.error(&declaration.body, message);
        return None;
    }
    let (graph, is_full) = Graph::with_most(most);
    let deepest = most.map_or(usize::MAX, |_| DEEPEST);
    let model = read_into(graph, declaration, diagnostics, deepest);
    if !is_full.get() {
        return model;
    }
    // What was found of expressions that were left out means nothing.
    *diagnostics = Diagnostics::new(diagnostics.notation());
    let message = "this energy is too large for one that is compiled at run time: write sums over lists as `sum(|p| …)`, and \
                   nest powers and functions less";
    diagnostics.error(&declaration.body, message);
    None
}

/// The stages of a model: names are resolved, forms prepared and derivatives derived; the energy is judged as
/// written before, and by its derivatives after.
fn read_into(
    mut graph: Graph,
    declaration: &Declaration,
    diagnostics: &mut Diagnostics,
    deepest: usize,
) -> Option<Model> {
    let options = &declaration.options;
    let is_well_formed = diagnostics.is_clean();
    let mut resolver = Resolver::new(declaration, &mut graph, diagnostics);
    let energy = resolver.energy();
    let bounds = declaration.bounds().filter_map(|condition| resolver.bound(condition)).collect();
    let constrained: Vec<_> =
        options.admissible.iter().map(|condition| resolver.condition(condition)).collect();
    let restoring = options.extend.iter().flatten().filter_map(|condition| resolver.condition(condition));
    let admissible: Vec<_> = restoring.chain(constrained.iter().copied().flatten()).collect();
    let mut nodes = resolver.nodes;
    if deepest < usize::MAX && graph.depth(&[energy]) > deepest {
        let message = format!("this is nested more than {deepest} deep, names of `let` included");
        diagnostics.error(&declaration.body, message);
        return None;
    }
    let (energy, bounds) = forms::in_squares(&mut graph, energy, bounds, &mut nodes);
    let volume = declaration.volume();
    let (bounds, admissible, notation) = (&bounds[..], &admissible[..], diagnostics.notation());
    let source = Source { declaration, nodes, energy, bounds, admissible, volume, notation };

    let samples = judge::written(&mut graph, &source, is_well_formed, diagnostics)?;
    // For a formula more than one domain is tried, and the mistakes of the last are reported.
    let is_trial =
        diagnostics.notation().is_formula() && (options.domain.is_empty() || options.extend.is_some());
    if is_trial && judge::is_out_of_domain(&graph, &source, &samples) {
        diagnostics.error(&declaration.body, "this has no value, or no continuation, where it is needed");
        return None;
    }
    let prepared = forms::prepare(&mut graph, &source, &samples);
    let (mut model, derived) = derive(graph, &source, constrained, &prepared, samples)?;
    let findings = judge::derived(&mut model.graph, &source, &derived, &model.samples);
    judge::report(findings, diagnostics);
    Some(model)
}

/// All derivatives of an energy in its prepared form, and the subset that is judged; `None` if those by the
/// stretches leave no room for others.
fn derive(
    mut graph: Graph,
    source: &Source<'_>,
    constrained: Vec<Option<Id>>,
    prepared: &Prepared,
    samples: Vec<Point>,
) -> Option<(Model, Derived)> {
    let Source { declaration, energy, volume, .. } = *source;
    let options = &declaration.options;
    let bounds = prepared.bounds.clone();
    let bounds_at_rest = bounds_at_rest(&mut graph, declaration, &bounds, &constrained);
    let plain = variant(&mut graph, prepared.energy, &samples, volume == Volume::Positive);
    if graph.is_full() {
        return None;
    }
    let is_exact = !graph.overflowed();
    let lossy = lossy(&graph, prepared.energy, [&plain.gradient, &plain.blocks()[3..]], &prepared.ways);
    let mut increments = Increments::default();
    let at_strains = plain.gradient.map(|derivative| {
        let increment = increments.increment(&mut graph, derivative);
        if options.prestressed {
            let stress = substitute_rest(&mut graph, derivative);
            graph.add(stress, increment)
        } else {
            increment
        }
    });
    let extended = options.extend.is_some().then(|| {
        let extended = extension::extend(&mut graph, energy);
        variant(&mut graph, extended, &samples, false)
    });
    let moduli = moduli(&mut graph, &plain);
    let derived = Derived {
        gradient: plain.gradient[0],
        hessian: plain.hessian,
        shear: moduli[0],
        continued: extended.as_ref().map(|extended| extended.energy),
        is_exact,
    };
    // By invariants, I1b − 3 is not known well enough for real powers, be they of the energy or of a bound.
    let invariants = resolve::resolve_by_invariants(declaration, &mut graph)
        .filter(|_| !prepared.has_squares)
        .map(|(energy, bounds, has_energy)| {
            let energy = over_one_denominator(&mut graph, energy, &prepared.ways.by_invariants());
            let (gradient, hessian) = derivatives(&mut graph, energy);
            let has_domain = volume != Volume::Any || !bounds.is_empty();
            let energy = with_limits(&mut graph, energy);
            ByInvariants { energy, has_energy, gradient, hessian, bounds, has_domain }
        });
    let moduli = moduli.map(|modulus| expand_products(&mut graph, modulus));
    let units = judge::units_of_parameters(&graph, source);
    let model = Model {
        graph,
        energy,
        plain,
        at_strains,
        extended,
        invariants,
        bounds,
        bounds_at_rest,
        volume,
        units,
        moduli,
        lossy,
        samples,
        constrained,
        programs: FxHashMap::default(),
        collector: Collector::default(),
    };
    Some((model, derived))
}

/// Values at rest of bounds that depend on parameters there, unless a condition on parameters is equivalent.
fn bounds_at_rest(
    graph: &mut Graph,
    declaration: &Declaration,
    bounds: &[Id],
    constrained: &[Option<Id>],
) -> Vec<(usize, Id)> {
    let is_strict = |condition: &Expr| matches!(condition, Expr::Binary(comparison) if matches!(comparison.op, BinOp::Gt(_) | BinOp::Lt(_)));
    let conditions = declaration.options.admissible.iter().zip(constrained);
    let implied: Vec<_> =
        conditions.filter_map(|(condition, &id)| id.filter(|_| is_strict(condition))).collect();
    let is_parameter = |node: &Node| matches!(node, Node::Parameter(_) | Node::Entry(_)) || node.is_call();
    let at_rest: Vec<_> = bounds.iter().map(|&bound| substitute_rest(graph, bound)).enumerate().collect();
    let is_decided = |value: Id| !implied.contains(&value) && graph.contains(value, is_parameter);
    at_rest.into_iter().filter(|&(_, value)| is_decided(value)).collect()
}

/// An energy with its first and second derivatives and quotients.
fn variant(graph: &mut Graph, energy: Id, samples: &[Point], positive: bool) -> Variant {
    let (gradient, hessian) = derivatives(graph, energy);
    let mut quotients = Quotients::new(samples);
    let flip = PAIRS.map(|(i, j)| quotients.quotient(graph, gradient[i], Reflection::Flip(i, j)));
    let twist = PAIRS.map(|(i, j)| quotients.twist(graph, gradient[i], i, j, positive));
    let energy = with_limits(graph, energy);
    let mut evaluated = Evaluated::default();
    let mut evaluated = |id| evaluated.of(graph, id);
    Variant {
        energy: evaluated(energy),
        gradient: gradient.map(&mut evaluated),
        hessian: hessian.map(&mut evaluated),
        flip: flip.map(&mut evaluated),
        twist: twist.map(|(twist, _)| evaluated(twist)),
        has_pole: twist.iter().any(|&(_, has_pole)| has_pole),
    }
}

/// The small-strain moduli μ = (ψ11 − ψ12)/2 and λ = ψ12 at rest.
fn moduli(graph: &mut Graph, plain: &Variant) -> [Id; 2] {
    let [normal, mixed] = [plain.hessian[0], plain.hessian[3]].map(|h| substitute_rest(graph, h));
    let difference = graph.sub(normal, mixed);
    let half = Rational::new(1, 2).unwrap_or(Rational::ONE);
    let shear = graph.scale(difference, half);
    [shear, mixed].map(|modulus| simplify(graph, modulus))
}
