"""scikit-fem: a hyperelastic bar by its forms, with stress and tangent by hand and by piola."""

import numpy as np
import pytest
import solids

skfem = pytest.importorskip("skfem")

from skfem.helpers import ddot, grad, identity  # noqa: E402

MU, LAMBDA = solids.MU, solids.LAMBDA


def by_hand(F):
    """P and dP/dF of the neo-Hookean solid, as a user of scikit-fem writes them; F of shape (3, 3, ...)."""
    J = skfem.helpers.det(F)
    by_J = np.swapaxes(skfem.helpers.inv(F), 0, 1)
    P = MU * (F - by_J) + LAMBDA * np.log(J) * by_J
    identity = np.eye(3)
    A = (
        MU * np.einsum("ik,jl->ijkl", identity, identity)[..., None, None]
        + (MU - LAMBDA * np.log(J)) * np.einsum("il...,kj...->ijkl...", by_J, by_J)
        + LAMBDA * np.einsum("ij...,kl...->ijkl...", by_J, by_J)
    )
    return P, A


def by_piola(F):
    return solids.neo_hooke().tangent(F, trailing=True)


def solve(respond):
    """A bar hung by its end, bent by a traction of its other end: displacements and norms of residuals."""
    mesh = skfem.MeshHex.init_tensor(np.linspace(0, 2, 9), np.linspace(0, 1, 5), np.linspace(0, 1, 5))
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementHex1()), intorder=3)
    end = skfem.FacetBasis(mesh, basis.elem, facets=mesh.facets_satisfying(lambda x: x[0] == 2.0))

    @skfem.BilinearForm
    def stiffness(u, v, w):
        return np.einsum("ij...,ijkl...,kl...->...", grad(v), w["A"], grad(u))

    @skfem.LinearForm
    def forces(v, w):
        return ddot(w["P"], grad(v))

    @skfem.LinearForm
    def traction(v, w):
        return 0.02 * v[1]

    load, held = traction.assemble(end), basis.get_dofs(lambda x: x[0] == 0.0)
    u, residuals = basis.zeros(), []
    for _ in range(20):
        field = grad(basis.interpolate(u))
        P, A = respond(field + identity(field))
        residual = load - forces.assemble(basis, P=P)
        residuals.append(np.linalg.norm(np.delete(residual, held.all())))
        if residuals[-1] < 1e-13:
            break
        u = u + skfem.solve(*skfem.condense(stiffness.assemble(basis, A=A), residual, D=held))
    return u, residuals


def test_stresses_and_tangents_agree():
    F = solids.deformations(50)
    for found, expected in zip(by_piola(F), by_hand(F)):
        assert solids.difference(found, expected) < 1e-12


def test_bars_agree():
    (hand, residuals), (piola, others) = solve(by_hand), solve(by_piola)
    assert np.abs(hand).max() > 0.05
    assert np.abs(piola - hand).max() < 1e-9
    assert len(residuals) == len(others) < 10
