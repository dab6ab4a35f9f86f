//! WGSL, in which a number is an `f32`.
//!
//! The language lets a compiler compute as with real numbers, none of them infinite or NaN. Mesa's compiler
//! does: (a + b) − a becomes b, a b + a c becomes a (b + c), and 0 a becomes 0. So every result of arithmetic
//! is hidden from it: the bits are combined with bits that are zero, which the compiler cannot know. Finite
//! numbers are recognised by their bits.

use super::{Argument, Field, Kind, Language, Needs, parts};

/// Keywords and reserved words.
const RESERVED: &str = "alias break case const const_assert continue continuing default diagnostic discard else enable \
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

pub(super) struct Wgsl {
    prefix: String,
}

impl Wgsl {
    pub(super) fn new(prefix: &str) -> Self {
        Self { prefix: prefix.to_owned() }
    }

    fn type_of(kind: Kind) -> &'static str {
        match kind {
            Kind::Number => "f32",
            Kind::Truth => "bool",
        }
    }
}

impl Language for Wgsl {
    fn is_reserved(&self, name: &str) -> bool {
        RESERVED.split_ascii_whitespace().any(|word| word == name)
    }

    fn literal(&self, value: f64) -> String {
        let value = value as f32;
        if value == 0.0 {
            // Which compilers would leave out of a sum, with the sign of the sum.
            self.rounded(format!("{value:?}f"))
        } else if value.is_finite() {
            format!("{value:?}f")
        } else {
            format!("{}_of_bits({:#x}u)", self.prefix, value.to_bits())
        }
    }

    fn truth(&self, truth: bool) -> String {
        truth.to_string()
    }

    fn constant(&self, _: Kind, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }

    fn variable(&self, kind: Kind, name: &str, _: bool) -> String {
        format!("var {name}: {};", Self::type_of(kind))
    }

    fn parameter(&self, name: &str, entry: Option<usize>) -> String {
        entry.map_or_else(|| format!("p.{name}"), |entry| format!("p.{name}[{entry}]"))
    }

    fn output(&self, name: &str, count: usize, entry: usize) -> String {
        if count == 1 { format!("*{name}") } else { format!("(*{name})[{entry}]") }
    }

    fn absolute(&self, a: &str) -> String {
        format!("abs({a})")
    }

    fn square_root(&self, a: &str) -> String {
        format!("sqrt({a})")
    }

    fn copy_sign(&self, a: &str, b: &str) -> String {
        format!("{}_copysign({a}, {b})", self.prefix)
    }

    fn mul_add(&self, a: &str, b: &str, c: &str) -> String {
        format!("fma({a}, {b}, {c})")
    }

    fn rounded(&self, result: String) -> String {
        format!("{}_rounded({result})", self.prefix)
    }

    fn start(&self, input: &str) -> String {
        format!("    {0}_nothing = select(1u, 0u, {0}_is_finite({input}));\n", self.prefix)
    }

    fn less(&self, a: &str, b: &str) -> String {
        if b == self.literal(f64::INFINITY) { self.is_finite(a) } else { format!("{a} < {b}") }
    }

    fn is_zero(&self, a: &str) -> String {
        format!("{a} == 0.0f")
    }

    fn is_finite(&self, a: &str) -> String {
        format!("{}_is_finite({a})", self.prefix)
    }

    fn select(&self, mask: &str, yes: &str, no: &str) -> String {
        format!("select({no}, {yes}, {mask})")
    }

    fn bit(&self, k: usize, truth: &str) -> String {
        format!("select(0u, {}u, {truth})", 1 << k)
    }

    fn head(&self, name: &str, arguments: &[String], is_pair: bool) -> String {
        let mut list: Vec<_> = arguments.iter().map(|argument| format!("{argument}: f32")).collect();
        if is_pair {
            list.push("second: ptr<function, f32>".to_owned());
        }
        format!("fn {}_{name}({}) -> f32 {{", self.prefix, list.join(", "))
    }

    fn head_of_point(&self, name: &str, arguments: &[Argument]) -> String {
        let written = |argument: &Argument| match argument {
            Argument::Parameters => format!("p: {}_parameters", self.prefix),
            Argument::Input(name, count) => format!("{name}: array<f32, {count}>"),
            Argument::Output(name, 1) => format!("{name}: ptr<function, f32>"),
            Argument::Output(name, count) => format!("{name}: ptr<function, array<f32, {count}>>"),
        };
        let list: Vec<_> = arguments.iter().map(written).collect();
        format!("fn {}_{name}({}) -> u32 {{", self.prefix, list.join(", "))
    }

    fn parameters_are_unused(&self) -> &'static str {
        ""
    }

    fn return_unless(&self, condition: &str, number: usize) -> String {
        format!("    if (!({condition})) {{ return {number}u; }}\n")
    }

    fn number_in_condition(&self, number: f64) -> String {
        self.literal(number)
    }

    fn parameter_in_condition(&self, place: String) -> String {
        place
    }

    fn call_in_condition(&self, name: &str, a: &str, b: &str) -> Option<String> {
        Some(match name {
            "log10" => format!("(log({a}) * 0.4342944819032518f)"),
            "cbrt" => format!("(sign({a}) * pow(abs({a}), 0.3333333333333333f))"),
            "ln_1p" => format!("log(1.0f + {a})"),
            "exp_m1" => format!("(exp({a}) - 1.0f)"),
            "recip" => format!("(1.0f / {a})"),
            // The language has powers of positive numbers alone; a condition has whole exponents here.
            "powi" => {
                let exponent = b.trim_matches(['(', ')', 'f']).parse::<f32>();
                let is_odd = exponent.is_ok_and(|exponent| exponent % 2.0 != 0.0);
                format!(
                    "({}pow(abs({a}), {b}))",
                    if is_odd { format!("sign({a}) * ") } else { String::new() }
                )
            }
            _ => return None,
        })
    }

    fn structure(&self, fields: &[Field], example: &[String]) -> String {
        let Self { prefix } = self;
        let comment = |doc: &str| if doc.is_empty() { String::new() } else { format!(" /* {doc} */") };
        let line = |field: &Field| match field {
            Field::Absent(comment) => format!("    /* {comment} */\n"),
            Field::Number(name, doc) => format!("    {name}: f32,{}\n", comment(doc)),
            Field::List(name, count, doc) => format!("    {name}: array<f32, {count}>,{}\n", comment(doc)),
        };
        format!(
            "struct {prefix}_parameters {{\n{}}}\n\nfn {prefix}_example() -> {prefix}_parameters {{\n    return {prefix}_parameters({});\n}}\n\n",
            fields.iter().map(line).collect::<String>(),
            example.join(", ")
        )
    }

    fn list(&self, numbers: &[String]) -> String {
        format!("array<f32, {}>({})", numbers.len(), numbers.join(", "))
    }

    fn example(&self) -> String {
        format!("{}_example()", self.prefix)
    }

    fn advice(&self) -> &'static str {
        "No option is needed. Divisions and square roots are as exact as the device makes them, which the language does
 * not promise to be the last bit."
    }

    fn primitives(&self, needs: &Needs<'_>) -> String {
        let text = parts(include_str!("primitives.wgsl"), |part| needs.part(part));
        text.replace("{prefix}", &self.prefix)
    }

    fn guarded(&self, text: String) -> String {
        text
    }
}
