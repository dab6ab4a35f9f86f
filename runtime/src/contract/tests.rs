//! The contract must accept correct materials and name the mistakes of wrong ones.

use super::*;
use crate::hand_written::{ExtendedNeoHookean, NeoHookean, RotatedLinear, SaintVenantKirchhoff};
use crate::lanes::{Mask, Real};
use crate::material::{Curvature, Moduli, PAIRS};

#[track_caller]
fn check_passes(material: &impl Material, settings: &Settings) {
    match check(material, settings) {
        Ok(report) => {
            for finding in &report.findings {
                assert!(finding.comparisons >= 12 && finding.worst <= 1.0, "{finding:?}");
            }
        }
        Err(violations) => panic!("{violations}"),
    }
}

#[test]
fn right_materials_pass() {
    for seed in 0..20 {
        let settings = Settings { seed, ..Settings::default() };
        check_passes(&SaintVenantKirchhoff, &settings);
        check_passes(&NeoHookean, &settings);
        check_passes(&RotatedLinear, &settings);
        check_passes(&by_invariants(-0.5, 0.875, Curvature::Separate), &settings);
        for epsilon in [0.1, 0.3, 0.7] {
            check_passes(&ExtendedNeoHookean { epsilon }, &settings);
        }
    }
}

/// Defects that a material can have.
#[derive(Clone, Copy)]
enum Defect {
    /// Stress at rest in every part: a defect only if the rest state must be free of stress.
    Prestress,
    PrestressOfOnePart,
    StressTooLargeByAMillionth,
    HessianTooLargeBy(f64),
    LimitBelowAGap,
    VanishingShearAtTheGap,
    NaiveTwist,
    PrefersFirstStretch,
    JumpingCurvature,
    AttractsCollapse,
    LinearInStrains,
    OverstatedShear,
    ConstantOfSinglePrecision,
    AnyLaneDecides,
    JumpingEnergy,
    LimitWhereAllAreClose,
    DeniesItsEnd,
    EndsAtInversion,
    OverflowsInExtension,
    EnergyLosesDigits,
    CurvatureWithoutValue,
    /// An energy that has no value below I1 = 3, or one of −∞.
    EnergyOfShortStretches(f64),
    /// Σ f(λ) with f′ = 1 + c λ instead, which pulls elements flat, and which only claims to be extended.
    PullsBy(f64),
    /// [`SaintVenantKirchhoff`] in I1 and I2 with these W2 and W11: −1/2 and 7/8 are right, and that W11 does
    /// not vanish.
    Invariants(f64, f64, Curvature),
}

struct Defective<M>(M, Defect);

