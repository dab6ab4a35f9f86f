//! Observers of long computations.

/// Observer of a run, which may end it.
pub trait Watch: Send {
    /// Called when the files of a frame have been written; 0 is the start.
    fn frame(&mut self, frame: usize) {
        let _ = frame;
    }

    /// True to end the run with the frames that it has. Called before each step.
    fn stops(&mut self) -> bool {
        false
    }
}

/// An observer that does nothing.
impl Watch for () {}
