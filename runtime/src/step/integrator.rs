//! Integrators in time: how a step is made of minimisations.
//!
//! Every method here is made of stages, and each stage finds positions x from its start s, w and two lengths
//! τ, σ:
//!
//! ```text
//! v = (x − s)/τ        a = (v − w)/σ        M a = f(x, v)
//! ```
//!
//! which is the minimisation that [`super::objective`] describes; for implicit Euler s, w are the state
//! before the step and τ = σ = h.
//!
//! **Runge–Kutta methods** have coefficients aij, j ≤ i, with equal ones aii = γ on the diagonal:
//!
//! ```text
//! s = xₙ + h Σ aij vj        w = vₙ + h Σ aij aj        (j < i)        τ = σ = γ h
//! ```
//!
//! Those of Alexander are stiffly accurate: the last stage is the state after the step, so that a collapsed
//! or stiff body ends where its own equation holds. They are L-stable, as implicit Euler is. The midpoint
//! rule goes on beyond its only stage, to xₙ + h v and vₙ + h a.
//!
//! **Backward differences** of steps h and, before that, h/q fit a parabola to the last two states and the
//! one to come. The velocity at its end is v = (x − s)/τ with
//!
//! ```text
//! s = ((1 + q)² xₙ − q² xₙ₋₁)/(1 + 2q)        w likewise        τ = σ = (1 + q)/(1 + 2q) h
//! ```
//!
//! Without a step before, q = 0, this is implicit Euler.
//!
//! **Newmark's method and generalised α.** The state after the step is
//!
//! ```text
//! x' = x̃ + β h² a'        x̃ = xₙ + h vₙ + h² (½ − β) aₙ
//! v' = ṽ + γ h a'         ṽ = vₙ + h (1 − γ) aₙ
//! M ((1 − αm) a' + αm aₙ) = f((1 − αf) (x', v') + αf (xₙ, vₙ))
//! ```
//!
//! The argument of f is the stage, from which follow τ = β h/γ, σ = γ h (1 − αf)/(1 − αm), s and w.
//!
//! **Prescribed motion.** Pinned nodes and targets of springs move evenly through the step: a stage has them
//! at its share of their way, Σ aij or 1 − αf.
//!
//! \[Alexander77\] Alexander, *Diagonally implicit Runge–Kutta methods for stiff O.D.E.'s*, 1977.
//! \[CH93\] Chung, Hulbert, *A time integration algorithm for structural dynamics with improved numerical
//! dissipation: the generalized-α method*, 1993.
//! \[Gear71\] Gear, *Numerical Initial Value Problems in Ordinary Differential Equations*, 1971.
//! \[Newmark59\] Newmark, *A method of computation for structural dynamics*, 1959.

use super::spring::Spring;

/// Integrator of a [`Simulation`](super::Simulation).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Integrator {
    /// Implicit Euler: first order. Calms a body down, the more so the longer its steps.
    #[default]
    ImplicitEuler,
    /// The backward differentiation formula of the last two steps \[Gear71\]: second order, in one
    /// minimisation.
    ///
    /// Calms fast motions down as implicit Euler does, and slow ones far less. Steps may change their length;
    /// longer than 2.4 times the one before they would no longer be stable. The first step, and the one after
    /// positions, velocities or the integrator have been set, is one of implicit Euler.
    Bdf2,
    /// Two stages \[Alexander77\]: second order. A step costs a little more than two of implicit Euler
    /// (`cargo speed-report --only steps`).
    Sdirk2,
    /// Three stages \[Alexander77\]: third order, for smooth motions and small errors.
    Sdirk3,
    /// The implicit midpoint rule: second order, in one minimisation.
    ///
    /// Calms nothing down: motions that steps do not resolve keep their energy, and gain some where forces
    /// are far from linear. The state after a step lies beyond the one that was minimised, and a body that
    /// leaves the domain of its material there fails the step.
    ImplicitMidpoint,
    /// Newmark's method with β = ¼ and γ = ½, of constant average acceleration \[Newmark59\]: second order,
    /// in one minimisation.
    ///
    /// Calms nothing down. A step goes on from the [accelerations](super::Simulation::accelerations) after
    /// the one before.
    Newmark,
    /// Generalised α \[CH93\]: second order, in one minimisation; calms down what steps do not resolve.
    ///
    /// It goes on from accelerations as Newmark's method does, and beyond the state that was minimised as the
    /// midpoint rule does.
    GeneralizedAlpha {
        /// The share of the fastest motions that a step keeps, from 0 to 1.
        spectral_radius: f64,
    },
}

