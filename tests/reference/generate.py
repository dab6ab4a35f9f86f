#!/usr/bin/env python3
"""Reference values of isotropic energies at hard deformation gradients, to 25 digits: writes and checks `cases*.json`.

    python -m venv venv && venv/bin/pip install mpmath==1.4.1 gmpy2==2.3.2
    venv/bin/python generate.py cases-more.json             # writes the file beside this script, the same bytes each time
    venv/bin/python generate.py --further cases-further.json    # likewise: the energies that came later
    venv/bin/python generate.py --ordinary cases-ordinary.json  # likewise: what the report of speed and error calls ordinary
    venv/bin/python generate.py --check cases.json          # recomputes every number of a file of this schema

Version 1. Provenance: written from the formulas of the literature as SCHEMA.md and the catalogue's documentation state
them, with mpmath alone; it shares no code and no formula with the Rust crates, nor with whatever computed `cases.json`,
which it therefore checks. gmpy2 makes mpmath faster and changes no digit.

Every case is computed twice, from the same ψ(λ1, λ2, λ3) but with nothing else in common:

one  eigenvectors of FᵀF give U, λ, V; second-order Taylor arithmetic gives ψi and ψij; naive quotients and the
     block-diagonal map of the SVD gradient give dP/dF; its projection clamps block by block.
two  central differences of ψ(F), λ by the closed form of the cubic, without vectors, derivatives, quotients or blocks;
     the projection by an eigensolver on the 9×9 matrix.

No stretch spacing is special in either, because F is first moved by 1e-70 of its norm in a fixed generic direction: no gap is
zero then, 400 digits outlive every cancellation, and what is printed moves by 1e-70 of its sensitivity. The two
must agree to 1e-60 of norm plus sensitivity, or the case is an error.
"""

import argparse
import json
import random
import struct
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import cached_property
from pathlib import Path

from mpmath import mp, mpf

DIGITS = 400
MOVED = mpf("1e-70")  # of the norm of F, so that nothing coincides
STEP_TWO = mpf("1e-60")  # of the norm of F, for the differences of derivation two
STEP_SENSITIVITY = mpf("1e-40")  # of the norm of F, for the differences of the sensitivities
AGREEMENT = mpf("1e-60")  # required of the two derivations
PRINTED = 25
mp.dps = DIGITS

# ------------------------------------------------------------------------------------------ second-order Taylor arithmetic

PAIRS = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]


class Taylor:
    """A function of three variables at a point: value, gradient, Hessian in the order of PAIRS."""

    def __init__(self, value, gradient=(0, 0, 0), hessian=(0,) * 6):
        self.value, self.gradient, self.hessian = value, gradient, hessian

    def chain(self, value, first, second):
        """φ(self) for a φ with these derivatives at the value of self."""
        g = self.gradient
        hessian = [first * h + second * g[i] * g[j] for h, (i, j) in zip(self.hessian, PAIRS)]
        return Taylor(value, [first * x for x in g], hessian)

    def __add__(self, other):
        other = other if isinstance(other, Taylor) else Taylor(other)
        return Taylor(
            self.value + other.value,
            [a + b for a, b in zip(self.gradient, other.gradient)],
            [a + b for a, b in zip(self.hessian, other.hessian)],
        )

    def __mul__(self, other):
        if not isinstance(other, Taylor):
            return self.chain(self.value * other, other, 0)
        (a, g), (b, k) = (self.value, self.gradient), (other.value, other.gradient)
        hessian = [
            a * y + b * x + g[i] * k[j] + g[j] * k[i] for x, y, (i, j) in zip(self.hessian, other.hessian, PAIRS)
        ]
        return Taylor(a * b, [a * y + b * x for x, y in zip(g, k)], hessian)

    def __pow__(self, r):
        x = self.value
        return self.chain(x**r, r * x ** (r - 1), r * (r - 1) * x ** (r - 2))

    def ln(self):
        return self.chain(mp.log(self.value), 1 / self.value, -1 / self.value**2)

    def exp(self):
        e = mp.exp(self.value)
        return self.chain(e, e, e)

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __truediv__(self, other):
        return self * (other**-1 if isinstance(other, Taylor) else 1 / mpf(other))

    def __rtruediv__(self, other):
        return self**-1 * other

    __radd__, __rmul__ = __add__, __mul__


def ln(x):
    return x.ln() if isinstance(x, Taylor) else mp.log(x)


def exp(x):
    return x.exp() if isinstance(x, Taylor) else mp.exp(x)


THIRD = mpf(1) / 3

# ---------------------------------------------------------------------------------------------------------------- energies


class Stretches:
    """λ1, λ2, λ3 and what formulas make of them, for numbers and for Taylor expansions."""

    def __init__(self, stretches):
        self.all = stretches

    def sum(self, f):
        l1, l2, l3 = self.all
        return f(l1) + f(l2) + f(l3)

    @cached_property
    def J(self):
        l1, l2, l3 = self.all
        return l1 * l2 * l3

    @cached_property
    def I1(self):
        return self.sum(lambda l: l * l)

    @cached_property
    def I2(self):
        a, b, c = (l * l for l in self.all)
        return a * b + b * c + c * a

    @cached_property
    def I1b(self):
        return self.J ** (-2 * THIRD) * self.I1

    @cached_property
    def I2b(self):
        return self.J ** (-4 * THIRD) * self.I2

    @cached_property
    def isochoric(self):
        """The stretches J^(−1/3) λ."""
        return Stretches([self.J ** -THIRD * l for l in self.all])

    @cached_property
    def E(self):
        """Green strains."""
        return [(l * l - 1) / 2 for l in self.all]

    @cached_property
    def U(self):
        """The volumetric energy of bulk modulus one that most isochoric solids share."""
        return ((self.J**2 - 1) / 2 - ln(self.J)) / 2


