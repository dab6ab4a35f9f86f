"""Bodies, and bodies in motion."""

import sys
import threading

import meshio
import numpy as np
import piola
import pytest
from scipy import sparse
from scipy.sparse.linalg import spsolve


@pytest.fixture
def rubber():
    return piola.Material("neo_hookean", mu=1e5, lambda_=4e5)


@pytest.fixture
def beam():
    return piola.box_mesh((4, 1, 1), (0.4, 0.1, 0.1))


def wobbly(points, rng):
    return points + 0.005 * rng.uniform(-1, 1, points.shape)


def test_energy_gradient_and_stiffness_are_derivatives(rubber, beam, rng):
    points, tets = beam
    body = piola.Body(points, tets, rubber, 1000.0)
    assert body.energy(points) == pytest.approx(0, abs=1e-9)
    assert body.masses.sum() == pytest.approx(1000 * 0.4 * 0.1 * 0.1)
    x, d, h = wobbly(points, rng), rng.uniform(-1, 1, points.shape), 1e-7
    gradient, K = body.gradient(x), body.stiffness(x)
    slope = (body.energy(x + h * d) - body.energy(x - h * d)) / (2 * h)
    assert (gradient * d).sum() == pytest.approx(slope, rel=1e-6)
    slopes = (body.gradient(x + h * d) - body.gradient(x - h * d)) / (2 * h)
    assert np.allclose(K @ d.ravel(), slopes.ravel(), rtol=1e-5, atol=1e-4 * np.abs(slopes).max())
    assert abs(K - K.T).max() == 0
    assert isinstance(K, sparse.csr_array) and K.shape == (points.size, points.size) and K.has_canonical_format
    assert K.indices.dtype == K.indptr.dtype == np.int32  # which solvers take as they are
    rows, columns, blocks = body.stiffness_blocks(x)
    dense = np.zeros((len(points), 3, len(points), 3))
    dense[rows, :, columns, :] = blocks
    assert np.array_equal(dense.reshape(K.shape), K.toarray())
    assert list(zip(rows, columns)) == sorted({(i, j) for tet in tets for i in tet for j in tet})
    clamped = body.stiffness(1.2 * points * [1, 1, 0.4], filter="clamp").toarray()
    assert np.linalg.eigvalsh(clamped).min() > -1e-9 * np.abs(clamped).max()


def test_stiffness_does_not_depend_on_the_numbers_of_nodes(rubber, beam, rng):
    points, tets = beam
    x, numbers = wobbly(points, rng), rng.permutation(len(points))
    K = piola.Body(points, tets, rubber, 1000.0).stiffness(x).toarray()
    shuffled = piola.Body(points[numbers], np.argsort(numbers)[tets], rubber, 1000.0).stiffness(x[numbers])
    assert shuffled.has_canonical_format
    places = (3 * numbers[:, None] + np.arange(3)).ravel()
    assert np.allclose(shuffled.toarray(), K[places][:, places], rtol=1e-12, atol=1e-12 * np.abs(K).max())


