"""Materials by name and by text, and what they say when something is wrong."""

import pickle
import threading
import unicodedata

import numpy as np
import piola
import pytest
from conftest import close

FORMULA = "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2"


def message(error, call):
    with pytest.raises(error) as caught:
        call()
    return str(caught.value)


@pytest.mark.parametrize("name", piola.catalogue())
def test_the_whole_catalogue_computes(name, F):
    description = piola.describe(name)
    material = piola.Material.typical(name)
    assert material.parameters.keys() == {parameter.name for parameter in description.parameters}
    assert material.name == name and description.formula and description.domain
    F = np.eye(3) + 0.1 * (F[:20] - np.eye(3))
    psi, P, A = material.evaluate(F)
    step = 1e-5
    for i, j in [(0, 0), (1, 2)]:
        by = np.zeros((3, 3))
        by[i, j] = step
        slopes = (material.energy(F + by) - material.energy(F - by)) / (2 * step)
        assert np.abs(slopes - P[:, i, j]).max() < 1e-7 * np.abs(A).max()
        slopes = (material.stress(F + by) - material.stress(F - by)) / (2 * step)
        assert np.abs(slopes - A[..., i, j]).max() < 1e-5 * np.abs(A).max()
    single = material.tangent(F.astype(np.float32))[1]
    assert np.abs(single - A).max() < 1e-4 * np.abs(A).max()


def test_names_are_read_kindly():
    parameters = {"mu": 1e6, "lambda": 5e6}
    for name in ("neo_hookean", "Neo-Hookean", "NeoHookean", "neo hookean"):
        assert piola.Material(name, **parameters).name == "neo_hookean"


def test_parameters_are_kept_and_changed():
    material = piola.Material("ogden", mu=[6e5, -1e4], alpha=np.array([1.3, -2.0]), kappa=2e7)
    assert material.parameters == {"mu": [6e5, -1e4], "alpha": [1.3, -2.0], "kappa": 2e7}
    assert material.changed(kappa=1e7).parameters["kappa"] == 1e7
    assert repr(material) == "<piola.Material ogden(mu=[600000.0, -10000.0], alpha=[1.3, -2.0], kappa=20000000.0)>"
    assert piola.Material("neo_hookean", mu=1, lambda_=np.float32(2)).parameters == {"mu": 1.0, "lambda_": 2.0}


def test_moduli_are_those_of_small_strain():
    moduli = piola.Material("neo_hookean", mu=1e6, lambda_=4e6).moduli
    assert (moduli.mu, moduli.lambda_) == (1e6, 4e6)
    assert moduli.poisson == pytest.approx(0.4) and moduli.young == pytest.approx(2.8e6)
    assert moduli.bulk == pytest.approx(4e6 + 2e6 / 3)
    matched = piola.Material.matching("stable_neo_hookean", young=1e6, poisson=0.45).moduli
    assert matched.young == pytest.approx(1e6) and matched.poisson == pytest.approx(0.45)


def test_matched_moduli_are_those_asked_for_or_an_error():
    for name in ("neo_hookean", "st_venant_kirchhoff", "storakers", "ogden"):
        for poisson in (-0.2, 0.0, 0.25, 0.45):
            moduli = piola.Material.matching(name, young=1e6, poisson=poisson).moduli
            assert moduli.young == pytest.approx(1e6) and moduli.poisson == pytest.approx(poisson, abs=1e-12)
    for name, poisson, its_own in (("arap", 0.3, "ν = 0;"), ("blatz_ko", 0.0, "ν between 0 and 0.5;")):
        refused = message(piola.MaterialError, lambda: piola.Material.matching(name, young=1e6, poisson=poisson))
        assert its_own in refused