# ψ(stretches, parameters); `lam` is the parameter that files call `lambda`.
ENERGIES = {
    "st_venant_kirchhoff": lambda s, mu, lam: mu * sum(e * e for e in s.E) + lam / 2 * sum(s.E) ** 2,
    "ogden": lambda s, mu, alpha, kappa: (
        sum(m / a * (s.sum(lambda l: l**a) - 3) for m, a in zip(mu, alpha))
        - sum(mu) * ln(s.J)
        + kappa / 2 * (s.J - 1) ** 2
    ),
    "rotated_linear": lambda s, mu, lam: mu * s.sum(lambda l: (l - 1) ** 2) + lam / 2 * s.sum(lambda l: l - 1) ** 2,
    "fixed_corotated": lambda s, mu, lam: mu * s.sum(lambda l: (l - 1) ** 2) + lam / 2 * (s.J - 1) ** 2,
    "neo_hookean": lambda s, mu, lam: mu / 2 * (s.I1 - 3) - mu * ln(s.J) + lam / 2 * ln(s.J) ** 2,
    "stable_neo_hookean": lambda s, mu, lam: (
        mu / 2 * (s.I1 - 3) + lam / 2 * (s.J - (1 + mu / lam - mu / (4 * lam))) ** 2 - mu / 2 * ln(s.I1 + 1)
    ),
    "mooney_rivlin": lambda s, c10, c01, kappa: c10 * (s.I1b - 3) + c01 * (s.I2b - 3) + kappa / 2 * (s.J - 1) ** 2,
    "mooney_rivlin_coupled": lambda s, c10, c01, kappa: (
        c10 * (s.I1 - 3) + c01 * (s.I2 - 3) - 2 * (c10 + 2 * c01) * ln(s.J) + kappa / 2 * (s.J - 1) ** 2
    ),
    "hencky": lambda s, mu, lam: mu * s.sum(lambda l: ln(l) ** 2) + lam / 2 * ln(s.J) ** 2,
    "arap": lambda s, mu: mu * s.sum(lambda l: (l - 1) ** 2),
    "symmetric_dirichlet": lambda s, mu: mu / 2 * s.sum(lambda l: l**2 + l**-2 - 2),
    "gent": lambda s, mu, jm, kappa: (
        -mu * jm / 2 * ln(1 - (s.I1 - 3) / jm) - mu * ln(s.J) + kappa / 2 * (s.J - 1) ** 2
    ),
    "fung": lambda s, c, a1, a2: c / 2 * (exp(a1 * sum(s.E) ** 2 + a2 * sum(e * e for e in s.E)) - 1),
    "yeoh": lambda s, c1, c2, c3, kappa: (
        sum(c * (s.I1b - 3) ** k for k, c in [(1, c1), (2, c2), (3, c3)]) + kappa / 2 * (s.J - 1) ** 2
    ),
    "arruda_boyce": lambda s, mu, lambda_m, kappa: mu * sum(
        mpf(p) / q / lambda_m ** (2 * k - 2) * (s.I1b**k - 3**k)
        for k, p, q in [(1, 1, 2), (2, 1, 20), (3, 11, 1050), (4, 19, 7000), (5, 519, 673750)]
    ) + kappa * s.U,
    "blatz_ko": lambda s, mu, f, beta: (
        f * mu / 2 * (s.I1 - 3 + (s.J ** (-2 * beta) - 1) / beta)
        + (1 - f) * mu / 2 * (s.I2 / s.J**2 - 3 + (s.J ** (2 * beta) - 1) / beta)
    ),
    "varga": lambda s, mu, kappa: 2 * mu * s.sum(lambda l: l - 1) - 2 * mu * ln(s.J) + kappa / 2 * (s.J - 1) ** 2,
    "isochoric_ogden": lambda s, mu, alpha, kappa: sum(
        m / a * (s.J ** (-a / 3) * s.sum(lambda l: l**a) - 3) for m, a in zip(mu, alpha)
    ) + kappa * s.U,
    "exponentiated_hencky": lambda s, mu, k, kappa, k_hat: (
        mu / k * (exp(k * s.sum(lambda l: (ln(l) - ln(s.J) / 3) ** 2)) - 1)
        + kappa / (2 * k_hat) * (exp(k_hat * ln(s.J) ** 2) - 1)
    ),
    "ciarlet_neo_hookean": lambda s, mu, lam: (
        mu / 2 * (s.I1 - 3) + lam / 4 * (s.J**2 - 1) - (lam / 2 + mu) * ln(s.J)
    ),
    "isochoric_neo_hookean": lambda s, mu, kappa: mu / 2 * (s.I1b - 3) + kappa * s.U,
    "ciarlet_geymonat": lambda s, c1, c2, a: (
        c1 * (s.I1 - 3) + c2 * (s.I2 - 3) + a * (s.J**2 - 1) - (2 * c1 + 4 * c2 + 2 * a) * ln(s.J)
    ),
    "gent_gent": lambda s, mu, jm, c2, kappa: (
        -mu * jm / 2 * ln(1 - (s.I1b - 3) / jm) + c2 * ln(s.I2b / 3) + kappa * s.U
    ),
    "gent_thomas": lambda s, c1, c2, kappa: c1 * (s.I1b - 3) + c2 * ln(s.I2b / 3) + kappa * s.U,
    "carroll": lambda s, a, b, c, kappa: (
        a * (s.I1b - 3) + b * (s.I1b**4 - 81) + c * (s.I2b ** mpf(0.5) - mp.sqrt(3)) + kappa * s.U
    ),
    "lopez_pamies": lambda s, mu, alpha, kappa: sum(
        3 ** (1 - a) / (2 * a) * m * (s.I1b**a - 3**a) for m, a in zip(mu, alpha)
    ) + kappa * s.U,
    "storakers": lambda s, mu, alpha, beta: sum(
        2 * m / a**2 * (s.sum(lambda l: l**a) - 3 + (s.J ** (-a * b) - 1) / b) for m, a, b in zip(mu, alpha, beta)
    ),
    "extended_tube": lambda s, gc, delta, ge, beta, kappa: (
        gc / 2 * (1 - delta**2) * (s.I1b - 3) / (1 - delta**2 * (s.I1b - 3))
        + gc / 2 * ln(1 - delta**2 * (s.I1b - 3))
        + 2 * ge / beta**2 * s.sum(lambda l: (s.J ** (-THIRD) * l) ** -beta - 1)
        + kappa * s.U
    ),
    "valanis_landel": lambda s, mu, lam: 2 * mu * s.sum(lambda l: l * ln(l) - l + 1) + lam / 2 * ln(s.J) ** 2,
    "knowles": lambda s, mu, b, n, kappa: mu / (2 * b) * ((1 + b / n * (s.I1b - 3)) ** n - 1) + kappa * s.U,
    "anssari_benam_bucchi": lambda s, mu, n, kappa: (
        mu * n * ((s.I1b - 3) / (6 * n) - ln((s.I1b - 3 * n) / (3 - 3 * n))) + kappa * s.U
    ),
    "isihara": lambda s, c10, c20, c01, kappa: (
        c10 * (s.I1b - 3) + c20 * (s.I1b - 3) ** 2 + c01 * (s.I2b - 3) + kappa * s.U
    ),
    "haines_wilson": lambda s, c10, c01, c11, c02, c20, c30, kappa: (
        polynomial(s, {(1, 0): c10, (0, 1): c01, (1, 1): c11, (0, 2): c02, (2, 0): c20, (3, 0): c30}) + kappa * s.U
    ),
    "james_green_simpson": lambda s, c10, c01, c11, c20, c30, kappa: (
        polynomial(s, {(1, 0): c10, (0, 1): c01, (1, 1): c11, (2, 0): c20, (3, 0): c30}) + kappa * s.U
    ),
    "swanson": lambda s, a, alpha, b, beta, kappa: sum(
        mpf(3) / 2 * c / (1 + e) * ((invariant / 3) ** (1 + e) - 1)
        for invariant, moduli, exponents in [(s.I1b, a, alpha), (s.I2b, b, beta)]
        for c, e in zip(moduli, exponents)
    ) + kappa * s.U,
    "horgan_saccomandi": lambda s, mu, jm, kappa: (
        -mu / 2 * jm * ln((jm**3 - jm**2 * s.I1b + jm * s.I2b - 1) / (jm - 1) ** 3) + kappa * s.U
    ),
    "edwards_vilgis": lambda s, nc, ns, alpha, eta, kappa: (
        nc / 2 * ((1 - alpha**2) * s.I1b / (1 - alpha**2 * s.I1b) + ln(1 - alpha**2 * s.I1b))
        + ns / 2 * (
            s.isochoric.sum(
                lambda l: (1 + eta) * (1 - alpha**2) * l**2 / ((1 + eta * l**2) * (1 - alpha**2 * s.I1b))
                + ln(1 + eta * l**2)
            )
            + ln(1 - alpha**2 * s.I1b)
        )
        + kappa * s.U
    ),
    "flory_erman": lambda s, cp, cc, kappa_c, kappa: (
        cp / 2 * (s.I1b - 3) + cc / 2 * s.isochoric.sum(lambda l: constraint(l, kappa_c)) + kappa * s.U
    ),
    "attard_hunt": lambda s, a1, a2, a3, b1, lam: (
        s.sum(lambda l: sum(a / (2 * n) * (l ** (2 * n) - 1) for n, a in [(1, a1), (2, a2), (3, a3)]))
        + s.sum(lambda l: b1 / 2 * (l**-2 - 1)) - (a1 + a2 + a3 - b1) * ln(s.J) + lam / 2 * ln(s.J) ** 2
    ),
    "davidson_goulbourne": lambda s, gc, lambda_m, ge, kappa: (
        gc / 6 * (s.I1b - 3) - gc * lambda_m**2 * ln((3 * lambda_m**2 - s.I1b) / (3 * lambda_m**2 - 3))
        + ge * s.isochoric.sum(lambda l: l + 1 / l - 2) + kappa * s.U
    ),
    "khajehsaeid": lambda s, a, alpha, beta, kappa: (
        a * (exp(alpha * (s.I1b - 3)) / alpha + beta * (s.I1b - 2) * (1 - ln(s.I1b - 2)) - 1 / alpha - beta)
        + kappa * s.U
    ),
    "mansouri_darijani": lambda s, a1, m1, b1, n1, kappa: (
        a1 * (exp(m1 * (s.I1b - 3)) - 1) + b1 * (exp(n1 * (s.I2b - 3)) - 1) + kappa * s.U
    ),
    "hoss_marczak": lambda s, alpha, beta, mu, b, n, c2, kappa: (
        alpha / beta * (1 - exp(-beta * (s.I1b - 3))) + mu / (2 * b) * ((1 + b / n * (s.I1b - 3)) ** n - 1)
        + c2 * ln(s.I2b / 3) + kappa * s.U
    ),
    "hartmann_neff": lambda s, alpha, c10, c01, kappa: (
        alpha * (s.I1b**3 - 27) + c10 * (s.I1b - 3) + c01 * (s.I2b ** mpf(1.5) - 3 * mp.sqrt(3))
        + kappa / 50 * (s.J**5 + s.J**-5 - 2)
    ),
    "yeoh_fleming": lambda s, a, b, c10, im, kappa: (
        a / b * (im - 3) * (1 - exp(-b * (s.I1b - 3) / (im - 3)))
        - c10 * (im - 3) * ln(1 - (s.I1b - 3) / (im - 3)) + kappa * s.U
    ),
    "dobrynin_carrillo": lambda s, g, beta, kappa: (
        g / 6 * (s.I1b - 3) + g / beta * ((1 - beta * s.I1b / 3) ** -1 - 1 / (1 - beta)) + kappa * s.U
    ),
    "veronda_westmann": lambda s, c1, alpha, kappa: (
        c1 * (exp(alpha * (s.I1b - 3)) - 1) - c1 * alpha / 2 * (s.I2b - 3) + kappa * s.U
    ),
    "three_chain": lambda s, mu, n, kappa: mu * n / 3 * (
        s.isochoric.sum(lambda l: cohen(l**2 / n)) - 3 * cohen(1 / n)
    ) + kappa * s.U,
    "peng_landel": lambda s, e, kappa: (
        e * s.isochoric.sum(
            lambda l: l - 1 - ln(l) - ln(l) ** 2 / 6 + ln(l) ** 3 / 18 - ln(l) ** 4 / 216
        ) + kappa * s.U
    ),
    "levinson_burgess": lambda s, mu, f, nu: mu / 2 * (
        f * (s.I1 - 3) + (1 - f) * (s.I2 / s.J**2 - 3) + 2 * (1 - 2 * f) * (s.J - 1)
        + (2 * f + (4 * nu - 1) / (1 - 2 * nu)) * (s.J - 1) ** 2
    ),
    "murnaghan": lambda s, lam, mu, l, m, n: (
        (lam + 2 * mu) / 2 * sum(s.E) ** 2 - 2 * mu * (s.E[0] * s.E[1] + s.E[1] * s.E[2] + s.E[2] * s.E[0])
        + (l + 2 * m) / 3 * sum(s.E) ** 3
        - 2 * m * sum(s.E) * (s.E[0] * s.E[1] + s.E[1] * s.E[2] + s.E[2] * s.E[0])
        + n * s.E[0] * s.E[1] * s.E[2]
    ),
    "bazant": lambda s, mu, lam: (
        mu * s.sum(lambda l: ((l - 1 / l) / 2) ** 2) + lam / 2 * s.sum(lambda l: (l - 1 / l) / 2) ** 2
    ),
    "symmetric_arap": lambda s, mu: mu / 2 * s.sum(lambda l: (l - 1) ** 2 + (1 / l - 1) ** 2),
    "mips": lambda s, mu, alpha: (
        mu * (alpha * (s.I1 * s.I2 / s.J**2 - 1) / 8 + (1 - alpha) * (s.J + 1 / s.J) / 2)
    ),
}


