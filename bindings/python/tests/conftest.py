"""What several tests share: deformations, and a solid whose stress and tangent are known on paper."""

import numpy as np
import pytest

MU, LAMBDA = 0.7e6, 3e6


@pytest.fixture
def rng():
    return np.random.default_rng(23)


@pytest.fixture
def F(rng):
    """Some hundred moderate deformations."""
    return deformations(rng, 333)


def deformations(rng, count):
    F = np.eye(3) + 0.25 * rng.uniform(-1, 1, (count, 3, 3))
    return F[np.linalg.det(F) > 0.2]


def neo_hookean(F, mu=MU, lambda_=LAMBDA):
    """ψ, P and dP/dF of μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)², by inverses and outer products.

    Parameters are broadcast with the points.
    """
    mu, lambda_ = np.asarray(mu), np.asarray(lambda_)
    of_matrix, of_tangent = (..., *[None] * 2), (..., *[None] * 4)
    inverse = np.linalg.inv(F)
    by_J = np.swapaxes(inverse, -1, -2)
    log = np.log(np.linalg.det(F))
    psi = mu / 2 * (np.einsum("...ij,...ij->...", F, F) - 3) - mu * log + lambda_ / 2 * log**2
    P = mu[of_matrix] * (F - by_J) + (lambda_ * log)[of_matrix] * by_J
    identity = np.einsum("ik,jl->ijkl", np.eye(3), np.eye(3))
    crossed = np.einsum("...li,...jk->...ijkl", inverse, inverse)
    straight = np.einsum("...ij,...kl->...ijkl", by_J, by_J)
    A = mu[of_tangent] * identity + (mu - lambda_ * log)[of_tangent] * crossed + lambda_[of_tangent] * straight
    return psi, P, A


def close(found, expected, tolerance=1e-12):
    """Whether numbers agree relative to the largest of them."""
    return np.abs(found - expected).max() <= tolerance * np.abs(expected).max()
