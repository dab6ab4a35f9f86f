"""Forces and status in kernels of Warp, compared with those from the file of C that is printed for the same energy.

Fails where a force is farther from C's than 30 u (‖P‖ + ‖dP/dF‖ ‖F‖) allows, u being the unit roundoff of the
kernels, and where an element has another status. The kernels are then compiled for CUDA, which needs no GPU.
"""

import argparse
import ctypes
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import warp as wp

from soft_body import FAILED, Body, Kernels, read_mesh

BOUND = 30


def compiled(path):
    """The function F → P, dP/dF, status of a file of C in f64, for many F."""
    text = Path(path).read_text()
    prefix = re.search(r"(\w+)_tangent\(.*const double F", text).group(1)
    text += f"""
        void tangents(int count, const double *F, double *P, double *A, unsigned *status) {{
            const {prefix}_parameters p = {prefix.upper()}_EXAMPLE;
            for (int k = 0; k < count; k++)
                status[k] = {prefix}_tangent(&p, F + 9 * k, P + 9 * k, A + 81 * k);
        }}"""
    with tempfile.TemporaryDirectory() as folder:
        library = f"{folder}/energy.so"
        compiler = [os.environ.get("CC", "cc"), "-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC"]
        subprocess.run([*compiler, "-x", "c", "-", "-o", library, "-lm"], input=text.encode(), check=True)
        function = ctypes.CDLL(library).tangents

    def tangents(F):
        F = np.ascontiguousarray(F)
        P, A, status = np.empty_like(F), np.empty((len(F), 9, 9)), np.empty(len(F), dtype=np.uint32)
        function(len(F), *(one.ctypes.data_as(ctypes.c_void_p) for one in (F, P, A, status)))
        return P, A, status

    return tangents


def norm(matrices):
    return np.linalg.norm(matrices, axis=(-2, -1))


def judge(body, x, tangents):
    """The worst error of a force in u of its scale, and the numbers of inverted and of failed elements."""
    body.x.assign(x)
    body.compute_forces()
    found, status = body.force.numpy(), body.status.numpy()

    # From the numbers that the kernels have: their rounding from f64 is not an error here.
    x = body.x.numpy().astype(float)
    tetrahedra, inverse, volume = (one.numpy() for one in body.elements)
    inverse, volume = inverse.astype(float), volume.astype(float)
    edges = np.stack([x[tetrahedra[:, k]] - x[tetrahedra[:, 0]] for k in (1, 2, 3)], axis=-1)
    F = edges @ inverse
    P, A, expected_status = tangents(F)
    if (status != expected_status).any():
        sys.exit(f"{(status != expected_status).sum()} elements have another status than in C")

    forces = -volume[:, None, None] * P @ inverse.transpose(0, 2, 1)
    # F is rounded in the kernel, where its terms may cancel.
    scales = volume * norm(inverse) * (norm(P) + norm(A) * norm(edges) * norm(inverse))
    expected, scale = np.zeros_like(x), np.zeros(len(x))
    for k in range(4):
        np.add.at(expected, tetrahedra[:, k], forces[:, :, k - 1] if k > 0 else -forces.sum(axis=-1))
        np.add.at(scale, tetrahedra[:, k], scales)
    # Nodes of an element without a stress have no force.
    has_failed = (status & FAILED) != 0
    has_force = np.ones(len(x), dtype=bool)
    has_force[tetrahedra[has_failed]] = False
    error = np.linalg.norm(found - expected, axis=1)[has_force] / scale[has_force]
    return error.max() / (np.finfo(found.dtype).eps / 2), (np.linalg.det(F) < 0).sum(), has_failed.sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("emitted", help="file for the kernels, with the functions energy and stress")
    parser.add_argument("reference", help="the same energy in C and f64, with the function tangent")
    parser.add_argument("mesh", help="tetrahedra, MSH 4.1 in ASCII")
    arguments = parser.parse_args()
    wp.config.log_level = wp.LOG_ERROR

    kernels = Kernels(Path(arguments.emitted).read_text())
    tangents = compiled(arguments.reference)
    rest, tetrahedra = read_mesh(arguments.mesh)
    body = Body(kernels, rest, tetrahedra, "cpu")
    noise = np.random.default_rng(1).uniform(-1, 1, rest.shape)
    states = {
        "almost at rest": rest + 1e-4 * noise,
        "stretched by 2.5": rest * [2.5, 0.7, 0.6] + 0.02 * noise,
        "partly inverted": rest + 0.08 * noise,
    }
    worst = 0
    for name, x in states.items():
        error, inverted, failed = judge(body, x, tangents)
        worst = max(worst, error)
        print(f"{kernels.real.__name__}, {name}: error {error:.2f} u; {inverted} inverted, {failed} refused")
    if not worst <= BOUND:
        sys.exit(f"an error is above {BOUND} u")

    # The compiler for CUDA is a part of Warp's packages for Linux and Windows.
    if sys.platform != "darwin":
        with tempfile.TemporaryDirectory() as folder:
            for kernel in (kernels.forces, kernels.energies):
                wp.compile_aot_module(kernel.module, arch=75, module_dir=folder, use_ptx=True)
            print(f"{kernels.real.__name__}, for CUDA: {len(list(Path(folder).glob('*.ptx')))} kernels compiled")


if __name__ == "__main__":
    main()
