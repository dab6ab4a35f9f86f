//! Integrators in time: how a step is made of minimisations.
//!
//! With x′ = v and M v′ = f(x, v), a diagonally implicit Runge–Kutta method of s stages has coefficients aij,
//! j ≤ i, equal ones aii = γ on the diagonal, and
//!
//! ```text
//! xi = x̂i + γ h vi        x̂i = xₙ + h Σ aij vj        (j < i)
//! vi = v̂i + γ h ai        v̂i = vₙ + h Σ aij aj        M ai = f(xi, vi)
//! ```
//!
//! Stage i is therefore a step of implicit Euler of length γ h from x̂i, v̂i, and as much work. The methods
//! here are stiffly accurate: the last stage is the state after the step, so that a collapsed or stiff
//! body ends where its own equation holds. They are L-stable, as implicit Euler is.
//!
//! Pinned nodes and targets of springs move evenly through the step: stage i has them at the share ci = Σ aij
//! of their way.
//!
//! \[Alexander77\] Alexander, *Diagonally implicit Runge–Kutta methods for stiff O.D.E.'s*, 1977.

use super::objective::Spring;

/// Integrator of a [`Simulation`](super::Simulation).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Integrator {
    /// Implicit Euler: first order. Calms a body down, the more so the longer its steps.
    #[default]
    ImplicitEuler,
    /// Two stages \[Alexander77\]: second order. A step costs a little more than two of implicit Euler
    /// (`cargo speed-report --only steps`).
    Sdirk2,
    /// Three stages \[Alexander77\]: third order, for smooth motions and small errors.
    Sdirk3,
}

/// Coefficients of a method.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tableau {
    /// γ.
    pub(super) diagonal: f64,
    /// aij of each stage but the last, for j < i.
    pub(super) before: &'static [&'static [f64]],
    /// asj of the last stage, for j < s.
    pub(super) last: &'static [f64],
}

impl Integrator {
    pub(super) fn tableau(self) -> Tableau {
        match self {
            Self::ImplicitEuler => Tableau { diagonal: 1.0, before: &[], last: &[] },
            Self::Sdirk2 => Tableau { diagonal: GAMMA_2, before: &[&[]], last: &[1.0 - GAMMA_2] },
            Self::Sdirk3 => {
                const FIRST: f64 = -0.25 * ((6.0 * GAMMA_3 - 16.0) * GAMMA_3 + 1.0);
                const SECOND: f64 = 0.25 * ((6.0 * GAMMA_3 - 20.0) * GAMMA_3 + 5.0);
                let before: &[&[f64]] = &[&[], &[0.5 * (1.0 - GAMMA_3)]];
                Tableau { diagonal: GAMMA_3, before, last: &[FIRST, SECOND] }
            }
        }
    }
}

/// 1 − 1/√2.
const GAMMA_2: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// The root of γ³ − 3 γ² + 3/2 γ − 1/6 between 1/6 and 1/2.
const GAMMA_3: f64 = 0.435_866_521_508_459;

/// The stages of a step that come before the last, and where the next one starts.
#[derive(Clone, Debug)]
pub(super) struct Stages {
    /// x̂, m, and v̂, m/s.
    pub(super) start: Vec<[f64; 3]>,
    pub(super) velocities: Vec<[f64; 3]>,
    /// Springs with their targets at the end of the stage.
    pub(super) springs: Vec<Spring>,
    /// v, m/s, and a, m/s², of each stage done.
    done: Vec<[Vec<[f64; 3]>; 2]>,
}

impl Stages {
    /// Memory for the stages of an integrator.
    pub(super) fn new(integrator: Integrator, nodes: usize) -> Self {
        let before = integrator.tableau().before.len();
        let nodes = if before == 0 { 0 } else { nodes };
        let zero = || vec![[0.0; 3]; nodes];
        let done = (0..before).map(|_| [zero(), zero()]).collect();
        Self { start: zero(), velocities: zero(), springs: Vec::new(), done }
    }

    /// Sets x̂ and v̂ for a stage.
    pub(super) fn begin(
        &mut self,
        coefficients: &[f64],
        dt: f64,
        positions: &[[f64; 3]],
        velocities: &[[f64; 3]],
    ) {
        self.start.copy_from_slice(positions);
        self.velocities.copy_from_slice(velocities);
        for (coefficient, [v, a]) in coefficients.iter().zip(&self.done) {
            add(&mut self.start, dt * coefficient, v);
            add(&mut self.velocities, dt * coefficient, a);
        }
    }

    /// Sets the springs for the end of a stage, whose targets have gone this share of their way.
    pub(super) fn pull(&mut self, springs: &[Spring], targets_before: &[[f64; 3]], share: f64) {
        let at_share = |(&spring, before): (&Spring, &[f64; 3])| {
            let way = |c: usize| before[c] + share * (spring.target[c] - before[c]);
            Spring { target: std::array::from_fn(way), ..spring }
        };
        self.springs.clear();
        self.springs.extend(springs.iter().zip(targets_before).map(at_share));
    }

    /// Notes that a stage of length γ h has ended at `positions`.
    pub(super) fn end(&mut self, stage: usize, length: f64, positions: &[[f64; 3]]) {
        let [v, a] = &mut self.done[stage];
        for node in 0..positions.len() {
            for c in 0..3 {
                v[node][c] = (positions[node][c] - self.start[node][c]) / length;
                a[node][c] = (v[node][c] - self.velocities[node][c]) / length;
            }
        }
    }
}

fn add(sum: &mut [[f64; 3]], factor: f64, x: &[[f64; 3]]) {
    for (sum, x) in sum.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
        *sum += factor * x;
    }
}

#[cfg(test)]
mod tests;
