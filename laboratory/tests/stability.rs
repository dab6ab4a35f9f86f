//! Stability of energies of the catalogue, compared with searches and published results.

use piola::__private::random::Random;
use piola::material::{Blocks, Moduli};
use piola_laboratory::Specimen;
use piola_laboratory::chart::map;
use piola_laboratory::stability::criteria::{Criterion, Judgement};
use piola_laboratory::stability::wave::slowest;
use piola_laboratory::stability::*;
use piola_materials::{Fung, Gent, NeoHookean, Ogden, StVenantKirchhoff};

// Energies that the catalogue does not compile by default, from their files.
#[path = "../../materials/src/blatz_ko.rs"]
mod blatz_ko;
#[path = "../../materials/src/ciarlet_geymonat.rs"]
mod ciarlet_geymonat;
#[path = "../../materials/src/hencky.rs"]
mod hencky;

use blatz_ko::BlatzKo;
use ciarlet_geymonat::CiarletGeymonat;
use hencky::Hencky;

type Tested = Result<(), Box<dyn std::error::Error>>;

/// (m ⊗ N) : dP/dF (m ⊗ N) between the principal frames, by the map of `piola::point`.
fn modulus(blocks: &Blocks<f64>, m: [f64; 3], n: [f64; 3]) -> f64 {
    let dyad = std::array::from_fn(|i| std::array::from_fn(|j| m[i] * n[j]));
    let change = blocks.apply(&dyad);
    (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| dyad[i][j] * change[i][j]).sum()
}

/// The least eigenvalue of the acoustic tensor Q(N).
fn least_of(blocks: &Blocks<f64>, n: [f64; 3]) -> f64 {
    let mut q = nalgebra::Matrix3::<f64>::zeros();
    for i in 0..3 {
        let dyad: [[f64; 3]; 3] = std::array::from_fn(|k| if k == i { n } else { [0.0; 3] });
        let change = blocks.apply(&dyad);
        for k in 0..3 {
            q[(k, i)] = (0..3).map(|l| change[k][l] * n[l]).sum();
        }
    }
    q.symmetric_eigenvalues().min()
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / norm)
}

/// The wave of the least modulus by search: all N of a grid over half the sphere, then ever smaller steps
/// around the best. It shares nothing with the closed form.
fn searched(blocks: &Blocks<f64>) -> f64 {
    const STEPS: i32 = 10;
    let mut best = (f64::INFINITY, [0.0; 3]);
    let mut meet = |n: [f64; 3]| {
        let n = unit(n);
        let value = least_of(blocks, n);
        if value < best.0 {
            best = (value, n);
        }
        best
    };
    for x in -STEPS..=STEPS {
        for y in -STEPS..=STEPS {
            // The three faces of a cube that have one of each pair of opposite directions.
            let (x, y) = (f64::from(x) / f64::from(STEPS), f64::from(y) / f64::from(STEPS));
            for n in [[1.0, x, y], [y, 1.0, x], [x, y, 1.0]] {
                meet(n);
            }
        }
    }
    let mut step = 1.0 / f64::from(STEPS);
    let (mut value, mut n) = meet([1.0, 0.0, 0.0]);
    while step > 1e-9 {
        let before = value;
        for k in 0..3 {
            for sign in [-1.0, 1.0] {
                let mut nearby = n;
                nearby[k] += sign * step;
                (value, n) = meet(nearby);
            }
        }
        if value == before {
            step *= 0.5;
        }
    }
    value
}

fn random_blocks(random: &mut Random) -> Blocks<f64> {
    let mut three = || std::array::from_fn(|_| random.uniform(-1.0, 1.0));
    let (gradient, flip, twist, diagonal, mixed): ([f64; 3], _, _, [f64; 3], [f64; 3]) =
        (three(), three(), three(), three(), three());
    // Stiff on the diagonal, or corners of the triangle would win nearly always.
    let [h11, h22, h33] = diagonal.map(|x| x + 1.0);
    let flip: [f64; 3] = flip;
    let [h12, h13, h23] = mixed;
    Blocks { gradient, hessian: [h11, h22, h33, h12, h13, h23], flip: flip.map(|x| x + 1.0), twist }
}

