//! C99 that is C++17 as well, and its dialects for graphics processors.

mod primitives;

use super::{Argument, Field, Kind, Language, Needs};
use crate::emit::Precision;

/// Keywords of C99, C++20 and OpenCL C, and macros of headers and compilers.
const RESERVED: &str = "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t \
    char32_t class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue \
    decltype default delete do double dynamic_cast else enum explicit export extern false float for friend goto if \
    inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public \
    register reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct \
    switch template this thread_local throw true try typedef typeid typename typeof union unsigned using virtual void \
    volatile wchar_t while xor xor_eq INFINITY NAN HUGE_VAL NULL M_E M_PI MAXFLOAT errno linux unix global local constant \
    kernel half uchar ushort uint ulong read_only write_only read_write uniform pipe event_t sampler_t image1d_t image2d_t \
    image3d_t size_t";

/// A compiler's view of C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialect {
    C,
    /// CUDA, HIP, and the native functions of Warp.
    Cuda,
    OpenCl,
}

pub(super) struct C {
    dialect: Dialect,
    is_single: bool,
    prefix: String,
    /// The prefix of macros.
    upper: String,
}

impl C {
    pub(super) fn new(dialect: Dialect, precision: Precision, prefix: &str) -> Self {
        let is_single = precision == Precision::F32;
        Self { dialect, is_single, prefix: prefix.to_owned(), upper: prefix.to_uppercase() }
    }

    fn number(&self) -> &'static str {
        if self.is_single { "float" } else { "double" }
    }

    fn type_of(&self, kind: Kind) -> &'static str {
        match kind {
            Kind::Number => self.number(),
            Kind::Truth => "int",
        }
    }

    /// The end of literals.
    fn end(&self) -> &'static str {
        if self.is_single { "f" } else { "" }
    }

    /// The end of names of functions of the library, which OpenCL overloads.
    fn suffix(&self) -> &'static str {
        if self.dialect == Dialect::OpenCl { "" } else { self.end() }
    }

    /// Qualifiers and type of a function, and the prefix of its name.
    fn function(&self, result: &str) -> String {
        format!("{}_FUNCTION {result} {}", self.upper, self.prefix)
    }

    /// True if conditions on parameters are in `double`, as in the constructor.
    fn has_double(&self) -> bool {
        !self.is_single || self.dialect != Dialect::OpenCl
    }
}

impl Language for C {
    fn is_reserved(&self, name: &str) -> bool {
        RESERVED.split_ascii_whitespace().any(|word| word == name)
    }

    fn literal(&self, value: f64) -> String {
        let number = self.number();
        match (self.dialect, self.is_single) {
            // CUDA's compiler at run time has no macros for them.
            (Dialect::Cuda, true) if !value.is_finite() => {
                format!("{}_of_bits({:#x}u)", self.prefix, (value as f32).to_bits())
            }
            (Dialect::Cuda, false) if !value.is_finite() => {
                format!("{}_of_bits({:#x}ull)", self.prefix, value.to_bits())
            }
            _ if value.is_nan() => format!("({number})NAN"),
            _ if value.is_infinite() => format!("{}({number})INFINITY", if value < 0.0 { "-" } else { "" }),
            (_, false) => format!("{value:?}"),
            (_, true) => format!("{:?}f", value as f32),
        }
    }

    fn truth(&self, truth: bool) -> String {
        u8::from(truth).to_string()
    }

    fn constant(&self, kind: Kind, name: &str, value: &str) -> String {
        format!("const {} {name} = {value};", self.type_of(kind))
    }

    fn variable(&self, kind: Kind, name: &str, is_zeroed: bool) -> String {
        format!("{} {name}{};", self.type_of(kind), if is_zeroed { " = 0" } else { "" })
    }

    fn parameter(&self, name: &str, entry: Option<usize>) -> String {
        entry.map_or_else(|| format!("p->{name}"), |entry| format!("p->{name}[{entry}]"))
    }

    fn output(&self, name: &str, count: usize, entry: usize) -> String {
        if count == 1 { format!("*{name}") } else { format!("{name}[{entry}]") }
    }

    fn absolute(&self, a: &str) -> String {
        format!("fabs{}({a})", self.suffix())
    }

    fn square_root(&self, a: &str) -> String {
        format!("sqrt{}({a})", self.suffix())
    }

    fn copy_sign(&self, a: &str, b: &str) -> String {
        match self.dialect {
            // Warp's compiler has none.
            Dialect::Cuda => format!("{}_copysign({a}, {b})", self.prefix),
            _ => format!("copysign{}({a}, {b})", self.suffix()),
        }
    }

    fn mul_add(&self, a: &str, b: &str, c: &str) -> String {
        format!("{}_MUL_ADD({a}, {b}, {c})", self.upper)
    }

    fn rounded(&self, result: String) -> String {
        result
    }

    fn start(&self, _: &str) -> String {
        String::new()
    }

    fn less(&self, a: &str, b: &str) -> String {
        format!("{a} < {b}")
    }

    fn is_zero(&self, a: &str) -> String {
        format!("{a} == 0")
    }

