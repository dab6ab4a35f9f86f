//! A material whose responses are programs.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use piola_codegen::read::domain::Volume;

use super::domain::VolumeBound;
use super::execute::{execute_alone, execute_tile};
use super::parameters::{Context, Parameters, Value, are_alike};
use super::program::Program;
use super::registers::Registers;
use crate::lanes::{Mask, Real, Scalar, Truth, stage};
use crate::material::{Blocks, Curvature, Graded, Inversion, Material, Moduli, RawTile, ResponseKind};

/// Programs of an energy and of all its responses.
#[derive(Debug, PartialEq)]
pub struct Programs {
    /// The energy inside its domain.
    pub plain: Variant,
    /// The energy continued beyond J = 0, if it can be.
    pub extended: Option<Variant>,
    /// ψ1, ψ2, ψ3, Pa, from stretches and, as arguments 3 to 5, strains.
    pub at_strains: Program,
    /// Expressions in the stretches that are positive inside the domain, J apart.
    pub bounds: Program,
    /// The volumes of the domain.
    pub volume: Volume,
    /// Programs by I1, I2 and J, if ψ is a function of these alone.
    pub by_invariants: Option<ByInvariants>,
    /// Small-strain μ and λ, Pa.
    pub moduli: Program,
    /// For each parameter, true if it is a whole exponent or a list of whole exponents.
    pub are_whole: Vec<bool>,
}

/// Programs of an energy and its derivatives by the stretches.
#[derive(Debug, PartialEq)]
pub struct Variant {
    /// ψ, Pa.
    pub energy: Program,
    /// ψ1, ψ2, ψ3, Pa.
    pub gradient: Program,
    /// The fifteen components of [`Blocks`], Pa, in the order of its fields.
    pub blocks: Program,
    /// True if a twist has a pole at λi + λj = 0.
    pub has_pole: bool,
}

/// Programs of an energy and its derivatives by I1, I2 and J.
#[derive(Debug, PartialEq)]
pub struct ByInvariants {
    /// ψ, Pa, if it is as accurate as by stretches.
    pub energy: Option<Program>,
    /// W1, W2, WJ, Pa.
    pub gradient: Program,
    /// W1, W2, WJ, W11, W22, WJJ, W12, W1J, W2J, Pa.
    pub derivatives: Program,
    /// Expressions that are positive inside the domain, J apart.
    pub bounds: Program,
    /// True if ψ depends on I2.
    pub has_second_invariant: bool,
    /// Second derivatives that do not vanish everywhere.
    pub curvature: Curvature,
}

/// Material whose energy was declared at run time, made by the crate `piola-declare`.
///
/// It computes what a material compiled from the same declaration does, to the last bit, also behind `dyn`
/// [`DynMaterial`](crate::DynMaterial). Batches and bodies execute each operation for a tile of 64 points
/// before the next, which costs little compared with the operation. A single point takes up to three times as
/// long as compiled.
#[derive(Clone, Debug)]
pub struct Interpreted {
    /// Identity of the parameter values; shared by clones.
    number: u64,
    programs: Arc<Programs>,
    values: Vec<Value>,
    inversion: Inversion,
}

impl PartialEq for Interpreted {
    fn eq(&self, other: &Self) -> bool {
        self.is_of_the_same_energy(other) && self.values == other.values && self.inversion == other.inversion
    }
}

impl Interpreted {
    /// The material with these values, which have been checked, and without extension.
    #[doc(hidden)]
    #[must_use]
    pub fn new(programs: Arc<Programs>, values: Vec<Value>, inversion: Inversion) -> Self {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        Self { number, programs, values, inversion }
    }

    /// The values of the parameters, in the order of the declaration.
    #[doc(hidden)]
    #[must_use]
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// The material of the same energy with other values, which are not checked.
    #[doc(hidden)]
    #[must_use]
    pub fn clone_with(&self, values: Vec<Value>) -> Self {
        Self::new(self.programs.clone(), values, self.inversion)
    }

    /// Executes a program of numbers that depend on the parameters and on these arguments alone, at the entry
    /// of lists that it reads outside of sums.
    #[doc(hidden)]
    #[must_use]
    pub fn compute(&self, program: &Program, arguments: &[f64], entry: usize) -> Vec<f64> {
        let context = Context { material: None, entry, ..self.context() };
        execute_at(program, context, arguments, |registers| {
            program.results.iter().map(|&register| registers.number(register)).collect()
        })
    }

