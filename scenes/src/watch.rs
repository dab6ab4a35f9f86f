//! Observers of long computations.

/// Observer of a run, who may end it.
pub trait Watch: Send {
    /// Is called when the files of a frame have been written; 0 is the start.
    fn frame(&mut self, frame: usize) {
        let _ = frame;
    }

    /// Whether the run is to end with the frames that it has. Is asked before each step.
    fn stops(&mut self) -> bool {
        false
    }
}

/// An observer who does nothing.
impl Watch for () {}
