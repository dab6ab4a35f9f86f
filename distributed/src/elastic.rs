//! Energy, forces and stiffness of the elements of a rank, evaluated by piola's kernels.
//!
//! The elements are a body of piola, whose nodes are the owned nodes and the copies. This module does not
//! depend on time or on a solver.

use piola::point::Filter;
use piola_bodies::mesh::{Group, TetMesh};
use piola_bodies::step::EnergyChange;
use piola_bodies::system::{Body, ElasticResponse, NodalStiffness, Part};
use piola_scenes::material::MaterialSpec;

use crate::error::Error;
use crate::petsc::{GhostedVector, PetscError};
use crate::share::Share;

/// Material and density of the elements of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialPart {
    /// The material.
    pub material: MaterialSpec,
    /// Mass per rest volume, kg/m³.
    pub density: f64,
}

/// Elements of a rank, with their energy, gradient and stiffness.
pub struct Elastic {
    piece: Option<Piece>,
    /// Gradient at all nodes of the rank, N.
    gradient: Vec<[f64; 3]>,
    /// Sum over the elements of stiffness times length, N/m, for the regularisation of statics.
    stiffness: f64,
    filtered: usize,
    bounded: usize,
}

/// Elements as a body of piola, with the nodes of the share.
struct Piece {
    body: Body,
    response: ElasticResponse,
    energy: f64,
    /// Tag of the first element without an energy, gradient or tangent in the last evaluation.
    refused: Option<usize>,
}

impl Elastic {
    /// Elements of a share.
    ///
    /// # Errors
    /// [`Error::Body`] for an invalid element, such as an inverted one; [`Error::Scene`] for a material.
    pub fn new(share: &Share, parts: &[MaterialPart]) -> Result<Self, Error> {
        let mut stiffness = 0.0;
        let piece = match share.elements.is_empty() {
            true => None,
            false => Some(Piece::new(share, parts, &mut stiffness)?),
        };
        Ok(Self { piece, gradient: vec![[0.0; 3]; share.ids.len()], stiffness, filtered: 0, bounded: 0 })
    }

    /// Stiffness matrix of zeros, for these elements.
    ///
    /// # Errors
    /// [`Error::Linear`].
    pub fn nodal_stiffness(&self) -> Result<NodalStiffness, Error> {
        Ok(match &self.piece {
            Some(piece) => NodalStiffness::of_body(&piece.body)?,
            None => NodalStiffness::empty()?,
        })
    }

    /// Adds the masses of the elements to the masses of all nodes of the rank, kg.
    pub fn add_masses(&self, masses: &mut [f64]) {
        if let Some(piece) = &self.piece {
            masses.iter_mut().zip(piece.body.masses()).for_each(|(total, mass)| *total += mass);
        }
    }

    /// Sum over the elements of stiffness times length, N/m.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Evaluates the energies of the elements.
    pub fn evaluate(&mut self, positions: &[[f64; 3]]) {
        if let Some(Piece { body, response, energy, refused }) = &mut self.piece {
            // The slices have the lengths with which the body was made.
            if let Ok((found, survey)) = response.energy(body, positions) {
                *energy = found;
                *refused = survey.first.map(|element| body.elements()[element].tag);
            }
        }
    }

    /// Smallest tag of an element of this rank without an energy, gradient or tangent in the last evaluation.
    #[must_use]
    pub fn refused(&self) -> Option<usize> {
        self.piece.as_ref()?.refused
    }

    /// Energy of the elements of this rank, J.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.piece.as_ref().map_or(0.0, |piece| piece.energy)
    }

    /// Number of elements of this rank with a filtered tangent in the last evaluation.
    #[must_use]
    pub fn filtered(&self) -> usize {
        self.filtered
    }

    /// Number of elements of this rank with a tangent at a pole in the last evaluation.
    #[must_use]
    pub fn bounded(&self) -> usize {
        self.bounded
    }

    /// Makes the last evaluated energies the base of differences.
    pub fn set_base(&mut self) {
        self.piece.iter_mut().for_each(|piece| piece.response.set_base());
    }

    /// Energy of the elements of this rank minus their energy at the base, J.
    #[must_use]
    pub fn change(&self) -> EnergyChange {
        let mut sum = EnergyChange::default();
        if let Some(Piece { response, body, .. }) = &self.piece {
            sum.difference += response.difference();
            sum.noise += response.difference_noise(body).unwrap_or(f64::INFINITY);
        }
        sum
    }

    /// Replaces `gradient`, N, at the owned nodes by the gradient of the elements of all ranks, at the last
    /// evaluated positions.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn gradient(
        &mut self,
        exchange: &mut GhostedVector,
        gradient: &mut [[f64; 3]],
    ) -> Result<(), PetscError> {
        if let Some(Piece { response, body, .. }) = &mut self.piece {
            let _ = response.gradient_here(body, &mut self.gradient);
        }
        self.sum(exchange, gradient)
    }

    /// Replaces `gradient` as [`Elastic::gradient`] does, and `stiffness`, a result of
    /// [`Elastic::nodal_stiffness`], by the filtered stiffness of this rank's elements.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn linearise(
        &mut self,
        filter: Filter,
        stiffness: &mut NodalStiffness,
        exchange: &mut GhostedVector,
        gradient: &mut [[f64; 3]],
    ) -> Result<(), PetscError> {
        if let Some(Piece { response, body, refused, .. }) = &mut self.piece
            && let Ok(survey) = response.stiffness_here(body, filter, &mut self.gradient, stiffness)
        {
            (self.filtered, self.bounded) = (survey.filtered, survey.bounded);
            *refused = survey.first.map(|element| body.elements()[element].tag);
        }
        self.sum(exchange, gradient)
    }

    fn sum(&mut self, exchange: &mut GhostedVector, total: &mut [[f64; 3]]) -> Result<(), PetscError> {
        exchange.sum(self.gradient.as_flattened_mut())?;
        total.copy_from_slice(&self.gradient[..total.len()]);
        Ok(())
    }
}

impl Piece {
    fn new(share: &Share, parts: &[MaterialPart], total_stiffness: &mut f64) -> Result<Self, Error> {
        let Share { elements, places, .. } = share;
        let mut mesh = TetMesh::new(
            places.iter().map(|place| place.rest).collect(),
            elements.iter().map(|&(nodes, ..)| nodes).collect(),
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
            let material = part.material.build()?.elements;
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
        Ok(Self { response: ElasticResponse::new(&body), body, energy: 0.0, refused: None })
    }
}
