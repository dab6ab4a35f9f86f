"""Energies for JAX: functions that `jax.grad`, `jax.jvp`, `jax.hessian`, `jax.vmap` and `jax.jit` know.

What is computed runs on the processor, called back from the program of JAX, in the precision of F. An F of another shape
or type raises ValueError or TypeError when it is traced.
"""

import functools

import jax
import jax.numpy as jnp
import numpy as np


def energy(material):
    """The function F ↦ ψ, Pa, twice differentiable: F of shape (..., 3, 3), ψ of shape (...)."""
    P = stress(material)

    @jax.custom_jvp
    def psi(F):
        return _call(material, material.energy, F, ())

    @psi.defjvp
    def psi_jvp(primals, tangents):
        (F,), (dF,) = primals, tangents
        return psi(F), jnp.einsum("...ij,...ij->...", P(F), dF)

    return lambda F: psi(_checked(F))


def stress(material):
    """The function F ↦ P, Pa, differentiable: of shapes (..., 3, 3)."""
    both = tangent(material)

    @jax.custom_jvp
    def P(F):
        return _call(material, material.stress, F, (3, 3))

    @P.defjvp
    def P_jvp(primals, tangents):
        (F,), (dF,) = primals, tangents
        stress, dP_dF = both(F)
        return stress, jnp.einsum("...ijkl,...kl->...ij", dP_dF, dF)

    return lambda F: P(_checked(F))


def tangent(material, *, filter=None):
    """The function F ↦ (P, dP/dF), Pa, in one call, for whoever needs all of it: not differentiable further.

    filter: as of `Material.tangent`.
    """

    def both(F):
        function = functools.partial(material.tangent, filter=filter)
        return _call(material, function, _checked(F), (3, 3), (3, 3, 3, 3))

    return both


def _checked(F):
    """F as an array of JAX."""
    F = jnp.asarray(F)
    if F.shape[-2:] != (3, 3):
        raise ValueError(f"F has the shape {F.shape}; it must be (..., 3, 3)")
    if F.dtype not in (jnp.float32, jnp.float64):
        raise TypeError(f"F is an array of {F.dtype}; it must be float32 or float64")
    return F


def _call(material, function, F, *components):
    """Results with these components at each point, called back."""
    points = jnp.broadcast_shapes(F.shape[:-2], material.shape)
    # Axes that `jax.vmap` adds come before all those of the points, parameters included.
    F = F.reshape((1,) * (len(points) + 2 - F.ndim) + F.shape)
    results = [jax.ShapeDtypeStruct((*points, *shape), F.dtype) for shape in components]
    results = tuple(results) if len(results) > 1 else results[0]
    return jax.pure_callback(lambda F: function(np.asarray(F), trailing=False), results, F, vmap_method="expand_dims")