/// How the stages of a step follow from the state before it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Method {
    RungeKutta(Tableau),
    /// The length of the step over that of the one before, 0 where there was none.
    Differences {
        ratio: f64,
    },
    Alpha(Alpha),
}

/// Coefficients of a Runge–Kutta method.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tableau {
    /// γ.
    diagonal: f64,
    /// aij of each stage, for j < i.
    rows: &'static [&'static [f64]],
    /// Weights of the stages in the state after the step, where that is not the last stage.
    weights: Option<&'static [f64]>,
}

/// Coefficients αm, αf, β and γ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Alpha {
    m: f64,
    f: f64,
    beta: f64,
    gamma: f64,
}

impl Integrator {
    /// The method of a step from a state.
    pub(super) fn method(self, dt: f64, state: &State) -> Method {
        let stiffly_accurate = |diagonal, rows| Method::RungeKutta(Tableau { diagonal, rows, weights: None });
        match self {
            Self::ImplicitEuler => stiffly_accurate(1.0, &[&[]]),
            Self::Bdf2 => {
                Method::Differences { ratio: state.earlier.as_ref().map_or(0.0, |earlier| dt / earlier.dt) }
            }
            Self::Sdirk2 => stiffly_accurate(GAMMA_2, &[&[], &[1.0 - GAMMA_2]]),
            Self::Sdirk3 => {
                const FIRST: f64 = -0.25 * ((6.0 * GAMMA_3 - 16.0) * GAMMA_3 + 1.0);
                const SECOND: f64 = 0.25 * ((6.0 * GAMMA_3 - 20.0) * GAMMA_3 + 5.0);
                stiffly_accurate(GAMMA_3, &[&[], &[0.5 * (1.0 - GAMMA_3)], &[FIRST, SECOND]])
            }
            Self::ImplicitMidpoint => {
                Method::RungeKutta(Tableau { diagonal: 0.5, rows: &[&[]], weights: Some(&[1.0]) })
            }
            Self::Newmark => Method::Alpha(Alpha { m: 0.0, f: 0.0, beta: 0.25, gamma: 0.5 }),
            Self::GeneralizedAlpha { spectral_radius: rho } => {
                let (m, f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
                let beta = 0.25 * (1.0 - m + f) * (1.0 - m + f);
                Method::Alpha(Alpha { m, f, beta, gamma: 0.5 - m + f })
            }
        }
    }

    /// The power of the step's length with which errors of smooth motions fall.
    pub(super) fn order(self) -> i32 {
        match self {
            Self::ImplicitEuler => 1,
            Self::Bdf2
            | Self::Sdirk2
            | Self::ImplicitMidpoint
            | Self::Newmark
            | Self::GeneralizedAlpha { .. } => 2,
            Self::Sdirk3 => 3,
        }
    }

    /// The number of minimisations in a step.
    fn stages(self) -> usize {
        match self {
            Self::Sdirk2 => 2,
            Self::Sdirk3 => 3,
            _ => 1,
        }
    }

    /// Whether a step needs the state before the one that it starts from.
    pub(super) fn looks_back(self) -> bool {
        self == Self::Bdf2
    }

    /// The rule that these settings break, if any.
    pub(super) fn broken_rule(self) -> Option<&'static str> {
        match self {
            Self::GeneralizedAlpha { spectral_radius } if !(0.0..=1.0).contains(&spectral_radius) => {
                Some("the spectral radius of generalised α must be between 0 and 1")
            }
            _ => None,
        }
    }
}

