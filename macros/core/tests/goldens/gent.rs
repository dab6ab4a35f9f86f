/// Gent solid: rubber that locks where I1 − 3 reaches Jm.
///
/// ψ = −μ Jm/2 ln(1 − (I1 − 3)/Jm) − μ ln J + κ/2 (J − 1)².
///
/// Gent, *A New Constitutive Relation for Rubber*, 1996, eq. 2, for the first term; the source is
/// incompressible, and the others free the rest state of stress and penalise changes of volume. Defined for J
/// > 0 and I1 − 3 < Jm; the first of these bounds opens with [`Inversion::Extend`](piola::Inversion::Extend)
/// if κ ≥ 0, the second stays.
///
/// ```text
/// ψ = 1/2 κ (J − 1)² − 1/2 μ jm ln(1 − (I1 − 3)/jm) − μ ln J
/// ```
///
/// **Parameters**:
///
/// * `mu`: Shear modulus μ, Pa.
/// * `jm`: Locking value Jm of I1 − 3, dimensionless.
/// * `kappa`: Volumetric modulus κ, Pa.
///
/// They satisfy `mu > 0, jm > 0`.
///
/// **Typical**: `mu = 3.3e5, jm = 108.0, kappa = 2e7`, natural rubber, fitted to Treloar 1944.
///
/// **Domain**: `J > 0, I1 - 3 < jm`. It can be continued beyond J > 0 where `kappa >= 0`.
///
/// **Small strain**: μ = μ, λ = κ + 2 μ/jm.
///
/// **Derivatives** inside the domain, with D⁻₁₂ = (ψ₁ − ψ₂)/(λ₁ − λ₂) and D⁺₁₂ = (ψ₁ + ψ₂)/(λ₁ + λ₂), where f\[x, y\] is (f(x) − f(y))/(x − y); the others follow by exchange of stretches:
///
/// ```text
/// ψ₁ = μ λ₁/(1 − (I1 − 3)/jm) + κ (J − 1) λ₂ λ₃ − μ/λ₁
/// ψ₁₁ = μ/(1 − (I1 − 3)/jm) + 2 μ λ₁²/(jm (1 − (I1 − 3)/jm)²) + μ/λ₁² + κ λ₂² λ₃²
/// ψ₁₂ = 2 μ λ₁ λ₂/(jm (1 − (I1 − 3)/jm)²) + κ (J − 1) λ₃ + κ λ₁ λ₂ λ₃²
/// D⁻₁₂ = μ/(1 − (I1 − 3)/jm) + μ/(λ₁ λ₂) − κ (J − 1) λ₃
/// D⁺₁₂ = μ/(1 − (I1 − 3)/jm) + κ (J − 1) λ₃ − μ/(λ₁ λ₂)
/// ```
///
/// **By the invariants**, from which the stress needs no stretches:
///
/// ```text
/// ∂ψ/∂I1 = 1/2 μ/(1 − (I1 − 3)/jm)
/// ∂ψ/∂I2 = 0
/// ∂ψ/∂J = κ (J − 1) − μ/J
/// ```
///
/// **By the parameters**: it is [`Fittable`](piola::material::Fittable), with the derivatives of ψ₁, ψ₂, ψ₃ by each.
///
/// **Operations**, of each result by itself:
///
/// | result | operations |
/// |---|---|
/// | energy | 22 (1 ÷, 2 ln) |
/// | gradient | 37 (5 ÷) |
/// | energy, gradient and Hessian | 102 (5 ÷, 2 ln) |
/// | flip | 34 (5 ÷) |
/// | twist | 34 (5 ÷) |
/// | blocks | 107 (5 ÷) |
/// | blocks, continued | 163 (9 ÷, 6 Δ) |
///
/// A fused multiplication and addition counts as two operations, a loop over lists of length N as N times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a multiplication: ÷ divisions, √ roots, ln, exp, φ other elementary functions, pow real powers, Δ divided differences, f functions that are parameters.
#[derive(Clone, Debug, PartialEq)]
#[derive(Copy)]
pub struct Gent<P = f64> {
    mu: P,
    jm: P,
    kappa: P,
    inversion: ::piola::Inversion,
}
const _: () = {
    use ::piola::__private as __p;
    #[allow(clippy::too_many_arguments)]
    impl Gent {
        /// The material with these parameters.
        ///
        /// * `mu`: Shear modulus μ, Pa.
        /// * `jm`: Locking value Jm of I1 − 3, dimensionless.
        /// * `kappa`: Volumetric modulus κ, Pa.
        ///
        /// # Errors
        /// Where a parameter is not finite or not admissible.
        pub fn new(
            mu: f64,
            jm: f64,
            kappa: f64,
        ) -> __p::Result<Self, __p::MaterialError> {
            __p::finite("mu", mu)?;
            __p::finite("jm", jm)?;
            __p::finite("kappa", kappa)?;
            __p::admissible(mu > 0f64, "mu > 0", &[("mu", None, mu)])?;
            __p::admissible(jm > 0f64, "jm > 0", &[("jm", None, jm)])?;
            __p::stable_at_rest(Self {
                mu,
                jm,
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
                let Self { kappa, .. } = self;
                __p::restoring(kappa >= 0f64, "kappa >= 0", &[("kappa", None, kappa)])?;
            }
            self.inversion = inversion;
            Ok(self)
        }
        /// Shear modulus μ, Pa.
        #[must_use]
        pub fn mu(&self) -> f64 {
            self.mu
        }
        /// Locking value Jm of I1 − 3, dimensionless.
        #[must_use]
        pub fn jm(&self) -> f64 {
            self.jm
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
        pub fn with_mu(self, mu: f64) -> __p::Result<Self, __p::MaterialError> {
            Self::new(mu, self.jm, self.kappa)?.with_inversion(self.inversion)
        }
        /// Replaces `jm`.
        ///
        /// # Errors
        /// If the parameters are not admissible together, as of `new`.
        #[allow(dead_code)]
        pub fn with_jm(self, jm: f64) -> __p::Result<Self, __p::MaterialError> {
            Self::new(self.mu, jm, self.kappa)?.with_inversion(self.inversion)
        }
        /// Replaces `kappa`.
        ///
        /// # Errors
        /// If the parameters are not admissible together, as of `new`.
        #[allow(dead_code)]
        pub fn with_kappa(self, kappa: f64) -> __p::Result<Self, __p::MaterialError> {
            Self::new(self.mu, self.jm, kappa)?.with_inversion(self.inversion)
        }
    }
    #[allow(unused_variables, clippy::all)]
    impl<P: __p::ParameterValue> ::piola::Material for Gent<P> {
        #[inline(always)]
        fn energy<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> R {
            match self.inversion {
                __p::Inversion::Refuse => {
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t1 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let t3 = t1 * (kappa * t1);
                    let t9 = (-(R::splat(1.0) / jm))
                        .mul_add(
                            l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0),
                            R::splat(1.0),
                        );
                    let t15 = (-mu)
                        .mul_add(
                            __p::ln_product([l1, l2, l3]),
                            (-t9.ln()).mul_add(mu * jm, t3) * R::splat(0.5),
                        );
                    t15
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t1 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let t3 = t1 * (kappa * t1);
                    let t9 = (-(R::splat(1.0) / jm))
                        .mul_add(
                            l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0),
                            R::splat(1.0),
                        );
                    let t13 = (-t9.ln()).mul_add(mu * jm, t3) * R::splat(0.5);
                    let t14 = l1.max(epsilon);
                    let t15 = t14.ln();
                    let t16 = (l1 - epsilon).min(R::splat(0.0));
                    let t17 = R::splat(1.0) / t14;
                    let t18 = t16.mul_add(t17, t15);
                    let t19 = l2.max(epsilon);
                    let t21 = t18 + t19.ln();
                    let t22 = (l2 - epsilon).min(R::splat(0.0));
                    let t23 = R::splat(1.0) / t19;
                    let t24 = t22.mul_add(t23, t21);
                    let t25 = l3.max(epsilon);
                    let t27 = t24 + t25.ln();
                    let t28 = (l3 - epsilon).min(R::splat(0.0));
                    let t29 = R::splat(1.0) / t25;
                    let t30 = t28.mul_add(t29, t27);
                    let t39 = t29
                        .mul_add(
                            t29 * (t28 * t28),
                            t23.mul_add(t23 * (t22 * t22), t17 * (t17 * (t16 * t16))),
                        );
                    (-mu).mul_add((-R::splat(0.5)).mul_add(t39, t30), t13)
                }
            }
        }
        #[inline(always)]
        fn gradient<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> [R; 3] {
            match self.inversion {
                __p::Inversion::Refuse => {
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let t5 = (-(R::splat(1.0) / jm))
                        .mul_add(
                            l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0),
                            R::splat(1.0),
                        );
                    let t7 = mu * (R::splat(1.0) / t5);
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t8 = l1 * t7;
                    let t10 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t15 = (-mu)
                        .mul_add(R::splat(1.0) / l1, t10.mul_add(l3 * (l2 * kappa), t8));
                    let t16 = l2 * t7;
                    let t17 = l1 * kappa;
                    [
                        t15,
                        (-mu).mul_add(R::splat(1.0) / l2, t10.mul_add(l3 * t17, t16)),
                        (-mu).mul_add(R::splat(1.0) / l3, t10.mul_add(l2 * t17, l3 * t7)),
                    ]
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let t5 = (-(R::splat(1.0) / jm))
                        .mul_add(
                            l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0),
                            R::splat(1.0),
                        );
                    let t7 = mu * (R::splat(1.0) / t5);
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t8 = l1 * t7;
                    let t10 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t13 = t10.mul_add(l3 * (l2 * kappa), t8);
                    let t15 = R::splat(1.0) / l1.max(epsilon);
                    let t19 = (-mu)
                        .mul_add(
                            (-t15).mul_add(t15 * (l1 - epsilon).min(R::splat(0.0)), t15),
                            t13,
                        );
                    let t20 = l2 * t7;
                    let t21 = l1 * kappa;
                    let t23 = t10.mul_add(l3 * t21, t20);
                    let t25 = R::splat(1.0) / l2.max(epsilon);
                    let t29 = (-mu)
                        .mul_add(
                            (-t25).mul_add(t25 * (l2 - epsilon).min(R::splat(0.0)), t25),
                            t23,
                        );
                    let t32 = t10.mul_add(l2 * t21, l3 * t7);
                    let t34 = R::splat(1.0) / l3.max(epsilon);
                    let t38 = (-mu)
                        .mul_add(
                            (-t34).mul_add(t34 * (l3 - epsilon).min(R::splat(0.0)), t34),
                            t32,
                        );
                    [t19, t29, t38]
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
            let mu: R = __p::ParameterValue::on(&self.mu);
            let jm: R = __p::ParameterValue::on(&self.jm);
            let t0 = R::splat(1.0) / jm;
            let t6 = strains[2]
                .mul_add(
                    R::splat(1.0) + l3,
                    strains[1]
                        .mul_add(R::splat(1.0) + l2, strains[0] * (R::splat(1.0) + l1)),
                );
            let t11 = (-t0)
                .mul_add(
                    l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0),
                    R::splat(1.0),
                );
            let t12 = R::splat(1.0) / t11;
            let t15 = t12 * (t6 * (mu * t0));
            let t16 = mu * strains[0];
            let kappa: R = __p::ParameterValue::on(&self.kappa);
            let t19 = t16.mul_add(R::splat(1.0) / l1, t12.mul_add(t16, t15));
            let t23 = kappa
                * l3.mul_add(strains[0] * l2, strains[1].mul_add(l3, strains[2]));
            let t25 = l3.mul_add(l2 * t23, t19);
            let t26 = mu * strains[1];
            let t29 = t26.mul_add(R::splat(1.0) / l2, t12.mul_add(t26, t15));
            let t30 = l1 * t23;
            let t31 = l3.mul_add(t30, t29);
            let t32 = mu * strains[2];
            let inside = [
                t25,
                t31,
                l2.mul_add(t30, t32.mul_add(R::splat(1.0) / l3, t12.mul_add(t32, t15))),
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
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let t5 = (-t0)
                        .mul_add(
                            l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0),
                            R::splat(1.0),
                        );
                    let t6 = R::splat(1.0) / t5;
                    let t7 = mu * t6;
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t8 = l1 * t7;
                    let t10 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t11 = l2 * kappa;
                    let t12 = l3 * t11;
                    let t13 = t10.mul_add(t12, t8);
                    let t14 = R::splat(1.0) / l1;
                    let t15 = mu * t14;
                    let t16 = t13 - t15;
                    let t17 = l2 * t7;
                    let t18 = l1 * kappa;
                    let t19 = l3 * t18;
                    let t20 = t10.mul_add(t19, t17);
                    let t21 = R::splat(1.0) / l2;
                    let t22 = mu * t21;
                    let t23 = t20 - t22;
                    let t24 = l3 * t7;
                    let t25 = l2 * t18;
                    let t26 = t10.mul_add(t25, t24);
                    let t27 = R::splat(1.0) / l3;
                    let t28 = mu * t27;
                    let t29 = t26 - t28;
                    let t31 = t6 * (mu * t0);
                    let t32 = l1 * t31;
                    let t38 = l3
                        .mul_add(
                            l2 * t12,
                            t14
                                .mul_add(t15, (t6 * (l1 * t32)).mul_add(R::splat(2.0), t7)),
                        );
                    let t39 = l2 * t31;
                    let t45 = l3
                        .mul_add(
                            l1 * t19,
                            t21.mul_add(t22, R::splat(2.0).mul_add(t6 * (l2 * t39), t7)),
                        );
                    let t52 = l2
                        .mul_add(
                            l1 * t25,
                            t27
                                .mul_add(
                                    t28,
                                    R::splat(2.0).mul_add(t6 * (l3 * (l3 * t31)), t7),
                                ),
                        );
                    let t54 = t6 * (l2 * t32);
                    let t56 = t10 * (l3 * kappa);
                    let t57 = R::splat(2.0).mul_add(t54, t56);
                    let t58 = l3 * t25;
                    let t59 = l3.mul_add(t58, t57);
                    let t61 = t6 * (l3 * t32);
                    let t62 = t10 * t11;
                    let t64 = l2.mul_add(t58, R::splat(2.0).mul_add(t61, t62));
                    let t66 = t6 * (l3 * t39);
                    let t67 = t10 * t18;
                    let t69 = l1.mul_add(t58, R::splat(2.0).mul_add(t66, t67));
                    let t70 = t15 * t21;
                    let t72 = (t7 + t70) - t56;
                    let t73 = t15 * t27;
                    let t75 = (t7 + t73) - t62;
                    let t76 = t22 * t27;
                    __p::Blocks {
                        gradient: [t16, t23, t29],
                        hessian: [t38, t45, t52, t59, t64, t69],
                        flip: [t72, t75, (t7 + t76) - t67],
                        twist: [(t7 + t56) - t70, (t7 + t62) - t73, (t7 + t67) - t76],
                    }
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let t5 = (-t0)
                        .mul_add(
                            l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0),
                            R::splat(1.0),
                        );
                    let t6 = R::splat(1.0) / t5;
                    let t7 = mu * t6;
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t8 = l1 * t7;
                    let t10 = l3.mul_add(l1 * l2, -R::splat(1.0));
                    let t11 = l2 * kappa;
                    let t12 = l3 * t11;
                    let t13 = t10.mul_add(t12, t8);
                    let t15 = R::splat(1.0) / l1.max(epsilon);
                    let t19 = mu
                        * (-t15).mul_add(t15 * (l1 - epsilon).min(R::splat(0.0)), t15);
                    let t20 = t13 - t19;
                    let t21 = l2 * t7;
                    let t22 = l1 * kappa;
                    let t23 = l3 * t22;
                    let t24 = t10.mul_add(t23, t21);
                    let t26 = R::splat(1.0) / l2.max(epsilon);
                    let t30 = mu
                        * (-t26).mul_add(t26 * (l2 - epsilon).min(R::splat(0.0)), t26);
                    let t31 = t24 - t30;
                    let t32 = l3 * t7;
                    let t33 = l2 * t22;
                    let t34 = t10.mul_add(t33, t32);
                    let t36 = R::splat(1.0) / l3.max(epsilon);
                    let t40 = mu
                        * (-t36).mul_add(t36 * (l3 - epsilon).min(R::splat(0.0)), t36);
                    let t41 = t34 - t40;
                    let t43 = t6 * (mu * t0);
                    let t44 = l1 * t43;
                    let t51 = t15
                        .mul_add(
                            mu * t15,
                            l3
                                .mul_add(
                                    l2 * t12,
                                    (t6 * (l1 * t44)).mul_add(R::splat(2.0), t7),
                                ),
                        );
                    let t52 = l2 * t43;
                    let t59 = t26
                        .mul_add(
                            mu * t26,
                            l3
                                .mul_add(
                                    l1 * t23,
                                    R::splat(2.0).mul_add(t6 * (l2 * t52), t7),
                                ),
                        );
                    let t67 = t36
                        .mul_add(
                            mu * t36,
                            l2
                                .mul_add(
                                    l1 * t33,
                                    R::splat(2.0).mul_add(t6 * (l3 * (l3 * t43)), t7),
                                ),
                        );
                    let t69 = t6 * (l2 * t44);
                    let t71 = t10 * (l3 * kappa);
                    let t72 = R::splat(2.0).mul_add(t69, t71);
                    let t73 = l3 * t33;
                    let t74 = l3.mul_add(t73, t72);
                    let t76 = t6 * (l3 * t44);
                    let t77 = t10 * t11;
                    let t79 = l2.mul_add(t73, R::splat(2.0).mul_add(t76, t77));
                    let t81 = t6 * (l3 * t52);
                    let t82 = t10 * t22;
                    let t84 = l1.mul_add(t73, R::splat(2.0).mul_add(t81, t82));
                    let t85 = t7 - t71;
                    let t89 = -(t26 * (t15 * __p::share_above(l1, l2, epsilon)));
                    let t90 = R::splat(1.0) / epsilon;
                    let t91 = __p::share_below(l1, l2, epsilon);
                    let t92 = t90 * t90;
                    let t94 = (-mu).mul_add((-t91).mul_add(t92, t89), t85);
                    let t95 = t7 - t77;
                    let t101 = (-t92)
                        .mul_add(
                            __p::share_below(l1, l3, epsilon),
                            -(t36 * (t15 * __p::share_above(l1, l3, epsilon))),
                        );
                    let t102 = (-mu).mul_add(t101, t95);
                    let t103 = t7 - t82;
                    let t109 = (-t92)
                        .mul_add(
                            __p::share_below(l2, l3, epsilon),
                            -(t36 * (t26 * __p::share_above(l2, l3, epsilon))),
                        );
                    let t110 = (-mu).mul_add(t109, t103);
                    let t111 = t7 + t71;
                    let t112 = -t19;
                    let t113 = t112 - t30;
                    let t114 = l1 + l2;
                    let t115 = __p::pole_floor([l1, l2, l3]);
                    __p::Blocks {
                        gradient: [t20, t31, t41],
                        hessian: [t51, t59, t67, t74, t79, t84],
                        flip: [t94, t102, t110],
                        twist: [
                            t111 + (t113 / t114.max(t115)),
                            (t7 + t77) + ((t112 - t40) / (l1 + l3).max(t115)),
                            (t7 + t82) + (((-t30) - t40) / (l2 + l3).max(t115)),
                        ],
                    }
                }
            }
        }
        #[inline(always)]
        fn admits<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> R::Mask {
            let jm: R = __p::ParameterValue::on(&self.jm);
            R::splat(0.0)
                .less(
                    (-l3).mul_add(l3, (-l2).mul_add(l2, (-l1).mul_add(l1, jm)))
                        + R::splat(3.0),
                )
                & match self.inversion {
                    __p::Inversion::Refuse => R::splat(0.0).less(l3),
                    __p::Inversion::Extend { .. } => __p::Mask::splat(true),
                }
        }
        const HAS_INVARIANTS: bool = true;
        const HAS_SECOND_INVARIANT: bool = false;
        const CURVATURE_BY_INVARIANTS: __p::Curvature = __p::Curvature::Separate;
        #[inline(always)]
        #[allow(non_snake_case)]
        fn energy_by_invariants<R: __p::Real>(&self, [I1, I2, J]: [R; 3]) -> R {
            let kappa: R = __p::ParameterValue::on(&self.kappa);
            let t0 = J - R::splat(1.0);
            let mu: R = __p::ParameterValue::on(&self.mu);
            let jm: R = __p::ParameterValue::on(&self.jm);
            let t8 = (-(-(R::splat(1.0) / jm))
                .mul_add(I1 - R::splat(3.0), R::splat(1.0))
                .ln())
                .mul_add(mu * jm, t0 * (kappa * t0));
            (-mu).mul_add(J.ln(), t8 * R::splat(0.5))
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn gradient_by_invariants<R: __p::Real>(&self, [I1, I2, J]: [R; 3]) -> [R; 3] {
            let mu: R = __p::ParameterValue::on(&self.mu);
            let jm: R = __p::ParameterValue::on(&self.jm);
            let t3 = R::splat(1.0)
                / (-(R::splat(1.0) / jm)).mul_add(I1 - R::splat(3.0), R::splat(1.0));
            let kappa: R = __p::ParameterValue::on(&self.kappa);
            [
                (mu * t3) * R::splat(0.5),
                R::splat(0.0),
                (-mu).mul_add(R::splat(1.0) / J, kappa * (J - R::splat(1.0))),
            ]
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn derivatives_by_invariants<R: __p::Real>(
            &self,
            [I1,
            I2,
            J,
            ]: [R; 3],
        ) -> [R; 9] {
            let mu: R = __p::ParameterValue::on(&self.mu);
            let jm: R = __p::ParameterValue::on(&self.jm);
            let t0 = R::splat(1.0) / jm;
            let t3 = R::splat(1.0) / (-t0).mul_add(I1 - R::splat(3.0), R::splat(1.0));
            let kappa: R = __p::ParameterValue::on(&self.kappa);
            let t5 = (mu * t3) * R::splat(0.5);
            let t6 = J - R::splat(1.0);
            let t7 = R::splat(1.0) / J;
            let t8 = mu * t7;
            [
                t5,
                R::splat(0.0),
                kappa.mul_add(t6, -t8),
                R::splat(0.5) * (t3 * (t3 * (mu * t0))),
                R::splat(0.0),
                t7.mul_add(t8, kappa),
                R::splat(0.0),
                R::splat(0.0),
                R::splat(0.0),
            ]
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn admits_invariants<R: __p::Real>(&self, [I1, I2, J]: [R; 3]) -> R::Mask {
            let jm: R = __p::ParameterValue::on(&self.jm);
            R::splat(0.0).less((jm - I1) + R::splat(3.0))
                & match self.inversion {
                    __p::Inversion::Refuse => R::splat(0.0).less(J),
                    __p::Inversion::Extend { epsilon: epsilon } => {
                        (R::splat(epsilon) * I1).less(J + J)
                    }
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
            let mu: R = __p::ParameterValue::on(&self.mu);
            let kappa: R = __p::ParameterValue::on(&self.kappa);
            let jm: R = __p::ParameterValue::on(&self.jm);
            __p::stated_moduli(
                mu,
                (mu * (R::splat(1.0) / jm)).mul_add(R::splat(2.0), kappa),
            )
        }
    }
    impl __p::Graded for Gent {
        type OnLanes<'lanes> = Gent<__p::PerLane>;
        #[inline(always)]
        fn on_lanes<'lanes>(
            material: impl ::core::ops::Fn(usize) -> &'lanes Self + ::core::marker::Copy,
        ) -> Self::OnLanes<'lanes>
        where
            Self: 'lanes,
        {
            Gent {
                mu: __p::PerLane::gather(|lane| material(lane).mu),
                jm: __p::PerLane::gather(|lane| material(lane).jm),
                kappa: __p::PerLane::gather(|lane| material(lane).kappa),
                inversion: material(0).inversion,
            }
        }
    }
    impl __p::Declared for Gent {
        const DESCRIPTION: __p::Description = __p::Description {
            name: __p::Borrowed("Gent"),
            summary: __p::Borrowed(
                "Gent solid: rubber that locks where I1 − 3 reaches Jm.",
            ),
            formula: __p::Borrowed(
                "1/2 κ (J − 1)² − 1/2 μ jm ln(1 − (I1 − 3)/jm) − μ ln J",
            ),
            parameters: __p::Borrowed(
                &[
                    __p::Parameter {
                        name: __p::Borrowed("mu"),
                        doc: __p::Borrowed("Shear modulus μ, Pa."),
                        unit: Some(__p::Unit::Pascal),
                        form: __p::Form::Number,
                    },
                    __p::Parameter {
                        name: __p::Borrowed("jm"),
                        doc: __p::Borrowed(
                            "Locking value Jm of I1 − 3, dimensionless.",
                        ),
                        unit: Some(__p::Unit::Dimensionless),
                        form: __p::Form::Number,
                    },
                    __p::Parameter {
                        name: __p::Borrowed("kappa"),
                        doc: __p::Borrowed("Volumetric modulus κ, Pa."),
                        unit: Some(__p::Unit::Pascal),
                        form: __p::Form::Number,
                    },
                ],
            ),
            domain: __p::Borrowed("J > 0, I1 - 3 < jm"),
            extends: true,
            refusal: None,
            admissible: __p::Borrowed(
                &[__p::Borrowed("mu > 0"), __p::Borrowed("jm > 0")],
            ),
            moduli: [__p::Borrowed("μ"), __p::Borrowed("κ + 2 μ/jm")],
            typical: Some(__p::Typical {
                values: __p::Borrowed(
                    &[
                        __p::Borrowed(&[330000.0]),
                        __p::Borrowed(&[108.0]),
                        __p::Borrowed(&[20000000.0]),
                    ],
                ),
                source: __p::Borrowed("natural rubber, fitted to Treloar 1944"),
            }),
        };
        fn from_values(
            values: &[&[f64]],
            inversion: __p::Inversion,
        ) -> __p::Result<Self, __p::MaterialError> {
            let mut values = __p::Values::new(values, &["mu", "jm", "kappa"])?;
            Self::new(values.number()?, values.number()?, values.number()?)?
                .with_inversion(inversion)
        }
    }
    impl __p::Fittable for Gent {
        fn values(&self) -> __p::Vec<__p::Vec<f64>> {
            ::std::vec![
                ::std::vec![self.mu], ::std::vec![self.jm], ::std::vec![self.kappa]
            ]
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn gradient_by_parameters(&self, [l1, l2, l3]: [f64; 3]) -> __p::Vec<[f64; 3]> {
            use ::piola::Real;
            type R = f64;
            let mut derivatives: [__p::Vec<[f64; 3]>; 3] = [const {
                __p::Vec::new()
            }; 3];
            let jm: R = __p::ParameterValue::on(&self.jm);
            let t0 = R::splat(1.0) / jm;
            let t4 = l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0);
            let t6 = R::splat(1.0) / (-t0).mul_add(t4, R::splat(1.0));
            let mu: R = __p::ParameterValue::on(&self.mu);
            let t8 = l1.mul_add(t6, -(R::splat(1.0) / l1));
            let t10 = l2.mul_add(t6, -(R::splat(1.0) / l2));
            let t12 = l3.mul_add(t6, -(R::splat(1.0) / l3));
            let t17 = t6 * (t6 * (t4 * (t0 * (t0 * mu))));
            let t19 = -(l1 * t17);
            let t21 = -(l2 * t17);
            let t23 = -(l3 * t17);
            let t24 = l1 * l2;
            let t25 = l3.mul_add(t24, -R::splat(1.0));
            derivatives[0].push([t8, t10, t12]);
            derivatives[1].push([t19, t21, t23]);
            derivatives[2].push([t25 * (l2 * l3), t25 * (l1 * l3), t24 * t25]);
            derivatives.concat()
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn constraints(&self) -> __p::Vec<__p::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = __p::Constraint::all(
                [
                    __p::Limit::Admissible(__p::Borrowed("mu > 0")),
                    __p::Limit::Admissible(__p::Borrowed("jm > 0")),
                    __p::Limit::ShearModulus,
                    __p::Limit::BulkModulus,
                ],
                {
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let kappa: R = __p::ParameterValue::on(&self.kappa);
                    let t3 = (mu * (R::splat(1.0) / jm))
                        .mul_add(
                            R::splat(2.0),
                            mu.mul_add(R::splat(0.6666666666666666), kappa),
                        );
                    [mu, jm, mu, t3]
                },
                {
                    let mut derivatives: [__p::Vec<[f64; 4]>; 3] = [const {
                        __p::Vec::new()
                    }; 3];
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    derivatives[0]
                        .push([
                            R::splat(1.0),
                            R::splat(0.0),
                            R::splat(1.0),
                            t0.mul_add(R::splat(2.0), R::splat(0.6666666666666666)),
                        ]);
                    derivatives[1]
                        .push([
                            R::splat(0.0),
                            R::splat(1.0),
                            R::splat(0.0),
                            -(R::splat(2.0) * (t0 * (t0 * mu))),
                        ]);
                    derivatives[2]
                        .push([
                            R::splat(0.0),
                            R::splat(0.0),
                            R::splat(0.0),
                            R::splat(1.0),
                        ]);
                    derivatives.concat()
                },
            );
            constraints
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn domain_constraints(
            &self,
            [l1,
            l2,
            l3,
            ]: [f64; 3],
        ) -> __p::Vec<__p::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = __p::Constraint::all(
                [__p::Limit::Domain(__p::Borrowed("I1 - 3 < jm"))],
                {
                    let jm: R = __p::ParameterValue::on(&self.jm);
                    [
                        (-l3).mul_add(l3, (-l2).mul_add(l2, (-l1).mul_add(l1, jm)))
                            + R::splat(3.0),
                    ]
                },
                {
                    let mut derivatives: [__p::Vec<[f64; 1]>; 3] = [const {
                        __p::Vec::new()
                    }; 3];
                    derivatives[0].push([R::splat(0.0)]);
                    derivatives[1].push([R::splat(1.0)]);
                    derivatives[2].push([R::splat(0.0)]);
                    derivatives.concat()
                },
            );
            constraints
        }
    }
};
