//! The kernels of a batch, and the numbers that they read and write.

#![expect(non_snake_case, reason = "F, X as below")]

use piola::point::{Filter, Matrix3};

use piola::__private::random::Random;

/// A method of [`Batch`](piola::batch::Batch) to be timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// ψ.
    Energies,
    /// P.
    Stresses,
    /// P and 81 entries of dP/dF.
    Tangents,
    /// Gradients and stiffnesses of elements, 144 entries.
    Stiffnesses,
    /// Gradients and stiffnesses of elements, 144 entries, from the positions of their nodes.
    StiffnessesAt,
}

impl Task {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Energies, Self::Stresses, Self::Tangents, Self::Stiffnesses, Self::StiffnessesAt];

    /// Name of the method, and the numbers that it writes at each point.
    pub(super) fn signature(self) -> (&'static str, [usize; 2]) {
        match self {
            Self::Energies => ("energies", [1, 0]),
            Self::Stresses => ("stresses", [9, 0]),
            Self::Tangents => ("tangents", [9, 81]),
            Self::Stiffnesses => ("stiffnesses", [12, 144]),
            Self::StiffnessesAt => ("stiffnesses_at", [12, 144]),
        }
    }

    /// The name of the method.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.signature().0
    }

    /// The filters that make a difference to it.
    #[must_use]
    pub fn filters(self) -> &'static [Filter] {
        match self {
            Self::Energies | Self::Stresses => &[Filter::None],
            _ => &[Filter::None, Filter::Clamp],
        }
    }

    /// Dm⁻¹ and a volume: Dm⁻¹ drawn like F or, where nodes are given, that with which [`CORNERS`] have a
    /// deformation gradient like the others.
    pub(super) fn rest_shape(self, random: &mut Random) -> Vec<f64> {
        let F = deformation(random);
        // Ds⁻¹ of the edges between `CORNERS`.
        let inverse = |i: usize, j: usize| if i == j { 0.25 } else { -0.25 };
        let entry = |k: usize| match self {
            Self::StiffnessesAt => (0..3).map(|m| inverse(k / 3, m) * F[m][k % 3]).sum::<f64>(),
            _ => F[k / 3][k % 3],
        };
        (0..9).map(entry).chain([random.uniform(0.5, 1.5)]).collect()
    }
}

/// The corners of every tetrahedron whose nodes are given.
pub(super) const CORNERS: [[f64; 3]; 4] =
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];

/// The deformation gradients of [`Arrays`](crate::Arrays), without end.
pub fn deformation_gradients() -> impl Iterator<Item = Matrix3<f64>> {
    let mut random = Random::new(1);
    std::iter::repeat_with(move || deformation(&mut random))
}

/// F = I + 0.3 X with entries of X uniform in [−1, 1) and det F > 0, so that every energy is defined.
pub(super) fn deformation(random: &mut Random) -> Matrix3<f64> {
    loop {
        let X = random.matrix();
        let F: Matrix3<f64> = [0, 1, 2].map(|i| [0, 1, 2].map(|j| f64::from(i == j) + 0.3 * X[i][j]));
        let [a, b, c] = F;
        let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        if determinant > 0.0 {
            return F;
        }
    }
}
