//! Recorded programs as C99 that is C++17 as well.

use std::collections::BTreeSet;
use std::fmt::Write;

use piola::__private::record::{Binary, Function, Id, RecordedOperation, RecordedProgram, Recording, Unary};
use piola::Inversion;
use piola::material::{Form, Parameter};

use super::steps::{Step, Steps};
use super::{File, PointFunction, Precision};
use crate::condition::{Condition, Term};

/// Names that fields cannot have: keywords of C99 and C++20, and macros of the headers and compilers.
const RESERVED: &str = " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t \
    char32_t class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue \
    decltype default delete do double dynamic_cast else enum explicit export extern false float for friend goto if \
    inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public \
    register reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct \
    switch template this thread_local throw true try typedef typeid typename typeof union unsigned using virtual void \
    volatile wchar_t while xor xor_eq INFINITY NAN HUGE_VAL NULL errno linux unix ";

/// Whether names can begin with it.
pub(super) fn is_identifier(name: &str) -> bool {
    let is_of_c = |c: char| c.is_ascii_alphanumeric() || c == '_';
    // Others belong to the compiler.
    let is_free = !name.contains("__") && !name.ends_with('_');
    name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(is_of_c) && is_free
}

/// The file.
pub(super) fn print(file: &File<'_>) -> String {
    let printer = Printer::new(file);
    let recordings: Vec<&Recording> =
        file.functions.iter().map(|one| &one.recording).chain([&file.rest]).collect();
    let mut text = printer.parameters();
    text += &printer.primitives(&recordings);
    let mut printed = BTreeSet::new();
    for recording in &recordings {
        for function in recording.functions.keys() {
            printer.function(*function, recording, &mut printed, &mut text);
        }
    }
    text += &printer.check();
    for one in &file.functions {
        text += &printer.point_function(one.function, &one.recording.program);
    }
    printer.comment() + &printer.guarded(&text)
}

struct Printer<'a> {
    file: &'a File<'a>,
    prefix: &'a str,
    upper: String,
    /// `float` or `double`.
    number: &'static str,
    /// The end of literals, and of the names of functions of the C library.
    suffix: &'static str,
    /// The name of each parameter.
    fields: Vec<String>,
    /// How each number among the parameters is written; whole exponents have no place.
    parameters: Vec<String>,
}

impl<'a> Printer<'a> {
    fn new(file: &'a File<'a>) -> Self {
        let (number, suffix) = match file.precision {
            Precision::F64 => ("double", ""),
            Precision::F32 => ("float", "f"),
        };
        let description = file.energy.description();
        let mut parameters = Vec::new();
        let fields = fields(description.parameters.iter());
        for ((parameter, values), name) in description.parameters.iter().zip(file.values).zip(&fields) {
            for k in 0..values.len() {
                parameters.push(match parameter.form {
                    Form::List | Form::Exponents => format!("p->{name}[{k}]"),
                    _ => format!("p->{name}"),
                });
            }
        }
        Self {
            file,
            prefix: &file.prefix,
            upper: file.prefix.to_uppercase(),
            number,
            suffix,
            fields,
            parameters,
        }
    }

    /// The description of the file and its use.
    fn comment(&self) -> String {
        let Self { file, prefix, .. } = self;
        let description = file.energy.description();
        let mut text = format!(
            "/* {}: an isotropic hyperelastic energy, by piola {}.\n *\n * {}\n *\n * psi = {}\n",
            safe(&description.name),
            env!("CARGO_PKG_VERSION"),
            safe(&description.summary),
            safe(&description.formula)
        );
        if !description.domain.is_empty() {
            let _ = writeln!(text, " * for {}", safe(&description.domain));
        }
        if let Inversion::Extend { epsilon } = file.inversion {
            let _ = writeln!(text, " * continued where a stretch is below {epsilon}.");
        }
        text + &format!(
            " *
 * F, P row by row: entry (i, j) at 3 i + j. dP/dF: row 3 i + j for entry (i, j) of P, column 3 k + l for entry
 * (k, l) of F, entry at 9 row + column; symmetric. Energies are densities of rest volume, Pa in SI units.
 * Stretches are signed: F = U diag(l) V^T with rotations U and V, l1 >= l2 >= |l3|. Outputs may not overlap
 * inputs.
 *
 * Functions return bits: 1 refused (outside of the domain), 2 bounded (at a pole), 4 not finite, 8 filtered.
 * With 1 or 4 the results mean nothing. Call {prefix}_check once for each set of parameters.
 *
 * Compile with -O2 or -O3 and -ffp-contract=off, for the processor at hand (-march=native); never with
 * -ffast-math. Nothing is allocated, and there is no global state. Licence: MIT or Apache-2.0, as you choose. */
"
        )
    }

