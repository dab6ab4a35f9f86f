/// Compressible Ogden solid with N terms: rubber at large strain.
///
/// ψ = Σₚ μₚ/αₚ (λ1^αₚ + λ2^αₚ + λ3^αₚ − 3) − (Σₚ μₚ) ln J + κ/2 (J − 1)².
///
/// Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment for
/// incompressible rubberlike solids*, Proc. R. Soc. Lond. A 326, 1972, eq. 12, for the shear part. The source
/// is incompressible; here −(Σₚ μₚ) ln J frees the rest state of stress and κ/2 (J − 1)² penalises changes of
/// volume. κ is the first Lamé parameter at small strain. Defined for J > 0; continued below a threshold
/// stretch with [`Inversion::Extend`](piola::Inversion::Extend) if every μₚ αₚ > 0 and κ ≥ 0: a term with μₚ
/// αₚ < 0 would attract collapse.
///
/// ```text
/// ψ = Σₚ μₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3)/αₚ + 1/2 κ (J − 1)² − (Σₚ μₚ) ln J
/// ```
///
/// **Parameters**:
///
/// * `mu`: Moduli μₚ, Pa.
/// * `alpha`: Exponents αₚ, dimensionless.
/// * `kappa`: Volumetric modulus κ, Pa.
///
/// They satisfy `alpha[p] != 0`.
///
/// **Typical**: `mu = [6.3e5, 1.2e3, -1e4], alpha = [1.3, 5.0, -2.0], kappa = 2e7`, natural rubber, the three terms of the source.
///
/// **Domain**: `J > 0`. It can be continued beyond J > 0 where `mu[p] * alpha[p] > 0, kappa >= 0`.
///
/// **Small strain**: μ = 1/2 Σₚ μₚ αₚ, λ = κ.
///
/// **Derivatives** inside the domain, with D⁻₁₂ = (ψ₁ − ψ₂)/(λ₁ − λ₂) and D⁺₁₂ = (ψ₁ + ψ₂)/(λ₁ + λ₂), where f\[x, y\] is (f(x) − f(y))/(x − y); the others follow by exchange of stretches:
///
/// ```text
/// ψ₁ = Σₚ μₚ λ₁^(αₚ − 1) + κ (J − 1) λ₂ λ₃ − (Σₚ μₚ)/λ₁
/// ψ₁₁ = Σₚ μₚ (αₚ − 1) λ₁^(αₚ − 2) + (Σₚ μₚ)/λ₁² + κ λ₂² λ₃²
/// ψ₁₂ = κ (J − 1) λ₃ + κ λ₁ λ₂ λ₃²
/// D⁻₁₂ = Σₚ μₚ pow^(αₚ − 1)[λ₁, λ₂] + (Σₚ μₚ)/(λ₁ λ₂) − κ (J − 1) λ₃
/// D⁺₁₂ = κ (J − 1) λ₃ + (Σₚ μₚ λ₁^(αₚ − 1) + Σₚ μₚ λ₂^(αₚ − 1))/(λ₁ + λ₂) − (Σₚ μₚ)/(λ₁ λ₂)
/// ```
///
/// **By the parameters**: it is [`Fittable`](piola::material::Fittable), with the derivatives of ψ₁, ψ₂, ψ₃ by each.
///
/// **Operations**, of each result by itself:
///
/// | result | operations |
/// |---|---|
/// | energy | 13 + 11 N (N ÷, 4 ln, 3 N pow) |
/// | gradient | 26 + 11 N (3 ÷, 3 ln, 3 N pow) |
/// | energy, gradient and Hessian | 62 + 25 N (3 + N ÷, 4 ln, 3 N pow) |
/// | flip | 29 + 14 N (3 ÷, 3 ln, 3 N pow, 3 + 3 N Δ) |
/// | twist | 38 + 11 N (6 ÷, 3 ln, 3 N pow) |
/// | blocks | 85 + 27 N (6 ÷, 3 ln, 3 N pow, 3 + 3 N Δ) |
/// | blocks, continued | 131 + 60 N (7 + N ÷, 4 ln, 4 N pow, 9 + 3 N Δ) |
///
/// A fused multiplication and addition counts as two operations, a loop over lists of length N as N times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a multiplication: ÷ divisions, √ roots, ln, exp, φ other elementary functions, pow real powers, Δ divided differences, f functions that are parameters.
#[derive(Clone, Debug, PartialEq)]
#[derive(Copy)]
pub struct Ogden<const N: usize, P = f64> {
    mu: [P; N],
    alpha: [P; N],
    kappa: P,
    inversion: ::piola::Inversion,
}
const _: () = {
    use ::piola::__private as __p;
    #[allow(clippy::too_many_arguments)]
    impl<const N: usize> Ogden<N> {
        /// The material with these parameters.
        ///
        /// * `mu`: Moduli μₚ, Pa.
        /// * `alpha`: Exponents αₚ, dimensionless.
        /// * `kappa`: Volumetric modulus κ, Pa.
        ///
        /// # Errors
        /// Where a parameter is not finite or not admissible.
        pub fn new(
            mu: [f64; N],
            alpha: [f64; N],
            kappa: f64,
        ) -> __p::Result<Self, __p::MaterialError> {
            __p::all_finite("mu", &mu)?;
            __p::all_finite("alpha", &alpha)?;
            __p::finite("kappa", kappa)?;
            for p in 0..alpha.len() {
                __p::admissible(
                    alpha[p] != 0f64,
                    "alpha[p] != 0",
                    &[("alpha", Some(p), alpha[p])],
                )?;
            }
            __p::stable_at_rest(Self {
                mu,
                alpha,
                kappa,
                inversion: __p::Inversion::Refuse,
            })
        }
        /// Replaces what the material does outside its domain.
        ///
        /// # Errors
        /// Where the extension would not restore, or its threshold is outside 0 < ε < 1.
        pub fn with_inversion(
            mut self,
            inversion: __p::Inversion,
        ) -> __p::Result<Self, __p::MaterialError> {
            if __p::extends(inversion)? {
                let Self { mu, alpha, kappa, .. } = self;
                for p in 0..mu.len() {
                    __p::restoring(
                        mu[p] * alpha[p] > 0f64,
                        "mu[p] * alpha[p] > 0",
                        &[("mu", Some(p), mu[p]), ("alpha", Some(p), alpha[p])],
                    )?;
                }
                __p::restoring(kappa >= 0f64, "kappa >= 0", &[("kappa", None, kappa)])?;
            }
            self.inversion = inversion;
            Ok(self)
        }
        /// Moduli μₚ, Pa.
        #[must_use]
        pub fn mu(&self) -> [f64; N] {
            self.mu
        }
        /// Exponents αₚ, dimensionless.
        #[must_use]
        pub fn alpha(&self) -> [f64; N] {
            self.alpha
        }
        /// Volumetric modulus κ, Pa.
        #[must_use]
        pub fn kappa(&self) -> f64 {
            self.kappa
        }
        /// Replaces `mu`.
        ///
        /// # Errors
        /// If the parameters are not admissible together, as of `new`.
        #[allow(dead_code)]
        pub fn with_mu(self, mu: [f64; N]) -> __p::Result<Self, __p::MaterialError> {
            Self::new(mu, self.alpha, self.kappa)?.with_inversion(self.inversion)
        }
        /// Replaces `alpha`.
        ///
        /// # Errors
        /// If the parameters are not admissible together, as of `new`.
        #[allow(dead_code)]
        pub fn with_alpha(
            self,
            alpha: [f64; N],
        ) -> __p::Result<Self, __p::MaterialError> {
            Self::new(self.mu, alpha, self.kappa)?.with_inversion(self.inversion)
        }
        /// Replaces `kappa`.
        ///
        /// # Errors
        /// If the parameters are not admissible together, as of `new`.
        #[allow(dead_code)]
        pub fn with_kappa(self, kappa: f64) -> __p::Result<Self, __p::MaterialError> {
            Self::new(self.mu, self.alpha, kappa)?.with_inversion(self.inversion)
        }
    }
    #[allow(unused_variables, clippy::all)]
    impl<const N: usize, P: __p::ParameterValue> ::piola::Material for Ogden<N, P> {
        #[inline(always)]
        fn energy<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> R {
            match self.inversion {
                __p::Inversion::Refuse => {
                    let t0 = l1.logarithm();
                    let t1 = l2.logarithm();
                    let t2 = l3.logarithm();
                    let mut t3 = R::splat(0.0);
                    let mut t4 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let t5 = R::splat(1.0) / alpha;
                        let t11 = ((R::power(t0, alpha) + R::power(t1, alpha))
                            + R::power(t2, alpha)) - R::splat(3.0);
                        let t13 = t11 * (mu * t5);
                        t3 = t3 + t13;
                        t4 = t4 + mu;
                    }
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t15 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t20 = (-t4)
                        .mul_add(
                            __p::ln_product([l1, l2, l3]),
                            (t15 * (kappa * t15)).mul_add(R::splat(0.5), t3),
                        );
                    t20
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let t0 = l1.max(epsilon);
                    let t1 = t0.logarithm();
                    let t2 = (l1 - epsilon).min(R::splat(0.0));
                    let t3 = R::splat(1.0) / t0;
                    let t4 = t3 * t3;
                    let t5 = (l2 - epsilon).min(R::splat(0.0));
                    let t6 = l2.max(epsilon);
                    let t7 = t6.logarithm();
                    let t8 = R::splat(1.0) / t6;
                    let t9 = t8 * t8;
                    let t10 = (l3 - epsilon).min(R::splat(0.0));
                    let t11 = l3.max(epsilon);
                    let t12 = t11.logarithm();
                    let t13 = R::splat(1.0) / t11;
                    let t14 = t13 * t13;
                    let mut t15 = R::splat(0.0);
                    let mut t16 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let t17 = R::splat(1.0) / alpha;
                        let t18 = R::power(t1, alpha);
                        let t21 = (t18 * t3).mul_add(alpha * t2, t18);
                        let t22 = alpha - R::splat(1.0);
                        let t23 = t18 * t4;
                        let t24 = alpha * t22;
                        let t27 = t23 * (t2 * (t2 * t24));
                        let t28 = R::power(t7, alpha);
                        let t32 = (t28 * t9).mul_add(t5 * (t24 * t5), t27);
                        let t33 = R::power(t12, alpha);
                        let t42 = (t28 * t8)
                            .mul_add(
                                alpha * t5,
                                t28
                                    + (t33 * t14)
                                        .mul_add(t10 * (t24 * t10), t32)
                                        .mul_add(R::splat(0.5), t21),
                            );
                        let t49 = ((t33 * t13).mul_add(alpha * t10, t33 + t42)
                            - R::splat(3.0)) * (mu * t17);
                        t15 = t15 + t49;
                        t16 = t16 + mu;
                    }
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t51 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t54 = R::splat(0.5).mul_add(t51 * (kappa * t51), t15);
                    let t72 = (-R::splat(0.5))
                        .mul_add(
                            t13
                                .mul_add(
                                    t13 * (t10 * t10),
                                    t8.mul_add(t8 * (t5 * t5), t3 * (t3 * (t2 * t2))),
                                ),
                            t10
                                .mul_add(
                                    t13,
                                    t5.mul_add(t8, t2.mul_add(t3, t0.ln()) + t6.ln()) + t11.ln(),
                                ),
                        );
                    (-t16).mul_add(t72, t54)
                }
            }
        }
        #[inline(always)]
        fn gradient<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> [R; 3] {
            match self.inversion {
                __p::Inversion::Refuse => {
                    let t0 = l1.logarithm();
                    let t1 = l2.logarithm();
                    let t2 = l3.logarithm();
                    let mut t3 = R::splat(0.0);
                    let mut t4 = R::splat(0.0);
                    let mut t5 = R::splat(0.0);
                    let mut t6 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let t7 = alpha - R::splat(1.0);
                        let t9 = mu * R::power(t0, t7);
                        let t11 = mu * R::power(t1, t7);
                        let t13 = mu * R::power(t2, t7);
                        t3 = t3 + t9;
                        t4 = t4 + mu;
                        t5 = t5 + t11;
                        t6 = t6 + t13;
                    }
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t15 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t20 = (-t4)
                        .mul_add(R::splat(1.0) / l1, t15.mul_add(l3 * (l2 * kappa), t3));
                    let t21 = l1 * kappa;
                    [
                        t20,
                        (-t4).mul_add(R::splat(1.0) / l2, t15.mul_add(l3 * t21, t5)),
                        (-t4).mul_add(R::splat(1.0) / l3, t15.mul_add(l2 * t21, t6)),
                    ]
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let t0 = l1.max(epsilon);
                    let t1 = t0.logarithm();
                    let t2 = (l1 - epsilon).min(R::splat(0.0));
                    let t3 = R::splat(1.0) / t0;
                    let t4 = l2.max(epsilon);
                    let t5 = t4.logarithm();
                    let t6 = (l2 - epsilon).min(R::splat(0.0));
                    let t7 = R::splat(1.0) / t4;
                    let t8 = l3.max(epsilon);
                    let t9 = t8.logarithm();
                    let t10 = (l3 - epsilon).min(R::splat(0.0));
                    let t11 = R::splat(1.0) / t8;
                    let mut t12 = R::splat(0.0);
                    let mut t13 = R::splat(0.0);
                    let mut t14 = R::splat(0.0);
                    let mut t15 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let t16 = R::splat(1.0) / alpha;
                        let t17 = alpha - R::splat(1.0);
                        let t18 = R::power(t1, t17);
                        let t19 = alpha * t18;
                        let t20 = t18 * t3;
                        let t21 = alpha * t17;
                        let t23 = t20.mul_add(t2 * t21, t19);
                        let t24 = mu * t16;
                        let t25 = t23 * t24;
                        let t26 = R::power(t5, t17);
                        let t31 = t24 * (t26 * t7).mul_add(t21 * t6, alpha * t26);
                        let t32 = R::power(t9, t17);
                        let t37 = t24 * (t32 * t11).mul_add(t21 * t10, alpha * t32);
                        t12 = t12 + t25;
                        t13 = t13 + mu;
                        t14 = t14 + t31;
                        t15 = t15 + t37;
                    }
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t39 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t45 = (-t13)
                        .mul_add(
                            (-t3).mul_add(t2 * t3, t3),
                            t39.mul_add(l3 * (l2 * kappa), t12),
                        );
                    let t46 = l1 * kappa;
                    [
                        t45,
                        (-t13)
                            .mul_add(
                                (-t7).mul_add(t6 * t7, t7),
                                t39.mul_add(l3 * t46, t14),
                            ),
                        (-t13)
                            .mul_add(
                                (-t11).mul_add(t10 * t11, t11),
                                t39.mul_add(l2 * t46, t15),
                            ),
                    ]
                }
            }
        }
        #[inline(always)]
        fn gradient_at_strains<R: __p::Real>(&self, strains: [R; 3]) -> [R; 3] {
            let [l1, l2, l3] = [
                R::splat(1.0) + strains[0],
                R::splat(1.0) + strains[1],
                R::splat(1.0) + strains[2],
            ];
            let t0 = R::splat(1.0) / l1;
            let t1 = l1.logarithm();
            let t2 = R::splat(1.0).logarithm();
            let t3 = __p::Pair::new([l1, R::splat(1.0)], [t0, R::splat(1.0)], [t1, t2]);
            let t4 = R::splat(1.0) / l2;
            let t5 = l2.logarithm();
            let t6 = __p::Pair::new([l2, R::splat(1.0)], [t4, R::splat(1.0)], [t5, t2]);
            let t7 = R::splat(1.0) / l3;
            let t8 = l3.logarithm();
            let t9 = __p::Pair::new([l3, R::splat(1.0)], [t7, R::splat(1.0)], [t8, t2]);
            let mut t10 = R::splat(0.0);
            let mut t11 = R::splat(0.0);
            let mut t12 = R::splat(0.0);
            let mut t13 = R::splat(0.0);
            for p in 0..N {
                let mu: R = __p::ParameterValue::on(&self.mu[p]);
                let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                let t14 = alpha - R::splat(1.0);
                let t18 = t3.power_quotient([R::power(t1, t14), R::splat(1.0)], t14)
                    * (mu * strains[0]);
                let t22 = t6.power_quotient([R::power(t5, t14), R::splat(1.0)], t14)
                    * (mu * strains[1]);
                let t26 = t9.power_quotient([R::power(t8, t14), R::splat(1.0)], t14)
                    * (mu * strains[2]);
                t10 = t10 + t18;
                t11 = t11 + mu;
                t12 = t12 + t22;
                t13 = t13 + t26;
            }
            let kappa: R = __p::ParameterValue::on(&self.kappa);
            let t28 = t0.mul_add(strains[0] * t11, t10);
            let t32 = kappa
                * l3.mul_add(strains[0] * l2, strains[1].mul_add(l3, strains[2]));
            let t34 = l3.mul_add(l2 * t32, t28);
            let t36 = t4.mul_add(strains[1] * t11, t12);
            let t37 = l1 * t32;
            let inside = [
                t34,
                l3.mul_add(t37, t36),
                l2.mul_add(t37, t7.mul_add(strains[2] * t11, t13)),
            ];
            if let __p::Inversion::Extend { epsilon: epsilon } = self.inversion {
                let below = strains[2].less(R::splat(epsilon - 1.0));
                if __p::Mask::any(below) {
                    let extended = ::piola::Material::gradient(
                        self,
                        [
                            R::splat(1.0) + strains[0],
                            R::splat(1.0) + strains[1],
                            R::splat(1.0) + strains[2],
                        ],
                    );
                    return ::core::array::from_fn(|k| R::select(
                        below,
                        extended[k],
                        inside[k],
                    ));
                }
            }
            inside
        }
        #[inline(always)]
        fn blocks<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> __p::Blocks<R> {
            match self.inversion {
                __p::Inversion::Refuse => {
                    let t0 = l1.logarithm();
                    let t1 = l2.logarithm();
                    let t2 = l3.logarithm();
                    let t3 = R::splat(1.0) / l1;
                    let t4 = R::splat(1.0) / l2;
                    let t5 = __p::Pair::new([l1, l2], [t3, t4], [t0, t1]);
                    let t6 = R::splat(1.0) / l3;
                    let t7 = __p::Pair::new([l1, l3], [t3, t6], [t0, t2]);
                    let t8 = __p::Pair::new([l2, l3], [t4, t6], [t1, t2]);
                    let mut t9 = R::splat(0.0);
                    let mut t10 = R::splat(0.0);
                    let mut t11 = R::splat(0.0);
                    let mut t12 = R::splat(0.0);
                    let mut t13 = R::splat(0.0);
                    let mut t14 = R::splat(0.0);
                    let mut t15 = R::splat(0.0);
                    let mut t16 = R::splat(0.0);
                    let mut t17 = R::splat(0.0);
                    let mut t18 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let t19 = alpha - R::splat(1.0);
                        let t20 = R::power(t0, t19);
                        let t21 = mu * t20;
                        let t22 = R::power(t1, t19);
                        let t23 = mu * t22;
                        let t24 = R::power(t2, t19);
                        let t25 = mu * t24;
                        let t26 = mu * t19;
                        let t27 = t20 * t26;
                        let t28 = t22 * t26;
                        let t29 = t24 * t26;
                        let t31 = mu * t5.power_quotient([t20, t22], t19);
                        let t33 = mu * t7.power_quotient([t20, t24], t19);
                        let t35 = mu * t8.power_quotient([t22, t24], t19);
                        t9 = t9 + t21;
                        t10 = t10 + mu;
                        t11 = t11 + t23;
                        t12 = t12 + t25;
                        t13 = t13 + t27;
                        t14 = t14 + t28;
                        t15 = t15 + t29;
                        t16 = t16 + t31;
                        t17 = t17 + t33;
                        t18 = t18 + t35;
                    }
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t37 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t38 = l2 * kappa;
                    let t39 = l3 * t38;
                    let t40 = t37.mul_add(t39, t9);
                    let t41 = t3 * t10;
                    let t42 = t40 - t41;
                    let t43 = l1 * kappa;
                    let t44 = l3 * t43;
                    let t45 = t37.mul_add(t44, t11);
                    let t46 = t4 * t10;
                    let t47 = t45 - t46;
                    let t48 = l2 * t43;
                    let t49 = t37.mul_add(t48, t12);
                    let t50 = t6 * t10;
                    let t51 = t49 - t50;
                    let t55 = t3.mul_add(t13, l3.mul_add(l2 * t39, t3 * t41));
                    let t59 = t4.mul_add(t14, l3.mul_add(l1 * t44, t4 * t46));
                    let t63 = t6.mul_add(t15, l2.mul_add(l1 * t48, t6 * t50));
                    let t65 = t37 * (l3 * kappa);
                    let t66 = l3 * t48;
                    let t67 = l3.mul_add(t66, t65);
                    let t68 = t37 * t38;
                    let t69 = l2.mul_add(t66, t68);
                    let t70 = t37 * t43;
                    let t71 = l1.mul_add(t66, t70);
                    let t72 = t4 * t41;
                    let t74 = (t16 + t72) - t65;
                    let t75 = t6 * t41;
                    let t77 = (t17 + t75) - t68;
                    let t78 = t6 * t46;
                    __p::Blocks {
                        gradient: [t42, t47, t51],
                        hessian: [t55, t59, t63, t67, t69, t71],
                        flip: [t74, t77, (t18 + t78) - t70],
                        twist: [
                            (t9 + t11).mul_add(R::splat(1.0) / (l1 + l2), t65) - t72,
                            (t9 + t12).mul_add(R::splat(1.0) / (l1 + l3), t68) - t75,
                            (t11 + t12).mul_add(R::splat(1.0) / (l2 + l3), t70) - t78,
                        ],
                    }
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let t0 = l1.max(epsilon);
                    let t1 = t0.logarithm();
                    let t2 = (l1 - epsilon).min(R::splat(0.0));
                    let t3 = R::splat(1.0) / t0;
                    let t4 = l2.max(epsilon);
                    let t5 = t4.logarithm();
                    let t6 = (l2 - epsilon).min(R::splat(0.0));
                    let t7 = R::splat(1.0) / t4;
                    let t8 = l3.max(epsilon);
                    let t9 = t8.logarithm();
                    let t10 = (l3 - epsilon).min(R::splat(0.0));
                    let t11 = R::splat(1.0) / t8;
                    let t12 = __p::share_above(l1, l2, epsilon);
                    let t13 = __p::Pair::new([t0, t4], [t3, t7], [t1, t5]);
                    let t14 = epsilon.logarithm();
                    let t15 = __p::share_below(l1, l2, epsilon);
                    let t16 = __p::share_above(l1, l3, epsilon);
                    let t17 = __p::Pair::new([t0, t8], [t3, t11], [t1, t9]);
                    let t18 = __p::share_below(l1, l3, epsilon);
                    let t19 = __p::share_above(l2, l3, epsilon);
                    let t20 = __p::Pair::new([t4, t8], [t7, t11], [t5, t9]);
                    let t21 = __p::share_below(l2, l3, epsilon);
                    let mut t22 = R::splat(0.0);
                    let mut t23 = R::splat(0.0);
                    let mut t24 = R::splat(0.0);
                    let mut t25 = R::splat(0.0);
                    let mut t26 = R::splat(0.0);
                    let mut t27 = R::splat(0.0);
                    let mut t28 = R::splat(0.0);
                    let mut t29 = R::splat(0.0);
                    let mut t30 = R::splat(0.0);
                    let mut t31 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let t32 = R::splat(1.0) / alpha;
                        let t33 = alpha - R::splat(1.0);
                        let t34 = R::power(t1, t33);
                        let t35 = alpha * t34;
                        let t36 = t34 * t3;
                        let t37 = alpha * t33;
                        let t39 = t36.mul_add(t2 * t37, t35);
                        let t40 = mu * t32;
                        let t41 = t39 * t40;
                        let t42 = R::power(t5, t33);
                        let t47 = t40 * (t42 * t7).mul_add(t37 * t6, alpha * t42);
                        let t48 = R::power(t9, t33);
                        let t53 = t40 * (t48 * t11).mul_add(t37 * t10, alpha * t48);
                        let t54 = mu * t33;
                        let t55 = t34 * t54;
                        let t56 = t42 * t54;
                        let t57 = t48 * t54;
                        let t60 = t13.power_quotient([t34, t42], t33) * (alpha * t12);
                        let t63 = t37 * R::power(t14, alpha - R::splat(2.0));
                        let t65 = t40 * t15.mul_add(t63, t60);
                        let t70 = t40
                            * t63
                                .mul_add(
                                    t18,
                                    t17.power_quotient([t34, t48], t33) * (alpha * t16),
                                );
                        let t75 = t40
                            * t63
                                .mul_add(
                                    t21,
                                    t20.power_quotient([t42, t48], t33) * (alpha * t19),
                                );
                        t22 = t22 + t41;
                        t23 = t23 + mu;
                        t24 = t24 + t47;
                        t25 = t25 + t53;
                        t26 = t26 + t55;
                        t27 = t27 + t56;
                        t28 = t28 + t57;
                        t29 = t29 + t65;
                        t30 = t30 + t70;
                        t31 = t31 + t75;
                    }
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t77 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t78 = l2 * kappa;
                    let t79 = l3 * t78;
                    let t80 = t77.mul_add(t79, t22);
                    let t83 = t23 * (-t3).mul_add(t2 * t3, t3);
                    let t84 = t80 - t83;
                    let t85 = l1 * kappa;
                    let t86 = l3 * t85;
                    let t87 = t77.mul_add(t86, t24);
                    let t90 = t23 * (-t7).mul_add(t6 * t7, t7);
                    let t91 = t87 - t90;
                    let t92 = l2 * t85;
                    let t93 = t77.mul_add(t92, t25);
                    let t96 = t23 * (-t11).mul_add(t10 * t11, t11);
                    let t97 = t93 - t96;
                    let t102 = t3.mul_add(t26, t3.mul_add(t3 * t23, l3 * (l2 * t79)));
                    let t107 = t7.mul_add(t27, t7.mul_add(t7 * t23, l3 * (l1 * t86)));
                    let t112 = t11.mul_add(t28, t11.mul_add(t11 * t23, l2 * (l1 * t92)));
                    let t114 = t77 * (l3 * kappa);
                    let t115 = l3 * t92;
                    let t116 = l3.mul_add(t115, t114);
                    let t117 = t77 * t78;
                    let t118 = l2.mul_add(t115, t117);
                    let t119 = t77 * t85;
                    let t120 = l1.mul_add(t115, t119);
                    let t121 = t29 - t114;
                    let t124 = -(t7 * (t3 * t12));
                    let t125 = R::splat(1.0) / epsilon;
                    let t126 = t125 * t125;
                    let t128 = (-t23).mul_add((-t15).mul_add(t126, t124), t121);
                    let t134 = (-t23)
                        .mul_add((-t18).mul_add(t126, -(t11 * (t3 * t16))), t30 - t117);
                    let t140 = (-t23)
                        .mul_add((-t21).mul_add(t126, -(t11 * (t7 * t19))), t31 - t119);
                    let t143 = ((t22 + t24) - t83) - t90;
                    let t144 = l1 + l2;
                    let t145 = __p::pole_floor([l1, l2, l3]);
                    __p::Blocks {
                        gradient: [t84, t91, t97],
                        hessian: [t102, t107, t112, t116, t118, t120],
                        flip: [t128, t134, t140],
                        twist: [
                            t114 + (t143 / t144.max(t145)),
                            t117 + ((((t22 + t25) - t83) - t96) / (l1 + l3).max(t145)),
                            t119 + ((((t24 + t25) - t90) - t96) / (l2 + l3).max(t145)),
                        ],
                    }
                }
            }
        }
        #[inline(always)]
        fn admits<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> R::Mask {
            match self.inversion {
                __p::Inversion::Refuse => R::splat(0.0).less(l3),
                __p::Inversion::Extend { .. } => __p::Mask::splat(true),
            }
        }
        #[inline]
        fn has_pole(&self) -> bool {
            self.inversion != __p::Inversion::Refuse
        }
        #[inline]
        fn ends_at_zero_volume(&self) -> bool {
            self.inversion == __p::Inversion::Refuse
        }
        #[inline]
        fn inversion(&self) -> __p::Inversion {
            self.inversion
        }
        #[allow(unused_imports)]
        fn stated_moduli(&self) -> __p::Option<__p::Moduli> {
            use ::piola::Real;
            type R = f64;
            let mut t0 = R::splat(0.0);
            for p in 0..N {
                let mu: R = __p::ParameterValue::on(&self.mu[p]);
                let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                let t1 = mu * alpha;
                t0 = t0 + t1;
            }
            let kappa: R = __p::ParameterValue::on(&self.kappa);
            __p::stated_moduli(t0 * R::splat(0.5), kappa)
        }
    }
    impl<const N: usize> __p::Graded for Ogden<N> {
        type OnLanes<'lanes> = Ogden<N, __p::PerLane>;
        #[inline(always)]
        fn on_lanes<'lanes>(
            material: impl ::core::ops::Fn(usize) -> &'lanes Self + ::core::marker::Copy,
        ) -> Self::OnLanes<'lanes>
        where
            Self: 'lanes,
        {
            Ogden {
                mu: ::core::array::from_fn(|k| __p::PerLane::gather(|lane| {
                    material(lane).mu[k]
                })),
                alpha: ::core::array::from_fn(|k| __p::PerLane::gather(|lane| {
                    material(lane).alpha[k]
                })),
                kappa: __p::PerLane::gather(|lane| material(lane).kappa),
                inversion: material(0).inversion,
            }
        }
    }
    impl<const N: usize> __p::Declared for Ogden<N> {
        const DESCRIPTION: __p::Description = __p::Description {
            name: __p::Borrowed("Ogden"),
            summary: __p::Borrowed(
                "Compressible Ogden solid with N terms: rubber at large strain.",
            ),
            formula: __p::Borrowed(
                "Σₚ μₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3)/αₚ + 1/2 κ (J − 1)² − (Σₚ μₚ) ln J",
            ),
            parameters: __p::Borrowed(
                &[
                    __p::Parameter {
                        name: __p::Borrowed("mu"),
                        doc: __p::Borrowed("Moduli μₚ, Pa."),
                        unit: Some(__p::Unit::Pascal),
                        form: __p::Form::List,
                    },
                    __p::Parameter {
                        name: __p::Borrowed("alpha"),
                        doc: __p::Borrowed("Exponents αₚ, dimensionless."),
                        unit: Some(__p::Unit::Dimensionless),
                        form: __p::Form::List,
                    },
                    __p::Parameter {
                        name: __p::Borrowed("kappa"),
                        doc: __p::Borrowed("Volumetric modulus κ, Pa."),
                        unit: Some(__p::Unit::Pascal),
                        form: __p::Form::Number,
                    },
                ],
            ),
            domain: __p::Borrowed("J > 0"),
            extends: true,
            refusal: None,
            admissible: __p::Borrowed(&[__p::Borrowed("alpha[p] != 0")]),
            moduli: [__p::Borrowed("1/2 Σₚ μₚ αₚ"), __p::Borrowed("κ")],
            typical: Some(__p::Typical {
                values: __p::Borrowed(
                    &[
                        __p::Borrowed(&[630000.0, 1200.0, -10000.0]),
                        __p::Borrowed(&[1.3, 5.0, -2.0]),
                        __p::Borrowed(&[20000000.0]),
                    ],
                ),
                source: __p::Borrowed("natural rubber, the three terms of the source"),
            }),
        };
        fn from_values(
            values: &[&[f64]],
            inversion: __p::Inversion,
        ) -> __p::Result<Self, __p::MaterialError> {
            let mut values = __p::Values::new(values, &["mu", "alpha", "kappa"])?;
            Self::new(values.list()?, values.list()?, values.number()?)?
                .with_inversion(inversion)
        }
    }
    impl<const N: usize> __p::Fittable for Ogden<N> {
        fn values(&self) -> __p::Vec<__p::Vec<f64>> {
            ::std::vec![self.mu.to_vec(), self.alpha.to_vec(), ::std::vec![self.kappa]]
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn gradient_by_parameters(&self, [l1, l2, l3]: [f64; 3]) -> __p::Vec<[f64; 3]> {
            use ::piola::Real;
            type R = f64;
            let mut derivatives: [__p::Vec<[f64; 3]>; 3] = [const {
                __p::Vec::new()
            }; 3];
            let t0 = l2 * l1;
            let t1 = l3.mul_add(t0, -R::splat(1.0));
            derivatives[2].push([t1 * (l2 * l3), t1 * (l3 * l1), t0 * t1]);
            for p in 0..N {
                let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                let t0 = alpha - R::splat(1.0);
                let t2 = R::power(l1.logarithm(), t0);
                let t4 = t2 - (R::splat(1.0) / l1);
                let t6 = R::power(l2.logarithm(), t0);
                let t8 = t6 - (R::splat(1.0) / l2);
                let t10 = R::power(l3.logarithm(), t0);
                let mu: R = __p::ParameterValue::on(&self.mu[p]);
                derivatives[0].push([t4, t8, t10 - (R::splat(1.0) / l3)]);
                derivatives[1]
                    .push([
                        t2 * (mu * l1.ln()),
                        t6 * (mu * l2.ln()),
                        t10 * (mu * l3.ln()),
                    ]);
            }
            derivatives.concat()
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn constraints(&self) -> __p::Vec<__p::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = __p::Constraint::all(
                [__p::Limit::ShearModulus, __p::Limit::BulkModulus],
                {
                    let mut t0 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let t1 = mu * alpha;
                        t0 = t0 + t1;
                    }
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    [t0 * R::splat(0.5), t0.mul_add(R::splat(0.3333333333333333), kappa)]
                },
                {
                    let mut derivatives: [__p::Vec<[f64; 2]>; 3] = [const {
                        __p::Vec::new()
                    }; 3];
                    derivatives[2].push([R::splat(0.0), R::splat(1.0)]);
                    for p in 0..N {
                        let alpha: R = __p::ParameterValue::on(&self.alpha[p]);
                        let mu: R = __p::ParameterValue::on(&self.mu[p]);
                        derivatives[0]
                            .push([
                                alpha * R::splat(0.5),
                                alpha * R::splat(0.3333333333333333),
                            ]);
                        derivatives[1]
                            .push([
                                R::splat(0.5) * mu,
                                R::splat(0.3333333333333333) * mu,
                            ]);
                    }
                    derivatives.concat()
                },
            );
            constraints
        }
    }
};
