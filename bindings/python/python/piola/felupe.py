"""Materials for felupe: `felupe.SolidBody(piola.felupe.Umat(material), field)`."""

import numpy as np


class Umat:
    """A material as felupe takes it, in place of one of its own.

    filter: what becomes of negative eigenvalues of dP/dF, as of `Material.tangent`.

    F has the shape (3, 3, ...), and `out` is an array for the first result, or None. A trial of Newton's method
    that leaves the domain of the energy raises `DomainError`, where other materials give NaN.
    """

    def __init__(self, material, *, filter=None):
        self.material = material
        self.filter = filter
        self.x = [np.eye(3), np.zeros(0)]

    def function(self, x):
        """[ψ], Pa, of x = [F, state]."""
        return [self.material.energy(x[0], trailing=True)]

    def gradient(self, x, out=None):
        """[P, state], Pa."""
        return [self.material.stress(x[0], trailing=True, out=_fitting(out, x[0].shape)), x[-1]]

    def hessian(self, x, out=None):
        """[dP/dF], Pa."""
        F = x[0]
        out = _fitting(out, (3, 3, *F.shape))
        return [self.material.tangent(F, filter=self.filter, trailing=True, out=(None, out))[1]]


def _fitting(out, shape):
    """An array of an earlier call, unless it has become one of another kind."""
    return out if out is not None and out.shape == shape and out.flags.c_contiguous else None