def test_wrong_parameters_are_named_with_their_range():
    new = piola.Material
    assert "there is no material `neohooke`; choose one of" in message(piola.MaterialError, lambda: new("neohooke"))
    assert message(piola.MaterialError, lambda: new("neo_hookean", mu=1.0)) == (
        "neo_hookean needs a value for `lambda_`"
    )
    assert message(piola.MaterialError, lambda: new("neo_hookean", mu=1.0, lamda=1.0)) == (
        "neo_hookean has no parameter `lamda`; did you mean `lambda_`? It has `mu`, `lambda_`"
    )
    assert message(piola.MaterialError, lambda: new("ogden", mu_1=1.0, alpha=[2.0], kappa=1.0)) == (
        "ogden has no parameter `mu_1`; did you mean `mu`? It has `mu`, `alpha`, `kappa`"
    )
    assert message(piola.MaterialError, lambda: piola.Material.typical("yeoh").changed(c10=1.0)) == (
        "yeoh has no parameter `c10`; did you mean `c1`? It has `c1`, `c2`, `c3`, `kappa`"
    )
    assert message(piola.MaterialError, lambda: new("neo_hookean", mu=-1.0, lambda_=1.0)) == (
        "neo_hookean: `mu > 0` must hold, but mu = -1"
    )
    assert "`mu` is NaN" in message(ValueError, lambda: new("neo_hookean", mu=np.nan, lambda_=1.0))
    assert "`lambda_` is inf; it must be a finite number" in message(
        ValueError, lambda: new("neo_hookean", mu=1.0, lambda_=np.inf)
    )
    assert message(ValueError, lambda: new("ogden", mu=[1.0, 2.0], alpha=[1.0], kappa=1.0)) == (
        "ogden: `alpha` must have 2 entries"
    )
    assert "`mu` is of type str" in message(TypeError, lambda: new("neo_hookean", mu="1", lambda_=1.0))
    assert "`mu`" in message(TypeError, lambda: new("neo_hookean", mu=None, lambda_=1.0))
    assert "`mu` is of type complex" in message(TypeError, lambda: new("neo_hookean", mu=1j, lambda_=1.0))
    assert "0.1" not in message(ValueError, lambda: new("neo_hookean", mu=1.0, lambda_=1.0, extend=2.0))
    assert "`mu` is of type bool" in message(TypeError, lambda: new("neo_hookean", mu=True, lambda_=1.0))
    typical = piola.Material.typical("murnaghan").parameters
    assert "use `extend=None`" in message(ValueError, lambda: new("murnaghan", extend=0.1, **typical))
    with pytest.raises(TypeError):
        new(3)
    with pytest.raises(TypeError):
        new()


def test_a_declared_energy_is_that_of_the_catalogue(F):
    declared = piola.declare(FORMULA, mu=1e6, lambda_=5e6)
    compiled = piola.Material("neo_hookean", mu=1e6, lambda_=5e6)
    for found, expected in zip(declared.evaluate(F), compiled.evaluate(F)):
        assert np.array_equal(found, expected)
    assert np.array_equal(declared.stress(F.astype(np.float32)), compiled.stress(F.astype(np.float32)))


@pytest.mark.parametrize("name", [*"bBCESUFePRVTKλµ", "name", "type_"])
def test_a_name_that_is_given_a_value_is_a_parameter(name, F):
    keyword = "name_" if name == "name" else unicodedata.normalize("NFKC", name)  # as Python does
    material = piola.declare(f"mu/2*(I1-3) - mu*ln(J) + {name}*ln(J)^2", **{"mu": 1e6, keyword: 2.5e6})
    assert close(material.stress(F), piola.Material("neo_hookean", mu=1e6, lambda_=5e6).stress(F))
    assert material.parameters.popitem()[1] == 2.5e6