#[test]
fn the_slowest_wave_is_the_one_that_a_search_finds() {
    let mut random = Random::new(1);
    let mut met = [0; 4];
    for _ in 0..400 {
        let blocks = random_blocks(&mut random);
        let wave = slowest(&blocks);
        // The search ends within 1e-9 of a stationary direction, but on ridges; the value is within its
        // square, and rounding.
        let expected = searched(&blocks);
        assert!((wave.modulus - expected).abs() < 1e-8, "{blocks:?}: {wave:?}, {expected}");
        for v in [wave.polarisation, wave.normal] {
            let norm = v.iter().map(|x| x * x).sum::<f64>();
            assert!((norm - 1.0).abs() < 1e-15, "{wave:?}");
        }
        let of_wave = modulus(&blocks, wave.polarisation, wave.normal);
        assert!((wave.modulus - of_wave).abs() < 1e-14, "{wave:?}, {of_wave}");
        let axes = wave.normal.iter().filter(|&&x| x > 0.0).count();
        let is_axial = axes == 1 && wave.polarisation != wave.normal;
        met[if is_axial { 0 } else { axes }] += 1;
    }
    // Shear waves along axes, and each kind of face: corners, edges, the inside.
    assert!(met.iter().all(|&count| count > 10), "{met:?}");
}

/// λ1 ≥ λ2 ≥ λ3 between e⁻¹ and e.
fn random_stretches(random: &mut Random) -> [f64; 3] {
    let mut stretches = std::array::from_fn(|_| random.uniform(-1.0, 1.0).exp());
    stretches.sort_by(|one: &f64, other| other.total_cmp(one));
    stretches
}

#[test]
fn at_rest_all_moduli_are_those_of_hooke() -> Tested {
    for (mu, lambda) in [(1.0, 5.0), (1.0, 0.0), (3.0, -1.5)] {
        let solid = Hencky::new(mu, lambda)?;
        let rest = Judgement::of(&solid, [1.0; 3]).ok_or("admitted")?;
        let bulk = lambda + 2.0 / 3.0 * mu;
        let expected = [mu, mu.min(1.5 * bulk), mu.min(lambda + 2.0 * mu)];
        for (found, expected) in rest.moduli.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{rest:?}");
        }
        assert_eq!(rest.kept, [true; 3]);
    }
    Ok(())
}

/// For ψ = μ/2 (I1 − 3) + h(J), E = μ + h″(J) (m · cof F N)²: the shear modulus, or less by the largest entry
/// of cof F where h is concave. Here h = −μ ln J + λ/2 (ln J)².
#[test]
fn waves_of_a_neo_hookean_solid_have_a_formula() -> Tested {
    let (mu, lambda) = (1.0, 5.0);
    let solid = NeoHookean::new(mu, lambda)?;
    let mut random = Random::new(3);
    let mut lost = 0;
    for _ in 0..1000 {
        let stretches = random_stretches(&mut random);
        let [l1, l2, l3] = stretches;
        let bulge = (mu + lambda * (1.0 - (l1 * l2 * l3).ln())) / (l3 * l3);
        let expected = mu + bulge.min(0.0);
        let judgement = Judgement::of(&solid, stretches).ok_or("admitted")?;
        let [shear, hill, wave] = judgement.moduli;
        // A dozen roundings of the largest terms, λ/λ3².
        let tolerance = 64.0 * f64::EPSILON * lambda / (l3 * l3);
        assert!((wave - expected).abs() < tolerance, "{judgement:?}, {expected}");
        assert!((shear - mu).abs() < tolerance, "{judgement:?}");
        // dτ/d ln U = 2 μ diag(λi²) + λ 1 1ᵀ, between the least term and that plus rounding of the largest.
        assert!(hill > mu * l3 * l3 - tolerance * l1 * l1, "{judgement:?}");
        lost += usize::from(!judgement.kept[2]);
    }
    assert!(lost > 10, "{lost}");
    Ok(())
}

/// \[KS75\] Knowles, Sternberg, *On the ellipticity of the equations of nonlinear elastostatics for a special
/// material*, J. Elasticity 5, 1975: elliptic if and only if 2 − √3 < λi/λj < 2 + √3 for all pairs.
#[test]
fn the_foam_of_blatz_and_ko_loses_ellipticity_where_knowles_and_sternberg_say() -> Tested {
    let foam = BlatzKo::new(1.0, 0.0, 0.5)?;
    let limit = 2.0 + 3f64.sqrt();
    let mut random = Random::new(4);
    let mut met = [0; 2];
    for _ in 0..4000 {
        let stretches = random_stretches(&mut random);
        let is_elliptic = stretches[0] / stretches[2] < limit;
        let judgement = Judgement::of(&foam, stretches).ok_or("admitted")?;
        assert_eq!(judgement.kept[2], is_elliptic, "{judgement:?}");
        met[usize::from(is_elliptic)] += 1;
    }
    assert!(met[0] > 100 && met[1] > 100, "{met:?}");
    // Near the limit, to the digits that are left where ψ12 is a thousand times the modulus.
    for [least, middle] in [[1.0, 1.0], [0.3, 0.3], [1.0, 2.0], [2.0, 9.0]] {
        for (share, is_elliptic) in [(1.0 - 1e-10, true), (1.0 + 1e-10, false)] {
            let largest = share * limit * least;
            let stretches = [largest, largest.min(middle), least];
            let judgement = Judgement::of(&foam, stretches).ok_or("admitted")?;
            assert_eq!(judgement.kept[2], is_elliptic, "{judgement:?}");
        }
    }
    // The first wave to stand still travels in the plane of the largest stretch and of the smallest.
    let [n1, n2, n3] = Judgement::of(&foam, [1.0001 * limit, 2.0, 1.0]).ok_or("admitted")?.wave.normal;
    assert!(n1 > 0.0 && n2 == 0.0 && n3 > 0.0, "{n1} {n2} {n3}");
    Ok(())
}

