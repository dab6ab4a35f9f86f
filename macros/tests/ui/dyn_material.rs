//! A material behind `dyn` is a `DynMaterial`: the message for the wrong trait shows the right one.

use piola::Material;

fn stiffest(_: &[Box<dyn Material>]) {}

fn main() {}
