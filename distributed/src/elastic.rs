//! Energy, forces and stiffness of the elements of a rank, evaluated by piola's kernels.
//!
//! The elements are two bodies of piola: those at the border, which touch nodes of other ranks, and those
//! inside, which are evaluated while copies and sums of the border's nodes are under way. This module knows
//! no time and no solver.

use std::sync::Arc;

use piola::mesh::{Group, TetMesh};
use piola::point::Filter;
use piola::step::EnergyChange;
use piola::system::{Body, ElasticResponse, NodalStiffness, Part};
use piola_scenes::material::MaterialSpec;

use crate::error::Error;
use crate::petsc::{GhostedVector, PetscError};
use crate::share::Share;
use crate::varied::Varied;

/// Material and density, kg/m³, of the elements of a number.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialPart {
    /// The material.
    pub material: MaterialSpec,
    /// Parameters of each element by itself, in place of the material's.
    pub varied: Option<Arc<Varied>>,
    /// Mass per rest volume, kg/m³.
    pub density: f64,
}

/// The elements of a rank.
pub struct Elastic {
    border: Option<Piece>,
    inner: Option<Piece>,
    /// Gradients of all nodes of the rank, N, from the elements at the border.
    outgoing: Vec<[f64; 3]>,
    /// Sum over the elements of stiffness times length, N/m, as regularisation of statics has it.
    stiffness: f64,
    filtered: usize,
    bounded: usize,
}

/// Some elements, as a body of piola.
struct Piece {
    body: Body,
    response: ElasticResponse,
    /// Node of the share for each node of the body.
    nodes: Vec<usize>,
    positions: Vec<[f64; 3]>,
    gradient: Vec<[f64; 3]>,
    stiffness: NodalStiffness,
    energy: f64,
    /// Tag of the first element that has no energy, gradient or tangent where one was evaluated last.
    refused: Option<usize>,
}

impl Elastic {
    /// The elements of a share.
    ///
    /// # Errors
    /// [`Error::Body`] for an element that is none, such as an inverted one, [`Error::Scene`] for a material,
    /// [`Error::Linear`].
    pub fn new(share: &Share, parts: &[MaterialPart]) -> Result<Self, Error> {
        let is_inner = |nodes: &[usize; 4]| nodes.iter().all(|&node| node < share.owned);
        let mut stiffness = 0.0;
        let mut piece = |inner: bool| {
            let elements: Vec<_> =
                share.elements.iter().filter(|(nodes, ..)| is_inner(nodes) == inner).copied().collect();
            Piece::new(share, &elements, parts, &mut stiffness)
        };
        let (border, inner) = (piece(false)?, piece(true)?);
        Ok(Self {
            border,
            inner,
            outgoing: vec![[0.0; 3]; share.ids.len()],
            stiffness,
            filtered: 0,
            bounded: 0,
        })
    }

    fn pieces(&self) -> impl Iterator<Item = &Piece> {
        self.border.iter().chain(&self.inner)
    }

    fn pieces_mut(&mut self) -> impl Iterator<Item = &mut Piece> {
        self.border.iter_mut().chain(&mut self.inner)
    }

    /// Adds what the elements weigh to the masses of all nodes of the rank, kg.
    pub fn add_masses(&self, masses: &mut [f64]) {
        for piece in self.pieces() {
            piece.nodes.iter().zip(piece.body.masses()).for_each(|(&node, mass)| masses[node] += mass);
        }
    }

    /// Sum over the elements of stiffness times length, N/m.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Evaluates the energies of the elements that touch no node of another rank.
    pub fn evaluate_inner(&mut self, positions: &[[f64; 3]]) {
        self.inner.iter_mut().for_each(|piece| piece.evaluate(positions));
    }

    /// Evaluates the energies of the other elements.
    pub fn evaluate_border(&mut self, positions: &[[f64; 3]]) {
        self.border.iter_mut().for_each(|piece| piece.evaluate(positions));
    }

    /// The smallest tag of an element of this rank that has no energy, gradient or tangent where one was
    /// evaluated last.
    #[must_use]
    pub fn refused(&self) -> Option<usize> {
        self.pieces().filter_map(|piece| piece.refused).min()
    }

