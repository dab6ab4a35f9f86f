//@ all
fn {prefix}_of_bits(bits: u32) -> f32 {
    return bitcast<f32>(bits);
}

fn {prefix}_is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) < 0x7f800000u;
}

/* Zero, unless the last input was not finite: which no compiler knows. */
var<private> {prefix}_nothing: u32;

/* x, which is rounded before it is used: compilers may not combine what it is made of with what it is used for. */
fn {prefix}_rounded(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) ^ {prefix}_nothing);
}

//@ is_exact
/* False if the compiler changes sums or takes NaN for finite. x is 0.25. A parameter that is not finite is
 * another mistake. Where `||` branches, the compiler would know that the hidden bits are zero. */
fn {prefix}_is_exact() -> bool {
    let x = {prefix}_of_bits(0x3e800000u ^ {prefix}_nothing);
    let nan = {prefix}_of_bits(0x7fc00000u ^ {prefix}_nothing);
    let sum = {prefix}_rounded({prefix}_rounded(x + 12582912.0f) - 12582912.0f);
    return ({prefix}_nothing != 0u) | ((sum == 0.0f) & !{prefix}_is_finite(nan));
}

//@ copysign
/* |x| with the sign of y. */
fn {prefix}_copysign(x: f32, y: f32) -> f32 {
    return bitcast<f32>((bitcast<u32>(x) & 0x7fffffffu) | (bitcast<u32>(y) & 0x80000000u));
}

//@ scale
/* x 2^e, rounded once; two factors, since 2^e itself may be out of range. */
fn {prefix}_scale(x: f32, e: f32) -> f32 {
    let first = round(e * 0.5f);
    let low = bitcast<u32>(i32(first) + 127) << 23u;
    let high = bitcast<u32>(i32(e - first) + 127) << 23u;
    return {prefix}_rounded({prefix}_rounded(x * bitcast<f32>(low)) * bitcast<f32>(high));
}

//@ leading_power
/* The power of two in |x|. */
fn {prefix}_leading_power(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0x7f800000u);
}

//@ reciprocal_of_power
/* 1/x for a power of two. */
fn {prefix}_reciprocal_of_power(x: f32) -> f32 {
    return bitcast<f32>((254u << 23u) - bitcast<u32>(x));
}

//@ split
/* x = m 2^e with sqrt(1/2) <= m < sqrt(2). */
fn {prefix}_split(x: f32, e: ptr<function, f32>) -> f32 {
    let is_tiny = x < 1.17549435e-38f;
    let bits = bitcast<i32>(select(x, x * 16777216.0f, is_tiny));
    let exponent = (bits - 0x3f3504f3) >> 23u;
    let found = f32(exponent) - select(0.0f, 24.0f, is_tiny);
    let limit = {prefix}_of_bits(select(0xff800000u, 0x7fc00000u, x < 0.0f));
    *e = select(x, select(limit, found, 0.0f < x), {prefix}_is_finite(x) || x < 0.0f);
    return bitcast<f32>(bits - (exponent << 23u));
}

//@ product_error
/* The rounding error of a b, by halves of the digits. */
fn {prefix}_product_error(a: f32, b: f32) -> f32 {
    let ah = bitcast<f32>(bitcast<u32>(a) & 0xfffff000u);
    let bh = bitcast<f32>(bitcast<u32>(b) & 0xfffff000u);
    let al = a - ah;
    let bl = b - bh;
    let first = {prefix}_rounded({prefix}_rounded(a * b) - ah * bh);
    return al * bl - {prefix}_rounded({prefix}_rounded(first - al * bh) - ah * bl);
}

