"""Energies for JAX: functions that `jax.grad`, `jax.jvp`, `jax.hessian`, `jax.vmap` and `jax.jit` know.

What is computed runs on the processor, called back from the program of JAX.
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
        return _call(material.energy, F, F.shape[:-2])

    @psi.defjvp
    def psi_jvp(primals, tangents):
        (F,), (dF,) = primals, tangents
        return psi(F), jnp.einsum("...ij,...ij->...", P(F), dF)

    return psi


def stress(material):
    """The function F ↦ P, Pa, differentiable: of shapes (..., 3, 3)."""

    @jax.custom_jvp
    def P(F):
        return _call(material.stress, F, F.shape)

    @P.defjvp
    def P_jvp(primals, tangents):
        (F,), (dF,) = primals, tangents
        A = _call(lambda F: material.tangent(F)[1], F, (*F.shape, 3, 3))
        return P(F), jnp.einsum("...ijkl,...kl->...ij", A, dF)

    return P


def _call(function, F, shape):
    result = jax.ShapeDtypeStruct(shape, F.dtype)
    return jax.pure_callback(functools.partial(_on_numpy, function), result, F, vmap_method="expand_dims")


def _on_numpy(function, F):
    return function(np.asarray(F))
