"""Anything at all as an argument: exceptions of Python, and never a crash."""

import random

import numpy as np
import piola
import pytest

THINGS = [
    None, True, 0, -1, 10**30, 1.5, float("nan"), float("inf"), 1j, "", "x", "clamp", b"x", (), [], {}, {"uniaxial": 3},
    [[]], [None], object(), int, np.eye(3), np.zeros((0, 3, 3)), np.full((3, 3), np.nan), np.ones((2, 3, 3), np.float32),
    np.eye(3, dtype=int), np.array("text"), np.array([None]), np.zeros(3, np.uint8), np.ma.masked_array(np.eye(3), np.eye(3)),
    np.broadcast_to(1.0, (3, 3)), np.zeros((3, 3, 3, 3, 3)), np.zeros((3, 3, 2**20, 0)), np.array(1.0), np.eye(3)[::-1],
    np.eye(4)[:3, 1:], np.arange(4)[None], np.zeros((4, 3)), np.zeros((2, 2), dtype=[("a", "f8")]), np.float64(2), np.int8(3),
    np.array([[1e308] * 3] * 3), np.array([[5e-324] * 3] * 3),
]  # fmt: skip
KEYWORDS = ["filter", "trailing", "out", "status", "threads", "held", "restarts", "incompressible", "tangent", "parts",
            "pins", "gravity", "newton", "extend", "smallest", "largest", "mu", "young", "poisson"]  # fmt: skip


@pytest.mark.parametrize("seed", range(20))
def test_nothing_crashes(seed):
    chance = random.Random(seed)
    material = piola.Material("neo_hookean", mu=1.0, lambda_=1.0)
    points, tets = piola.box_mesh((1, 1, 1), (1.0, 1.0, 1.0))
    body = piola.Body(points, tets, material, 1.0)
    simulation = piola.Simulation(body)
    owners = [material, body, simulation, piola]
    functions = [
        (owner, name)
        for owner in owners
        for name in dir(owner)
        if not name.startswith("_") and callable(getattr(owner, name)) and name not in ("set_num_threads", "stability")
    ]
    calls = 0
    for _ in range(400):
        owner, name = chance.choice(functions)
        function = getattr(owner, name)
        arguments = [chance.choice(THINGS) for _ in range(chance.randrange(4))]
        keywords = {key: chance.choice(THINGS) for key in chance.sample(KEYWORDS, chance.randrange(3))}
        try:
            function(*arguments, **keywords)
        except Exception:
            calls += 1
    assert calls > 100
    assert np.array_equal(material.stress(np.eye(3)), np.zeros((3, 3)))