def test_blocks_need_no_scipy(rubber, beam, monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.sparse", None)
    points, tets = beam
    body = piola.Body(points, tets, rubber, 1000.0)
    with pytest.raises(ImportError, match="install scipy, or use Body.stiffness_blocks"):
        body.stiffness(points)
    assert body.stiffness_blocks(points)[2].shape[1:] == (3, 3)


def test_a_newton_method_of_ones_own_finds_the_equilibrium(rubber, beam):
    points, tets = beam
    body = piola.Body(points, tets, rubber, 1000.0)
    pins = np.flatnonzero(points[:, 0] == 0)
    weight = body.masses[:, None] * np.array([0, -9.81, 0])
    free = np.setdiff1d(np.arange(points.size), 3 * pins[:, None] + np.arange(3))
    x = points.copy()
    for _ in range(12):
        K = body.stiffness(x)[free][:, free]
        force = (weight - body.gradient(x)).ravel()[free]
        x.ravel()[free] += spsolve(K, force)
    hanging = piola.Simulation(body, pins=pins, gravity=(0, -9.81, 0), newton={"tolerance": 1e-12})
    report = hanging.equilibrate()
    assert report["newton"]["convergence"] in ("tolerance", "rounding")
    assert np.abs(hanging.positions - x).max() < 1e-9 * 0.4
    assert (points[:, 1] - x[:, 1]).max() > 0.01


def test_meshes_come_from_meshio(tmp_path, rubber, beam):
    points, tets = beam
    meshio.Mesh(points, {"tetra": tets}).write(tmp_path / "beam.vtk")
    mesh = meshio.read(tmp_path / "beam.vtk")
    body = piola.Body(mesh.points, mesh.cells_dict["tetra"], rubber, 1000.0)
    assert repr(body) == "<piola.Body of 20 nodes and 24 tetrahedra>"
    simulation = piola.Simulation(body, gravity=[0, 0, -10])
    simulation.step(0.1)
    mesh.points = simulation.positions
    mesh.point_data["velocity"] = simulation.velocities
    mesh.write(tmp_path / "fallen.vtk")
    assert np.allclose(meshio.read(tmp_path / "fallen.vtk").points[:, 2], points[:, 2] - 0.1)


def test_the_order_of_nodes_carries_no_physics(rubber, beam, rng):
    points, tets = beam
    x = wobbly(points, rng)
    for tets_of, named in (([3], ": 3;"), (range(24), r": 0, 1, .*, 19 and 4 more;")):
        reversed_tets = tets.copy()
        reversed_tets[tets_of] = tets[tets_of][:, [0, 2, 1, 3]]
        with pytest.raises(piola.BodyError, match=f"{len(tets_of)} of 24 elements .*{named}.*`turn_tets`"):
            piola.Body(points, reversed_tets, rubber, 1000.0)
        turned = piola.turn_tets(points, reversed_tets)
        assert np.array_equal(turned, tets) and (turned != reversed_tets).any(axis=1).sum() == len(tets_of)
        body, right = (piola.Body(points, order, rubber, 1000.0) for order in (turned, tets))
        assert body.energy(x) == right.energy(x)


def test_meshes_may_be_arrays_of_any_type(rubber, beam, rng):
    points, tets = beam
    x = wobbly(points, rng)
    energy = piola.Body(points, tets, rubber, 1000.0).energy(x)
    for nodes in (np.asfortranarray(points), points.tolist(), points.astype(">f8")):
        for corners in (tets.astype(np.int32), tets.astype(np.uint64), np.asfortranarray(tets), tets.tolist()):
            assert piola.Body(nodes, corners, rubber, 1000.0).energy(x) == energy
    single = piola.Body(points.astype(np.float32), tets, rubber, 1000.0)
    assert single.energy(x) == pytest.approx(energy, rel=1e-4)
    with pytest.raises(ValueError, match=r"points has the shape \(3, 20\); it must be \(n, 3\)"):
        piola.Body(points.T, tets, rubber, 1000.0)


def test_numbers_of_nodes_from_1_and_loose_nodes_are_named(rubber, beam):
    points, tets = beam
    with pytest.raises(piola.BodyError, match="the 20 nodes are numbered from 0; here they are from 1: subtract 1"):
        piola.Body(points, tets + 1, rubber, 1000.0)
    loose = np.vstack([points, [[9, 9, 9]]])
    with pytest.raises(piola.BodyError, match=r"node 20 \(from 0\) belongs to no .*leave such nodes out"):
        piola.Body(loose, tets, rubber, 1000.0)
    used, tets = np.unique(tets, return_inverse=True)
    assert len(piola.Body(loose[used], tets.reshape(-1, 4), rubber, 1000.0).points) == 20


def test_steps_move_and_report(rubber, beam):
    points, tets = beam
    left, right = (np.flatnonzero(points[:, 0] == x) for x in (0, points[:, 0].max()))
    for integrator in ("implicit_euler", "sdirk2", "sdirk3"):
        body = piola.Body(points, tets, rubber, 1000.0)
        simulation = piola.Simulation(body, pins=np.r_[left, right], integrator=integrator)
        simulation.prescribe(right, points[right] + [0.1, 0, 0])
        report = simulation.step(0.01)
        assert np.allclose(simulation.positions[right], points[right] + [0.1, 0, 0])
        assert report["min_det"] > 0 and report["energies"]["elastic"] > 0
        assert report["energies"] == simulation.energies()
        assert simulation.settings["integrator"] == integrator and simulation.pins == sorted([*left, *right])


def test_reactions_hold_the_body(rubber, beam):
    points, tets = beam
    body = piola.Body(points, tets, rubber, 1000.0)
    pins, weight = np.flatnonzero(points[:, 0] == 0), 1000 * 0.4 * 0.1 * 0.1 * 9.81
    hanging = piola.Simulation(body, pins=pins, gravity=(0, -9.81, 0), newton={"tolerance": 1e-10})
    hanging.equilibrate()
    reactions = hanging.reactions()
    assert reactions.shape == (len(pins), 3)
    assert np.allclose(reactions.sum(axis=0), [0, weight, 0], atol=1e-6 * weight)
    held = body.gradient(hanging.positions) - body.masses[:, None] * [0, -9.81, 0]
    assert np.allclose(reactions, held[hanging.pins], atol=1e-9 * weight)
    right = np.flatnonzero(points[:, 0] == points[:, 0].max())
    pulled = piola.Simulation(body, pins=np.r_[right, pins], newton={"tolerance": 1e-10})
    pulled.prescribe(right, points[right] + [0.04, 0, 0])
    pulled.equilibrate()
    by_node = dict(zip(pulled.pins, pulled.reactions()))
    assert sum(by_node[k] for k in right)[0] > 0 > sum(by_node[k] for k in pins)[0]
    assert np.allclose(sum(by_node.values()), 0, atol=1e-6)
    free = piola.Simulation(body)
    assert free.reactions().shape == (0, 3)
    free.positions = points * [1, 1, -1]
    with pytest.raises(piola.StepError, match="outside the domain"):
        free.reactions()


def test_state_is_read_and_set_as_a_whole(rubber, beam):
    points, tets = beam
    body = piola.Body(points, tets, rubber, 1000.0)
    simulation = piola.Simulation(body)
    for array in (simulation.positions, simulation.velocities, body.points, body.masses):
        assert not array.flags.writeable
        with pytest.raises(ValueError, match="read-only"):
            array[0] += 1
    x = simulation.positions.copy()
    x[5] += 0.01
    simulation.positions = x.astype(np.float32).tolist()
    assert np.array_equal(simulation.positions, x.astype(np.float32))
    before = simulation.positions
    simulation.step(0.001)
    assert np.array_equal(before, x.astype(np.float32)) and not np.array_equal(simulation.positions, before)


def test_a_state_is_saved_and_restored(rubber, beam, tmp_path):
    points, tets = beam
    body = piola.Body(points, tets, rubber, 1000.0)
    settings = {"pins": np.flatnonzero(points[:, 0] == 0), "gravity": (0, -9.81, 0), "integrator": "sdirk2"}
    first = piola.Simulation(body, **settings)
    for _ in range(3):
        first.step(0.01)
    names = ("positions", "velocities", "accelerations")
    np.savez(tmp_path / "state.npz", **{name: getattr(first, name) for name in names})
    second, saved = piola.Simulation(body, **settings), np.load(tmp_path / "state.npz")
    for name in names:
        setattr(second, name, saved[name])
    assert np.array_equal(second.reactions(), first.reactions())
    assert first.step(0.01)["energies"] == second.step(0.01)["energies"]
    assert all(np.array_equal(getattr(first, name), getattr(second, name)) for name in names)
    with pytest.raises(piola.BodyError):
        second.accelerations = points[:3]


def test_an_equilibrium_that_there_is_not_is_told(rubber, beam):
    points, tets = beam
    body = piola.Body(points, tets, rubber, 1000.0)
    free = piola.Simulation(body, gravity=(0, -9.81, 0))
    with pytest.raises(piola.StepError, match=r"no pin, spring or term holds the body, .* add up to 39\.2\d* N"):
        free.equilibrate()
    assert np.array_equal(free.positions, points)
    pins = np.flatnonzero(points[:, 0] == 0)
    hasty = piola.Simulation(body, pins=pins, gravity=(0, -9.81, 0), newton={"max_iterations": 1})
    with pytest.warns(UserWarning, match="no equilibrium within `max_iterations`: the residual is"):
        assert hasty.equilibrate()["newton"]["convergence"] == "limit"


def test_forces_pins_and_settings_change(rubber, beam):
    points, tets = beam
    simulation = piola.Simulation(piola.Body(points, tets, rubber, 1000.0), damping=1.0)
    simulation.set_forces(np.tile([1.0, 0, 0], (len(points), 1)))
    simulation.step(0.01)
    assert (simulation.velocities[:, 0] > 0).all()
    simulation.set_settings(gravity=(0, -9.81, 0))
    simulation.pins = [0, 1]
    simulation.velocities = np.zeros_like(points)
    simulation.positions = 1.1 * points
    simulation.step(0.01)
    assert simulation.pins == [0, 1] and np.array_equal(simulation.positions[:2], 1.1 * points[:2])
    assert simulation.settings["damping"] == 0.0


def test_parts_have_materials_of_their_own(rubber, beam):
    points, tets = beam
    stiff = piola.Material("neo_hookean", mu=1e6, lambda_=4e6)
    half = (points[tets].mean(axis=1)[:, 0] > 0.2).astype(int)
    x = points * [1.01, 1, 1]
    soft, hard = (piola.Body(points, tets, material, 1.0).energy(x) for material in (rubber, stiff))
    both = piola.Body(points, tets, [rubber, stiff], [1.0, 2.0], parts=half)
    assert both.energy(x) == pytest.approx((soft + hard) / 2)
    assert both.masses.sum() == pytest.approx(1.5 * 0.4 * 0.01)
    formula = "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2"
    graded = piola.declare(formula, mu=np.where(half, 1e6, 1e5), lambda_=np.where(half, 4e6, 4e5))
    assert piola.Body(points, tets, graded, 1.0).energy(x) == pytest.approx((soft + hard) / 2)
    uniform = piola.declare(formula, mu=[1e5], lambda_=[4e5])
    assert piola.Body(points, tets, uniform, 1.0).energy(x) == pytest.approx(soft)
    for wrong in ([1e5, 1e5], np.full((24, 1), 1e5)):
        with pytest.raises(piola.MaterialError, match="parameters of the shape .* there are 24 tetrahedra"):
            piola.Body(points, tets, piola.declare(formula, mu=wrong, lambda_=4e5), 1.0)


def test_inverted_bodies_recover(beam):
    points, tets = beam
    material = piola.Material("neo_hookean", mu=1e5, lambda_=4e5, extend=0.1)
    simulation = piola.Simulation(piola.Body(points, tets, material, 1000.0))
    simulation.positions = points * [1, 1, 0]
    simulation.positions = simulation.positions + 1e-4 * np.random.default_rng(1).normal(size=points.shape)
    simulation.equilibrate()
    edges = lambda x: np.linalg.norm(x[tets[:, 1]] - x[tets[:, 0]], axis=1)
    assert np.allclose(edges(simulation.positions), edges(points), rtol=1e-3)


def test_mistakes_are_named(rubber, beam):
    points, tets = beam

    def message(error, call):
        with pytest.raises(error) as caught:
            call()
        return str(caught.value)

    new = piola.Body
    assert "(n, 3)" in message(ValueError, lambda: new(points[:, :2], tets, rubber, 1.0))
    assert "(n, 4)" in message(ValueError, lambda: new(points, tets[:, :3], rubber, 1.0))
    assert "whole numbers" in message(TypeError, lambda: new(points, tets.astype(float), rubber, 1.0))
    assert "negative" in message(ValueError, lambda: new(points, -tets, rubber, 1.0))
    assert "density is -1" in message(piola.BodyError, lambda: new(points, tets, rubber, -1.0))
    assert "it must be a piola.Material" in message(TypeError, lambda: new(points, tets, "rubber", 1.0))
    assert "parts" in message(piola.BodyError, lambda: new(points, tets, [rubber, rubber], [1.0, 1.0]))
    assert "materials and" in message(piola.BodyError, lambda: new(points, tets, [rubber, rubber], 1.0))
    assert "no part" in message(piola.BodyError, lambda: new(points, tets, [rubber], 1.0, parts=np.ones(24, int)))
    assert "24" in message(piola.BodyError, lambda: new(points, tets, rubber, 1.0, parts=np.zeros(3, int)))
    for nonsense in (tets + 1000, tets[:, [1, 0, 2, 3]], np.zeros_like(tets)):
        with pytest.raises(piola.BodyError):
            new(points, nonsense, rubber, 1.0)
    with pytest.raises(piola.BodyError):
        new(points * np.nan, tets, rubber, 1.0)
    body = new(points, tets, rubber, 1.0)
    with pytest.raises(piola.BodyError):
        body.energy(points[:3])
    assert "domain" in message(piola.DomainError, lambda: body.gradient(points * [1, 1, -1]))
    assert "domain" in message(piola.DomainError, lambda: body.stiffness(points * np.nan))
    simulate = piola.Simulation
    assert "unknown field `gravty`" in message(piola.BodyError, lambda: simulate(body, gravty=(0, 0, 0)))
    assert "implicit_euler" in message(piola.BodyError, lambda: simulate(body, integrator="euler"))
    assert "tolerance" in message(piola.BodyError, lambda: simulate(body, newton={"tolerance": 2.0}))
    mask = points[:, 0] == 0
    assert "numpy.flatnonzero" in message(TypeError, lambda: simulate(body, pins=mask))
    assert "no node 1000" in message(piola.BodyError, lambda: simulate(body, pins=[1000]))
    masked = np.ma.masked_array([0, 1], mask=[False, True])
    assert "whole numbers" in message(TypeError, lambda: simulate(body, pins=masked))
    with pytest.raises((TypeError, ValueError)):
        simulate(body, gravity=object())
    simulation = simulate(body, pins=[0])
    assert "not pinned" in message(piola.BodyError, lambda: simulation.prescribe([1], [[0, 0, 0]]))
    assert "time step" in message(piola.StepError, lambda: simulation.step(-1.0))
    assert "time step" in message(piola.StepError, lambda: simulation.step(float("nan")))
    with pytest.raises(piola.BodyError):
        simulation.positions = points * np.nan
    simulation.positions = points * [1, 1, -1]
    with pytest.raises(piola.StepError):
        simulation.step(0.01)
    with pytest.raises(piola.BodyError):
        piola.box_mesh((0, 1, 1), (1, 1, 1))
    with pytest.raises(piola.BodyError):
        piola.box_mesh((10**9, 10**9, 10**9), (1, 1, 1))
    with pytest.raises((TypeError, OverflowError)):
        piola.box_mesh((-1, 1, 1), (1, 1, 1))


def test_threads_may_share_a_body_and_a_simulation(rubber, rng):
    points, tets = piola.box_mesh((12, 4, 4), (0.6, 0.2, 0.2))
    body = piola.Body(points, tets, rubber, 1000.0)
    simulation = piola.Simulation(body, gravity=(0, -10, 0))
    x = wobbly(points, rng)
    expected, errors = body.gradient(x), []

    def work():
        try:
            for _ in range(20):
                assert np.array_equal(body.gradient(x), expected)
                simulation.step(0.001)
                simulation.positions
        except Exception as error:
            errors.append(error)

    workers = [threading.Thread(target=work) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert not errors
    assert simulation.velocities[:, 1] == pytest.approx(-10 * 0.001 * 80)
