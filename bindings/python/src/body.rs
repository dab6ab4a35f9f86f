//! Bodies of linear tetrahedra: their energy, forces and stiffness at any positions.

use std::error::Error;
use std::sync::Mutex;

use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use piola::Survey;
use piola::point::Filter;
use piola_bodies::mesh::{Group, TetMesh, tetrahedral_box};
use piola_bodies::system::{self, ElasticResponse, NodalStiffness, Part};
use pyo3::prelude::*;
use pyo3::types::PySequence;

use crate::arrays::{from_rows, indices, kind, numbers, read_only, rows};
use crate::errors::{DomainError, of_body, type_error};
use crate::evaluate::filter;
use crate::material::Material;
use crate::threads::with_locked;

/// An elastic body: tetrahedra with a material and a density.
///
///     Body(points, tets, material, density, *, parts=None)
///
/// points: rest positions of the nodes, m, of shape (n, 3): `mesh.points` of meshio.
/// tets: nodes of each tetrahedron, from 0, of shape (m, 4), in the order of a positive volume, which
///     `turn_tets` brings about: `mesh.cells_dict["tetra"]`.
/// material, density: a Material and its density, kg/m³; or a sequence of each, one for each part. A material
///     whose parameters differ from point to point has them for each tetrahedron of its part.
/// parts: the part of each tetrahedron, from 0, of shape (m,), if there are several.
///
/// Raises BodyError for a mesh, a density or parts that are not valid.
#[pyclass(frozen, module = "piola")]
pub(crate) struct Body {
    pub(crate) body: system::Body,
    /// Memory that evaluations reuse.
    memory: Mutex<Memory>,
}

/// Row, column and entries of each block.
type Triplets<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyAny>);

/// Error of an evaluation: positions of another number of nodes, or a stiffness beyond all memory.
type Failure = Box<dyn Error + Send + Sync>;

struct Memory {
    response: ElasticResponse,
    stiffness: Option<NodalStiffness>,
}

impl Body {
    /// Evaluates something, on threads, without the interpreter; raises an error for tetrahedra outside of
    /// the domain.
    fn evaluate<T: Send>(
        &self,
        py: Python<'_>,
        compute: impl FnOnce(&system::Body, &mut Memory) -> Result<(T, Survey), Failure> + Send,
    ) -> PyResult<T> {
        let evaluated = with_locked(py, &self.memory, |memory| compute(&self.body, memory))?;
        let (value, survey) = evaluated.map_err(of_body)?;
        let Some(first) = survey.first else { return Ok(value) };
        let Survey { refused, nonfinite, .. } = survey;
        let tet = self.body.elements()[first].tag;
        let message = format!(
            "{refused} tetrahedra are outside the domain of their material, and {nonfinite} not finite; the first \
             of them is {tet} (from 0)"
        );
        Err(DomainError::new_err((message, (tet,), refused, nonfinite)))
    }
}

#[pymethods]
impl Body {
    #[new]
    #[pyo3(signature = (points, tets, material, density, *, parts = None))]
    fn new(
        points: &Bound<'_, PyAny>,
        tets: &Bound<'_, PyAny>,
        material: &Bound<'_, PyAny>,
        density: &Bound<'_, PyAny>,
        parts: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let mut mesh = TetMesh::new(rows("points", points)?, indices("tets", tets)?);
        // Messages count tetrahedra from 0.
        mesh.tags = (0..mesh.tets.len()).collect();
        let (materials, densities) = (materials(material)?, numbers("density", density)?);
        if materials.len() != densities.len() {
            let (materials, densities) = (materials.len(), densities.len());
            return Err(of_body(format!("there are {materials} materials and {densities} densities")));
        }
        let part_of: Vec<[usize; 1]> = match parts {
            Some(parts) => indices("parts", parts)?,
            None if materials.len() == 1 => vec![[0]; mesh.tets.len()],
            None => return Err(of_body("several materials need `parts`, the material of each tetrahedron")),
        };
        if part_of.len() != mesh.tets.len() {
            let (parts, tets) = (part_of.len(), mesh.tets.len());
            return Err(of_body(format!("parts has {parts} entries; it must have one for each of {tets}")));
        }
        let group = |part: usize| {
            let tets = (0..part_of.len()).filter(|&tet| part_of[tet] == [part]).collect();
            Group { name: part.to_string(), dimension: 3, tets, ..Group::default() }
        };
        mesh.groups = (0..materials.len()).map(group).collect();
        let part = |(part, (material, density)): (usize, (&Py<Material>, f64))| {
            let material = material.get().elements(mesh.groups[part].tets.len())?;
            Ok(Part { group: Some(part.to_string()), material, density })
        };
        let parts: Vec<_> = materials.iter().zip(densities).enumerate().map(part).collect::<PyResult<_>>()?;
        let body = system::Body::from_parts(&mesh, parts).map_err(of_body)?;
        let memory = Mutex::new(Memory { response: ElasticResponse::new(&body), stiffness: None });
        Ok(Self { body, memory })
    }

