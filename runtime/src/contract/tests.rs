//! The contract must pass what is right and name what is wrong.

use super::*;
use crate::hand_written::{ExtendedNeoHookean, NeoHookean, RotatedLinear, SaintVenantKirchhoff};
use crate::lanes::Real;
use crate::material::PAIRS;

#[track_caller]
fn check_passes(material: &impl Material, settings: &Settings) {
    match check(material, settings) {
        Ok(report) => {
            for finding in &report.findings {
                assert!(finding.comparisons >= 12 && finding.worst <= 1.0, "{finding:?}");
            }
        }
        Err(violation) => panic!("{violation}"),
    }
}

#[test]
fn right_materials_pass() {
    for seed in 0..20 {
        let settings = Settings { seed, ..Settings::default() };
        check_passes(&SaintVenantKirchhoff, &settings);
        check_passes(&NeoHookean, &settings);
        check_passes(&RotatedLinear, &settings);
        for epsilon in [0.1, 0.3, 0.7] {
            let settings = Settings { threshold: Some(epsilon), ..settings.clone() };
            check_passes(&ExtendedNeoHookean { epsilon }, &settings);
        }
    }
}

/// What can be wrong with a material.
#[derive(Clone, Copy)]
enum Defect {
    PrestressOfOnePart,
    StressTooLargeByAMillionth,
    HessianTooLargeByAMillionth,
    LimitBelowAGap,
    VanishingShearAtTheGap,
    NaiveTwist,
    PrefersFirstStretch,
    JumpingCurvature,
    AttractsCollapse,
}

struct Defective<M>(M, Defect);

impl<M: Material> Material for Defective<M> {
    fn energy<R: Real>(&self, l: [R; 3]) -> R {
        let right = self.0.energy(l);
        match self.1 {
            Defect::PrestressOfOnePart => right + l[0] + l[1] + l[2],
            Defect::PrefersFirstStretch => right + quartic(l[0])[0],
            Defect::AttractsCollapse => right + R::splat(100.0) * below(l[2]) * below(l[2]) * below(l[2]),
            _ => right,
        }
    }

    fn gradient<R: Real>(&self, l: [R; 3]) -> [R; 3] {
        self.blocks(l).gradient
    }

    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let mut blocks = self.0.blocks(l);
        let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
        let gradient = blocks.gradient;
        let (diagonal, mixed) = ([h11, h22, h33], [h12, h13, h23]);
        match self.1 {
            Defect::PrestressOfOnePart => blocks.gradient = gradient.map(|g| g + R::splat(1.0)),
            Defect::StressTooLargeByAMillionth => {
                blocks.gradient = gradient.map(|g| g * R::splat(1.0 + 1e-6))
            }
            Defect::HessianTooLargeByAMillionth => {
                // Not at rest, where the flip would give it away at once.
                let strain = l[0] * l[1] * l[2] - R::splat(1.0);
                blocks.hessian =
                    blocks.hessian.map(|h| h * (R::splat(1.0) + R::splat(1e-6) * strain * strain));
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
                for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
                    blocks.twist[pair] = (gradient[i] + gradient[j]) / (l[i] + l[j]);
                }
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
        }
        blocks
    }

    fn admits<R: Real>(&self, l: [R; 3]) -> R::Mask {
        self.0.admits(l)
    }

    fn has_pole(&self) -> bool {
        self.0.has_pole()
    }

    fn ends_at_zero_volume(&self) -> bool {
        self.0.ends_at_zero_volume()
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

#[track_caller]
fn check_names(
    material: impl Material,
    defect: Defect,
    threshold: Option<f64>,
    expected: Rule,
    component: &str,
) {
    let settings = Settings { threshold, ..Settings::default() };
    let violation = check(&Defective(material, defect), &settings).expect_err("a defect went unnoticed");
    let (Violation::Differs { rule, component: found, .. }
    | Violation::WrongSign { rule, component: found, .. }) = &violation
    else {
        panic!("{violation}");
    };
    assert_eq!(*rule, expected, "{violation}");
    assert!(found.contains(component), "{violation}");
}

#[test]
fn defects_are_named() {
    let extended = || ExtendedNeoHookean { epsilon: 0.3 };
    check_names(
        NeoHookean,
        Defect::PrestressOfOnePart,
        None,
        Rule::Rest,
        "derivative of the energy by stretch 1",
    );
    check_names(NeoHookean, Defect::StressTooLargeByAMillionth, None, Rule::StressSlope, "energy");
    check_names(NeoHookean, Defect::HessianTooLargeByAMillionth, None, Rule::TangentSlope, "stress");
    check_names(NeoHookean, Defect::LimitBelowAGap, None, Rule::Quotients, "flip");
    check_names(NeoHookean, Defect::VanishingShearAtTheGap, None, Rule::Rest, "flip");
    check_names(SaintVenantKirchhoff, Defect::NaiveTwist, None, Rule::Quotients, "twist");
    check_names(NeoHookean, Defect::PrefersFirstStretch, None, Rule::Isotropy, "stretch 2");
    check_names(extended(), Defect::JumpingCurvature, Some(0.3), Rule::TangentSlope, "stress");
    check_names(extended(), Defect::AttractsCollapse, Some(0.3), Rule::Extension, "stretch 3");
}

#[test]
fn a_material_that_admits_nothing_is_not_called_right() {
    let settings = Settings { range: (3.0, 4.0), points: 0, ..Settings::default() };
    assert_eq!(
        objectivity(&NeoHookean, &settings),
        Err(Violation::NothingToCheck { rule: Rule::Objectivity })
    );
}

#[test]
fn violations_read_as_sentences() {
    let violation = Violation::Differs {
        rule: Rule::Quotients,
        component: pair_name("flip", 0),
        stretches: [1.5, 1.5, 0.5],
        found: 0.0,
        expected: 2.0,
        tolerance: 1e-14,
    };
    assert_eq!(
        violation.to_string(),
        "quotients: the flip of stretches 1 and 2 at stretches (1.5, 1.5, 0.5) is 0e0 and should be 2e0; \
         rounding explains a difference of 1e-14"
    );
}