def test_energies_are_called_by_their_formula_or_name():
    formula = "mu/2*(I1 - 3)\n    - mu*ln(J)"
    plain, named = piola.declare(formula, mu=1.0), piola.declare(formula, mu=1.0, name="my gel")
    assert plain.name == "mu/2*(I1 - 3) - mu*ln(J)" and named.name == "my gel"
    assert repr(plain) == "<piola.Material 'mu/2*(I1 - 3) - mu*ln(J)'(mu=1.0)>"
    assert repr(named) == "<piola.Material my gel(mu=1.0)>"
    assert repr(named.description) == "my gel(mu): 1/2 μ (I1 − 3) − μ ln J"
    for material, name in [(plain, plain.name), (named, "my gel")]:
        for copy in (material, pickle.loads(pickle.dumps(material)), material.changed(mu=2.0)):
            refused = message(piola.MaterialError, lambda: copy.changed(kappa=1.0))
            assert refused == f"{name} has no parameter `kappa`; it has `mu`"
        assert message(piola.MaterialError, lambda: material.changed(mu=-1.0)).startswith(f"{name}: ")
        fitted = material.fit(piola.treloar(), restarts=0).material
        assert fitted.name == name
    everywhere = "mu/2*(I1 - 3) - mu*(J - 1) + kappa/2*(J - 1)^2"
    assert message(piola.MaterialError, lambda: piola.declare(everywhere, mu=1, kappa=1, extend=0.1)) == (
        f"{everywhere}: the energy has no extension beyond its domain: it is defined for every deformation gradient "
        "already; use `extend=None`"
    )
    long = " + ".join(["mu/2*(I1 - 3) - mu*ln(J)"] * 20)
    assert len(piola.declare(long, mu=1.0).name) == 101
    springs = "#[material]\nfn Springs([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu * sum(|l| (l - 1.0).powi(2)) }"
    assert piola.declare(springs, mu=1.0).name == "Springs"
    assert piola.declare(springs, mu=1.0, name="my springs").name == "my springs"
    for empty in ("", " \n"):
        with pytest.raises(ValueError, match="the name is empty"):
            piola.declare(formula, mu=1.0, name=empty)


def test_names_materials_and_formulas_are_described():
    formula = "mu/2*(I1 - 3) - mu*ln(J)"
    expected = f"'{formula}'(mu): 1/2 μ (I1 − 3) − μ ln J"
    assert repr(piola.describe(formula)) == repr(piola.describe(piola.declare(formula, mu=1.0))) == expected
    assert piola.describe("mu/2*(I1 - 3)", free_rest=True).domain == "J > 0"
    named = piola.declare(formula, mu=np.ones(2), name="my gel")
    assert repr(piola.describe(named)) == "my gel(mu): 1/2 μ (I1 − 3) − μ ln J"
    yeoh = piola.describe("yeoh")
    assert repr(piola.describe(piola.Material.typical("yeoh"))) == repr(yeoh) and yeoh.parameters[0].unit == "Pa"
    springs = "#[material]\nfn Springs([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu * sum(|l| (l - 1.0).powi(2)) }"
    assert repr(piola.describe(springs)).startswith("Springs(mu): ")
    assert "there is no material `neohooke`" in message(piola.MaterialError, lambda: piola.describe("neohooke"))
    assert "free_rest=True" in message(piola.DeclarationError, lambda: piola.describe("mu/2*(I1 - 3)"))
    assert "mu/2*(I1 - 3" in message(piola.DeclarationError, lambda: piola.describe("mu/2*(I1 - 3"))
    assert message(TypeError, lambda: piola.describe(3)) == (
        "energy is of type int; it must be a name, a Material or a formula"
    )


def test_keywords_that_are_missing_or_wrong_are_told_with_the_parameters_there_are():
    declare = piola.declare
    for keywords, expected in [
        ({"lambda_": 1.0}, "needs a value for `mu`"),
        ({}, "needs a value for `mu`, `lambda_`"),
        ({"mu": 1.0, "lambda_": 1.0, "kappa": 1.0}, "has no parameter `kappa`; it has `mu`, `lambda_`"),
        (
            {"mu": 1.0, "lamda": 1.0},
            "has no parameter `lamda`; did you mean `lambda_`? It has `mu`, `lambda_`",
        ),
        ({"mu": 1.0, "lambda_": 1.0, "J": 1.0}, "has no parameter `J`; it has `mu`, `lambda_`"),
    ]:
        assert message(piola.MaterialError, lambda: declare(FORMULA, **keywords)) == f"{FORMULA} {expected}"