    fn context(&self) -> Context<'_> {
        let epsilon = match self.inversion {
            Inversion::Refuse => f64::NAN,
            Inversion::Extend { epsilon } => epsilon,
        };
        Context { material: Some(self.number), parameters: Parameters::same(&self.values), entry: 0, epsilon }
    }

    fn is_of_the_same_energy(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.programs, &other.programs) || self.programs == other.programs
    }

    /// The programs in use.
    fn variant(&self) -> &Variant {
        match (&self.programs.extended, self.inversion) {
            (Some(extended), Inversion::Extend { .. }) => extended,
            _ => &self.programs.plain,
        }
    }

    /// The program of a response, if there is one, with the name of its stage.
    fn program(&self, response: ResponseKind) -> Option<(&'static str, &Program)> {
        let (variant, by_invariants) = (self.variant(), self.programs.by_invariants.as_ref());
        Some(match response {
            ResponseKind::Energy => ("energy_of_stretches", &variant.energy),
            ResponseKind::Gradient => ("gradient", &variant.gradient),
            ResponseKind::Blocks => ("blocks_of_stretches", &variant.blocks),
            ResponseKind::EnergyByInvariants => ("energy_by_invariants", by_invariants?.energy.as_ref()?),
            ResponseKind::GradientByInvariants => ("gradient_by_invariants", &by_invariants?.gradient),
            ResponseKind::DerivativesByInvariants => {
                ("derivatives_by_invariants", &by_invariants?.derivatives)
            }
        })
    }

    /// The results of a response at one point, or one register of them.
    fn alone<R: Real, const N: usize>(&self, response: ResponseKind, at: [R; 3]) -> [R; N] {
        match self.program(response) {
            None => [R::splat(f64::NAN); N],
            Some((name, program)) => stage!(R, name, (at) => self.results(program, &at)),
        }
    }

    fn results<R: Real, const N: usize>(&self, program: &Program, arguments: &[R]) -> [R; N] {
        execute_at(program, self.context(), arguments, |registers| {
            std::array::from_fn(|k| registers.number(program.results[k]))
        })
    }

    /// The volumes inside the domain, by stretches or by invariants.
    fn volume(&self, is_by_invariants: bool) -> VolumeBound {
        VolumeBound { volume: self.programs.volume, inversion: self.inversion, is_by_invariants }
    }

    fn admits_alone<R: Real>(&self, is_by_invariants: bool, at: [R; 3]) -> R::Mask {
        let bounds = match (is_by_invariants, &self.programs.by_invariants) {
            (false, _) => &self.programs.bounds,
            (true, Some(programs)) => &programs.bounds,
            (true, None) => return R::Mask::splat(false),
        };
        let name = if is_by_invariants { "admits_invariants" } else { "admits" };
        stage!(R, name, (at) => Truth(execute_at(bounds, self.context(), &at, |registers| {
            let holds = bounds.results.iter().map(|&bound| R::splat(0.0).less(registers.number(bound)));
            holds.fold(self.volume(is_by_invariants).holds(at), |all, one| all & one)
        })))
        .0
    }

    /// A response of a tile whose points have this material except for real numbers among its parameters.
    /// Returns the points inside the domain as bits.
    fn respond<E: Scalar>(
        &self,
        response: ResponseKind,
        parameters: Parameters<'_>,
        tile: RawTile<'_, E>,
    ) -> u64 {
        let Some((_, program)) = self.program(response) else { return 0 };
        let context = Context { parameters, ..self.context() };
        execute_tile(program, context, self.volume(response.is_by_invariants()), tile)
    }
}

/// Executes a program for one point, or one register of points, and reads its registers.
fn execute_at<R: Real, T>(
    program: &Program,
    context: Context<'_>,
    arguments: &[R],
    read: impl FnOnce(&Registers<R>) -> T,
) -> T {
    let mut registers = Registers::take(program, &context, 1);
    execute_alone(program, context, arguments, &mut registers);
    let results = read(&registers);
    registers.give_back();
    results
}

