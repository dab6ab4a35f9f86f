//! The command `piola`.
fn main() {}
