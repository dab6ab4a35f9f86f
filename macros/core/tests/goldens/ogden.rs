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
/// A fused multiplication and addition counts as two operations, a loop over lists of length N as N times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a multiplication: ÷ divisions, √ roots, ln, exp, pow real powers, Δ divided differences, f functions that are parameters.
#[derive(Clone, Debug, PartialEq)]
#[derive(Copy)]
pub struct Ogden<const N: usize, P = f64> {
    mu: [P; N],
    alpha: [P; N],
    kappa: P,
    inversion: ::piola::Inversion,
}
impl<const N: usize> Ogden<N> {
    /// The material with these parameters.
    ///
    /// * `mu`: Moduli μₚ, Pa.
    /// * `alpha`: Exponents αₚ, dimensionless.
    /// * `kappa`: Volumetric modulus κ, Pa.
    ///
    /// # Errors
    /// Where a parameter is not finite or not admissible.
    #[allow(clippy::too_many_arguments)]
    pub fn new(
        mu: [f64; N],
        alpha: [f64; N],
        kappa: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        for (index, value) in mu.into_iter().enumerate() {
            if !value.is_finite() {
                return Err(::piola::material::Inadmissible::NotFinite {
                    given: ::piola::material::Given::entry("mu", index, value),
                });
            }
        }
        for (index, value) in alpha.into_iter().enumerate() {
            if !value.is_finite() {
                return Err(::piola::material::Inadmissible::NotFinite {
                    given: ::piola::material::Given::entry("alpha", index, value),
                });
            }
        }
        if !kappa.is_finite() {
            return Err(::piola::material::Inadmissible::NotFinite {
                given: ::piola::material::Given::scalar("kappa", kappa),
            });
        }
        for p in 0..alpha.len() {
            #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
            if !(alpha[p] != 0f64) {
                return Err(::piola::material::Inadmissible::Violated {
                    condition: "alpha[p] != 0",
                    given: ::std::vec![
                        ::piola::material::Given::entry("alpha", p, alpha[p])
                    ],
                });
            }
        }
        let material = Self {
            mu,
            alpha,
            kappa,
            inversion: ::piola::Inversion::Refuse,
        };
        let moduli = ::piola::material::Declared::moduli(&material);
        if !(moduli.mu > 0.0 && moduli.bulk() >= 0.0 && moduli.bulk().is_finite()) {
            return Err(::piola::material::Inadmissible::UnstableRest {
                moduli,
            });
        }
        Ok(material)
    }
    /// Replaces what the material does outside its domain.
    ///
    /// # Errors
    /// Where the extension would not restore, or its threshold is outside 0 < ε < 1.
    pub fn with_inversion(
        mut self,
        inversion: ::piola::Inversion,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        if let ::piola::Inversion::Extend { epsilon } = inversion {
            if !(epsilon > 0.0 && epsilon < 1.0) {
                return Err(::piola::material::Inadmissible::Threshold {
                    epsilon,
                });
            }
            #[allow(unused_variables)]
            let Self { mu, alpha, kappa, .. } = self;
            for p in 0..mu.len() {
                #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
                if !(mu[p] * alpha[p] > 0f64) {
                    return Err(::piola::material::Inadmissible::DoesNotRestore {
                        condition: "mu[p] * alpha[p] > 0",
                        given: ::std::vec![
                            ::piola::material::Given::entry("mu", p, mu[p]),
                            ::piola::material::Given::entry("alpha", p, alpha[p])
                        ],
                    });
                }
            }
            #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
            if !(kappa >= 0f64) {
                return Err(::piola::material::Inadmissible::DoesNotRestore {
                    condition: "kappa >= 0",
                    given: ::std::vec![::piola::material::Given::scalar("kappa", kappa)],
                });
            }
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
    pub fn with_mu(
        self,
        mu: [f64; N],
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
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
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        Self::new(self.mu, alpha, self.kappa)?.with_inversion(self.inversion)
    }
    /// Replaces `kappa`.
    ///
    /// # Errors
    /// If the parameters are not admissible together, as of `new`.
    #[allow(dead_code)]
    pub fn with_kappa(
        self,
        kappa: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        Self::new(self.mu, self.alpha, kappa)?.with_inversion(self.inversion)
    }
}
const _: () = {
    use ::piola::__private as __piola;
    #[allow(unused_variables, clippy::all)]
    impl<const N: usize, P: __piola::ParameterValue> ::piola::Material for Ogden<N, P> {
        #[inline(always)]
        fn energy<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> R {
            match self.inversion {
                ::piola::Inversion::Refuse => {
                    let t0 = l1.logarithm();
                    let t1 = l2.logarithm();
                    let t2 = l3.logarithm();
                    let mut t3 = R::splat(0.0);
                    let mut t4 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                        let t5 = R::splat(1.0) / alpha;
                        let t6 = R::power(t0, alpha);
                        let t7 = R::power(t1, alpha);
                        let t8 = t6 + t7;
                        let t9 = R::power(t2, alpha);
                        let t10 = t8 + t9;
                        let t11 = t10 - R::splat(3.0);
                        let t12 = mu * t5;
                        let t13 = t11 * t12;
                        t3 = t3 + t13;
                        t4 = t4 + mu;
                    }
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t14 = l1 * l2;
                    let t15 = l3.mul_add(t14, -R::splat(1.0));
                    let t16 = kappa * t15;
                    let t17 = t15 * t16;
                    let t18 = t17.mul_add(R::splat(0.5), t3);
                    let t19 = __piola::ln_product([l1, l2, l3]);
                    let t20 = (-t4).mul_add(t19, t18);
                    t20
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
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
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                        let t17 = R::splat(1.0) / alpha;
                        let t18 = R::power(t1, alpha);
                        let t19 = t18 * t3;
                        let t20 = alpha * t2;
                        let t21 = t19.mul_add(t20, t18);
                        let t22 = alpha - R::splat(1.0);
                        let t23 = t18 * t4;
                        let t24 = alpha * t22;
                        let t25 = t2 * t24;
                        let t26 = t2 * t25;
                        let t27 = t23 * t26;
                        let t28 = R::power(t7, alpha);
                        let t29 = t28 * t9;
                        let t30 = t24 * t5;
                        let t31 = t5 * t30;
                        let t32 = t29.mul_add(t31, t27);
                        let t33 = R::power(t12, alpha);
                        let t34 = t33 * t14;
                        let t35 = t24 * t10;
                        let t36 = t10 * t35;
                        let t37 = t34.mul_add(t36, t32);
                        let t38 = t37.mul_add(R::splat(0.5), t21);
                        let t39 = t28 + t38;
                        let t40 = t28 * t8;
                        let t41 = alpha * t5;
                        let t42 = t40.mul_add(t41, t39);
                        let t43 = t33 + t42;
                        let t44 = t33 * t13;
                        let t45 = alpha * t10;
                        let t46 = t44.mul_add(t45, t43);
                        let t47 = t46 - R::splat(3.0);
                        let t48 = mu * t17;
                        let t49 = t47 * t48;
                        t15 = t15 + t49;
                        t16 = t16 + mu;
                    }
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t50 = l1 * l2;
                    let t51 = l3.mul_add(t50, -R::splat(1.0));
                    let t52 = kappa * t51;
                    let t53 = t51 * t52;
                    let t54 = R::splat(0.5).mul_add(t53, t15);
                    let t55 = t0.ln();
                    let t56 = t2.mul_add(t3, t55);
                    let t57 = t6.ln();
                    let t58 = t56 + t57;
                    let t59 = t5.mul_add(t8, t58);
                    let t60 = t11.ln();
                    let t61 = t59 + t60;
                    let t62 = t10.mul_add(t13, t61);
                    let t63 = t2 * t2;
                    let t64 = t3 * t63;
                    let t65 = t3 * t64;
                    let t66 = t5 * t5;
                    let t67 = t8 * t66;
                    let t68 = t8.mul_add(t67, t65);
                    let t69 = t10 * t10;
                    let t70 = t13 * t69;
                    let t71 = t13.mul_add(t70, t68);
                    let t72 = (-R::splat(0.5)).mul_add(t71, t62);
                    let t73 = (-t16).mul_add(t72, t54);
                    t73
                }
            }
        }
        #[inline(always)]
        fn gradient<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> [R; 3] {
            match self.inversion {
                ::piola::Inversion::Refuse => {
                    let t0 = l1.logarithm();
                    let t1 = l2.logarithm();
                    let t2 = l3.logarithm();
                    let mut t3 = R::splat(0.0);
                    let mut t4 = R::splat(0.0);
                    let mut t5 = R::splat(0.0);
                    let mut t6 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                        let t7 = alpha - R::splat(1.0);
                        let t8 = R::power(t0, t7);
                        let t9 = mu * t8;
                        let t10 = R::power(t1, t7);
                        let t11 = mu * t10;
                        let t12 = R::power(t2, t7);
                        let t13 = mu * t12;
                        t3 = t3 + t9;
                        t4 = t4 + mu;
                        t5 = t5 + t11;
                        t6 = t6 + t13;
                    }
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t14 = l1 * l2;
                    let t15 = l3.mul_add(t14, -R::splat(1.0));
                    let t16 = l2 * kappa;
                    let t17 = l3 * t16;
                    let t18 = t15.mul_add(t17, t3);
                    let t19 = R::splat(1.0) / l1;
                    let t20 = (-t4).mul_add(t19, t18);
                    let t21 = l1 * kappa;
                    let t22 = l3 * t21;
                    let t23 = t15.mul_add(t22, t5);
                    let t24 = R::splat(1.0) / l2;
                    let t25 = (-t4).mul_add(t24, t23);
                    let t26 = l2 * t21;
                    let t27 = t15.mul_add(t26, t6);
                    let t28 = R::splat(1.0) / l3;
                    let t29 = (-t4).mul_add(t28, t27);
                    [t20, t25, t29]
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
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
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                        let t16 = R::splat(1.0) / alpha;
                        let t17 = alpha - R::splat(1.0);
                        let t18 = R::power(t1, t17);
                        let t19 = alpha * t18;
                        let t20 = t18 * t3;
                        let t21 = alpha * t17;
                        let t22 = t2 * t21;
                        let t23 = t20.mul_add(t22, t19);
                        let t24 = mu * t16;
                        let t25 = t23 * t24;
                        let t26 = R::power(t5, t17);
                        let t27 = alpha * t26;
                        let t28 = t26 * t7;
                        let t29 = t21 * t6;
                        let t30 = t28.mul_add(t29, t27);
                        let t31 = t24 * t30;
                        let t32 = R::power(t9, t17);
                        let t33 = alpha * t32;
                        let t34 = t32 * t11;
                        let t35 = t21 * t10;
                        let t36 = t34.mul_add(t35, t33);
                        let t37 = t24 * t36;
                        t12 = t12 + t25;
                        t13 = t13 + mu;
                        t14 = t14 + t31;
                        t15 = t15 + t37;
                    }
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t38 = l1 * l2;
                    let t39 = l3.mul_add(t38, -R::splat(1.0));
                    let t40 = l2 * kappa;
                    let t41 = l3 * t40;
                    let t42 = t39.mul_add(t41, t12);
                    let t43 = t2 * t3;
                    let t44 = (-t3).mul_add(t43, t3);
                    let t45 = (-t13).mul_add(t44, t42);
                    let t46 = l1 * kappa;
                    let t47 = l3 * t46;
                    let t48 = t39.mul_add(t47, t14);
                    let t49 = t6 * t7;
                    let t50 = (-t7).mul_add(t49, t7);
                    let t51 = (-t13).mul_add(t50, t48);
                    let t52 = l2 * t46;
                    let t53 = t39.mul_add(t52, t15);
                    let t54 = t10 * t11;
                    let t55 = (-t11).mul_add(t54, t11);
                    let t56 = (-t13).mul_add(t55, t53);
                    [t45, t51, t56]
                }
            }
        }
        #[inline(always)]
        fn gradient_at_strains<R: ::piola::Real>(&self, strains: [R; 3]) -> [R; 3] {
            let [l1, l2, l3] = [
                R::splat(1.0) + strains[0],
                R::splat(1.0) + strains[1],
                R::splat(1.0) + strains[2],
            ];
            let t0 = R::splat(1.0) / l1;
            let t1 = l1.logarithm();
            let t2 = R::splat(1.0).logarithm();
            let t3 = __piola::Pair::new(
                [l1, R::splat(1.0)],
                [t0, R::splat(1.0)],
                [t1, t2],
            );
            let t4 = R::splat(1.0) / l2;
            let t5 = l2.logarithm();
            let t6 = __piola::Pair::new(
                [l2, R::splat(1.0)],
                [t4, R::splat(1.0)],
                [t5, t2],
            );
            let t7 = R::splat(1.0) / l3;
            let t8 = l3.logarithm();
            let t9 = __piola::Pair::new(
                [l3, R::splat(1.0)],
                [t7, R::splat(1.0)],
                [t8, t2],
            );
            let mut t10 = R::splat(0.0);
            let mut t11 = R::splat(0.0);
            let mut t12 = R::splat(0.0);
            let mut t13 = R::splat(0.0);
            for p in 0..N {
                let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                let t14 = alpha - R::splat(1.0);
                let t15 = R::power(t1, t14);
                let t16 = t3.power_quotient([t15, R::splat(1.0)], t14);
                let t17 = strains[0] * mu;
                let t18 = t16 * t17;
                let t19 = R::power(t5, t14);
                let t20 = t6.power_quotient([t19, R::splat(1.0)], t14);
                let t21 = mu * strains[1];
                let t22 = t20 * t21;
                let t23 = R::power(t8, t14);
                let t24 = t9.power_quotient([t23, R::splat(1.0)], t14);
                let t25 = mu * strains[2];
                let t26 = t24 * t25;
                t10 = t10 + t18;
                t11 = t11 + mu;
                t12 = t12 + t22;
                t13 = t13 + t26;
            }
            let t27 = strains[0] * t11;
            let t28 = t0.mul_add(t27, t10);
            let kappa: R = __piola::ParameterValue::on(&self.kappa);
            let t29 = strains[1].mul_add(l3, strains[2]);
            let t30 = strains[0] * l2;
            let t31 = l3.mul_add(t30, t29);
            let t32 = kappa * t31;
            let t33 = t28 + t32;
            let t34 = l2 * l3;
            let t35 = l1.mul_add(t34, -R::splat(1.0));
            let t36 = strains[2] * kappa;
            let t37 = t35 * t36;
            let t38 = t33 + t37;
            let t39 = strains[1] * kappa;
            let t40 = l3 * t39;
            let t41 = t35.mul_add(t40, t38);
            let t42 = t32 + t37;
            let t43 = t12 + t42;
            let t44 = strains[1] * t11;
            let t45 = t4.mul_add(t44, t43);
            let t46 = strains[0] * kappa;
            let t47 = l3 * t46;
            let t48 = t35.mul_add(t47, t45);
            let t49 = t13 + t32;
            let t50 = strains[2] * t11;
            let t51 = t7.mul_add(t50, t49);
            let t52 = t35.mul_add(t39, t51);
            let t53 = l2 * t46;
            let t54 = t35.mul_add(t53, t52);
            let inside = [t41, t48, t54];
            if let ::piola::Inversion::Extend { epsilon: epsilon } = self.inversion {
                let below = strains[2].less(R::splat(epsilon - 1.0));
                if __piola::Mask::any(below) {
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
        fn blocks<R: ::piola::Real>(
            &self,
            [l1,
            l2,
            l3,
            ]: [R; 3],
        ) -> ::piola::material::Blocks<R> {
            match self.inversion {
                ::piola::Inversion::Refuse => {
                    let t0 = l1.logarithm();
                    let t1 = l2.logarithm();
                    let t2 = l3.logarithm();
                    let t3 = R::splat(1.0) / l1;
                    let t4 = R::splat(1.0) / l2;
                    let t5 = __piola::Pair::new([l1, l2], [t3, t4], [t0, t1]);
                    let t6 = R::splat(1.0) / l3;
                    let t7 = __piola::Pair::new([l1, l3], [t3, t6], [t0, t2]);
                    let t8 = __piola::Pair::new([l2, l3], [t4, t6], [t1, t2]);
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
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
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
                        let t30 = t5.power_quotient([t20, t22], t19);
                        let t31 = mu * t30;
                        let t32 = t7.power_quotient([t20, t24], t19);
                        let t33 = mu * t32;
                        let t34 = t8.power_quotient([t22, t24], t19);
                        let t35 = mu * t34;
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
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t36 = l1 * l2;
                    let t37 = l3.mul_add(t36, -R::splat(1.0));
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
                    let t52 = t3 * t41;
                    let t53 = l2 * t39;
                    let t54 = l3.mul_add(t53, t52);
                    let t55 = t3.mul_add(t13, t54);
                    let t56 = t4 * t46;
                    let t57 = l1 * t44;
                    let t58 = l3.mul_add(t57, t56);
                    let t59 = t4.mul_add(t14, t58);
                    let t60 = t6 * t50;
                    let t61 = l1 * t48;
                    let t62 = l2.mul_add(t61, t60);
                    let t63 = t6.mul_add(t15, t62);
                    let t64 = l3 * kappa;
                    let t65 = t37 * t64;
                    let t66 = l3 * t48;
                    let t67 = l3.mul_add(t66, t65);
                    let t68 = t37 * t38;
                    let t69 = l2.mul_add(t66, t68);
                    let t70 = t37 * t43;
                    let t71 = l1.mul_add(t66, t70);
                    let t72 = t4 * t41;
                    let t73 = t16 + t72;
                    let t74 = t73 - t65;
                    let t75 = t6 * t41;
                    let t76 = t17 + t75;
                    let t77 = t76 - t68;
                    let t78 = t6 * t46;
                    let t79 = t18 + t78;
                    let t80 = t79 - t70;
                    let t81 = t9 + t11;
                    let t82 = l1 + l2;
                    let t83 = R::splat(1.0) / t82;
                    let t84 = t81.mul_add(t83, t65);
                    let t85 = t84 - t72;
                    let t86 = t9 + t12;
                    let t87 = l1 + l3;
                    let t88 = R::splat(1.0) / t87;
                    let t89 = t86.mul_add(t88, t68);
                    let t90 = t89 - t75;
                    let t91 = t11 + t12;
                    let t92 = l2 + l3;
                    let t93 = R::splat(1.0) / t92;
                    let t94 = t91.mul_add(t93, t70);
                    let t95 = t94 - t78;
                    ::piola::material::Blocks {
                        gradient: [t42, t47, t51],
                        hessian: [t55, t59, t63, t67, t69, t71],
                        flip: [t74, t77, t80],
                        twist: [t85, t90, t95],
                    }
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
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
                    let t12 = __piola::share_above(l1, l2, epsilon);
                    let t13 = __piola::Pair::new([t0, t4], [t3, t7], [t1, t5]);
                    let t14 = epsilon.logarithm();
                    let t15 = __piola::share_below(l1, l2, epsilon);
                    let t16 = __piola::share_above(l1, l3, epsilon);
                    let t17 = __piola::Pair::new([t0, t8], [t3, t11], [t1, t9]);
                    let t18 = __piola::share_below(l1, l3, epsilon);
                    let t19 = __piola::share_above(l2, l3, epsilon);
                    let t20 = __piola::Pair::new([t4, t8], [t7, t11], [t5, t9]);
                    let t21 = __piola::share_below(l2, l3, epsilon);
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
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                        let t32 = R::splat(1.0) / alpha;
                        let t33 = alpha - R::splat(1.0);
                        let t34 = R::power(t1, t33);
                        let t35 = alpha * t34;
                        let t36 = t34 * t3;
                        let t37 = alpha * t33;
                        let t38 = t2 * t37;
                        let t39 = t36.mul_add(t38, t35);
                        let t40 = mu * t32;
                        let t41 = t39 * t40;
                        let t42 = R::power(t5, t33);
                        let t43 = alpha * t42;
                        let t44 = t42 * t7;
                        let t45 = t37 * t6;
                        let t46 = t44.mul_add(t45, t43);
                        let t47 = t40 * t46;
                        let t48 = R::power(t9, t33);
                        let t49 = alpha * t48;
                        let t50 = t48 * t11;
                        let t51 = t37 * t10;
                        let t52 = t50.mul_add(t51, t49);
                        let t53 = t40 * t52;
                        let t54 = mu * t33;
                        let t55 = t34 * t54;
                        let t56 = t42 * t54;
                        let t57 = t48 * t54;
                        let t58 = t13.power_quotient([t34, t42], t33);
                        let t59 = alpha * t12;
                        let t60 = t58 * t59;
                        let t61 = alpha - R::splat(2.0);
                        let t62 = R::power(t14, t61);
                        let t63 = t37 * t62;
                        let t64 = t15.mul_add(t63, t60);
                        let t65 = t40 * t64;
                        let t66 = t17.power_quotient([t34, t48], t33);
                        let t67 = alpha * t16;
                        let t68 = t66 * t67;
                        let t69 = t63.mul_add(t18, t68);
                        let t70 = t40 * t69;
                        let t71 = t20.power_quotient([t42, t48], t33);
                        let t72 = alpha * t19;
                        let t73 = t71 * t72;
                        let t74 = t63.mul_add(t21, t73);
                        let t75 = t40 * t74;
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
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t76 = l1 * l2;
                    let t77 = l3.mul_add(t76, -R::splat(1.0));
                    let t78 = l2 * kappa;
                    let t79 = l3 * t78;
                    let t80 = t77.mul_add(t79, t22);
                    let t81 = t2 * t3;
                    let t82 = (-t3).mul_add(t81, t3);
                    let t83 = t23 * t82;
                    let t84 = t80 - t83;
                    let t85 = l1 * kappa;
                    let t86 = l3 * t85;
                    let t87 = t77.mul_add(t86, t24);
                    let t88 = t6 * t7;
                    let t89 = (-t7).mul_add(t88, t7);
                    let t90 = t23 * t89;
                    let t91 = t87 - t90;
                    let t92 = l2 * t85;
                    let t93 = t77.mul_add(t92, t25);
                    let t94 = t10 * t11;
                    let t95 = (-t11).mul_add(t94, t11);
                    let t96 = t23 * t95;
                    let t97 = t93 - t96;
                    let t98 = l2 * t79;
                    let t99 = l3 * t98;
                    let t100 = t3 * t23;
                    let t101 = t3.mul_add(t100, t99);
                    let t102 = t3.mul_add(t26, t101);
                    let t103 = l1 * t86;
                    let t104 = l3 * t103;
                    let t105 = t7 * t23;
                    let t106 = t7.mul_add(t105, t104);
                    let t107 = t7.mul_add(t27, t106);
                    let t108 = l1 * t92;
                    let t109 = l2 * t108;
                    let t110 = t11 * t23;
                    let t111 = t11.mul_add(t110, t109);
                    let t112 = t11.mul_add(t28, t111);
                    let t113 = l3 * kappa;
                    let t114 = t77 * t113;
                    let t115 = l3 * t92;
                    let t116 = l3.mul_add(t115, t114);
                    let t117 = t77 * t78;
                    let t118 = l2.mul_add(t115, t117);
                    let t119 = t77 * t85;
                    let t120 = l1.mul_add(t115, t119);
                    let t121 = t29 - t114;
                    let t122 = t3 * t12;
                    let t123 = t7 * t122;
                    let t124 = -t123;
                    let t125 = R::splat(1.0) / epsilon;
                    let t126 = t125 * t125;
                    let t127 = (-t15).mul_add(t126, t124);
                    let t128 = (-t23).mul_add(t127, t121);
                    let t129 = t30 - t117;
                    let t130 = t3 * t16;
                    let t131 = t11 * t130;
                    let t132 = -t131;
                    let t133 = (-t18).mul_add(t126, t132);
                    let t134 = (-t23).mul_add(t133, t129);
                    let t135 = t31 - t119;
                    let t136 = t7 * t19;
                    let t137 = t11 * t136;
                    let t138 = -t137;
                    let t139 = (-t21).mul_add(t126, t138);
                    let t140 = (-t23).mul_add(t139, t135);
                    let t141 = t22 + t24;
                    let t142 = t141 - t83;
                    let t143 = t142 - t90;
                    let t144 = l1 + l2;
                    let t145 = __piola::pole_floor([l1, l2, l3]);
                    let t146 = t144.max(t145);
                    let t147 = t143 / t146;
                    let t148 = t114 + t147;
                    let t149 = t22 + t25;
                    let t150 = t149 - t83;
                    let t151 = t150 - t96;
                    let t152 = l1 + l3;
                    let t153 = t152.max(t145);
                    let t154 = t151 / t153;
                    let t155 = t117 + t154;
                    let t156 = t24 + t25;
                    let t157 = t156 - t90;
                    let t158 = t157 - t96;
                    let t159 = l2 + l3;
                    let t160 = t159.max(t145);
                    let t161 = t158 / t160;
                    let t162 = t119 + t161;
                    ::piola::material::Blocks {
                        gradient: [t84, t91, t97],
                        hessian: [t102, t107, t112, t116, t118, t120],
                        flip: [t128, t134, t140],
                        twist: [t148, t155, t162],
                    }
                }
            }
        }
        #[inline(always)]
        fn admits<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> R::Mask {
            match self.inversion {
                ::piola::Inversion::Refuse => R::splat(0.0).less(l3),
                ::piola::Inversion::Extend { .. } => __piola::Mask::splat(true),
            }
        }
        #[inline]
        fn has_pole(&self) -> bool {
            match self.inversion {
                ::piola::Inversion::Refuse => false,
                ::piola::Inversion::Extend { .. } => true,
            }
        }
        #[inline]
        fn ends_at_zero_volume(&self) -> bool {
            ::core::matches!(self.inversion, ::piola::Inversion::Refuse)
        }
        #[inline]
        fn inversion(&self) -> ::piola::Inversion {
            self.inversion
        }
        #[allow(unused_imports)]
        fn stated_moduli(&self) -> ::core::option::Option<::piola::material::Moduli> {
            use ::piola::Real;
            type R = f64;
            let mut t0 = R::splat(0.0);
            for p in 0..N {
                let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                let t1 = mu * alpha;
                t0 = t0 + t1;
            }
            let t2 = t0 * R::splat(0.5);
            let kappa: R = __piola::ParameterValue::on(&self.kappa);
            ::core::option::Option::Some(::piola::material::Moduli {
                mu: t2,
                lambda: kappa,
            })
        }
    }
    impl<const N: usize> ::piola::material::Graded for Ogden<N> {
        type OnLanes = Ogden<N, __piola::PerLane>;
        #[inline(always)]
        fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes
        where
            Self: 'a,
        {
            Ogden {
                mu: ::core::array::from_fn(|k| __piola::PerLane::gather(|lane| {
                    material(lane).mu[k]
                })),
                alpha: ::core::array::from_fn(|k| __piola::PerLane::gather(|lane| {
                    material(lane).alpha[k]
                })),
                kappa: __piola::PerLane::gather(|lane| material(lane).kappa),
                inversion: material(0).inversion,
            }
        }
    }
    impl<const N: usize> ::piola::material::Declared for Ogden<N> {
        const DESCRIPTION: ::piola::material::Description = ::piola::material::Description {
            name: "Ogden",
            summary: "Compressible Ogden solid with N terms: rubber at large strain.",
            formula: "Σₚ μₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3)/αₚ + 1/2 κ (J − 1)² − (Σₚ μₚ) ln J",
            parameters: &[
                ::piola::material::Parameter {
                    name: "mu",
                    doc: "Moduli μₚ, Pa.",
                    unit: ::core::option::Option::Some(::piola::material::Unit::Pascal),
                    form: ::piola::material::Form::List,
                },
                ::piola::material::Parameter {
                    name: "alpha",
                    doc: "Exponents αₚ, dimensionless.",
                    unit: ::core::option::Option::Some(
                        ::piola::material::Unit::Dimensionless,
                    ),
                    form: ::piola::material::Form::List,
                },
                ::piola::material::Parameter {
                    name: "kappa",
                    doc: "Volumetric modulus κ, Pa.",
                    unit: ::core::option::Option::Some(::piola::material::Unit::Pascal),
                    form: ::piola::material::Form::Number,
                },
            ],
            domain: "J > 0",
            extends: true,
            refusal: ::core::option::Option::None,
            admissible: &["alpha[p] != 0"],
            moduli: ["1/2 Σₚ μₚ αₚ", "κ"],
            typical: ::core::option::Option::Some(::piola::material::Typical {
                values: &[
                    &[630000.0, 1200.0, -10000.0],
                    &[1.3, 5.0, -2.0],
                    &[20000000.0],
                ],
                source: "natural rubber, the three terms of the source",
            }),
        };
        fn from_values(
            values: &[&[f64]],
            inversion: ::piola::Inversion,
        ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
            let &[mu, alpha, kappa] = values else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "3 parameters are expected: `mu`, `alpha`, `kappa`"
                        .to_owned(),
                });
            };
            let Ok(mu) = <[f64; N]>::try_from(mu) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: ::std::format!("`mu` must have {} entries", N),
                });
            };
            let Ok(alpha) = <[f64; N]>::try_from(alpha) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: ::std::format!("`alpha` must have {} entries", N),
                });
            };
            let Ok([kappa]) = <[f64; 1]>::try_from(kappa) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "`kappa` must be one number".to_owned(),
                });
            };
            Self::new(mu, alpha, kappa)?.with_inversion(inversion)
        }
    }
    impl<const N: usize> ::piola::material::Fittable for Ogden<N> {
        fn values(&self) -> ::std::vec::Vec<::std::vec::Vec<f64>> {
            ::std::vec![self.mu.to_vec(), self.alpha.to_vec(), ::std::vec![self.kappa]]
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn gradient_by_parameters(
            &self,
            [l1,
            l2,
            l3,
            ]: [f64; 3],
        ) -> ::std::vec::Vec<[f64; 3]> {
            use ::piola::Real;
            type R = f64;
            let mut derivatives: [::std::vec::Vec<[f64; 3]>; 3] = [const {
                ::std::vec::Vec::new()
            }; 3];
            let t0 = l2 * l1;
            let t1 = l3.mul_add(t0, -R::splat(1.0));
            let t2 = l2 * l3;
            let t3 = t1 * t2;
            let t4 = l3 * l1;
            let t5 = t1 * t4;
            let t6 = t0 * t1;
            derivatives[2].push([t3, t5, t6]);
            for p in 0..N {
                let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                let t0 = alpha - R::splat(1.0);
                let t1 = l1.logarithm();
                let t2 = R::power(t1, t0);
                let t3 = R::splat(1.0) / l1;
                let t4 = t2 - t3;
                let t5 = l2.logarithm();
                let t6 = R::power(t5, t0);
                let t7 = R::splat(1.0) / l2;
                let t8 = t6 - t7;
                let t9 = l3.logarithm();
                let t10 = R::power(t9, t0);
                let t11 = R::splat(1.0) / l3;
                let t12 = t10 - t11;
                let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                let t13 = l1.ln();
                let t14 = mu * t13;
                let t15 = t2 * t14;
                let t16 = l2.ln();
                let t17 = mu * t16;
                let t18 = t6 * t17;
                let t19 = l3.ln();
                let t20 = mu * t19;
                let t21 = t10 * t20;
                derivatives[0].push([t4, t8, t12]);
                derivatives[1].push([t15, t18, t21]);
            }
            derivatives.concat()
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn constraints(&self) -> ::std::vec::Vec<::piola::material::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = ::piola::material::Constraint::all(
                [
                    ::piola::material::Limit::ShearModulus,
                    ::piola::material::Limit::BulkModulus,
                ],
                {
                    let mut t0 = R::splat(0.0);
                    for p in 0..N {
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                        let t1 = mu * alpha;
                        t0 = t0 + t1;
                    }
                    let t2 = t0 * R::splat(0.5);
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t3 = t0.mul_add(R::splat(0.3333333333333333), kappa);
                    [t2, t3]
                },
                {
                    let mut derivatives: [::std::vec::Vec<[f64; 2]>; 3] = [const {
                        ::std::vec::Vec::new()
                    }; 3];
                    derivatives[2].push([R::splat(0.0), R::splat(1.0)]);
                    for p in 0..N {
                        let alpha: R = __piola::ParameterValue::on(&self.alpha[p]);
                        let t0 = alpha * R::splat(0.5);
                        let t1 = alpha * R::splat(0.3333333333333333);
                        let mu: R = __piola::ParameterValue::on(&self.mu[p]);
                        let t2 = R::splat(0.5) * mu;
                        let t3 = R::splat(0.3333333333333333) * mu;
                        derivatives[0].push([t0, t1]);
                        derivatives[1].push([t2, t3]);
                    }
                    derivatives.concat()
                },
            );
            constraints
        }
    }
};
