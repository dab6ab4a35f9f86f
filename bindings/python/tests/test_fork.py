"""Processes that are copied, and objects that are sent to them."""

import multiprocessing
import pickle

import numpy as np
import piola
import pytest


def _stress(material):
    F = np.repeat(np.diag([1.1, 1.0, 0.9])[None], 10_000, axis=0)
    return material.stress(F, threads=True)[-1]


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_children_have_threads_of_their_own(method):
    material = piola.Material.typical("ogden")
    here = _stress(material)
    with multiprocessing.get_context(method).Pool(1) as pool:
        there = pool.apply_async(_stress, (material,)).get(timeout=60)
    assert np.array_equal(here, there)


def test_materials_can_be_pickled():
    for material in [
        piola.Material("neo_hookean", mu=1e6, lambda_=5e6, extend=0.2),
        piola.declare("mu/2*(I1 - 3) - mu*ln(J) + kappa/2*(J - 1)^2", mu=1e6, kappa=1e7),
    ]:
        copy = pickle.loads(pickle.dumps(material))
        assert repr(copy) == repr(material) and copy.extend == material.extend
        F = np.diag([1.3, 1.0, 0.7])
        assert np.array_equal(copy.stress(F), material.stress(F))