    /// Rest positions of the nodes, m, of shape (n, 3), to be read.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        read_only(from_rows(py, self.body.rest())?)
    }

    /// Lumped masses of the nodes, kg, of shape (n,), to be read.
    #[getter]
    fn masses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        read_only(self.body.masses().to_vec().into_pyarray(py))
    }

    /// Energy of deformation, J, with the nodes at these positions, m, of shape (n, 3).
    ///
    /// Raises DomainError if a tetrahedron is outside the domain of its material, like all methods below.
    #[pyo3(signature = (positions, /))]
    fn energy(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<f64> {
        let x = rows("positions", positions)?;
        self.evaluate(py, |body, memory| Ok(memory.response.energy(body, &x)?))
    }

    /// Gradient of the energy in the positions, N, of shape (n, 3): minus the forces.
    #[pyo3(signature = (positions, /))]
    fn gradient<'py>(&self, py: Python<'py>, positions: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let x = rows("positions", positions)?;
        let mut gradient = vec![[0.0; 3]; self.body.rest().len()];
        self.evaluate(py, |body, memory| {
            memory.response.energy(body, &x)?;
            Ok(((), memory.response.gradient_here(body, &mut gradient)?))
        })?;
        from_rows(py, &gradient)
    }

    /// Stiffness, N/m: second derivatives of the energy, a symmetric `scipy.sparse.csr_array` of shape
    /// (3n, 3n), in which coordinate c of node k has index 3k + c.
    ///
    ///     stiffness(positions, /, *, filter=None)
    ///
    /// filter: as for `Material.tangent`, for each tetrahedron.
    ///
    /// Raises ImportError without scipy, which `stiffness_blocks` does not need.
    #[pyo3(signature = (positions, /, *, filter = None))]
    fn stiffness<'py>(
        &self,
        py: Python<'py>,
        positions: &Bound<'py, PyAny>,
        filter: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (rows, columns, blocks) = self.stiffness_blocks(py, positions, filter)?;
        let nodes = self.body.rest().len();
        py.import("piola.results")?.call_method1("csr_array", (rows, columns, blocks, nodes))
    }

    /// Stiffness, N/m, in blocks of 3x3: (rows, columns, blocks), of shapes (b,), (b,) and (b, 3, 3).
    ///
    ///     stiffness_blocks(positions, /, *, filter=None)
    ///
    /// Block k holds the second derivatives of the energy by the positions of node rows[k] and node
    /// columns[k]. They come row by row, each pair of nodes in both orders, and always at the same place.
    ///
    /// filter: as for `Material.tangent`, for each tetrahedron.
    #[pyo3(signature = (positions, /, *, filter = None))]
    fn stiffness_blocks<'py>(
        &self,
        py: Python<'py>,
        positions: &Bound<'py, PyAny>,
        filter: Option<&str>,
    ) -> PyResult<Triplets<'py>> {
        let x = rows("positions", positions)?;
        let filter: Filter = self::filter(filter)?;
        let mut gradient = vec![[0.0; 3]; self.body.rest().len()];
        let ((rows, columns), blocks): ((Vec<_>, Vec<_>), Vec<_>) =
            self.evaluate(py, |body, Memory { response, stiffness }| {
                let matrix = match stiffness {
                    Some(matrix) => matrix,
                    None => stiffness.insert(NodalStiffness::of_body(body)?),
                };
                response.energy(body, &x)?;
                let survey = response.stiffness_here(body, filter, &mut gradient, matrix)?;
                // Both blocks of each pair of nodes, of which the matrix has one.
                let mut of_rows = vec![Vec::new(); gradient.len()];
                for (row, column, block) in matrix.blocks() {
                    of_rows[row].push((column, *block));
                    if row != column {
                        let transposed = std::array::from_fn(|i| std::array::from_fn(|j| block[j][i]));
                        of_rows[column].push((row, transposed));
                    }
                }
                let sorted = of_rows.into_iter().enumerate().flat_map(|(row, mut of_row)| {
                    of_row.sort_unstable_by_key(|&(column, _)| column);
                    of_row.into_iter().map(move |(column, block)| ((row as i64, column as i64), block))
                });
                Ok((sorted.unzip(), survey))
            })?;
        let flat = blocks.as_flattened().as_flattened().to_vec().into_pyarray(py);
        let blocks = flat.reshape([blocks.len(), 3, 3])?.into_any();
        Ok((rows.into_pyarray(py), columns.into_pyarray(py), blocks))
    }

    fn __repr__(&self) -> String {
        format!(
            "<piola.Body of {} nodes and {} tetrahedra>",
            self.body.rest().len(),
            self.body.elements().len()
        )
    }
}

