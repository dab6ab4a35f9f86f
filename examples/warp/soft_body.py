"""A soft body of tetrahedra in kernels of Warp; its stress comes from one file that `piola emit` has printed.

It falls on the plane y = 0 with explicit steps, symplectic Euler. There is no damping, so that the total energy
says how good the steps are.
"""

import argparse
import re
import sys
import time
from pathlib import Path

import numpy as np
import warp as wp

GRAVITY = 9.81  # m/s²
DENSITY = 1000.0  # kg/m³
# The ground pushes nodes back like springs of this angular frequency, for any mass.
GROUND = 400.0  # 1/s
# Bits of a status with which a result means nothing: outside of the domain, not finite.
FAILED = 1 | 4


class Kernels:
    """Forces, energies and steps with the energy of an emitted file, in its number format.

    The text of the file stands before the code that Warp generates, on the CPU as on CUDA; native functions call it.
    """

    def __init__(self, text):
        prefix, number = re.search(r"(\w+)_energy\(.*const (float|double) F", text).groups()
        parameters = f"const {prefix}_parameters p = {prefix.upper()}_EXAMPLE;"
        self.real = real = {"float": wp.float32, "double": wp.float64}[number]
        self.vector = vector = wp.types.vector(3, real)
        self.matrix = matrix = wp.types.matrix((3, 3), real)

        # Matrices of Warp are stored row by row, as the file has them. Arguments are copies, except for arrays.
        @wp.func_native(f"""
            {parameters}
            wp::mat_t<3, 3, {number}> P;
            status[element] = {prefix}_stress(&p, F.data[0], P.data[0]);
            return P;
        """)
        def stress(F: matrix, element: int, status: wp.array(dtype=wp.uint32)) -> matrix: ...

        @wp.func_native(f"""
            {parameters}
            {number} psi;
            status[element] = {prefix}_energy(&p, F.data[0], &psi);
            return psi;
        """)
        def density(F: matrix, element: int, status: wp.array(dtype=wp.uint32)) -> real: ...

        @wp.func
        def gradient(x: wp.array(dtype=vector), t: wp.vec4i, inverse: matrix):
            return wp.matrix_from_cols(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]], x[t[3]] - x[t[0]]) * inverse

        options = {
            "extra_build_options": wp.ModuleBuildOptions(extra_cpu_preamble=text, extra_cuda_preamble=text),
            # On CUDA, too, only what the file writes as fma is fused.
            "fuse_fp": False,
        }
        kernel = wp.kernel(enable_backward=False, module="unique", module_options=options)

        @kernel
        def forces(
            x: wp.array(dtype=vector),
            tetrahedra: wp.array(dtype=wp.vec4i),
            inverse: wp.array(dtype=matrix),
            volume: wp.array(dtype=real),
            force: wp.array(dtype=vector),
            status: wp.array(dtype=wp.uint32),
        ):
            e = wp.tid()
            t = tetrahedra[e]
            P = stress(gradient(x, t, inverse[e]), e, status)
            # f = −V P Dm⁻ᵀ, a column for each of the nodes 1, 2 and 3; the four forces add up to zero.
            f = -volume[e] * P * wp.transpose(inverse[e])
            for k in range(3):
                column = vector(f[0, k], f[1, k], f[2, k])
                wp.atomic_add(force, t[k + 1], column)
                wp.atomic_add(force, t[0], -column)

        @kernel
        def energies(
            x: wp.array(dtype=vector),
            tetrahedra: wp.array(dtype=wp.vec4i),
            inverse: wp.array(dtype=matrix),
            volume: wp.array(dtype=real),
            energy: wp.array(dtype=real),
            status: wp.array(dtype=wp.uint32),
        ):
            e = wp.tid()
            energy[e] = volume[e] * density(gradient(x, tetrahedra[e], inverse[e]), e, status)

        @kernel
        def step(
            x: wp.array(dtype=vector),
            v: wp.array(dtype=vector),
            force: wp.array(dtype=vector),
            mass: wp.array(dtype=real),
            dt: real,
        ):
            n = wp.tid()
            upwards = real(GROUND * GROUND) * wp.max(-x[n][1], real(0.0)) - real(GRAVITY)
            v[n] += dt * (force[n] / mass[n] + vector(real(0.0), upwards, real(0.0)))
            x[n] += dt * v[n]

        self.forces, self.energies, self.step = forces, energies, step