def test_others_run_while_a_formula_is_compiled():
    counts, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counts[0] += 1

    counter = threading.Thread(target=count)
    counter.start()
    try:
        terms = " + ".join(f"c{k}*(I1b - 3)^{k}" for k in range(1, 41))
        values = {f"c{k}": 1.0 for k in range(1, 41)}
        before = counts[0]
        piola.declare(f"{terms} + K/2*(J - 1)^2", K=1.0, **values)
        assert counts[0] - before > 1000
    finally:
        done.set()
        counter.join()


def test_a_declaration_in_rust_has_names_and_documentation():
    material = piola.declare(
        """
        /// Springs.
        #[material]
        pub fn Springs([l1, l2, l3]: [f64; 3], /** Stiffness, Pa. */ mu: f64) -> f64 {
            mu / 2.0 * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
        }
        """,
        mu=2.0,
    )
    assert material.name == "Springs" and material.description.parameters[0].unit == "Pa"
    assert close(material.stress(np.diag([1.5, 1.0, 1.0])), np.diag([1.0, 0.0, 0.0]))


def test_mistakes_of_a_text_are_told_at_their_places():
    with pytest.raises(piola.DeclarationError) as caught:
        piola.declare("mu/2*(I1 - 3", mu=1.0)
    text, place = caught.value.mistakes[0]
    assert place[:2] == (1, 6) and text in str(caught.value) and "^" in str(caught.value)
    assert isinstance(caught.value, ValueError)
    assert "--> my gel:1:6" in message(piola.DeclarationError, lambda: piola.declare("mu/2*(I1 - 3", name="my gel", mu=1.0))
    assert "stress" in message(piola.DeclarationError, lambda: piola.declare("C10*(I1 - 3)", C10=1.0))
    freed = piola.declare("C10*(I1 - 3) + kappa/2*(J-1)^2", C10=1.0, kappa=10.0, free_rest=True)
    assert np.abs(freed.stress(np.eye(3))).max() < 1e-12
    assert "needs a value for `mu`" in message(piola.MaterialError, lambda: piola.declare(FORMULA, lambda_=1.0))
    springs = "fn Springs([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu * sum(|l| (l - 1.0).powi(2)) }"
    assert "with `#[material]` before it" in message(piola.DeclarationError, lambda: piola.declare(springs, mu=1.0))
    for text in ("", "(" * 100_000, "mu" * 50_000, "\0", "∫", "fn", "#[material] fn", "1/0", "J^J^J^J"):
        with pytest.raises((piola.DeclarationError, piola.MaterialError)):
            piola.declare(text, mu=1.0)


def test_an_energy_is_printed_as_c():
    rubber = piola.declare(FORMULA, mu=1e6, **{"lambda": 5e6})
    text = rubber.emit("c", name="rubber", precision="f32", functions=["stress"])
    assert "unsigned rubber_stress(const rubber_parameters *p, const float F[9], float P[9])" in text
    assert "rubber_tangent" not in text and "{1000000.0f, 5000000.0f}" in text
    assert "fn rubber_stress(" in rubber.emit("wgsl", name="rubber", functions=["stress"])
    assert "choose the precision f32" in message(piola.MaterialError, lambda: rubber.emit("wgsl", precision="f64"))
    assert "known are: c" in message(ValueError, lambda: rubber.emit("fortran"))
    assert "unknown function `forces`" in message(ValueError, lambda: rubber.emit("c", functions=["forces"]))
    assert "is not a name" in message(piola.MaterialError, lambda: rubber.emit("c", name="a b"))
