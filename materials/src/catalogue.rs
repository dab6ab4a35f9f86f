//! The energies by name, for programs that choose a material at run time.

use piola::Inversion;
use piola::material::{Declared, Description, Inadmissible, Moduli};
use piola::system::element::ElementEnergy;

use crate::{
    Arap, ArrudaBoyce, BlatzKo, FixedCorotated, Fung, Gent, Hencky, MooneyRivlin, MooneyRivlinCoupled,
    NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff, StableNeoHookean, SymmetricDirichlet, Varga, Yeoh,
};

/// An energy of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// By which it is chosen, such as `neo_hookean_lnj`.
    pub name: &'static str,
    /// Formula, parameters, domain.
    pub description: Description,
}

/// What can be done with a material whose type is only known inside.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// Meets the material, its type static from here on.
    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output;
}

/// Energies without lists, and energies whose lists have one of these lengths.
macro_rules! catalogue {
    ($($name:literal => $Material:ident $(<$($length:literal)|+>)?),+ $(,)?) => {
        /// All energies.
        pub static CATALOGUE: &[Entry] = &[
            $(Entry { name: $name, description: catalogue!(@description $Material $($($length)+)?) }),+
        ];

        impl Entry {
            /// Builds the material and shows it to the visitor.
            ///
            /// `values` has one slice for each parameter of the description, in its order.
            ///
            /// # Errors
            /// Where the constructor of the material would refuse, or a list is longer than the catalogue provides for.
            pub fn visit<V: Visitor>(
                &self,
                values: &[&[f64]],
                inversion: Inversion,
                visitor: V,
            ) -> Result<V::Output, Inadmissible> {
                match self.name {
                    $($name => catalogue!(@visit values, inversion, visitor, $Material $($($length)+)?),)+
                    _ => Err(Inadmissible::Shape { expected: format!("`{}` is not in the catalogue", self.name) }),
                }
            }
        }
    };
    (@description $Material:ident) => { <$Material as Declared>::DESCRIPTION };
    (@description $Material:ident $first:literal $($length:literal)*) => { <$Material<$first> as Declared>::DESCRIPTION };
    (@visit $values:ident, $inversion:ident, $visitor:ident, $Material:ident) => {
        $Material::from_values($values, $inversion).map(|material| $visitor.visit(material))
    };
    (@visit $values:ident, $inversion:ident, $visitor:ident, $Material:ident $($length:literal)+) => {
        match $values.first().map_or(0, |list| list.len()) {
            $($length => $Material::<$length>::from_values($values, $inversion).map(|material| $visitor.visit(material)),)+
            length => Err(Inadmissible::Shape {
                expected: format!(
                    "the lists of {} have {} entries by name, not {length}; other lengths need its type in Rust",
                    stringify!($Material),
                    [$($length.to_string()),+].join(", "),
                ),
            }),
        }
    };
}

catalogue! {
    "arap" => Arap,
    "arruda_boyce" => ArrudaBoyce,
    "blatz_ko" => BlatzKo,
    "fixed_corotated" => FixedCorotated,
    "fung" => Fung,
    "gent" => Gent,
    "hencky" => Hencky,
    "mooney_rivlin" => MooneyRivlin,
    "mooney_rivlin_coupled" => MooneyRivlinCoupled,
    "neo_hookean_lnj" => NeoHookean,
    "ogden" => Ogden<1 | 2 | 3 | 4 | 5 | 6>,
    "rotated_linear" => RotatedLinear,
    "stable_neo_hookean" => StableNeoHookean,
    "stvk" => StVenantKirchhoff,
    "symmetric_dirichlet" => SymmetricDirichlet,
    "varga" => Varga,
    "yeoh" => Yeoh,
}

/// The energy of that name.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let entry = piola_materials::find("stvk").ok_or("not in the catalogue")?;
/// let moduli = entry.moduli(&[&[3.0], &[5.0]], piola::Inversion::Refuse)?;
/// assert_eq!((moduli.mu, moduli.lambda), (3.0, 5.0));
/// # Ok(())
/// # }
/// ```
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}

impl Entry {
    /// The material for the elements of a body: dispatched once for each block of them.
    ///
    /// # Errors
    /// As [`Entry::visit`].
    pub fn elements(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn ElementEnergy>, Inadmissible> {
        struct Boxed;
        impl Visitor for Boxed {
            type Output = Box<dyn ElementEnergy>;
            fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
                Box::new(material)
            }
        }
        self.visit(values, inversion, Boxed)
    }

    /// Small-strain moduli, Pa.
    ///
    /// # Errors
    /// As [`Entry::visit`].
    pub fn moduli(&self, values: &[&[f64]], inversion: Inversion) -> Result<Moduli, Inadmissible> {
        struct Small;
        impl Visitor for Small {
            type Output = Moduli;
            fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
                material.moduli()
            }
        }
        self.visit(values, inversion, Small)
    }
}
