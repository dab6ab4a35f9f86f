"""What the functions of the package return, where it is more than an array, and what they do in Python."""

from __future__ import annotations

import enum
import json
import re
import unicodedata
import warnings
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from piola import Material


class Status(enum.IntFlag):
    """Flags of a point, in the arrays of uint8 that `status=` fills.

    REFUSED (1): the deformation is outside the domain of the energy; the results are NaN.
    BOUNDED (2): the tangent is at a pole, and has a bounded value instead of an infinite one.
    NONFINITE (4): the deformation or a result is infinite or NaN, or nearly so; the results are NaN.
    FILTERED (8): the filter changed the tangent.
    """

    REFUSED = 1
    """The deformation is outside the domain of the energy, and the results are NaN."""
    BOUNDED = 2
    """The tangent is at a pole, and has a bounded value instead of an infinite one."""
    NONFINITE = 4
    """The deformation or a result is infinite or NaN, or nearly so, and the results are NaN."""
    FILTERED = 8
    """The filter changed the tangent."""


class Moduli(NamedTuple):
    """Moduli at small strain."""

    mu: float
    """Shear modulus, Pa."""
    lambda_: float
    """Lamé's first parameter, Pa."""
    bulk: float
    """Bulk modulus, Pa."""
    young: float
    """Young's modulus, Pa."""
    poisson: float
    """Poisson's ratio."""


class Curve(NamedTuple):
    """A test curve."""

    mode: str
    """The test."""
    control: np.ndarray
    """What the machine sets, of shape (n,): stretch, shear or ratio of volumes."""
    stress: np.ndarray
    """What it reads, Pa, of shape (n,); NaN where there is no point."""
    stretches: np.ndarray
    """Principal stretches, of shape (n, 3)."""
    reasons: list
    """Why there is no point, or None, for each control."""


class Fit(NamedTuple):
    """Parameters that agree best with measurements."""

    material: Material
    """The material with them."""
    errors: dict
    """Standard error of each number, to first order; None where there is none."""
    determination: dict
    """R² of each mode, and of "all"."""
    difference: float
    """Root of the mean square of the differences that were made small: 0.05 is five percent."""
    condition: float
    """How many times worse the fit determines the parameters than the data determine the fit."""
    ended: str
    """Why the search ended."""
    warnings: list
    """Why other parameters might do as well, or better."""


# Words of warnings of a fit in Rust, and the keywords of `Material.fit`.
_KEYWORDS = (
    (r"\blambda\b", "lambda_"),
    (r"`--hold (\w+)`, `FitSettings::held`", r'`held=["\1"]`'),
    (r"`--floor 0.05` \(`FitSettings::floor`\)", "`floor=0.05`"),
    (r"`--absolute` \(a floor of 1\)", "`relative=False`"),
    (r"`--compressible`, `FitSettings::volume`", "`incompressible=False`"),
)


def fitted(*fields):
    """A `Fit`, whose warnings are warnings of Python, too."""
    fit = Fit(*fields)
    for words, keyword in _KEYWORDS:
        fit.warnings[:] = [re.sub(words, keyword, warning) for warning in fit.warnings]
    for warning in fit.warnings:
        warnings.warn(warning, stacklevel=2)
    return fit


def readings(mode, table):
    """Control and stress, Pa: the columns of an array, or those of a DataFrame that their names say."""
    from piola import measurements

    names = list(getattr(table, "columns", ()))
    if not names or not all(isinstance(name, str) for name in names):
        return table
    # As pandas and polars write tables.
    text = table.to_csv(index=False) if hasattr(table, "to_csv") else table.write_csv()
    return measurements(text, mode=mode, unit="Pa")[mode]


class Walk(NamedTuple):
    """A path of stretches from rest, up to its end."""

    path: str
    """"uniaxial", "equibiaxial", "pure_shear", "confined" or "hydrostatic"."""
    to: float
    """The stretch that it was to be walked to."""
    reached: float
    """The stretch that was reached."""
    lost: dict
    """The stretch at which each criterion is lost first, or None."""


