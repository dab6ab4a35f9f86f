//! The languages of files: words, literals, and the lines around a function.
//!
//! C is C99 that is C++17 as well, with dialects for graphics processors. In WGSL a number is an `f32`, and a
//! compiler may compute as with real numbers, none of them infinite or NaN. Mesa's compiler does: (a + b) − a
//! becomes b, a b + a c becomes a (b + c), and 0 a becomes 0. So every result of arithmetic is hidden from
//! it: the bits are combined with bits that are zero, which the compiler cannot know. In C this would cost
//! time: options that permit the same are refused by their macros, switched off by a pragma, or detected by
//! the check of the parameters, which computes a sum and a NaN. Finite numbers are recognised by their bits.

mod primitives;

use piola::__private::record::{Binary, Id, RecordedOperation, Unary};

use super::{Precision, Target};

/// Keywords of C99, C++20 and OpenCL C, and macros of headers and compilers.
const RESERVED_IN_C: &str = "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t \
    char32_t class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue \
    decltype default delete do double dynamic_cast else enum explicit export extern false float for friend goto if \
    inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public \
    register reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct \
    switch template this thread_local throw true try typedef typeid typename typeof union unsigned using virtual void \
    volatile wchar_t while xor xor_eq I complex imaginary INFINITY NAN HUGE_VAL NULL M_E M_PI MAXFLOAT errno linux unix near \
    far small global local constant kernel half uchar ushort uint ulong read_only write_only read_write uniform pipe event_t \
    sampler_t image1d_t image2d_t image3d_t size_t";

/// Keywords and reserved words of WGSL.
const RESERVED_IN_WGSL: &str = "alias break case const const_assert continue continuing default diagnostic discard else enable \
    false fn for if let loop override requires return struct switch true var while NULL Self abstract active alignas \
    alignof as asm asm_fragment async attribute auto await become binding_array cast catch class co_await co_return \
    co_yield coherent column_major common compile compile_fragment concept const_cast consteval constexpr constinit crate \
    debugger decltype delete demote demote_to_helper do dynamic_cast enum explicit export extends extern external \
    fallthrough filter final finally friend from fxgroup get goto groupshared highp impl implements import inline \
    instanceof interface layout lowp macro macro_rules match mediump meta mod module move mut mutable namespace new nil \
    noexcept noinline nointerpolation non_coherent noncoherent noperspective null nullptr of operator package packoffset \
    partition pass patch pixelfragment precise precision premerge priv protected pub public readonly ref regardless \
    register reinterpret_cast require resource restrict self set shared sizeof smooth snorm static static_assert \
    static_cast std subroutine super target template this thread_local throw trait try type typedef typeid typename \
    typeof union unless unorm unsafe unsized use using varying virtual volatile wgsl where with writeonly yield bool f16 \
    f32 i32 u32 array atomic ptr vec2 vec3 vec4";

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number,
    Truth,
    /// Bits that a function returns.
    Status,
}

