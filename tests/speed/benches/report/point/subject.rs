//! The energies of the report.

use piola::Material;
use piola::material::{Declared, Description};
use piola_baselines::automatic::{self, Potential};
use piola_baselines::{invariants, polar};
use piola_materials as catalogue;
use piola_tests::cases::Case;

use super::Work;
use super::contestant::{Contestant, Number};
use super::methods;

/// An energy with the parameters of a case, in all the forms that methods need.
pub(crate) trait Subject: Sized {
    const NAME: &'static str;
    const IN_CATALOGUE: &'static str;

    /// Material as declared.
    type Material: Material + Copy + 'static;
    /// Potential for hyper-dual numbers.
    type Potential: Potential + Copy + 'static;

    /// # Errors
    /// Where the case does not fit.
    fn of_case(case: &Case) -> Result<Self, String>;
    fn material(&self) -> Self::Material;
    fn potential(&self) -> Self::Potential;

    /// Methods for this energy alone.
    fn special<E: Number>(&self, _work: Work) -> Vec<Contestant<E>> {
        Vec::new()
    }
}

/// Repeats code for each of the energies, whose type has the name given.
macro_rules! for_each {
    ($Subject:ident => $body:block) => {{
        subject::for_each!(@one $Subject = StVenantKirchhoff => $body);
        subject::for_each!(@one $Subject = NeoHookean => $body);
        subject::for_each!(@one $Subject = Ogden => $body);
        subject::for_each!(@one $Subject = RotatedLinear => $body);
        subject::for_each!(@one $Subject = Hencky => $body);
    }};
    (@one $Subject:ident = $Type:ident => $body:block) => {{
        type $Subject = subject::$Type;
        $body
    }};
}
pub(super) use for_each;

/// The numbers of a case in the order of the declaration.
fn numbers<const N: usize>(case: &Case, description: &Description) -> Result<[f64; N], String> {
    let values = case.values(description)?.concat();
    values.try_into().map_err(|_| format!("{}: not {N} numbers", case.id))
}

/// An energy of μ and λ.
macro_rules! of_two_moduli {
    ($Subject:ident, $name:literal, $in_catalogue:literal $(, $special:item)?) => {
        pub(crate) struct $Subject {
            mu: f64,
            lambda: f64,
            material: catalogue::$Subject,
        }

        impl Subject for $Subject {
            const NAME: &'static str = $name;
            const IN_CATALOGUE: &'static str = $in_catalogue;
            type Material = catalogue::$Subject;
            type Potential = automatic::$Subject;

            fn of_case(case: &Case) -> Result<Self, String> {
                let [mu, lambda] = numbers(case, &<catalogue::$Subject as Declared>::DESCRIPTION)?;
                let material = catalogue::$Subject::new(mu, lambda);
                let material = material.map_err(|error| format!("{}: {error}", case.id))?;
                Ok(Self { mu, lambda, material })
            }

            fn material(&self) -> Self::Material {
                self.material
            }

            fn potential(&self) -> Self::Potential {
                let &Self { mu, lambda, .. } = self;
                automatic::$Subject { mu, lambda }
            }

            $($special)?
        }
    };
}

of_two_moduli!(
    StVenantKirchhoff,
    "Saint Venant–Kirchhoff",
    "st_venant_kirchhoff",
    fn special<E: Number>(&self, work: Work) -> Vec<Contestant<E>> {
        let &Self { mu, lambda, .. } = self;
        methods::by_invariants(invariants::StVenantKirchhoff { mu, lambda }, work)
    }
);

of_two_moduli!(
    NeoHookean,
    "neo-Hookean",
    "neo_hookean",
    fn special<E: Number>(&self, work: Work) -> Vec<Contestant<E>> {
        let &Self { mu, lambda, .. } = self;
        methods::by_invariants(invariants::NeoHookean { mu, lambda }, work)
    }
);

of_two_moduli!(
    RotatedLinear,
    "rotated linear",
    "rotated_linear",
    fn special<E: Number>(&self, work: Work) -> Vec<Contestant<E>> {
        let &Self { mu, lambda, .. } = self;
        vec![methods::by_polar_decomposition(polar::RotatedLinear { mu, lambda }, work)]
    }
);

of_two_moduli!(Hencky, "Hencky", "hencky");

/// Ogden's energy with three terms: those that a case has fewer have a modulus of zero.
pub(crate) struct Ogden {
    mu: [f64; 3],
    alpha: [f64; 3],
    kappa: f64,
    material: catalogue::Ogden<3>,
}

impl Subject for Ogden {
    const NAME: &'static str = "Ogden, three terms";
    const IN_CATALOGUE: &'static str = "ogden";
    type Material = catalogue::Ogden<3>;
    type Potential = automatic::Ogden<3>;

    fn of_case(case: &Case) -> Result<Self, String> {
        let values = case.values(&<catalogue::Ogden<3> as Declared>::DESCRIPTION)?;
        let [mu, alpha, kappa] = &values[..] else {
            return Err(format!("{}: not three parameters", case.id));
        };
        // Any exponent would do.
        let filled = |list: &[f64], with| std::array::from_fn(|p| list.get(p).copied().unwrap_or(with));
        let (mu, alpha, kappa) = (filled(mu, 0.0), filled(alpha, 2.0), kappa[0]);
        let material = catalogue::Ogden::new(mu, alpha, kappa);
        let material = material.map_err(|error| format!("{}: {error}", case.id))?;
        Ok(Self { mu, alpha, kappa, material })
    }

    fn material(&self) -> Self::Material {
        self.material
    }

    fn potential(&self) -> Self::Potential {
        let &Self { mu, alpha, kappa, .. } = self;
        automatic::Ogden { mu, alpha, kappa }
    }
}
