//! A material on the bench: what a testing machine would say of an energy before any body is made of it.
//!
//! The crate knows materials only through the traits of [`piola::material`], so that an energy of one's own is as welcome
//! as one of the catalogue. There are no bodies here: each specimen is deformed homogeneously.
