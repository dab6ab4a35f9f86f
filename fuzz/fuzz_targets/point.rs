//! Any material of the catalogue, with any parameters, at any deformation gradient: no panic, no infinite or
//! NaN result under a clean status, and in single precision no clean result flagged.
//!
//! ```sh
//! cargo +nightly fuzz run -s none -O point fuzz/corpus/point fuzz/seeds/point -- -max_len=256 -use_value_profile=1
//! ```
//!
//! The seeds hold each entry of the catalogue at deformations at rest, sheared, inverted, of rank one,
//! graded, huge, tiny and subnormal.
//!
//! An input is read as: the entry of the catalogue; precision, inversion and origin of the parameters;
//! parameters; nine numbers by their bits. What is missing is zero.

#![no_main]
#![expect(non_snake_case, reason = "F as in the literature")]

use libfuzzer_sys::fuzz_target;
use piola::Inversion;
use piola::point::Matrix3;
use piola_tests::energies::{ENERGIES, Format};
use piola_tests::soundness::{check, check_elements, check_single, check_single_accuracy};

fuzz_target!(|input: &[u8]| {
    let mut input = Input(input);
    let energy = &ENERGIES[usize::from(input.byte()) % ENERGIES.len()];
    let switches = input.byte();
    let inversion = match switches >> 1 & 3 {
        0 | 1 => Inversion::Refuse,
        2 => Inversion::Extend { epsilon: 0.1 },
        _ => Inversion::Extend { epsilon: input.number::<f64>() },
    };
    let origin = switches >> 3 & 3;
    let mut parameter = |&typical: &f64| match origin {
        0 | 1 => typical,
        // From an eighth to eight times as much, of either sign.
        2 => {
            let byte = input.byte();
            let factor = f64::from(1 + (byte & 63)) / 8.0;
            if byte & 128 == 0 { typical * factor } else { -typical * factor }
        }
        _ => input.number(),
    };
    let parameters = energy.typical();
    let parameters: Vec<Vec<f64>> =
        parameters.iter().map(|list| list.iter().map(&mut parameter).collect()).collect();
    let parameters: Vec<&[f64]> = parameters.iter().map(Vec::as_slice).collect();
    // What single precision rounds to zero or infinity, or can hardly hold the square of, is another material
    // there.
    let is_typical = origin < 2
        && match inversion {
            Inversion::Refuse => true,
            Inversion::Extend { epsilon } => epsilon > 1e-3,
        };
    // A refusal of the parameters is an answer; what it may not be is a panic.
    let Ok(subject) = energy.subject(&parameters, inversion) else { return };
    let verdict = if switches & 1 == 1 {
        let F: Matrix3<f32> = input.matrix();
        let mut verdict = check(f32::of(&subject), &F).map(drop);
        if verdict.is_ok() && is_typical && F.iter().flatten().all(|x| x.is_finite()) {
            verdict = check_single(&subject, &F).and_then(|_| check_single_accuracy(&subject, &F));
        }
        verdict.map_err(|fault| (fault, format!("{F:?}")))
    } else {
        let F: Matrix3<f64> = input.matrix();
        let of_element = |_| match check_elements(&*subject.double, &[F]).into_iter().next() {
            Some((_, fault)) => Err(fault),
            None => Ok(()),
        };
        let verdict = check(f64::of(&subject), &F).and_then(of_element);
        verdict.map_err(|fault| (fault, format!("{F:?}")))
    };
    if let Err((fault, F)) = verdict {
        panic!("{} {parameters:?} {inversion:?}: {fault} at {F}", energy.name);
    }
});

/// The bytes that are left.
struct Input<'a>(&'a [u8]);

impl Input<'_> {
    fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    fn number<R: Format>(&mut self) -> R {
        let bytes = if R::NAME == "f32" { 4 } else { 8 };
        R::from_bits((0..bytes).fold(0, |bits, _| bits << 8 | u64::from(self.byte())))
    }

    fn matrix<R: Format>(&mut self) -> Matrix3<R> {
        std::array::from_fn(|_| std::array::from_fn(|_| self.number()))
    }
}
