"""Invertible isotropic hyperelasticity: materials, points, bodies.

>>> import numpy as np, piola
>>> rubber = piola.Material("neo_hookean", mu=1e6, lambda_=5e6)
>>> shear = np.array([[1.0, 0.2, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
>>> bool(abs(rubber.stress(shear)[0, 1] - 0.2e6) < 1e-6)
True

All is in SI units, and points lie along the leading axes of arrays: F has the shape (..., 3, 3).

The modules `piola.felupe`, `piola.torch`, `piola.jax` and `piola.plot` are imported by their names; each needs the
library that it is called by, `piola.plot` matplotlib.
"""

from piola._piola import (
    Body,
    Description,
    Material,
    Parameter,
    Simulation,
    box_mesh,
    catalogue,
    declare,
    describe,
    measurements,
    num_threads,
    set_num_threads,
    treloar,
    turn_tets,
)
from piola.errors import (
    BodyError,
    ContractError,
    DeclarationError,
    DomainError,
    Error,
    FitError,
    MaterialError,
    StepError,
)
from piola.results import Curve, Fit, Moduli, Stability, Status, Walk

__all__ = [
    "Body",
    "BodyError",
    "ContractError",
    "Curve",
    "DeclarationError",
    "Description",
    "DomainError",
    "Error",
    "Fit",
    "FitError",
    "Material",
    "MaterialError",
    "Moduli",
    "Parameter",
    "Simulation",
    "Stability",
    "Status",
    "StepError",
    "Walk",
    "box_mesh",
    "catalogue",
    "declare",
    "describe",
    "measurements",
    "num_threads",
    "set_num_threads",
    "treloar",
    "turn_tets",
]