    /// The contents between guards against a second reading, another file of that name, and arithmetic that
    /// is not that of IEEE 754.
    fn guarded(&self, text: &str) -> String {
        let Self { upper, .. } = self;
        // FNV-1a.
        let sum =
            text.bytes().fold(0x811c_9dc5u32, |sum, byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193));
        let exact = if self.file.precision == Precision::F32 {
            "FLT_EVAL_METHOD == 0"
        } else {
            "FLT_EVAL_METHOD >= 0 && FLT_EVAL_METHOD < 2"
        };
        format!(
            "#ifndef {upper}_H
#define {upper}_H {sum:#x}
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__FAST_MATH__) || !({exact})
#error \"compile without -ffast-math, and with arithmetic in the format itself (-msse2 -mfpmath=sse)\"
#endif

{text}#elif {upper}_H != {sum:#x}
#error \"two files have the prefix of this one: give one of them another name\"
#endif
"
        )
    }

    /// The structure of the parameters.
    fn parameters(&self) -> String {
        let Self { file, prefix, upper, number, .. } = self;
        let description = file.energy.description();
        let mut fields = String::new();
        let mut example = Vec::new();
        for ((parameter, values), name) in description.parameters.iter().zip(file.values).zip(&self.fields) {
            let doc = safe(&parameter.doc);
            let comment = if doc.is_empty() { String::new() } else { format!(" /* {doc} */") };
            let numbers: Vec<_> = values.iter().map(|&value| self.literal(value)).collect();
            match parameter.form {
                Form::Exponent | Form::Exponents => {
                    let _ = writeln!(fields, "    /* {name} is {}, a whole exponent. */", numbers.join(", "));
                }
                Form::List if values.is_empty() => {
                    let _ = writeln!(fields, "    /* {name} has no entries. */");
                }
                Form::List => {
                    let _ = writeln!(fields, "    {number} {name}[{}];{comment}", values.len());
                    example.push(format!("{{{}}}", numbers.join(", ")));
                }
                _ => {
                    let _ = writeln!(fields, "    {number} {name};{comment}");
                    example.extend(numbers);
                }
            }
        }
        if example.is_empty() {
            fields += &format!("    {number} unused; /* The energy has no parameters. */\n");
            example.push(self.literal(0.0));
        }
        format!(
            "typedef struct {{\n{fields}}} {prefix}_parameters;\n\n/* The parameters that the file was made with: {prefix}_parameters p = {upper}_EXAMPLE; */\n#define {upper}_EXAMPLE {{{}}}\n\n",
            example.join(", ")
        )
    }

    /// Functions that programs are made of, those that one of them needs.
    fn primitives(&self, recordings: &[&Recording]) -> String {
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

    /// A function, after those that it calls.
    fn function(
        &self,
        function: Function,
        recording: &Recording,
        printed: &mut BTreeSet<Function>,
        text: &mut String,
    ) {
        let Some(program) = recording.functions.get(&function).filter(|_| printed.insert(function)) else {
            return;
        };
        for operation in &program.operations {
            if let RecordedOperation::Call(called, _) = operation {
                self.function(*called, recording, printed, text);
            }
        }
        let Self { prefix, number, .. } = self;
        let arguments: Vec<_> = (0..program.arguments).map(|k| format!("x{k}")).collect();
        let list: Vec<_> = arguments.iter().map(|name| format!("{number} {name}")).collect();
        let second = if function.is_pair() { format!(", {number} *second") } else { String::new() };
        let _ = writeln!(
            text,
            "static inline {number} {prefix}_{}({}{second}) {{",
            function.name(),
            list.join(", ")
        );
        let body = Body::new(self, program, arguments);
        *text += &body.statements();
        if function.is_pair() {
            let _ = writeln!(text, "    *second = {};", body.operand(program.results[1]));
        }
        let _ = writeln!(text, "    return {};\n}}\n", body.operand(program.results[0]));
    }

    fn point_function(&self, function: PointFunction, program: &RecordedProgram) -> String {
        let Self { prefix, number, .. } = self;
        let outputs: &[(&str, usize)] = match function {
            PointFunction::Energy => &[("psi", 1)],
            PointFunction::Stress => &[("P", 9)],
            PointFunction::Tangent | PointFunction::Projected | PointFunction::Absolute => {
                &[("P", 9), ("A", 81)]
            }
            PointFunction::Blocks => &[("blocks", 15)],
            PointFunction::Svd => &[("U", 9), ("l", 3), ("V", 9)],
        };
        let (comment, input, count) = match function {
            PointFunction::Energy => ("The energy density psi at F, Pa.", "F", 9),
            PointFunction::Stress => ("The first Piola stress P at F, Pa.", "F", 9),
            PointFunction::Tangent => ("P and A = dP/dF at F, Pa.", "F", 9),
            PointFunction::Projected => (
                "P and dP/dF at F, Pa, with negative eigenvalues clamped to zero: positive semidefinite.",
                "F",
                9,
            ),
            PointFunction::Absolute => {
                ("P and dP/dF at F, Pa, with the absolute values of its eigenvalues.", "F", 9)
            }
            PointFunction::Blocks => (
                "psi_i, then psi_11, _22, _33, _12, _13, _23, flips (psi_i - psi_j)/(l_i - l_j) and twists (psi_i + psi_j)/(l_i + l_j) of the pairs 12, 13, 23, at signed stretches, Pa.",
                "l",
                3,
            ),
            PointFunction::Svd => ("F = U diag(l) V^T.", "F", 9),
        };
        let arguments: Vec<_> = (0..count).map(|k| format!("{input}[{k}]")).collect();
        let list: Vec<_> = outputs
            .iter()
            .map(|&(name, count)| match count {
                1 => format!("{number} *{name}"),
                _ => format!("{number} {name}[{count}]"),
            })
            .collect();
        let uses_parameters =
            program.operations.iter().any(|one| matches!(one, RecordedOperation::Parameter(_)));
        let unused = if uses_parameters { "" } else { "    (void)p;\n" };
        let mut text = format!(
            "/* {comment} */\nstatic inline unsigned {prefix}_{}(const {prefix}_parameters *p, const {number} {input}[{count}], {}) {{\n{unused}",
            function.name(),
            list.join(", ")
        );
        let body = Body::new(self, program, arguments);
        text += &body.statements();
        let mut results = program.results.iter();
        for &(name, count) in outputs {
            for (k, &result) in (0..count).zip(results.by_ref()) {
                let place = if count == 1 { format!("*{name}") } else { format!("{name}[{k}]") };
                let _ = writeln!(text, "    {place} = {};", body.operand(result));
            }
        }
        let bits: Vec<_> = results
            .enumerate()
            .filter(|&(_, &result)| program.operations[result as usize] != RecordedOperation::Truth(false))
            .map(|(k, &result)| match k {
                0 => format!("(unsigned){}", body.operand(result)),
                _ => format!("(unsigned){} << {k}", body.operand(result)),
            })
            .collect();
        let status = if bits.is_empty() { "0u".to_owned() } else { bits.join(" | ") };
        let _ = writeln!(text, "    return {status};\n}}\n");
        text
    }

    /// A check of the parameters, by the conditions of the declaration.
    fn check(&self) -> String {
        let Self { file, prefix, suffix, .. } = self;
        let description = file.energy.description();
        let mut places = self.parameters.iter();
        let mut all = Vec::new();
        // Each with what is said of it, statements before it, and the condition under which all is well.
        let mut cases: Vec<(String, String, String)> = Vec::new();
        for ((parameter, values), name) in description.parameters.iter().zip(file.values).zip(&self.fields) {
            let numbers: Vec<_> = places.by_ref().take(values.len()).cloned().collect();
            if !matches!(parameter.form, Form::Exponent | Form::Exponents) && !numbers.is_empty() {
                let finite: Vec<_> = numbers.iter().map(|place| format!("isfinite({place})")).collect();
                let meaning = format!("{name} is not finite");
                cases.push((meaning, String::new(), finite.join(" && ")));
            }
            all.push(numbers);
        }
        for condition in file.energy.conditions(file.inversion) {
            let entries = condition.list.map_or(1, |list| all[list].len());
            let holds: Vec<_> = (0..entries).map(|entry| self.condition(condition, &all, entry)).collect();
            if !holds.is_empty() {
                cases.push((format!("not {}", safe(&condition.text)), String::new(), holds.join(" && ")));
            }
        }
        let Recording { program, .. } = &file.rest;
        let body = Body::new(self, program, Vec::new());
        let mut results = program.results.iter().map(|&id| body.operand(id));
        let mut statements = body.statements();
        if let (false, Some(shear), Some(bulk)) = (file.is_prestressed, results.next(), results.next()) {
            // The constructor has the moduli by a formula, without the roundings of derivatives.
            let rounding = if file.precision == Precision::F32 { "1e-5f" } else { "1e-13" };
            let condition =
                format!("{shear} > 0.0{suffix} && {bulk} >= -{rounding} * {shear} && isfinite({bulk})");
            let meaning = "at rest, the solid does not resist shear or changes of volume".to_owned();
            cases.push((meaning, std::mem::take(&mut statements), condition));
        }
        if let Some(inside) = results.next().filter(|inside| inside != "1") {
            cases.push(("the rest state is outside of the domain".to_owned(), statements, inside));
        }
        let mut list =
            "/* Returns 0 if the parameters are admissible, else the first of these that is true:\n"
                .to_owned();
        let mut statements = String::new();
        for (k, (meaning, before, condition)) in cases.iter().enumerate() {
            let _ = writeln!(list, " * {}: {meaning}", k + 1);
            let _ = writeln!(statements, "{before}    if (!({condition})) return {}u;", k + 1);
        }
        if !statements.contains("p->") {
            statements = format!("    (void)p;\n{statements}");
        }
        format!(
            "{list} */\nstatic inline unsigned {prefix}_check(const {prefix}_parameters *p) {{\n{statements}    return 0u;\n}}\n\n"
        )
    }

    /// A condition for an entry of its list.
    fn condition(&self, condition: &Condition, places: &[Vec<String>], entry: usize) -> String {
        let [left, right] = condition.sides.each_ref().map(|side| self.term(side, places, entry));
        format!("{left} {} {right}", condition.comparison)
    }

    /// An expression in parameters, in `double`.
    fn term(&self, term: &Term, places: &[Vec<String>], entry: usize) -> String {
        match term {
            Term::Number(number) => format!("{number:?}").replace("inf", "INFINITY").replace("NaN", "NAN"),
            Term::Parameter(k) => {
                let place = places[*k].get(entry).or(places[*k].first());
                let place = place.cloned().unwrap_or_else(|| "NAN".to_owned());
                if self.file.precision == Precision::F32 { format!("(double){place}") } else { place }
            }
            Term::Negative(term) => format!("(-{})", self.term(term, places, entry)),
            Term::Arithmetic(operator, sides) => {
                let [a, b] = sides.each_ref().map(|side| self.term(side, places, entry));
                format!("({a} {operator} {b})")
            }
            Term::Call(function, arguments) => {
                let terms: Vec<_> = arguments.iter().map(|one| self.term(one, places, entry)).collect();
                let last = terms.last().map_or("NAN", String::as_str);
                (function.in_c)(terms.first().map_or("NAN", String::as_str), last)
            }
        }
    }

    fn literal(&self, value: f64) -> String {
        match self.file.precision {
            _ if value.is_nan() => format!("({})NAN", self.number),
            _ if value.is_infinite() => {
                format!("{}({})INFINITY", if value < 0.0 { "-" } else { "" }, self.number)
            }
            Precision::F64 => format!("{value:?}"),
            Precision::F32 => format!("{:?}f", value as f32),
        }
    }
}

