"""felupe: blocks by piola's materials, compared with its own, those of hyperelastic, tensortrax and matadi."""

import numpy as np
import piola
import pytest
import solids

felupe = pytest.importorskip("felupe")

import piola.felupe  # noqa: E402


class Sum:
    """Two materials side by side, whichever libraries they are from."""

    def __init__(self, *umats):
        self.umats = umats
        self.x = [np.eye(3), np.zeros(0)]

    def gradient(self, x):
        return [sum(umat.gradient([x[0], None])[0] for umat in self.umats), x[-1]]

    def hessian(self, x):
        return [sum(umat.hessian([x[0], None])[0] for umat in self.umats)]


def others(name):
    """The solid by other libraries: name → umat."""
    volumetric = felupe.Volumetric(bulk=solids.BULK)
    if name == "neo_hooke":
        return {"felupe": felupe.NeoHookeCompressible(mu=solids.MU, lmbda=solids.LAMBDA)}
    keywords = {"yeoh": solids.YEOH, "ogden": solids.OGDEN}[name]
    found = {}
    tensortrax = pytest.importorskip("felupe.constitution.tensortrax")
    model = getattr(tensortrax.models.hyperelastic, name)
    found["tensortrax"] = Sum(tensortrax.Hyperelastic(model, **keywords), volumetric)
    hel = pytest.importorskip("hyperelastic")
    framework = {
        "yeoh": lambda: hel.InvariantsFramework(hel.models.invariants.ThirdOrderDeformation(**keywords)),
        "ogden": lambda: hel.StretchesFramework(hel.models.stretches.Ogden(**keywords)),
    }[name]()
    found["hyperelastic"] = Sum(hel.DistortionalSpace(framework), volumetric)
    matadi = pytest.importorskip("matadi")
    found["matadi"] = matadi.MaterialHyperelastic(getattr(matadi.models, name), **keywords, bulk=solids.BULK)
    return found


# These move eigenvalues apart before they differentiate, by which their Ogden solids lose digits.
LOST = {("tensortrax", "ogden"): 1e-8, ("matadi", "ogden"): 1e-5}

NAMES = ["neo_hooke", "yeoh", "ogden"]


@pytest.mark.parametrize("name", NAMES)
def test_stresses_and_tangents_agree(name):
    umat = piola.felupe.Umat(getattr(solids, name)())
    F = solids.deformations(50)
    P, A = umat.gradient([F, None])[0], umat.hessian([F, None])[0]
    for library, other in others(name).items():
        tolerance = LOST.get((library, name), 1e-12)
        assert solids.difference(P, other.gradient([F, None])[0]) < tolerance, library
        assert solids.difference(A, other.hessian([F, None])[0]) < 10 * tolerance, library


@pytest.mark.parametrize("name", NAMES)
def test_blocks_agree(name):
    """A block is pulled to 1.4 of its length, its ends held."""
    converged = {library: pull(umat) for library, umat in others(name).items() if library != "matadi"}
    u, force, iterations = pull(piola.felupe.Umat(getattr(solids, name)()))
    for library, (other_u, other_force, other_iterations) in converged.items():
        tolerance = 10 * LOST.get((library, name), 1e-10)
        assert np.abs(u - other_u).max() < tolerance, library
        assert np.abs(force - other_force).max() < tolerance * np.abs(other_force).max(), library
        assert iterations == other_iterations, library


def pull(umat):
    """Displacements and reactions of a cube, and the iterations of each step."""
    mesh = felupe.Cube(n=6)
    field = felupe.FieldContainer([felupe.Field(felupe.RegionHexahedron(mesh), dim=3)])
    boundaries = felupe.dof.uniaxial(field, clamped=True, return_loadcase=False)
    boundaries = boundaries[0] if isinstance(boundaries, tuple) else boundaries
    solid = felupe.SolidBody(umat, field)
    move = np.linspace(0, 0.4, 5)[1:]
    iterations, force = [], None
    for value in move:
        boundaries["move"].update(value)
        dof0, dof1 = felupe.dof.partition(field, boundaries)
        ext0 = felupe.dof.apply(field, boundaries, dof0)
        result = felupe.newtonraphson(items=[solid], dof0=dof0, dof1=dof1, ext0=ext0, tol=1e-12, verbose=0)
        iterations.append(result.iterations)
        force = solid.assemble.vector(field).toarray().reshape(-1, 3)[mesh.points[:, 0] == 1].sum(axis=0)
    return field[0].values.copy(), force[:1], iterations


def test_results_are_written_where_felupe_wants():
    umat = piola.felupe.Umat(solids.yeoh())
    F = solids.deformations(5)
    P, A = np.empty_like(F), np.empty((3, 3, *F.shape))
    assert umat.gradient([F, None], out=P)[0] is P and umat.hessian([F, None], out=A)[0] is A
    assert umat.gradient([F[..., :2], None], out=P)[0] is not P
    assert umat.function([F])[0].shape == F.shape[2:]


def test_parameters_may_differ_from_cell_to_cell():
    F = solids.deformations(5)
    mu = np.linspace(0.5, 2, 5)
    umat = piola.felupe.Umat(piola.Material("neo_hookean", mu=mu, lambda_=solids.LAMBDA))
    x = [F, None]
    for k in range(5):
        one = felupe.NeoHookeCompressible(mu=mu[k], lmbda=solids.LAMBDA)
        assert solids.difference(umat.gradient(x)[0][..., k], one.gradient([F[..., k], None])[0]) < 1e-12
        assert solids.difference(umat.hessian(x)[0][..., k], one.hessian([F[..., k], None])[0]) < 1e-11


def test_a_point_outside_the_domain_is_no_silent_number():
    umat = piola.felupe.Umat(solids.yeoh())
    F = solids.deformations(5)
    F[:, :, 3, 2] = np.diag([1, 1, -1])
    with pytest.raises(piola.DomainError) as caught:
        umat.gradient([F, None])
    assert caught.value.first == (3, 2)
