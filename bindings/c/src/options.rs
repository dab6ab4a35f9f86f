//! Options of batches, and their reports.

use piola::batch::{Batch, Layout};
use piola::lanes::Backend;
use piola::point::Filter as PointFilter;
use piola::{StatusCell, Survey as PointSurvey};

use crate::error::{Code, Failure};
use crate::lent::{self, Arrays};
use crate::material::{Material, Precision};

/// Treatment of the negative eigenvalues of dP/dF.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum Filter {
    /// Leaves negative eigenvalues as they are: the exact derivative of the stress.
    None = 0,
    /// Sets negative eigenvalues to zero.
    Clamp = 1,
    /// Replaces negative eigenvalues by their absolute values.
    Absolute = 2,
}

/// The order of the components of many points in an array, N of each point.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum PointLayout {
    /// Point by point: component k of point p at p N + k.
    Points = 0,
    /// Lines of L points, 8 in double precision and 16 in single precision: component k of point p is
    /// at (p/L N + k) L + p mod L. Faster. The number of points must be a multiple of L: fill the last line
    /// up with identities.
    Lines = 1,
}

/// The instructions to compute with.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum Instructions {
    /// The best that the processor has.
    Best = 0,
    /// Instructions that every processor has.
    Portable = 1,
}

/// Options of a batch. `piola_options options = {sizeof options};` has the defaults, and so does null.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Options {
    /// `sizeof(piola_options)`, from which the library determines the fields of the header that a program was
    /// compiled with.
    pub size: usize,
    /// One of `piola_filter`. Stresses in other measures have tangents without a filter.
    pub filter: i32,
    /// One of `piola_layout`, of all arrays of a call except for positions, tetrahedra and statuses.
    pub layout: i32,
    /// One of `piola_instructions`.
    pub instructions: i32,
    /// 1 to share the points among as many threads as there are processors, or as the environment variable
    /// RAYON_NUM_THREADS gives; 0 for the thread of the caller alone. Results have the same bits.
    pub threads: i32,
    /// Array for the status of each point, flags of `piola_status`; or null.
    pub statuses: *mut u8,
    /// Number of statuses: that of the points, or 0.
    pub statuses_length: usize,
}

/// Flags of the status of a point.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StatusFlag {
    /// The deformation is outside the domain of the energy, and the results are invalid.
    Refused = 1,
    /// The tangent is at a pole, and has a bounded value instead of an infinite one.
    Bounded = 2,
    /// The deformation gradient or a result is infinite or NaN, or nearly so: the results are invalid.
    Nonfinite = 4,
    /// The filter has changed the tangent.
    Filtered = 8,
}

/// Counts of the statuses of many points. A point that cannot be computed is not an error of a call: look
/// here.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Survey {
    /// Number of points outside the domain of the energy.
    pub refused: usize,
    /// Number of points at a pole of the tangent.
    pub bounded: usize,
    /// Number of points with an infinite or NaN deformation or result.
    pub nonfinite: usize,
    /// Number of points where the filter has changed the tangent.
    pub filtered: usize,
    /// Index of the first point with invalid results, refused or nonfinite; SIZE_MAX if there is none.
    pub first: usize,
}

impl From<PointSurvey> for Survey {
    fn from(survey: PointSurvey) -> Self {
        let PointSurvey { refused, bounded, nonfinite, filtered, first } = survey;
        Self { refused, bounded, nonfinite, filtered, first: first.unwrap_or(usize::MAX) }
    }
}

/// Options of a call, read and checked.
#[derive(Default)]
pub(crate) struct Chosen<'call> {
    filter: PointFilter,
    layout: Layout,
    backend: Option<Backend>,
    threads: bool,
    statuses: &'call [StatusCell],
}

impl<'call> Chosen<'call> {
    /// The batch of a material with these options.
    #[inline]
    pub(crate) fn batch<E: Precision>(&self, material: &'call Material) -> Result<Batch<'call, E>, Failure> {
        let batch = Batch::new(E::tiles(material)?)
            .with_filter(self.filter)
            .with_layout(self.layout)
            .with_threads(self.threads)
            .with_statuses(self.statuses);
        Ok(self.backend.map_or(batch, |backend| batch.with_backend(backend)))
    }
}

/// The options behind a pointer, or the defaults if that is null.
///
/// # Safety
/// `options` is null, or points to as many bytes as its first field gives, and to its number of statuses.
#[inline]
pub(crate) unsafe fn read<'call>(
    options: *const Options,
    arrays: &mut Arrays<'call>,
) -> Result<Chosen<'call>, Failure> {
    // SAFETY: that of this function; a size is all that is read.
    let Some(&size) = (unsafe { lent::optional("options", options.cast::<usize>()) })? else {
        return Ok(Chosen::default());
    };
    let expected = size_of::<Options>();
    if size != expected {
        let message = format!("`options->size` is {size}; it must be sizeof(piola_options), {expected}");
        return Err(Failure::new(Code::Value, message));
    }
    // SAFETY: the caller vouches for the bytes, which are numbers and a pointer.
    let options = *unsafe { lent::value("options", options) }?;
    // SAFETY: that of this function.
    let statuses = unsafe { arrays.output("options->statuses", options.statuses, options.statuses_length) }?;
    let statuses: *const [u8] = statuses;
    let filters = [PointFilter::None, PointFilter::Clamp, PointFilter::Absolute];
    let is_portable = lent::choice("options->instructions", options.instructions, [false, true])?;
    Ok(Chosen {
        filter: lent::choice("options->filter", options.filter, filters)?,
        layout: lent::choice("options->layout", options.layout, [Layout::Points, Layout::Lines])?,
        backend: is_portable.then(Backend::portable),
        threads: lent::choice("options->threads", options.threads, [false, true])?,
        // SAFETY: a cell is one byte, and nobody else uses these during the call.
        statuses: unsafe { &*(statuses as *const [StatusCell]) },
    })
}
