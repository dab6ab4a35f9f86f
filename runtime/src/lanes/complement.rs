//! The complement of the error function without the exponential in it: e^(x²) erfc x.
//!
//! It falls as 1/x from 1 at x = 0, and (1 + 2x) times it stays between 1 and 1.3, so that one polynomial in
//! (x − 3.5)/(x + 3.5) has it for all x ≥ 0. Erf needs it, and its divided difference, which may be as small
//! as erfc.

use super::polynomial::polynomial;
use super::real::Real;

/// X(x) = e^(x²) erfc x for x ≥ 0, with a relative error of a few u.
///
/// The polynomial's is below 2⁻⁵⁵ (`f32`: 2⁻²⁵).
#[inline(always)]
pub(crate) fn scaled_complement<R: Real>(x: R) -> R {
    const SINGLE: [f64; 12] = [
        1.242_349_3,
        -0.140_009_25,
        -0.010_556_81,
        0.097_521_09,
        -0.115_075_17,
        0.087_968_595,
        -0.048_886_113,
        0.019_146_021,
        -0.004_090_828_4,
        -0.000_377_595_25,
        0.000_449_263_7,
        -0.000_059_270_165,
    ];
    const DOUBLE: [f64; 24] = [
        1.242_349_244_871_154_4,
        -0.140_009_180_137_619_8,
        -0.010_555_596_332_220_838,
        0.097_519_095_153_295_1,
        -0.115_089_598_160_065_56,
        0.087_983_153_823_815_32,
        -0.048_823_325_830_318_266,
        0.019_099_330_956_066_63,
        -0.004_215_019_884_471_702,
        -0.000_302_267_972_930_556_43,
        0.000_564_384_289_546_535_3,
        -0.000_121_512_038_221_427_26,
        -0.000_042_781_807_993_800_61,
        0.000_024_260_076_598_966_927,
        2.327_461_691_384_984_7e-6,
        -3.813_614_842_377_661e-6,
        -4.325_337_927_630_413e-8,
        6.010_240_537_611_203e-7,
        -8.488_709_207_230_264e-9,
        -9.606_964_049_277_308e-8,
        6.123_052_258_996_297e-10,
        1.348_866_601_285_687_7e-8,
        7.021_742_502_926_128e-11,
        -1.141_484_862_026_002_1e-9,
    ];
    let centre = R::splat(3.5);
    let t = (x - centre) / (x + centre);
    polynomial(t, &SINGLE, &DOUBLE) / x.mul_add(R::splat(2.0), R::splat(1.0))
}
