//@ head of c
#include <float.h>
#include <math.h>
#include <string.h>
//@ head of cuda
#if !defined(__CUDACC_RTC__) && !defined(__HIPCC_RTC__) && !defined(WP_NO_CRT)
#include <math.h>
#include <string.h>
#endif
#if defined(__CUDACC__) || defined(__HIPCC__)
#define {upper}_DEVICE __host__ __device__
#else
#define {upper}_DEVICE
#endif
//@ head
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST) || \
    defined(__FAST_RELAXED_MATH__) || (defined(__USE_FAST_MATH__) && __USE_FAST_MATH__)
//@ head of c
#error "compile without -ffast-math, -Ofast, -funsafe-math-optimizations, -ffinite-math-only, /fp:fast; icx: -fp-model=precise"
//@ head of cuda
#error "compile without --use_fast_math, -ffast-math, -Ofast, -funsafe-math-optimizations, -ffinite-math-only, /fp:fast"
//@ head of opencl
#error "build without -cl-fast-relaxed-math, -cl-unsafe-math-optimizations, -cl-finite-math-only"
//@ head
#endif
//@ head of c
/* clang 15 and later also have -1 for options that the pragma below switches off. */
#if ({is_wide}) && !(FLT_EVAL_METHOD == -1 && defined(__clang__) && defined(__x86_64__))
#error "compile without -ffast-math and its parts, and with arithmetic in the format itself (-msse2 -mfpmath=sse)"
#endif
//@ head
/* clang has no macros for most of these options, and ignores this pragma for other processors. */
#if (defined(__clang__) ? defined(__x86_64__) : defined(_MSC_VER)) && \
    !defined(__CUDA_ARCH__) && !defined(__HIP_DEVICE_COMPILE__)
#define {upper}_PRECISE
#pragma float_control(precise, on, push)
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif
#endif
//@ head of opencl in double
#if __OPENCL_C_VERSION__ < 120
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
//@ head of opencl
#pragma OPENCL FP_CONTRACT OFF
//@ all
#if {has_fast}
#define {upper}_MUL_ADD(a, b, c) fma{suffix}(a, b, c)
#else
#define {upper}_MUL_ADD(a, b, c) ((a) * (b) + (c))
#endif

//@ bits of opencl
{function}_of_bits({bits} bits) { return as_{number}(bits); }

{function_to_bits}_to_bits({number} x) { return as_{opencl_bits}(x); }

//@ bits
{function}_of_bits({bits} bits) {
    {number} x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

{function_to_bits}_to_bits({number} x) {
    {bits} bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

//@ is_finite
{upper}_FUNCTION int {prefix}_is_finite({number} x) {
    return ({prefix}_to_bits(x) & {infinity_bits}) < {infinity_bits};
}

//@ is_exact
/* False if options of the compiler change sums or comparisons, which volatile numbers hide from it. */
{upper}_FUNCTION int {prefix}_is_exact(void) {
    volatile {number} quarter = 0.25{end}, three = 3.0{end}, zero = 0.0{end};
    const {number} x = quarter, y = three, z = zero / zero;
    const {number} sum = (x + {rounding}) - {rounding};
    const {number} fused = {upper}_MUL_ADD(y, 1.0{end} / {lift}, y);
    const {number} nan = {upper}_MUL_ADD(z, 0.0{end}, 0.0{end});
//@ is_exact on a device
#ifdef __CUDA_ARCH__
    volatile {number} smallest = {smallest};
    /* --use_fast_math makes this zero, in addition to worse divisions and roots. */
    if (smallest * 0.5{end} == 0.0{end}) return 0;
#endif
//@ is_exact
    return sum == 0.0{end} && fused > y && !(nan < 1.0{end}) && !(1.0{end} <= nan);
}

//@ copysign
/* |x| with the sign of y. */
{function}_copysign({number} x, {number} y) {
    const {bits} sign = ({bits})1 << {sign_place};
    return {prefix}_of_bits(({prefix}_to_bits(x) & ~sign) | ({prefix}_to_bits(y) & sign));
}

//@ scale
/* x 2^e, rounded once; two factors, since 2^e itself may be out of range. */
{function}_scale({number} x, {number} e) {
    const {number} first = (e * 0.5{end} + {rounding}) - {rounding};
    const {bits} low = {prefix}_to_bits(first + ({rounding} + {bias}.0{end}));
    const {bits} high = {prefix}_to_bits((e - first) + ({rounding} + {bias}.0{end}));
    return x * {prefix}_of_bits(low << {mantissa}) * {prefix}_of_bits(high << {mantissa});
}

//@ leading_power
/* The power of two in |x|. */
{function}_leading_power({number} x) {
    return {prefix}_of_bits({prefix}_to_bits(x) & {infinity_bits});
}

//@ reciprocal_of_power
/* 1/x for a power of two. */
{function}_reciprocal_of_power({number} x) {
    return {prefix}_of_bits((({bits}){twice_bias} << {mantissa}) - {prefix}_to_bits(x));
}

//@ split
/* x = m 2^e with sqrt(1/2) <= m < sqrt(2). */
{function}_split({number} x, {number} *e) {
    const int is_tiny = x < {smallest};
    const {number} lifted = is_tiny ? x * {lift} : x;
    const {signed} bits = ({signed}){prefix}_to_bits(lifted);
    const {signed} exponent = ({signed})(({bits})bits - ({bits}){half_root}) >> {mantissa};
    const {number} found = ({number})exponent - (is_tiny ? {digits}.0{end} : 0.0{end});
    const {number} limit = x < 0.0{end} ? {nan} : -{infinity};
    *e = x < {infinity} ? (0.0{end} < x ? found : limit) : x;
    return {prefix}_of_bits(({bits})bits - (({bits})exponent << {mantissa}));
}

//@ product_error
/* The rounding error of a b. */
{function}_product_error({number} a, {number} b) {
#if {has_fast}
    return fma{suffix}(a, b, -(a * b));
#else
//@ product_error in double
    return (float)((double)a * (double)b - (double)(a * b));
//@ product_error by halves
    const {number} a_big = {splitter} * a, b_big = {splitter} * b;
    const {number} ah = a_big - (a_big - a), bh = b_big - (b_big - b);
    const {number} al = a - ah, bl = b - bh;
    return al * bl - (((a * b - ah * bh) - al * bh) - ah * bl);
//@ product_error
#endif
}

