//! piola for programs in Python.
