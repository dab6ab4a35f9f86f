"""Implicit Euler by Newton's method in f64, with the functions of an emitted text in C."""

import ctypes
import os
import subprocess
import tempfile

import numpy as np


class Tetrahedra:
    """Energies, gradients and projected stiffnesses of a mesh, from `energy` and `projected_tetrahedron`."""

    def __init__(self, text, mesh):
        self.mesh = mesh
        text += """
            void evaluate(int count, const double *x, const double *rest, const double *F,
                          double *psi, double *gradient, double *K, unsigned *status) {
                const rubber_parameters p = RUBBER_EXAMPLE;
                for (int e = 0; e < count; e++) {
                    status[e] = rubber_energy(&p, F + 9 * e, psi + e);
                    status[e] |= rubber_projected_tetrahedron(&p, x + 12 * e, rest + 10 * e,
                                                              gradient + 12 * e, K + 144 * e);
                }
            }"""
        with tempfile.TemporaryDirectory() as folder:
            options = ["-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-x", "c", "-", "-lm"]
            command = [os.environ.get("CC", "cc"), *options, "-o", f"{folder}/energy.so"]
            subprocess.run(command, input=text.encode(), check=True)
            self.function = ctypes.CDLL(f"{folder}/energy.so").evaluate

    def evaluate(self, x):
        """V ψ, gradient (4, 3), stiffness (12, 12) and status of each, from the positions of its nodes."""
        mesh, count = self.mesh, len(x)
        rest = np.column_stack([mesh.inverse.reshape(-1, 9), mesh.volume])
        F = (x[:, 1:] - x[:, :1]).transpose(0, 2, 1) @ mesh.inverse
        psi, gradient, K = np.empty(count), np.empty((count, 4, 3)), np.empty((count, 12, 12))
        status = np.empty(count, dtype=np.uint32)
        arrays = [np.ascontiguousarray(one) for one in (x, rest, F)] + [psi, gradient, K, status]
        self.function(count, *(one.ctypes.data_as(ctypes.c_void_p) for one in arrays))
        return mesh.volume * psi, gradient, K, status


class ImplicitEuler:
    """Steps with a line search and a dense matrix."""

    def __init__(self, text, mesh, mass):
        self.tetrahedra, self.mass = Tetrahedra(text, mesh), np.repeat(mass, 3)
        self.places = (3 * mesh.tetrahedra[:, :, None] + np.arange(3)).reshape(-1, 12)

    def step(self, x, v, dt, guess):
        """Positions after a step, from a guess of them."""
        size, inertia, y = x.size, self.mass / dt**2, (x + dt * v).ravel()
        entries = (size * self.places[:, :, None] + self.places[:, None, :]).ravel()

        def objective(x):
            energy, gradient, K, status = self.tetrahedra.evaluate(x[self.places].reshape(-1, 4, 3))
            is_valid = not (status & (1 | 4)).any()
            return energy.sum() + inertia @ (x - y) ** 2 / 2 if is_valid else np.inf, gradient, K

        x = guess.ravel()
        value, gradient, K = objective(x)
        for _ in range(1000):
            H = np.bincount(entries, K.ravel(), size**2).reshape(size, size)
            H[np.diag_indices(size)] += inertia
            g = np.bincount(self.places.ravel(), gradient.ravel()) + inertia * (x - y)
            step, length = np.linalg.solve(H, -g), 1.0
            while length > 1e-10:
                found, gradient, K = objective(x + length * step)
                # Rounding errors of the sums decide nothing.
                if found <= value + 1e-4 * length * (g @ step) + 1e-14 * abs(value):
                    break
                length /= 2
            x, value = x + length * step, found
            if abs(step).max() < 1e-8:
                return x.reshape(-1, 3)
        raise ArithmeticError("Newton's method does not converge")
