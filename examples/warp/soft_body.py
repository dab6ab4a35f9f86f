"""Vertex block descent of a soft body that starts flat or inside out and recovers, with any energy of piola.

A step minimises |x − y|²_M/(2 dt²) + Σ V ψ(F), y = x + dt v: implicit Euler. A sweep makes a step of Newton's
method for each node, in groups of nodes that share no element: Chen, Liu, Yang, Yuksel, Vertex Block Descent,
ACM Transactions on Graphics 43 (2024)."""

import argparse
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import warp as wp

from mesh import Mesh

DENSITY = 1000.0  # kg/m³
FAILED = 1 | 4  # bits of a status without a result: outside of the domain, not finite


def emit(energy, target, precision, functions):
    """Text of an energy from `piola emit`. If that prints an error instead, the program ends."""
    piola = os.environ.get("PIOLA", "cargo run --quiet --release -p piola-cli --").split()
    options = ["--name=rubber", f"--target={target}", f"--precision={precision}", f"--functions={functions}"]
    found = subprocess.run([*piola, "emit", *energy, *options], stdout=subprocess.PIPE, encoding="utf-8")
    return found.stdout if found.returncode == 0 else sys.exit(found.returncode)


class Solver:
    """Steps of implicit Euler for a mesh, with the functions of an emitted text in kernels of Warp."""

    def __init__(self, energy, precision, mesh):
        text = emit(energy, "cuda", precision, "energy,projected_vertex")
        number, real = {"f32": ("float", wp.float32), "f64": ("double", wp.float64)}[precision]
        vec3, vec4 = wp.types.vector(3, real), wp.types.vector(4, real)
        mat33, mat43 = wp.types.matrix((3, 3), real), wp.types.matrix((4, 3), real)
        vectors, reals = wp.array(dtype=vec3), wp.array(dtype=real)
        ids, bits = wp.array(dtype=int), wp.array(dtype=wp.uint32)

        @wp.struct
        class Elements:
            nodes: wp.array(dtype=wp.vec4i)  # of each element
            inverse: wp.array(dtype=mat33)  # Dm⁻¹, 1/m
            rest: wp.array(dtype=vec4)  # argument of projected_vertex for each corner
            status: wp.array(dtype=wp.uint32)  # bits of all calls; no two threads have the same element

        # Rows 0 to 2 are the stiffness of a node, row 3 is the gradient.
        @wp.func_native(f"""
            const rubber_parameters p = RUBBER_EXAMPLE;
            wp::mat_t<4, 3, {number}> block;
            status[element] |= rubber_projected_vertex(&p, F.data[0], &rest[0], block.data[3], block.data[0]);
            return block;
        """)
        def vertex(F: mat33, rest: vec4, status: bits, element: int) -> mat43: ...

        @wp.func_native("""
            const rubber_parameters p = RUBBER_EXAMPLE;
            status[element] |= rubber_energy(&p, F.data[0], &density[element]);
        """)
        def energy_density(F: mat33, density: reals, status: bits, element: int): ...

        @wp.func
        def deformation(of: Elements, e: int, x: vectors):
            n, x0 = of.nodes[e], x[of.nodes[e][0]]
            return wp.matrix_from_cols(x[n[1]] - x0, x[n[2]] - x0, x[n[3]] - x0) * of.inverse[e]

        # The text is placed before the code that Warp generates. Only its own fma are fused, on CUDA too.
        build = wp.ModuleBuildOptions(extra_cpu_preamble=text, extra_cuda_preamble=text)
        options = {"extra_build_options": build, "fuse_fp": False}
        kernel = wp.kernel(enable_backward=False, module="unique", module_options=options)

        @kernel
        def sweep(group: ids, first: ids, corners: ids, of: Elements, inertia: reals, y: vectors, x: vectors):
            n = group[wp.tid()]
            K, g = wp.diag(vec3(inertia[n])), inertia[n] * (x[n] - y[n])
            for k in range(first[n], first[n + 1]):
                e = corners[k] / 4
                block = vertex(deformation(of, e, x), of.rest[corners[k]], of.status, e)
                K += wp.matrix_from_rows(block[0], block[1], block[2])
                g += block[3]
            x[n] -= wp.inverse(K) * g

        @kernel
        def densities(of: Elements, x: vectors, density: reals):
            e = wp.tid()
            energy_density(deformation(of, e, x), density, of.status, e)

        self.real, self.vec3, self.mat43, self.kernel, self.Elements = real, vec3, mat43, kernel, Elements
        self.vertex, self.deformation, self.sweep, self.densities = vertex, deformation, sweep, densities
        self.elements = of = Elements()
        of.nodes, of.inverse = wp.array(mesh.tetrahedra, dtype=wp.vec4i), wp.array(mesh.inverse, dtype=mat33)
        of.rest, of.status = wp.array(mesh.rest, dtype=vec4), wp.zeros(len(mesh.volume), dtype=wp.uint32)
        self.first, self.corners = wp.array(mesh.first, dtype=int), wp.array(mesh.corners, dtype=int)
        self.groups = [wp.array(group, dtype=int) for group in mesh.groups()]
        self.volume, self.mass = mesh.volume, mesh.lumped(DENSITY)

    def step(self, x, v, dt, sweeps):
        """Positions after a step from positions x with velocities v."""
        y, x = wp.array(x + dt * v, dtype=self.vec3), wp.array(x, dtype=self.vec3)
        inertia = wp.array(self.mass / dt**2, dtype=self.real)
        for group in self.groups * sweeps:
            wp.launch(self.sweep, len(group), [group, self.first, self.corners, self.elements, inertia, y, x])
        return x.numpy().astype(float)

    def energy(self, x):
        """Elastic energy, J. If it, or a step before, has no value, the program ends."""
        density = wp.zeros(len(self.volume), dtype=self.real)
        wp.launch(self.densities, len(density), [self.elements, wp.array(x, dtype=self.vec3), density])
        if failed := np.count_nonzero(self.elements.status.numpy() & FAILED):
            sys.exit(f"{failed} elements are outside of the domain of the energy, or not finite")
        return self.volume @ density.numpy()


