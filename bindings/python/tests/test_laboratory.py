"""Curves, fits, stability and the contract."""

import numpy as np
import piola
import pytest
from conftest import LAMBDA, MU

FORMULA = "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2"


@pytest.fixture
def rubber():
    return piola.Material("neo_hookean", mu=MU, lambda_=LAMBDA)


def test_curves_are_those_on_paper(rubber):
    stretch = np.linspace(0.5, 3, 11)
    curve = rubber.curve("uniaxial", stretch, incompressible=True)
    assert np.allclose(curve.stress, MU * (stretch - stretch**-2), rtol=1e-12, atol=1e-6)
    assert np.allclose(curve.stretches.prod(axis=1), 1) and curve.reasons == [None] * 11
    free = rubber.curve("uniaxial", stretch)
    P = rubber.stress(np.einsum("ni,ij->nij", free.stretches, np.eye(3)))
    assert np.allclose(P[:, 0, 0], free.stress) and np.abs(P[:, 1:]).max() < 1e-6 * MU
    shear = rubber.curve("simple_shear", [0.0, 0.5])
    assert np.allclose(shear.stress, [0, 0.5 * MU])


def test_points_that_a_curve_lacks_are_nan_with_a_reason(rubber):
    curve = rubber.curve("uniaxial", [1.0, -1.0, np.nan, np.inf])
    assert list(np.isnan(curve.stress)) == [False, True, True, True]
    assert "must be positive and finite" in curve.reasons[1]
    with pytest.raises(ValueError, match="is not a test"):
        rubber.curve("torsion", [1.0])
    with pytest.raises(TypeError, match="controls"):
        rubber.curve("uniaxial", "abc")
    with pytest.raises(ValueError, match="controls"):
        rubber.curve("uniaxial", np.ones((2, 2)))


def test_a_fit_finds_the_parameters_of_its_data():
    stretch = np.linspace(1.1, 3, 20)
    truth = piola.Material("yeoh", c1=2e5, c2=-2e3, c3=1e2, kappa=1e9)
    modes = ("uniaxial", "equibiaxial")
    data = {mode: np.c_[stretch, truth.curve(mode, stretch, incompressible=True).stress] for mode in modes}
    start = piola.Material("yeoh", c1=1e5, c2=0.0, c3=0.0, kappa=1e9)
    fit = start.fit(data, held=["kappa"], restarts=2)
    for name in ("c1", "c2", "c3"):
        assert fit.material.parameters[name] == pytest.approx(truth.parameters[name], rel=1e-6)
    assert fit.determination["all"] > 1 - 1e-12 and fit.errors["kappa"] is None
    assert fit == start.fit(data, held=["kappa"], restarts=2)._replace(material=fit.material)


def test_lambda_has_one_spelling(rubber):
    data = {"uniaxial": [[1.5, 1e6], [2.0, 2e6], [3.0, 3e6]]}
    for name in ("lambda_", "lambda"):
        fit = rubber.fit(data, held=[name], restarts=0)
        assert fit.material.parameters["lambda_"] == LAMBDA and fit.errors["lambda_"] is None
    assert list(fit.errors) == list(fit.material.parameters) == list(rubber.stress_by_parameters(np.eye(3)))
    assert [parameter.name for parameter in rubber.description.parameters] == ["mu", "lambda_"]
    assert "lambda_=" in repr(rubber) and piola.Material("neo_hookean", **rubber.parameters).moduli == rubber.moduli
    with pytest.raises(TypeError, match="`lambda_` is of type str"):
        rubber.changed(lambda_="soft")


