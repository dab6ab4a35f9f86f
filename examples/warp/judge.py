"""Gradients and stiffnesses of nodes in kernels of Warp, compared with the emitted file in C and f64.

The bound is 30 u (‖X‖ + sens), u being the unit roundoff of the kernels, sens = ‖dX/dx‖₂ ‖edges‖₂ by
differences. Inverted elements must have the status of C, and other elements must be refused if C refuses
them. Then the kernels are compiled for CUDA, which needs no GPU."""

import sys
import tempfile
from pathlib import Path

import numpy as np
import warp as wp

from implicit_euler import Tetrahedra
from mesh import Mesh
from soft_body import FAILED, Solver, emit

BOUND, CHANGE = 30, 1e-8  # CHANGE of positions for differences, m


def nodal_blocks(solver, mesh, x):
    """Stiffness and gradient of each corner as in a sweep, and the status of each element."""
    Elements, mat43, vertex, deformation = solver.Elements, solver.mat43, solver.vertex, solver.deformation

    @solver.kernel
    def blocks(of: Elements, x: wp.array(dtype=solver.vec3), block: wp.array(dtype=mat43)):
        e = wp.tid()
        for c in range(4 * e, 4 * e + 4):
            block[c] = vertex(deformation(of, e, x), of.rest[c], of.status, e)

    solver.elements.status.zero_()
    found = wp.zeros(4 * len(mesh.volume), dtype=mat43)
    wp.launch(blocks, len(mesh.volume), [solver.elements, x, found])
    stiffness, gradient = np.split(found.numpy().astype(float), [3], axis=1)
    return stiffness, gradient, solver.elements.status.numpy()


def diagonal(stiffness):
    """Blocks (4, 3, 3) of stiffnesses that belong to a node with itself."""
    return np.stack([stiffness[:, k : k + 3, k : k + 3] for k in (0, 3, 6, 9)], axis=1)


def judge(solver, mesh, tetrahedra, x):
    """The worst errors in u of the scales, and the numbers of inverted and of refused elements."""
    rounded = wp.array(x, dtype=solver.vec3)
    (K, g, status), x = nodal_blocks(solver, mesh, rounded), rounded.numpy().astype(float)
    nodes, edges = x[mesh.tetrahedra], mesh.edges(x)
    _, gradient, stiffness, expected_status = tetrahedra.evaluate(nodes)
    inverted = np.linalg.det(edges) < 0
    compared = np.where(inverted, ~np.uint32(0), np.uint32(FAILED))
    if (differ := ((status ^ expected_status) & compared) != 0).any():
        sys.exit(f"{differ.sum()} elements have another status than in C")

    changed = [tetrahedra.evaluate(nodes + change) for change in CHANGE * np.eye(12).reshape(12, 1, 4, 3)]
    valid, u, errors = status & FAILED == 0, np.finfo(rounded.numpy().dtype).eps / 2, []
    for found, X, others in (
        (g, gradient, [other for _, other, _, _ in changed]),
        (K, diagonal(stiffness), [diagonal(other) for _, _, other, _ in changed]),
    ):
        rows = [values.reshape(len(edges), -1)[valid] for values in (found, X, *others)]
        slopes = np.stack(rows[2:], axis=-1) - rows[1][:, :, None]
        sens = np.linalg.norm(slopes / CHANGE, 2, axis=(1, 2)) * np.linalg.norm(edges[valid], 2, axis=(1, 2))
        error = np.linalg.norm(rows[0] - rows[1], axis=1) / (np.linalg.norm(rows[1], axis=1) + sens)
        errors.append(error.max(initial=0) / u)
    return [*errors, inverted.sum(), (~valid).sum()]


def main():
    precision, *energy = sys.argv[1:]
    wp.config.log_level = wp.LOG_ERROR
    wp.set_device("cpu")
    mesh = Mesh(Path(__file__).parents[2] / "scenes/assets/horse.msh")
    solver = Solver(energy, precision, mesh)
    tetrahedra = Tetrahedra(emit(energy, "c", "f64", "energy,projected_tetrahedron"), mesh)
    rest, noise = mesh.nodes, np.random.default_rng(1).uniform(-1, 1, mesh.nodes.shape)
    states = {
        "almost at rest": rest + 1e-4 * noise,
        "stretched by 2.5": rest * [2.5, 0.7, 0.6] + 0.02 * noise,
        "partly inverted": rest + 0.08 * noise,
        "inside out": rest * [1, 1, -1] + 1e-2 * noise,
    }
    for name, x in states.items():
        *errors, inverted, refused = judge(solver, mesh, tetrahedra, x)
        print(f"{precision}, {name}: errors {np.round(errors, 2)} u; {inverted} inverted, {refused} refused")
        if not max(errors) <= BOUND:
            sys.exit(f"an error is above {BOUND} u")

    # The compiler for CUDA is a part of Warp's packages for Linux and Windows.
    if sys.platform != "darwin":
        with tempfile.TemporaryDirectory() as folder:
            for kernel in (solver.sweep, solver.densities):
                wp.compile_aot_module(kernel.module, arch=75, module_dir=folder, use_ptx=True)
            print(f"{precision}, for CUDA: {len(list(Path(folder).glob('*.ptx')))} kernels compiled")


if __name__ == "__main__":
    main()