impl Material for Interpreted {
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        let [energy] = self.alone(ResponseKind::Energy, stretches);
        energy
    }

    fn gradient<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
        self.alone(ResponseKind::Gradient, stretches)
    }

    fn gradient_at_strains<R: Real>(&self, strains: [R; 3]) -> [R; 3] {
        let stretches = strains.map(|strain| R::splat(1.0) + strain);
        let [[l1, l2, l3], [s1, s2, s3]] = [stretches, strains];
        let inside = self.results(&self.programs.at_strains, &[l1, l2, l3, s1, s2, s3]);
        if let (Inversion::Extend { epsilon }, Some(_)) = (self.inversion, &self.programs.extended) {
            let below = s3.less(R::splat(epsilon - 1.0));
            if below.any() {
                let extended = self.gradient(stretches);
                return std::array::from_fn(|k| R::select(below, extended[k], inside[k]));
            }
        }
        inside
    }

    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        let all: [R; 15] = self.alone(ResponseKind::Blocks, stretches);
        Blocks {
            gradient: std::array::from_fn(|k| all[k]),
            hessian: std::array::from_fn(|k| all[3 + k]),
            flip: std::array::from_fn(|k| all[9 + k]),
            twist: std::array::from_fn(|k| all[12 + k]),
        }
    }

    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        self.admits_alone(false, stretches)
    }

    fn has_invariants(&self) -> bool {
        self.programs.by_invariants.is_some()
    }

    fn has_second_invariant(&self) -> bool {
        self.programs.by_invariants.as_ref().is_none_or(|programs| programs.has_second_invariant)
    }

    fn curvature_by_invariants(&self) -> Curvature {
        self.programs.by_invariants.as_ref().map_or(Curvature::All, |programs| programs.curvature)
    }

    fn has_energy_by_invariants(&self) -> bool {
        self.programs.by_invariants.as_ref().is_some_and(|programs| programs.energy.is_some())
    }

    fn energy_by_invariants<R: Real>(&self, invariants: [R; 3]) -> R {
        let [energy] = self.alone(ResponseKind::EnergyByInvariants, invariants);
        energy
    }

    fn gradient_by_invariants<R: Real>(&self, invariants: [R; 3]) -> [R; 3] {
        self.alone(ResponseKind::GradientByInvariants, invariants)
    }

    fn derivatives_by_invariants<R: Real>(&self, invariants: [R; 3]) -> [R; 9] {
        self.alone(ResponseKind::DerivativesByInvariants, invariants)
    }

    fn admits_invariants<R: Real>(&self, invariants: [R; 3]) -> R::Mask {
        self.admits_alone(true, invariants)
    }

    fn has_pole(&self) -> bool {
        self.variant().has_pole
    }

    fn ends_at_zero_volume(&self) -> bool {
        let is_refused = self.inversion == Inversion::Refuse || self.programs.extended.is_none();
        let has_functions = self.values.iter().any(|value| matches!(value, Value::Function(_)));
        self.programs.volume == Volume::Positive && is_refused
            || has_functions && crate::material::constructor::sign_decides(self)
    }

    fn inversion(&self) -> Inversion {
        self.inversion
    }

    fn stated_moduli(&self) -> Option<Moduli> {
        let moduli = self.compute(&self.programs.moduli, &[], 0);
        Some(Moduli { mu: moduli[0], lambda: moduli[1] })
    }

    const RESPONDS_TOGETHER: bool = true;

    fn respond_together<'m, E: Scalar>(
        material: impl Fn(usize) -> &'m Self + Copy,
        response: ResponseKind,
        tile: RawTile<'_, E>,
    ) -> u64 {
        let first = material(0);
        let mut others = (1..tile.materials).map(material);
        if others.all(|other| std::ptr::eq(other, first) || other == first) {
            return first.respond(response, Parameters::same(&first.values), tile);
        }
        // They differ in real numbers only. Lanes beyond the points have the values of the last.
        let last = tile.materials - 1;
        let each = |point: usize| material(point.min(last)).values();
        let parameters = Parameters { each: Some(&each), ..Parameters::same(&first.values) };
        first.respond(response, parameters, tile)
    }
}

impl Graded for Interpreted {
    type OnLanes<'a> = &'a Self;

    fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes<'a> {
        material(0)
    }

    /// True if both differ in real numbers only.
    fn shares_lanes(&self, other: &Self) -> bool {
        let is_alike = || are_alike(&self.values, &other.values, &self.programs.are_whole);
        std::ptr::eq(self, other) || self.is_of_the_same_energy(other) && is_alike()
    }
}
