/// Compressible neo-Hookean solid with a logarithmic volumetric part: rubber at moderate strain.
///
/// ψ = μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)².
///
/// Bonet, Wood, *Nonlinear Continuum Mechanics for Finite Element Analysis*, 2nd ed. 2008, eq. 6.27. Defined for J > 0;
/// continued below a threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend) if λ ≥ 0.
///
/// Typical: `mu = 3.8e5, lambda = 2e7`, natural rubber, fitted to \[Treloar 1944\].
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
/// **Domain**: `J > 0`. It can be continued beyond that where `lambda >= 0`.
///
/// **Small strain**: μ = μ, λ = λ.
///
/// **Derivatives** inside the domain, with D⁻₁₂ = (ψ₁ − ψ₂)/(λ₁ − λ₂) and D⁺₁₂ = (ψ₁ + ψ₂)/(λ₁ + λ₂), where f\[x, y\] is (f(x) − f(y))/(x − y); the others follow by exchange of stretches, and formulas of more than 240 characters are left out:
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
/// | energy | 15 (1 ln) |
/// | gradient | 15 (3 ÷, 1 ln) |
/// | energy, gradient and Hessian | 43 (3 ÷, 1 ln) |
/// | flip | 14 (3 ÷, 1 ln) |
/// | twist | 14 (3 ÷, 1 ln) |
/// | blocks | 45 (3 ÷, 1 ln) |
/// | blocks, continued | 136 (7 ÷, 3 ln, 6 Δ) |
///
/// A fused multiplication and addition counts as two operations, a loop over lists of length N as N times what it does for one entry. In parentheses are those of the operations that cost more than an addition or a multiplication: ÷ divisions, √ roots, ln, exp, pow real powers, Δ divided differences, f functions that are parameters.
#[derive(Clone, Debug, PartialEq)]
#[derive(Copy)]
pub struct NeoHookean {
    mu: f64,
    lambda: f64,
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
        for value in [mu] {
            if !value.is_finite() {
                return Err(::piola::material::Inadmissible::NotFinite {
                    parameter: "mu",
                    value,
                });
            }
        }
        for value in [lambda] {
            if !value.is_finite() {
                return Err(::piola::material::Inadmissible::NotFinite {
                    parameter: "lambda",
                    value,
                });
            }
        }
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
        if !(mu > 0f64) {
            return Err(::piola::material::Inadmissible::Violated {
                condition: "mu > 0",
                given: [::std::format!("mu = {}", mu)].join(", "),
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
    /// The same material with another way to meet what lies outside its domain.
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
                    given: [::std::format!("lambda = {}", lambda)].join(", "),
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
}
impl ::piola::Material for NeoHookean {
    #[inline(always)]
    fn energy<R: ::piola::Real>(&self, stretches: [R; 3]) -> R {
        <Self as ::piola::material::Varying>::energy_of(
            &::piola::material::Uniform(self),
            stretches,
        )
    }
    #[inline(always)]
    fn gradient<R: ::piola::Real>(&self, stretches: [R; 3]) -> [R; 3] {
        <Self as ::piola::material::Varying>::gradient_of(
            &::piola::material::Uniform(self),
            stretches,
        )
    }
    #[inline(always)]
    fn gradient_at_strains<R: ::piola::Real>(&self, strains: [R; 3]) -> [R; 3] {
        <Self as ::piola::material::Varying>::gradient_at_strains_of(
            &::piola::material::Uniform(self),
            strains,
        )
    }
    #[inline(always)]
    fn blocks<R: ::piola::Real>(
        &self,
        stretches: [R; 3],
    ) -> ::piola::material::Blocks<R> {
        <Self as ::piola::material::Varying>::blocks_of(
            &::piola::material::Uniform(self),
            stretches,
        )
    }
    #[inline(always)]
    fn admits<R: ::piola::Real>(&self, stretches: [R; 3]) -> R::Mask {
        <Self as ::piola::material::Varying>::admits_of(
            &::piola::material::Uniform(self),
            stretches,
        )
    }
    const HAS_INVARIANTS: bool = true;
    #[inline(always)]
    fn energy_by_invariants<R: ::piola::Real>(&self, invariants: [R; 3]) -> R {
        <Self as ::piola::material::Varying>::energy_by_invariants_of(
            &::piola::material::Uniform(self),
            invariants,
        )
    }
    #[inline(always)]
    fn gradient_by_invariants<R: ::piola::Real>(&self, invariants: [R; 3]) -> [R; 3] {
        <Self as ::piola::material::Varying>::gradient_by_invariants_of(
            &::piola::material::Uniform(self),
            invariants,
        )
    }
    #[inline(always)]
    fn admits_invariants<R: ::piola::Real>(&self, invariants: [R; 3]) -> R::Mask {
        <Self as ::piola::material::Varying>::admits_invariants_of(
            &::piola::material::Uniform(self),
            invariants,
        )
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
    fn stated_moduli(&self) -> ::core::option::Option<::piola::material::Moduli> {
        ::core::option::Option::Some(::piola::material::Declared::moduli(self))
    }
}
#[allow(unused_variables, clippy::all)]
impl ::piola::material::Varying for NeoHookean {
    #[inline(always)]
    fn energy_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        [l1,
        l2,
        l3,
        ]: [R; 3],
    ) -> R {
        match ::piola::material::Parameters::first(materials).inversion {
            ::piola::Inversion::Refuse => {
                let mu = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.mu);
                let t0 = l1 * l1;
                let t1 = l2.mul_add(l2, t0);
                let t2 = l3.mul_add(l3, t1);
                let t3 = t2 - R::splat(3.0);
                let t4 = mu * t3;
                let t5 = t4 * R::splat(0.5);
                let t6 = ::piola::quotient::ln_product([l1, l2, l3]);
                let lambda = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.lambda);
                let t7 = t6 * t6;
                let t8 = lambda * t7;
                let t9 = R::splat(0.5).mul_add(t8, t5);
                let t10 = (-mu).mul_add(t6, t9);
                t10
            }
            ::piola::Inversion::Extend { epsilon: epsilon } => {
                let epsilon = R::splat(epsilon);
                let mu = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.mu);
                let t0 = l1 * l1;
                let t1 = l2.mul_add(l2, t0);
                let t2 = l3.mul_add(l3, t1);
                let t3 = t2 - R::splat(3.0);
                let t4 = mu * t3;
                let t5 = t4 * R::splat(0.5);
                let t6 = l1.max(epsilon);
                let t7 = t6.ln();
                let t8 = (l1 - epsilon).min(R::splat(0.0));
                let t9 = R::splat(1.0) / t6;
                let t10 = t8.mul_add(t9, t7);
                let t11 = l2.max(epsilon);
                let t12 = t11.ln();
                let t13 = t10 + t12;
                let t14 = (l2 - epsilon).min(R::splat(0.0));
                let t15 = R::splat(1.0) / t11;
                let t16 = t14.mul_add(t15, t13);
                let t17 = l3.max(epsilon);
                let t18 = t17.ln();
                let t19 = t16 + t18;
                let t20 = (l3 - epsilon).min(R::splat(0.0));
                let t21 = R::splat(1.0) / t17;
                let t22 = t20.mul_add(t21, t19);
                let t23 = t8 * t8;
                let t24 = t9 * t23;
                let t25 = t9 * t24;
                let t26 = (-R::splat(0.5)).mul_add(t25, t22);
                let t27 = t14 * t14;
                let t28 = t15 * t27;
                let t29 = t15 * t28;
                let t30 = (-R::splat(0.5)).mul_add(t29, t26);
                let t31 = t20 * t20;
                let t32 = t21 * t31;
                let t33 = t21 * t32;
                let t34 = (-R::splat(0.5)).mul_add(t33, t30);
                let lambda = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.lambda);
                let t35 = t34 * lambda;
                let t36 = t34 * t35;
                let t37 = R::splat(0.5).mul_add(t36, t5);
                let t38 = (-mu).mul_add(t34, t37);
                t38
            }
        }
    }
    #[inline(always)]
    fn gradient_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        [l1,
        l2,
        l3,
        ]: [R; 3],
    ) -> [R; 3] {
        match ::piola::material::Parameters::first(materials).inversion {
            ::piola::Inversion::Refuse => {
                let mu = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.mu);
                let t0 = mu * l1;
                let t1 = ::piola::quotient::ln_product([l1, l2, l3]);
                let lambda = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.lambda);
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
                let mu = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.mu);
                let t0 = mu * l1;
                let lambda = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.lambda);
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
                let t24 = (-t23).mul_add(R::splat(0.5), t20);
                let t25 = t10 * t10;
                let t26 = t11 * t25;
                let t27 = t11 * t26;
                let t28 = (-R::splat(0.5)).mul_add(t27, t24);
                let t29 = t17 * t17;
                let t30 = t18 * t29;
                let t31 = t18 * t30;
                let t32 = (-R::splat(0.5)).mul_add(t31, t28);
                let t33 = (-t4).mul_add(t5, t4);
                let t34 = lambda * t32;
                let t35 = t33.mul_add(t34, t0);
                let t36 = (-mu).mul_add(t33, t35);
                let t37 = mu * l2;
                let t38 = (-t11).mul_add(t12, t11);
                let t39 = t34.mul_add(t38, t37);
                let t40 = (-mu).mul_add(t38, t39);
                let t41 = mu * l3;
                let t42 = (-t18).mul_add(t19, t18);
                let t43 = t34.mul_add(t42, t41);
                let t44 = (-mu).mul_add(t42, t43);
                [t36, t40, t44]
            }
        }
    }
    #[inline(always)]
    fn gradient_at_strains_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        strains: [R; 3],
    ) -> [R; 3] {
        let [l1, l2, l3] = [
            R::splat(1.0) + strains[0],
            R::splat(1.0) + strains[1],
            R::splat(1.0) + strains[2],
        ];
        let mu = ::piola::material::Parameters::read::<
            R,
        >(materials, |material| material.mu);
        let t0 = mu * strains[0];
        let lambda = ::piola::material::Parameters::read::<
            R,
        >(materials, |material| material.lambda);
        let t1 = strains[1].mul_add(l3, strains[2]);
        let t2 = strains[0] * l2;
        let t3 = l3.mul_add(t2, t1);
        let t4 = l3 * l2;
        let t5 = l1 * t4;
        let t6 = R::splat(1.0) / t5;
        let t7 = t5.logarithm();
        let t8 = R::splat(1.0).logarithm();
        let t9 = ::piola::quotient::Pair::new(
            [t5, R::splat(1.0)],
            [t6, R::splat(1.0)],
            [t7, t8],
        );
        let t10 = t9.ln_quotient();
        let t11 = lambda * t3;
        let t12 = t10 * t11;
        let t13 = t0 + t12;
        let t14 = ::piola::quotient::ln_product([l1, l2, l3]);
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
        if let ::piola::Inversion::Extend { epsilon: epsilon } = ::piola::material::Parameters::first(
                materials,
            )
            .inversion
        {
            let below = strains[2].less(R::splat(epsilon - 1.0));
            if ::piola::lanes::Mask::any(below) {
                let extended = <Self as ::piola::material::Varying>::gradient_of(
                    materials,
                    [
                        R::splat(1.0) + strains[0],
                        R::splat(1.0) + strains[1],
                        R::splat(1.0) + strains[2],
                    ],
                );
                return [
                    R::select(below, extended[0], inside[0]),
                    R::select(below, extended[1], inside[1]),
                    R::select(below, extended[2], inside[2]),
                ];
            }
        }
        inside
    }
    #[inline(always)]
    fn blocks_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        [l1,
        l2,
        l3,
        ]: [R; 3],
    ) -> ::piola::material::Blocks<R> {
        match ::piola::material::Parameters::first(materials).inversion {
            ::piola::Inversion::Refuse => {
                let mu = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.mu);
                let lambda = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.lambda);
                let t0 = ::piola::quotient::ln_product([l1, l2, l3]);
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
                let mu = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.mu);
                let lambda = ::piola::material::Parameters::read::<
                    R,
                >(materials, |material| material.lambda);
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
                let t23 = (-t22).mul_add(R::splat(0.5), t19);
                let t24 = t9 * t9;
                let t25 = t10 * t24;
                let t26 = t10 * t25;
                let t27 = (-R::splat(0.5)).mul_add(t26, t23);
                let t28 = t16 * t16;
                let t29 = t17 * t28;
                let t30 = t17 * t29;
                let t31 = (-R::splat(0.5)).mul_add(t30, t27);
                let t32 = (-t3).mul_add(t4, t3);
                let t33 = lambda * t31;
                let t34 = t32 * t33;
                let t35 = mu.mul_add(l1, t34);
                let t36 = mu * t32;
                let t37 = t35 - t36;
                let t38 = (-t10).mul_add(t11, t10);
                let t39 = t33 * t38;
                let t40 = mu.mul_add(l2, t39);
                let t41 = mu * t38;
                let t42 = t40 - t41;
                let t43 = (-t17).mul_add(t18, t17);
                let t44 = t33 * t43;
                let t45 = mu.mul_add(l3, t44);
                let t46 = mu * t43;
                let t47 = t45 - t46;
                let t48 = lambda * t32;
                let t49 = t32.mul_add(t48, mu);
                let t50 = mu - t33;
                let t51 = t3 * t50;
                let t52 = t3.mul_add(t51, t49);
                let t53 = lambda * t38;
                let t54 = t38.mul_add(t53, mu);
                let t55 = t10 * t50;
                let t56 = t10.mul_add(t55, t54);
                let t57 = lambda * t43;
                let t58 = t43.mul_add(t57, mu);
                let t59 = t17 * t50;
                let t60 = t17.mul_add(t59, t58);
                let t61 = t38 * t48;
                let t62 = t43 * t48;
                let t63 = t43 * t53;
                let t64 = ::piola::quotient::share_above(l1, l2, epsilon);
                let t65 = t3 * t64;
                let t66 = t10 * t65;
                let t67 = -t66;
                let t68 = R::splat(1.0) / epsilon;
                let t69 = ::piola::quotient::share_below(l1, l2, epsilon);
                let t70 = t68 * t68;
                let t71 = (-t69).mul_add(t70, t67);
                let t72 = t33.mul_add(t71, mu);
                let t73 = (-mu).mul_add(t71, t72);
                let t74 = ::piola::quotient::share_above(l1, l3, epsilon);
                let t75 = t3 * t74;
                let t76 = t17 * t75;
                let t77 = -t76;
                let t78 = ::piola::quotient::share_below(l1, l3, epsilon);
                let t79 = (-t70).mul_add(t78, t77);
                let t80 = t33.mul_add(t79, mu);
                let t81 = (-mu).mul_add(t79, t80);
                let t82 = ::piola::quotient::share_above(l2, l3, epsilon);
                let t83 = t10 * t82;
                let t84 = t17 * t83;
                let t85 = -t84;
                let t86 = ::piola::quotient::share_below(l2, l3, epsilon);
                let t87 = (-t70).mul_add(t86, t85);
                let t88 = t33.mul_add(t87, mu);
                let t89 = (-mu).mul_add(t87, t88);
                let t90 = t34 + t39;
                let t91 = t90 - t36;
                let t92 = t91 - t41;
                let t93 = l1 + l2;
                let t94 = ::piola::quotient::pole_floor([l1, l2, l3]);
                let t95 = t93.max(t94);
                let t96 = t92 / t95;
                let t97 = mu + t96;
                let t98 = t34 + t44;
                let t99 = t98 - t36;
                let t100 = t99 - t46;
                let t101 = l1 + l3;
                let t102 = t101.max(t94);
                let t103 = t100 / t102;
                let t104 = mu + t103;
                let t105 = t39 + t44;
                let t106 = t105 - t41;
                let t107 = t106 - t46;
                let t108 = l2 + l3;
                let t109 = t108.max(t94);
                let t110 = t107 / t109;
                let t111 = mu + t110;
                ::piola::material::Blocks {
                    gradient: [t37, t42, t47],
                    hessian: [t52, t56, t60, t61, t62, t63],
                    flip: [t73, t81, t89],
                    twist: [t97, t104, t111],
                }
            }
        }
    }
    #[inline(always)]
    fn admits_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        [l1,
        l2,
        l3,
        ]: [R; 3],
    ) -> R::Mask {
        match ::piola::material::Parameters::first(materials).inversion {
            ::piola::Inversion::Refuse => R::splat(0.0).less(l3),
            ::piola::Inversion::Extend { .. } => {
                <R::Mask as ::piola::lanes::Mask>::splat(true)
            }
        }
    }
    #[inline(always)]
    #[allow(non_snake_case)]
    fn energy_by_invariants_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        [I1,
        I2,
        J,
        ]: [R; 3],
    ) -> R {
        let mu = ::piola::material::Parameters::read::<
            R,
        >(materials, |material| material.mu);
        let t0 = I1 - R::splat(3.0);
        let t1 = mu * t0;
        let t2 = t1 * R::splat(0.5);
        let t3 = J.ln();
        let lambda = ::piola::material::Parameters::read::<
            R,
        >(materials, |material| material.lambda);
        let t4 = t3 * lambda;
        let t5 = t3 * t4;
        let t6 = R::splat(0.5).mul_add(t5, t2);
        let t7 = (-mu).mul_add(t3, t6);
        t7
    }
    #[inline(always)]
    #[allow(non_snake_case)]
    fn gradient_by_invariants_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        [I1,
        I2,
        J,
        ]: [R; 3],
    ) -> [R; 3] {
        let mu = ::piola::material::Parameters::read::<
            R,
        >(materials, |material| material.mu);
        let t0 = mu * R::splat(0.5);
        let lambda = ::piola::material::Parameters::read::<
            R,
        >(materials, |material| material.lambda);
        let t1 = J.ln();
        let t2 = lambda.mul_add(t1, -mu);
        let t3 = R::splat(1.0) / J;
        let t4 = t2 * t3;
        [t0, R::splat(0.0), t4]
    }
    #[inline(always)]
    #[allow(non_snake_case)]
    fn admits_invariants_of<R: ::piola::Real>(
        materials: &impl ::piola::material::Parameters<Self>,
        [I1,
        I2,
        J,
        ]: [R; 3],
    ) -> R::Mask {
        match ::piola::material::Parameters::first(materials).inversion {
            ::piola::Inversion::Refuse => R::splat(0.0).less(J),
            ::piola::Inversion::Extend { epsilon: epsilon } => {
                (R::splat(epsilon) * I1).less(J + J)
            }
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
                is_list: false,
            },
            ::piola::material::Parameter {
                name: "lambda",
                doc: "First Lamé parameter λ, Pa.",
                is_list: false,
            },
        ],
        domain: "J > 0",
        extends: true,
        refusal: ::core::option::Option::None,
        admissible: &["mu > 0"],
        moduli: ["μ", "λ"],
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
    #[allow(unused_imports, clippy::all)]
    fn moduli(&self) -> ::piola::material::Moduli {
        use ::piola::Real;
        type R = f64;
        let mu = R::splat(self.mu);
        let lambda = R::splat(self.lambda);
        ::piola::material::Moduli {
            mu: mu,
            lambda: lambda,
        }
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
        let t6 = ::piola::quotient::ln_product([l1, l2, l3]);
        let t7 = t0 * t6;
        let t8 = t2 * t6;
        let t9 = t4 * t6;
        derivatives[0].push([t1, t3, t5]);
        derivatives[1].push([t7, t8, t9]);
        derivatives.concat()
    }
}
