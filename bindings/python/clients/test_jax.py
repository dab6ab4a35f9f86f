"""JAX: energies that it differentiates, compared with its own differentiation of the same formulas."""

import numpy as np
import piola
import pytest
import solids

jax = pytest.importorskip("jax")
jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp  # noqa: E402
import piola.jax  # noqa: E402


def neo_hooke(F):
    log = jnp.log(jnp.linalg.det(F))
    return solids.MU / 2 * (jnp.sum(F * F) - 3) - solids.MU * log + solids.LAMBDA / 2 * log**2


def yeoh(F):
    J = jnp.linalg.det(F)
    i = jnp.sum(F * F) * J ** (-2 / 3) - 3
    c1, c2, c3 = solids.YEOH.values()
    return c1 * i + c2 * i**2 + c3 * i**3 + solids.BULK / 2 * (J - 1) ** 2


SOLIDS = {"neo_hooke": neo_hooke, "yeoh": yeoh}


def points(count=20):
    return jnp.asarray(np.moveaxis(solids.deformations(count).reshape(3, 3, -1), -1, 0))


@pytest.mark.parametrize("name", SOLIDS)
def test_derivatives_agree(name):
    F, plain = points(), SOLIDS[name]
    energy = piola.jax.energy(getattr(solids, name)())
    assert solids.difference(energy(F), jax.vmap(plain)(F)) < 1e-12
    assert solids.difference(jax.vmap(energy)(F), jax.vmap(plain)(F)) < 1e-12
    P = jax.jit(jax.vmap(jax.grad(energy)))(F)
    assert solids.difference(P, jax.vmap(jax.grad(plain))(F)) < 1e-12
    assert solids.difference(jax.grad(lambda F: energy(F).sum())(F), P) == 0
    expected = jax.vmap(jax.hessian(plain))(F)
    for second in (jax.hessian, lambda f: jax.jacrev(jax.jacrev(f)), lambda f: jax.jacfwd(jax.grad(f))):
        assert solids.difference(jax.vmap(second(energy))(F), expected) < 1e-11


def test_stress_and_tangent_come_in_one_call():
    F, plain = points(), SOLIDS["yeoh"]
    for function in (piola.jax.tangent(solids.yeoh()), jax.jit(jax.vmap(piola.jax.tangent(solids.yeoh())))):
        P, A = function(F)
        assert solids.difference(P, jax.vmap(jax.grad(plain))(F)) < 1e-12
        assert solids.difference(A, jax.vmap(jax.hessian(plain))(F)) < 1e-11
    A = piola.jax.tangent(solids.yeoh(), filter="clamp")(F)[1]
    assert np.linalg.eigvalsh(np.asarray(A).reshape(-1, 9, 9)).min() > -1e-9


def test_single_precision_stays_so():
    F = points().astype(jnp.float32)
    P = jax.vmap(jax.grad(piola.jax.energy(solids.yeoh())))(F)
    assert P.dtype == jnp.float32
    assert solids.difference(P, jax.vmap(jax.grad(yeoh))(F)) < 1e-4


def test_a_body_of_springs_comes_to_rest():
    """A bar of three points in a row of cells, pulled at its end: Newton's method on derivatives of JAX."""
    energy = piola.jax.energy(solids.neo_hooke())

    def body(u, psi):
        lengths, sides = 1 + jnp.diff(jnp.concatenate([jnp.zeros(1), u[:4]])), 1 + u[4:]
        F = jax.vmap(lambda l, s: jnp.diag(jnp.stack([l, s, s])))(lengths, sides)
        return psi(F).sum() - 0.5 * u[3]

    def solve(psi):
        u = jnp.zeros(8)
        for _ in range(12):
            u = u - jnp.linalg.solve(jax.jacfwd(jax.grad(body))(u, psi), jax.grad(body)(u, psi))
        return u

    found, expected = solve(energy), solve(jax.vmap(neo_hooke))
    assert found[3] > 0.5 and np.abs(found - expected).max() < 1e-9


def test_wrong_arrays_are_refused_when_traced():
    material = solids.yeoh()
    functions = [piola.jax.energy(material), piola.jax.stress(material), piola.jax.tangent(material)]
    functions += [jax.jit(function) for function in functions] + [jax.vmap(function) for function in functions]
    for function in functions:
        for F, error, expected in [
            (jnp.ones((2, 9)), ValueError, "it must be (..., 3, 3)"),
            (jnp.ones((4, 3)), ValueError, "it must be (..., 3, 3)"),
            (jnp.ones((2, 3, 3), int), TypeError, "F is an array of int64; it must be float32 or float64"),
            (jnp.ones((2, 3, 3), jnp.bfloat16), TypeError, "bfloat16"),
            (jnp.ones((2, 3, 3), complex), TypeError, "complex128"),
        ]:
            with pytest.raises(error) as caught:
                function(F)
            assert expected in str(caught.value) and "\n" not in str(caught.value)
    assert np.array_equal(functions[1]([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), np.zeros((3, 3)))


def test_parameters_are_broadcast_with_the_points():
    mu, F = np.linspace(0.5, 2, 4), points()[:3]
    energy = piola.jax.energy(piola.Material("neo_hookean", mu=mu, lambda_=solids.LAMBDA))
    each = [piola.jax.energy(piola.Material("neo_hookean", mu=value, lambda_=solids.LAMBDA)) for value in mu]
    for function in (energy, jax.jit(energy)):
        assert solids.difference(function(F[:, None]), jnp.stack([one(F) for one in each], axis=1)) < 1e-14
        assert solids.difference(jax.vmap(function)(F), jnp.stack([one(F) for one in each], axis=1)) < 1e-14
        gradient = jax.grad(lambda F: function(F[:, None]).sum())(F)
        assert solids.difference(gradient, sum(jax.grad(lambda F: one(F).sum())(F) for one in each)) < 1e-14


def test_a_point_outside_the_domain_is_an_exception():
    with pytest.raises(Exception, match="outside the domain"):
        piola.jax.energy(solids.yeoh())(-jnp.eye(3)).block_until_ready()