/// Statements of a program.
struct Body<'a> {
    printer: &'a Printer<'a>,
    program: &'a RecordedProgram,
    arguments: Vec<String>,
    steps: Steps,
}

impl<'a> Body<'a> {
    fn new(printer: &'a Printer<'a>, program: &'a RecordedProgram, arguments: Vec<String>) -> Self {
        Self { printer, program, arguments, steps: Steps::of(program) }
    }

    fn statements(&self) -> String {
        let mut text = String::new();
        for &id in &self.steps.escaping {
            let _ = writeln!(text, "    {} t{id} = 0;", self.type_of(id));
            if self.is_pair(id) {
                let _ = writeln!(text, "    {} s{id} = 0;", self.printer.number);
            }
        }
        self.write(&self.steps.all, 1, &mut text);
        text
    }

    fn write(&self, steps: &[Step], depth: usize, text: &mut String) {
        let margin = "    ".repeat(depth);
        for step in steps {
            match step {
                Step::Compute(id) => {
                    let is_declared = self.steps.escaping.contains(id);
                    if self.is_pair(*id) && !is_declared {
                        let _ = writeln!(text, "{margin}{} s{id};", self.printer.number);
                    }
                    let kind =
                        if is_declared { String::new() } else { format!("const {} ", self.type_of(*id)) };
                    let _ = writeln!(text, "{margin}{kind}t{id} = {};", self.expression(*id));
                }
                Step::Branch { mask, selections, yes, no } => {
                    for id in selections.iter().filter(|id| !self.steps.escaping.contains(id)) {
                        let _ = writeln!(text, "{margin}{} t{id};", self.type_of(*id));
                    }
                    let _ = writeln!(text, "{margin}if ({}) {{", self.operand(*mask));
                    for (k, inner) in [yes, no].into_iter().enumerate() {
                        if k == 1 {
                            let _ = writeln!(text, "{margin}}} else {{");
                        }
                        self.write(inner, depth + 1, text);
                        for &id in selections {
                            if let RecordedOperation::Select(_, yes, no) =
                                self.program.operations[id as usize]
                            {
                                let _ = writeln!(text, "{margin}    t{id} = {};", self.operand([yes, no][k]));
                            }
                        }
                    }
                    let _ = writeln!(text, "{margin}}}");
                }
            }
        }
    }

