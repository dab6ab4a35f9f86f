//! Bodies of linear tetrahedra: their energy, forces and stiffness at any positions.

use std::sync::{Mutex, MutexGuard, PoisonError};

use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use piola::Survey;
use piola::batch::LengthError;
use piola::mesh::{Group, TetMesh, tetrahedral_box};
use piola::point::Filter;
use piola::system::{self, ElasticResponse, NodalStiffness, Part};
use pyo3::prelude::*;
use pyo3::types::PySequence;

use crate::arrays::{from_rows, indices, kind, numbers, rows};
use crate::errors::{BodyError, DomainError, of_body, type_error};
use crate::evaluate::filter;
use crate::material::Material;
use crate::threads::on_threads;

/// An elastic body: tetrahedra with a material and a density.
///
///     Body(points, tets, material, density, *, parts=None)
///
/// points: rest positions of the nodes, m, of shape (n, 3): `mesh.points` of meshio.
/// tets: nodes of each tetrahedron, of shape (m, 4), positively oriented: `mesh.cells_dict["tetra"]`.
/// material, density: a Material and its density, kg/m³; or a sequence of each, one for each part. A material
///     that was declared with parameters for each point has them for each tetrahedron.
/// parts: the part of each tetrahedron, from 0, of shape (m,), where there are several.
///
/// Raises BodyError for a mesh, a density or parts that make no body.
#[pyclass(frozen, module = "piola")]
pub(crate) struct Body {
    pub(crate) body: system::Body,
    /// Memory that evaluations reuse.
    memory: Mutex<Memory>,
    /// The index in `tets` of each element, which are sorted by part.
    order: Vec<usize>,
}

/// Row, column and entries of the blocks of a matrix.
type Blocks<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyAny>);

struct Memory {
    response: ElasticResponse,
    stiffness: Option<NodalStiffness>,
}

impl Body {
    fn memory(&self) -> MutexGuard<'_, Memory> {
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Evaluates something, on threads, without the interpreter; complains of tetrahedra outside of the
    /// domain.
    fn evaluate<T: Send>(
        &self,
        py: Python<'_>,
        compute: impl FnOnce(&system::Body, &mut Memory) -> Result<(T, Survey), LengthError> + Send,
    ) -> PyResult<T> {
        let evaluated = py.detach(|| {
            // Locked before the pool is entered: a thread of it that waits may take up another call
            // meanwhile.
            let memory = &mut *self.memory();
            on_threads(|| compute(&self.body, memory))
        })?;
        let (value, survey) = evaluated.map_err(of_body)?;
        let Some(first) = survey.first else { return Ok(value) };
        let Survey { refused, nonfinite, .. } = survey;
        let tet = self.order[first];
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
        py: Python<'_>,
        points: &Bound<'_, PyAny>,
        tets: &Bound<'_, PyAny>,
        material: &Bound<'_, PyAny>,
        density: &Bound<'_, PyAny>,
        parts: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let mut mesh = TetMesh::new(rows(py, "points", points)?, indices(py, "tets", tets)?);
        // Messages count tetrahedra from 0.
        mesh.tags = (0..mesh.tets.len()).collect();
        let (materials, densities) = (materials(material)?, numbers(py, "density", density)?);
        if materials.len() != densities.len() {
            let (materials, densities) = (materials.len(), densities.len());
            return Err(BodyError::new_err(format!(
                "there are {materials} materials and {densities} densities"
            )));
        }
        let part_of: Option<Vec<[usize; 1]>> = parts.map(|parts| indices(py, "parts", parts)).transpose()?;
        match &part_of {
            None if materials.len() != 1 => {
                return Err(BodyError::new_err(
                    "several materials need `parts`, which says where each of them is",
                ));
            }
            Some(part_of) if part_of.len() != mesh.tets.len() => {
                let (parts, tets) = (part_of.len(), mesh.tets.len());
                return Err(BodyError::new_err(format!(
                    "parts has {parts} entries; it must have one for each of {tets}"
                )));
            }
            _ => {}
        }
        let tets_of = |part: usize| match &part_of {
            None => (0..mesh.tets.len()).collect::<Vec<_>>(),
            Some(part_of) => (0..mesh.tets.len()).filter(|&tet| part_of[tet][0] == part).collect(),
        };
        let groups: Vec<_> = (0..materials.len())
            .map(|part| Group {
                name: part.to_string(),
                dimension: 3,
                tets: tets_of(part),
                ..Group::default()
            })
            .collect();
        let order = groups.iter().flat_map(|group| group.tets.iter().copied()).collect();
        mesh.groups = groups;
        let part = |(part, (material, density)): (usize, (&Py<Material>, f64))| {
            let material = material.get().elements()?;
            Ok(Part { group: Some(part.to_string()), material, density })
        };
        let parts: Vec<_> = materials.iter().zip(densities).enumerate().map(part).collect::<PyResult<_>>()?;
        let body = system::Body::from_parts(&mesh, parts).map_err(of_body)?;
        let memory = Mutex::new(Memory { response: ElasticResponse::new(&body), stiffness: None });
        Ok(Self { body, memory, order })
    }

