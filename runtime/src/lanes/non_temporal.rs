//! Order between stores past the caches and all others.

#![cfg_attr(target_arch = "x86_64", expect(unsafe_code, reason = "an instruction; see its SAFETY"))]

/// A guard of stores past the caches: once it is dropped, later stores are seen after them.
///
/// The processor does not order such stores with the ordinary ones by which threads synchronise their work.
/// Therefore only this crate makes a guard, and lets no other thread see what was written until it is
/// dropped.
#[derive(Debug)]
pub struct NonTemporal(());

impl NonTemporal {
    pub(crate) fn new() -> Self {
        Self(())
    }
}

impl Drop for NonTemporal {
    fn drop(&mut self) {
        // SAFETY: every processor of x86-64 has SSE.
        #[cfg(target_arch = "x86_64")]
        unsafe {
            std::arch::x86_64::_mm_sfence();
        }
    }
}
