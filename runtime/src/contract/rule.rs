//! Rules of the contract by name, with their requirements.

use std::fmt;

/// Declares the rules: variant with documentation, name and promise of each.
macro_rules! rules {
    ($($(#[$doc:meta])* $Rule:ident $name:literal: $promise:literal,)*) => {
        /// A rule of the contract.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Rule {
            $($(#[$doc])* $Rule,)*
        }

        impl Rule {
            /// All rules, in the order above.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$Rule),*];

            /// The promise of a material that keeps the rule, in one line.
            #[must_use]
            pub(super) const fn promise(self) -> &'static str {
                match self {
                    $(Self::$Rule => $promise,)*
                }
            }
        }

        /// The name of the rule, which is also that of its test in [`contract!`](crate::contract!).
        impl fmt::Display for Rule {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self {
                    $(Self::$Rule => $name,)*
                })
            }
        }
    };
}

rules! {
    /// Rest state F = I: no stress and zero twists, [unless they are
    /// meant](super::Settings::stress_free_at_rest); flips of ψ11 − ψ12 = 2μ > 0.
    Rest "rest": "F = I is free of stress, and shear is resisted there",
    /// Finite results wherever the material is defined, and a true
    /// [`ends_at_zero_volume`](crate::Material::ends_at_zero_volume):
    ///
    /// * energy, gradient and blocks are finite at the samples, and so are energy and gradient if λ3 is only
    ///   2⁻¹⁰, 2⁻²⁰ and 2⁻³⁰ of λ1, of either sign, if such stretches are admitted;
    /// * but at these small λ3 ψ may be +∞: an exponential in `I1b`, say, overflows as J falls, at the end of
    ///   the range of numbers and not of the domain. Such a point is `nonfinite`, and a solver takes a
    ///   shorter step. If ψ > 2⁵¹² Pa, the root of the largest number, derivatives overflow before ψ does and
    ///   are not checked. NaN and −∞ are violations;
    /// * if only one of λ3 = ±2⁻¹⁰⁰⁰ is admitted, `ends_at_zero_volume` holds.
    Domain "domain": "where the energy is defined, it and its derivatives are finite numbers",
    /// Objectivity and isotropy: ψ(Q F W) = ψ(F), P(Q F W) = Q P(F) W for rotations Q, W, F = diag(λ); and
    /// where λi = λj, ψi = ψj and ψii = ψjj.
    ///
    /// Rotations change the stretches by rounding only: a material breaks the first two if that is enough to
    /// change its results beyond their tolerance, or makes them NaN.
    Isotropy "isotropy":
        "rotations of space and of the rest shape rotate the stress, and no stretch is preferred",
    /// Stress as the slope of the energy: (ψ(F + h A) − ψ(F − h A))/2h approaches P : A as h², and from one
    /// sample to the next ψ grows by the work of its gradient.
    ///
    /// Near a sample, an energy that jumps elsewhere would look correct.
    StressSlope "stress_slope": "P is the derivative of the energy",
    /// Tangent as the slope of the stress: (P(F + h A) − P(F − h A))/2h approaches (dP/dF) A as h².
    TangentSlope "tangent_slope": "dP/dF is the derivative of P",
    /// Derivatives by dual numbers: `energy` gives the ψi of `gradient` and `blocks`, and `gradient` the ψij,
    /// in either order of differentiation.
    ///
    /// Both the energy and its derivatives are sums of terms no larger than the tangent, with tens of
    /// roundings.
    DualNumbers "dual_numbers":
        "gradient and Hessian are the derivatives of `energy` and `gradient`, to rounding",
    /// Accuracy of flips and twists at gaps of 10⁻¹ … 10⁻¹⁶ and 0 of the larger stretch, and at all samples.
    Quotients "quotients": "flips and twists keep their digits at every gap between stretches, zero included",
    /// Agreement of `gradient_at_strains` at s with `gradient` at 1 + s, to the rounding of 1 + s: for
    /// strains of samples with λ3 > 0, and these times 10⁻¹ … 10⁻¹⁵ and 0.
    Strains "strains": "`gradient_at_strains` is the gradient at the stretches 1 + s",
    /// Agreement of the methods by invariants with those by stretches, where the material admits the
    /// invariants:
    ///
    /// * the stretches are admitted too;
    /// * the energies agree;
    /// * ψi = 2λi W1 + 2λi (λj² + λk²) W2 + λjλk WJ;
    /// * Hessian, flips and twists follow from W1 … WJJ by the rules of calculus.
    Invariants "invariants": "energy and derivatives by I1, I2 and J are those by stretches",
    /// Smooth, restoring extension of a material whose [`inversion`](crate::Material::inversion) is
    /// `Inversion::Extend { epsilon }`:
    ///
    /// * it admits an inverted point if it admits its mirror image;
    /// * difference quotients of ψ approach P, and those of P approach dP/dF, as h² on either side of the
    ///   threshold, with λ3 alone or λ2 as well near ε, and deep inside inversion, at λ3 = −0.01, −0.5 and
    ///   −2;
    /// * those across the threshold do so as h² and as h, since third derivatives of ψ jump there;
    /// * ∂ψ/∂λ3 < 0 wherever λ3 < ε and J < 1, so that inverted material is driven back.
    ///
    /// Depths beyond the [`range`](super::Settings::range) are left out.
    Extension "extension": "beyond its domain the energy continues smoothly and restores",
    /// Agreement of the moduli of [`stated_moduli`](crate::Material::stated_moduli) with μ = (ψ11 − ψ12)/2
    /// and λ = ψ12 at F = I.
    Moduli "moduli": "the stated moduli are those of the Hessian at rest",
    /// Agreement of energy, gradient, Hessian and quotients in `f32` and `f64`, to roundings of `f32`: at the
    /// samples, and where two stretches are 10⁻² … 10⁻⁷ of their mean apart or equal. Results that are finite
    /// in `f64` are finite in `f32`, too.
    ///
    /// Likewise far from rest, within the range of `f32`: where one or two stretches of a sample are 10⁻² …
    /// 10⁻⁴ of what they were, and all are 10⁻² … 10² times. A formula that cancels there loses digits in
    /// `f32` first, and in `f64` on elements that are flatter still.
    SinglePrecision "single_precision": "in `f32` all numbers are those of `f64`, to the rounding of `f32`",
    /// Agreement of every result on lanes with the result at its point alone:
    ///
    /// * on the portable back end, with the bits of a scalar;
    /// * on any, with the same bits regardless of its lane and its neighbours;
    /// * on the fastest one of this processor, as a scalar up to rounding: it has other instructions.
    ///
    /// Neighbours differ as much as they can: next to one of the samples are the same stretches with two of
    /// them 10⁻⁹ apart and equal, so that operations for some lanes only are detected. Truth values are
    /// compared as 0 and 1.
    Lanes "lanes": "on lanes every number is what it is by itself",
}
