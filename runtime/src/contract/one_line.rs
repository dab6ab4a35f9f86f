//! The contract as tests of a user's crate.

/// A module of tests, one for each [`Rule`](crate::contract::Rule), for one material.
///
/// After `piola::contract!(rubber: Rubber::new(1e6, 5e6)?);` `cargo test` shows `rubber::rest`,
/// `rubber::isotropy` and so on, and a failure names the wrong component, the stretches, and both values. The
/// first word names the module; the expression is the material under test, of any type that implements
/// [`Material`](crate::Material). It may use any name in scope at the macro, and `?` on any error.
///
/// [`Settings`](crate::contract::Settings) other than the default ones follow by name:
///
/// ```
/// # /// A stiff exponential.
/// # #[piola::material(domain(J > 0.0))]
/// # pub fn Tissue([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ kappa: f64) -> f64 {
/// #     mu / 2.0 * (I1b - 3.0).exp() + kappa / 2.0 * (J - 1.0).powi(2)
/// # }
/// piola::contract!(tissue: Tissue::new(1e4, 1e6)?, range: (0.7, 1.4), points: 32);
/// # fn main() {}
/// ```
///
/// A material declared `prestressed` carries stress at rest, which the rule `rest` admits by
/// [`stress_free_at_rest: false`](crate::contract::Settings::stress_free_at_rest).
///
/// A rule that does not apply, such as the one on extensions for a material that refuses inversion, counts as
/// kept. `cargo test -- --show-output` shows the comparisons of each rule.
#[macro_export]
macro_rules! contract {
    ($name:ident: $material:expr $(, $setting:ident: $value:expr)* $(,)?) => {
        #[allow(dead_code, unused_imports, clippy::needless_update, clippy::print_stdout)]
        mod $name {
            use super::*;

            #[track_caller]
            fn keep(rule: $crate::contract::Rule) {
                let verdict = move || judge(rule).map_err(|error| ::std::string::ToString::to_string(&error));
                match $crate::contract::with_large_stack(verdict) {
                    ::core::result::Result::Ok(finding) => ::std::println!("{finding}"),
                    ::core::result::Result::Err(error) => ::core::panic!("\n{error}\n"),
                }
            }

            fn judge(
                rule: $crate::contract::Rule,
            ) -> ::core::result::Result<::std::string::String, ::std::boxed::Box<dyn ::std::error::Error>> {
                let material = $material;
                let settings = $crate::contract::Settings {
                    $($setting: $value,)*
                    ..::core::default::Default::default()
                };
                ::core::result::Result::Ok(match $crate::contract::check_rule(rule, &material, &settings) {
                    ::core::option::Option::Some(verdict) => ::std::string::ToString::to_string(&verdict?),
                    ::core::option::Option::None => ::std::format!("{rule}: does not apply"),
                })
            }

            $crate::contract! { @tests
                rest: Rest,
                domain: Domain,
                isotropy: Isotropy,
                stress_slope: StressSlope,
                tangent_slope: TangentSlope,
                dual_numbers: DualNumbers,
                quotients: Quotients,
                strains: Strains,
                invariants: Invariants,
                extension: Extension,
                moduli: Moduli,
                single_precision: SinglePrecision,
                lanes: Lanes,
            }
        }
    };
    // Of the list above, for the macro's own use.
    (@tests $($test:ident: $rule:ident,)*) => {
        $(
            #[test]
            fn $test() {
                keep($crate::contract::Rule::$rule);
            }
        )*

        /// These tests, one for each rule, in the order of the rules.
        #[cfg(test)]
        pub(super) const TESTS: [($crate::contract::Rule, fn()); $crate::contract::Rule::ALL.len()] =
            [$(($crate::contract::Rule::$rule, $test)),*];
    };
}
