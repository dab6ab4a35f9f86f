//! Functions as parameters: they may end, and a material ends with them. Energies with splines are judged as
//! text, by `tests/tests/declarations`.

use piola::material::{Constraint, Declared, Fittable, Limit, MaterialError};
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

/// φ(x) = x + x^(3/2) for x > 0.
#[derive(Clone, Debug, PartialEq)]
struct Root;

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
        R::splat(0.75) / x.sqrt()
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
piola::contract!(of_excess: OfExcess::new(2.0, 50.0, Root)?);

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
    let solid = OfExcess::new(2.0, 50.0, Root).expect("a material");
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
    let solid = OfStretches::new(1.0, Root).expect("a material");
    assert!(solid.ends_at_zero_volume() && !solid.admits([1.0, 1.0, -1e-300f64]));
    assert!(!locking().has_pole() && locking().ends_at_zero_volume());
}

#[test]
fn a_function_is_defined_at_rest() {
    let error = ByInvariants::new(2.0, 50.0, Locking { limit: 1.0 }).expect_err("1 is not below 1");
    assert_eq!(error, MaterialError::UndefinedRest);
    assert!(error.to_string().contains("not defined at rest"));
    let error = InSums::new(1.0, [1.0], Locking { limit: -1.0 }).expect_err("0 is not below −1");
    assert_eq!(error, MaterialError::UndefinedRest);
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

/// φ(x) = c xⁿ, c in Pa.
#[derive(Clone, Debug, PartialEq)]
struct Power {
    c: f64,
    n: f64,
}

impl Univariate for Power {
    fn value<R: Real>(&self, x: R) -> R {
        R::splat(self.c) * x.powf(R::splat(self.n))
    }
    fn derivative<R: Real>(&self, x: R) -> R {
        R::splat(self.c * self.n) * x.powf(R::splat(self.n - 1.0))
    }
    fn second_derivative<R: Real>(&self, x: R) -> R {
        R::splat(self.c * self.n * (self.n - 1.0)) * x.powf(R::splat(self.n - 2.0))
    }
    fn values(&self) -> Vec<f64> {
        vec![self.c, self.n]
    }
    fn with_values(&self, values: &[f64]) -> Result<Self, MaterialError> {
        match *values {
            [c, n] if n > 0.0 => Ok(Self { c, n }),
            _ => Err(MaterialError::Shape { expected: "c and n > 0".into() }),
        }
    }
}

/// A power of the mean square of the stretches with a neo-Hookean solid, and a function that is held.
#[material(domain(J > 0.0, f(I1b / 3.0) < 20.0 * mu), admissible(mu < 10.0), extend, fit)]
pub fn Fitted([l1, l2, l3]: [f64; 3], mu: f64, f: Power, g: Locking) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + f(I1b / 3.0) + g(I1b - 3.0)
}

/// Springs, of which as many stiffnesses as wanted stand in the arguments of a function.
#[material(domain(J > 0.0), fit)]
pub fn Sprung<const N: usize>([l1, l2, l3]: [f64; 3], a: f64, b: [f64; N], k: f64, f: Power) -> f64 {
    f(a * l1) + f(a * l2) + f(a * l3) + sum(|p| f(b[p] * l1) + f(b[p] * l2) + f(b[p] * l3)) - k * J.ln()
}

fn fitted() -> Fitted {
    let (f, g) = (Power { c: 1.5, n: 2.5 }, Locking { limit: 40.0 });
    Fitted::new(2.0, f, g).expect("a material")
}

#[track_caller]
fn close(found: &[f64], expected: &[f64], scale: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        // 470 u of what is differenced, and a few roundings of it, by values near 1.
        assert!((found - expected).abs() <= 2000.0 * f64::EPSILON * scale, "{found} for {expected}");
    }
}

/// The value of a constraint, followed by its derivatives.
fn numbers(constraint: &Constraint) -> Vec<f64> {
    [&[constraint.value][..], &constraint.gradient].concat()
}

#[test]
fn values_of_functions_have_derivatives() {
    let solid = fitted();
    assert_eq!(solid.values(), [vec![2.0], vec![1.5, 2.5], vec![]]);
    let stretches: [f64; 3] = [1.7, 1.1, 0.6];
    let [by_mu, by_c, by_n] = solid.gradient_by_parameters(stretches)[..] else { panic!("three numbers") };
    let j: f64 = stretches.iter().product();
    let i1b = j.powf(-2.0 / 3.0) * stretches.iter().map(|l| l * l).sum::<f64>();
    let (x, n, c) = (i1b / 3.0, 2.5, 1.5);
    for (i, l) in stretches.into_iter().enumerate() {
        // dx/dλ = 2/3 (J^(−2/3) λ − I1b/(3 λ)).
        let dx = 2.0 / 3.0 * (j.powf(-2.0 / 3.0) * l - i1b / (3.0 * l));
        let slope = x.powf(n - 1.0) * dx;
        close(&[by_mu[i]], &[l - 1.0 / l], 1.0);
        close(&[by_c[i], by_n[i]], &[n * slope, c * slope * (1.0 + n * x.ln())], 10.0);
    }
    let extended = solid.clone().with_inversion(Inversion::Extend { epsilon: 0.9 }).expect("restoring");
    assert_eq!(extended.gradient_by_parameters(stretches), solid.gradient_by_parameters(stretches));
}