/// \[BXM01\] Bruhns, Xiao, Meyers, *Constitutive inequalities for an isotropic elastic strain-energy function
/// based on Hencky's logarithmic strain tensor*, Proc. R. Soc. A 457, 2001: elliptic for stretches of 0.21162
/// … ∛e, whatever λ ≥ 0.
#[test]
fn henckys_solid_is_elliptic_at_moderate_stretches_only() -> Tested {
    let upper = (1.0f64 / 3.0).exp();
    let moderate = SurveySettings { from: 0.211_63, to: upper - 1e-5, resolution: 21 };
    for lambda in [0.0, 0.1, 1.0, 10.0, 1e3] {
        let report = survey(&Hencky::new(1.0, lambda)?, &moderate)?;
        assert_eq!(report.findings[2].kept, report.points, "{report}");
        // Linear in the logarithmic strain.
        assert!(report.findings[1].worst.is_some_and(|worst| (worst.moduli[1] - 1.0).abs() < 1e-10));
    }
    // Both limits are sharp: the upper one where resistance to volume changes is all there is, the lower one
    // without any.
    let keeps = |lambda, stretches| -> Result<bool, Box<dyn std::error::Error>> {
        Ok(Judgement::of(&Hencky::new(1.0, lambda)?, stretches).ok_or("admitted")?.kept[2])
    };
    assert!(!keeps(1e6, [upper + 1e-5; 3])?);
    let (mut lost, mut kept) = (0.2, 0.22);
    while kept - lost > 1e-9 {
        let middle = 0.5 * (kept + lost);
        if keeps(0.0, [upper, middle, middle])? { kept = middle } else { lost = middle }
    }
    // As published.
    assert_eq!(format!("{kept:.5}"), "0.21162");
    Ok(())
}

#[test]
fn a_polyconvex_energy_keeps_ellipticity_everywhere() -> Tested {
    let solid = CiarletGeymonat::new(1.8e5, 3.4e3, 5e6)?;
    let report = survey(&solid, &SurveySettings { from: 0.05, to: 20.0, resolution: 25 })?;
    let [shear, _, wave] = report.findings;
    assert_eq!((shear.kept, wave.kept), (report.points, report.points), "{report}");
    assert!(report.walks.iter().all(|walk| walk.lost[2].is_none()), "{report}");
    Ok(())
}

/// At the stretches (x, 1, 1), with M = 2μ + λ: ψ11 = M (3x² − 1)/2, a12 = (M x² − λ)/2, b12 = μ x, ψ12 = λ x
/// and ψ22 = M + λ (x² − 1)/2.
#[test]
fn saint_venant_and_kirchhoffs_solid_is_lost_under_confined_compression() -> Tested {
    for poisson in [0.0, 0.2, 0.3, 0.45] {
        let Moduli { mu, lambda } = Moduli::from_young_poisson(1.0, poisson)?;
        let report = survey(&StVenantKirchhoff::new(mu, lambda)?, &SurveySettings::default())?;
        let crushed = report.walks.iter().find(|walk| walk.path == Path::Confined && walk.to == 0.3);
        let lost = crushed.ok_or("a walk")?.lost;
        // a12 = 0
        let sheared = lost[Criterion::BakerEricksen as usize];
        let expected = (poisson / (1.0 - poisson)).sqrt();
        assert_eq!(sheared.is_some(), expected > 0.3, "{report}");
        assert!(sheared.is_none_or(|stretch| (stretch - expected).abs() < 1e-8), "{report}");
        // a12 + √(ψ11 ψ22) = ψ12 + b12, the condition of \[KS77\]: for λ = 0 at 2 − √2.
        let stretch = lost[Criterion::StrongEllipticity as usize].ok_or("lost")?;
        let m = 2.0 * mu + lambda;
        let reserve = |x: f64| {
            let product = m * (3.0 * x * x - 1.0) / 2.0 * (m + lambda * (x * x - 1.0) / 2.0);
            (m * x * x - lambda) / 2.0 + product.sqrt() - (lambda + mu) * x
        };
        assert!(reserve(stretch + 1e-8) > 0.0 && reserve(stretch - 1e-8) < 0.0, "{stretch}");
        assert!(poisson > 0.0 || (stretch - (2.0 - 2f64.sqrt())).abs() < 1e-8, "{stretch}");
    }
    Ok(())
}