    fn is_pair(&self, id: Id) -> bool {
        matches!(self.program.operations[id as usize], RecordedOperation::Call(function, _) if function.is_pair())
    }

    fn type_of(&self, id: Id) -> &'static str {
        use RecordedOperation::{And, IsZero, Less, Not, Or, Select, Truth};
        match self.program.operations[id as usize] {
            Truth(_) | Less(..) | IsZero(_) | Not(_) | And(..) | Or(..) => "int",
            Select(_, yes, no) if [yes, no].iter().any(|&id| self.type_of(id) == "int") => "int",
            _ => self.printer.number,
        }
    }

    /// An operand where it is used.
    fn operand(&self, id: Id) -> String {
        match self.program.operations[id as usize] {
            RecordedOperation::Argument(k) => self.arguments[k as usize].clone(),
            RecordedOperation::Parameter(k) => self.printer.parameters[k as usize].clone(),
            RecordedOperation::Literal(bits) => {
                let text = self.printer.literal(f64::from_bits(bits));
                if text.starts_with('-') { format!("({text})") } else { text }
            }
            RecordedOperation::Truth(truth) => u8::from(truth).to_string(),
            RecordedOperation::Second(call) => format!("s{call}"),
            _ => format!("t{id}"),
        }
    }

    fn expression(&self, id: Id) -> String {
        let Printer { prefix, upper, suffix, .. } = self.printer;
        let o = |id: Id| self.operand(id);
        match self.program.operations[id as usize] {
            RecordedOperation::Unary(operator, a) => match operator {
                Unary::Negate => format!("-{}", o(a)),
                Unary::Absolute => format!("fabs{suffix}({})", o(a)),
                Unary::SquareRoot => format!("sqrt{suffix}({})", o(a)),
                Unary::LeadingPower => format!("{prefix}_leading_power({})", o(a)),
                Unary::ReciprocalOfPower => format!("{prefix}_reciprocal_of_power({})", o(a)),
            },
            RecordedOperation::Binary(operator, a, b) => match operator {
                Binary::Add => format!("{} + {}", o(a), o(b)),
                Binary::Subtract => format!("{} - {}", o(a), o(b)),
                Binary::Multiply => format!("{} * {}", o(a), o(b)),
                Binary::Divide => format!("{} / {}", o(a), o(b)),
                Binary::CopySign => format!("copysign{suffix}({}, {})", o(a), o(b)),
                Binary::Scale => format!("{prefix}_scale({}, {})", o(a), o(b)),
            },
            RecordedOperation::MulAdd(a, b, c) => format!("{upper}_MUL_ADD({}, {}, {})", o(a), o(b), o(c)),
            RecordedOperation::Less(a, b) => format!("{} < {}", o(a), o(b)),
            RecordedOperation::IsZero(a) => format!("{} == 0", o(a)),
            RecordedOperation::Not(a) => format!("!{}", o(a)),
            RecordedOperation::And(a, b) => format!("{} & {}", o(a), o(b)),
            RecordedOperation::Or(a, b) => format!("{} | {}", o(a), o(b)),
            RecordedOperation::Select(mask, yes, no) => format!("{} ? {} : {}", o(mask), o(yes), o(no)),
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
}

/// The names of all parameters as fields, each another one.
fn fields<'p>(parameters: impl Iterator<Item = &'p Parameter>) -> Vec<String> {
    let mut fields: Vec<String> = Vec::new();
    for parameter in parameters {
        let mut name = String::new();
        for c in parameter.name.chars() {
            match c.is_ascii_alphanumeric() || c == '_' {
                true => name.push(c),
                false => _ = write!(name, "u{:x}", u32::from(c)),
            }
        }
        while RESERVED.contains(&format!(" {name} ")) || fields.contains(&name) {
            name.push('_');
        }
        fields.push(name);
    }
    fields
}

/// A text in a comment of C, in ASCII as far as it has names there.
fn safe(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
        .replace('\\', "/")
        .replace("??", "? ?")
        .replace("*/", "* /")
        .replace("/*", "/ *")
}
