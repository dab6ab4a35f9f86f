//! The energies by name, for programs that choose a material at run time.

use piola::Inversion;
use piola::batch::TileMaterial;
use piola::material::{Declared, Description, Fittable, Inadmissible, Moduli};

use crate::{
    AnssariBenamBucchi, Arap, ArrudaBoyce, BlatzKo, Carroll, CiarletGeymonat, CiarletNeoHookean,
    ExponentiatedHencky, ExtendedTube, FixedCorotated, Fung, Gent, GentGent, GentThomas, Hencky,
    IsochoricNeoHookean, IsochoricOgden, Knowles, LopezPamies, MooneyRivlin, MooneyRivlinCoupled, NeoHookean,
    Ogden, RotatedLinear, StVenantKirchhoff, StableNeoHookean, Storakers, StretchSpline, SymmetricDirichlet,
    ValanisLandel, Varga, Yeoh,
};

/// An energy of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// By which it is chosen, such as `neo_hookean_lnj`.
    pub name: &'static str,
    /// Formula, parameters, domain.
    pub description: Description,
    /// Parameters of some real material, one slice for each parameter of the description in its order, in SI units.
    ///
    /// Their sources stand with each energy. The constructor accepts them, and the extension where there is one.
    pub typical: &'static [&'static [f64]],
}

/// What can be done with a material whose type is only known inside.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// Meets the material, its type static from here on.
    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output;
}

/// What can be done with a material whose derivatives by its parameters are known.
pub trait FittableVisitor {
    /// What comes of it.
    type Output;

    /// Meets the material, its type static from here on.
    fn visit<M: Fittable + 'static>(self, material: M) -> Self::Output;
}

/// Energies without lists, and energies whose lists have one of these lengths; each with its typical parameters. What is declared
/// `without fit` does not know its derivatives by these.
macro_rules! catalogue {
    ($($name:literal => $Material:ident $(<$($length:literal)|+>)? $(without $fit:ident)? [$([$($typical:expr),+]),+]),+ $(,)?) => {
        /// All energies.
        pub static CATALOGUE: &[Entry] = &[
            $(Entry {
                name: $name,
                description: catalogue!(@description $Material $($($length)+)?),
                typical: &[$(&[$($typical),+]),+],
            }),+
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
                    _ => Err(self.stranger()),
                }
            }

            /// Builds the material and shows it to the visitor, together with its derivatives by the parameters.
            ///
            /// `values` has one slice for each parameter of the description, in its order.
            ///
            /// # Errors
            /// As [`Entry::visit`], and [`Inadmissible::NotFittable`] where a parameter is a function.
            pub fn visit_fittable<V: FittableVisitor>(
                &self,
                values: &[&[f64]],
                inversion: Inversion,
                visitor: V,
            ) -> Result<V::Output, Inadmissible> {
                match self.name {
                    $($name => catalogue!(
                        @visit_fittable [$($fit)?] values, inversion, visitor, $Material $($($length)+)?
                    ),)+
                    _ => Err(self.stranger()),
                }
            }
        }
    };
    (@description $Material:ident) => { <$Material as Declared>::DESCRIPTION };
    (@description $Material:ident $first:literal $($length:literal)*) => { <$Material<$first> as Declared>::DESCRIPTION };
    (@visit_fittable [fit] $values:ident, $inversion:ident, $visitor:ident, $Material:ident) => {
        Err(Inadmissible::NotFittable { material: <$Material as Declared>::DESCRIPTION.name })
    };
    (@visit_fittable [] $($rest:tt)+) => { catalogue!(@visit $($rest)+) };
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
    "anssari_benam_bucchi" => AnssariBenamBucchi [[3.3e5], [30.0], [2e7]],
    "arap" => Arap [[1.0]],
    "arruda_boyce" => ArrudaBoyce [[3.3e5], [5.2], [2e7]],
    "blatz_ko" => BlatzKo [[2.2e5], [0.0], [1.0]],
    "carroll" => Carroll [[1.46e5], [0.31], [1.25e5], [2e7]],
    "ciarlet_geymonat" => CiarletGeymonat [[1.8e5], [3.4e3], [5e6]],
    "ciarlet_neo_hookean" => CiarletNeoHookean [[3.8e5], [2e7]],
    "exponentiated_hencky" => ExponentiatedHencky [[3.9e5], [0.25], [2e7], [0.125]],
    "extended_tube" => ExtendedTube [[2.05e5], [0.094], [1.8e5], [0.2], [2e7]],
    "fixed_corotated" => FixedCorotated [[5.8e4], [3.9e4]],
    "fung" => Fung [[2.7e4], [0.5], [0.5]],
    "gent" => Gent [[3.3e5], [108.0], [2e7]],
    "gent_gent" => GentGent [[2.6e5], [81.0], [2.0e5], [2e7]],
    "gent_thomas" => GentThomas [[1.4e5], [1.7e5], [2e7]],
    "hencky" => Hencky [[1.36e5], [2.04e5]],
    "isochoric_neo_hookean" => IsochoricNeoHookean [[3.8e5], [2e7]],
    "isochoric_ogden" => IsochoricOgden<1 | 2 | 3> [[3.5e5, 96.0], [2.0, 6.0], [2e7]],
    "knowles" => Knowles [[3.3e5], [0.024], [2.0], [2e7]],
    "lopez_pamies" => LopezPamies<1 | 2 | 3> [[3.53e5, 15.9], [1.0, 4.45], [2e7]],
    "mooney_rivlin" => MooneyRivlin [[1.8e5], [3.4e3], [2e7]],
    "mooney_rivlin_coupled" => MooneyRivlinCoupled [[1.8e5], [3.4e3], [2e7]],
    "neo_hookean_lnj" => NeoHookean [[3.8e5], [2e7]],
    "ogden" => Ogden<1 | 2 | 3 | 4 | 5 | 6> [[6.3e5, 1.2e3, -1e4], [1.3, 5.0, -2.0], [2e7]],
    "rotated_linear" => RotatedLinear [[3.4e5], [3.1e6]],
    "stable_neo_hookean" => StableNeoHookean [[4.5e3], [1.4e5]],
    "storakers" => Storakers<1 | 2 | 3> [[2.2e5], [2.0], [0.5]],
    "stretch_spline" => StretchSpline without fit [
        [0.25, -3.6e5, 0.5, -1.8e5, 1.0, 0.0, 2.0, 1.2e5, 3.0, 2.0e5, 5.0, 8.0e5],
        [0.1, -2.0e4, 1.0, 0.0, 4.0, 3.0e4],
        [0.1, -4.0e6, 0.5, -1.5e6, 1.0, 0.0, 2.0, 2.5e6]
    ],
    "stvk" => StVenantKirchhoff [[8.1e10], [1.2e11]],
    "symmetric_dirichlet" => SymmetricDirichlet [[1.0]],
    "valanis_landel" => ValanisLandel [[3.9e5], [2e7]],
    "varga" => Varga [[4.0e5], [2e7]],
    "yeoh" => Yeoh [[1.85e5], [-1.46e3], [40.4], [2e7]],
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
    /// Entries are public, and so can be made of anything.
    fn stranger(&self) -> Inadmissible {
        Inadmissible::Shape { expected: format!("`{}` is not in the catalogue", self.name) }
    }

    /// The material for the elements of a body: dispatched once for each block of them.
    ///
    /// # Errors
    /// As [`Entry::visit`].
    pub fn elements(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn TileMaterial<f64>>, Inadmissible> {
        struct Boxed;
        impl Visitor for Boxed {
            type Output = Box<dyn TileMaterial<f64>>;
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
