//! Time integrators, each as one or several minimisations for each step.
//!
//! Every method here is made of stages, and each stage finds positions x from its start s, w and its length
//! τ:
//!
//! ```text
//! v = (x − s)/τ        a = (v − w)/τ        M a = f(x, v)
//! ```
//!
//! which is the minimisation that [`super::objective`] describes; for implicit Euler s, w are the state
//! before the step and τ = h.
//!
//! **Runge–Kutta methods** have coefficients aij, j ≤ i, with equal ones aii = γ on the diagonal:
//!
//! ```text
//! s = xₙ + h Σ aij vj        w = vₙ + h Σ aij aj        (j < i)        τ = γ h
//! ```
//!
//! Those of Alexander are stiffly accurate: the last stage is the state after the step, so that a collapsed
//! or stiff body ends where its own equation holds. They are L-stable, as implicit Euler is.
//!
//! **Prescribed motion.** Pinned nodes and targets of springs move evenly through the step: a stage has them
//! at its share of their way, Σ aij.
//!
//! \[Alexander77\] Alexander, *Diagonally implicit Runge–Kutta methods for stiff O.D.E.'s*, 1977.

/// Integrator of a [`Simulation`](super::Simulation).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Integrator {
    /// Implicit Euler: first order. Numerical damping, stronger for longer steps.
    #[default]
    ImplicitEuler,
    /// SDIRK method with two stages \[Alexander77\]: second order. A step costs a little more than two of
    /// implicit Euler (`cargo speed-report --only steps`).
    Sdirk2,
    /// SDIRK method with three stages \[Alexander77\]: third order, for smooth motions and small errors.
    Sdirk3,
}

/// Coefficients of a Runge–Kutta method whose last stage is the state after the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Method {
    /// γ.
    pub(super) diagonal: f64,
    /// aij of each stage, for j < i.
    pub(super) rows: &'static [&'static [f64]],
}

impl Integrator {
    pub(super) fn method(self) -> Method {
        match self {
            Self::ImplicitEuler => Method { diagonal: 1.0, rows: &[&[]] },
            Self::Sdirk2 => Method { diagonal: GAMMA_2, rows: &[&[], &[1.0 - GAMMA_2]] },
            Self::Sdirk3 => {
                const FIRST: f64 = -0.25 * ((6.0 * GAMMA_3 - 16.0) * GAMMA_3 + 1.0);
                const SECOND: f64 = 0.25 * ((6.0 * GAMMA_3 - 20.0) * GAMMA_3 + 5.0);
                Method { diagonal: GAMMA_3, rows: &[&[], &[0.5 * (1.0 - GAMMA_3)], &[FIRST, SECOND]] }
            }
        }
    }

    /// Order of the integrator: the power of the step's length with which errors of smooth motions fall. The
    /// methods have as many stages.
    pub(super) fn order(self) -> usize {
        self.method().rows.len()
    }
}

impl Method {
    /// Share of the motion of pinned nodes that is done in a stage.
    pub(super) fn share(&self, stage: usize) -> f64 {
        if stage + 1 == self.rows.len() { 1.0 } else { self.rows[stage].iter().sum::<f64>() + self.diagonal }
    }
}

/// 1 − 1/√2.
const GAMMA_2: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// The root of γ³ − 3 γ² + 3/2 γ − 1/6 between 1/6 and 1/2.
const GAMMA_3: f64 = 0.435_866_521_508_459;

/// The state from which a step starts: positions, m, velocities, m/s, and accelerations, m/s², of all nodes.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) x: Vec<[f64; 3]>,
    pub(super) v: Vec<[f64; 3]>,
    pub(super) a: Vec<[f64; 3]>,
}

impl State {
    pub(super) fn at_rest(positions: &[[f64; 3]]) -> Self {
        let zero = || vec![[0.0; 3]; positions.len()];
        Self { x: positions.to_vec(), v: zero(), a: zero() }
    }
}

/// Stage of a step: velocities v = (x − s)/τ and accelerations a = (v − w)/τ from positions x.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    /// s, m.
    pub(crate) start: Vec<[f64; 3]>,
    /// w, m/s.
    pub(crate) velocities: Vec<[f64; 3]>,
    /// τ, s.
    pub(crate) length: f64,
    /// Accelerations in the stage before or, of the first one, at the end of the step before, m/s²; zero
    /// where there was none.
    pub(crate) accelerations: Vec<[f64; 3]>,
    /// True if the leading error of steps is in changes of the accelerations, not in the accelerations.
    pub(super) is_second_order: bool,
}

impl Stage {
    /// Statics: no velocities and no accelerations, at any positions.
    pub(super) fn at_rest(nodes: usize) -> Self {
        let zero = || vec![[0.0; 3]; nodes];
        Self {
            start: zero(),
            velocities: zero(),
            length: f64::INFINITY,
            accelerations: zero(),
            is_second_order: false,
        }
    }

    /// Velocity, m/s, and acceleration, m/s², of a node that is at `x`, m.
    pub(super) fn motion(&self, node: usize, x: [f64; 3]) -> [[f64; 3]; 2] {
        let v: [f64; 3] = std::array::from_fn(|c| (x[c] - self.start[node][c]) / self.length);
        [v, std::array::from_fn(|c| (v[c] - self.velocities[node][c]) / self.length)]
    }

    /// Scale of the error in time of the step with its nodes at `x`, m: the largest τ² |a|, or for methods of
    /// higher order τ² times the change of a.
    pub(super) fn error_scale(&self, x: &[[f64; 3]]) -> f64 {
        let before = if self.is_second_order { 1.0 } else { 0.0 };
        let size = |node: usize| {
            let [_, a] = self.motion(node, x[node]);
            let change = |c: usize| a[c] - before * self.accelerations[node][c];
            (0..3).map(|c| change(c).powi(2)).sum::<f64>()
        };
        self.length * self.length * (0..x.len()).map(size).fold(0.0, f64::max).sqrt()
    }
}

#[cfg(test)]
mod tests;