#[test]
fn a_path_ends_where_the_domain_does() -> Tested {
    // I1 − 3 < 3
    let rubber = Gent::new(1.0, 3.0, 100.0)?;
    for (path, expected) in [(Path::Confined, 2.0), (Path::Hydrostatic, 2f64.sqrt())] {
        let reached = Walk::along(path, &rubber, 3.0).reached;
        assert!((reached / expected - 1.0).abs() < 1e-8, "{reached}");
    }
    let reached = Walk::along(Path::Uniaxial, &rubber, 3.0).reached;
    assert!(2.0 < reached && reached < 6f64.sqrt(), "{reached}");
    Ok(())
}

#[test]
fn stretches_come_in_any_order() -> Tested {
    let solid = Hencky::new(1.0, 1.0)?;
    assert_eq!(Judgement::of(&solid, [0.5, 2.0, 1.0]), Judgement::of(&solid, [2.0, 1.0, 0.5]));
    for nonsense in [[1.0, 1.0, 0.0], [1.0, -1.0, 1.0], [f64::NAN, 1.0, 1.0], [f64::INFINITY, 1.0, 1.0]] {
        assert_eq!(Judgement::of(&solid, nonsense), None);
    }
    Ok(())
}

#[test]
fn settings_are_checked() -> Tested {
    let solid = Hencky::new(1.0, 1.0)?;
    let good = SurveySettings { resolution: 5, ..SurveySettings::default() };
    assert_eq!(survey(&solid, &good)?.points, 35);
    let wrong = [(1.0, 3.0), (0.3, 1.0), (0.0, 2.0), (f64::NAN, 2.0), (0.5, f64::INFINITY)];
    for (from, to) in wrong.into_iter().chain([(0.5, 1e200), (1e-300, 1e300), (0.9e-6, 2.0), (0.5, 1.1e6)]) {
        let error = survey(&solid, &SurveySettings { from, to, ..good }).expect_err("not a range");
        assert!(error.to_string().starts_with("the stretches are from "), "{from:e} to {to:e}: {error}");
    }
    for resolution in [0, 1, 401] {
        let error = survey(&solid, &SurveySettings { resolution, ..good }).expect_err("no resolution");
        assert_eq!(error.to_string(), format!("the resolution is {resolution}; it must be from 2 to 400"));
    }
    Ok(())
}

#[test]
fn reports_are_narrow() -> Tested {
    let rubber = Gent::new(1e6, 3.0, 1e8)?;
    let settings = SurveySettings { resolution: 11, ..SurveySettings::default() };
    let report = survey(&rubber, &settings)?;
    assert!(report.admitted < report.points);
    let text = report.to_string();
    assert!(text.lines().all(|line| line.chars().count() <= 90), "{text}");
    Ok(())
}

/// At the limits powers and exponentials overflow: what is infinite has no eigenvalues, and the search for
/// them would not end.
#[test]
fn surveys_end_at_the_limits_of_the_range() -> Tested {
    let settings = SurveySettings { from: 1e-6, to: 1e6, resolution: 7 };
    let fung = Fung::new(2.7e4, 0.5, 0.5)?;
    assert!(survey(&fung, &settings)?.admitted < 84, "an exponential of 10¹³ overflows");
    for specimen in [&Hencky::new(1e5, 1e5)? as &dyn Specimen<f64>, &fung, &Ogden::new([1e5], [40.0], 1e6)?] {
        let report = survey(specimen, &settings)?;
        assert_eq!(report.points, 84);
        assert!(map(specimen, &settings, "wide")?.contains("</svg>"));
    }
    // End that a walk must reach.
    for to in [0.0, 5e-324, f64::MAX, f64::INFINITY, f64::NAN] {
        let reached = Walk::along(Path::Uniaxial, &fung, to).reached;
        assert!((to.min(1.0)..=to.max(1.0)).contains(&reached), "{reached:e} of {to:e}");
    }
    Ok(())
}
