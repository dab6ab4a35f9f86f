//! Functions that programs are made of, from the files `primitives.c` and `primitives.wgsl`.

use super::{Kind, Language};
use crate::emit::Target;

/// Parts of the files.
const C: &str = include_str!("primitives.c");
const WGSL: &str = include_str!("primitives.wgsl");
const COMMENT: &str = include_str!("comment.txt");

/// The needed parts of a file, each of which follows a line `//@` with its name, the function first.
fn parts(file: &str, is_needed: impl Fn(&str) -> bool) -> Vec<(&str, String)> {
    let parts = file.split("//@ ").filter_map(|part| part.split_once('\n'));
    let mut functions: Vec<(&str, String)> = Vec::new();
    for (name, text) in parts.filter(|(name, _)| is_needed(name)) {
        let function = name.split(' ').next().unwrap_or(name);
        match functions.last_mut() {
            Some((last, whole)) if *last == function => whole.push_str(text),
            _ => functions.push((function, text.to_owned())),
        }
    }
    functions
}

impl Language {
    /// The part of the comment at the top of a file that is the same for all energies.
    pub(in crate::emit) fn comment(&self) -> String {
        let target = format!("{:?}", self.target);
        let parts = parts(COMMENT, |part| part == "all" || part == "end" || part == target);
        let text: String = parts.into_iter().map(|(_, text)| text).collect();
        text.replace("{prefix}", &self.prefix).replace("{example}", &self.example())
    }

    /// Text before the macros and functions of C: headers, and errors for options that change
    /// arithmetic.
    pub(super) fn head_of_file(&self) -> String {
        let (of_target, of_double) = match self.target {
            Target::C => ("head of c", None),
            Target::Cuda => ("head of cuda", None),
            Target::OpenCl => ("head of opencl", (!self.is_single).then_some("head of opencl in double")),
            Target::Wgsl => return String::new(),
        };
        let parts = parts(C, |part| part == "head" || part == of_target || Some(part) == of_double);
        parts.into_iter().map(|(_, text)| self.filled(&text)).collect()
    }

    /// Functions that programs are made of, those that a text calls.
    pub(in crate::emit) fn primitives(&self, text: &str) -> String {
        // Each part has the name of its function; `all` is always needed.
        let is_called = |part: &str| part == "all" || text.contains(&format!("{}_{part}(", self.shared));
        let target = self.target;
        if target == Target::Wgsl {
            let parts = parts(WGSL, is_called).into_iter();
            return parts.map(|(_, text)| text.replace("{prefix}", &self.shared)).collect();
        }
        let has_bits = ["is_finite", "scale", "split", "leading_power", "reciprocal_of_power"];
        let has_bits = target == Target::Cuda || has_bits.into_iter().any(is_called);
        let is_in_double = self.is_single && target != Target::OpenCl;
        let parts = parts(C, |part| match part {
            "bits of opencl" => target == Target::OpenCl,
            "bits" => target != Target::OpenCl && has_bits,
            "is_exact on a device" => target == Target::Cuda,
            "product_error in double" => is_in_double && is_called("product_error"),
            "product_error by halves" => !is_in_double && is_called("product_error"),
            part => is_called(part),
        });
        let once = |(function, text): (&str, String)| match function {
            // Macros may be defined again.
            "all" => self.filled(&text),
            function => self.shared(function, &self.filled(&text)),
        };
        parts.into_iter().map(once).collect()
    }

    /// A part in C with the words of the dialect and the numbers of the format.
    fn filled(&self, part: &str) -> String {
        let is_of_opencl = self.target == Target::OpenCl;
        let (bits, signed) = match (is_of_opencl, self.is_single) {
            (_, true) => ("unsigned", "int"),
            (true, false) => ("ulong", "long"),
            (false, false) => ("unsigned long long", "long long"),
        };
        let fast = if self.is_single { "FP_FAST_FMAF" } else { "FP_FAST_FMA" };
        // A device has no such macro, and clang has only that of the processor.
        let is_of_cuda = self.target == Target::Cuda;
        let on_device =
            if is_of_cuda { " || defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)" } else { "" };
        let has_fast = format!("defined({fast}) || defined(__FMA__){on_device}");
        let number = self.type_of(Kind::Number);
        let of_format = |single: &'static str, double: &'static str| match self.is_single {
            true => single.to_owned(),
            false => double.to_owned(),
        };
        let infinity_bits = if is_of_opencl { "0x7ff0000000000000UL" } else { "0x7ff0000000000000ull" };
        let words = [
            ("{prefix}", self.shared.clone()),
            ("{upper}", self.upper()),
            ("{number}", number.to_owned()),
            ("{bits}", bits.to_owned()),
            ("{signed}", signed.to_owned()),
            ("{opencl_bits}", of_format("uint", "ulong")),
            ("{end}", self.end().to_owned()),
            ("{suffix}", self.suffix().to_owned()),
            ("{function}", self.function(number)),
            ("{function_to_bits}", self.function(bits)),
            ("{has_fast}", has_fast),
            // The bit 16 is about numbers of 16 bits.
            ("{is_wide}", of_format("FLT_EVAL_METHOD & ~16", "FLT_EVAL_METHOD & ~17")),
            ("{nan}", self.literal(f64::NAN)),
            ("{infinity}", self.literal(f64::INFINITY)),
            ("{infinity_bits}", of_format("0x7f800000u", infinity_bits)),
            ("{sign_place}", of_format("31", "63")),
            ("{mantissa}", of_format("23", "52")),
            ("{digits}", of_format("24", "53")),
            ("{bias}", of_format("127", "1023")),
            ("{twice_bias}", of_format("254", "2046")),
            // ¾/u, √½, the smallest normal number, 1/u, and what splits a number into halves of its digits.
            ("{rounding}", of_format("12582912.0f", "6755399441055744.0")),
            ("{half_root}", of_format("0x3f3504f3", "0x3fe6a09e667f3bcd")),
            ("{smallest}", of_format("1.17549435e-38f", "2.2250738585072014e-308")),
            ("{lift}", of_format("16777216.0f", "9007199254740992.0")),
            ("{splitter}", of_format("4097.0f", "134217729.0")),
        ];
        words.iter().fold(part.to_owned(), |text, (word, meaning)| text.replace(word, meaning))
    }
}
