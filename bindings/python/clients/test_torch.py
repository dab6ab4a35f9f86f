"""torch: energies that autograd differentiates twice, and parameters fitted through a body at rest."""

import numpy as np
import piola
import pytest
import solids

torch = pytest.importorskip("torch", reason="no torch: its wheels for Linux on PyPI are far larger than 300 MB")

import piola.torch  # noqa: E402


def neo_hooke(F, mu=solids.MU, lambda_=solids.LAMBDA):
    log = torch.log(torch.linalg.det(F))
    return mu / 2 * ((F * F).sum((-2, -1)) - 3) - mu * log + lambda_ / 2 * log**2


def points(count=20):
    return torch.from_numpy(np.ascontiguousarray(np.moveaxis(solids.deformations(count).reshape(3, 3, -1), -1, 0)))


def derivatives(energy, F):
    F = F.clone().requires_grad_()
    psi = energy(F)
    (P,) = torch.autograd.grad(psi.sum(), F, create_graph=True)
    rows = [torch.autograd.grad(P[:, i, j].sum(), F, retain_graph=True)[0] for i in range(3) for j in range(3)]
    return psi.detach(), P.detach(), torch.stack(rows, dim=1).reshape(-1, 3, 3, 3, 3)


def test_derivatives_agree():
    material = solids.neo_hooke()
    found = derivatives(lambda F: piola.torch.energy(material, F), points())
    for one, other in zip(found, derivatives(neo_hooke, points())):
        assert solids.difference(one.numpy(), other.numpy()) < 1e-12


def test_gradients_pass_the_check_of_torch():
    F = points(1)[:2].requires_grad_()
    material = solids.neo_hooke()
    mu, lambda_ = (torch.tensor(value, dtype=torch.float64, requires_grad=True) for value in (0.8, 4.0))
    assert torch.autograd.gradcheck(lambda F: piola.torch.energy(material, F), F)
    assert torch.autograd.gradgradcheck(lambda F: piola.torch.energy(material, F), F)
    function = lambda F, mu, lambda_: piola.torch.stress(material, F, mu=mu, lambda_=lambda_)
    assert torch.autograd.gradcheck(function, (F, mu, lambda_))
    alpha = torch.tensor([1.3, -2.0], dtype=torch.float64, requires_grad=True)
    ogden = piola.Material("ogden", mu=[1.0, -0.2], alpha=[1.3, -2.0], kappa=5.0)
    assert torch.autograd.gradcheck(lambda F, alpha: piola.torch.stress(ogden, F, alpha=alpha), (F, alpha))


def test_single_precision_stays_so():
    F = points().float().requires_grad_()
    piola.torch.energy(solids.neo_hooke(), F).sum().backward()
    assert F.grad.dtype == torch.float32


def test_parameters_are_broadcast_with_the_points():
    F, mu = points(2)[:3].requires_grad_(), [0.5, 1.0, 2.0, 4.0]
    material = piola.Material("neo_hookean", mu=np.array(mu)[:, None], lambda_=solids.LAMBDA)
    psi = piola.torch.energy(material, F)
    assert psi.shape == (4, 3)
    (found,) = torch.autograd.grad(psi.sum(), F)
    (expected,) = torch.autograd.grad(sum(neo_hooke(F, value).sum() for value in mu), F)
    assert solids.difference(found.numpy(), expected.numpy()) < 1e-12


def test_parameters_are_fitted_through_a_body_at_rest():
    """A bar hangs by its end; its moduli are found from where its nodes are."""
    points, tets = piola.box_mesh((4, 1, 1), (4.0, 1.0, 1.0))
    free = np.flatnonzero(points[:, 0] > 0)
    loads = torch.zeros(len(points), 3, dtype=torch.float64)
    loads[points[:, 0] == 4.0, 1] = -0.002
    loads[points[:, 0] == 4.0, 0] = 0.05
    X, T = torch.from_numpy(points), torch.from_numpy(tets)
    edges = lambda x: torch.stack([x[T[:, k]] - x[T[:, 0]] for k in (1, 2, 3)], dim=-1)
    inverse, volume = torch.linalg.inv(edges(X)), torch.linalg.det(edges(X)) / 6

    def residual(x, material, parameters):
        P = piola.torch.stress(material, edges(x) @ inverse, **parameters)
        each = volume[:, None, None] * P @ inverse.transpose(1, 2)
        force = torch.zeros_like(X).index_add(0, T[:, 0], -each.sum(-1))
        for k in (1, 2, 3):
            force = force.index_add(0, T[:, k], each[..., k - 1])
        return (force - loads)[free].reshape(-1)

    def rest(mu, lambda_):
        """Positions at rest: piola's, and one more step of Newton's method, which torch differentiates."""
        material = piola.Material("neo_hookean", mu=float(mu), lambda_=float(lambda_))
        body = piola.Body(points, tets, material, 1.0)
        simulation = piola.Simulation(body, pins=np.flatnonzero(points[:, 0] == 0), newton={"tolerance": 1e-13})
        simulation.set_forces(loads.numpy())
        simulation.equilibrate()
        x = simulation.positions.copy()
        K = np.zeros((len(points), 3, len(points), 3))
        rows, columns, blocks = body.stiffness_blocks(x)
        K[rows, :, columns, :] = blocks
        K = torch.from_numpy(K[np.ix_(free, range(3), free, range(3))].reshape(3 * len(free), -1))
        x = torch.from_numpy(x)
        step = torch.linalg.solve(K, residual(x, material, {"mu": mu, "lambda_": lambda_}))
        return x.index_add(0, torch.from_numpy(free), -step.reshape(-1, 3))

    truth = rest(*torch.tensor([0.8, 4.0], dtype=torch.float64)).detach()
    logs = torch.tensor([0.0, 1.0], dtype=torch.float64, requires_grad=True)
    search = torch.optim.LBFGS([logs], max_iter=60, tolerance_grad=1e-14, tolerance_change=1e-16, line_search_fn="strong_wolfe")

    def loss():
        search.zero_grad()
        mu, lambda_ = torch.exp(logs)
        value = 1e3 * ((rest(mu, lambda_) - truth) ** 2).sum()
        value.backward()
        return value

    search.step(loss)
    mu, lambda_ = torch.exp(logs).tolist()
    assert mu == pytest.approx(0.8, rel=1e-5) and lambda_ == pytest.approx(4.0, rel=1e-4)