impl<M: Material> Material for Defective<M> {
    fn energy<R: Real>(&self, l: [R; 3]) -> R {
        let right = self.0.energy(l);
        match self.1 {
            Defect::Prestress | Defect::PrestressOfOnePart => right + l[0] + l[1] + l[2],
            Defect::PrefersFirstStretch => right + quartic(l[0])[0],
            Defect::JumpingEnergy => {
                right + R::select(l[2].less(R::splat(0.8)), R::splat(1e-6), R::splat(0.0))
            }
            Defect::OverflowsInExtension => {
                R::select(l[2].less(R::splat(-0.1)), R::splat(f64::INFINITY), right)
            }
            Defect::EnergyLosesDigits => {
                // Zero up to rounding, which depends on the last digit of the stretch.
                let root = l[0].sqrt();
                right + R::splat(1e6) * (root * root - l[0])
            }
            Defect::AttractsCollapse => right + R::splat(100.0) * below(l[2]) * below(l[2]) * below(l[2]),
            Defect::EnergyOfShortStretches(energy) => {
                let is_short = (l[0] * l[0] + l[1] * l[1] + l[2] * l[2]).less(R::splat(3.0));
                R::select(is_short, R::splat(energy), right)
            }
            Defect::PullsBy(c) => {
                let [e1, e2, e3] = l.map(|l| l * (R::splat(1.0) + R::splat(0.5 * c) * l));
                e1 + e2 + e3
            }
            _ => right,
        }
    }

    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let mut blocks = self.0.blocks(l);
        let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
        let gradient = blocks.gradient;
        let (diagonal, mixed) = ([h11, h22, h33], [h12, h13, h23]);
        match self.1 {
            Defect::Prestress => {
                blocks.gradient = gradient.map(|g| g + R::splat(1.0));
                for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
                    blocks.twist[pair] = blocks.twist[pair] + R::splat(2.0) / (l[i] + l[j]);
                }
            }
            Defect::PrestressOfOnePart => blocks.gradient = gradient.map(|g| g + R::splat(1.0)),
            Defect::StressTooLargeByAMillionth => {
                blocks.gradient = gradient.map(|g| g * R::splat(1.0 + 1e-6))
            }
            Defect::HessianTooLargeBy(share) => {
                // Not at rest, where the flip would give it away at once.
                let strain = l[0] * l[1] * l[2] - R::splat(1.0);
                blocks.hessian =
                    blocks.hessian.map(|h| h * (R::splat(1.0) + R::splat(share) * strain * strain));
            }
            Defect::LimitBelowAGap | Defect::VanishingShearAtTheGap => {
                for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
                    let gap = l[i] - l[j];
                    let limit = diagonal[i] - mixed[pair];
                    let vanishing = gap * (gradient[i] - gradient[j]) / (gap * gap + R::splat(1e-12));
                    let close = if matches!(self.1, Defect::LimitBelowAGap) { limit } else { vanishing };
                    blocks.flip[pair] = R::select(gap.less(R::splat(1e-6)), close, blocks.flip[pair]);
                }
            }
            Defect::NaiveTwist => {
                blocks.twist = PAIRS.map(|(i, j)| (gradient[i] + gradient[j]) / (l[i] + l[j]));
            }
            Defect::PrefersFirstStretch => {
                blocks.gradient[0] = gradient[0] + quartic(l[0])[1];
                blocks.hessian[0] = h11 + quartic(l[0])[2];
            }
            Defect::JumpingCurvature => {
                blocks.hessian[2] = R::select(l[2].less(R::splat(0.3)), h33 * R::splat(1.01), h33);
            }
            Defect::AttractsCollapse => {
                let slope = R::splat(300.0) * below(l[2]) * below(l[2]);
                blocks.gradient[2] = gradient[2] + slope;
                blocks.hessian[2] = h33 + R::splat(600.0) * below(l[2]);
                // Below 0.3 the third stretch is far from the others in all samples.
                for (pair, other) in [(1, l[0]), (2, l[1])] {
                    let over =
                        |distance: R| R::select(l[2].less(R::splat(0.3)), slope / distance, R::splat(0.0));
                    blocks.flip[pair] = blocks.flip[pair] - over(other - l[2]);
                    blocks.twist[pair] = blocks.twist[pair] + over(other + l[2]);
                }
            }
            Defect::ConstantOfSinglePrecision if R::UNIT_ROUNDOFF > 1e-10 => {
                blocks.twist = blocks.twist.map(|twist| twist * R::splat(1.0 + 1e-4));
            }
            // By less than any other rule could detect.
            Defect::AnyLaneDecides if l[2].less(R::splat(0.6)).any() => {
                blocks.hessian[0] = h11 * R::splat(1.0 + 4.0 * UNIT);
            }
            Defect::LimitWhereAllAreClose => {
                let close = (l[0] - l[2]).less(R::splat(1e-6));
                // A limit for l[0] = l[2] = 1.
                blocks.flip[1] = R::select(close, (diagonal[0] - mixed[1]) * l[1], blocks.flip[1]);
            }
            Defect::CurvatureWithoutValue => {
                blocks.hessian[0] = R::select(l[0].less(R::splat(1.5)), R::splat(f64::NAN), h11);
            }
            Defect::PullsBy(c) => {
                let (c, zero) = (R::splat(c), R::splat(0.0));
                let gradient = l.map(|l| R::splat(1.0) + c * l);
                blocks = Blocks {
                    gradient,
                    hessian: [c, c, c, zero, zero, zero],
                    flip: [c; 3],
                    twist: PAIRS.map(|(i, j)| (gradient[i] + gradient[j]) / (l[i] + l[j])),
                };
            }
            _ => {}
        }
        blocks
    }

    fn gradient_at_strains<R: Real>(&self, s: [R; 3]) -> [R; 3] {
        match self.1 {
            Defect::LinearInStrains => {
                let Moduli { mu, lambda } = Moduli::at_rest(&self.0);
                let pressure = R::splat(lambda) * (s[0] + s[1] + s[2]);
                s.map(|s| R::splat(2.0 * mu) * s + pressure)
            }
            _ => self.gradient(s.map(|s| R::splat(1.0) + s)),
        }
    }

    fn admits<R: Real>(&self, l: [R; 3]) -> R::Mask {
        match self.1 {
            Defect::EndsAtInversion => R::splat(0.0).less(l[2]),
            _ => self.0.admits(l),
        }
    }

    fn has_pole(&self) -> bool {
        self.0.has_pole()
    }

    fn ends_at_zero_volume(&self) -> bool {
        self.0.ends_at_zero_volume() && !matches!(self.1, Defect::DeniesItsEnd)
    }

    fn inversion(&self) -> Inversion {
        match self.1 {
            Defect::PullsBy(_) => Inversion::Extend { epsilon: 0.3 },
            _ => self.0.inversion(),
        }
    }

    fn stated_moduli(&self) -> Option<Moduli> {
        let Moduli { mu, lambda } = Moduli::at_rest(&self.0);
        matches!(self.1, Defect::OverstatedShear).then_some(Moduli { mu: 1.001 * mu, lambda })
    }

    fn has_invariants(&self) -> bool {
        matches!(self.1, Defect::Invariants(..))
    }

    fn curvature_by_invariants(&self) -> Curvature {
        match self.1 {
            Defect::Invariants(_, _, curvature) => curvature,
            _ => Curvature::All,
        }
    }

    /// Energy with μ = 1 and λ = 3/2: (I1² − 2 I2 − 2 I1 + 3)/4 + 3/16 (I1 − 3)².
    fn energy_by_invariants<R: Real>(&self, [i1, i2, _]: [R; 3]) -> R {
        let (two, three) = (R::splat(2.0), R::splat(3.0));
        let trace = i1 - three;
        (i1 * i1 - two * i2 - two * i1 + three) * R::splat(0.25) + R::splat(0.1875) * trace * trace
    }

    fn gradient_by_invariants<R: Real>(&self, invariants: [R; 3]) -> [R; 3] {
        let [w1, w2, wj, ..] = self.derivatives_by_invariants(invariants);
        [w1, w2, wj]
    }

    fn derivatives_by_invariants<R: Real>(&self, [i1, _, _]: [R; 3]) -> [R; 9] {
        let Defect::Invariants(w2, w11, _) = self.1 else { return [R::splat(f64::NAN); 9] };
        let w1 = (i1 - R::splat(1.0)) * R::splat(0.5) + (i1 - R::splat(3.0)) * R::splat(0.375);
        let zero = R::splat(0.0);
        [w1, R::splat(w2), zero, R::splat(w11), zero, zero, zero, zero, zero]
    }

    fn admits_invariants<R: Real>(&self, _: [R; 3]) -> R::Mask {
        R::Mask::splat(self.has_invariants())
    }
}

