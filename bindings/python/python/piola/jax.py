"""Energies for JAX: functions that `jax.grad`, `jax.jvp`, `jax.hessian`, `jax.vmap` and `jax.jit` know.

What is computed runs on the processor, called back from the program of JAX, in the precision of F.
"""

import jax
import jax.numpy as jnp
import numpy as np


def energy(material):
    """The function F ↦ ψ, Pa, twice differentiable: F of shape (..., 3, 3), ψ of shape (...)."""
    P = stress(material)

    @jax.custom_jvp
    def psi(F):
        return _call(material.energy, F, F.shape[:-2])

    @psi.defjvp
    def psi_jvp(primals, tangents):
        (F,), (dF,) = primals, tangents
        return psi(F), jnp.einsum("...ij,...ij->...", P(F), dF)

    return psi


def stress(material):
    """The function F ↦ P, Pa, differentiable: of shapes (..., 3, 3)."""
    both = tangent(material)

    @jax.custom_jvp
    def P(F):
        return _call(material.stress, F, F.shape)

    @P.defjvp
    def P_jvp(primals, tangents):
        (F,), (dF,) = primals, tangents
        stress, dP_dF = both(F)
        return stress, jnp.einsum("...ijkl,...kl->...ij", dP_dF, dF)

    return P


def tangent(material, *, filter=None):
    """The function F ↦ (P, dP/dF), Pa, in one call, for whoever needs all of it: not differentiable further.

    filter: as of `Material.tangent`.
    """

    def both(F):
        return _call(lambda F: material.tangent(F, filter=filter), F, F.shape, (*F.shape, 3, 3))

    return both


def _call(function, F, *shapes):
    results = tuple(jax.ShapeDtypeStruct(shape, F.dtype) for shape in shapes)
    results = results if len(results) > 1 else results[0]
    return jax.pure_callback(lambda F: function(np.asarray(F)), results, F, vmap_method="expand_dims")