#[test]
fn constraints_have_derivatives_by_values_of_functions() {
    let solid = fitted();
    let [upper, shear, bulk] = <[_; 3]>::try_from(solid.constraints()).expect("three");
    assert_eq!((upper.value, upper.gradient), (8.0, vec![-1.0, 0.0, 0.0]));
    // μ + 2/3 f′(1) + 2 g′(0) with f′(1) = c n and g′(0) = 1/2; the bulk modulus is 2/3 μ.
    assert_eq!(shear.limit, Limit::ShearModulus);
    close(&numbers(&shear), &[2.0 + 2.5 + 1.0, 1.0, 5.0 / 3.0, 1.0], 10.0);
    assert_eq!(bulk.limit, Limit::BulkModulus);
    close(&numbers(&bulk), &[4.0 / 3.0, 2.0 / 3.0, 0.0, 0.0], 10.0);
    // 20 μ − f(x) with x = I1b/3 = 5/3, at constant volume and twice as long.
    let tension = [2.0, 0.5f64.sqrt(), 0.5f64.sqrt()];
    let [domain] = <[_; 1]>::try_from(solid.domain_constraints(tension)).expect("one");
    let x: f64 = (4.0 + 2.0 / 2.0) / 3.0;
    let power = x.powf(2.5);
    close(&numbers(&domain), &[40.0 - 1.5 * power, 20.0, -power, -1.5 * power * x.ln()], 50.0);
}

#[test]
fn conditions_beyond_the_second_derivative_of_a_function_are_differenced() {
    // f = c x², so that k = 2 c (a² + Σ b²) leaves no stress; μ = c (a² + Σ b²) + k/2 and λ = 0.
    let f = Power { c: 1.5, n: 2.0 };
    let solid = Sprung::new(2.0, [0.5, 1.5], 2.0 * 1.5 * 6.5, f).expect("a material");
    let [shear, _] = <[_; 2]>::try_from(solid.constraints()).expect("two");
    close(&[shear.value], &[2.0 * 1.5 * 6.5], 20.0);
    // By a: 2 c a; by k: ½; by c: 6.5. By n, of ½ c Σ n (n − 1) bⁿ: ½ c Σ (2 n − 1 + n (n − 1) ln b) bⁿ.
    let by_n = |b: f64| 0.75 * (3.0 + 2.0 * b.ln()) * b * b;
    let by_n = by_n(2.0) + by_n(0.5) + by_n(1.5);
    close(&shear.gradient, &[6.0, 1.5, 4.5, 0.5, 6.5, by_n], 40.0);
}

#[test]
fn a_material_is_made_anew_with_other_values() {
    let solid = fitted().with_inversion(Inversion::Extend { epsilon: 0.2 }).expect("restoring");
    let other = Fittable::with_values(&solid, &[&[3.0], &[2.0, 4.0], &[]]).expect("admissible");
    assert_eq!(
        other,
        Fitted::new(3.0, Power { c: 2.0, n: 4.0 }, Locking { limit: 40.0 }).expect("admissible")
    );
    let error = |values: &[&[f64]]| Fittable::with_values(&solid, values).expect_err("refused").to_string();
    assert!(error(&[&[3.0], &[2.0, 4.0], &[1.0]]).contains("no values to be changed, but 1 are given"));
    assert!(error(&[&[3.0], &[2.0, -4.0], &[]]).contains("n > 0"));
    assert!(error(&[&[30.0], &[2.0, 4.0], &[]]).contains("mu < 10"));
    assert!(error(&[&[3.0]]).contains("3 parameters"));
}

/// Lists whose length is known at run time, whole exponents and a function in one energy.
#[material(domain(J > 0.0), fit)]
pub fn Data([l1, l2, l3]: [f64; 3], c: Vec<f64>, n: Vec<u32>, f: Locking) -> f64 {
    sum(|p| c[p] * (f(I1b - 3.0).powi(n[p]) + J.ln().powi(2)))
}

#[test]
fn data_of_every_kind_go_through_a_fit() -> Result<(), MaterialError> {
    let stretches = [1.3, 1.1, 0.8];
    let short = Data::new(vec![2.0], vec![1], Locking { limit: 9.0 })?;
    let long = Data::new(vec![2.0, 0.5, 0.25], vec![1, 2, 3], Locking { limit: 8.0 })?;
    for data in [&short, &long] {
        let values = data.values();
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        assert_eq!(data.with_values(&values)?, *data);
        // Energies are linear in the coefficients, and exponents do not change.
        let derivatives = data.gradient_by_parameters(stretches);
        let coefficients = derivatives.iter().zip(data.c());
        let [first, _, _] = data.gradient(stretches);
        let sum: f64 = coefficients.map(|(by_coefficient, c)| by_coefficient[0] * c).sum();
        close(&[sum], &[first], first.abs());
        assert!(derivatives[data.c().len()..].iter().all(|by_exponent| *by_exponent == [0.0; 3]));
    }
    Ok(())
}
