//! Energies declared at run time, compared with those that the compiler has made of the same declarations:
//! equal results, bit by bit.
//!
//! Every energy that the build compiles is read from its own declaration. Batches are compared in `f64` on
//! every back end, and with the feature `full` in `f32` those of energies with all kinds of operations;
//! single points in both formats, all responses of them. Deformation gradients are arbitrary patterns of
//! bits, so that the ends of the formats take part.

#![expect(non_snake_case, reason = "F, P, dP_dF as in the literature")]

use piola::__private::random::Random;
use piola::Inversion;
use piola::batch::{Batch, Kernels, TileMaterial};
use piola::lanes::Backend;
use piola::material::MaterialError;
use piola::point::Filter;
use piola_materials::{CATALOGUE, Entry};
use piola_tests::answers::Answers;
use piola_tests::bits::draw;
use piola_tests::energies::{ENERGIES, Format, Judged, Subject, find};
use piola_tests::twins::{check, responses, stretches};

/// Points of a batch: three tiles, the last of them not full.
const POINTS: usize = 150;

/// The energies that the build compiles, as judges take them, with their entries in the catalogue.
fn compiled() -> impl Iterator<Item = (&'static Judged, &'static Entry)> {
    ENERGIES.iter().filter_map(|energy| Some((energy, energy.compiled?)))
}

/// Deformation gradients of all kinds.
fn deformations<E: Format>(seed: u64) -> Vec<E> {
    let mut random = Random::new(seed);
    (0..POINTS).flat_map(|turn| draw(turn, &mut random)).flatten().collect()
}

fn check_batches<E: Kernels + Format>(
    name: &str,
    interpreted: &dyn TileMaterial<E>,
    compiled: &dyn TileMaterial<E>,
) {
    let F = deformations::<E>(name.len() as u64);
    for backend in Backend::available() {
        for filter in [Filter::None, Filter::Clamp] {
            let [found, expected] = [interpreted, compiled].map(|material| {
                Answers::of(Batch::new(material).with_backend(backend).with_filter(filter), &F)
            });
            let what = format!("{name} in {} on {backend}, {filter:?}", E::NAME);
            assert_eq!(found.statuses, expected.statuses, "{what}");
            check(&what, &found.numbers(), &expected.numbers());
        }
    }
}

#[test]
fn batches_have_the_bits_of_the_compiled_catalogue() {
    for (energy, _) in compiled() {
        for inversion in energy.inversions(0.1) {
            let Subject { double, exact, .. } =
                energy.subject(&energy.typical(), inversion).expect("typical parameters");
            check_batches::<f64>(&format!("{} {inversion:?}", energy.name), &exact, &*double);
        }
    }
}

#[cfg(feature = "full")]
#[test]
fn batches_in_single_precision_have_the_bits_of_compiled_ones() {
    use piola::material::Declared;
    use piola_materials::{
        ArrudaBoyce, Gent, NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff, StretchSpline,
    };

    fn of<M: Declared + 'static>(name: &str) {
        let energy = find(name).expect("an energy of the catalogue");
        for inversion in energy.inversions(0.1) {
            let values = energy.typical();
            let interpreted = energy.energy.material(&values, inversion).expect("typical parameters");
            let compiled = M::from_values(&values, inversion).expect("typical parameters");
            check_batches::<f32>(&format!("{name} {inversion:?}"), &interpreted, &compiled);
        }
    }
    of::<StVenantKirchhoff>("st_venant_kirchhoff");
    of::<NeoHookean>("neo_hookean");
    of::<Ogden<3>>("ogden");
    of::<Gent>("gent");
    of::<ArrudaBoyce>("arruda_boyce");
    of::<RotatedLinear>("rotated_linear");
    of::<StretchSpline>("stretch_spline");
}

