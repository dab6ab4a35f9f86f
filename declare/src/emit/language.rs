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

use super::signature::{Returned, Signature, Value};
use super::{Precision, Target};

/// Keywords of C99, C++20 and OpenCL C, and macros of headers and compilers.
const RESERVED_IN_C: &str = include_str!("language/reserved_in_c.txt");

/// Keywords and reserved words of WGSL.
const RESERVED_IN_WGSL: &str = include_str!("language/reserved_in_wgsl.txt");

/// A file of C. The attribute `unused` is for clang and nvcc, which warn of functions that are not called,
/// `inline` or not.
const FILE: &str = include_str!("language/file.c");

/// The structure of the parameters, and the values that a file was made with.
const PARAMETERS_IN_C: &str =
    "typedef struct {\n{fields}} {prefix}_parameters;\n\n#define {upper}_EXAMPLE {{example}}\n\n";
const PARAMETERS_IN_WGSL: &str = "struct {prefix}_parameters {\n{fields}}\n\nfn {prefix}_example() -> {prefix}_parameters {\n    return {prefix}_parameters({example});\n}\n\n";

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number,
    Truth,
    /// Bits that a function returns.
    Status,
}

/// A language, with the number format and the prefix of a file.
pub(super) struct Language {
    target: Target,
    is_single: bool,
    prefix: String,
    /// The prefix of functions that belong to all energies.
    shared: String,
}

