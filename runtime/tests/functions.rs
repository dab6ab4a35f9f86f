//! Functions as parameters: they may end, and a material ends with them. Energies with splines are judged as
//! text, by `tests/tests/declarations`.

use piola::material::Declared;
use piola::{Inversion, Material, Real, Univariate, material};

/// φ(s) = −limit/2 ln(1 − s/limit) for s < limit.
#[derive(Clone, Debug, PartialEq)]
struct Locking {
    limit: f64,
}

impl Univariate for Locking {
    #[inline(always)]
    fn admits<R: Real>(&self, s: R) -> R::Mask {
        s.less(R::splat(self.limit))
    }
    #[inline(always)]
    fn value<R: Real>(&self, s: R) -> R {
        R::splat(-0.5 * self.limit) * (-(s / R::splat(self.limit))).ln_1p()
    }
    #[inline(always)]
    fn derivative<R: Real>(&self, s: R) -> R {
        R::splat(0.5 * self.limit) / (R::splat(self.limit) - s)
    }
    #[inline(always)]
    fn second_derivative<R: Real>(&self, s: R) -> R {
        let left = R::splat(self.limit) - s;
        R::splat(0.5 * self.limit) / (left * left)
    }
}

/// Rubber whose chains lock, as a function of I1b − 2.
#[material(domain(J > 0.0))]
pub fn ByInvariants([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64, f: Locking) -> f64 {
    mu * f(I1b - 2.0) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// φ(x) = x + x^(3/2) for x > 0, and a factor of φ″, 1 if it is right.
#[derive(Clone, Debug, PartialEq)]
struct Root(f64);

impl Univariate for Root {
    fn admits<R: Real>(&self, x: R) -> R::Mask {
        R::splat(0.0).less(x)
    }
    fn value<R: Real>(&self, x: R) -> R {
        x + x * x.sqrt()
    }
    fn derivative<R: Real>(&self, x: R) -> R {
        R::splat(1.0) + R::splat(1.5) * x.sqrt()
    }
    fn second_derivative<R: Real>(&self, x: R) -> R {
        R::splat(0.75 * self.0) / x.sqrt()
    }
}

/// Rubber whose function ends where I1b − 3 begins.
#[material(domain(J > 0.0))]
pub fn OfExcess([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64, f: Root) -> f64 {
    mu / 2.0 * f(I1b - 3.0) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Fibres in all directions that lock at a stretch of 1 + limit/weight, one weight for each population.
#[material(prestressed, domain(J > 0.0), extend)]
pub fn InSums<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, weight: [f64; N], f: Locking) -> f64 {
    let fibres = sum(|p| f(weight[p] * (l1 - 1.0)) + f(weight[p] * (l2 - 1.0)) + f(weight[p] * (l3 - 1.0)));
    mu * fibres - mu * J.ln() + mu * f(f(J - 1.0))
}

/// A function of each stretch, without a domain of its own.
#[material(prestressed)]
pub fn OfStretches([l1, l2, l3]: [f64; 3], mu: f64, f: Root) -> f64 {
    mu * (f(l1) + f(l2) + f(l3))
}

/// Hencky's energy by the logarithm of the volume, which continues beyond J > 0 by its extension.
#[material(domain(J > 0.0), extend)]
pub fn OfLogarithm([l1, l2, l3]: [f64; 3], mu: f64, f: Locking) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + mu * f(J.ln().powi(2))
}

fn locking() -> ByInvariants {
    ByInvariants::new(2.0, 50.0, Locking { limit: 3.0 }).expect("a material")
}

fn in_sums() -> InSums<2> {
    InSums::new(1.0, [0.5, 2.0], Locking { limit: 2.0 }).expect("a material")
}

piola::contract!(by_invariants: locking(), range: (0.5, 2.2));
piola::contract!(of_excess: OfExcess::new(2.0, 50.0, Root(1.0))?);

#[test]
fn a_derivative_of_a_function_that_does_not_fit_breaks_the_contract() {
    let wrong = OfExcess::new(2.0, 50.0, Root(1.5)).expect("a material");
    let broken = piola::contract::check(&wrong, &Default::default()).expect_err("a factor").to_string();
    assert!(broken.contains("tangent_slope"), "{broken}");
}

/// I1b − 3 in tension at constant volume.
fn excess(l: f64) -> f64 {
    l * l + 2.0 / l - 3.0
}

#[test]
fn a_material_ends_where_its_function_does() {
    // 2² + 2/2 = 5.
    for (l, is_inside) in [(1.0f64, true), (1.999, true), (2.001, false), (5.0, false)] {
        assert_eq!(excess(l) < 2.0, is_inside);
        let stretches = [l, 1.0 / l.sqrt(), 1.0 / l.sqrt()];
        assert_eq!(locking().admits(stretches), is_inside, "{l}");
        // Neither I1b nor the function depends on a change of volume.
        assert_eq!(locking().admits(stretches.map(|x| 0.2 * x)), is_inside, "{l}");
        let invariants = [excess(l) + 3.0, 2.0 * l + 1.0 / (l * l), 1.0];
        assert_eq!(locking().admits_invariants(invariants), is_inside, "{l}");
        assert!(
            !locking().admits(stretches.map(|x| -x)) && !locking().admits_invariants([3.0, 3.0, -1.0f64])
        );
    }
    assert!(!locking().admits([f64::NAN; 3]));
}

#[test]
fn a_function_of_the_excess_is_defined_at_rest_and_at_dilations() {
    let solid = OfExcess::new(2.0, 50.0, Root(1.0)).expect("a material");
    for k in 0..1000 {
        let a = 0.5 + 1.5 * f64::from(k) / 999.0;
        assert!(solid.admits([a; 3]) && solid.admits([a as f32; 3]), "{a}");
        let dilation = [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
        let point = piola::point::evaluate(&solid, &dilation, piola::point::Filter::None);
        assert!(point.status.is_clean(), "{a}: {:?}", point.status);
        // D⁻12 of I1b at a dilation is 4/λ², and φ′(0) is 1.
        let expected = 4.0 / (a * a) - 50.0 * (a.powi(3) - 1.0) * a;
        for flip in solid.blocks([a; 3]).flip {
            assert!((flip - expected).abs() <= 1e-13 * (4.0 + 50.0 * a.powi(4)), "{flip} for {expected}");
        }
    }
}

#[test]
fn every_entry_of_a_list_and_every_inner_call_is_asked() {
    let ends = |l: f64| !in_sums().admits([l, 1.0, 1.0 / l]);
    // 2 (l − 1) reaches 2 at l = 2, where ½ (l − 1) is ½.
    assert!(!ends(1.99) && ends(2.01));
    // f(J − 1) = −ln(1 − (J − 1)/2) is 2 at J = 3 − 2 e⁻², before J − 1 is 2.
    let end = 3.0 - 2.0 * (-2f64).exp();
    let volumes = |j: f64| in_sums().admits([j.cbrt(); 3]);
    assert!(volumes(end - 1e-9) && !volumes(end + 1e-9) && !volumes(3.5));
}

#[test]
fn an_extension_continues_the_arguments_of_a_function_and_not_the_function() {
    let solid = |limit: f64| OfLogarithm::new(1.0, Locking { limit }).expect("a material");
    let flat: [f64; 3] = [1.0, 1.0, 0.1];
    // (ln J)² is 5.3.
    assert!(!solid(5.0).admits(flat) && solid(6.0).admits(flat));
    // Below ε = ½ the logarithm is ln ½ + 2 d − 2 d², d = 0.1 − ½: −1.813.
    let extended = |limit: f64| {
        solid(limit).with_inversion(Inversion::Extend { epsilon: 0.5 }).expect("restoring").admits(flat)
    };
    assert!(!extended(3.28) && extended(3.29));
}

#[test]
fn a_function_of_a_stretch_may_end_at_zero() {
    let solid = OfStretches::new(1.0, Root(1.0)).expect("a material");
    assert!(solid.ends_at_zero_volume() && !solid.admits([1.0, 1.0, -1e-300f64]));
    assert!(!locking().has_pole() && locking().ends_at_zero_volume());
}

#[test]
fn a_function_is_defined_at_rest() {
    let error = ByInvariants::new(2.0, 50.0, Locking { limit: 1.0 }).expect_err("1 is not below 1");
    assert!(error.to_string().contains("not defined at rest"), "{error}");
    let error = InSums::new(1.0, [1.0], Locking { limit: -1.0 }).expect_err("0 is not below −1");
    assert!(error.to_string().contains("not defined at rest"), "{error}");
}

/// Materials by invariants that end at different points, side by side on every back end.
#[cfg(feature = "batch")]
#[test]
fn every_point_has_the_end_of_its_own_function() -> Result<(), Box<dyn std::error::Error>> {
    use piola::batch::{Batch, LengthError, TileMaterial};
    use piola::lanes::Backend;
    use piola::material::PerPoint;
    use piola::{Status, StatusCell, Survey};

    type Results = Result<(Survey, Vec<(Status, Vec<u64>)>), LengthError>;

    let limits = [1.5, 2.0, 2.0, 3.0, 1e9];
    let materials = limits.map(|limit| ByInvariants::new(2.0, 50.0, Locking { limit }).expect("a material"));
    let (mut points, mut solids) = (Vec::new(), Vec::new());
    for p in 0..100 {
        let l = 1.0 + 0.02 * p as f64;
        points.push([l, 0.1, 0.0, 0.0, 1.0 / l.sqrt(), 0.0, 0.2, 0.0, 1.0 / l.sqrt()]);
        solids.push(&materials[p * p % 5]);
    }
    let results = |material: &dyn TileMaterial<f64>, backend: Backend, points: &[[f64; 9]]| -> Results {
        let statuses: Vec<_> = points.iter().map(|_| StatusCell::default()).collect();
        let (mut energies, mut stresses) = (vec![0.0; points.len()], vec![0.0; 9 * points.len()]);
        let batch = Batch::new(material).with_backend(backend).with_statuses(&statuses);
        let survey = batch.energies(points.as_flattened(), &mut energies)?;
        batch.stresses(points.as_flattened(), &mut stresses)?;
        let numbers = stresses.chunks(9).zip(energies).map(|(stress, energy)| [stress, &[energy]].concat());
        let bits = numbers.map(|numbers| numbers.into_iter().map(f64::to_bits).collect::<Vec<_>>());
        Ok((survey, statuses.iter().map(StatusCell::get).zip(bits).collect()))
    };
    let each = PerPoint::new(&solids)?;
    for backend in Backend::available() {
        let (survey, together) = results(&each, backend, &points)?;
        assert!(survey.refused > 10 && survey.refused < 60, "{survey:?}");
        for (p, (point, solid)) in points.iter().zip(&solids).enumerate() {
            let (_, alone) = results(*solid, backend, &[*point])?;
            assert_eq!(together[p], alone[0], "point {p}, {backend}");
        }
    }
    Ok(())
}

#[test]
fn the_domain_names_the_functions() {
    assert_eq!(ByInvariants::DESCRIPTION.domain, "J > 0 where f is defined");
    assert_eq!(OfStretches::DESCRIPTION.domain, "every deformation where f is defined");
}
