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
/// A fused multiplication and addition counts as two operations, a loop over lists of length N as N times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a multiplication: ÷ divisions, √ roots, ln, exp, φ other elementary functions, pow real powers, Δ divided differences, f functions that are parameters.
#[derive(Clone, Debug, PartialEq)]
#[derive(Copy)]
pub struct NeoHookean<P = f64> {
    mu: P,
    lambda: P,
    inversion: ::piola::Inversion,
}
const _: () = {
    use ::piola::__private as __p;
    #[allow(clippy::too_many_arguments)]
    impl NeoHookean {
        /// The material with these parameters.
        ///
        /// * `mu`: Shear modulus μ, Pa.
        /// * `lambda`: First Lamé parameter λ, Pa.
        ///
        /// # Errors
        /// Where a parameter is not finite or not admissible.
        pub fn new(mu: f64, lambda: f64) -> __p::Result<Self, __p::MaterialError> {
            __p::finite("mu", mu)?;
            __p::finite("lambda", lambda)?;
            __p::admissible(mu > 0f64, "mu > 0", &[("mu", None, mu)])?;
            __p::stable_at_rest(Self {
                mu,
                lambda,
                inversion: __p::Inversion::Refuse,
            })
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
        pub fn from_young_poisson(
            young: f64,
            poisson: f64,
        ) -> __p::Result<Self, __p::MaterialError> {
            let moduli = __p::Moduli::from_young_poisson(young, poisson)?;
            Self::new(moduli.mu, moduli.lambda)
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
                let Self { lambda, .. } = self;
                __p::restoring(
                    lambda >= 0f64,
                    "lambda >= 0",
                    &[("lambda", None, lambda)],
                )?;
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
        pub fn with_mu(self, mu: f64) -> __p::Result<Self, __p::MaterialError> {
            Self::new(mu, self.lambda)?.with_inversion(self.inversion)
        }
        /// Replaces `lambda`.
        ///
        /// # Errors
        /// If the parameters are not admissible together, as of `new`.
        #[allow(dead_code)]
        pub fn with_lambda(self, lambda: f64) -> __p::Result<Self, __p::MaterialError> {
            Self::new(self.mu, lambda)?.with_inversion(self.inversion)
        }
    }
    #[allow(unused_variables, clippy::all)]
    impl<P: __p::ParameterValue> ::piola::Material for NeoHookean<P> {
        #[inline(always)]
        fn energy<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> R {
            match self.inversion {
                __p::Inversion::Refuse => {
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let t4 = mu
                        * (l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0));
                    let t5 = __p::ln_product([l1, l2, l3]);
                    let lambda: R = __p::ParameterValue::on(&self.lambda);
                    (-mu).mul_add(t5, lambda.mul_add(t5 * t5, t4) * R::splat(0.5))
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let t4 = mu
                        * (l3.mul_add(l3, l2.mul_add(l2, l1 * l1)) - R::splat(3.0));
                    let t5 = l1.max(epsilon);
                    let t6 = t5.ln();
                    let t7 = (l1 - epsilon).min(R::splat(0.0));
                    let t8 = R::splat(1.0) / t5;
                    let t9 = t7.mul_add(t8, t6);
                    let t10 = l2.max(epsilon);
                    let t12 = t9 + t10.ln();
                    let t13 = (l2 - epsilon).min(R::splat(0.0));
                    let t14 = R::splat(1.0) / t10;
                    let t15 = t13.mul_add(t14, t12);
                    let t16 = l3.max(epsilon);
                    let t18 = t15 + t16.ln();
                    let t19 = (l3 - epsilon).min(R::splat(0.0));
                    let t20 = R::splat(1.0) / t16;
                    let t31 = (-t20
                        .mul_add(
                            t20 * (t19 * t19),
                            t14.mul_add(t14 * (t13 * t13), t8 * (t8 * (t7 * t7))),
                        ))
                        .mul_add(R::splat(0.5), t19.mul_add(t20, t18));
                    let lambda: R = __p::ParameterValue::on(&self.lambda);
                    (-mu).mul_add(t31, R::splat(0.5) * t31.mul_add(t31 * lambda, t4))
                }
            }
        }
        #[inline(always)]
        fn gradient<R: __p::Real>(&self, [l1, l2, l3]: [R; 3]) -> [R; 3] {
            match self.inversion {
                __p::Inversion::Refuse => {
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let lambda: R = __p::ParameterValue::on(&self.lambda);
                    let t0 = mu * l1;
                    let t2 = __p::ln_product([l1, l2, l3]).mul_add(lambda, -mu);
                    [
                        t2.mul_add(R::splat(1.0) / l1, t0),
                        t2.mul_add(R::splat(1.0) / l2, mu * l2),
                        t2.mul_add(R::splat(1.0) / l3, mu * l3),
                    ]
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let lambda: R = __p::ParameterValue::on(&self.lambda);
                    let t0 = mu * l1;
                    let t1 = l1.max(epsilon);
                    let t2 = t1.ln();
                    let t3 = (l1 - epsilon).min(R::splat(0.0));
                    let t4 = R::splat(1.0) / t1;
                    let t5 = t3 * t4;
                    let t6 = t2 + t5;
                    let t7 = l2.max(epsilon);
                    let t9 = t6 + t7.ln();
                    let t10 = (l2 - epsilon).min(R::splat(0.0));
                    let t11 = R::splat(1.0) / t7;
                    let t12 = t10 * t11;
                    let t13 = t9 + t12;
                    let t14 = l3.max(epsilon);
                    let t16 = t13 + t14.ln();
                    let t17 = (l3 - epsilon).min(R::splat(0.0));
                    let t18 = R::splat(1.0) / t14;
                    let t19 = t17 * t18;
                    let t30 = (-t18
                        .mul_add(
                            t18 * (t17 * t17),
                            t11.mul_add(t11 * (t10 * t10), t4 * (t4 * (t3 * t3))),
                        ))
                        .mul_add(R::splat(0.5), t16 + t19);
                    let t31 = (-t4).mul_add(t5, t4);
                    let t32 = lambda * t30;
                    let t34 = (-mu).mul_add(t31, t31.mul_add(t32, t0));
                    let t35 = mu * l2;
                    let t36 = (-t11).mul_add(t12, t11);
                    let t38 = (-mu).mul_add(t36, t32.mul_add(t36, t35));
                    let t39 = mu * l3;
                    let t40 = (-t18).mul_add(t19, t18);
                    [t34, t38, (-mu).mul_add(t40, t32.mul_add(t40, t39))]
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
            let t0 = mu * strains[0];
            let t1 = R::splat(1.0) / l1;
            let lambda: R = __p::ParameterValue::on(&self.lambda);
            let t2 = t0.mul_add(t1, t0);
            let t5 = l3.mul_add(strains[0] * l2, strains[1].mul_add(l3, strains[2]));
            let t7 = l1 * (l3 * l2);
            let t11 = __p::Pair::new(
                [t7, R::splat(1.0)],
                [R::splat(1.0) / t7, R::splat(1.0)],
                [t7.logarithm(), R::splat(1.0).logarithm()],
            );
            let t12 = t11.ln_quotient();
            let t13 = lambda * t5;
            let t15 = t12.mul_add(t1 * t13, t2);
            let t16 = mu * strains[1];
            let t17 = R::splat(1.0) / l2;
            let t20 = t12.mul_add(t13 * t17, t16.mul_add(t17, t16));
            let t21 = mu * strains[2];
            let t22 = R::splat(1.0) / l3;
            let inside = [t15, t20, t12.mul_add(t13 * t22, t21.mul_add(t22, t21))];
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
                    let lambda: R = __p::ParameterValue::on(&self.lambda);
                    let t1 = lambda * __p::ln_product([l1, l2, l3]);
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
                    let t14 = t3.mul_add(t3 * t12, mu);
                    let t16 = t6.mul_add(t6 * t12, mu);
                    let t18 = t10.mul_add(t10 * t12, mu);
                    let t19 = lambda * t3;
                    let t20 = t6 * t19;
                    let t21 = t10 * t19;
                    let t23 = t10 * (lambda * t6);
                    let t24 = mu - t1;
                    let t25 = t3 * t24;
                    __p::Blocks {
                        gradient: [t5, t8, t11],
                        hessian: [t14, t16, t18, t20, t21, t23],
                        flip: [
                            t6.mul_add(t25, mu),
                            t10.mul_add(t25, mu),
                            t10.mul_add(t6 * t24, mu),
                        ],
                        twist: [
                            t4.mul_add(t6, mu),
                            t4.mul_add(t10, mu),
                            t7.mul_add(t10, mu),
                        ],
                    }
                }
                __p::Inversion::Extend { epsilon: epsilon } => {
                    let epsilon = R::splat(epsilon);
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let lambda: R = __p::ParameterValue::on(&self.lambda);
                    let t0 = l1.max(epsilon);
                    let t1 = t0.ln();
                    let t2 = (l1 - epsilon).min(R::splat(0.0));
                    let t3 = R::splat(1.0) / t0;
                    let t4 = t2 * t3;
                    let t5 = t1 + t4;
                    let t6 = l2.max(epsilon);
                    let t8 = t5 + t6.ln();
                    let t9 = (l2 - epsilon).min(R::splat(0.0));
                    let t10 = R::splat(1.0) / t6;
                    let t11 = t9 * t10;
                    let t12 = t8 + t11;
                    let t13 = l3.max(epsilon);
                    let t15 = t12 + t13.ln();
                    let t16 = (l3 - epsilon).min(R::splat(0.0));
                    let t17 = R::splat(1.0) / t13;
                    let t18 = t16 * t17;
                    let t29 = (-t17
                        .mul_add(
                            t17 * (t16 * t16),
                            t10.mul_add(t10 * (t9 * t9), t3 * (t3 * (t2 * t2))),
                        ))
                        .mul_add(R::splat(0.5), t15 + t18);
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
                    let t50 = t3.mul_add(t3 * t48, t47);
                    let t51 = lambda * t36;
                    let t54 = t10.mul_add(t10 * t48, t36.mul_add(t51, mu));
                    let t58 = t17.mul_add(t17 * t48, t41.mul_add(lambda * t41, mu));
                    let t59 = t36 * t46;
                    let t60 = t41 * t46;
                    let t61 = t41 * t51;
                    let t65 = -(t10 * (t3 * __p::share_above(l1, l2, epsilon)));
                    let t66 = R::splat(1.0) / epsilon;
                    let t67 = __p::share_below(l1, l2, epsilon);
                    let t68 = t66 * t66;
                    let t69 = (-t67).mul_add(t68, t65);
                    let t71 = (-mu).mul_add(t69, t31.mul_add(t69, mu));
                    let t77 = (-t68)
                        .mul_add(
                            __p::share_below(l1, l3, epsilon),
                            -(t17 * (t3 * __p::share_above(l1, l3, epsilon))),
                        );
                    let t79 = (-mu).mul_add(t77, t31.mul_add(t77, mu));
                    let t85 = (-t68)
                        .mul_add(
                            __p::share_below(l2, l3, epsilon),
                            -(t17 * (t10 * __p::share_above(l2, l3, epsilon))),
                        );
                    let t87 = (-mu).mul_add(t85, t31.mul_add(t85, mu));
                    let t90 = ((t32 + t37) - t34) - t39;
                    let t91 = l1 + l2;
                    let t92 = __p::pole_floor([l1, l2, l3]);
                    __p::Blocks {
                        gradient: [t35, t40, t45],
                        hessian: [t50, t54, t58, t59, t60, t61],
                        flip: [t71, t79, t87],
                        twist: [
                            mu + (t90 / t91.max(t92)),
                            mu + ((((t32 + t42) - t34) - t44) / (l1 + l3).max(t92)),
                            mu + ((((t37 + t42) - t39) - t44) / (l2 + l3).max(t92)),
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
        const HAS_INVARIANTS: bool = true;
        const HAS_SECOND_INVARIANT: bool = false;
        const CURVATURE_BY_INVARIANTS: __p::Curvature = __p::Curvature::Volume;
        #[inline(always)]
        #[allow(non_snake_case)]
        fn energy_by_invariants<R: __p::Real>(&self, [I1, I2, J]: [R; 3]) -> R {
            let mu: R = __p::ParameterValue::on(&self.mu);
            let t1 = mu * (I1 - R::splat(3.0));
            let t2 = J.ln();
            let lambda: R = __p::ParameterValue::on(&self.lambda);
            (-mu).mul_add(t2, t2.mul_add(t2 * lambda, t1) * R::splat(0.5))
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn gradient_by_invariants<R: __p::Real>(&self, [I1, I2, J]: [R; 3]) -> [R; 3] {
            let mu: R = __p::ParameterValue::on(&self.mu);
            let lambda: R = __p::ParameterValue::on(&self.lambda);
            [
                mu * R::splat(0.5),
                R::splat(0.0),
                lambda.mul_add(J.ln(), -mu) * (R::splat(1.0) / J),
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
            let lambda: R = __p::ParameterValue::on(&self.lambda);
            let t0 = mu * R::splat(0.5);
            let t2 = lambda.mul_add(J.ln(), -mu);
            let t3 = R::splat(1.0) / J;
            [
                t0,
                R::splat(0.0),
                t2 * t3,
                R::splat(0.0),
                R::splat(0.0),
                t3 * (t3 * (lambda - t2)),
                R::splat(0.0),
                R::splat(0.0),
                R::splat(0.0),
            ]
        }
        #[inline(always)]
        #[allow(non_snake_case)]
        fn admits_invariants<R: __p::Real>(&self, [I1, I2, J]: [R; 3]) -> R::Mask {
            match self.inversion {
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
            let lambda: R = __p::ParameterValue::on(&self.lambda);
            __p::stated_moduli(mu, lambda)
        }
    }
    impl __p::Graded for NeoHookean {
        type OnLanes<'lanes> = NeoHookean<__p::PerLane>;
        #[inline(always)]
        fn on_lanes<'lanes>(
            material: impl ::core::ops::Fn(usize) -> &'lanes Self + ::core::marker::Copy,
        ) -> Self::OnLanes<'lanes>
        where
            Self: 'lanes,
        {
            NeoHookean {
                mu: __p::PerLane::gather(|lane| material(lane).mu),
                lambda: __p::PerLane::gather(|lane| material(lane).lambda),
                inversion: material(0).inversion,
            }
        }
    }
    impl __p::Declared for NeoHookean {
        const DESCRIPTION: __p::Description = __p::Description {
            name: __p::Borrowed("NeoHookean"),
            summary: __p::Borrowed(
                "Compressible neo-Hookean solid with a logarithmic volumetric part: rubber at moderate strain.",
            ),
            formula: __p::Borrowed("1/2 μ (I1 − 3) + 1/2 λ (ln J)² − μ ln J"),
            parameters: __p::Borrowed(
                &[
                    __p::Parameter {
                        name: __p::Borrowed("mu"),
                        doc: __p::Borrowed("Shear modulus μ, Pa."),
                        unit: Some(__p::Unit::Pascal),
                        form: __p::Form::Number,
                    },
                    __p::Parameter {
                        name: __p::Borrowed("lambda"),
                        doc: __p::Borrowed("First Lamé parameter λ, Pa."),
                        unit: Some(__p::Unit::Pascal),
                        form: __p::Form::Number,
                    },
                ],
            ),
            domain: __p::Borrowed("J > 0"),
            extends: true,
            refusal: None,
            admissible: __p::Borrowed(&[__p::Borrowed("mu > 0")]),
            moduli: [__p::Borrowed("μ"), __p::Borrowed("λ")],
            typical: Some(__p::Typical {
                values: __p::Borrowed(
                    &[__p::Borrowed(&[380000.0]), __p::Borrowed(&[20000000.0])],
                ),
                source: __p::Borrowed("natural rubber, fitted to Treloar 1944"),
            }),
        };
        fn from_values(
            values: &[&[f64]],
            inversion: __p::Inversion,
        ) -> __p::Result<Self, __p::MaterialError> {
            let mut values = __p::Values::new(values, &["mu", "lambda"])?;
            Self::new(values.number()?, values.number()?)?.with_inversion(inversion)
        }
    }
    impl __p::Fittable for NeoHookean {
        fn values(&self) -> __p::Vec<__p::Vec<f64>> {
            ::std::vec![::std::vec![self.mu], ::std::vec![self.lambda]]
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn gradient_by_parameters(&self, [l1, l2, l3]: [f64; 3]) -> __p::Vec<[f64; 3]> {
            use ::piola::Real;
            type R = f64;
            let mut derivatives: [__p::Vec<[f64; 3]>; 2] = [const {
                __p::Vec::new()
            }; 2];
            let t0 = R::splat(1.0) / l1;
            let t1 = l1 - t0;
            let t2 = R::splat(1.0) / l2;
            let t3 = l2 - t2;
            let t4 = R::splat(1.0) / l3;
            let t5 = l3 - t4;
            let t6 = __p::ln_product([l1, l2, l3]);
            derivatives[0].push([t1, t3, t5]);
            derivatives[1].push([t0 * t6, t2 * t6, t4 * t6]);
            derivatives.concat()
        }
        #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
        fn constraints(&self) -> __p::Vec<__p::Constraint> {
            use ::piola::Real;
            type R = f64;
            let mut constraints = __p::Constraint::all(
                [
                    __p::Limit::Admissible(__p::Borrowed("mu > 0")),
                    __p::Limit::ShearModulus,
                    __p::Limit::BulkModulus,
                ],
                {
                    let mu: R = __p::ParameterValue::on(&self.mu);
                    let lambda: R = __p::ParameterValue::on(&self.lambda);
                    [mu, mu, mu.mul_add(R::splat(0.6666666666666666), lambda)]
                },
                {
                    let mut derivatives: [__p::Vec<[f64; 3]>; 2] = [const {
                        __p::Vec::new()
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