    /// Rest positions of the nodes, m, of shape (n, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_rows(py, self.body.rest())
    }

    /// Lumped masses of the nodes, kg, of shape (n,).
    #[getter]
    fn masses<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.body.masses().to_vec().into_pyarray(py)
    }

    /// Energy of deformation, J, with the nodes at these positions, m, of shape (n, 3).
    ///
    /// Raises DomainError if a tetrahedron is outside the domain of its material, as the next two do.
    #[pyo3(signature = (positions, /))]
    fn energy(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<f64> {
        let x = rows(py, "positions", positions)?;
        self.evaluate(py, |body, memory| memory.response.energy(body, &x))
    }

    /// Gradient of the energy in the positions, N, of shape (n, 3): minus the forces.
    #[pyo3(signature = (positions, /))]
    fn gradient<'py>(&self, py: Python<'py>, positions: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let x = rows(py, "positions", positions)?;
        let mut gradient = vec![[0.0; 3]; self.body.rest().len()];
        self.evaluate(py, |body, memory| Ok(((), memory.response.gradient(body, &x, &mut gradient)?)))?;
        from_rows(py, &gradient)
    }

    /// Stiffness, N/m, in blocks of 3x3: (rows, columns, blocks), of shapes (b,), (b,) and (b, 3, 3).
    ///
    ///     stiffness(positions, /, *, filter=None)
    ///
    /// Block k holds the second derivatives of the energy by the positions of node rows[k] and node
    /// columns[k]; each pair of nodes occurs once in both orders, and always at the same place. With
    /// `i = 3*rows[:, None, None] + numpy.arange(3)[:, None]` and likewise j, `scipy.sparse.csr_array` takes
    /// `(blocks.ravel(), (i, j))`.
    ///
    /// filter: as of `Material.tangent`, for each tetrahedron.
    #[pyo3(signature = (positions, /, *, filter = None))]
    fn stiffness<'py>(
        &self,
        py: Python<'py>,
        positions: &Bound<'py, PyAny>,
        filter: Option<&str>,
    ) -> PyResult<Blocks<'py>> {
        let x = rows(py, "positions", positions)?;
        let filter: Filter = self::filter(filter)?;
        let mut gradient = vec![[0.0; 3]; self.body.rest().len()];
        if self.memory().stiffness.is_none() {
            self.memory().stiffness = Some(NodalStiffness::of_body(&self.body).map_err(of_body)?);
        }
        let (places, blocks) = self.evaluate(py, |body, memory| {
            let Memory { response, stiffness } = memory;
            let mut survey = response.energy(body, &x)?.1;
            let (mut places, mut blocks) = (Vec::new(), Vec::new());
            if let Some(matrix) = stiffness {
                survey = response.stiffness_here(body, filter, &mut gradient, matrix)?;
                for (row, column, block) in matrix.blocks() {
                    places.push([row as i64, column as i64]);
                    blocks.push(*block);
                    if row != column {
                        places.push([column as i64, row as i64]);
                        blocks.push(std::array::from_fn(|i| std::array::from_fn(|j| block[j][i])));
                    }
                }
            }
            Ok(((places, blocks), survey))
        })?;
        let [row, column] =
            [0, 1].map(|k| places.iter().map(|place| place[k]).collect::<Vec<_>>().into_pyarray(py));
        let count = blocks.len();
        let flat: Vec<f64> = blocks.into_iter().flat_map(|block: [[f64; 3]; 3]| block.concat()).collect();
        Ok((row, column, flat.into_pyarray(py).reshape([count, 3, 3])?.into_any()))
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
/// cells: their numbers along the three axes.
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
    let tets: Vec<[i64; 4]> = mesh.tets.iter().map(|tet| tet.map(|node| node as i64)).collect();
    Ok((from_rows(py, &mesh.positions)?, from_rows(py, &tets)?))
}