impl Method {
    pub(super) fn stages(&self) -> usize {
        match self {
            Self::RungeKutta(tableau) => tableau.rows.len(),
            Self::Differences { .. } | Self::Alpha(_) => 1,
        }
    }

    /// Whether a step starts from accelerations.
    pub(super) fn needs_accelerations(&self) -> bool {
        matches!(self, Self::Alpha(_))
    }

    /// Whether the state after a step is that of its last stage.
    pub(super) fn ends_with_last_stage(&self) -> bool {
        match self {
            Self::RungeKutta(tableau) => tableau.weights.is_none(),
            Self::Differences { .. } => true,
            Self::Alpha(alpha) => alpha.f == 0.0 && alpha.m == 0.0,
        }
    }

    /// τ and σ of each stage.
    pub(super) fn lengths(&self, dt: f64) -> [f64; 2] {
        match self {
            Self::RungeKutta(tableau) => [tableau.diagonal * dt; 2],
            Self::Differences { ratio } => [(1.0 + ratio) / (1.0 + 2.0 * ratio) * dt; 2],
            Self::Alpha(Alpha { m, f, beta, gamma }) => {
                [beta / gamma * dt, gamma * (1.0 - f) / (1.0 - m) * dt]
            }
        }
    }

    /// The share of their way that pinned nodes have gone in a stage.
    pub(super) fn share(&self, stage: usize) -> f64 {
        match self {
            Self::RungeKutta(Tableau { rows, weights: None, .. }) if stage + 1 == rows.len() => 1.0,
            Self::RungeKutta(Tableau { rows, diagonal, .. }) => rows[stage].iter().sum::<f64>() + diagonal,
            Self::Differences { .. } => 1.0,
            Self::Alpha(alpha) => 1.0 - alpha.f,
        }
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
    /// Whether the accelerations are those of the forces, or of the step before.
    pub(super) has_accelerations: bool,
    /// The state before the last step, where the integrator needs it.
    pub(super) earlier: Option<Box<Earlier>>,
}

/// The state before the last step, and its length, s.
#[derive(Clone, Debug)]
pub(super) struct Earlier {
    x: Vec<[f64; 3]>,
    v: Vec<[f64; 3]>,
    dt: f64,
}

impl State {
    /// Rest at these positions.
    pub(super) fn at_rest(positions: &[[f64; 3]]) -> Self {
        let zero = || vec![[0.0; 3]; positions.len()];
        Self { x: positions.to_vec(), v: zero(), a: zero(), has_accelerations: false, earlier: None }
    }

    /// Forgets how the body has come here.
    pub(super) fn forget(&mut self) {
        self.has_accelerations = false;
        self.earlier = None;
    }

    /// Notes that a step of `dt` has come from `before`.
    pub(super) fn come_from(&mut self, before: &Self, dt: f64) {
        let Self { x, v, .. } = before;
        match &mut self.earlier {
            Some(earlier) => {
                earlier.x.copy_from_slice(x);
                earlier.v.copy_from_slice(v);
                earlier.dt = dt;
            }
            None => self.earlier = Some(Box::new(Earlier { x: x.clone(), v: v.clone(), dt })),
        }
    }
}

/// How a stage of a step gets velocities v = (x − s)/τ and accelerations a = (v − w)/σ from positions x.
#[derive(Clone, Debug)]
pub struct Stage {
    /// s, m.
    pub(crate) start: Vec<[f64; 3]>,
    /// w, m/s.
    pub(crate) velocities: Vec<[f64; 3]>,
    /// τ and σ, s.
    pub(crate) lengths: [f64; 2],
    /// Accelerations in the stage before or, of the first one, at the end of the step before, m/s²; zero
    /// where there was none.
    pub(crate) accelerations: Vec<[f64; 3]>,
    /// Whether errors of steps begin with changes of the accelerations, not with the accelerations.
    is_second_order: bool,
}

impl Stage {
    /// Statics: no velocities and no accelerations, wherever the nodes are.
    pub(super) fn at_rest(nodes: usize) -> Self {
        let zero = || vec![[0.0; 3]; nodes];
        Self {
            start: zero(),
            velocities: zero(),
            lengths: [f64::INFINITY; 2],
            accelerations: zero(),
            is_second_order: false,
        }
    }

