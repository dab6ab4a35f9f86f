/// Compressible neo-Hookean solid with a logarithmic volumetric part: rubber at moderate strain.
///
/// ψ = μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)².
///
/// Bonet, Wood, *Nonlinear Continuum Mechanics for Finite Element Analysis*, 2nd ed. 2008, eq. 6.27. Defined
/// for J > 0; continued below a threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend) if λ ≥
/// 0.
///
/// ```text
/// ψ = 1/2 μ (I1 − 3) + 1/2 λ (ln J)² − μ ln J
/// ```
///
/// **Parameters**:
///
/// * `mu`: Shear modulus μ, Pa.
/// * `lambda`: First Lamé parameter λ, Pa.
///
/// They satisfy `mu > 0`.
///
/// **Typical**: `mu = 3.8e5, lambda = 2e7`, natural rubber, fitted to Treloar 1944.
///
/// **Domain**: `J > 0`. It can be continued beyond J > 0 where `lambda >= 0`.
///
/// **Small strain**: μ = μ, λ = λ.
///
/// **Derivatives** inside the domain, with D⁻₁₂ = (ψ₁ − ψ₂)/(λ₁ − λ₂) and D⁺₁₂ = (ψ₁ + ψ₂)/(λ₁ + λ₂), where f\[x, y\] is (f(x) − f(y))/(x − y); the others follow by exchange of stretches:
///
/// ```text
/// ψ₁ = μ λ₁ + λ ln J/λ₁ − μ/λ₁
/// ψ₁₁ = μ + μ/λ₁² + λ/λ₁² − λ ln J/λ₁²
/// ψ₁₂ = λ/(λ₁ λ₂)
/// D⁻₁₂ = μ + μ/(λ₁ λ₂) − λ ln J/(λ₁ λ₂)
/// D⁺₁₂ = μ + λ ln J/(λ₁ λ₂) − μ/(λ₁ λ₂)
/// ```
///
/// **By the invariants**, from which the stress needs no stretches:
///
/// ```text
/// ∂ψ/∂I1 = 1/2 μ
/// ∂ψ/∂I2 = 0
/// ∂ψ/∂J = λ ln J/J − μ/J
/// ```
///
/// **By the parameters**: it is [`Fittable`](piola::material::Fittable), with the derivatives of ψ₁, ψ₂, ψ₃ by each.
///
/// **Operations**, of each result by itself:
///
/// | result | operations |
/// |---|---|
/// | energy | 14 (1 ln) |
/// | gradient | 15 (3 ÷, 1 ln) |
/// | energy, gradient and Hessian | 42 (3 ÷, 1 ln) |
/// | flip | 14 (3 ÷, 1 ln) |
/// | twist | 14 (3 ÷, 1 ln) |
/// | blocks | 45 (3 ÷, 1 ln) |
/// | blocks, continued | 134 (7 ÷, 3 ln, 6 Δ) |
///
/// A fused multiplication and addition counts as two operations, a loop over lists of length N as N times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a multiplication: ÷ divisions, √ roots, ln, exp, pow real powers, Δ divided differences, f functions that are parameters.
#[derive(Clone, Debug, PartialEq)]
#[derive(Copy)]
pub struct NeoHookean<P = f64> {
    mu: P,
    lambda: P,
    inversion: ::piola::Inversion,
}
impl NeoHookean {
    /// The material with these parameters.
    ///
    /// * `mu`: Shear modulus μ, Pa.
    /// * `lambda`: First Lamé parameter λ, Pa.
    ///
    /// # Errors
    /// Where a parameter is not finite or not admissible.
    #[allow(clippy::too_many_arguments)]
    pub fn new(
        mu: f64,
        lambda: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        if !mu.is_finite() {
            return Err(::piola::material::Inadmissible::NotFinite {
                given: ::piola::material::Given::scalar("mu", mu),
            });
        }
        if !lambda.is_finite() {
            return Err(::piola::material::Inadmissible::NotFinite {
                given: ::piola::material::Given::scalar("lambda", lambda),
            });
        }
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
        if !(mu > 0f64) {
            return Err(::piola::material::Inadmissible::Violated {
                condition: "mu > 0",
                given: ::std::vec![::piola::material::Given::scalar("mu", mu)],
            });
        }
        let material = Self {
            mu,
            lambda,
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
    /// The material with this stiffness at small strain.
    ///
    /// * `young`: Young's modulus E > 0, Pa.
    /// * `poisson`: Poisson's ratio, −1 < ν < 1/2.
    ///
    /// With μ = E/(2 (1 + ν)) and λ = E ν/((1 + ν) (1 − 2 ν)), `mu` = μ and `lambda` = λ.
    ///
    /// # Errors
    /// Where E or ν is outside its range, or what follows from them is not admissible.
    #[allow(clippy::too_many_arguments)]
    pub fn from_young_poisson(
        young: f64,
        poisson: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        let moduli = ::piola::material::Moduli::from_young_poisson(young, poisson)?;
        let mu = moduli.mu;
        let lambda = moduli.lambda;
        Self::new(mu, lambda)
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
            let Self { mu, lambda, .. } = self;
            #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
            if !(lambda >= 0f64) {
                return Err(::piola::material::Inadmissible::DoesNotRestore {
                    condition: "lambda >= 0",
                    given: ::std::vec![
                        ::piola::material::Given::scalar("lambda", lambda)
                    ],
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
    /// First Lamé parameter λ, Pa.
    #[must_use]
    pub fn lambda(&self) -> f64 {
        self.lambda
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
        Self::new(mu, self.lambda)?.with_inversion(self.inversion)
    }
    /// Replaces `lambda`.
    ///
    /// # Errors
    /// If the parameters are not admissible together, as of `new`.
    #[allow(dead_code)]
    pub fn with_lambda(
        self,
        lambda: f64,
    ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
        Self::new(self.mu, lambda)?.with_inversion(self.inversion)
    }
}
const _: () = {
    use ::piola::__private as __piola;
    #[allow(unused_variables, clippy::all)]
    impl<P: __piola::ParameterValue> ::piola::Material for NeoHookean<P> {
        #[inline(always)]
        fn energy<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> R {
            match self.inversion {
                ::piola::Inversion::Refuse => {
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let t0 = l1 * l1;
                    let t1 = l2.mul_add(l2, t0);
                    let t2 = l3.mul_add(l3, t1);
                    let t3 = t2 - R::splat(3.0);
                    let t4 = mu * t3;
                    let t5 = __piola::ln_product([l1, l2, l3]);
                    let lambda: R = __piola::ParameterValue::on(&self.lambda);
                    let t6 = t5 * t5;
                    let t7 = lambda.mul_add(t6, t4);
                    let t8 = t7 * R::splat(0.5);
                    let t9 = (-mu).mul_add(t5, t8);
                    t9
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let t0 = l1 * l1;
                    let t1 = l2.mul_add(l2, t0);
                    let t2 = l3.mul_add(l3, t1);
                    let t3 = t2 - R::splat(3.0);
                    let t4 = mu * t3;
                    let t5 = l1.max(epsilon);
                    let t6 = t5.ln();
                    let t7 = (l1 - epsilon).min(R::splat(0.0));
                    let t8 = R::splat(1.0) / t5;
                    let t9 = t7.mul_add(t8, t6);
                    let t10 = l2.max(epsilon);
                    let t11 = t10.ln();
                    let t12 = t9 + t11;
                    let t13 = (l2 - epsilon).min(R::splat(0.0));
                    let t14 = R::splat(1.0) / t10;
                    let t15 = t13.mul_add(t14, t12);
                    let t16 = l3.max(epsilon);
                    let t17 = t16.ln();
                    let t18 = t15 + t17;
                    let t19 = (l3 - epsilon).min(R::splat(0.0));
                    let t20 = R::splat(1.0) / t16;
                    let t21 = t19.mul_add(t20, t18);
                    let t22 = t7 * t7;
                    let t23 = t8 * t22;
                    let t24 = t8 * t23;
                    let t25 = t13 * t13;
                    let t26 = t14 * t25;
                    let t27 = t14.mul_add(t26, t24);
                    let t28 = t19 * t19;
                    let t29 = t20 * t28;
                    let t30 = t20.mul_add(t29, t27);
                    let t31 = (-t30).mul_add(R::splat(0.5), t21);
                    let lambda: R = __piola::ParameterValue::on(&self.lambda);
                    let t32 = t31 * lambda;
                    let t33 = t31.mul_add(t32, t4);
                    let t34 = R::splat(0.5) * t33;
                    let t35 = (-mu).mul_add(t31, t34);
                    t35
                }
            }
        }
        #[inline(always)]
        fn gradient<R: ::piola::Real>(&self, [l1, l2, l3]: [R; 3]) -> [R; 3] {
            match self.inversion {
                ::piola::Inversion::Refuse => {
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let t0 = mu * l1;
                    let t1 = __piola::ln_product([l1, l2, l3]);
                    let lambda: R = __piola::ParameterValue::on(&self.lambda);
                    let t2 = t1.mul_add(lambda, -mu);
                    let t3 = R::splat(1.0) / l1;
                    let t4 = t2.mul_add(t3, t0);
                    let t5 = mu * l2;
                    let t6 = R::splat(1.0) / l2;
                    let t7 = t2.mul_add(t6, t5);
                    let t8 = mu * l3;
                    let t9 = R::splat(1.0) / l3;
                    let t10 = t2.mul_add(t9, t8);
                    [t4, t7, t10]
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let t0 = mu * l1;
                    let lambda: R = __piola::ParameterValue::on(&self.lambda);
                    let t1 = l1.max(epsilon);
                    let t2 = t1.ln();
                    let t3 = (l1 - epsilon).min(R::splat(0.0));
                    let t4 = R::splat(1.0) / t1;
                    let t5 = t3 * t4;
                    let t6 = t2 + t5;
                    let t7 = l2.max(epsilon);
                    let t8 = t7.ln();
                    let t9 = t6 + t8;
                    let t10 = (l2 - epsilon).min(R::splat(0.0));
                    let t11 = R::splat(1.0) / t7;
                    let t12 = t10 * t11;
                    let t13 = t9 + t12;
                    let t14 = l3.max(epsilon);
                    let t15 = t14.ln();
                    let t16 = t13 + t15;
                    let t17 = (l3 - epsilon).min(R::splat(0.0));
                    let t18 = R::splat(1.0) / t14;
                    let t19 = t17 * t18;
                    let t20 = t16 + t19;
                    let t21 = t3 * t3;
                    let t22 = t4 * t21;
                    let t23 = t4 * t22;
                    let t24 = t10 * t10;
                    let t25 = t11 * t24;
                    let t26 = t11.mul_add(t25, t23);
                    let t27 = t17 * t17;
                    let t28 = t18 * t27;
                    let t29 = t18.mul_add(t28, t26);
                    let t30 = (-t29).mul_add(R::splat(0.5), t20);
                    let t31 = (-t4).mul_add(t5, t4);
                    let t32 = lambda * t30;
                    let t33 = t31.mul_add(t32, t0);
                    let t34 = (-mu).mul_add(t31, t33);
                    let t35 = mu * l2;
                    let t36 = (-t11).mul_add(t12, t11);
                    let t37 = t32.mul_add(t36, t35);
                    let t38 = (-mu).mul_add(t36, t37);
                    let t39 = mu * l3;
                    let t40 = (-t18).mul_add(t19, t18);
                    let t41 = t32.mul_add(t40, t39);
                    let t42 = (-mu).mul_add(t40, t41);
                    [t34, t38, t42]
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
            let t0 = mu * strains[0];
            let lambda: R = __piola::ParameterValue::on(&self.lambda);
            let t1 = strains[1].mul_add(l3, strains[2]);
            let t2 = strains[0] * l2;
            let t3 = l3.mul_add(t2, t1);
            let t4 = l3 * l2;
            let t5 = l1 * t4;
            let t6 = R::splat(1.0) / t5;
            let t7 = t5.logarithm();
            let t8 = R::splat(1.0).logarithm();
            let t9 = __piola::Pair::new(
                [t5, R::splat(1.0)],
                [t6, R::splat(1.0)],
                [t7, t8],
            );
            let t10 = t9.ln_quotient();
            let t11 = lambda * t3;
            let t12 = t10 * t11;
            let t13 = t0 + t12;
            let t14 = __piola::ln_product([l1, l2, l3]);
            let t15 = lambda * t14;
            let t16 = (-strains[0]).mul_add(t15, t0);
            let t17 = R::splat(1.0) / l1;
            let t18 = t16.mul_add(t17, t13);
            let t19 = mu * strains[1];
            let t20 = t12 + t19;
            let t21 = (-strains[1]).mul_add(t15, t19);
            let t22 = R::splat(1.0) / l2;
            let t23 = t21.mul_add(t22, t20);
            let t24 = mu * strains[2];
            let t25 = t12 + t24;
            let t26 = (-strains[2]).mul_add(t15, t24);
            let t27 = R::splat(1.0) / l3;
            let t28 = t26.mul_add(t27, t25);
            let inside = [t18, t23, t28];
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
                    let lambda: R = __piola::ParameterValue::on(&self.lambda);
                    let t0 = __piola::ln_product([l1, l2, l3]);
                    let t1 = lambda * t0;
                    let t2 = t1 - mu;
                    let t3 = R::splat(1.0) / l1;
                    let t4 = t2 * t3;
                    let t5 = mu.mul_add(l1, t4);
                    let t6 = R::splat(1.0) / l2;
                    let t7 = t2 * t6;
                    let t8 = mu.mul_add(l2, t7);
                    let t9 = mu * l3;
                    let t10 = R::splat(1.0) / l3;
                    let t11 = t2.mul_add(t10, t9);
                    let t12 = lambda - t2;
                    let t13 = t3 * t12;
                    let t14 = t3.mul_add(t13, mu);
                    let t15 = t6 * t12;
                    let t16 = t6.mul_add(t15, mu);
                    let t17 = t10 * t12;
                    let t18 = t10.mul_add(t17, mu);
                    let t19 = lambda * t3;
                    let t20 = t6 * t19;
                    let t21 = t10 * t19;
                    let t22 = lambda * t6;
                    let t23 = t10 * t22;
                    let t24 = mu - t1;
                    let t25 = t3 * t24;
                    let t26 = t6.mul_add(t25, mu);
                    let t27 = t10.mul_add(t25, mu);
                    let t28 = t6 * t24;
                    let t29 = t10.mul_add(t28, mu);
                    let t30 = t4.mul_add(t6, mu);
                    let t31 = t4.mul_add(t10, mu);
                    let t32 = t7.mul_add(t10, mu);
                    ::piola::material::Blocks {
                        gradient: [t5, t8, t11],
                        hessian: [t14, t16, t18, t20, t21, t23],
                        flip: [t26, t27, t29],
                        twist: [t30, t31, t32],
                    }
                }
                ::piola::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let lambda: R = __piola::ParameterValue::on(&self.lambda);
                    let t0 = l1.max(epsilon);
                    let t1 = t0.ln();
                    let t2 = (l1 - epsilon).min(R::splat(0.0));
                    let t3 = R::splat(1.0) / t0;
                    let t4 = t2 * t3;
                    let t5 = t1 + t4;
                    let t6 = l2.max(epsilon);
                    let t7 = t6.ln();
                    let t8 = t5 + t7;
                    let t9 = (l2 - epsilon).min(R::splat(0.0));
                    let t10 = R::splat(1.0) / t6;
                    let t11 = t9 * t10;
                    let t12 = t8 + t11;
                    let t13 = l3.max(epsilon);
                    let t14 = t13.ln();
                    let t15 = t12 + t14;
                    let t16 = (l3 - epsilon).min(R::splat(0.0));
                    let t17 = R::splat(1.0) / t13;
                    let t18 = t16 * t17;
                    let t19 = t15 + t18;
                    let t20 = t2 * t2;
                    let t21 = t3 * t20;
                    let t22 = t3 * t21;
                    let t23 = t9 * t9;
                    let t24 = t10 * t23;
                    let t25 = t10.mul_add(t24, t22);
                    let t26 = t16 * t16;
                    let t27 = t17 * t26;
                    let t28 = t17.mul_add(t27, t25);
                    let t29 = (-t28).mul_add(R::splat(0.5), t19);
                    let t30 = (-t3).mul_add(t4, t3);
                    let t31 = lambda * t29;
                    let t32 = t30 * t31;
                    let t33 = mu.mul_add(l1, t32);
                    let t34 = mu * t30;
                    let t35 = t33 - t34;
                    let t36 = (-t10).mul_add(t11, t10);
                    let t37 = t31 * t36;
                    let t38 = mu.mul_add(l2, t37);
                    let t39 = mu * t36;
                    let t40 = t38 - t39;
                    let t41 = (-t17).mul_add(t18, t17);
                    let t42 = t31 * t41;
                    let t43 = mu.mul_add(l3, t42);
                    let t44 = mu * t41;
                    let t45 = t43 - t44;
                    let t46 = lambda * t30;
                    let t47 = t30.mul_add(t46, mu);
                    let t48 = mu - t31;
                    let t49 = t3 * t48;
                    let t50 = t3.mul_add(t49, t47);
                    let t51 = lambda * t36;
                    let t52 = t36.mul_add(t51, mu);
                    let t53 = t10 * t48;
                    let t54 = t10.mul_add(t53, t52);
                    let t55 = lambda * t41;
                    let t56 = t41.mul_add(t55, mu);
                    let t57 = t17 * t48;
                    let t58 = t17.mul_add(t57, t56);
                    let t59 = t36 * t46;
                    let t60 = t41 * t46;
                    let t61 = t41 * t51;
                    let t62 = __piola::share_above(l1, l2, epsilon);
                    let t63 = t3 * t62;
                    let t64 = t10 * t63;
                    let t65 = -t64;
                    let t66 = R::splat(1.0) / epsilon;
                    let t67 = __piola::share_below(l1, l2, epsilon);
                    let t68 = t66 * t66;
                    let t69 = (-t67).mul_add(t68, t65);
                    let t70 = t31.mul_add(t69, mu);
                    let t71 = (-mu).mul_add(t69, t70);
                    let t72 = __piola::share_above(l1, l3, epsilon);
                    let t73 = t3 * t72;
                    let t74 = t17 * t73;
                    let t75 = -t74;
                    let t76 = __piola::share_below(l1, l3, epsilon);
                    let t77 = (-t68).mul_add(t76, t75);
                    let t78 = t31.mul_add(t77, mu);
                    let t79 = (-mu).mul_add(t77, t78);
                    let t80 = __piola::share_above(l2, l3, epsilon);
                    let t81 = t10 * t80;
                    let t82 = t17 * t81;
                    let t83 = -t82;
                    let t84 = __piola::share_below(l2, l3, epsilon);
                    let t85 = (-t68).mul_add(t84, t83);
                    let t86 = t31.mul_add(t85, mu);
                    let t87 = (-mu).mul_add(t85, t86);
                    let t88 = t32 + t37;
                    let t89 = t88 - t34;
                    let t90 = t89 - t39;
                    let t91 = l1 + l2;
                    let t92 = __piola::pole_floor([l1, l2, l3]);
                    let t93 = t91.max(t92);
                    let t94 = t90 / t93;
                    let t95 = mu + t94;
                    let t96 = t32 + t42;
                    let t97 = t96 - t34;
                    let t98 = t97 - t44;
                    let t99 = l1 + l3;
                    let t100 = t99.max(t92);
                    let t101 = t98 / t100;
                    let t102 = mu + t101;
                    let t103 = t37 + t42;
                    let t104 = t103 - t39;
                    let t105 = t104 - t44;
                    let t106 = l2 + l3;
                    let t107 = t106.max(t92);
                    let t108 = t105 / t107;
                    let t109 = mu + t108;
                    ::piola::material::Blocks {
                        gradient: [t35, t40, t45],
                        hessian: [t50, t54, t58, t59, t60, t61],
                        flip: [t71, t79, t87],
                        twist: [t95, t102, t109],
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
        const HAS_INVARIANTS: bool = true;
        #[inline(always)]
        #[allow(non_snake_case)]
        fn energy_by_invariants<R: ::piola::Real>(&self, [I1, I2, J]: [R; 3]) -> R {
            let mu: R = __piola::ParameterValue::on(&self.mu);
            let t0 = I1 - R::splat(3.0);
            let t1 = mu * t0;
            let t2 = J.ln();
            let lambda: R = __piola::ParameterValue::on(&self.lambda);
            let t3 = t2 * lambda;
            let t4 = t2.mul_add(t3, t1);
            let t5 = t4 * R::splat(0.5);
            let t6 = (-mu).mul_add(t2, t5);
            t6
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
            let t0 = mu * R::splat(0.5);
            let lambda: R = __piola::ParameterValue::on(&self.lambda);
            let t1 = J.ln();
            let t2 = lambda.mul_add(t1, -mu);
            let t3 = R::splat(1.0) / J;
            let t4 = t2 * t3;
            [t0, R::splat(0.0), t4]
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn admits_invariants<R: ::piola::Real>(&self, [I1, I2, J]: [R; 3]) -> R::Mask {
            match self.inversion {
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
            let lambda: R = __piola::ParameterValue::on(&self.lambda);
            ::core::option::Option::Some(::piola::material::Moduli {
                mu: mu,
                lambda: lambda,
            })
        }
    }
    impl ::piola::material::Graded for NeoHookean {
        type OnLanes = NeoHookean<__piola::PerLane>;
        #[inline(always)]
        fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes
        where
            Self: 'a,
        {
            NeoHookean {
                mu: __piola::PerLane::gather(|lane| material(lane).mu),
                lambda: __piola::PerLane::gather(|lane| material(lane).lambda),
                inversion: material(0).inversion,
            }
        }
    }
    impl ::piola::material::Declared for NeoHookean {
        const DESCRIPTION: ::piola::material::Description = ::piola::material::Description {
            name: "NeoHookean",
            summary: "Compressible neo-Hookean solid with a logarithmic volumetric part: rubber at moderate strain.",
            formula: "1/2 μ (I1 − 3) + 1/2 λ (ln J)² − μ ln J",
            parameters: &[
                ::piola::material::Parameter {
                    name: "mu",
                    doc: "Shear modulus μ, Pa.",
                    unit: ::core::option::Option::Some(::piola::material::Unit::Pascal),
                    form: ::piola::material::Form::Number,
                },
                ::piola::material::Parameter {
                    name: "lambda",
                    doc: "First Lamé parameter λ, Pa.",
                    unit: ::core::option::Option::Some(::piola::material::Unit::Pascal),
                    form: ::piola::material::Form::Number,
                },
            ],
            domain: "J > 0",
            extends: true,
            refusal: ::core::option::Option::None,
            admissible: &["mu > 0"],
            moduli: ["μ", "λ"],
            typical: ::core::option::Option::Some(::piola::material::Typical {
                values: &[&[380000.0], &[20000000.0]],
                source: "natural rubber, fitted to Treloar 1944",
            }),
        };
        fn from_values(
            values: &[&[f64]],
            inversion: ::piola::Inversion,
        ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
            let &[mu, lambda] = values else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "2 parameters are expected: `mu`, `lambda`".to_owned(),
                });
            };
            let Ok([mu]) = <[f64; 1]>::try_from(mu) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "`mu` must be one number".to_owned(),
                });
            };
            let Ok([lambda]) = <[f64; 1]>::try_from(lambda) else {
                return Err(::piola::material::Inadmissible::Shape {
                    expected: "`lambda` must be one number".to_owned(),
                });
            };
            Self::new(mu, lambda)?.with_inversion(inversion)
        }
    }
    impl ::piola::material::Fittable for NeoHookean {
        fn values(&self) -> ::std::vec::Vec<::std::vec::Vec<f64>> {
            ::std::vec![::std::vec![self.mu], ::std::vec![self.lambda]]
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
            let mut derivatives: [::std::vec::Vec<[f64; 3]>; 2] = [const {
                ::std::vec::Vec::new()
            }; 2];
            let t0 = R::splat(1.0) / l1;
            let t1 = l1 - t0;
            let t2 = R::splat(1.0) / l2;
            let t3 = l2 - t2;
            let t4 = R::splat(1.0) / l3;
            let t5 = l3 - t4;
            let t6 = __piola::ln_product([l1, l2, l3]);
            let t7 = t0 * t6;
            let t8 = t2 * t6;
            let t9 = t4 * t6;
            derivatives[0].push([t1, t3, t5]);
            derivatives[1].push([t7, t8, t9]);
            derivatives.concat()
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn constraints(&self) -> ::std::vec::Vec<::piola::material::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = ::piola::material::Constraint::all(
                [
                    ::piola::material::Limit::Admissible("mu > 0"),
                    ::piola::material::Limit::ShearModulus,
                    ::piola::material::Limit::BulkModulus,
                ],
                {
                    let mu: R = __piola::ParameterValue::on(&self.mu);
                    let lambda: R = __piola::ParameterValue::on(&self.lambda);
                    let t0 = mu.mul_add(R::splat(0.6666666666666666), lambda);
                    [mu, mu, t0]
                },
                {
                    let mut derivatives: [::std::vec::Vec<[f64; 3]>; 2] = [const {
                        ::std::vec::Vec::new()
                    }; 2];
                    derivatives[0]
                        .push([
                            R::splat(1.0),
                            R::splat(1.0),
                            R::splat(0.6666666666666666),
                        ]);
                    derivatives[1].push([R::splat(0.0), R::splat(0.0), R::splat(1.0)]);
                    derivatives.concat()
                },
            );
            constraints
        }
    }
};
