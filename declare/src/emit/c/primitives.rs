//! Functions of C that programs are made of, written by hand.

use piola::__private::record::{Binary, Function, RecordedOperation, Recording, Unary};

use super::Printer;
use crate::emit::Precision;

impl Printer<'_> {
    /// Functions that programs are made of, those that one of them needs.
    pub(super) fn primitives(&self, recordings: &[&Recording]) -> String {
        let Self { prefix, upper, number, suffix, .. } = self;
        let all: Vec<_> = recordings
            .iter()
            .flat_map(|recording| recording.functions.values().chain([&recording.program]))
            .flat_map(|program| &program.operations)
            .collect();
        let has = |wanted: &dyn Fn(&RecordedOperation) -> bool| all.iter().any(|operation| wanted(operation));
        let calls =
            |function| has(&|operation| matches!(operation, RecordedOperation::Call(f, _) if *f == function));
        let unary = |operator| {
            has(&|operation| matches!(operation, RecordedOperation::Unary(o, _) if *o == operator))
        };
        let scales = has(&|operation| matches!(operation, RecordedOperation::Binary(Binary::Scale, ..)));
        let single = self.file.precision == Precision::F32;
        let (bits, signed, mantissa, bias) = match single {
            true => ("uint32_t", "int32_t", 23, 127),
            false => ("uint64_t", "int64_t", 52, 1023),
        };
        // ¾/u, √½, the smallest normal number, and 1/u with its exponent.
        let (rounding, half_root, smallest, lift, digits) = match single {
            true => ("12582912.0f", "0x3f3504f3", "1.17549435e-38f", "16777216.0f", 24),
            false => (
                "6755399441055744.0",
                "0x3fe6a09e667f3bcd",
                "2.2250738585072014e-308",
                "9007199254740992.0",
                53,
            ),
        };
        let fast = if single { "FP_FAST_FMAF" } else { "FP_FAST_FMA" };
        let mut text = format!(
            "#ifdef {fast}
#define {upper}_MUL_ADD(a, b, c) fma{suffix}(a, b, c)
#else
#define {upper}_MUL_ADD(a, b, c) ((a) * (b) + (c))
#endif

"
        );
        let splits = calls(Function::Split);
        if splits || scales || unary(Unary::LeadingPower) || unary(Unary::ReciprocalOfPower) {
            text += &format!(
                "static inline {number} {prefix}_of_bits({bits} bits) {{
    {number} x;
    memcpy(&x, &bits, sizeof x);
    return x;
}}

static inline {bits} {prefix}_to_bits({number} x) {{
    {bits} bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}}

"
            );
        }
        if scales {
            text += &format!(
                "/* x 2^e, rounded once; two factors, since 2^e itself may be out of range. */
static inline {number} {prefix}_scale({number} x, {number} e) {{
    const {number} first = (e * 0.5{suffix} + {rounding}) - {rounding};
    const {bits} low = {prefix}_to_bits(first + ({rounding} + {bias}.0{suffix}));
    const {bits} high = {prefix}_to_bits((e - first) + ({rounding} + {bias}.0{suffix}));
    return x * {prefix}_of_bits(low << {mantissa}) * {prefix}_of_bits(high << {mantissa});
}}

"
            );
        }
        if unary(Unary::LeadingPower) {
            text += &format!(
                "/* The power of two in |x|. */
static inline {number} {prefix}_leading_power({number} x) {{
    return {prefix}_of_bits({prefix}_to_bits(x) & {prefix}_to_bits(({number})INFINITY));
}}

"
            );
        }
        if unary(Unary::ReciprocalOfPower) {
            text += &format!(
                "/* 1/x for a power of two. */
static inline {number} {prefix}_reciprocal_of_power({number} x) {{
    return {prefix}_of_bits((({bits}){} << {mantissa}) - {prefix}_to_bits(x));
}}

",
                2 * bias
            );
        }
        if splits {
            text += &format!(
                "/* x = m 2^e with sqrt(1/2) <= m < sqrt(2). */
static inline {number} {prefix}_split({number} x, {number} *e) {{
    const int is_tiny = x < {smallest};
    const {number} lifted = is_tiny ? x * {lift} : x;
    const {signed} bits = ({signed}){prefix}_to_bits(lifted);
    const {signed} exponent = ({signed})(({bits})bits - ({bits}){half_root}) >> {mantissa};
    const {number} found = ({number})exponent - (is_tiny ? {digits}.0{suffix} : 0.0{suffix});
    const {number} limit = x < 0.0{suffix} ? ({number})NAN : -({number})INFINITY;
    *e = x < ({number})INFINITY ? (0.0{suffix} < x ? found : limit) : x;
    return {prefix}_of_bits(({bits})bits - (({bits})exponent << {mantissa}));
}}

"
            );
        }
        if calls(Function::ProductError) {
            let without = match single {
                true => "    return (float)((double)a * (double)b - (double)(a * b));\n".to_owned(),
                false => "    const double a_big = 134217729.0 * a, b_big = 134217729.0 * b;
    const double ah = a_big - (a_big - a), bh = b_big - (b_big - b);
    const double al = a - ah, bl = b - bh;
    return al * bl - (((a * b - ah * bh) - al * bh) - ah * bl);
"
                .to_owned(),
            };
            text += &format!(
                "/* The rounding error of a b. */
static inline {number} {prefix}_product_error({number} a, {number} b) {{
#ifdef {fast}
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