/// One material, or a sequence of them.
fn materials(given: &Bound<'_, PyAny>) -> PyResult<Vec<Py<Material>>> {
    let material = |given: &Bound<'_, PyAny>| match given.cast::<Material>() {
        Ok(material) => Ok(material.clone().unbind()),
        Err(_) => Err(type_error(format!("material is {}; it must be a piola.Material", kind(given)))),
    };
    match given.cast::<PySequence>() {
        Ok(sequence) => sequence.try_iter()?.map(|given| material(&given?)).collect(),
        Err(_) => Ok(vec![material(given)?]),
    }
}

/// A box of tetrahedra from the origin, six for each cell: (points, tets), of shapes (n, 3) and (6 cells, 4).
///
///     box_mesh(cells, size, /)
///
/// cells: number of cells along the three axes.
/// size: the lengths, m.
///
/// Raises BodyError for no cells, too many, or a length that is not positive and finite.
#[pyfunction]
#[pyo3(signature = (cells, size, /))]
pub(crate) fn box_mesh<'py>(
    py: Python<'py>,
    cells: [usize; 3],
    size: [f64; 3],
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let mesh = tetrahedral_box(cells, size).map_err(of_body)?;
    Ok((from_rows(py, &mesh.positions)?, tets_of(py, &mesh)?))
}

/// Tetrahedra with positive volumes, of shape (m, 4): two nodes of each with a negative one are swapped.
///
///     turn_tets(points, tets, /)
///
/// points, tets: as for `Body`. Flat tetrahedra, and those with a missing node, remain as they are.
#[pyfunction]
#[pyo3(signature = (points, tets, /))]
pub(crate) fn turn_tets<'py>(
    points: &Bound<'py, PyAny>,
    tets: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let mesh = TetMesh::new(rows("points", points)?, indices("tets", tets)?);
    tets_of(points.py(), &mesh.turn_tets())
}

/// The tetrahedra of a mesh as an array of shape (m, 4).
fn tets_of<'py>(py: Python<'py>, mesh: &TetMesh) -> PyResult<Bound<'py, PyAny>> {
    let tets: Vec<[i64; 4]> = mesh.tets.iter().map(|tet| tet.map(|node| node as i64)).collect();
    from_rows(py, &tets)
}