    /// Velocity, m/s, and acceleration, m/s², of a node that is at `x`, m.
    ///
    /// # Panics
    /// If there is no such node.
    #[must_use]
    pub fn motion(&self, node: usize, x: [f64; 3]) -> [[f64; 3]; 2] {
        let [tau, sigma] = self.lengths;
        let v: [f64; 3] = std::array::from_fn(|c| (x[c] - self.start[node][c]) / tau);
        [v, std::array::from_fn(|c| (v[c] - self.velocities[node][c]) / sigma)]
    }

    /// Displacement from `x` to where a node would be with `share` of the accelerations before, s + τ (w + σ
    /// a), without forces for 0.
    pub(super) fn extrapolation(&self, node: usize, x: [f64; 3], share: f64) -> [f64; 3] {
        let [tau, sigma] = self.lengths;
        let velocity = |c: usize| self.velocities[node][c] + share * sigma * self.accelerations[node][c];
        std::array::from_fn(|c| (self.start[node][c] - x[c]) + tau * velocity(c))
    }

    /// Scale of the error that the step has anyway with its nodes at `x`, m: the largest τ σ |a|, or of
    /// methods of higher order τ σ times the change of a.
    pub(super) fn error_scale(&self, x: &[[f64; 3]]) -> f64 {
        let [tau, sigma] = self.lengths;
        let before = if self.is_second_order { 1.0 } else { 0.0 };
        let size = |node: usize| {
            let [_, a] = self.motion(node, x[node]);
            let change = |c: usize| a[c] - before * self.accelerations[node][c];
            (0..3).map(|c| change(c).powi(2)).sum::<f64>()
        };
        tau * sigma * (0..x.len()).map(size).fold(0.0, f64::max).sqrt()
    }
}

/// The current stage of a step, and what those before it have left.
#[derive(Clone, Debug)]
pub(super) struct Stages {
    pub(super) current: Stage,
    /// Springs with their targets in this stage.
    pub(super) springs: Vec<Spring>,
    /// v, m/s, and a, m/s², of each stage done but the last.
    done: Vec<[Vec<[f64; 3]>; 2]>,
}

impl Stages {
    /// Memory for the stages of an integrator.
    pub(super) fn new(integrator: Integrator, nodes: usize) -> Self {
        let zero = || vec![[0.0; 3]; nodes];
        let done = (1..integrator.stages()).map(|_| [zero(), zero()]).collect();
        let current = Stage { is_second_order: integrator.order() > 1, ..Stage::at_rest(nodes) };
        Self { current, springs: Vec::new(), done }
    }