def test_a_fit_finds_the_ordinates_of_a_curve():
    text = """#[material]
    fn Drawn([l1, l2, l3]: [f64; 3], f: Spline, kappa: f64) -> f64 {
        f(l1) + f(l2) + f(l3) + kappa / 2.0 * (J - 1.0).powi(2)
    }"""
    truth = piola.declare(text, f=[0.3, -9e5, 0.7, -3e5, 1.0, 0.0, 1.7, 4e5, 2.6, 1.2e6], kappa=2e6)
    start = piola.declare(text, f=[0.3, -6e5, 0.7, -2e5, 1.0, 0.0, 1.7, 3e5, 2.6, 6e5], kappa=1e6)
    stretch = [0.7, 0.85, 1.1, 1.3, 1.6, 2.0, 2.5]
    data = {mode: np.c_[stretch, truth.curve(mode, stretch).stress] for mode in ("uniaxial", "equibiaxial")}
    fit = start.fit(data, incompressible=False, restarts=4)
    assert fit.difference <= 1e-9 and list(fit.errors) == ["f_1", "f_2", "f_3", "f_4", "kappa"]
    found, wanted = fit.material.parameters, truth.parameters
    # Differences of a billionth, times the condition of the problem.
    assert found["f"] == pytest.approx(wanted["f"], rel=1e-9 * fit.condition, abs=0)
    assert found["f"][::2] == wanted["f"][::2] and found["f"][5] == 0.0
    assert found["kappa"] == pytest.approx(2e6, rel=1e-9 * fit.condition)
    held = start.fit(data, incompressible=False, restarts=0, held=["f_2"])
    assert held.material.parameters["f"][3] == -2e5 and held.errors["f_2"] is None
    whole = start.fit(data, incompressible=False, restarts=0, held=["f"])
    assert whole.material.parameters["f"] == start.parameters["f"]
    with pytest.raises(piola.FitError, match="no parameter `f_5` to hold"):
        start.fit(data, held=["f_5"])
    other = [0.3, -6e5, 0.7, -2e5, 1.0, 0.0, 1.7, 4e5, 2.6, 8e5]
    with pytest.raises(piola.MaterialError, match="this needs one material for all"):
        start.changed(f=[start.parameters["f"], other]).fit(data)


def test_treloar_is_fitted_and_warned_about():
    data = piola.treloar()
    assert data["uniaxial"].shape[1] == 2 and set(data) == {"uniaxial", "equibiaxial", "pure_shear"}
    fit = piola.declare(FORMULA, mu=4e5, lambda_=1e7).fit(data, restarts=0)
    assert 0.5 < fit.determination["all"] < 1 and any("determine lambda_," in warning for warning in fit.warnings)


def test_noise_near_zero_does_not_decide_in_silence(rubber):
    rng = np.random.default_rng(1)
    stretch = 1 + np.r_[np.linspace(0.0005, 0.02, 30), np.linspace(0.03, 1, 60)]
    shape = stretch - stretch**-2
    stress = 30e3 * shape + rng.normal(0, 400, stretch.size)

    def linear(floor):
        size = np.maximum(np.abs(stress), floor * stress.max())
        return (shape * stress / size**2).sum() / ((shape / size) ** 2).sum()

    data = {"uniaxial": np.c_[stretch, stress]}
    words = "near zero stress decide the fit, with 56 % .*: uniaxial 1.0166, uniaxial 1.0025;.* `floor=0.05`, .* `relative=False`$"
    with pytest.warns(UserWarning, match=words):
        fit = rubber.fit(data)
    assert fit.material.parameters["mu"] == pytest.approx(linear(0), rel=1e-9) and linear(0) < 26e3
    for options, floor in (({"floor": 0.05}, 0.05), ({"relative": False}, 1)):
        found = rubber.fit(data, **options).material.parameters["mu"]
        assert found == pytest.approx(linear(floor), rel=1e-9) and found == pytest.approx(30e3, rel=0.01)
    for floor in (-0.1, 1.5, np.nan):
        with pytest.raises(piola.FitError, match="share of the greatest stress, from 0 to 1"):
            rubber.fit(data, floor=floor)
    with pytest.raises(ValueError, match="no `floor`"):
        rubber.fit(data, floor=0.05, relative=False)


def test_columns_of_a_frame_are_found_by_their_names(rubber):
    pandas = pytest.importorskip("pandas")
    stretch = np.linspace(1.05, 2, 20)
    stress = 4e5 * (stretch - stretch**-2)
    for columns in (
        {"stress": stress, "stretch": stretch},
        {"stretch": stretch, "stress": stress},
        {"strain": stretch - 1, "stress": stress},
        {"time": stretch, "stress [MPa]": stress / 1e6, "strain [%]": 100 * stretch - 100},
    ):
        fit = rubber.fit({"tension": pandas.DataFrame(columns)}, held=["lambda_"])
        assert fit.material.parameters["mu"] == pytest.approx(4e5, rel=1e-9)
    assert rubber.fit({"tension": np.c_[stretch, stress]}, held=["lambda"]).errors["lambda_"] is None
    nameless = pandas.DataFrame(np.c_[stretch, stress])
    assert rubber.fit({"tension": nameless}).material.parameters["mu"] == pytest.approx(4e5, rel=1e-9)
    with pytest.raises(ValueError, match="the columns are 1 `a`, 2 `b`"):
        rubber.fit({"uniaxial": pandas.DataFrame({"a": stretch, "b": stress})})


