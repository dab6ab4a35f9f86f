//! The energies by name, for programs that choose a material at run time.

use piola::material::{Declared, Description, MaterialError};
use piola::{DynMaterial, Inversion};

#[cfg(doc)]
use crate::DECLARATIONS;
use crate::{CATALOGUE, Kind};

/// The text of an energy of the catalogue, from [`DECLARATIONS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Declaration {
    /// The name by which the energy is chosen, such as `neo_hookean`.
    pub name: &'static str,
    /// True if it is an energy of rubber: its typical parameters are those of a vulcanised rubber, and it can
    /// be fitted to tests of others.
    pub is_rubber: bool,
    /// The declaration, as `piola_declare::Energy::from_rust` takes it.
    pub source: &'static str,
}

/// A compiled energy, from [`CATALOGUE`] or [`find`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Entry {
    /// The name by which it is chosen, such as `neo_hookean`.
    pub name: &'static str,
    /// Formula, parameters, domain.
    pub description: Description,
    pub(crate) kind: Kind,
}

/// An action on a material whose type is known only inside.
pub trait Visitor: Sized {
    /// The result of the action.
    type Output;

    /// Meets the material, its type static from here on.
    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output;
}

/// Declares the energies of the crate: for each its feature, its file, its type with the lengths that its
/// lists may have at run time, and whether it is `for rubber`.
macro_rules! catalogue {
    ($($feature:literal $module:ident::$Material:ident $(<$($length:literal),+>)? $(for $rubber:ident)?,)+) => {
        $(
            #[cfg(feature = $feature)]
            mod $module;
            #[cfg(feature = $feature)]
            pub use $module::$Material;
        )+

        /// The declarations of all energies in the order of their names, those of features that are off too:
        /// `piola_declare` makes energies of them at run time.
        pub static DECLARATIONS: &[Declaration] = &[$(
            Declaration {
                name: stringify!($module),
                is_rubber: catalogue!(@is $($rubber)?),
                source: include_str!(concat!(stringify!($module), ".rs")),
            },
        )+];

        /// The energies of the features that are on, in the order of their names.
        ///
        /// | name | type | feature |
        /// |---|---|---|
        $(#[cfg_attr(
            feature = $feature,
            doc = concat!("| `", stringify!($module), "` | [`", stringify!($Material), "`] | `", $feature, "` |")
        )])+
        pub static CATALOGUE: &[Entry] = &[$(
            #[cfg(feature = $feature)]
            Entry {
                name: stringify!($module),
                description: catalogue!(@description $Material $($($length)+)?),
                kind: Kind::$Material,
            },
        )+];

        /// The type of an entry.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) enum Kind {
            $(#[cfg(feature = $feature)] $Material,)+
        }

        impl Entry {
            /// Builds the material and shows it to the visitor.
            ///
            /// `values` has one slice for each parameter of the description, in its order.
            ///
            /// # Errors
            /// [`MaterialError`](piola::material::MaterialError) if the constructor of the material refuses,
            /// or a list is longer than the catalogue allows.
            pub fn visit<V: Visitor>(
                &self,
                values: &[&[f64]],
                inversion: ::piola::Inversion,
                visitor: V,
            ) -> Result<V::Output, ::piola::material::MaterialError> {
                let _ = (values, inversion, &visitor);
                match self.kind {$(
                    #[cfg(feature = $feature)]
                    Kind::$Material => catalogue!(
                        @visit values, inversion, visitor, $Material $($($length)+)?
                    ),
                )+}
            }
        }
    };
    (@is) => { false };
    (@is rubber) => { true };
    (@description $Material:ident) => { <$Material as ::piola::material::Declared>::DESCRIPTION };
    (@description $Material:ident $first:literal $($length:literal)*) => { <$Material<$first> as ::piola::material::Declared>::DESCRIPTION };
    (@visit $values:ident, $inversion:ident, $visitor:ident, $Material:ident) => {
        <$Material as ::piola::material::Declared>::from_values($values, $inversion).map(|material| $visitor.visit(material))
    };
    (@visit $values:ident, $inversion:ident, $visitor:ident, $Material:ident $($length:literal)+) => {
        match $values.first().map_or(0, |list| list.len()) {
            $($length => <$Material<$length> as ::piola::material::Declared>::from_values($values, $inversion).map(|material| $visitor.visit(material)),)+
            length => Err(::piola::material::MaterialError::Shape {
                expected: format!(
                    "the lists of {} have {} entries by name, not {length}; other lengths need its type in Rust",
                    stringify!($Material),
                    [$($length.to_string()),+].join(", "),
                ),
            }),
        }
    };
}

pub(crate) use catalogue;

/// The energy of that name.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let entry = piola_materials::find("st_venant_kirchhoff").ok_or("not in the catalogue")?;
/// let material = entry.material(&[&[3.0], &[5.0]], piola::Inversion::Refuse)?;
/// assert!(material.admits([1.2, 1.0, -0.5])); // inverted, and defined
/// # Ok(())
/// # }
/// ```
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}

impl Entry {
    /// The material behind a pointer, for single points, batches and bodies in `f64`.
    ///
    /// # Errors
    /// [`MaterialError`](piola::material::MaterialError), see [`Entry::visit`].
    pub fn material(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn DynMaterial<f64>>, MaterialError> {
        struct Boxed;
        impl Visitor for Boxed {
            type Output = Box<dyn DynMaterial<f64>>;
            fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
                Box::new(material)
            }
        }
        self.visit(values, inversion, Boxed)
    }
}