    /// Sets s, w, τ and σ of a stage of a step of `dt`.
    pub(super) fn begin(&mut self, method: &Method, stage: usize, dt: f64, state: &State) {
        let State { x, v, a, earlier, .. } = state;
        let Stage { start, velocities, lengths, accelerations, .. } = &mut self.current;
        *lengths = method.lengths(dt);
        accelerations.copy_from_slice(stage.checked_sub(1).map_or(a, |before| &self.done[before][1]));
        start.copy_from_slice(x);
        velocities.copy_from_slice(v);
        match *method {
            Method::RungeKutta(tableau) => {
                for (coefficient, [v, a]) in tableau.rows[stage].iter().zip(&self.done) {
                    add(start, dt * coefficient, v);
                    add(velocities, dt * coefficient, a);
                }
            }
            Method::Differences { ratio } => {
                // (1 + q)²/(1 + 2q) xₙ − q²/(1 + 2q) xₙ₋₁
                let back = ratio * ratio / (1.0 + 2.0 * ratio);
                let Some(earlier) = earlier else { return };
                for (now, before) in [(start, &earlier.x), (velocities, &earlier.v)] {
                    let pairs = now.as_flattened_mut().iter_mut().zip(before.as_flattened());
                    pairs.for_each(|(now, before)| *now += back * (*now - before));
                }
            }
            Method::Alpha(Alpha { m, f, beta, gamma }) => {
                let [tau, sigma] = *lengths;
                add(start, (1.0 - f) * dt, v);
                add(start, (1.0 - f) * dt * dt * (0.5 - beta), a);
                add(velocities, (1.0 - f) * dt * (1.0 - gamma), a);
                add(start, -tau, velocities);
                add(velocities, -sigma * m, a);
            }
        }
    }

    /// Makes a node move evenly by `way` in the course of a step of `dt`, and be at `x` in this stage.
    pub(super) fn drive(&mut self, node: usize, dt: f64, way: [f64; 3], x: [f64; 3]) {
        let Stage { start, velocities, lengths, .. } = &mut self.current;
        velocities[node] = way.map(|way| way / dt);
        for c in 0..3 {
            start[node][c] = x[c] - lengths[0] * velocities[node][c];
        }
    }

    /// Sets the springs for this stage, whose targets have gone this share of their way.
    pub(super) fn pull(&mut self, springs: &[Spring], targets_before: &[[f64; 3]], share: f64) {
        let at_share = |(&spring, before): (&Spring, &[f64; 3])| {
            let way = |c: usize| before[c] + share * (spring.target[c] - before[c]);
            // At the end without rounding.
            if share == 1.0 { spring } else { Spring { target: std::array::from_fn(way), ..spring } }
        };
        self.springs.clear();
        self.springs.extend(springs.iter().zip(targets_before).map(at_share));
    }

    /// Notes that a stage before the last has ended at `positions`.
    pub(super) fn end(&mut self, stage: usize, positions: &[[f64; 3]]) {
        for (node, &x) in positions.iter().enumerate() {
            let [v, a] = self.current.motion(node, x);
            self.done[stage][0][node] = v;
            self.done[stage][1][node] = a;
        }
    }

    /// Takes the state after a step of `dt` from the one before it; the last stage has ended at `next.x`.
    pub(super) fn finish(&self, method: &Method, dt: f64, before: &State, next: &mut State) {
        for node in 0..next.x.len() {
            let [v, a] = self.current.motion(node, next.x[node]);
            (next.v[node], next.a[node]) = (v, a);
            match *method {
                Method::RungeKutta(Tableau { weights: None, .. }) | Method::Differences { .. } => {}
                Method::RungeKutta(Tableau { weights: Some(weights), .. }) => {
                    let (last, others) = weights.split_last().unwrap_or((&1.0, &[]));
                    (next.x[node], next.v[node]) = (before.x[node], before.v[node]);
                    let done = others.iter().zip(&self.done).map(|(b, [v, a])| (b, v[node], a[node]));
                    for (b, v, a) in done.chain([(last, v, a)]) {
                        for c in 0..3 {
                            next.x[node][c] += dt * b * v[c];
                            next.v[node][c] += dt * b * a[c];
                        }
                    }
                }
                Method::Alpha(Alpha { m, f, .. }) => {
                    for c in 0..3 {
                        let beyond = |at: f64, share: f64, before: f64| (at - share * before) / (1.0 - share);
                        next.x[node][c] = beyond(next.x[node][c], f, before.x[node][c]);
                        next.v[node][c] = beyond(v[c], f, before.v[node][c]);
                        next.a[node][c] = beyond(a[c], m, before.a[node][c]);
                    }
                }
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
