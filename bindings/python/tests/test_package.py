"""What a user finds: documentation, types, notebook and pictures."""

import ast
import inspect
import pathlib

import matplotlib
import numpy as np
import piola
import pytest

ROOT = pathlib.Path(__file__).parents[1]
STUBS = ast.parse((pathlib.Path(piola.__file__).parent / "__init__.pyi").read_text())


def members(stub):
    names = {node.name for node in stub.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    return names | {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}


def test_stubs_name_what_there_is():
    declared = members(STUBS)
    imported = {
        alias.asname for node in STUBS.body if isinstance(node, ast.ImportFrom) for alias in node.names if alias.asname
    }
    assert declared | imported == set(piola.__all__)
    for stub in STUBS.body:
        if isinstance(stub, ast.ClassDef):
            found = {name for name in vars(getattr(piola, stub.name)) if not name.startswith("_")}
            assert members(stub) - {"__new__"} == found, stub.name


def test_stubs_have_the_keywords_of_the_functions():
    functions = [(piola, node) for node in STUBS.body if isinstance(node, ast.FunctionDef)]
    for stub in STUBS.body:
        if isinstance(stub, ast.ClassDef):
            owner = getattr(piola, stub.name)
            functions += [(owner, node) for node in stub.body if isinstance(node, ast.FunctionDef)]
    for owner, node in functions:
        if node.name == "__new__" or isinstance(inspect.getattr_static(owner, node.name), property):
            continue
        if inspect.isgetsetdescriptor(inspect.getattr_static(owner, node.name)):
            continue
        found = inspect.signature(getattr(owner, node.name)).parameters
        arguments = node.args
        named = [a.arg for a in arguments.posonlyargs + arguments.args + arguments.kwonlyargs]
        named += [a.arg for a in (arguments.vararg, arguments.kwarg) if a]
        assert [name for name in named if name != "self"] == [name for name in found if name != "self"], node.name


def test_everything_is_documented():
    for name in piola.__all__:
        thing = getattr(piola, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and thing.__module__ == "piola":
            for member, value in vars(thing).items():
                if not member.startswith("_"):
                    assert inspect.getdoc(value), (name, member)


def test_exceptions_are_those_of_python_too():
    for name in piola.__all__:
        thing = getattr(piola, name)
        if inspect.isclass(thing) and issubclass(thing, Exception) and thing is not piola.Error:
            assert issubclass(thing, piola.Error) and issubclass(thing, (ValueError, RuntimeError))


def test_the_tutorial_runs(tmp_path, monkeypatch):
    monkeypatch.delenv("MPLBACKEND", raising=False)  # notebooks have their own
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    notebook = nbformat.read(ROOT / "tutorial.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    pictures = sum("image/png" in output.get("data", {}) for cell in notebook.cells for output in cell.get("outputs", []))
    assert pictures >= 3


def test_pictures_show_curves_and_bodies():
    matplotlib.use("Agg")
    import piola.plot

    data = piola.treloar()
    axes = piola.plot.curves({"rubber": piola.Material.typical("neo_hookean")}, data, incompressible=True)
    assert [ax.get_title() for ax in axes] == ["uniaxial", "equibiaxial", "pure shear"]
    assert len(axes[0].lines) == 2 and np.array_equal(axes[0].lines[1].get_xdata(), data["uniaxial"][:, 0])
    points, tets = piola.box_mesh((2, 1, 1), (2.0, 1.0, 1.0))
    faces = piola.plot.surface(tets)
    corners = points[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert areas.sum() == pytest.approx(10.0)
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ki,ki->k", outward, corners.mean(axis=1) - [1, 0.5, 0.5]) > 0).all()
    ax = piola.plot.body(points, tets, values=points[:, 0], label="x in m")
    assert len(ax.collections) == 1 and ax.figure.axes[1].get_ylabel() == "x in m"
    assert ax.collections[0].get_clim() == pytest.approx((0.0, 2.0))
    frame = pytest.importorskip("pandas").DataFrame({"stress": [1e5, 2e5], "stretch": [1.1, 1.2]})
    (ax,) = piola.plot.curves(piola.Material.typical("neo_hookean"), {"uniaxial": frame})
    assert ax.lines[1].get_xdata() == pytest.approx([1.1, 1.2])
