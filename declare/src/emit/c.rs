//! Recorded programs as C99 that is C++17 as well: the file, its parameters and its functions.

mod body;
mod check;
mod primitives;

use std::collections::BTreeSet;
use std::fmt::Write;

use piola::__private::record::{Function, RecordedOperation, RecordedProgram, Recording};
use piola::Inversion;
use piola::material::{Form, Parameter};

use super::{File, PointFunction, Precision};
use body::Body;

/// Names that fields cannot have: keywords of C99 and C++20, and macros of the headers and compilers.
const RESERVED: &str = " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t \
    char32_t class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue \
    decltype default delete do double dynamic_cast else enum explicit export extern false float for friend goto if \
    inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public \
    register reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct \
    switch template this thread_local throw true try typedef typeid typename typeof union unsigned using virtual void \
    volatile wchar_t while xor xor_eq INFINITY NAN HUGE_VAL NULL M_E M_PI errno linux unix ";

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