/// (x − 1)⁴ and its derivatives, invisible at rest.
fn quartic<R: Real>(x: R) -> [R; 3] {
    let t = x - R::splat(1.0);
    [t * t * t * t, R::splat(4.0) * t * t * t, R::splat(12.0) * t * t]
}

/// min(x − 0.3, 0).
fn below<R: Real>(x: R) -> R {
    (x - R::splat(0.3)).min(R::splat(0.0))
}

fn by_invariants(w2: f64, w11: f64, curvature: Curvature) -> Defective<SaintVenantKirchhoff> {
    Defective(SaintVenantKirchhoff, Defect::Invariants(w2, w11, curvature))
}

#[track_caller]
fn check_names(material: &impl Material, expected: Rule, component: &str) {
    let verdict = check_rule(expected, material, &Settings::default()).expect("a rule that applies");
    let violation = verdict.expect_err("a defect went unnoticed");
    let text = violation.to_string();
    let found = text.lines().find(|line| line.starts_with("    component   "));
    assert!(found.is_some_and(|found| found.contains(component)), "{violation}");
}

/// Checks as [`check_names`] does, and that no other rule fails.
#[track_caller]
fn check_names_alone(material: &impl Material, expected: Rule, component: &str) {
    check_names(material, expected, component);
    let violations = check(material, &Settings::default()).expect_err("a defect went unnoticed");
    assert_eq!(violations.0.len(), 1, "{violations}");
}

