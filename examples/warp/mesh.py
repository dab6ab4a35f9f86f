"""Linear tetrahedra: their file, their quantities at rest, and groups of nodes for vertex block descent."""

import sys
from pathlib import Path

import numpy as np


class Mesh:
    """Nodes at rest and tetrahedra of a file of Gmsh: MSH 4.1 in ASCII, one block of each, tags 1, 2, 3 …"""

    def __init__(self, path):
        text = Path(path).read_text()
        sections = (text.split(f"${name}\n")[1].split("$")[0].split() for name in ("Nodes", "Elements"))
        nodes, elements = (np.array(section, dtype=float) for section in sections)
        if not nodes[0] == elements[0] == 1 or elements[6] != 4:
            sys.exit(f"{path}: only files with one block of nodes and one of linear tetrahedra are read")
        self.nodes = nodes[8 + len(nodes[8:]) // 4 :].reshape(-1, 3)
        self.tetrahedra = elements[8:].reshape(-1, 5)[:, 1:].astype(int) - 1
        edges = self.edges(self.nodes)
        self.volume, self.inverse = np.linalg.det(edges) / 6, np.linalg.inv(edges)
        if not (self.volume > 0).all():
            sys.exit(f"{path}: a tetrahedron is inverted at rest")
        # Gradients of the barycentric coordinates, rows of Dm⁻¹ for nodes 1 to 3, and the volume.
        gradients = np.concatenate([-self.inverse.sum(axis=1, keepdims=True), self.inverse], axis=1)
        self.rest = np.column_stack([gradients.reshape(-1, 3), np.repeat(self.volume, 4)])
        # Node k of element e is corner 4 e + k. The corners of node n are from first[n] to first[n + 1].
        self.corners = np.argsort(self.tetrahedra, axis=None, kind="stable")
        self.first = np.cumsum(np.bincount(self.tetrahedra.ravel() + 1))

    def lumped(self, density):
        """Mass of each node, kg."""
        return np.bincount(self.tetrahedra.ravel(), np.repeat(density / 4 * self.volume, 4))

    def edges(self, x):
        """Edges from node 0 of each tetrahedron, as columns."""
        return (x[self.tetrahedra[:, 1:]] - x[self.tetrahedra[:, :1]]).transpose(0, 2, 1)

    def groups(self):
        """Groups of nodes that share no element: each node is in the first group without its neighbours."""
        group = np.full(len(self.nodes), -1)
        for n in range(len(group)):
            taken = group[self.tetrahedra[self.corners[self.first[n] : self.first[n + 1]] // 4]]
            group[n] = min(set(range(taken.size + 1)) - set(taken.flat))
        return [np.flatnonzero(group == k) for k in range(group.max() + 1)]