def polynomial(s, coefficients):
    """Σ Cij (I1b − 3)^i (I2b − 3)^j."""
    x, y = s.I1b - 3, s.I2b - 3
    power = lambda x, i: x**i if i else 1
    return sum(c * power(x, i) * power(y, j) for (i, j), c in coefficients.items())


def constraint(l, kappa):
    """Flory and Erman's B + D − ln(1 + B) − ln(1 + D), as printed."""
    b = kappa**2 * (l**2 - 1) / (l**2 + kappa) ** 2
    d = l**2 * b / kappa
    return b + d - ln(1 + b) - ln(1 + d)


def cohen(square):
    """∫ x (3 − x²)/(1 − x²) dx at x²."""
    return square / 2 - ln(1 - square)


def energy_of(material, parameters):
    """ψ as a function of three stretches."""
    exact = {
        "lam" if name == "lambda" else name: [mpf(x) for x in v] if isinstance(v, list) else mpf(v)
        for name, v in parameters.items()
    }
    return lambda stretches: ENERGIES[material](Stretches(stretches), **exact)


# ---------------------------------------------------------------------------------------------------------- small matrices


def transpose(a):
    return [list(column) for column in zip(*a)]


def multiply(a, b):
    columns = transpose(b)
    return [[mp.fdot(row, column) for column in columns] for row in a]