#[test]
fn defects_are_named() {
    for (defect, rule, component) in [
        (Defect::PrestressOfOnePart, Rule::Rest, "derivative of the energy by stretch 1"),
        (Defect::StressTooLargeByAMillionth, Rule::StressSlope, "energy"),
        (Defect::HessianTooLargeBy(1e-6), Rule::TangentSlope, "stress"),
        (Defect::HessianTooLargeBy(1e-9), Rule::DualNumbers, "second derivative"),
        (Defect::LimitBelowAGap, Rule::Quotients, "flip of stretches 1 and 2, which are 1e-7 of their mean"),
        (Defect::VanishingShearAtTheGap, Rule::Rest, "flip"),
        (Defect::PrefersFirstStretch, Rule::Isotropy, "stretch 2"),
        (Defect::EnergyLosesDigits, Rule::Isotropy, "energy after a rotation"),
        (Defect::CurvatureWithoutValue, Rule::Domain, "second derivative"),
    ] {
        check_names(&Defective(NeoHookean, defect), rule, component);
    }
    let extended = |defect| Defective(ExtendedNeoHookean { epsilon: 0.3 }, defect);
    check_names(&extended(Defect::JumpingCurvature), Rule::TangentSlope, "stress");
    check_names(&extended(Defect::AttractsCollapse), Rule::Extension, "stretch 3");
    check_names(&Defective(SaintVenantKirchhoff, Defect::NaiveTwist), Rule::Quotients, "twist");
    // Points take their stress from W2 as well, and other rules see that.
    check_names(&by_invariants(0.5, 0.875, Curvature::Separate), Rule::Invariants, "by invariants");
}

#[test]
fn defects_that_one_rule_sees_are_named_by_it() {
    let second = "second derivative of the energy by stretch 1";
    for (defect, rule, component) in [
        (Defect::LinearInStrains, Rule::Strains, "from the strain"),
        (Defect::OverstatedShear, Rule::Moduli, "shear modulus"),
        (Defect::ConstantOfSinglePrecision, Rule::SinglePrecision, "twist of stretches 1 and 2 in `f32`"),
        (Defect::AnyLaneDecides, Rule::Lanes, &*format!("{second} on the portable back end")),
        (Defect::JumpingEnergy, Rule::StressSlope, "energy"),
        (Defect::DeniesItsEnd, Rule::Domain, "ends_at_zero_volume"),
        (Defect::LimitWhereAllAreClose, Rule::Quotients, "flip of stretches 1 and 3, which are 1e-"),
    ] {
        check_names_alone(&Defective(NeoHookean, defect), rule, component);
    }
    let pole = "twist of stretches 2 and 3 at a pole";
    check_names_alone(&Defective(RotatedLinear, Defect::NaiveTwist), Rule::Quotients, pole);
    let (wrong, vanishing) =
        (by_invariants(-0.5, 0.5, Curvature::Separate), by_invariants(-0.5, 0.875, Curvature::Volume));
    check_names_alone(&wrong, Rule::Invariants, &format!("{second}, from those by invariants"));
    let component = "vanishing of W11, as `curvature_by_invariants` says";
    check_names_alone(&vanishing, Rule::Invariants, component);
}

