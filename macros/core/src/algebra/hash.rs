//! Hash tables for the small keys of a compiler: ids, nodes, operations.
//!
//! They are filled and asked thousands of times for each material, and the crates that procedural macros are made of are
//! built without optimisation by default. There the hash function of the standard library, which resists whoever chooses
//! keys to collide, costs a quarter of an expansion. Nobody chooses keys here.

use std::hash::{BuildHasherDefault, Hasher};

/// A hash map of this crate.
pub type HashMap<K, V> = std::collections::HashMap<K, V, BuildHasherDefault<Words>>;

/// A hash set of this crate.
pub type HashSet<K> = std::collections::HashSet<K, BuildHasherDefault<Words>>;

/// Multiplies word by word.
#[derive(Clone, Copy, Debug, Default)]
pub struct Words(u64);

impl Words {
    fn add(&mut self, word: u64) {
        // An odd number near 2⁶⁴ divided by the golden ratio; the shift brings high bits, which the product mixes best, down
        // to where tables look first.
        let product = (self.0 ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        self.0 = product ^ (product >> 32);
    }
}

impl Hasher for Words {
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.add(u64::from(byte));
        }
    }

    fn write_u8(&mut self, word: u8) {
        self.add(u64::from(word));
    }

    fn write_u32(&mut self, word: u32) {
        self.add(u64::from(word));
    }

    fn write_u64(&mut self, word: u64) {
        self.add(word);
    }

    fn write_usize(&mut self, word: usize) {
        self.add(word as u64);
    }

    fn write_isize(&mut self, word: isize) {
        self.add(word as u64);
    }

    fn write_i128(&mut self, word: i128) {
        self.add(word as u64);
        self.add((word >> 64) as u64);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}
