"""Energy, stress and tangent of arrays of points."""

import pickle
import threading
import warnings
from fractions import Fraction

import numpy as np
import piola
import pytest
from conftest import LAMBDA, MU, close, deformations, neo_hookean
from scipy.interpolate import CubicSpline


@pytest.fixture
def rubber():
    return piola.Material("neo_hookean", mu=MU, lambda_=LAMBDA)


def test_values_are_those_on_paper(rubber, F):
    psi, P, A = neo_hookean(F)
    assert close(rubber.energy(F), psi) and close(rubber.stress(F), P)
    for found, expected in zip(rubber.tangent(F), (P, A)):
        assert close(found, expected)
    for found, expected in zip(rubber.evaluate(F), (psi, P, A)):
        assert close(found, expected)


@pytest.mark.parametrize("shape", [(), (1,), (7,), (2, 3), (2, 1, 4), (0,), (3, 0, 2)])
def test_points_have_any_shape_on_either_side(rubber, rng, shape):
    F = np.eye(3) + 0.2 * rng.uniform(-1, 1, (*shape, 3, 3))
    trailing = np.ascontiguousarray(np.moveaxis(F, (-2, -1), (0, 1)))
    psi, P, A = rubber.evaluate(F)
    assert psi.shape == shape and P.shape == (*shape, 3, 3) and A.shape == (*shape, 3, 3, 3, 3)
    psi_t, P_t, A_t = rubber.evaluate(trailing, trailing=True)
    assert psi_t.shape == shape and P_t.shape == (3, 3, *shape) and A_t.shape == (3, 3, 3, 3, *shape)
    assert np.array_equal(psi, psi_t)
    assert np.array_equal(P, np.moveaxis(P_t, (0, 1), (-2, -1)))
    assert np.array_equal(A, np.moveaxis(A_t, (0, 1, 2, 3), (-4, -3, -2, -1)))