def flatten(a):
    return [x for row in a for x in row]


def norm(values):
    return mp.sqrt(mp.fdot(values, values))


def determinant(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def eigen(a):
    """Ascending eigenvalues, and their eigenvectors as rows."""
    values, vectors = mp.eigsy(mp.matrix(a))
    n = len(a)
    return list(values), [[vectors[i, k] for i in range(n)] for k in range(n)]


def compose(values, vectors):
    """Σ value · vector vectorᵀ."""
    return multiply(transpose([[value * x for x in v] for value, v in zip(values, vectors)]), vectors)


# ---------------------------------------------------------------------------------------------------------- derivation one


def signed_decomposition(F):
    """Rows u1, u2, u3; signed stretches; rows v1, v2, v3."""
    _, (v3, v2, v1) = eigen(multiply(transpose(F), F))
    if determinant([v1, v2, v3]) < 0:
        v3 = [-x for x in v3]
    image = [[mp.fdot(row, v) for row in F] for v in (v1, v2, v3)]
    l1, l2 = norm(image[0]), norm(image[1])
    u1, u2 = [x / l1 for x in image[0]], [x / l2 for x in image[1]]
    u3 = [u1[i - 2] * u2[i - 1] - u1[i - 1] * u2[i - 2] for i in range(3)]
    return [u1, u2, u3], [l1, l2, mp.fdot(u3, image[2])], [v1, v2, v3]


def derivation_one(psi, F):
    """stretches, psi, P, dPdF, psd, eig at a generic F."""
    U, stretches, V = signed_decomposition(F)
    unit = [[int(i == j) for j in range(3)] for i in range(3)]
    expansion = psi([Taylor(l, e) for l, e in zip(stretches, unit)])
    gradient = expansion.gradient
    P = multiply(transpose([[g * x for x in u] for g, u in zip(gradient, U)]), V)

    # Column 3a + b of the frame is u_a v_bᵀ, flattened by rows.
    frame = transpose([[x * y for x in u for y in v] for u in U for v in V])
    plain = [[mpf(0)] * 9 for _ in range(9)]
    clamped = [[mpf(0)] * 9 for _ in range(9)]
    eigenvalues = []

    hessian = [[mpf(0)] * 3 for _ in range(3)]
    for h, (i, j) in zip(expansion.hessian, PAIRS):
        hessian[i][j] = hessian[j][i] = h
    values, vectors = eigen(hessian)
    eigenvalues += values
    semidefinite = compose([max(x, mpf(0)) for x in values], vectors)
    for i in range(3):
        for j in range(3):
            plain[4 * i][4 * j], clamped[4 * i][4 * j] = hessian[i][j], semidefinite[i][j]

    for i, j in PAIRS[3:]:
        flip = (gradient[i] - gradient[j]) / (stretches[i] - stretches[j])
        twist = (gradient[i] + gradient[j]) / (stretches[i] + stretches[j])
        eigenvalues += [flip, twist]
        p, q = 3 * i + j, 3 * j + i
        for block, f, t in [(plain, flip, twist), (clamped, max(flip, mpf(0)), max(twist, mpf(0)))]:
            block[p][p] = block[q][q] = (f + t) / 2
            block[p][q] = block[q][p] = (f - t) / 2

    to_entries = lambda block: flatten(multiply(multiply(frame, block), transpose(frame)))
    return {
        "stretches": stretches,
        "psi": [expansion.value],
        "P": flatten(P),
        "dPdF": to_entries(plain),
        "psd": to_entries(clamped),
        "eig": sorted(eigenvalues),
    }


# ---------------------------------------------------------------------------------------------------------- derivation two


def stretches_of(F):
    """λ1, λ2 by the trigonometric roots of the characteristic polynomial of FᵀF, λ3 = det F/(λ1 λ2)."""
    C = multiply(transpose(F), F)
    mean = (C[0][0] + C[1][1] + C[2][2]) / 3
    deviator = [[C[i][j] - (mean if i == j else 0) for j in range(3)] for i in range(3)]
    radius = norm(flatten(deviator)) / mp.sqrt(6)
    angle = mp.acos(max(-1, min(1, determinant(deviator) / (2 * radius**3)))) / 3
    l1 = mp.sqrt(mean + 2 * radius * mp.cos(angle))
    # The middle root from the trace; the smallest would cancel.
    l2 = mp.sqrt(mean - 2 * radius * mp.cos(angle + mp.pi / 3))
    return [l1, l2, determinant(F) / (l1 * l2)]


def derivation_two(psi, F):
    """psi, P, dPdF, psd by differences of ψ(F)."""
    step = STEP_TWO * norm(flatten(F))

    def at(*moves):
        moved = [list(row) for row in F]
        for entry, sign in moves:
            moved[entry // 3][entry % 3] += sign * step
        return psi(stretches_of(moved))

    centre = at()
    plus, minus = [at((k, 1)) for k in range(9)], [at((k, -1)) for k in range(9)]
    dPdF = [[None] * 9 for _ in range(9)]
    for r in range(9):
        dPdF[r][r] = (plus[r] - 2 * centre + minus[r]) / step**2
        for c in range(r):
            both = at((r, 1), (c, 1)) + at((r, -1), (c, -1))
            # ψ(+,+) + ψ(−,−) − Σ of the single moves + 2 ψ = 2 h² ∂²ψ + O(h⁴)
            dPdF[r][c] = dPdF[c][r] = (both - plus[r] - minus[r] - plus[c] - minus[c] + 2 * centre) / (2 * step**2)
    values, vectors = eigen(dPdF)
    return {
        "psi": [centre],
        "P": [(p - m) / (2 * step) for p, m in zip(plus, minus)],
        "dPdF": flatten(dPdF),
        "psd": flatten(compose([max(x, mpf(0)) for x in values], vectors)),
        "eig": values,
    }


# ------------------------------------------------------------------------------------------------------------------- cases


def generic(F):
    """F moved by MOVED of its norm, in the same direction for every F."""
    scale = MOVED * (norm(F) or 1)
    direction = [31, -17, 11, 13, 29, -7, -19, 5, 23]
    moved = [mpf(x) + scale * d / 53 for x, d in zip(F, direction)]
    return [moved[0:3], moved[3:6], moved[6:9]]


def sensitivities(psi, F, result):
    """‖D X(F)‖₂ ‖F‖ for each X, and cond_cw = ‖ |D dPdF| |F| ‖ / ‖dPdF‖, both by forward differences."""
    size = norm(flatten(F))
    step = STEP_SENSITIVITY * size
    columns = {"dPdF": [], "psd": []}
    for k in range(9):
        moved = [list(row) for row in F]
        moved[k // 3][k % 3] += step
        there = derivation_one(psi, moved)
        for name, rows in columns.items():
            rows.append([(b - a) / step for a, b in zip(result[name], there[name])])
    sens = {"psi": norm(result["P"]) * size, "P": max(abs(x) for x in result["eig"]) * size}
    for name, rows in columns.items():
        values, _ = eigen([[mp.fdot(a, b) for b in rows] for a in rows])
        sens[name] = mp.sqrt(max(values)) * size
    entrywise = [mp.fdot(map(abs, slope), map(abs, flatten(F))) for slope in zip(*columns["dPdF"])]
    return sens, norm(entrywise) / norm(result["dPdF"])


def solve(case):
    """Everything about a case with `material`, `params` and `F`: the values as numbers, and how far the derivations differ."""
    psi, F = energy_of(case["material"], case["params"]), generic(case["F"])
    result = derivation_one(psi, F)
    sens, entrywise = sensitivities(psi, F, result)
    again = derivation_two(psi, F)
    # What vanishes at rest is compared with what it is made of: ψ by a step to first and second order, P to first.
    scale = {name: norm(result[name]) + sens[name] for name in sens}
    scale["P"] = norm(result["P"]) + sens["P"]
    scale["psi"] += sens["P"] * norm(flatten(F))
    scale["eig"] = scale["dPdF"]
    difference = max(norm([a - b for a, b in zip(result[x], again[x])]) / (scale[x] or 1) for x in scale)
    return result, sens, entrywise, scale, difference


def vanishes(value, scale):
    """Below 1e-60 of the scale: what moving F made of zero. At F = 0 the scale itself is, hence the least of one."""
    return abs(value) <= mpf("1e-60") * max(scale, 1)


def text(value, scale):
    """25 significant digits, or "0"."""
    if vanishes(value, scale):
        return "0"
    return mp.nstr(value, PRINTED, min_fixed=1, max_fixed=0).replace(".0e", "e").removesuffix(".0")


def record(case, result, sens, entrywise, scale):
    """The case as a line of the file."""
    rounded = lambda x: float(mp.nstr(x, 6))
    texts = {name: [text(x, scale[name]) for x in result[name]] for name in scale}
    is_zero = {name: all(x == "0" for x in texts[name]) for name in sens}
    entrywise = mpf(0) if vanishes(entrywise, 1) else entrywise
    sens = {name: mpf(0) if vanishes(x, scale[name]) else x for name, x in sens.items()}
    cond = {name: None if is_zero[name] else rounded(x / norm(result[name])) for name, x in sens.items()}
    return {
        **{name: case[name] for name in ("id", "material", "params", "tag", "k", "F")},
        "F_hex": [x.hex() for x in case["F"]],
        "f32_exact": all(x == to_f32(x) for x in case["F"]),
        "cond": cond["dPdF"],
        "cond_cw": None if is_zero["dPdF"] else rounded(entrywise),
        "cond_psd": cond["psd"],
        "cond_P": cond["P"],
        "cond_psi": cond["psi"],
        "sens": {name: rounded(x) for name, x in sens.items()},
        "stretches": [text(x, norm(result["stretches"])) for x in result["stretches"]],
        "psi": texts["psi"][0],
        "P": texts["P"],
        "eig": texts["eig"],
        "dPdF": texts["dPdF"],
        "dPdF_psd": texts["psd"],
    }


def to_f32(x):
    return struct.unpack("f", struct.pack("f", x))[0]


# ---------------------------------------------------------------------------------------------------------------- families


def turn(a, b, c, d):
    """|q|² times the rotation of a quaternion q: integers for integers."""
    return [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]


def rotation(rng):
    q = [mpf(rng.uniform(-1, 1)) for _ in range(4)]
    return [[x / mp.fdot(q, q) for x in row] for row in turn(*q)]


def dyadic(rng, low, high):
    """A number of at most 8 significant bits."""
    x = rng.uniform(low, high)
    unit = mpf(2) ** (mp.floor(mp.log(x, 2)) - 7)
    return float(mp.nint(x / unit) * unit)


def with_stretches(U, stretches, V):
    return [float(x) for x in flatten(multiply([[x * l for x, l in zip(row, stretches)] for row in U], transpose(V)))]


def rotated(stretches):
    """A family that is random rotations around the stretches."""
    return lambda rng, k: with_stretches(rotation(rng), [mpf(x) for x in stretches(rng, k)], rotation(rng))


def exact(pattern):
    """A family whose equal stretches are equal in F to the last bit: scaled integer rotations around dyadic numbers."""

    def family(rng, k):
        p, q = ([rng.randint(-2, 2) for _ in range(3)] + [1] for _ in range(2))
        values = [dyadic(rng, 0.4, 2.5) / 2 ** mp.nint(mp.log(mp.fdot(p, p) * mp.fdot(q, q), 2)) for _ in range(3)]
        return with_stretches(turn(*p), [values[i] for i in pattern], turn(*q))

    return family


def shear(rng, k):
    F = [[mpf(int(i == j)) for j in range(3)] for i in range(3)]
    i = rng.randrange(3)
    F[i][(i + rng.choice([1, 2])) % 3] = mpf(rng.choice([1e-4, 0.1, 1, 3, 10]))
    return [float(x) for x in flatten(multiply(rng.choice([F, rotation(rng)]), F))]


def diagonal(rng, k):
    """A signed permutation of three stretches, with a positive determinant."""
    first = rng.randrange(3)
    signs = rng.choice([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
    F = [0.0] * 9
    for row, sign in enumerate(signs):
        F[3 * row + (first + row) % 3] = sign * rng.uniform(0.3, 2.5)
    return F


def around(low, high):
    return lambda rng: rng.uniform(low, high)


ordinary, small = around(0.4, 2), around(-1, 1)
FAMILIES = {
    "rest_exact": lambda rng, k: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    "near_rest": rotated(lambda rng, k: [1 + small(rng) * mpf(10) ** -k for _ in range(3)]),
    "random_large": rotated(lambda rng, k: [rng.uniform(0.1, 10) for _ in range(3)]),
    "exact_pair": exact((0, 0, 1)),
    "exact_triple": exact((0, 0, 0)),
    "near_pair": rotated(lambda rng, k: [(a := mpf(ordinary(rng))) + mpf(10) ** -k, a, ordinary(rng)]),
    "near_triple": rotated(
        lambda rng, k: [(a := mpf(ordinary(rng))) + mpf(10) ** -k, a, a - mpf(10) ** -k * ordinary(rng)]
    ),
    "near_singular": rotated(lambda rng, k: [ordinary(rng), ordinary(rng), mpf(10) ** -k]),
    "line_collapse": rotated(lambda rng, k: [ordinary(rng)] + [mpf(10) ** -k * ordinary(rng) for _ in range(2)]),
    "extreme_stretch": rotated(lambda rng, k: [ordinary(rng) * rng.choice([1e-3, 1, 1e3]) for _ in range(3)]),
    "tiny_scale": rotated(lambda rng, k: [ordinary(rng) * 1e-8 for _ in range(3)]),
    "huge_scale": rotated(lambda rng, k: [ordinary(rng) * 1e8 for _ in range(3)]),
    "pure_rotation": rotated(lambda rng, k: [1, 1, 1]),
    "shear": shear,
    "diagonal": diagonal,
    "inverted": rotated(lambda rng, k: [ordinary(rng), ordinary(rng), -ordinary(rng)]),
    "near_pair_inverted": rotated(lambda rng, k: [(a := mpf(ordinary(rng))) + mpf(10) ** -k, a, -ordinary(rng)]),
}
# How many cases of each family an energy gets, and the levels k that they take in turn.
PLAN = [
    ("rest_exact", 1, [None]),
    ("near_rest", 2, [1, 2, 3, 4, 6, 8]),
    ("random_large", 1, [None]),
    ("exact_pair", 1, [None]),
    ("exact_triple", 1, [None]),
    ("near_pair", 2, list(range(1, 17))),
    ("near_triple", 1, [1, 2, 3, 4, 6, 8, 10, 12, 14, 16]),
    ("near_singular", 1, list(range(2, 13))),
    ("line_collapse", 1, list(range(1, 13))),
    ("extreme_stretch", 1, [None]),
    ("tiny_scale", 1, [None]),
    ("huge_scale", 1, [None]),
    ("pure_rotation", 1, [None]),
    ("shear", 1, [None]),
    ("diagonal", 1, [None]),
]
LOCKING = ("gent_locking", 4, [1, 2, 3, 4])
# The same for the energies of `cases-further.json`, of which those that are defined there get inverted ones.
FURTHER_PLAN = [
    ("rest_exact", 1, [None]),
    ("near_rest", 1, [1, 2, 4, 6, 8]),
    ("random_large", 1, [None]),
    ("exact_pair", 1, [None]),
    ("near_pair", 1, list(range(4, 15))),
    ("near_triple", 1, list(range(4, 15))),
    ("near_singular", 1, list(range(2, 13))),
    ("line_collapse", 1, list(range(1, 13))),
]
FURTHER_LOCKING = ("gent_locking", 1, [1, 2, 3, 4])
INVERTED = [("near_pair_inverted", 1, [2, 6, 10, 14]), ("inverted", 2, [None])]
DEFINED_INVERTED = ["murnaghan"]

# -------------------------------------------------------------------------------------------------------------- parameters


def terms(rng, p, exponents):
    """Moduli and distinct exponents of one to three terms."""
    alpha = rng.sample(exponents, rng.randint(1, 3))
    return [p(0.5, 5) for _ in alpha], alpha


def ogden_terms(rng, p):
    """Each term stable by itself, or the set of Ogden 1972, rounded, whose sum is."""
    if rng.random() < 0.3:
        return {"mu": [6.25, 0.01171875, -0.09375], "alpha": [1.3125, 5.0, -2.0]}
    mu, alpha = terms(rng, p, [-3.25, -2.0, -0.5, 0.125, 1.0, 1.5, 2.0, 4.0, 6.0])
    return {"mu": [m if a > 0 else -m for m, a in zip(mu, alpha)], "alpha": alpha}


def lists(rng, p, exponents):
    mu, alpha = terms(rng, p, exponents)
    return {"mu": mu, "alpha": alpha}


def foam(rng, p, d):
    values = lists(rng, p, [-2.0, -0.5, 1.5, 3.25, 4.5, 8.0])
    return {**values, "beta": [d(0.125, 2) for _ in values["mu"]]}


def two_lists(rng, p):
    """Swanson's moduli and exponents, as many of one invariant as of the other."""
    count = rng.randint(1, 2)
    alpha, beta = rng.sample([-0.5, 0.25, 0.5, 1.5, 3.0], count), rng.sample([-0.75, -0.5, 0.25, 0.5], count)
    return {"a": [p(0.5, 5) for _ in alpha], "alpha": alpha, "b": [p(0.125, 2) for _ in beta], "beta": beta}


# p draws a modulus, d a pure number; `room` is a power of two above I1b − 3, for the energies that bound it.
PARAMETERS = {
    "isochoric_ogden": lambda rng, p, d, room: {**ogden_terms(rng, p), "kappa": p(4, 200)},
    "exponentiated_hencky": lambda rng, p, d, room: {
        "mu": p(0.5, 5), "k": d(0.125, 2), "kappa": p(1, 200), "k_hat": d(0.0625, 1),
    },
    "ciarlet_neo_hookean": lambda rng, p, d, room: {"mu": p(0.5, 5), "lambda": p(0.5, 200)},
    "isochoric_neo_hookean": lambda rng, p, d, room: {"mu": p(0.5, 5), "kappa": p(1, 200)},
    "ciarlet_geymonat": lambda rng, p, d, room: {"c1": p(0.5, 5), "c2": p(0.125, 2), "a": p(0.5, 50)},
    "gent_gent": lambda rng, p, d, room: {
        "mu": p(0.5, 5), "jm": d(1.25, 8) * room, "c2": p(0.125, 2), "kappa": p(1, 200),
    },
    "gent_thomas": lambda rng, p, d, room: {"c1": p(0.5, 5), "c2": p(0.125, 2), "kappa": p(1, 200)},
    "carroll": lambda rng, p, d, room: {
        "a": p(0.5, 5), "b": p(1e-3, 0.01), "c": p(0.125, 2), "kappa": p(1, 200),
    },
    "lopez_pamies": lambda rng, p, d, room: {
        **lists(rng, p, [-2.5, -0.5, 0.625, 1.0, 1.5, 4.375]), "kappa": p(1, 200),
    },
    "storakers": lambda rng, p, d, room: foam(rng, p, d),
    "extended_tube": lambda rng, p, d, room: {
        "gc": p(0.5, 5), "delta": d(0.25, 0.75) * 2.0 ** -int(mp.ceil(mp.log(room, 4))), "ge": p(0.125, 2),
        "beta": d(0.125, 1), "kappa": p(1, 200),
    },
    "valanis_landel": lambda rng, p, d, room: {"mu": p(0.5, 5), "lambda": p(0.5, 200)},
    "knowles": lambda rng, p, d, room: {"mu": p(0.5, 5), "b": d(0.125, 2), "n": d(0.25, 4), "kappa": p(1, 200)},
    "anssari_benam_bucchi": lambda rng, p, d, room: {"mu": p(0.5, 5), "n": d(1.25, 8) * room, "kappa": p(1, 200)},
}
# The energies of `cases-further.json`, as above.
FURTHER = {
    "isihara": lambda rng, p, d, room: {
        "c10": p(0.5, 5), "c20": p(1e-3, 0.1), "c01": p(0.125, 2), "kappa": p(1, 200),
    },
    "haines_wilson": lambda rng, p, d, room: {
        "c10": p(0.5, 5), "c01": p(0.125, 2), "c11": p(1e-3, 0.01), "c02": p(1e-4, 1e-3), "c20": -p(1e-3, 0.1),
        "c30": p(1e-3, 0.01), "kappa": p(1, 200),
    },
    "james_green_simpson": lambda rng, p, d, room: {
        "c10": p(0.5, 5), "c01": p(0.125, 2), "c11": p(1e-3, 0.01), "c20": -p(1e-3, 0.1), "c30": p(1e-3, 0.01),
        "kappa": p(1, 200),
    },
    "swanson": lambda rng, p, d, room: {**two_lists(rng, p), "kappa": p(1, 200)},
    "horgan_saccomandi": lambda rng, p, d, room: {"mu": p(0.5, 5), "jm": d(2, 8) * room, "kappa": p(1, 200)},
    "edwards_vilgis": lambda rng, p, d, room: {
        "nc": p(0.5, 5), "ns": p(0.5, 5), "alpha": d(0.25, 0.75) * 2.0 ** -int(mp.ceil(mp.log(2 * room, 4))),
        "eta": d(0.125, 1), "kappa": p(1, 200),
    },
    "flory_erman": lambda rng, p, d, room: {
        "cp": p(0.5, 5), "cc": p(0.5, 5), "kappa_c": d(0.5, 20), "kappa": p(1, 200),
    },
    "attard_hunt": lambda rng, p, d, room: {
        "a1": p(0.5, 5), "a2": p(0.01, 0.1), "a3": p(1e-3, 0.01), "b1": p(0.125, 2), "lambda": p(1, 200),
    },
    "davidson_goulbourne": lambda rng, p, d, room: {
        "gc": p(0.5, 5), "lambda_m": d(1, 2) * 2.0 ** int(mp.ceil(mp.log(room, 4))), "ge": p(0.125, 2),
        "kappa": p(1, 200),
    },
    "khajehsaeid": lambda rng, p, d, room: {
        "a": p(0.5, 5), "alpha": d(0.25, 2) / room, "beta": d(0.01, 0.1), "kappa": p(1, 200),
    },
    "mansouri_darijani": lambda rng, p, d, room: {
        "a1": p(0.5, 5), "m1": d(0.25, 2) / room, "b1": p(0.125, 2), "n1": d(0.25, 2) / room**2, "kappa": p(1, 200),
    },
    "hoss_marczak": lambda rng, p, d, room: {
        "alpha": p(0.125, 2), "beta": d(0.25, 2), "mu": p(0.5, 5), "b": d(0.125, 2), "n": d(0.25, 4),
        "c2": p(0.125, 2), "kappa": p(1, 200),
    },
    "hartmann_neff": lambda rng, p, d, room: {
        "alpha": p(1e-3, 0.01), "c10": p(0.5, 5), "c01": p(0.125, 2), "kappa": p(1, 200),
    },
    "yeoh_fleming": lambda rng, p, d, room: {
        "a": p(0.125, 2), "b": d(0.25, 4), "c10": p(0.5, 5), "im": d(1.25, 8) * room, "kappa": p(1, 200),
    },
    "dobrynin_carrillo": lambda rng, p, d, room: {"g": p(0.5, 5), "beta": d(0.25, 0.75) / room, "kappa": p(1, 200)},
    "veronda_westmann": lambda rng, p, d, room: {"c1": p(0.5, 5), "alpha": d(1, 4) / room, "kappa": p(1, 200)},
    "three_chain": lambda rng, p, d, room: {"mu": p(0.5, 5), "n": d(2, 8) * room, "kappa": p(1, 200)},
    "peng_landel": lambda rng, p, d, room: {"e": p(0.5, 5), "kappa": p(1, 200)},
    "levinson_burgess": lambda rng, p, d, room: {
        "mu": p(0.5, 5), "f": d(0.125, 0.75), "nu": 0.5 - d(0.01, 0.25),
    },
    "murnaghan": lambda rng, p, d, room: {
        "lambda": p(1, 5), "mu": p(0.5, 5), "l": -p(1, 20), "m": -p(1, 20), "n": -p(1, 20),
    },
    "bazant": lambda rng, p, d, room: {"mu": p(0.5, 5), "lambda": p(0.5, 200)},
    "symmetric_arap": lambda rng, p, d, room: {"mu": p(0.5, 5)},
    "mips": lambda rng, p, d, room: {"mu": p(0.5, 5), "alpha": d(0.25, 0.75)},
}
# The upper bound of I1b − 3.
BOUND = {
    "gent_gent": lambda values: values["jm"],
    "extended_tube": lambda values: values["delta"] ** -2.0,
    "anssari_benam_bucchi": lambda values: 3 * (values["n"] - 1),
    "edwards_vilgis": lambda values: values["alpha"] ** -2.0 - 3,
    "davidson_goulbourne": lambda values: 3 * (values["lambda_m"] ** 2 - 1),
    "yeoh_fleming": lambda values: values["im"] - 3,
    "dobrynin_carrillo": lambda values: 3 / values["beta"] - 3,
}


def isochoric_excess(stretches):
    return Stretches([abs(mpf(x)) for x in stretches]).I1b - 3


def locking(rng, k, bound):
    """F with I1b − 3 short of its bound by 10^-k of it: the first stretch is found by bisection."""
    others = [mpf(ordinary(rng)) for _ in range(2)]
    target = bound * (1 - mpf(10) ** -k)
    low, high = mp.sqrt(others[0] * others[1]), mpf(10) ** 6
    for _ in range(200):
        middle = mp.sqrt(low * high)
        low, high = (low, middle) if isochoric_excess([middle, *others]) > target else (middle, high)
    return with_stretches(rotation(rng), [low, *others], rotation(rng))


def draw(material, tag, k, rng):
    """Parameters and F of one case."""
    unit = rng.choice([1.0, 1.0, 1.0, 65536.0])
    d = lambda low, high: dyadic(rng, low, high)
    p = lambda low, high: unit * d(low, high)
    parameters = {**PARAMETERS, **FURTHER}[material]
    if tag == LOCKING[0]:
        values = parameters(rng, p, d, 8.0)
        F = locking(rng, k, BOUND[material](values))
    else:
        F = FAMILIES[tag](rng, k)
        if rng.random() < 0.5 and (k or 0) <= 6:
            F = [to_f32(x) for x in F]
        excess = isochoric_excess(signed_decomposition(generic(F))[1])
        values = parameters(rng, p, d, 2.0 ** max(3, int(mp.ceil(mp.log(max(excess, 1), 2)))))
    return {"material": material, "params": values, "tag": tag, "k": k, "F": F}


# ------------------------------------------------------------------------------------------------------- write and check


def generate(name, position, material, tag, k):
    """The line of one case of the set of this name; drawn again where a value leaves the range of f64."""
    rng = random.Random(f"{material} {tag} {position}")
    for _ in range(100):
        case = draw(material, tag, k, rng)
        values = [*derivation_one(energy_of(material, case["params"]), generic(case["F"])).values()]
        if all(abs(x) < mpf("1e290") for x in flatten(values)):
            break
    else:
        return f"{material} {tag} {k}: always beyond the range of f64"
    case["id"] = f"{name}-{position:04}"
    *solution, difference = solve(case)
    if difference > AGREEMENT:
        return f"{case['id']} {material} {tag} {k}: the derivations differ by {mp.nstr(difference, 3)}"
    return json.dumps(record(case, *solution), separators=(",", ":"))


def planned():
    for number, material in enumerate(PARAMETERS):
        for tag, count, levels in PLAN + ([LOCKING] if material in BOUND else []):
            for i in range(count):
                # Energies take the levels where the one before left off, so that each level is met.
                yield material, tag, levels[(number * count + i) * 7 % len(levels)]


def planned_further():
    for number, material in enumerate(FURTHER):
        locking = [FURTHER_LOCKING] if material in BOUND else []
        for tag, count, levels in FURTHER_PLAN + locking + (INVERTED if material in DEFINED_INVERTED else []):
            for i in range(count):
                yield material, tag, levels[(number * count + i) * 7 % len(levels)]


# Of the energies in the report of speed and error, all numbers exact in f32: moduli about as in its timings.
ORDINARY = {
    "st_venant_kirchhoff": {"mu": 1.0, "lambda": 1.5},
    "neo_hookean": {"mu": 1.0, "lambda": 1.5},
    "ogden": {"mu": [6.25, 0.01171875, -0.09375], "alpha": [1.3125, 5.0, -2.0], "kappa": 6.0},
    "rotated_linear": {"mu": 1.0, "lambda": 1.5},
    "hencky": {"mu": 1.0, "lambda": 1.5},
}
ORDINARY_COUNT = 32


def ordinary_deformation(i):
    """F = I + 0.3 X in f32, entries of X uniform in [−1, 1), det F > 0: the same for all energies."""
    rng = random.Random(f"ordinary {i}")
    while True:
        F = [to_f32(float(k % 4 == 0) + 0.3 * rng.uniform(-1, 1)) for k in range(9)]
        if determinant([F[0:3], F[3:6], F[6:9]]) > 0:
            return F


def generate_ordinary(material, i):
    """The line of one case."""
    tag, case_id = "ordinary", f"ordinary-{material}-{i:02}"
    case = {"id": case_id, "material": material, "params": ORDINARY[material], "tag": tag, "k": None}
    case["F"] = ordinary_deformation(i)
    *solution, difference = solve(case)
    if difference > AGREEMENT:
        return f"{case_id}: the derivations differ by {mp.nstr(difference, 3)}"
    return json.dumps(record(case, *solution), separators=(",", ":"))


def check(case):
    """Where the file's numbers differ by more than 1e-24 of their norm, or its sensitivities by more than a part in 1e4."""
    result, sens, entrywise, scale, difference = solve(case)
    complaints = [f"the derivations differ by {mp.nstr(difference, 3)}"] if difference > AGREEMENT else []
    again = record(case, result, sens, entrywise, scale)
    worst = mpf(0)
    for name in ("stretches", "psi", "P", "dPdF", "dPdF_psd", "eig"):
        expected, found = ([mpf(x) for x in (v if isinstance(v, list) else [v])] for v in (case[name], again[name]))
        distance = norm([a - b for a, b in zip(expected, found)])
        if distance:
            worst = max(worst, distance / norm(found))
    figures = {**case["sens"], **{x: case[x] for x in case if x.startswith("cond")}}
    others = {**again["sens"], **{x: again[x] for x in again if x.startswith("cond")}}
    for name, figure in figures.items():
        other = others[name]
        if (figure is None) != (other is None) or figure is not None and abs(figure - other) > 1e-4 * abs(figure):
            complaints.append(f"{name} is {figure}, not {other}")
    if worst > mpf("1e-24"):
        complaints.append(f"values differ by {mp.nstr(worst, 3)}")
    return worst, difference, [f"{case['id']} {case['material']} {case['tag']}: {x}" for x in complaints]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--check", action="store_true", help="recompute the file instead of writing it")
    arguments.add_argument("--ordinary", action="store_true", help="write ordinary deformations, not hard ones")
    arguments.add_argument("--further", action="store_true", help="write the energies of FURTHER")
    arguments.add_argument("file", type=Path)
    arguments = arguments.parse_args()
    with ProcessPoolExecutor() as workers:
        if arguments.check:
            cases = json.loads(arguments.file.read_text())["cases"]
            worst, differences, complaints = zip(*workers.map(check, cases, chunksize=4))
            complaints = [line for lines in complaints for line in lines]
            print("\n".join(complaints), end="\n" if complaints else "")
            print(f"{len(cases)} cases: values within {mp.nstr(max(worst), 3)} of their norm,", end=" ")
            print(f"derivations within {mp.nstr(max(differences), 3)}, {len(complaints)} complaints")
        else:
            if arguments.ordinary:
                plan = [(material, i) for material in ORDINARY for i in range(ORDINARY_COUNT)]
                lines = list(workers.map(generate_ordinary, *zip(*plan), chunksize=4))
            else:
                name, cases = ("further", planned_further()) if arguments.further else ("more", planned())
                plan = [(name, i, *x) for i, x in enumerate(cases)]
                lines = list(workers.map(generate, *zip(*plan), chunksize=4))
            complaints = [line for line in lines if not line.startswith("{")]
            print("\n".join(complaints), end="\n" if complaints else "")
            name = "ordinary" if arguments.ordinary else name
            head = f'{{"schema":"isohyper-oracle-1","set":"{name}","count":{len(lines)},"cases":[\n'
            if not complaints:
                arguments.file.write_text(head + ",\n".join(lines) + "\n]}\n")
    sys.exit(bool(complaints))


if __name__ == "__main__":
    main()
