//! piola for programs in C.