class Stability(NamedTuple):
    """Where a material keeps the inequalities of a stable solid."""

    points: int
    """Points of the box of stretches."""
    admitted: int
    """Points inside of the domain."""
    kept: dict
    """Points that keep "baker_ericksen", "hill" and "strong_ellipticity"."""
    walks: list
    """A `Walk` along each path, to either end of the range."""
    report: str
    """All of this in words."""

    def __str__(self):
        return self.report


def as_array(given):
    """`numpy.asarray`, with NaN for masked entries, of an array or of the arrays in lists, and numbers for objects."""
    if isinstance(given, np.ma.MaskedArray) and np.ma.is_masked(given):
        given = (given.astype(float) if given.dtype.kind in "iub" else given).filled(np.nan)
    elif isinstance(given, (list, tuple)) and _has_masked_array(given):
        given = [as_array(array) for array in given]
    array = np.asarray(given)
    # Objects that are numbers to Python, such as fractions.
    return np.asarray(np.frompyfunc(float, 1, 1)(array), float) if array.dtype == object else array


def _has_masked_array(given):
    """True for a masked array, and for a list with one in it, at any depth."""
    if isinstance(given, (list, tuple)):
        return any(map(_has_masked_array, given))
    return isinstance(given, np.ma.MaskedArray)


def as_identifiers(text):
    """A text with the letters that Python substitutes in keywords: μ for the micro sign, φ for ϕ."""
    letters = (not c.isascii() and c.isidentifier() for c in text)
    return "".join(unicodedata.normalize("NFKC", c) if is_letter else c for c, is_letter in zip(text, letters))


def csr_array(rows, columns, blocks, nodes):
    """The matrix of blocks of 3x3 that come row by row."""
    try:
        from scipy.sparse import bsr_array
    except ImportError as cause:
        advice = "install scipy, or use Body.stiffness_blocks, which returns arrays"
        raise ImportError(f"Body.stiffness returns a matrix of scipy: {advice}") from cause
    # Solvers take indices of 32 bits, unless there are too many entries.
    dtype = np.int32 if 9 * len(rows) < 2**31 else np.int64
    starts = np.searchsorted(rows, np.arange(nodes + 1))
    return bsr_array((blocks, columns.astype(dtype), starts.astype(dtype)), (3 * nodes, 3 * nodes)).tocsr()


def broadcast(F, points, trailing):
    """A contiguous F whose points have another shape, to which they can be broadcast."""
    if trailing:
        # Axes are added before those of the points.
        F = F.reshape((3, 3) + (1,) * (2 + len(points) - F.ndim) + F.shape[2:])
    return np.ascontiguousarray(np.broadcast_to(F, (3, 3, *points) if trailing else (*points, 3, 3)))


def question_axes(shape, trailing):
    """Warns of an F with its points on either side, and refuses one with points on the side that is not chosen."""
    shape = tuple(shape)
    if trailing is not None or shape[-2:] != (3, 3):
        raise ValueError(f"F has the shape {shape}; it must be (..., 3, 3), or (3, 3, ...) with `trailing=True`")
    warnings.warn(
        f"F has the shape {shape}, and its points were taken to be on the first axes; pass `trailing=False` if they are, "
        "`trailing=True` if they are on the last",
        stacklevel=2,
    )


def warn_of_limit(residual):
    """Warns of a body that the limit of iterations has left out of balance."""
    warnings.warn(f"no equilibrium within `max_iterations`: the residual is {residual:.3g} N", stacklevel=2)


def to_json(settings):
    """Settings as JSON, arrays of numpy as lists."""

    def plain(value):
        if hasattr(value, "tolist"):
            return value.tolist()
        kind = type(value).__name__
        raise TypeError(f"a setting is of type {kind}; it must be a number, a string or a list of these")

    return json.dumps(settings, default=plain)
