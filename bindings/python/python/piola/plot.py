"""Pictures, by matplotlib: test curves with measurements, and bodies."""

import numpy as np

from piola.results import readings

_CONTROLS = {
    "uniaxial": "stretch",
    "equibiaxial": "stretch",
    "pure_shear": "stretch",
    "simple_shear": "shear",
    "volumetric": "ratio of volumes J",
}


def curves(materials, data=None, *, modes=None, controls=None, incompressible=False, axes=None):
    """Draws test curves of materials, and measurements as points.

    materials: a Material, a sequence of them, or a dictionary from labels to them.
    data: a dictionary from modes to arrays of shape (n, 2) or DataFrames, as `Material.fit` takes it.
    modes: names of tests; None for those of the data, or uniaxial, equibiaxial and pure shear.
    controls: what the machine sets, of shape (n,); None for the range of the data, or 0.6 to 3.
    axes: axes of matplotlib, one for each mode; None for new ones.

    Returns the axes.
    """
    if hasattr(materials, "curve"):
        materials = [materials]
    if not hasattr(materials, "items"):
        materials = {material.name: material for material in materials}
    data = data or {}
    modes = list(modes or data or ["uniaxial", "equibiaxial", "pure_shear"])
    if axes is None:
        import matplotlib.pyplot as plt

        axes = plt.subplots(1, len(modes), figsize=(4 * len(modes), 3.2), layout="constrained", squeeze=False)[1][0]
    for mode, ax in zip(modes, np.atleast_1d(axes)):
        measured = np.asarray(readings(mode, data[mode]), float) if mode in data else None
        for label, material in materials.items():
            at = controls if controls is not None else _range(mode, measured)
            curve = material.curve(mode, at, incompressible=incompressible)
            ax.plot(curve.control, curve.stress / 1e6, label=label)
        if measured is not None:
            ax.plot(measured[:, 0], measured[:, 1] / 1e6, "ko", markersize=3, label="measured")
        ax.set(title=mode.replace("_", " "), xlabel=_CONTROLS[mode], ylabel="stress in MPa")
        ax.legend()
    return axes


def body(points, tets, *, values=None, label=None, ax=None):
    """Draws the surface of a body of tetrahedra.

    points: positions, m, of shape (n, 3). tets: of shape (m, 4).
    values: a number for each node, of shape (n,), that colours the surface; label: what they are.
    ax: an axis of matplotlib in three dimensions; None for a new one.

    Returns the axis.
    """
    points, faces = np.asarray(points), surface(tets)
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.figure(figsize=(6, 4), layout="constrained").add_subplot(projection="3d")
    drawn = ax.plot_trisurf(*points.T, triangles=faces, linewidth=0.2, edgecolor="grey", cmap="viridis")
    if values is not None:
        drawn.set_array(np.asarray(values)[faces].mean(axis=1))
        drawn.autoscale()
        ax.figure.colorbar(drawn, ax=ax, shrink=0.6, label=label)
    lengths = np.ptp(points, axis=0)
    for axis, length in zip("xyz", lengths):
        ax.locator_params(axis=axis, nbins=max(1, round(6 * length / lengths.max())))
    ax.set(xlabel="x in m", ylabel="y in m", zlabel="z in m", aspect="equal")
    return ax


def surface(tets):
    """The faces of tetrahedra that belong to one of them only, seen from outside counterclockwise: (k, 3)."""
    faces = np.concatenate([np.asarray(tets)[:, list(face)] for face in [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]])
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[counts == 1]]


def _range(mode, measured):
    if measured is not None:
        return np.linspace(measured[:, 0].min(), measured[:, 0].max(), 101)
    return np.linspace(0.0, 2.0, 101) if mode == "simple_shear" else np.linspace(0.6, 3.0, 101)
