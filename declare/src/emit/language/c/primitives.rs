//! Functions of C that programs are made of, from the file `primitives.c`.

use super::{C, Dialect};
use crate::emit::language::{Language, Needs, parts};

/// Parts of the file.
const TEXT: &str = include_str!("../primitives.c");

impl C {
    /// What comes before the macros and functions: headers, and errors for options that change arithmetic.
    pub(super) fn head(&self) -> String {
        let (of_dialect, of_double) = match self.dialect {
            Dialect::C => ("head of c", None),
            Dialect::Cuda => ("head of cuda", None),
            Dialect::OpenCl => ("head of opencl", (!self.is_single).then_some("head of opencl in double")),
        };
        self.filled(&parts(TEXT, |part| part == of_dialect || Some(part) == of_double))
    }

    pub(super) fn functions_of(&self, needs: &Needs<'_>) -> String {
        let (dialect, is_single) = (self.dialect, self.is_single);
        let has_bits = ["scale", "split", "leading_power", "reciprocal_of_power"];
        let has_bits = dialect == Dialect::Cuda || has_bits.into_iter().any(|part| needs.part(part));
        let is_in_double = is_single && dialect != Dialect::OpenCl;
        self.filled(&parts(TEXT, |part| match part {
            "bits of opencl" => dialect == Dialect::OpenCl,
            "bits" => dialect != Dialect::OpenCl && has_bits,
            "copysign" => dialect == Dialect::Cuda && needs.part(part),
            "product_error in double" => is_in_double && needs.part("product_error"),
            "product_error by halves" => !is_in_double && needs.part("product_error"),
            part => needs.part(part),
        }))
    }

    /// A part with the words of the dialect and the numbers of the format.
    fn filled(&self, part: &str) -> String {
        let is_of_opencl = self.dialect == Dialect::OpenCl;
        let (bits, signed) = match (is_of_opencl, self.is_single) {
            (_, true) => ("unsigned", "int"),
            (true, false) => ("ulong", "long"),
            (false, false) => ("unsigned long long", "long long"),
        };
        let fast = if self.is_single { "FP_FAST_FMAF" } else { "FP_FAST_FMA" };
        let has_fast = match self.dialect {
            // A device has no such macro, and clang has only that of the processor.
            Dialect::Cuda => format!(
                "defined({fast}) || defined(__FMA__) || defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)"
            ),
            Dialect::C | Dialect::OpenCl => format!("defined({fast}) || defined(__FMA__)"),
        };
        let of_format = |single: &'static str, double: &'static str| match self.is_single {
            true => single.to_owned(),
            false => double.to_owned(),
        };
        let infinity_bits = if is_of_opencl { "0x7ff0000000000000UL" } else { "0x7ff0000000000000ull" };
        let words = [
            ("{prefix}", self.prefix.clone()),
            ("{upper}", self.upper.clone()),
            ("{number}", self.number().to_owned()),
            ("{bits}", bits.to_owned()),
            ("{signed}", signed.to_owned()),
            ("{opencl_bits}", of_format("uint", "ulong")),
            ("{end}", self.end().to_owned()),
            ("{suffix}", self.suffix().to_owned()),
            ("{function}", self.function(self.number())),
            ("{function_to_bits}", self.function(bits)),
            ("{has_fast}", has_fast),
            ("{exact}", of_format("FLT_EVAL_METHOD == 0", "FLT_EVAL_METHOD >= 0 && FLT_EVAL_METHOD < 2")),
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