def main():
    usage = "%(prog)s [options] ENERGY [options of `piola emit` for it]"
    parser = argparse.ArgumentParser(usage=usage, description=__doc__, allow_abbrev=False)
    parser.add_argument("--start", choices=["flat", "inside_out"], default="flat")
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--dt", type=float, default=0.01, help="length of a step, s")
    parser.add_argument("--sweeps", type=int, default=20, help="for each step")
    parser.add_argument("--precision", choices=["f32", "f64"], default="f32")
    parser.add_argument("--newton", action="store_true", help="also compute the minimum of each step; slow")
    arguments, energy = parser.parse_known_args()
    wp.config.log_level = wp.LOG_ERROR

    mesh = Mesh(Path(__file__).parents[2] / "scenes/assets/horse.msh")
    solver = Solver(energy, arguments.precision, mesh)
    if arguments.newton:
        from implicit_euler import ImplicitEuler

        newton = ImplicitEuler(emit(energy, "c", "f64", "energy,projected_tetrahedron"), mesh, solver.mass)
    start = mesh.nodes * {"flat": [1, 1, 0], "inside_out": [1, 1, -1]}[arguments.start]
    x, v, distance, at_rest = start, np.zeros_like(start), "", solver.energy(mesh.nodes)
    print("time s  elastic energy J  inverted" + "  distance from the minimum m" * arguments.newton)
    for k in range(arguments.steps + 1):
        if k > 0:
            x = solver.step(start, v, arguments.dt, arguments.sweeps)
            if arguments.newton:
                distance = f"{abs(x - newton.step(start, v, arguments.dt, x)).max():29.1e}"
            start, v = x, (x - start) / arguments.dt
        elastic, inverted = solver.energy(x) - at_rest, np.sum(np.linalg.det(mesh.edges(x)) < 0)
        if k % max(arguments.steps // 10, 1) == 0:
            print(f"{k * arguments.dt:6.3f}  {elastic:16.2f}  {inverted:8}{distance}", flush=True)
    if inverted:
        sys.exit(f"{inverted} elements are still inverted")


if __name__ == "__main__":
    main()
