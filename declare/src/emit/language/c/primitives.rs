//! Functions of C that programs are made of, written by hand.

use piola::__private::record::{Binary, Function, Unary};

use super::{C, Dialect, Needs};

impl C {
    pub(super) fn functions_of(&self, needs: &Needs<'_>) -> String {
        let Self { prefix, upper, dialect, .. } = self;
        let (number, end, suffix) = (self.number(), self.end(), self.suffix());
        let function = self.function(number);
        let (bits, signed) = match (dialect, self.is_single) {
            (_, true) => ("unsigned", "int"),
            (Dialect::OpenCl, false) => ("ulong", "long"),
            (_, false) => ("unsigned long long", "long long"),
        };
        let (mantissa, bias, infinity) = match self.is_single {
            true => (23, 127, "0x7f800000u"),
            false => (
                52,
                1023,
                if *dialect == Dialect::OpenCl { "0x7ff0000000000000UL" } else { "0x7ff0000000000000ull" },
            ),
        };
        // ¾/u, √½, the smallest normal number, and 1/u with its exponent.
        let (rounding, half_root, smallest, lift, digits) = match self.is_single {
            true => ("12582912.0f", "0x3f3504f3", "1.17549435e-38f", "16777216.0f", 24),
            false => (
                "6755399441055744.0",
                "0x3fe6a09e667f3bcd",
                "2.2250738585072014e-308",
                "9007199254740992.0",
                53,
            ),
        };
        let fast = if self.is_single { "FP_FAST_FMAF" } else { "FP_FAST_FMA" };
        let has_fast = match dialect {
            // A device has no such macro, and clang has only that of the processor.
            Dialect::Cuda => format!(
                "defined({fast}) || defined(__FMA__) || defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)"
            ),
            Dialect::C | Dialect::OpenCl => format!("defined({fast}) || defined(__FMA__)"),
        };
        let mut text = format!(
            "#if {has_fast}
#define {upper}_MUL_ADD(a, b, c) fma{suffix}(a, b, c)
#else
#define {upper}_MUL_ADD(a, b, c) ((a) * (b) + (c))
#endif

"
        );
        let (scales, splits) = (needs.binary(Binary::Scale), needs.calls(Function::Split));
        let copies_sign = *dialect == Dialect::Cuda && needs.binary(Binary::CopySign);
        let has_power = needs.unary(Unary::LeadingPower);
        let has_reciprocal = needs.unary(Unary::ReciprocalOfPower);
        let of_bits = format!("{}_of_bits({bits} bits)", function);
        let to_bits = format!("{}_to_bits({number} x)", self.function(bits));
        if *dialect == Dialect::OpenCl {
            text += &format!(
                "{of_bits} {{ return as_{number}(bits); }}\n\n{to_bits} {{ return as_{}(x); }}\n\n",
                if self.is_single { "uint" } else { "ulong" }
            );
        } else if *dialect == Dialect::Cuda || scales || splits || has_power || has_reciprocal {
            text += &format!(
                "{of_bits} {{
    {number} x;
    memcpy(&x, &bits, sizeof x);
    return x;
}}

{to_bits} {{
    {bits} bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}}

"
            );
        }
        if copies_sign {
            text += &format!(
                "/* |x| with the sign of y. */
{function}_copysign({number} x, {number} y) {{
    const {bits} sign = ({bits})1 << {};
    return {prefix}_of_bits(({prefix}_to_bits(x) & ~sign) | ({prefix}_to_bits(y) & sign));
}}

",
                if self.is_single { 31 } else { 63 }
            );
        }
        if scales {
            text += &format!(
                "/* x 2^e, rounded once; two factors, since 2^e itself may be out of range. */
{function}_scale({number} x, {number} e) {{
    const {number} first = (e * 0.5{end} + {rounding}) - {rounding};
    const {bits} low = {prefix}_to_bits(first + ({rounding} + {bias}.0{end}));
    const {bits} high = {prefix}_to_bits((e - first) + ({rounding} + {bias}.0{end}));
    return x * {prefix}_of_bits(low << {mantissa}) * {prefix}_of_bits(high << {mantissa});
}}

"
            );
        }
        if has_power {
            text += &format!(
                "/* The power of two in |x|. */
{function}_leading_power({number} x) {{
    return {prefix}_of_bits({prefix}_to_bits(x) & {infinity});
}}

"
            );
        }
        if has_reciprocal {
            text += &format!(
                "/* 1/x for a power of two. */
{function}_reciprocal_of_power({number} x) {{
    return {prefix}_of_bits((({bits}){} << {mantissa}) - {prefix}_to_bits(x));
}}

",
                2 * bias
            );
        }
        if splits {
            let [nan, infinite] =
                [f64::NAN, f64::INFINITY].map(|value| super::Language::literal(self, value));
            text += &format!(
                "/* x = m 2^e with sqrt(1/2) <= m < sqrt(2). */
{function}_split({number} x, {number} *e) {{
    const int is_tiny = x < {smallest};
    const {number} lifted = is_tiny ? x * {lift} : x;
    const {signed} bits = ({signed}){prefix}_to_bits(lifted);
    const {signed} exponent = ({signed})(({bits})bits - ({bits}){half_root}) >> {mantissa};
    const {number} found = ({number})exponent - (is_tiny ? {digits}.0{end} : 0.0{end});
    const {number} limit = x < 0.0{end} ? {nan} : -{infinite};
    *e = x < {infinite} ? (0.0{end} < x ? found : limit) : x;
    return {prefix}_of_bits(({bits})bits - (({bits})exponent << {mantissa}));
}}

"
            );
        }
        if needs.calls(Function::ProductError) {
            let without = match (self.is_single, dialect) {
                (true, Dialect::C | Dialect::Cuda) => {
                    "    return (float)((double)a * (double)b - (double)(a * b));\n".to_owned()
                }
                _ => format!(
                    "    const {number} a_big = {splitter} * a, b_big = {splitter} * b;
    const {number} ah = a_big - (a_big - a), bh = b_big - (b_big - b);
    const {number} al = a - ah, bl = b - bh;
    return al * bl - (((a * b - ah * bh) - al * bh) - ah * bl);
",
                    splitter = if self.is_single { "4097.0f" } else { "134217729.0" }
                ),
            };
            text += &format!(
                "/* The rounding error of a b. */
{function}_product_error({number} a, {number} b) {{
#if {has_fast}
    return fma{suffix}(a, b, -(a * b));
#else
{without}#endif
}}

"
            );
        }
        text
    }
}