    /// Energy on this rank, J.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.pieces().map(|piece| piece.energy).sum()
    }

    /// Number of elements of this rank whose tangent was filtered last.
    #[must_use]
    pub fn filtered(&self) -> usize {
        self.filtered
    }

    /// Number of elements of this rank whose tangent was at a pole last.
    #[must_use]
    pub fn bounded(&self) -> usize {
        self.bounded
    }

    /// Makes the energies evaluated last those that differences are taken from.
    pub fn set_base(&mut self) {
        self.pieces_mut().for_each(|piece| piece.response.set_base());
    }

    /// Energy on this rank minus that of the base, J.
    #[must_use]
    pub fn change(&self) -> EnergyChange {
        let mut sum = EnergyChange::default();
        for Piece { response, body, .. } in self.pieces() {
            sum.difference += response.difference();
            sum.noise += response.difference_noise(body).unwrap_or(f64::INFINITY);
        }
        sum
    }

    /// Replaces `gradient`, N, of the owned nodes by that of all ranks' elements where these were evaluated
    /// last.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn gradient(
        &mut self,
        exchange: &mut GhostedVector,
        gradient: &mut [[f64; 3]],
    ) -> Result<(), PetscError> {
        self.sum(exchange, gradient, |piece| {
            let Piece { response, body, gradient, .. } = piece;
            let _ = response.gradient_here(body, gradient);
        })
    }

    /// Replaces `gradient` as [`Elastic::gradient`] does, and takes the filtered stiffness of this rank's
    /// elements.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn linearise(
        &mut self,
        filter: Filter,
        exchange: &mut GhostedVector,
        gradient: &mut [[f64; 3]],
    ) -> Result<(), PetscError> {
        let (mut filtered, mut bounded) = (0, 0);
        self.sum(exchange, gradient, |piece| {
            let Piece { response, body, gradient, stiffness, refused, .. } = piece;
            if let Ok(survey) = response.stiffness_here(body, filter, gradient, stiffness) {
                filtered += survey.filtered;
                bounded += survey.bounded;
                *refused = survey.first.map(|element| body.elements()[element].tag);
            }
        })?;
        (self.filtered, self.bounded) = (filtered, bounded);
        Ok(())
    }

    /// Evaluates the border, begins to send its part, evaluates the elements inside, and adds up.
    fn sum(
        &mut self,
        exchange: &mut GhostedVector,
        total: &mut [[f64; 3]],
        mut evaluate: impl FnMut(&mut Piece),
    ) -> Result<(), PetscError> {
        self.outgoing.fill([0.0; 3]);
        if let Some(piece) = &mut self.border {
            evaluate(piece);
            piece.add_to(&mut self.outgoing);
        }
        exchange.begin_sum(&self.outgoing)?;
        if let Some(piece) = &mut self.inner {
            evaluate(piece);
        }
        exchange.end_sum(total)?;
        if let Some(piece) = &self.inner {
            piece.add_to(total);
        }
        Ok(())
    }

    /// Adds the product of the stiffness taken last with a displacement of each node of the rank, m, to
    /// `total`, N.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn add_product(
        &mut self,
        exchange: &mut GhostedVector,
        displacement: &[[f64; 3]],
        total: &mut [[f64; 3]],
    ) -> Result<(), PetscError> {
        let mut product = vec![[0.0; 3]; self.outgoing.len()];
        self.blocks(|row, column, entries| {
            for r in 0..3 {
                for c in 0..3 {
                    product[row][r] += entries[r][c] * displacement[column][c];
                    if row != column {
                        product[column][c] += entries[r][c] * displacement[row][r];
                    }
                }
            }
        });
        exchange.begin_sum(&product)?;
        let mut sum = vec![[0.0; 3]; total.len()];
        exchange.end_sum(&mut sum)?;
        for (total, sum) in total.as_flattened_mut().iter_mut().zip(sum.as_flattened()) {
            *total += sum;
        }
        Ok(())
    }

    /// Visits the blocks of the stiffness taken last, by nodes of the share, in an order that does not
    /// change. Of two different nodes of a piece there is one block, of which the other is the transpose.
    pub fn blocks(&self, mut visit: impl FnMut(usize, usize, &[[f64; 3]; 3])) {
        for Piece { stiffness, nodes, .. } in self.pieces() {
            for (row, column, entries) in stiffness.blocks() {
                visit(nodes[row], nodes[column], entries);
            }
        }
    }
}

impl Piece {
    fn new(
        share: &Share,
        elements: &[([usize; 4], u64, u64)],
        parts: &[MaterialPart],
        total_stiffness: &mut f64,
    ) -> Result<Option<Self>, Error> {
        if elements.is_empty() {
            return Ok(None);
        }
        let mut nodes: Vec<usize> = elements.iter().flat_map(|(nodes, ..)| *nodes).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut index = vec![usize::MAX; share.ids.len()];
        nodes.iter().enumerate().for_each(|(here, &node)| index[node] = here);
        let mut mesh = TetMesh::new(
            nodes.iter().map(|&node| share.places[node].rest).collect(),
            elements.iter().map(|(nodes, ..)| nodes.map(|node| index[node])).collect(),
        );
        mesh.tags = elements.iter().map(|&(_, tag, _)| tag as usize).collect();

        let mut in_body = Vec::new();
        let mut stiffnesses = Vec::new();
        for (number, part) in parts.iter().enumerate() {
            let tets: Vec<usize> =
                (0..elements.len()).filter(|&tet| elements[tet].2 == number as u64).collect();
            if tets.is_empty() {
                continue;
            }
            let material = match &part.varied {
                None => part.material.build()?.elements,
                Some(varied) => varied.elements(&part.material, tets.iter().map(|&tet| elements[tet].1))?,
            };
            stiffnesses.push((material.rest_stiffness().abs(), tets.len()));
            let name = number.to_string();
            mesh.groups.push(Group { name: name.clone(), dimension: 3, nodes: Vec::new(), tets });
            in_body.push(Part { group: Some(name), material, density: part.density });
        }
        let body = Body::from_parts(&mesh, in_body)?;
        let mut of_part = body.elements().iter();
        for (stiffness, count) in stiffnesses {
            let lengths = of_part.by_ref().take(count).map(|element| element.shape.volume.cbrt());
            *total_stiffness += stiffness * lengths.sum::<f64>();
        }
        let count = nodes.len();
        Ok(Some(Self {
            response: ElasticResponse::new(&body),
            stiffness: NodalStiffness::of_body(&body)?,
            body,
            nodes,
            positions: vec![[0.0; 3]; count],
            gradient: vec![[0.0; 3]; count],
            energy: 0.0,
            refused: None,
        }))
    }

    fn evaluate(&mut self, positions: &[[f64; 3]]) {
        for (here, &node) in self.positions.iter_mut().zip(&self.nodes) {
            *here = positions[node];
        }
        // Lengths are those that both were made with.
        if let Ok((energy, survey)) = self.response.energy(&self.body, &self.positions) {
            self.energy = energy;
            self.refused = survey.first.map(|element| self.body.elements()[element].tag);
        }
    }

    fn add_to(&self, total: &mut [[f64; 3]]) {
        for (&node, gradient) in self.nodes.iter().zip(&self.gradient) {
            for c in 0..3 {
                total[node][c] += gradient[c];
            }
        }
    }
}
