"""The solids that clients are compared by, in piola; their tests have them in the words of other libraries.

Moduli are in MPa, as many users have them.
"""

import numpy as np
import piola

MU, LAMBDA = 0.8, 4.0
YEOH = {"C10": 0.4, "C20": -0.02, "C30": 0.003}
OGDEN = {"mu": [0.6, 0.1], "alpha": [1.7, -1.5]}
BULK = 20.0


def neo_hooke():
    return piola.Material("neo_hookean", mu=MU, lambda_=LAMBDA)


def yeoh():
    return piola.Material("yeoh", c1=YEOH["C10"], c2=YEOH["C20"], c3=YEOH["C30"], kappa=BULK)


def ogden():
    """Two terms 2 μ/α² Σ λb^α in isochoric stretches."""
    term = "2*m{0}/a{0}^2*(J^(-a{0}/3)*(l1^a{0} + l2^a{0} + l3^a{0}) - 3)"
    (m1, m2), (a1, a2) = OGDEN["mu"], OGDEN["alpha"]
    formula = f"{term.format(1)} + {term.format(2)} + K/2*(J - 1)^2"
    return piola.declare(formula, m1=m1, m2=m2, a1=a1, a2=a2, K=BULK)


def deformations(count, seed=1):
    """Moderate deformations, (3, 3, 8, count): eight points in each cell."""
    rng = np.random.default_rng(seed)
    return np.eye(3)[..., None, None] + 0.2 * rng.uniform(-1, 1, (3, 3, 8, count))


def difference(found, expected):
    """The largest difference, relative to the largest number."""
    return np.abs(found - expected).max() / np.abs(expected).max()