class Body:
    """Tetrahedra of positive volume, at rest where their nodes are given."""

    def __init__(self, kernels, rest, tetrahedra, device=None):
        self.kernels, self.device = kernels, device
        edges = np.stack([rest[tetrahedra[:, k]] - rest[tetrahedra[:, 0]] for k in (1, 2, 3)], axis=-1)
        volume = np.linalg.det(edges) / 6
        if not (volume > 0).all():
            raise ValueError("a tetrahedron is inverted at rest")
        self.mass = DENSITY / 4 * np.bincount(tetrahedra.ravel(), np.repeat(volume, 4), len(rest))
        self.elements = [
            wp.array(tetrahedra.astype(np.int32), dtype=wp.vec4i, device=device),
            wp.array(np.linalg.inv(edges), dtype=kernels.matrix, device=device),
            wp.array(volume, dtype=kernels.real, device=device),
        ]
        self.x = wp.array(rest, dtype=kernels.vector, device=device)
        self.v, self.force = wp.zeros_like(self.x), wp.zeros_like(self.x)
        self.masses = wp.array(self.mass, dtype=kernels.real, device=device)
        self.energy = wp.zeros(len(volume), dtype=kernels.real, device=device)
        self.status = wp.zeros(len(volume), dtype=wp.uint32, device=device)

    def launch(self, kernel, *inputs):
        """Launches a kernel for as many threads as its last array has entries."""
        count = [len(one) for one in inputs if isinstance(one, wp.array)][-1]
        wp.launch(kernel, dim=count, inputs=list(inputs), device=self.device)

    def compute_forces(self):
        """Elastic forces, N."""
        self.force.zero_()
        self.launch(self.kernels.forces, self.x, *self.elements, self.force, self.status)

    def step(self, dt):
        """One step of symplectic Euler."""
        self.compute_forces()
        self.launch(self.kernels.step, self.x, self.v, self.force, self.masses, self.kernels.real(dt))

    def total_energy(self):
        """Elastic and kinetic energy, and those of gravity and of the ground, J."""
        self.launch(self.kernels.energies, self.x, *self.elements, self.energy, self.status)
        x, v = self.x.numpy().astype(float), self.v.numpy().astype(float)
        depth = np.maximum(-x[:, 1], 0)
        of_nodes = (v**2).sum(axis=1) / 2 + GRAVITY * x[:, 1] + (GROUND * depth) ** 2 / 2
        return self.energy.numpy().sum(dtype=float) + self.mass @ of_nodes

    def momentum(self):
        """Momentum of the whole body, kg m/s."""
        return self.mass @ self.v.numpy().astype(float)

    def count_failed(self):
        """The number of elements that have no stress or energy."""
        return int((self.status.numpy() & FAILED != 0).sum())


def read_mesh(path):
    """Nodes and tetrahedra of a file of Gmsh, MSH 4.1 in ASCII."""
    words = iter(Path(path).read_text().split())

    def numbers(count, kind=int):
        return [kind(next(words)) for _ in range(count)]

    while next(words) != "$Nodes":
        pass
    tags, nodes, tetrahedra = [], [], []
    for _ in range(numbers(4)[0]):
        size = numbers(4)[3]
        tags += numbers(size)
        nodes += numbers(3 * size, float)
    place = {tag: k for k, tag in enumerate(tags)}
    while next(words) != "$Elements":
        pass
    for _ in range(numbers(4)[0]):
        _, _, kind, size = numbers(4)
        if kind != 4:
            raise ValueError(f"{path}: elements of type {kind}; only tetrahedra of four nodes are read")
        tetrahedra += [[place[tag] for tag in numbers(5)[1:]] for _ in range(size)]
    return np.array(nodes).reshape(-1, 3), np.array(tetrahedra)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("energy", help="emitted file, with the functions energy and stress")
    parser.add_argument("mesh", help="tetrahedra, MSH 4.1 in ASCII")
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--dt", type=float, default=5e-4, help="time step, s [default: %(default)s]")
    parser.add_argument("--device", help="cpu or cuda:0 [default: CUDA if there is one]")
    arguments = parser.parse_args()
    wp.config.log_level = wp.LOG_ERROR

    rest, tetrahedra = read_mesh(arguments.mesh)
    rest[:, 1] += 0.2 - rest[:, 1].min()
    kernels = Kernels(Path(arguments.energy).read_text())
    body = Body(kernels, rest, tetrahedra, arguments.device)
    print(f"{len(rest)} nodes, {len(tetrahedra)} tetrahedra, {body.mass.sum():.1f} kg, {kernels.real.__name__}")
    print("time s   lowest m    energy J   its change   momentum along x, z kg m/s")
    first, seconds = body.total_energy(), 0.0
    for done in range(arguments.steps + 1):
        if done % max(arguments.steps // 10, 1) == 0:
            energy, momentum, lowest = body.total_energy(), body.momentum(), body.x.numpy()[:, 1].min()
            # Of the work that gravity does along one metre.
            change = (energy - first) / (GRAVITY * body.mass.sum())
            line = f"{done * arguments.dt:6.3f}   {lowest:8.4f}   {energy:9.2f}   {100 * change:8.3f} %"
            print(f"{line}   {momentum[0]:8.1e} {momentum[2]:8.1e}", flush=True)
            if failed := body.count_failed():
                sys.exit(f"{failed} elements are outside of the domain of the energy")
        start = time.perf_counter()
        body.step(arguments.dt)
        wp.synchronize()
        # The first one compiles the kernels.
        seconds += time.perf_counter() - start if done > 0 else 0
    print(f"{1e6 * seconds / max(arguments.steps, 1):.0f} µs a step")
    # The steps' own error is some hundredths of this.
    if not abs(change) < 0.01:
        sys.exit("the steps are too long: the energy has changed")


if __name__ == "__main__":
    main()