impl Language {
    pub(super) fn new(target: Target, precision: Precision, prefix: &str) -> Self {
        let is_single = precision == Precision::F32;
        // Each file of WGSL has what it calls, and a variable of its own for it.
        let shared = match (target, is_single) {
            (Target::Wgsl, _) => prefix,
            (_, true) => "piola_f32",
            (_, false) => "piola_f64",
        };
        Self { target, is_single, prefix: prefix.to_owned(), shared: shared.to_owned() }
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

    /// The prefix of macros that belong to all energies.
    fn upper(&self) -> String {
        self.shared.to_uppercase()
    }

    /// The name of a function.
    pub(super) fn name_of(&self, function: &str, is_of_energy: bool) -> String {
        format!("{}_{function}", if is_of_energy { &self.prefix } else { &self.shared })
    }

    /// Qualifiers and type of a shared function in C, and the prefix of its name.
    fn function(&self, result: &str) -> String {
        format!("{}_FUNCTION {result} {}", self.upper(), self.shared)
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
                format!("{}_of_bits({:#x}ull)", self.shared, value.to_bits())
            }
            (Target::Cuda | Target::Wgsl, true) if !single.is_finite() => {
                format!("{}_of_bits({:#x}u)", self.shared, single.to_bits())
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

    /// A statement with an array that is not changed.
    pub(super) fn constant_array(&self, name: &str, numbers: &[String]) -> String {
        let (count, number) = (numbers.len(), self.type_of(Kind::Number));
        match self.is_c() {
            true => format!("const {number} {name}[{count}] = {};", self.list(numbers)),
            false => format!("let {name} = {};", self.list(numbers)),
        }
    }

    /// Statements with variables that are assigned later: names, or arrays.
    pub(super) fn variables(&self, kind: Kind, names: &[String], margin: &str) -> String {
        let of_kind = self.type_of(kind);
        let mut text = String::new();
        // As many in a line of C as are read easily.
        for names in names.chunks(if self.is_c() { 12 } else { 1 }) {
            text += &match self.is_c() {
                true => format!("{margin}{of_kind} {};\n", names.join(", ")),
                false if names[0].contains(':') => format!("{margin}var {};\n", names[0]),
                false => format!("{margin}var {}: {of_kind};\n", names[0]),
            };
        }
        text
    }

    /// An array in the statement that declares it.
    pub(super) fn array(&self, name: &str, length: usize) -> String {
        if self.is_c() { format!("{name}[{length}]") } else { format!("{name}: array<f32, {length}>") }
    }

    /// A variable as an output of a call; an output of the calling function is one already.
    pub(super) fn address(&self, name: &str, is_array: bool, is_output: bool) -> String {
        if is_output || is_array && self.is_c() { name.to_owned() } else { format!("&{name}") }
    }

    /// An array as an input of a call.
    pub(super) fn passed(&self, name: &str, is_output: bool) -> String {
        if is_output && !self.is_c() { format!("*{name}") } else { name.to_owned() }
    }

    /// An entry of an array.
    pub(super) fn element(&self, name: &str, entry: usize, is_output: bool) -> String {
        if is_output && !self.is_c() { format!("(*{name})[{entry}]") } else { format!("{name}[{entry}]") }
    }

    /// Statements that write a value to several places.
    pub(super) fn assignment(&self, places: &[String], value: &str, margin: &str) -> String {
        match self.is_c() {
            true => format!("{margin}{} = {value};\n", places.join(" = ")),
            false => {
                let copies = places[1..].iter().map(|place| format!("{margin}{place} = {};\n", places[0]));
                format!("{margin}{} = {value};\n{}", places[0], copies.collect::<String>())
            }
        }
    }

    /// Text before a call whose value is not used.
    pub(super) fn unused(&self) -> &'static str {
        if self.is_c() { "" } else { "_ = " }
    }

    pub(super) fn parameter(&self, name: &str, entry: Option<usize>) -> String {
        let within = if self.is_c() { "->" } else { "." };
        entry.map_or_else(|| format!("p{within}{name}"), |entry| format!("p{within}{name}[{entry}]"))
    }

    /// The result of an operation of arithmetic, rounded before it is used.
    fn rounded(&self, result: String) -> String {
        if self.is_c() { result } else { format!("{}_rounded({result})", self.shared) }
    }

    /// The first statement of a function that returns a status, whose first input this is.
    pub(super) fn start(&self, input: &str) -> String {
        match self.is_c() {
            true => String::new(),
            false => format!("    {0}_nothing = select(1u, 0u, {0}_is_finite({input}));\n", self.shared),
        }
    }

    pub(super) fn is_finite(&self, a: &str) -> String {
        format!("{}_is_finite({a})", self.shared)
    }

    /// The text of an operation, given the text of an operand by itself and within an expression, and whether
    /// the text needs parentheses within another.
    pub(super) fn expression(
        &self,
        operation: &RecordedOperation,
        o: &dyn Fn(Id) -> String,
        atom: &dyn Fn(Id) -> String,
    ) -> (String, bool) {
        use RecordedOperation::{And, IsZero, Less, MulAdd, Not, Or, Select};
        let (is_c, suffix) = (self.is_c(), self.suffix());
        let infix = |a: Id, operator: &str, b: Id| format!("{} {operator} {}", atom(a), atom(b));
        match *operation {
            RecordedOperation::Unary(Unary::Negate, a) => (format!("-{}", atom(a)), true),
            RecordedOperation::Unary(Unary::Absolute, a) if is_c => {
                (format!("fabs{suffix}({})", o(a)), false)
            }
            RecordedOperation::Unary(Unary::Absolute, a) => (format!("abs({})", o(a)), false),
            RecordedOperation::Unary(Unary::SquareRoot, a) => {
                (self.rounded(format!("sqrt{suffix}({})", o(a))), false)
            }
            // Warp's compiler has none.
            RecordedOperation::Binary(Binary::CopySign, a, b) => {
                let name = match self.target {
                    Target::Cuda | Target::Wgsl => self.name_of("copysign", false),
                    Target::C | Target::OpenCl => format!("copysign{suffix}"),
                };
                (format!("{name}({}, {})", o(a), o(b)), false)
            }
            RecordedOperation::Binary(operator, a, b) => {
                let sign = match operator {
                    Binary::Add => "+",
                    Binary::Subtract => "-",
                    Binary::Multiply => "*",
                    _ => "/",
                };
                (self.rounded(infix(a, sign, b)), is_c)
            }
            MulAdd(a, b, c) => {
                let function = if is_c { format!("{}_MUL_ADD", self.upper()) } else { "fma".to_owned() };
                (self.rounded(format!("{function}({}, {}, {})", o(a), o(b), o(c))), false)
            }
            Less(a, b) if o(b) == self.literal(f64::INFINITY) => (self.is_finite(&o(a)), false),
            Less(a, b) => (infix(a, "<", b), true),
            IsZero(a) => (format!("{} == 0{}", atom(a), if is_c { "" } else { ".0f" }), true),
            Not(a) => (format!("!{}", atom(a)), false),
            And(a, b) => (infix(a, "&", b), true),
            Or(a, b) => (infix(a, "|", b), true),
            Select(mask, yes, no) if is_c => (format!("{} ? {} : {}", atom(mask), atom(yes), atom(no)), true),
            Select(mask, yes, no) => (format!("select({}, {}, {})", o(no), o(yes), o(mask)), false),
            _ => (String::new(), false),
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
    pub(super) fn head(&self, signature: &Signature, is_inlined: bool) -> String {
        let mut list = Vec::new();
        if signature.is_of_energy {
            list.push(match self.is_c() {
                true => format!("const {}_parameters *p", self.prefix),
                false => format!("p: {}_parameters", self.prefix),
            });
        }
        for &Value { name, length } in &signature.inputs {
            let constant = if self.is_c() && length.is_some() { "const " } else { "" };
            list.push(format!("{constant}{}", self.declared(name, length)));
        }
        for &Value { name, length } in &signature.outputs {
            let number = self.type_of(Kind::Number);
            list.push(match (length, self.is_c()) {
                (None, true) => format!("{number} *{name}"),
                (_, true) => self.declared(name, length),
                (None, false) => format!("{name}: ptr<function, {number}>"),
                (Some(length), false) => format!("{name}: ptr<function, array<{number}, {length}>>"),
            });
        }
        let returned = match signature.returned {
            Returned::Nothing => None,
            Returned::Number => Some(self.type_of(Kind::Number)),
            Returned::Truth(_) => Some(self.type_of(Kind::Truth)),
            Returned::Status => Some(self.type_of(Kind::Status)),
        };
        let (name, list) = (self.name_of(signature.name, signature.is_of_energy), list.join(", "));
        match (self.is_c(), returned) {
            (true, _) => {
                let word = if is_inlined { "STAGE" } else { "FUNCTION" };
                format!("{}_{word} {} {name}({list}) {{", self.upper(), returned.unwrap_or("void"))
            }
            (false, Some(returned)) => format!("fn {name}({list}) -> {returned} {{"),
            (false, None) => format!("fn {name}({list}) {{"),
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
        let text = if self.is_c() { PARAMETERS_IN_C } else { PARAMETERS_IN_WGSL };
        let (prefix, upper) = (&self.prefix, self.prefix.to_uppercase());
        let text = text.replace("{prefix}", prefix).replace("{upper}", &upper);
        // Fields last: a comment of a user may look like a word of the template.
        text.replace("{example}", &example.join(", ")).replace("{fields}", fields)
    }

    /// Numbers of a list among those values.
    pub(super) fn list(&self, numbers: &[String]) -> String {
        let list = numbers.join(", ");
        if self.is_c() { format!("{{{list}}}") } else { format!("array<f32, {}>({list})", numbers.len()) }
    }

    /// Name of the values that the file was made with.
    pub(super) fn example(&self) -> String {
        let prefix = &self.prefix;
        if self.is_c() {
            format!("{prefix}_parameters p = {}_EXAMPLE", prefix.to_uppercase())
        } else {
            format!("{prefix}_example()")
        }
    }

    /// A function that belongs to all energies: once in a program.
    pub(super) fn shared(&self, name: &str, text: &str) -> String {
        let guard = self.name_of(name, false).to_uppercase();
        let mistake = "print all files of a program with one release and one --target";
        if self.is_c() { self.once(&guard, text, mistake) } else { text.to_owned() }
    }

    /// A text in C that is read once, and that refuses another one, or one of another target, with its guard.
    fn once(&self, guard: &str, text: &str, mistake: &str) -> String {
        let (text, sum) = (text.trim_end(), sum_of(&format!("{:?}{text}", self.target)));
        format!(
            "#ifndef {guard}\n#define {guard} {sum:#x}\n{text}\n#elif {guard} != {sum:#x}\n#error \"{mistake}\"\n#endif\n"
        )
    }

    /// The contents below the comment. In C with guards against a second reading, against another file of
    /// that name, and against arithmetic that is not that of IEEE 754.
    pub(super) fn guarded(&self, shared: String, own: String) -> String {
        let (upper, all) = (self.prefix.to_uppercase(), self.upper());
        // CUDA's compiler at run time defines no `__GNUC__`, but has its attributes.
        let (has_attributes, device) = match self.target {
            Target::Wgsl => return shared + &own,
            Target::C | Target::OpenCl => ("defined(__GNUC__)", String::new()),
            Target::Cuda => ("defined(__GNUC__) || defined(__CUDACC_RTC__)", format!(" {all}_DEVICE")),
        };
        let inlined = if self.target == Target::C { "unused, always_inline" } else { "unused" };
        let words = [
            ("{all}", &all[..]),
            ("{head}", &self.head_of_file()),
            ("{has_attributes}", has_attributes),
            ("{device}", &device),
            ("{inlined}", inlined),
            ("{shared}", &shared),
            ("{own}", &own),
        ];
        let text = words.iter().fold(FILE.to_owned(), |text, (word, meaning)| text.replace(word, meaning));
        let mistake = "two files have the prefix of this one: give one of them another name";
        self.once(&format!("{upper}_H"), &text, mistake)
    }
}

/// FNV-1a.
fn sum_of(text: &str) -> u32 {
    text.bytes().fold(0x811c_9dc5, |sum, byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}