@pytest.mark.parametrize("count", [1, 7, 8, 9, 127, 128, 129, 1000, 5000])
@pytest.mark.parametrize("threads", [False, True])
def test_bits_do_not_depend_on_place_layout_or_threads(rubber, rng, count, threads):
    F = np.eye(3) + 0.2 * rng.uniform(-1, 1, (count, 3, 3))
    one_by_one = np.array([rubber.stress(F[k]) for k in range(0, count, max(1, count // 50))])
    status = np.full(count, 99, np.uint8)
    P, A = rubber.tangent(F, threads=threads, status=status)
    assert np.array_equal(rubber.stress(F, threads=threads)[:: max(1, count // 50)], one_by_one)
    columns = np.ascontiguousarray(F.transpose(1, 2, 0))
    statuses = np.full(count, 99, np.uint8)
    P_t, A_t = rubber.tangent(columns, trailing=True, threads=threads, status=statuses)
    assert np.array_equal(P, P_t.transpose(2, 0, 1)) and np.array_equal(A, A_t.transpose(4, 0, 1, 2, 3))
    assert not status.any() and not statuses.any()


def test_single_precision_stays_so(rubber, F):
    psi, P, A = rubber.evaluate(F.astype(np.float32))
    assert psi.dtype == P.dtype == A.dtype == np.float32
    for found, expected in zip((psi, P, A), neo_hookean(F.astype(np.float32).astype(float))):
        assert close(found, expected, 1e-5)
    P_t = rubber.stress(np.ascontiguousarray(F.astype(np.float32).transpose(1, 2, 0)), trailing=True)
    assert np.array_equal(P, P_t.transpose(2, 0, 1))


def test_arrays_need_not_be_contiguous(rubber, F):
    P = rubber.stress(F)
    assert np.array_equal(rubber.stress(np.asfortranarray(F)), P)
    assert np.array_equal(rubber.stress(F[::2]), P[::2]) and np.array_equal(rubber.stress(F[::-2]), P[::-2])
    turned = np.swapaxes(F, -1, -2)
    assert close(rubber.stress(turned), neo_hookean(turned)[1])
    assert np.array_equal(rubber.stress(F.transpose(1, 2, 0), trailing=True), P.transpose(1, 2, 0))
    assert np.array_equal(rubber.stress(np.broadcast_to(F[0], (4, 3, 3)))[3], P[0])


def test_axes_of_points_are_not_guessed_in_silence(rubber, rng):
    F = np.eye(3) + 0.1 * rng.uniform(-1, 1, (40, 5, 3, 3))
    columns = np.ascontiguousarray(np.moveaxis(F, (2, 3), (0, 1)))
    for given in (columns, columns[..., :7, 0]):
        for trailing in (None, False):
            with pytest.raises(ValueError, match=r"or \(3, 3, ...\) with `trailing=True`"):
                rubber.stress(given, trailing=trailing)
    with pytest.raises(ValueError, match=r"it must be \(..., 3, 3\), or \(3, 3, ...\) with `trailing=True`"):
        rubber.stress(F, trailing=True)
    square, flags = columns[..., :3, :3], np.zeros((3, 3), np.uint8)
    with pytest.warns(UserWarning, match=r"shape \(3, 3, 3, 3\).*`trailing=False` if they are, `trailing=True`"):
        rubber.stress(square, status=flags)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        P = rubber.stress(F[:3, :3], trailing=False)
        assert np.array_equal(rubber.stress(square, trailing=True), np.moveaxis(P, (2, 3), (0, 1)))
        assert np.array_equal(rubber.stress(F[0, 0]), P[0, 0])


def test_masked_entries_are_nan(rubber, F):
    masked = np.ma.masked_array(F, mask=np.zeros(F.shape, bool))
    P = rubber.stress(F)
    assert type(rubber.stress(masked)) is np.ndarray and np.array_equal(rubber.stress(masked), P)
    masked[0, 0, 0] = np.ma.masked
    rows = [tuple(matrix) for matrix in masked]
    for given in (masked, list(masked), rows, masked.astype(np.float32), masked.astype(object)):
        status = np.zeros(len(F), np.uint8)
        found = rubber.stress(given, status=status)
        assert np.isnan(found[0]).all() and close(found[1:], P[1:], 1e-5)
        assert piola.Status(int(status[0])) & piola.Status.NONFINITE and not status[1:].any()
        with pytest.raises(piola.DomainError, match="not finite"):
            rubber.stress(given)
    for mu in (masked[:, 0, 0], np.ma.masked_array([1, 2], mask=[False, True]), np.ma.masked):
        with pytest.raises(piola.MaterialError, match="`mu` is NaN"):
            piola.Material("neo_hookean", mu=mu, lambda_=LAMBDA)
    with pytest.raises(TypeError, match="complex128"):
        rubber.stress(masked * 1j)


def test_whatever_numpy_makes_numbers_of_is_taken(rubber):
    shear = [[1, 2, 0], [0, 1, 0], [0, 0, 1]]
    P = rubber.stress(np.array(shear, float))
    assert P.dtype == np.float64
    wide = np.zeros((3, 3), dtype=[("pad", "i1"), ("F", "f8")])
    wide["F"] = shear
    fractions = [[Fraction(entry) for entry in row] for row in shear]
    dtypes = [int, np.int8, np.uint64, np.float16, np.longdouble, ">f8", ">i4", object]
    for F in [shear, tuple(map(tuple, shear)), fractions, wide["F"], *(np.array(shear, dtype) for dtype in dtypes)]:
        found = rubber.stress(F)
        assert found.dtype == np.float64 and np.array_equal(found, P)
    assert np.array_equal(rubber.stress(np.eye(3, dtype=bool)), np.zeros((3, 3)))
    single = rubber.stress(np.array(shear, np.float32))
    for F in [np.array(shear, ">f4"), np.array([shear], np.float32)[:, ::1][0].T.copy().T]:
        found = rubber.stress(F)
        assert found.dtype == np.float32 and np.array_equal(found, single)
    results = [rubber.energy(shear), *rubber.tangent(shear), *rubber.evaluate(shear), *rubber.measured(shear, "cauchy")]
    assert all(result.dtype == np.float64 for result in results)
    assert close(rubber.stress([shear, shear])[1], P) and rubber.stress([[shear] * 2] * 4).shape == (4, 2, 3, 3)
    columns = np.moveaxis(np.array([shear] * 5), 0, -1)
    assert np.array_equal(rubber.stress(columns.tolist(), trailing=True)[..., 4], P)


def test_tables_of_pandas_are_arrays(rubber, F):
    pandas = pytest.importorskip("pandas")
    P = rubber.stress(F)
    assert np.array_equal(rubber.stress(pandas.DataFrame(F[0])), P[0])
    for index in (None, np.arange(len(F))[::-1]):
        mu = pandas.Series(np.full(len(F), MU), index=index)
        assert close(piola.Material("neo_hookean", mu=mu, lambda_=LAMBDA).stress(F), P)
    for given, shape in ((pandas.DataFrame(F.reshape(-1, 9)), "9"), (F[..., :2, :2], "2, 2")):
        with pytest.raises(ValueError, match=rf"F has the shape \({len(F)}, {shape}\); it must be \(..., 3, 3\)"):
            rubber.stress(given)
    with pytest.raises(TypeError, match="F is of type Series; it must be real numbers"):
        rubber.stress(pandas.Series(list(F)))


def test_what_is_no_number_is_refused(rubber):
    ragged = [[1.0, 0, 0], [0, 1.0], [0, 0, 1.0]]
    text = [["1", "0", "0"]] * 3
    for F in [np.eye(3) * 1j, text, np.array(text), [[None] * 3] * 3, ragged, None, "F", {}, object(), {1.0}]:
        with pytest.raises(TypeError, match="F is .*; it must be real numbers") as caught:
            rubber.stress(F)
        assert "\n" not in str(caught.value)
    with pytest.raises(ValueError, match="shape"):
        rubber.stress(1.0)


def test_results_go_where_the_caller_wants(rubber, F):
    P, A, psi = np.empty_like(F), np.empty((*F.shape, 3, 3)), np.empty(len(F))
    assert rubber.stress(F, out=P) is P and close(P, neo_hookean(F)[1])
    found = rubber.tangent(F, out=(P, A))
    assert found[0] is P and found[1] is A and close(A, neo_hookean(F)[2])
    assert rubber.tangent(F, out=(None, A))[1] is A
    assert rubber.evaluate(F, out=(psi, P, A))[0] is psi and close(psi, neo_hookean(F)[0])


def test_mistaken_arrays_are_refused(rubber, F):
    def message(error, call):
        with pytest.raises(error) as caught:
            call()
        return str(caught.value)

    assert message(ValueError, lambda: rubber.stress(np.ones((4, 9)))) == (
        "F has the shape (4, 9); it must be (..., 3, 3)"
    )
    assert "(3, 3, ...)" in message(ValueError, lambda: rubber.stress(F, trailing=True))
    assert message(TypeError, lambda: rubber.stress(F.astype(complex))) == (
        "F is an array of complex128; it must be real numbers, or an array of them"
    )
    assert "out has the shape (3,)" in message(ValueError, lambda: rubber.stress(F, out=np.empty(3)))
    for other in (np.float32, int, ">f8"):
        assert "array of float64" in message(TypeError, lambda: rubber.stress(F, out=np.empty_like(F, other)))
    assert "array of float64" in message(TypeError, lambda: rubber.stress(F, out=F.tolist()))
    assert "contiguous" in message(ValueError, lambda: rubber.stress(F[:2], out=np.empty((2, 3, 6))[..., ::2]))
    read_only = np.empty_like(F)
    read_only.flags.writeable = False
    assert "out cannot be written: it is read-only" == message(ValueError, lambda: rubber.stress(F, out=read_only))
    for out in (F, F[::-1][::-1]):
        assert message(ValueError, lambda: rubber.stress(F, out=out)).startswith(
            "out cannot be written: it shares memory with F, another result"
        )
    assert "tuple of arrays" in message(TypeError, lambda: rubber.tangent(F, out=np.empty_like(F)))
    assert "it must have 2" in message(ValueError, lambda: rubber.tangent(F, out=(None,)))
    assert "uint8" in message(TypeError, lambda: rubber.stress(F, status=np.zeros(len(F))))
    assert "status has the shape" in message(ValueError, lambda: rubber.stress(F, status=np.zeros(1, np.uint8)))
    assert '"clamp"' in message(ValueError, lambda: rubber.tangent(F, filter="clip"))
    assert '"cauchy"' in message(ValueError, lambda: rubber.measured(F, "biot"))


def test_points_without_results_are_named(rubber, F):
    bad = np.repeat(F[:1], 12, axis=0).reshape(3, 4, 3, 3)
    bad[1, 2] = np.diag([1, 1, -1])
    bad[2, 3, 0, 0] = np.nan
    for arguments in ({}, {"threads": True}):
        with pytest.raises(piola.DomainError) as caught:
            rubber.stress(bad, **arguments)
        assert caught.value.first == (1, 2) and caught.value.refused >= 1 and caught.value.nonfinite >= 1
        assert "index (1, 2)" in str(caught.value)
    with pytest.raises(ValueError):
        rubber.tangent(np.ascontiguousarray(bad.transpose(2, 3, 0, 1)), trailing=True)
    status = np.zeros((3, 4), np.uint8)
    P = rubber.stress(bad, status=status)
    assert piola.Status(int(status[1, 2])) & piola.Status.REFUSED
    assert piola.Status(int(status[2, 3])) & piola.Status.NONFINITE
    assert np.count_nonzero(status) == 2 and np.array_equal(P[0, 0], rubber.stress(F[0]))
    statuses = np.zeros((3, 4), np.uint8)
    rubber.tangent(np.ascontiguousarray(bad.transpose(2, 3, 0, 1)), trailing=True, status=statuses)
    assert np.array_equal(status != 0, statuses != 0)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("trailing, threads", [(False, False), (False, True), (True, False), (True, True)])
def test_points_without_results_are_nan(rubber, F, dtype, trailing, threads):
    F = F.astype(dtype)
    bad = F.copy()
    refused, broken, last = 3, 130, len(F) - 1
    bad[[refused, last]] = np.diag([1, 1, -1])
    bad[broken, 0, 0] = np.inf
    valid = np.setdiff1d(np.arange(len(F)), [refused, broken, last])

    def computed(F, call, **arguments):
        F = np.ascontiguousarray(F.transpose(1, 2, 0)) if trailing else F
        results = call(F, trailing=trailing, threads=threads, **arguments)
        results = results if isinstance(results, tuple) else (results,)
        return [np.moveaxis(result, -1, 0) if trailing else result for result in results]

    for call in (
        rubber.energy,
        rubber.stress,
        rubber.tangent,
        rubber.evaluate,
        lambda F, **arguments: rubber.measured(F, "cauchy", **arguments),
    ):
        status = np.zeros(len(F), np.uint8)
        for found, expected in zip(computed(bad, call, status=status), computed(F, call)):
            assert np.array_equal(found[valid], expected[valid]) and found.dtype == dtype
            assert np.isnan(found[[refused, broken, last]]).all()
        assert status[refused] & piola.Status.REFUSED and status[broken] & piola.Status.NONFINITE
        assert not status[valid].any()


def test_extended_materials_know_inverted_points(F):
    rubber = piola.Material("neo_hookean", mu=MU, lambda_=LAMBDA, extend=0.1)
    inverted = np.diag([1.0, 1.0, -0.5])
    assert rubber.stress(inverted)[2, 2] < 0
    assert np.isfinite(rubber.energy(np.zeros((3, 3))))


def test_filters_leave_no_negative_eigenvalue(rubber):
    pressed = np.diag([1.5, 0.5, 0.5])
    status = np.zeros((), np.uint8)
    for filter in ("clamp", "absolute"):
        A = rubber.tangent(pressed, filter=filter, status=status)[1].reshape(9, 9)
        assert np.linalg.eigvalsh(A).min() > -1e-9 * MU and int(status) == piola.Status.FILTERED
    assert np.linalg.eigvalsh(rubber.tangent(pressed)[1].reshape(9, 9)).min() < -0.1 * MU


def test_measures_are_pushed_forward(rubber, F):
    P = rubber.stress(F)
    J = np.linalg.det(F)[:, None, None]
    cauchy = P @ F.transpose(0, 2, 1) / J
    places = ([0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1])
    for measure, tensor in [
        ("cauchy", cauchy),
        ("jaumann", cauchy),
        ("kirchhoff", J * cauchy),
        ("second_piola", np.linalg.solve(F, P)),
    ]:
        stress, tangent = rubber.measured(F, measure)
        assert close(stress, tensor[:, places[0], places[1]]) and tangent.shape == (len(F), 6, 6)
        assert close(tangent, tangent.transpose(0, 2, 1))
        assert close(rubber.measured(F, measure, tangent=False), stress)
        columns = rubber.measured(np.ascontiguousarray(F.transpose(1, 2, 0)), measure, trailing=True)
        assert all(close(np.moveaxis(found, -1, 0), result) for found, result in zip(columns, (stress, tangent)))


def test_derivatives_by_parameters(rubber, F):
    by = rubber.stress_by_parameters(F)
    inverse = np.linalg.inv(F).transpose(0, 2, 1)
    assert close(by["mu"], F - inverse)
    assert close(by["lambda_"], np.log(np.linalg.det(F))[:, None, None] * inverse)
    ogden = piola.Material.typical("ogden")
    by = ogden.stress_by_parameters(F)
    assert by["mu"].shape == by["alpha"].shape == (3, *F.shape)
    mu, step = ogden.parameters["mu"], 1e2
    changed = [ogden.changed(mu=[mu[0] + sign * step, *mu[1:]]).stress(F) for sign in (1, -1)]
    assert close((changed[0] - changed[1]) / (2 * step), by["mu"][0], 1e-7)
    with pytest.raises(piola.DomainError):
        rubber.stress_by_parameters(np.diag([1.0, 1.0, -1.0]))


def test_derivatives_by_parameters_stay_in_single_precision(rubber, F):
    single, double = (rubber.stress_by_parameters(F.astype(dtype)) for dtype in (np.float32, np.float64))
    for name in ("mu", "lambda_"):
        assert single[name].dtype == np.float32 and double[name].dtype == np.float64
        assert close(single[name], double[name], 1e-6)
    assert np.array_equal(rubber.stress_by_parameters(np.eye(3, dtype=int).tolist())["mu"], np.zeros((3, 3)))
    with pytest.raises(piola.DomainError) as caught:
        rubber.stress_by_parameters([[np.eye(3), np.eye(3)], [np.eye(3), np.diag([1, 1, -1])]])
    assert caught.value.first == (1, 1)


def by_ordinates(points, at):
    """Derivatives of a natural cubic spline by the ordinates of its control points, except for one at x = 1."""
    x = np.array(points[::2])
    return np.moveaxis(CubicSpline(x, np.eye(len(x))[:, x != 1], bc_type="natural")(at), -1, 0)


def test_derivatives_by_curves_are_those_by_their_ordinates():
    drawn = piola.Material.typical("stretch_spline")
    f, g, h = (drawn.parameters[name] for name in "fgh")
    # Between the control points, as the products of two and of all three are.
    stretches = np.array([[1.7, 1.2, 0.6], [0.9, 0.8, 0.7]])
    areas, J = stretches[..., :, None] * stretches[..., None, :], stretches.prod(axis=-1)
    # P_ii = f′(λi) + Σ g′(λiλj) λj + h′(J) J/λi, with j other than i.
    expected = {
        "f": by_ordinates(f, stretches),
        "g": np.einsum("...ij,...j,ij->...i", by_ordinates(g, areas), stretches, 1 - np.eye(3)),
        "h": by_ordinates(h, J)[..., None] * J[:, None] / stretches,
    }
    by = drawn.stress_by_parameters(np.einsum("...i,ij->...ij", stretches, np.eye(3)))
    assert [len(by[name]) for name in "fgh"] == [5, 2, 3]
    for name in "fgh":
        assert by[name].shape == (*expected[name].shape, 3)
        # Differences have 470 roundings of stresses of some MPa, for ordinates of 20 kPa: 1e-11.
        assert close(by[name], np.einsum("...i,ij->...ij", expected[name], np.eye(3)), 1e-9)


def test_curves_that_differ_have_as_many_ordinates_or_no_derivatives(F):
    drawn = piola.Material.typical("stretch_spline")
    curves = [[0.5, -1e5, 1.0, 0.0, 2.0, 1e5], [0.5, -2e5, 1.0, 0.0, 2.0, 3e5]]
    graded = drawn.changed(f=curves)
    assert graded.shape == (2,)
    by = graded.stress_by_parameters(F[:2])
    assert [by[name].shape for name in "fgh"] == [(2, 2, 3, 3), (2, 2, 3, 3), (3, 2, 3, 3)]
    for k, curve in enumerate(curves):
        for name, derivatives in drawn.changed(f=curve).stress_by_parameters(F[k]).items():
            assert np.array_equal(by[name][:, k], derivatives)
    # Straight, and zero at x = 1 without a control point there.
    straight = [0.5, -1e5, 1.5, 1e5, 2.5, 3e5]
    assert drawn.changed(f=straight).stress_by_parameters(F)["f"].shape == (3, *F.shape)
    mixed = drawn.changed(f=[curves[0], straight])
    assert mixed.stress(F[:2]).shape == (2, 3, 3)
    with pytest.raises(piola.MaterialError, match="at x = 1 for some points and none for others"):
        mixed.stress_by_parameters(F[:2])
    with pytest.raises(TypeError, match="`f` is of type list; it must be real numbers"):
        drawn.changed(f=[curves[0], curves[0][:4]])
    with pytest.raises(piola.MaterialError, match="pairs x, φ′, but there are 3 numbers"):
        drawn.changed(f=curves[0][:3])


def test_parameters_may_differ_from_point_to_point(rng, F):
    mu = MU * rng.uniform(0.5, 2, len(F))
    declared = piola.declare("mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2", mu=mu, lambda_=LAMBDA)
    graded = piola.Material("neo_hookean", mu=mu, lambda_=LAMBDA)
    assert graded.shape == (len(F),) and np.array_equal(declared.stress(F), graded.stress(F))
    P = np.array([neo_hookean(F[k], mu[k])[1] for k in range(len(F))])
    assert close(graded.stress(F), P) and close(graded.stress(F.astype(np.float32)), P, 1e-5)
    for threads in (False, True):
        columns = np.ascontiguousarray(F.transpose(1, 2, 0))
        assert close(graded.stress(columns, trailing=True, threads=threads), P.transpose(1, 2, 0))
    with pytest.raises(ValueError, match=r"points of the shape \(5,\).*parameters of the shape \(333,\)"):
        graded.stress(F[:5])
    assert np.array_equal(graded.parameters["mu"], mu) and graded.parameters["lambda_"] == LAMBDA
    assert repr(graded) == "<piola.Material neo_hookean(mu=<array of shape (333,)>, lambda_=3000000.0)>"
    for call in (graded.contract, graded.stability, lambda: graded.changed(mu=1.0), lambda: pickle.dumps(graded)):
        with pytest.raises(piola.MaterialError, match="this needs one material for all"):
            call()
    with pytest.raises(piola.MaterialError, match=r"`lambda_` has .* \(3,\).* \(2,\): they cannot be broadcast"):
        piola.Material("neo_hookean", mu=np.ones(2), lambda_=np.ones(3))
    with pytest.raises(piola.MaterialError, match=r"^at index \(1, 0\): neo_hookean: .*mu = -1"):
        piola.Material("neo_hookean", mu=[[1.0], [-1.0]], lambda_=1.0)
    with pytest.raises(piola.MaterialError, match="no values"):
        piola.Material("neo_hookean", mu=[], lambda_=1.0)
    with pytest.raises(piola.MaterialError, match="no memory"):
        piola.Material("neo_hookean", mu=np.ones((10**6, 1)), lambda_=np.ones(10**7))


@pytest.mark.parametrize("trailing", [False, True])
@pytest.mark.parametrize(
    "of_mu, of_lambda, points",
    [
        ((100, 1), (), (100, 8)),
        ((100, 8), (8,), (100, 8)),
        ((8,), (), (100, 8)),
        ((100, 1), (1, 8), (100, 8)),
        ((1, 1, 1), (1,), (5,)),
        ((6, 1), (), (5,)),
        ((6,), (2, 1), ()),
        ((6, 1, 1), (5,), (7, 1)),
        ((1,), (), (0,)),
    ],
)
def test_parameters_are_broadcast_with_the_points(rng, of_mu, of_lambda, points, trailing):
    mu, lambda_ = MU * rng.uniform(0.5, 2, of_mu), LAMBDA * rng.uniform(0.5, 2, of_lambda)
    F = np.eye(3) + 0.2 * rng.uniform(-1, 1, (*points, 3, 3))
    shape = np.broadcast_shapes(of_mu, of_lambda, points)
    expected = neo_hookean(F, mu, lambda_)
    graded = piola.Material("neo_hookean", mu=mu, lambda_=lambda_)
    assert graded.shape == np.broadcast_shapes(of_mu, of_lambda)
    status = np.full(shape, 99, np.uint8)
    given = np.moveaxis(F, (-2, -1), (0, 1)) if trailing else F
    psi, P, A = graded.evaluate(given, trailing=trailing, status=status)
    if trailing:
        P, A = np.moveaxis(P, (0, 1), (-2, -1)), np.moveaxis(A, (0, 1, 2, 3), (-4, -3, -2, -1))
    for found, wanted in zip((psi, P, A), expected):
        assert found.shape == wanted.shape and np.allclose(found, wanted, rtol=1e-12, atol=1e-6)
    assert not status.any()
    by = graded.stress_by_parameters(F)
    by_J = np.swapaxes(np.linalg.inv(F), -1, -2)
    assert by["mu"].shape == by["lambda_"].shape == (*shape, 3, 3)
    assert np.allclose(by["mu"], np.broadcast_to(F - by_J, (*shape, 3, 3)))


def test_entries_of_lists_are_on_the_last_axis(rng, F):
    mu, alpha = rng.uniform(1, 2, (7, 2)), rng.uniform(1, 3, (4, 1, 2))
    graded = piola.Material("ogden", mu=mu, alpha=alpha, kappa=[10.0] * 7)
    assert graded.shape == (4, 7) and repr(graded).count("(7, 2)") == repr(graded).count("(4, 1, 2)") == 1
    assert graded.parameters["alpha"].shape == (4, 1, 2)
    P, by = graded.stress(F[:7]), graded.stress_by_parameters(F[:7])
    assert P.shape == (4, 7, 3, 3) and by["alpha"].shape == (2, 4, 7, 3, 3) and by["kappa"].shape == P.shape
    for i, j in [(0, 0), (3, 2), (2, 6)]:
        one = piola.Material("ogden", mu=mu[j], alpha=alpha[i, 0], kappa=10.0)
        assert close(P[i, j], one.stress(F[j]))
        for name, derivatives in one.stress_by_parameters(F[j]).items():
            assert np.array_equal(by[name][..., i, j, :, :], derivatives)
    assert piola.Material("ogden", mu=[1.0, 2.0], alpha=[2, 3], kappa=10).shape == ()
    with pytest.raises(piola.MaterialError, match="`alpha` must have 2 entries"):
        piola.Material("ogden", mu=mu, alpha=np.ones(3), kappa=10.0)


def test_threads_share_a_material(rubber, rng):
    inputs = [deformations(rng, 20_000) for _ in range(8)]
    results, errors = [None] * 8, []

    def work(k):
        try:
            for _ in range(5):
                results[k] = rubber.tangent(inputs[k], threads=bool(k % 2))
        except Exception as error:
            errors.append(error)

    workers = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert not errors
    for k in range(8):
        assert np.array_equal(results[k][1], rubber.tangent(inputs[k])[1])


def test_threads_cannot_write_to_one_array(rubber, rng):
    F = np.repeat(deformations(rng, 10)[:1], 200_000, axis=0)
    P, refused = np.empty_like(F), []

    def work():
        for _ in range(10):
            try:
                rubber.stress(F, out=P)
            except ValueError as error:
                refused.append(str(error))

    workers = [threading.Thread(target=work) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all("out cannot be written" in text for text in refused)
    assert np.array_equal(P[-1], rubber.stress(F[0]))


def test_others_run_meanwhile(rubber, rng):
    """Python goes on counting while a call of another thread computes."""
    F = np.repeat(deformations(rng, 10)[:1], 300_000, axis=0)
    counts, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counts[0] += 1

    counter = threading.Thread(target=count)
    counter.start()
    before = counts[0]
    for _ in range(3):
        rubber.tangent(F, threads=False)
    after = counts[0]
    done.set()
    counter.join()
    assert after - before > 1000


def test_the_number_of_threads_can_be_set(rubber, rng):
    F = deformations(rng, 5000)
    before, expected = piola.num_threads(), rubber.stress(F)
    try:
        for count in (1, 3):
            piola.set_num_threads(count)
            assert piola.num_threads() == count
            assert np.array_equal(rubber.stress(F, threads=True), expected)
    finally:
        piola.set_num_threads(before)
    with pytest.raises(ValueError, match="number of threads"):
        piola.set_num_threads(10**6)