    fn is_finite(&self, a: &str) -> String {
        format!("{a} - {a} == 0")
    }

    fn select(&self, mask: &str, yes: &str, no: &str) -> String {
        format!("{mask} ? {yes} : {no}")
    }

    fn bit(&self, k: usize, truth: &str) -> String {
        if k == 0 { format!("(unsigned){truth}") } else { format!("(unsigned){truth} << {k}") }
    }

    fn head(&self, name: &str, arguments: &[String], is_pair: bool) -> String {
        let number = self.number();
        let mut list: Vec<_> = arguments.iter().map(|argument| format!("{number} {argument}")).collect();
        if is_pair {
            list.push(format!("{number} *second"));
        }
        format!("{}_{name}({}) {{", self.function(number), list.join(", "))
    }

    fn head_of_point(&self, name: &str, arguments: &[Argument]) -> String {
        let number = self.number();
        let written = |argument: &Argument| match argument {
            Argument::Parameters => format!("const {}_parameters *p", self.prefix),
            Argument::Input(name, count) => format!("const {number} {name}[{count}]"),
            Argument::Output(name, 1) => format!("{number} *{name}"),
            Argument::Output(name, count) => format!("{number} {name}[{count}]"),
        };
        let list: Vec<_> = arguments.iter().map(written).collect();
        format!("{}_{name}({}) {{", self.function("unsigned"), list.join(", "))
    }

    fn parameters_are_unused(&self) -> &'static str {
        "    (void)p;\n"
    }

    fn return_unless(&self, condition: &str, number: usize) -> String {
        format!("    if (!({condition})) return {number}u;\n")
    }

    fn number_in_condition(&self, number: f64) -> String {
        match self.has_double() {
            true if number.is_finite() => format!("{number:?}"),
            true => self.literal(number),
            false => self.literal(f64::from(number as f32)),
        }
    }

    fn parameter_in_condition(&self, place: String) -> String {
        if self.is_single && self.has_double() { format!("(double){place}") } else { place }
    }

    fn call_in_condition(&self, _: &str, _: &str, _: &str) -> Option<String> {
        None
    }

    fn structure(&self, fields: &[Field], example: &[String]) -> String {
        let Self { prefix, upper, .. } = self;
        let number = self.number();
        let comment = |doc: &str| if doc.is_empty() { String::new() } else { format!(" /* {doc} */") };
        let line = |field: &Field| match field {
            Field::Absent(comment) => format!("    /* {comment} */\n"),
            Field::Number(name, doc) => format!("    {number} {name};{}\n", comment(doc)),
            Field::List(name, count, doc) => format!("    {number} {name}[{count}];{}\n", comment(doc)),
        };
        format!(
            "typedef struct {{\n{}}} {prefix}_parameters;\n\n#define {upper}_EXAMPLE {{{}}}\n\n",
            fields.iter().map(line).collect::<String>(),
            example.join(", ")
        )
    }

    fn list(&self, numbers: &[String]) -> String {
        format!("{{{}}}", numbers.join(", "))
    }

    fn example(&self) -> String {
        format!("{}_parameters p = {}_EXAMPLE", self.prefix, self.upper)
    }

    fn advice(&self) -> &'static str {
        match self.dialect {
            Dialect::C => {
                "Compile with -O2 or -O3 and -ffp-contract=off, for the processor at hand (-march=native); never with
 * -ffast-math."
            }
            Dialect::Cuda => {
                "Compile with -fmad=false (nvcc), -ffp-contract=off (HIP, clang) or fuse_fp=False (Warp): what is to be fused
 * is written as fma. Never with --use_fast_math."
            }
            Dialect::OpenCl => {
                "Build with -cl-fp32-correctly-rounded-divide-sqrt where the device has it; never with -cl-fast-relaxed-math,
 * -cl-unsafe-math-optimizations or -cl-finite-math-only."
            }
        }
    }

    fn primitives(&self, needs: &Needs<'_>) -> String {
        self.functions_of(needs)
    }

    /// Guards against a second reading, against another file of that name, and against arithmetic that is not
    /// that of IEEE 754.
    fn guarded(&self, text: String) -> String {
        let Self { upper, .. } = self;
        // FNV-1a.
        let sum =
            text.bytes().fold(0x811c_9dc5_u32, |sum, byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193));
        let head = self.head();
        // CUDA's compiler at run time defines no `__GNUC__`, but has its attributes.
        let (has_attributes, device) = match self.dialect {
            Dialect::C | Dialect::OpenCl => ("defined(__GNUC__)", String::new()),
            Dialect::Cuda => ("defined(__GNUC__) || defined(__CUDACC_RTC__)", format!(" {upper}_DEVICE")),
        };
        // The attribute is for clang and nvcc, which warn of functions that are not called, `inline` or not.
        format!(
            "#ifndef {upper}_H
#define {upper}_H {sum:#x}
{head}#if {has_attributes}
#define {upper}_FUNCTION static inline __attribute__((unused)){device}
#else
#define {upper}_FUNCTION static inline{device}
#endif

{text}#elif {upper}_H != {sum:#x}
#error \"two files have the prefix of this one: give one of them another name\"
#endif
"
        )
    }
}
