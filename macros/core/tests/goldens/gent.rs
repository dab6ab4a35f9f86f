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
/// A fused multiplication and addition counts as two operations, a loop over lists of length N as N times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a multiplication: ÷ divisions, √ roots, ln, exp, pow real powers, Δ divided differences, f functions that are parameters.
#[derive(Clone, Debug, PartialEq)]
#[derive(Copy)]
pub struct Gent<P = f64> {
    mu: P,
    jm: P,
    kappa: P,
    inversion: ::piola::Inversion,
}
impl Gent {
    /// The material with these parameters.
    ///
    /// * `mu`: Shear modulus μ, Pa.
    /// * `jm`: Locking value Jm of I1 − 3, dimensionless.
    /// * `kappa`: Volumetric modulus κ, Pa.
    ///
    /// # Errors
    /// Where a parameter is not finite or not admissible.
    #[allow(clippy::too_many_arguments)]
    pub fn new(
        mu: f64,
        jm: f64,
        kappa: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        if !mu.is_finite() {
            return Err(::piola::material::Inadmissible::NotFinite {
                given: ::piola::material::Given::scalar("mu", mu),
            });
        }
        if !jm.is_finite() {
            return Err(::piola::material::Inadmissible::NotFinite {
                given: ::piola::material::Given::scalar("jm", jm),
            });
        }
        if !kappa.is_finite() {
            return Err(::piola::material::Inadmissible::NotFinite {
                given: ::piola::material::Given::scalar("kappa", kappa),
            });
        }
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
        if !(mu > 0f64) {
            return Err(::piola::material::Inadmissible::Violated {
                condition: "mu > 0",
                given: ::std::vec![::piola::material::Given::scalar("mu", mu)],
            });
        }
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
        if !(jm > 0f64) {
            return Err(::piola::material::Inadmissible::Violated {
                condition: "jm > 0",
                given: ::std::vec![::piola::material::Given::scalar("jm", jm)],
            });
        }
        let material = Self {
            mu,
            jm,
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
            let Self { mu, jm, kappa, .. } = self;
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
    pub fn with_mu(
        self,
        mu: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        Self::new(mu, self.jm, self.kappa)?.with_inversion(self.inversion)
    }
    /// Replaces `jm`.
    ///
    /// # Errors
    /// If the parameters are not admissible together, as of `new`.
    #[allow(dead_code)]
    pub fn with_jm(
        self,
        jm: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        Self::new(self.mu, jm, self.kappa)?.with_inversion(self.inversion)
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
        Self::new(self.mu, self.jm, kappa)?.with_inversion(self.inversion)
    }
}
const _: () = {
    use ::piola::__private as __piola;
    #[allow(unused_variables, clippy::all)]
    impl<P: __piola::ParameterValue> ::piola::Material for Gent<P> {
        #[inline(always)]
        fn energy<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> R {
            match self.inversion {
                ::piola::Inversion::Refuse => {
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t0 = l1 * l2;
                    let t1 = l3.mul_add(t0, -R::splat(1.0));
                    let t2 = kappa * t1;
                    let t3 = t1 * t2;
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t4 = R::splat(1.0) / jm;
                    let t5 = l1 * l1;
                    let t6 = l2.mul_add(l2, t5);
                    let t7 = l3.mul_add(l3, t6);
                    let t8 = t7 - R::splat(3.0);
                    let t9 = (-t4).mul_add(t8, R::splat(1.0));
                    let t10 = t9.ln();
                    let t11 = mu * jm;
                    let t12 = (-t10).mul_add(t11, t3);
                    let t13 = t12 * R::splat(0.5);
                    let t14 = __piola::ln_product([l1, l2, l3]);
                    let t15 = (-mu).mul_add(t14, t13);
                    t15
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t0 = l1 * l2;
                    let t1 = l3.mul_add(t0, -R::splat(1.0));
                    let t2 = kappa * t1;
                    let t3 = t1 * t2;
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t4 = R::splat(1.0) / jm;
                    let t5 = l1 * l1;
                    let t6 = l2.mul_add(l2, t5);
                    let t7 = l3.mul_add(l3, t6);
                    let t8 = t7 - R::splat(3.0);
                    let t9 = (-t4).mul_add(t8, R::splat(1.0));
                    let t10 = t9.ln();
                    let t11 = mu * jm;
                    let t12 = (-t10).mul_add(t11, t3);
                    let t13 = t12 * R::splat(0.5);
                    let t14 = l1.max(epsilon);
                    let t15 = t14.ln();
                    let t16 = (l1 - epsilon).min(R::splat(0.0));
                    let t17 = R::splat(1.0) / t14;
                    let t18 = t16.mul_add(t17, t15);
                    let t19 = l2.max(epsilon);
                    let t20 = t19.ln();
                    let t21 = t18 + t20;
                    let t22 = (l2 - epsilon).min(R::splat(0.0));
                    let t23 = R::splat(1.0) / t19;
                    let t24 = t22.mul_add(t23, t21);
                    let t25 = l3.max(epsilon);
                    let t26 = t25.ln();
                    let t27 = t24 + t26;
                    let t28 = (l3 - epsilon).min(R::splat(0.0));
                    let t29 = R::splat(1.0) / t25;
                    let t30 = t28.mul_add(t29, t27);
                    let t31 = t16 * t16;
                    let t32 = t17 * t31;
                    let t33 = t17 * t32;
                    let t34 = t22 * t22;
                    let t35 = t23 * t34;
                    let t36 = t23.mul_add(t35, t33);
                    let t37 = t28 * t28;
                    let t38 = t29 * t37;
                    let t39 = t29.mul_add(t38, t36);
                    let t40 = (-R::splat(0.5)).mul_add(t39, t30);
                    let t41 = (-mu).mul_add(t40, t13);
                    t41
                }
            }
        }
        #[inline(always)]
        fn gradient<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> [R; 3] {
            match self.inversion {
                ::piola::Inversion::Refuse => {
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let t1 = l1 * l1;
                    let t2 = l2.mul_add(l2, t1);
                    let t3 = l3.mul_add(l3, t2);
                    let t4 = t3 - R::splat(3.0);
                    let t5 = (-t0).mul_add(t4, R::splat(1.0));
                    let t6 = R::splat(1.0) / t5;
                    let t7 = mu * t6;
                    let t8 = l1 * t7;
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t9 = l1 * l2;
                    let t10 = l3.mul_add(t9, -R::splat(1.0));
                    let t11 = l2 * kappa;
                    let t12 = l3 * t11;
                    let t13 = t10.mul_add(t12, t8);
                    let t14 = R::splat(1.0) / l1;
                    let t15 = (-mu).mul_add(t14, t13);
                    let t16 = l2 * t7;
                    let t17 = l1 * kappa;
                    let t18 = l3 * t17;
                    let t19 = t10.mul_add(t18, t16);
                    let t20 = R::splat(1.0) / l2;
                    let t21 = (-mu).mul_add(t20, t19);
                    let t22 = l3 * t7;
                    let t23 = l2 * t17;
                    let t24 = t10.mul_add(t23, t22);
                    let t25 = R::splat(1.0) / l3;
                    let t26 = (-mu).mul_add(t25, t24);
                    [t15, t21, t26]
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let t1 = l1 * l1;
                    let t2 = l2.mul_add(l2, t1);
                    let t3 = l3.mul_add(l3, t2);
                    let t4 = t3 - R::splat(3.0);
                    let t5 = (-t0).mul_add(t4, R::splat(1.0));
                    let t6 = R::splat(1.0) / t5;
                    let t7 = mu * t6;
                    let t8 = l1 * t7;
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t9 = l1 * l2;
                    let t10 = l3.mul_add(t9, -R::splat(1.0));
                    let t11 = l2 * kappa;
                    let t12 = l3 * t11;
                    let t13 = t10.mul_add(t12, t8);
                    let t14 = l1.max(epsilon);
                    let t15 = R::splat(1.0) / t14;
                    let t16 = (l1 - epsilon).min(R::splat(0.0));
                    let t17 = t15 * t16;
                    let t18 = (-t15).mul_add(t17, t15);
                    let t19 = (-mu).mul_add(t18, t13);
                    let t20 = l2 * t7;
                    let t21 = l1 * kappa;
                    let t22 = l3 * t21;
                    let t23 = t10.mul_add(t22, t20);
                    let t24 = l2.max(epsilon);
                    let t25 = R::splat(1.0) / t24;
                    let t26 = (l2 - epsilon).min(R::splat(0.0));
                    let t27 = t25 * t26;
                    let t28 = (-t25).mul_add(t27, t25);
                    let t29 = (-mu).mul_add(t28, t23);
                    let t30 = l3 * t7;
                    let t31 = l2 * t21;
                    let t32 = t10.mul_add(t31, t30);
                    let t33 = l3.max(epsilon);
                    let t34 = R::splat(1.0) / t33;
                    let t35 = (l3 - epsilon).min(R::splat(0.0));
                    let t36 = t34 * t35;
                    let t37 = (-t34).mul_add(t36, t34);
                    let t38 = (-mu).mul_add(t37, t32);
                    [t19, t29, t38]
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
            let mu: R = __piola::ParameterValue::on(&self.mu);
            let jm: R = __piola::ParameterValue::on(&self.jm);
            let t0 = R::splat(1.0) / jm;
            let t1 = R::splat(1.0) + l1;
            let t2 = strains[0] * t1;
            let t3 = R::splat(1.0) + l2;
            let t4 = strains[1].mul_add(t3, t2);
            let t5 = R::splat(1.0) + l3;
            let t6 = strains[2].mul_add(t5, t4);
            let t7 = l1 * l1;
            let t8 = l2.mul_add(l2, t7);
            let t9 = l3.mul_add(l3, t8);
            let t10 = t9 - R::splat(3.0);
            let t11 = (-t0).mul_add(t10, R::splat(1.0));
            let t12 = R::splat(1.0) / t11;
            let t13 = mu * t0;
            let t14 = t6 * t13;
            let t15 = t12 * t14;
            let t16 = mu * strains[0];
            let t17 = t12.mul_add(t16, t15);
            let t18 = R::splat(1.0) / l1;
            let t19 = t16.mul_add(t18, t17);
            let kappa: R = __piola::ParameterValue::on(&self.kappa);
            let t20 = strains[1].mul_add(l3, strains[2]);
            let t21 = strains[0] * l2;
            let t22 = l3.mul_add(t21, t20);
            let t23 = kappa * t22;
            let t24 = t19 + t23;
            let t25 = l2 * l3;
            let t26 = l1.mul_add(t25, -R::splat(1.0));
            let t27 = strains[2] * kappa;
            let t28 = t26 * t27;
            let t29 = t24 + t28;
            let t30 = strains[1] * kappa;
            let t31 = l3 * t30;
            let t32 = t26.mul_add(t31, t29);
            let t33 = t15 + t23;
            let t34 = t28 + t33;
            let t35 = mu * strains[1];
            let t36 = t12.mul_add(t35, t34);
            let t37 = R::splat(1.0) / l2;
            let t38 = t35.mul_add(t37, t36);
            let t39 = strains[0] * kappa;
            let t40 = l3 * t39;
            let t41 = t26.mul_add(t40, t38);
            let t42 = mu * strains[2];
            let t43 = t12.mul_add(t42, t33);
            let t44 = R::splat(1.0) / l3;
            let t45 = t42.mul_add(t44, t43);
            let t46 = t26.mul_add(t30, t45);
            let t47 = l2 * t39;
            let t48 = t26.mul_add(t47, t46);
            let inside = [t32, t41, t48];
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
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let t1 = l1 * l1;
                    let t2 = l2.mul_add(l2, t1);
                    let t3 = l3.mul_add(l3, t2);
                    let t4 = t3 - R::splat(3.0);
                    let t5 = (-t0).mul_add(t4, R::splat(1.0));
                    let t6 = R::splat(1.0) / t5;
                    let t7 = mu * t6;
                    let t8 = l1 * t7;
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t9 = l1 * l2;
                    let t10 = l3.mul_add(t9, -R::splat(1.0));
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
                    let t30 = mu * t0;
                    let t31 = t6 * t30;
                    let t32 = l1 * t31;
                    let t33 = l1 * t32;
                    let t34 = t6 * t33;
                    let t35 = t34.mul_add(R::splat(2.0), t7);
                    let t36 = t14.mul_add(t15, t35);
                    let t37 = l2 * t12;
                    let t38 = l3.mul_add(t37, t36);
                    let t39 = l2 * t31;
                    let t40 = l2 * t39;
                    let t41 = t6 * t40;
                    let t42 = R::splat(2.0).mul_add(t41, t7);
                    let t43 = t21.mul_add(t22, t42);
                    let t44 = l1 * t19;
                    let t45 = l3.mul_add(t44, t43);
                    let t46 = l3 * t31;
                    let t47 = l3 * t46;
                    let t48 = t6 * t47;
                    let t49 = R::splat(2.0).mul_add(t48, t7);
                    let t50 = t27.mul_add(t28, t49);
                    let t51 = l1 * t25;
                    let t52 = l2.mul_add(t51, t50);
                    let t53 = l2 * t32;
                    let t54 = t6 * t53;
                    let t55 = l3 * kappa;
                    let t56 = t10 * t55;
                    let t57 = R::splat(2.0).mul_add(t54, t56);
                    let t58 = l3 * t25;
                    let t59 = l3.mul_add(t58, t57);
                    let t60 = l3 * t32;
                    let t61 = t6 * t60;
                    let t62 = t10 * t11;
                    let t63 = R::splat(2.0).mul_add(t61, t62);
                    let t64 = l2.mul_add(t58, t63);
                    let t65 = l3 * t39;
                    let t66 = t6 * t65;
                    let t67 = t10 * t18;
                    let t68 = R::splat(2.0).mul_add(t66, t67);
                    let t69 = l1.mul_add(t58, t68);
                    let t70 = t15 * t21;
                    let t71 = t7 + t70;
                    let t72 = t71 - t56;
                    let t73 = t15 * t27;
                    let t74 = t7 + t73;
                    let t75 = t74 - t62;
                    let t76 = t22 * t27;
                    let t77 = t7 + t76;
                    let t78 = t77 - t67;
                    let t79 = t7 + t56;
                    let t80 = t79 - t70;
                    let t81 = t7 + t62;
                    let t82 = t81 - t73;
                    let t83 = t7 + t67;
                    let t84 = t83 - t76;
                    ::piola::material::Blocks {
                        gradient: [t16, t23, t29],
                        hessian: [t38, t45, t52, t59, t64, t69],
                        flip: [t72, t75, t78],
                        twist: [t80, t82, t84],
                    }
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let t1 = l1 * l1;
                    let t2 = l2.mul_add(l2, t1);
                    let t3 = l3.mul_add(l3, t2);
                    let t4 = t3 - R::splat(3.0);
                    let t5 = (-t0).mul_add(t4, R::splat(1.0));
                    let t6 = R::splat(1.0) / t5;
                    let t7 = mu * t6;
                    let t8 = l1 * t7;
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t9 = l1 * l2;
                    let t10 = l3.mul_add(t9, -R::splat(1.0));
                    let t11 = l2 * kappa;
                    let t12 = l3 * t11;
                    let t13 = t10.mul_add(t12, t8);
                    let t14 = l1.max(epsilon);
                    let t15 = R::splat(1.0) / t14;
                    let t16 = (l1 - epsilon).min(R::splat(0.0));
                    let t17 = t15 * t16;
                    let t18 = (-t15).mul_add(t17, t15);
                    let t19 = mu * t18;
                    let t20 = t13 - t19;
                    let t21 = l2 * t7;
                    let t22 = l1 * kappa;
                    let t23 = l3 * t22;
                    let t24 = t10.mul_add(t23, t21);
                    let t25 = l2.max(epsilon);
                    let t26 = R::splat(1.0) / t25;
                    let t27 = (l2 - epsilon).min(R::splat(0.0));
                    let t28 = t26 * t27;
                    let t29 = (-t26).mul_add(t28, t26);
                    let t30 = mu * t29;
                    let t31 = t24 - t30;
                    let t32 = l3 * t7;
                    let t33 = l2 * t22;
                    let t34 = t10.mul_add(t33, t32);
                    let t35 = l3.max(epsilon);
                    let t36 = R::splat(1.0) / t35;
                    let t37 = (l3 - epsilon).min(R::splat(0.0));
                    let t38 = t36 * t37;
                    let t39 = (-t36).mul_add(t38, t36);
                    let t40 = mu * t39;
                    let t41 = t34 - t40;
                    let t42 = mu * t0;
                    let t43 = t6 * t42;
                    let t44 = l1 * t43;
                    let t45 = l1 * t44;
                    let t46 = t6 * t45;
                    let t47 = t46.mul_add(R::splat(2.0), t7);
                    let t48 = l2 * t12;
                    let t49 = l3.mul_add(t48, t47);
                    let t50 = mu * t15;
                    let t51 = t15.mul_add(t50, t49);
                    let t52 = l2 * t43;
                    let t53 = l2 * t52;
                    let t54 = t6 * t53;
                    let t55 = R::splat(2.0).mul_add(t54, t7);
                    let t56 = l1 * t23;
                    let t57 = l3.mul_add(t56, t55);
                    let t58 = mu * t26;
                    let t59 = t26.mul_add(t58, t57);
                    let t60 = l3 * t43;
                    let t61 = l3 * t60;
                    let t62 = t6 * t61;
                    let t63 = R::splat(2.0).mul_add(t62, t7);
                    let t64 = l1 * t33;
                    let t65 = l2.mul_add(t64, t63);
                    let t66 = mu * t36;
                    let t67 = t36.mul_add(t66, t65);
                    let t68 = l2 * t44;
                    let t69 = t6 * t68;
                    let t70 = l3 * kappa;
                    let t71 = t10 * t70;
                    let t72 = R::splat(2.0).mul_add(t69, t71);
                    let t73 = l3 * t33;
                    let t74 = l3.mul_add(t73, t72);
                    let t75 = l3 * t44;
                    let t76 = t6 * t75;
                    let t77 = t10 * t11;
                    let t78 = R::splat(2.0).mul_add(t76, t77);
                    let t79 = l2.mul_add(t73, t78);
                    let t80 = l3 * t52;
                    let t81 = t6 * t80;
                    let t82 = t10 * t22;
                    let t83 = R::splat(2.0).mul_add(t81, t82);
                    let t84 = l1.mul_add(t73, t83);
                    let t85 = t7 - t71;
                    let t86 = __piola::share_above(l1, l2, epsilon);
                    let t87 = t15 * t86;
                    let t88 = t26 * t87;
                    let t89 = -t88;
                    let t90 = R::splat(1.0) / epsilon;
                    let t91 = __piola::share_below(l1, l2, epsilon);
                    let t92 = t90 * t90;
                    let t93 = (-t91).mul_add(t92, t89);
                    let t94 = (-mu).mul_add(t93, t85);
                    let t95 = t7 - t77;
                    let t96 = __piola::share_above(l1, l3, epsilon);
                    let t97 = t15 * t96;
                    let t98 = t36 * t97;
                    let t99 = -t98;
                    let t100 = __piola::share_below(l1, l3, epsilon);
                    let t101 = (-t92).mul_add(t100, t99);
                    let t102 = (-mu).mul_add(t101, t95);
                    let t103 = t7 - t82;
                    let t104 = __piola::share_above(l2, l3, epsilon);
                    let t105 = t26 * t104;
                    let t106 = t36 * t105;
                    let t107 = -t106;
                    let t108 = __piola::share_below(l2, l3, epsilon);
                    let t109 = (-t92).mul_add(t108, t107);
                    let t110 = (-mu).mul_add(t109, t103);
                    let t111 = t7 + t71;
                    let t112 = -t19;
                    let t113 = t112 - t30;
                    let t114 = l1 + l2;
                    let t115 = __piola::pole_floor([l1, l2, l3]);
                    let t116 = t114.max(t115);
                    let t117 = t113 / t116;
                    let t118 = t111 + t117;
                    let t119 = t7 + t77;
                    let t120 = t112 - t40;
                    let t121 = l1 + l3;
                    let t122 = t121.max(t115);
                    let t123 = t120 / t122;
                    let t124 = t119 + t123;
                    let t125 = t7 + t82;
                    let t126 = -t30;
                    let t127 = t126 - t40;
                    let t128 = l2 + l3;
                    let t129 = t128.max(t115);
                    let t130 = t127 / t129;
                    let t131 = t125 + t130;
                    ::piola::material::Blocks {
                        gradient: [t20, t31, t41],
                        hessian: [t51, t59, t67, t74, t79, t84],
                        flip: [t94, t102, t110],
                        twist: [t118, t124, t131],
                    }
                }
            }
        }
        #[inline(always)]
        fn admits<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> R::Mask {
            let jm: R = __piola::ParameterValue::on(&self.jm);
            let t0 = (-l1).mul_add(l1, jm);
            let t1 = (-l2).mul_add(l2, t0);
            let t2 = (-l3).mul_add(l3, t1);
            let t3 = t2 + R::splat(3.0);
            R::splat(0.0).less(t3)
                & match self.inversion {
                    ::piola::Inversion::Refuse => R::splat(0.0).less(l3),
                    ::piola::Inversion::Extend { .. } => __piola::Mask::splat(true),
                }
        }
        const HAS_INVARIANTS: bool = true;
        #[inline(always)]
        #[allow(non_snake_case)]
        fn energy_by_invariants<R: ::piola::Real>(&self, [I1, I2, J]: [R; 3]) -> R {
            let kappa: R = __piola::ParameterValue::on(&self.kappa);
            let t0 = J - R::splat(1.0);
            let t1 = kappa * t0;
            let t2 = t0 * t1;
            let mu: R = __piola::ParameterValue::on(&self.mu);
            let jm: R = __piola::ParameterValue::on(&self.jm);
            let t3 = R::splat(1.0) / jm;
            let t4 = I1 - R::splat(3.0);
            let t5 = (-t3).mul_add(t4, R::splat(1.0));
            let t6 = t5.ln();
            let t7 = mu * jm;
            let t8 = (-t6).mul_add(t7, t2);
            let t9 = t8 * R::splat(0.5);
            let t10 = J.ln();
            let t11 = (-mu).mul_add(t10, t9);
            t11
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn gradient_by_invariants<R: ::piola::Real>(
            &self,
            [I1,
            I2,
            J,
            ]: [R; 3],
        ) -> [R; 3] {
            let mu: R = __piola::ParameterValue::on(&self.mu);
            let jm: R = __piola::ParameterValue::on(&self.jm);
            let t0 = R::splat(1.0) / jm;
            let t1 = I1 - R::splat(3.0);
            let t2 = (-t0).mul_add(t1, R::splat(1.0));
            let t3 = R::splat(1.0) / t2;
            let t4 = mu * t3;
            let t5 = t4 * R::splat(0.5);
            let kappa: R = __piola::ParameterValue::on(&self.kappa);
            let t6 = J - R::splat(1.0);
            let t7 = kappa * t6;
            let t8 = R::splat(1.0) / J;
            let t9 = (-mu).mul_add(t8, t7);
            [t5, R::splat(0.0), t9]
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn admits_invariants<R: ::piola::Real>(&self, [I1, I2, J]: [R; 3]) -> R::Mask {
            let jm: R = __piola::ParameterValue::on(&self.jm);
            let t0 = jm - I1;
            let t1 = t0 + R::splat(3.0);
            R::splat(0.0).less(t1)
                & match self.inversion {
                    ::piola::Inversion::Refuse => R::splat(0.0).less(J),
                    ::piola::Inversion::Extend { epsilon: epsilon } => {
                        (R::splat(epsilon) * I1).less(J + J)
                    }
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
            let mu: R = __piola::ParameterValue::on(&self.mu);
            let kappa: R = __piola::ParameterValue::on(&self.kappa);
            let jm: R = __piola::ParameterValue::on(&self.jm);
            let t0 = R::splat(1.0) / jm;
            let t1 = mu * t0;
            let t2 = t1.mul_add(R::splat(2.0), kappa);
            ::core::option::Option::Some(::piola::material::Moduli {
                mu: mu,
                lambda: t2,
            })
        }
    }
    impl ::piola::material::Graded for Gent {
        type OnLanes = Gent<__piola::PerLane>;
        #[inline(always)]
        fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes
        where
            Self: 'a,
        {
            Gent {
                mu: __piola::PerLane::gather(|lane| material(lane).mu),
                jm: __piola::PerLane::gather(|lane| material(lane).jm),
                kappa: __piola::PerLane::gather(|lane| material(lane).kappa),
                inversion: material(0).inversion,
            }
        }
    }
    impl ::piola::material::Declared for Gent {
        const DESCRIPTION: ::piola::material::Description = ::piola::material::Description {
            name: "Gent",
            summary: "Gent solid: rubber that locks where I1 − 3 reaches Jm.",
            formula: "1/2 κ (J − 1)² − 1/2 μ jm ln(1 − (I1 − 3)/jm) − μ ln J",
            parameters: &[
                ::piola::material::Parameter {
                    name: "mu",
                    doc: "Shear modulus μ, Pa.",
                    unit: ::core::option::Option::Some(::piola::material::Unit::Pascal),
                    form: ::piola::material::Form::Number,
                },
                ::piola::material::Parameter {
                    name: "jm",
                    doc: "Locking value Jm of I1 − 3, dimensionless.",
                    unit: ::core::option::Option::Some(
                        ::piola::material::Unit::Dimensionless,
                    ),
                    form: ::piola::material::Form::Number,
                },
                ::piola::material::Parameter {
                    name: "kappa",
                    doc: "Volumetric modulus κ, Pa.",
                    unit: ::core::option::Option::Some(::piola::material::Unit::Pascal),
                    form: ::piola::material::Form::Number,
                },
            ],
            domain: "J > 0, I1 - 3 < jm",
            extends: true,
            refusal: ::core::option::Option::None,
            admissible: &["mu > 0", "jm > 0"],
            moduli: ["μ", "κ + 2 μ/jm"],
            typical: ::core::option::Option::Some(::piola::material::Typical {
                values: &[&[330000.0], &[108.0], &[20000000.0]],
                source: "natural rubber, fitted to Treloar 1944",
            }),
        };
        fn from_values(
            values: &[&[f64]],
            inversion: ::piola::Inversion,
        ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
            let &[mu, jm, kappa] = values else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "3 parameters are expected: `mu`, `jm`, `kappa`".to_owned(),
                });
            };
            let Ok([mu]) = <[f64; 1]>::try_from(mu) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "`mu` must be one number".to_owned(),
                });
            };
            let Ok([jm]) = <[f64; 1]>::try_from(jm) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "`jm` must be one number".to_owned(),
                });
            };
            let Ok([kappa]) = <[f64; 1]>::try_from(kappa) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "`kappa` must be one number".to_owned(),
                });
            };
            Self::new(mu, jm, kappa)?.with_inversion(inversion)
        }
    }
    impl ::piola::material::Fittable for Gent {
        fn values(&self) -> ::std::vec::Vec<::std::vec::Vec<f64>> {
            ::std::vec![
                ::std::vec![self.mu], ::std::vec![self.jm], ::std::vec![self.kappa]
            ]
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
            let jm: R = __piola::ParameterValue::on(&self.jm);
            let t0 = R::splat(1.0) / jm;
            let t1 = l1 * l1;
            let t2 = l2.mul_add(l2, t1);
            let t3 = l3.mul_add(l3, t2);
            let t4 = t3 - R::splat(3.0);
            let t5 = (-t0).mul_add(t4, R::splat(1.0));
            let t6 = R::splat(1.0) / t5;
            let t7 = R::splat(1.0) / l1;
            let t8 = l1.mul_add(t6, -t7);
            let t9 = R::splat(1.0) / l2;
            let t10 = l2.mul_add(t6, -t9);
            let t11 = R::splat(1.0) / l3;
            let t12 = l3.mul_add(t6, -t11);
            let mu: R = __piola::ParameterValue::on(&self.mu);
            let t13 = t0 * mu;
            let t14 = t0 * t13;
            let t15 = t4 * t14;
            let t16 = t6 * t15;
            let t17 = t6 * t16;
            let t18 = l1 * t17;
            let t19 = -t18;
            let t20 = l2 * t17;
            let t21 = -t20;
            let t22 = l3 * t17;
            let t23 = -t22;
            let t24 = l1 * l2;
            let t25 = l3.mul_add(t24, -R::splat(1.0));
            let t26 = l2 * l3;
            let t27 = t25 * t26;
            let t28 = l1 * l3;
            let t29 = t25 * t28;
            let t30 = t24 * t25;
            derivatives[0].push([t8, t10, t12]);
            derivatives[1].push([t19, t21, t23]);
            derivatives[2].push([t27, t29, t30]);
            derivatives.concat()
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn constraints(&self) -> ::std::vec::Vec<::piola::material::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = ::piola::material::Constraint::all(
                [
                    ::piola::material::Limit::Admissible("mu > 0"),
                    ::piola::material::Limit::Admissible("jm > 0"),
                    ::piola::material::Limit::ShearModulus,
                    ::piola::material::Limit::BulkModulus,
                ],
                {
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let kappa: R = __piola::ParameterValue::on(&self.kappa);
                    let t0 = mu.mul_add(R::splat(0.6666666666666666), kappa);
                    let t1 = R::splat(1.0) / jm;
                    let t2 = mu * t1;
                    let t3 = t2.mul_add(R::splat(2.0), t0);
                    [mu, jm, mu, t3]
                },
                {
                    let mut derivatives: [::std::vec::Vec<[f64; 4]>; 3] = [const {
                        ::std::vec::Vec::new()
                    }; 3];
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t0 = R::splat(1.0) / jm;
                    let t1 = t0.mul_add(R::splat(2.0), R::splat(0.6666666666666666));
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let t2 = t0 * mu;
                    let t3 = t0 * t2;
                    let t4 = R::splat(2.0) * t3;
                    let t5 = -t4;
                    derivatives[0]
                        .push([R::splat(1.0), R::splat(0.0), R::splat(1.0), t1]);
                    derivatives[1]
                        .push([R::splat(0.0), R::splat(1.0), R::splat(0.0), t5]);
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
        ) -> ::std::vec::Vec<::piola::material::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = ::piola::material::Constraint::all(
                [::piola::material::Limit::Domain("I1 - 3 < jm")],
                {
                    let jm: R = __piola::ParameterValue::on(&self.jm);
                    let t0 = (-l1).mul_add(l1, jm);
                    let t1 = (-l2).mul_add(l2, t0);
                    let t2 = (-l3).mul_add(l3, t1);
                    let t3 = t2 + R::splat(3.0);
                    [t3]
                },
                {
                    let mut derivatives: [::std::vec::Vec<[f64; 1]>; 3] = [const {
                        ::std::vec::Vec::new()
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