/// An argument of a function of the file.
pub(super) enum Argument<'a> {
    /// The structure of the parameters, `p`.
    Parameters,
    /// A number.
    Number(&'a str),
    /// Numbers to be read.
    Input(&'a str, usize),
    /// Numbers to be written.
    Output(&'a str, usize),
}

/// A language, with the number format and the prefix of a file.
pub(super) struct Language {
    target: Target,
    is_single: bool,
    prefix: String,
    /// The prefix of macros.
    upper: String,
}

impl Language {
    pub(super) fn new(target: Target, precision: Precision, prefix: &str) -> Self {
        let is_single = precision == Precision::F32;
        Self { target, is_single, prefix: prefix.to_owned(), upper: prefix.to_uppercase() }
    }

    fn is_c(&self) -> bool {
        self.target != Target::Wgsl
    }

    fn type_of(&self, kind: Kind) -> &'static str {
        match (kind, self.is_c()) {
            (Kind::Number, true) if self.is_single => "float",
            (Kind::Number, true) => "double",
            (Kind::Number, false) => "f32",
            (Kind::Truth, true) => "int",
            (Kind::Truth, false) => "bool",
            (Kind::Status, true) => "unsigned",
            (Kind::Status, false) => "u32",
        }
    }

    /// The end of literals.
    fn end(&self) -> &'static str {
        if self.is_single { "f" } else { "" }
    }

    /// The end of names of functions of the library, which OpenCL and WGSL overload.
    fn suffix(&self) -> &'static str {
        if matches!(self.target, Target::C | Target::Cuda) { self.end() } else { "" }
    }

    /// Qualifiers and type of a function in C, and the prefix of its name.
    fn function(&self, result: &str) -> String {
        format!("{}_FUNCTION {result} {}", self.upper, self.prefix)
    }

    /// True if conditions on parameters are in `double`, as in the constructor.
    fn has_double(&self) -> bool {
        !self.is_single || matches!(self.target, Target::C | Target::Cuda)
    }

    /// True if a field cannot have this name.
    pub(super) fn is_reserved(&self, name: &str) -> bool {
        let reserved = if self.is_c() { RESERVED_IN_C } else { RESERVED_IN_WGSL };
        reserved.split_ascii_whitespace().any(|word| word == name)
    }

    pub(super) fn literal(&self, value: f64) -> String {
        let number = self.type_of(Kind::Number);
        let single = value as f32;
        match (self.target, self.is_single) {
            // Compilers would leave it out of a sum, with the sign of the sum.
            (Target::Wgsl, _) if single == 0.0 => self.rounded(format!("{single:?}f")),
            // CUDA's compiler at run time has no macros for them.
            (Target::Cuda, false) if !value.is_finite() => {
                format!("{}_of_bits({:#x}ull)", self.prefix, value.to_bits())
            }
            (Target::Cuda | Target::Wgsl, true) if !single.is_finite() => {
                format!("{}_of_bits({:#x}u)", self.prefix, single.to_bits())
            }
            _ if value.is_nan() => format!("({number})NAN"),
            _ if value.is_infinite() => format!("{}({number})INFINITY", if value < 0.0 { "-" } else { "" }),
            (_, false) => format!("{value:?}"),
            (_, true) => format!("{single:?}f"),
        }
    }

    pub(super) fn truth(&self, truth: bool) -> String {
        if self.is_c() { u8::from(truth).to_string() } else { truth.to_string() }
    }

    /// A statement with a value that is not changed.
    pub(super) fn constant(&self, kind: Kind, name: &str, value: &str) -> String {
        let words = if self.is_c() { format!("const {}", self.type_of(kind)) } else { "let".to_owned() };
        format!("{words} {name} = {value};")
    }

    /// A statement with a variable that is assigned later; zeroed, if not every way assigns it.
    pub(super) fn variable(&self, kind: Kind, name: &str, is_zeroed: bool) -> String {
        let of_kind = self.type_of(kind);
        match self.is_c() {
            true => format!("{of_kind} {name}{};", if is_zeroed { " = 0" } else { "" }),
            false => format!("var {name}: {of_kind};"),
        }
    }

    pub(super) fn parameter(&self, name: &str, entry: Option<usize>) -> String {
        let within = if self.is_c() { "->" } else { "." };
        entry.map_or_else(|| format!("p{within}{name}"), |entry| format!("p{within}{name}[{entry}]"))
    }

    /// An entry of an output of `count` numbers.
    pub(super) fn output(&self, name: &str, count: usize, entry: usize) -> String {
        match (count, self.is_c()) {
            (1, _) => format!("*{name}"),
            (_, true) => format!("{name}[{entry}]"),
            (_, false) => format!("(*{name})[{entry}]"),
        }
    }

    /// The result of an operation of arithmetic, rounded before it is used.
    fn rounded(&self, result: String) -> String {
        if self.is_c() { result } else { format!("{}_rounded({result})", self.prefix) }
    }

    /// The first statement of a function that returns a status, whose first input this is.
    pub(super) fn start(&self, input: &str) -> String {
        match self.is_c() {
            true => String::new(),
            false => format!("    {0}_nothing = select(1u, 0u, {0}_is_finite({input}));\n", self.prefix),
        }
    }

    pub(super) fn is_finite(&self, a: &str) -> String {
        format!("{}_is_finite({a})", self.prefix)
    }

    /// The text of an operation, given the text of each operand.
    pub(super) fn expression(
        &self,
        id: Id,
        operation: &RecordedOperation,
        o: &dyn Fn(Id) -> String,
    ) -> String {
        let Self { prefix, upper, .. } = self;
        let (is_c, suffix) = (self.is_c(), self.suffix());
        match *operation {
            RecordedOperation::Unary(operator, a) => match (operator, o(a)) {
                (Unary::Negate, a) => format!("-{a}"),
                (Unary::Absolute, a) if is_c => format!("fabs{suffix}({a})"),
                (Unary::Absolute, a) => format!("abs({a})"),
                (Unary::SquareRoot, a) => self.rounded(format!("sqrt{suffix}({a})")),
                (Unary::LeadingPower, a) => format!("{prefix}_leading_power({a})"),
                (Unary::ReciprocalOfPower, a) => format!("{prefix}_reciprocal_of_power({a})"),
            },
            RecordedOperation::Binary(operator, a, b) => match (operator, o(a), o(b)) {
                (Binary::Add, a, b) => self.rounded(format!("{a} + {b}")),
                (Binary::Subtract, a, b) => self.rounded(format!("{a} - {b}")),
                (Binary::Multiply, a, b) => self.rounded(format!("{a} * {b}")),
                (Binary::Divide, a, b) => self.rounded(format!("{a} / {b}")),
                // Warp's compiler has none.
                (Binary::CopySign, a, b) if matches!(self.target, Target::Cuda | Target::Wgsl) => {
                    format!("{prefix}_copysign({a}, {b})")
                }
                (Binary::CopySign, a, b) => format!("copysign{suffix}({a}, {b})"),
                (Binary::Scale, a, b) => format!("{prefix}_scale({a}, {b})"),
            },
            RecordedOperation::MulAdd(a, b, c) => {
                let function = if is_c { format!("{upper}_MUL_ADD") } else { "fma".to_owned() };
                self.rounded(format!("{function}({}, {}, {})", o(a), o(b), o(c)))
            }
            RecordedOperation::Less(a, b) if o(b) == self.literal(f64::INFINITY) => self.is_finite(&o(a)),
            RecordedOperation::Less(a, b) => format!("{} < {}", o(a), o(b)),
            RecordedOperation::IsZero(a) => format!("{} == 0{}", o(a), if is_c { "" } else { ".0f" }),
            RecordedOperation::Not(a) => format!("!{}", o(a)),
            RecordedOperation::And(a, b) => format!("{} & {}", o(a), o(b)),
            RecordedOperation::Or(a, b) => format!("{} | {}", o(a), o(b)),
            RecordedOperation::Select(mask, yes, no) if is_c => {
                format!("{} ? {} : {}", o(mask), o(yes), o(no))
            }
            RecordedOperation::Select(mask, yes, no) => {
                format!("select({}, {}, {})", o(no), o(yes), o(mask))
            }
            RecordedOperation::Call(function, arguments) => {
                let mut list: Vec<_> = arguments.iter().flatten().map(|&argument| o(argument)).collect();
                if function.is_pair() {
                    list.push(format!("&s{id}"));
                }
                format!("{prefix}_{}({})", function.name(), list.join(", "))
            }
            _ => o(id),
        }
    }

    /// Bit k of a status.
    pub(super) fn bit(&self, k: usize, truth: &str) -> String {
        match (k, self.is_c()) {
            (0, true) => format!("(unsigned){truth}"),
            (_, true) => format!("(unsigned){truth} << {k}"),
            (_, false) => format!("select(0u, {}u, {truth})", 1 << k),
        }
    }

    /// The first line of a function.
    pub(super) fn head(&self, name: &str, arguments: &[Argument<'_>], result: Kind) -> String {
        let (number, result) = (self.type_of(Kind::Number), self.type_of(result));
        let written = |argument: &Argument<'_>| match (argument, self.is_c()) {
            (Argument::Parameters, true) => format!("const {}_parameters *p", self.prefix),
            (Argument::Parameters, false) => format!("p: {}_parameters", self.prefix),
            (Argument::Number(name), _) => self.declared(name, None),
            (Argument::Input(name, count), true) => format!("const {}", self.declared(name, Some(*count))),
            (Argument::Input(name, count), false) => self.declared(name, Some(*count)),
            (Argument::Output(name, 1), true) => format!("{number} *{name}"),
            (Argument::Output(name, 1), false) => format!("{name}: ptr<function, {number}>"),
            (Argument::Output(name, count), true) => self.declared(name, Some(*count)),
            (Argument::Output(name, count), false) => {
                format!("{name}: ptr<function, array<{number}, {count}>>")
            }
        };
        let list = arguments.iter().map(written).collect::<Vec<_>>().join(", ");
        match self.is_c() {
            true => format!("{}_{name}({list}) {{", self.function(result)),
            false => format!("fn {}_{name}({list}) -> {result} {{", self.prefix),
        }
    }

    /// A statement that makes compilers accept that the parameters are not read.
    pub(super) fn parameters_are_unused(&self) -> &'static str {
        if self.is_c() { "    (void)p;\n" } else { "" }
    }

    /// A statement that returns a number where a condition does not hold.
    pub(super) fn return_unless(&self, condition: &str, number: usize) -> String {
        match self.is_c() {
            true => format!("    if (!({condition})) return {number}u;\n"),
            false => format!("    if (!({condition})) {{ return {number}u; }}\n"),
        }
    }

    /// A number in a condition on parameters.
    pub(super) fn number_in_condition(&self, number: f64) -> String {
        match self.has_double() {
            true if number.is_finite() => format!("{number:?}"),
            true => self.literal(number),
            false => self.literal(f64::from(number as f32)),
        }
    }

    /// A parameter in a condition.
    pub(super) fn parameter_in_condition(&self, place: String) -> String {
        if self.is_single && self.has_double() { format!("(double){place}") } else { place }
    }

    /// A call of a method in a condition.
    pub(super) fn call_in_condition(&self, name: &str, a: &str, b: &str) -> String {
        match (name, self.is_c()) {
            // WGSL has powers of positive numbers alone; a condition has whole exponents here.
            ("powi", false) => {
                let exponent = b.trim_matches(['(', ')', 'f']).parse::<f32>();
                let is_odd = exponent.is_ok_and(|exponent| exponent % 2.0 != 0.0);
                let sign = if is_odd { format!("sign({a}) * ") } else { String::new() };
                format!("({sign}pow(abs({a}), {b}))")
            }
            ("powi" | "powf", _) => format!("pow({a}, {b})"),
            ("log", _) => format!("(log({a}) / log({b}))"),
            ("ln", _) => format!("log({a})"),
            ("recip", true) => format!("(1.0 / {a})"),
            ("recip", false) => format!("(1.0f / {a})"),
            ("ln_1p", true) => format!("log1p({a})"),
            ("ln_1p", false) => format!("log(1.0f + {a})"),
            ("exp_m1", true) => format!("expm1({a})"),
            ("exp_m1", false) => format!("(exp({a}) - 1.0f)"),
            ("log10", false) => format!("(log({a}) * 0.4342944819032518f)"),
            ("cbrt", false) => format!("(sign({a}) * pow(abs({a}), 0.3333333333333333f))"),
            (name, _) => format!("{name}({a})"),
        }
    }

    /// A name with the type of a number, or of an array of numbers.
    fn declared(&self, name: &str, count: Option<usize>) -> String {
        let number = self.type_of(Kind::Number);
        match (count, self.is_c()) {
            (None, true) => format!("{number} {name}"),
            (None, false) => format!("{name}: {number}"),
            (Some(count), true) => format!("{number} {name}[{count}]"),
            (Some(count), false) => format!("{name}: array<{number}, {count}>"),
        }
    }

    /// A field of the structure of the parameters, a number or an array, with its comment.
    pub(super) fn field(&self, name: &str, count: Option<usize>, doc: &str) -> String {
        let comment = if doc.is_empty() { String::new() } else { format!(" /* {doc} */") };
        format!("    {}{}{comment}\n", self.declared(name, count), if self.is_c() { ';' } else { ',' })
    }

    /// The structure of the parameters with these fields, and the values that the file was made with.
    pub(super) fn structure(&self, fields: &str, example: &[String]) -> String {
        let (Self { prefix, upper, .. }, example) = (self, example.join(", "));
        match self.is_c() {
            true => format!(
                "typedef struct {{\n{fields}}} {prefix}_parameters;\n\n#define {upper}_EXAMPLE {{{example}}}\n\n"
            ),
            false => format!(
                "struct {prefix}_parameters {{
{fields}}}

fn {prefix}_example() -> {prefix}_parameters {{
    return {prefix}_parameters({example});
}}

"
            ),
        }
    }

    /// Numbers of a list among those values.
    pub(super) fn list(&self, numbers: &[String]) -> String {
        let list = numbers.join(", ");
        if self.is_c() { format!("{{{list}}}") } else { format!("array<f32, {}>({list})", numbers.len()) }
    }

    /// Name of the values that the file was made with.
    pub(super) fn example(&self) -> String {
        let Self { prefix, upper, .. } = self;
        if self.is_c() {
            format!("{prefix}_parameters p = {upper}_EXAMPLE")
        } else {
            format!("{prefix}_example()")
        }
    }

    /// Compiler command, for the top of the file.
    pub(super) fn advice(&self) -> &'static str {
        match self.target {
            Target::C => {
                "Compile with -O2 or -O3 and -ffp-contract=off, for the processor at hand (-march=native); never with
 * -ffast-math, -Ofast, -funsafe-math-optimizations, -ffinite-math-only, /fp:fast; icx needs -fp-model=precise."
            }
            Target::Cuda => {
                "Compile with -fmad=false (nvcc), -ffp-contract=off (HIP, clang) or fuse_fp=False (Warp): what is to be fused
 * is written as fma. Never with --use_fast_math or -ffast-math."
            }
            Target::OpenCl => {
                "Build with -cl-fp32-correctly-rounded-divide-sqrt where the device has it; never with -cl-fast-relaxed-math,
 * -cl-unsafe-math-optimizations or -cl-finite-math-only."
            }
            Target::Wgsl => {
                "No option is needed. Divisions and square roots are as exact as the device makes them, which the language does
 * not promise to be the last bit."
            }
        }
    }

    /// The contents below the comment. In C with guards against a second reading, against another file of
    /// that name, and against arithmetic that is not that of IEEE 754.
    pub(super) fn guarded(&self, text: String) -> String {
        let Self { upper, .. } = self;
        // FNV-1a.
        let sum =
            text.bytes().fold(0x811c_9dc5_u32, |sum, byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193));
        // CUDA's compiler at run time defines no `__GNUC__`, but has its attributes.
        let (has_attributes, device) = match self.target {
            Target::Wgsl => return text,
            Target::C | Target::OpenCl => ("defined(__GNUC__)", String::new()),
            Target::Cuda => ("defined(__GNUC__) || defined(__CUDACC_RTC__)", format!(" {upper}_DEVICE")),
        };
        let head = self.head_of_file();
        // The attribute is for clang and nvcc, which warn of functions that are not called, `inline` or not.
        format!(
            "#ifndef {upper}_H
#define {upper}_H {sum:#x}
{head}#if {has_attributes}
#define {upper}_FUNCTION static inline __attribute__((unused)){device}
#else
#define {upper}_FUNCTION static inline{device}
#endif

{text}#ifdef {upper}_PRECISE
#pragma float_control(pop)
#endif
#elif {upper}_H != {sum:#x}
#error \"two files have the prefix of this one: give one of them another name\"
#endif
"
        )
    }
}