#[test]
fn single_points_have_the_bits_of_the_compiled_catalogue() {
    let mut random = Random::new(1);
    for (energy, entry) in compiled() {
        assert_eq!(energy.description(), &entry.description, "{}", energy.name);
        for inversion in energy.inversions(0.1) {
            let Subject { double, single, exact, .. } =
                energy.subject(&energy.typical(), inversion).expect("typical parameters");
            for _ in 0..200 {
                let at = stretches(&mut random);
                let what = format!("{} {inversion:?} at {at:?}", energy.name);
                check(&what, &responses::<f64>(&exact, at), &responses::<f64>(&*double, at));
                let at = at.map(|stretch| stretch as f32);
                check(&what, &responses::<f32>(&exact, at), &responses::<f32>(&*single, at));
            }
        }
    }
}

/// Constants stay in a thread's registers from one tile to the next: each material finds its own.
#[test]
fn materials_of_one_energy_do_not_mix_their_constants() {
    let energy = &find("arruda_boyce").expect("an energy of the catalogue").energy;
    let typical: Vec<Vec<f64>> = energy.typical().iter().map(|list| list.to_vec()).collect();
    let scaled = |factor: f64| {
        let values: Vec<Vec<f64>> = typical.iter().map(|list| vec![factor * list[0]]).collect();
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        energy.material(&values, Inversion::Refuse).expect("admissible")
    };
    let materials = [scaled(1.0), scaled(1.5)];
    let F = deformations::<f64>(3);
    let alone = materials.each_ref().map(|material| {
        std::thread::scope(|scope| {
            let stresses = scope.spawn(|| Answers::of(Batch::<f64>::new(material), &F));
            stresses.join().expect("no panic")
        })
    });
    for k in [0, 1, 1, 0, 1] {
        let found = Answers::of(Batch::<f64>::new(&materials[k]), &F);
        check(&format!("material {k}"), &found.numbers(), &alone[k].numbers());
    }
    assert!(
        alone[0].numbers().iter().zip(&alone[1].numbers()).any(|(one, other)| one < other),
        "they differ"
    );
}

/// The error for values that a constructor rejects is that of the compiled constructor.
#[test]
fn values_are_refused_as_by_the_compiled_catalogue() {
    let mut refused = 0;
    for (Judged { energy, .. }, entry) in compiled() {
        let typical: Vec<Vec<f64>> = energy.typical().iter().map(|list| list.to_vec()).collect();
        let mut all = vec![Vec::new(), typical[..typical.len() - 1].to_vec()];
        for (k, list) in typical.iter().enumerate() {
            for place in 0..list.len() {
                for value in [0.0, -list[place], f64::NAN, f64::INFINITY, 0.5, 3.0] {
                    let mut values = typical.clone();
                    values[k][place] = value;
                    all.push(values);
                }
            }
            let mut values = typical.clone();
            values[k] = Vec::new();
            all.push(values);
        }
        for values in all {
            let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
            for inversion in
                [Inversion::Refuse, Inversion::Extend { epsilon: 0.1 }, Inversion::Extend { epsilon: 2.0 }]
            {
                // Of moduli that are told, the first digits: they differ by roundings.
                let told = |error: MaterialError| match error {
                    MaterialError::UnstableRest { moduli } => format!("unstable: {:.6e}", moduli.mu),
                    error => error.to_string(),
                };
                let found = energy.material(&values, inversion).map(|_| ()).map_err(told);
                let expected = entry.material(&values, inversion).map(|_| ()).map_err(told);
                // By name, lists have the lengths that the catalogue provides for.
                if expected.as_ref().is_err_and(|error| error.contains("by name, not")) {
                    continue;
                }
                assert_eq!(found, expected, "{} with {values:?}", entry.name);
                refused += usize::from(found.is_err());
            }
        }
    }
    // More than a thousand of the eighteen energies that `.ci/run` compiles.
    assert!(18 * refused > 1000 * CATALOGUE.len(), "{refused} of {} energies", CATALOGUE.len());
}