@pytest.mark.parametrize(
    ("strains", "stresses", "words"),
    [
        ([0.5, 1, 0, 0.5, 1], [4, 6, 0, 2, 3], "turns 2 times.*`cycle=1`"),
        ([0.5, 0.5, 1], [4, 2, 3], "4 Pa at λ = 1.5 and 2 Pa at λ = 1.5"),
        ([0.75, 1], [4, 0.5], "4 Pa at λ = 1.75 and 0.5 Pa at λ = 2"),
        ([1, 1.5], [0, 2], "begins with 0 Pa at λ = 2, far from rest"),
        ([-0.5, -0.25], [1, 2], "2 Pa at λ = 0.75 and 0 Pa at λ = 1"),
        ([0.1, 0.5, 0.4, 1], [1, 4, 3.5, 6], None),
        ([0, 1, 1.5, -0.5], [0, 0, 2, -9], None),
    ],
)
def test_points_that_are_no_single_curve_are_told(rubber, strains, stresses, words):
    data = {"uniaxial": np.c_[1 + np.array(strains), stresses]}
    if words is None:
        assert rubber.fit(data).material.parameters["mu"] > 0
        return
    with pytest.raises(ValueError, match=words):
        rubber.fit(data)
    rubber.fit(data, cycle=1)
    with pytest.raises(ValueError, match="there is no cycle 3"):
        rubber.fit(data, cycle=3)


def test_tables_are_read_by_explicit_choice():
    plain = piola.measurements("strain [%];stress [MPa]\n10;0,12\n50;0,4\n", mode="uniaxial")
    assert np.allclose(plain["uniaxial"], [[1.1, 0.12e6], [1.5, 0.4e6]], rtol=1e-14)
    text = "Zeit,Dehnung,Spannung\n0,1.1,0.12\n1,1.5,0.4\n"
    chosen = piola.measurements(text, strain="Dehnung=stretch", stress="3", mode="uniaxial", unit="MPa")
    assert np.allclose(chosen["uniaxial"], plain["uniaxial"], rtol=1e-14)
    with pytest.raises(ValueError, match="1 `Zeit`, 2 `Dehnung`, 3 `Spannung`"):
        piola.measurements(text, mode="uniaxial")
    with pytest.raises(ValueError, match="is not a test"):
        piola.measurements(text, mode="torsion")


def test_data_that_cannot_be_fitted_are_refused(rubber):
    def message(error, call):
        with pytest.raises(error) as caught:
            call()
        return str(caught.value)

    data = {"uniaxial": [[1.5, 1e6], [2.0, 2e6], [3.0, 3e6]]}
    assert message(piola.FitError, lambda: rubber.fit(data, held=["kappa"])) == (
        "there is no parameter `kappa` to hold; there are `mu`, `lambda_`"
    )
    assert "(n, 2)" in message(ValueError, lambda: rubber.fit({"uniaxial": np.ones(3)}))
    assert "cannot be fitted" in message(piola.FitError, lambda: rubber.fit({"uniaxial": [[np.nan, 1e6]]}))
    assert "no point" in message(piola.FitError, lambda: rubber.fit({}))
    assert "is not a test" in message(ValueError, lambda: rubber.fit({"torsion": [[1.5, 1e6]]}))
    assert "at most" in message(piola.FitError, lambda: rubber.fit(data, restarts=10**9))


def test_stability_is_lost_where_it_is_on_paper():
    solid = piola.Material("st_venant_kirchhoff", mu=1.0, lambda_=0.0)
    found = solid.stability(resolution=11)
    walk = next(walk for walk in found.walks if walk.path == "confined" and walk.to == 0.3)
    assert walk.lost["strong_ellipticity"] == pytest.approx(2 - 2**0.5, abs=1e-8)
    assert found.admitted == found.points > found.kept["strong_ellipticity"]
    assert "strong ellipticity" in str(found)
    with pytest.raises(ValueError, match="stretches are from"):
        solid.stability(smallest=2.0)
    with pytest.raises(ValueError, match="resolution"):
        solid.stability(resolution=1)


def test_the_contract_is_kept():
    rules = piola.declare(FORMULA, mu=1e6, lambda_=5e6).contract()
    assert {"rest", "isotropy", "quotients"} <= {rule for rule, _, _ in rules}
    assert all(comparisons > 0 and 0 <= worst <= 1 for _, comparisons, worst in rules)
    plain, extended = (piola.Material.typical("ogden", extend=extend).contract() for extend in (None, 0.1))
    assert {rule for rule, _, _ in extended} - {rule for rule, _, _ in plain} == {"extension"}