#[test]
fn stress_at_rest_that_is_meant_is_no_defect() {
    let prestressed = || Defective(NeoHookean, Defect::Prestress);
    check_names_alone(&prestressed(), Rule::Rest, "derivative of the energy by stretch 1");
    let meant = Settings { stress_free_at_rest: false, ..Settings::default() };
    check(&prestressed(), &meant).unwrap_or_else(|violations| panic!("{violations}"));
    // Other defects are still found, at rest as elsewhere.
    for (defect, rule) in [
        (Defect::StressTooLargeByAMillionth, Rule::StressSlope),
        (Defect::HessianTooLargeBy(1e-6), Rule::TangentSlope),
        (Defect::VanishingShearAtTheGap, Rule::Rest),
    ] {
        let verdict = check_rule(rule, &Defective(prestressed(), defect), &meant);
        assert!(matches!(verdict, Some(Err(_))), "{rule}: {verdict:?}");
    }
}

#[test]
fn what_a_material_has_not_is_not_asked_for() {
    let settings = Settings { points: 8, ..Settings::default() };
    for rule in Rule::ALL {
        let has_subject = !matches!(rule, Rule::Extension | Rule::Invariants | Rule::Moduli);
        assert_eq!(check_rule(rule, &NeoHookean, &settings).is_some(), has_subject, "{rule}");
    }
    let extended = ExtendedNeoHookean { epsilon: 0.3 };
    assert!(check_rule(Rule::Extension, &extended, &settings).is_some());
    let with_invariants = by_invariants(-0.5, 0.875, Curvature::Separate);
    assert!(check_rule(Rule::Invariants, &with_invariants, &settings).is_some());
}

mod messages;

mod one_line {
    use super::*;

    crate::contract!(neo_hookean: NeoHookean);
    crate::contract!(
        extended: { ExtendedNeoHookean { epsilon: 0.25 } },
        range: (0.3, 3.0),
        points: 16,
    );

    #[test]
    fn every_rule_is_a_test() {
        assert_eq!(neo_hookean::TESTS.map(|(rule, _)| rule), Rule::ALL);
        for rule in Rule::ALL {
            let test = format!(" {rule}: {rule:?},\n");
            assert!(include_str!("one_line.rs").contains(&test), "there is no test `{test}`");
        }
    }

    // Inside a function, what the macro writes is not a test of this crate, and may fail.
    #[test]
    fn tests_fail_where_their_rule_is_broken_and_nowhere_else() {
        crate::contract!(overstated: Defective(NeoHookean, Defect::OverstatedShear), points: 8);
        for (rule, test) in overstated::TESTS {
            let message = failure(test);
            assert_eq!(message.is_some(), rule == Rule::Moduli, "{rule}: {message:?}");
            assert!(message.is_none_or(|message| message.contains("component   shear modulus")));
        }
    }

    #[test]
    fn tests_fail_where_there_is_no_material() {
        crate::contract!(refused: no_rubber()?);
        crate::contract!(panicking: no_rubber().expect("a material"));
        for (rule, test) in refused::TESTS.into_iter().chain(panicking::TESTS) {
            assert!(failure(test).is_some_and(|message| message.contains("no such rubber")), "{rule}");
        }
    }

    fn no_rubber() -> Result<NeoHookean, &'static str> {
        Err("no such rubber")
    }

    /// Panic message of a test, if it panics.
    fn failure(test: fn()) -> Option<String> {
        let panic = std::panic::catch_unwind(test).err()?;
        Some(*panic.downcast::<String>().expect("a formatted message"))
    }
}
