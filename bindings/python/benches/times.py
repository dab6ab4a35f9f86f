"""Times of piola from Python: the overhead of a call, and stress and tangent compared with what clients do without it.

    python benches/times.py [--points N]

Each time is the best of several runs, all in one process, those that are compared one after the other. piola uses
one thread, unless a line says otherwise; what the others use is their own choice.
"""

import argparse
import importlib.util
import pathlib
import sys
import time

import numpy as np

import piola

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "clients"))

import solids  # noqa: E402


def best(call, seconds=0.6, least=3):
    """The shortest time of a call, s, of as many as the time allows."""
    call()
    times, end = [], time.perf_counter() + seconds
    while len(times) < least or time.perf_counter() < end:
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def has(*modules):
    return all(importlib.util.find_spec(module) for module in modules)


def overhead():
    """Time of a call for one point, less a loop that does nothing."""
    rubber, F, out = solids.neo_hooke(), np.diag([1.1, 1.0, 0.9]), np.empty((3, 3))
    count = range(1000)

    def per_call(call):
        def loop():
            for _ in count:
                call()

        return best(loop) / len(count)

    print(f"stress of one point            {1e9 * per_call(lambda: rubber.stress(F)):8.0f} ns")
    print(f"stress of one point, out=      {1e9 * per_call(lambda: rubber.stress(F, out=out)):8.0f} ns")
    print(f"tangent of one point           {1e9 * per_call(lambda: rubber.tangent(F)):8.0f} ns")


def many(points):
    """Times for a point of large arrays."""
    F = np.eye(3) + 0.2 * np.random.default_rng(1).uniform(-1, 1, (points, 3, 3))
    columns = np.ascontiguousarray(F.transpose(1, 2, 0))
    P, A = np.empty_like(F), np.empty((*F.shape, 3, 3))
    P_t, A_t = np.empty_like(columns), np.empty((3, 3, *columns.shape))
    print(f"\nns a point of {points}          threads      P   P, dP/dF   (3, 3, n): P   P, dP/dF")
    for name, rubber in {"neo-Hookean": solids.neo_hooke(), "Ogden, declared": solids.ogden()}.items():
        for count in sorted({1, piola.num_threads()}):
            threads = count > 1
            calls = (
                lambda: rubber.stress(F, out=P, threads=threads),
                lambda: rubber.tangent(F, out=(P, A), threads=threads),
                lambda: rubber.stress(columns, trailing=True, out=P_t, threads=threads),
                lambda: rubber.tangent(columns, trailing=True, out=(P_t, A_t), threads=threads),
            )
            each = [1e9 * best(call) / points for call in calls]
            print(f"{name:26} {count:9} {each[0]:6.1f} {each[1]:10.1f} {each[2]:14.1f} {each[3]:10.1f}")


def compare(client, what, other, own, points):
    there, here = best(other), best(own)
    print(
        f"{client:32} {what:12} {1e9 * there / points:9.0f} ns {1e9 * here / points:7.0f} ns {there / here:8.1f}"
    )


def clients(cells):
    F = solids.deformations(cells)
    points = F[0, 0].size
    print(f"\nP and dP/dF of {points} points         solid          without       piola    ratio")
    own = {name: getattr(solids, name)() for name in ("neo_hooke", "yeoh", "ogden")}

    def by_piola(name):
        return lambda: own[name].tangent(F, trailing=True, threads=False)

    if has("felupe"):
        import felupe
        import test_felupe

        for name in own:
            for library, umat in test_felupe.others(name).items():
                both = lambda: (umat.gradient([F, None]), umat.hessian([F, None]))
                adapted = piola_umat(own[name], F)
                compare(f"felupe {felupe.__version__}, {library}", name, both, adapted, points)
    if has("skfem"):
        import test_skfem

        compare("scikit-fem, by hand", "neo_hooke", lambda: test_skfem.by_hand(F), by_piola("neo_hooke"), points)
    rows = np.ascontiguousarray(np.moveaxis(F.reshape(3, 3, -1), -1, 0))
    if has("jax"):
        import jax
        import test_jax

        import piola.jax

        for name, energy in test_jax.SOLIDS.items():
            F_jax, called = jax.numpy.asarray(rows), jax.jit(piola.jax.tangent(own[name]))
            both = jax.jit(jax.vmap(lambda F: (jax.grad(energy)(F), jax.hessian(energy)(F))))
            there = lambda: jax.block_until_ready(both(F_jax))
            compare("JAX, grad and hessian", name, there, lambda: own[name].tangent(rows, threads=False), points)
            compare("  piola called back from JAX", name, there, lambda: jax.block_until_ready(called(F_jax)), points)
    if has("torch"):
        import torch
        import test_torch

        F_torch = torch.from_numpy(rows)
        there = lambda: test_torch.derivatives(test_torch.neo_hooke, F_torch)
        compare("torch, autograd twice", "neo_hooke", there, lambda: own["neo_hooke"].tangent(rows, threads=False), points)


def piola_umat(material, F):
    import piola.felupe

    umat = piola.felupe.Umat(material)
    return lambda: (umat.gradient([F, None]), umat.hessian([F, None]))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=1_000_000, help="points of the large arrays")
    parser.add_argument("--cells", type=int, default=2000, help="cells of eight points, for the clients")
    arguments = parser.parse_args()
    overhead()
    many(arguments.points)
    piola.set_num_threads(1)
    clients(arguments.cells)
