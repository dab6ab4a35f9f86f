//! The calculus against the definitions it replaces, in the interpreter: no shared code but the expression
//! graph.

use piola_codegen::algebra::expr::{Graph, Id};
use piola_codegen::algebra::interpret::{Point, evaluate};
use piola_codegen::model::{Model, PAIRS, Variant, model};
use piola_codegen::read::parse::parse;
use piola_codegen::schedule::{Op, Statement};
use proc_macro2::TokenStream;
use quote::quote;

/// Energies whose parts meet every rule: invariants, isochoric forms, logarithms, exponentials, roots, real
/// powers, products of functions of single stretches.
fn energies() -> Vec<(&'static str, bool, TokenStream, TokenStream)> {
    vec![
        (
            "st_venant_kirchhoff",
            false,
            quote!(),
            quote! {
                fn E([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
                    mu / 4.0 * ((l1 * l1 - 1.0).powi(2) + (l2 * l2 - 1.0).powi(2) + (l3 * l3 - 1.0).powi(2))
                        + lambda / 8.0 * (I1 - 3.0).powi(2)
                }
            },
        ),
        (
            "corotated",
            true,
            quote!(),
            quote! {
                fn E([x, y, z]: [f64; 3], mu: f64, lambda: f64) -> f64 {
                    mu * ((x - 1.0).powi(2) + (y - 1.0).powi(2) + (z - 1.0).powi(2)) + lambda / 2.0 * (J - 1.0).powi(2)
                }
            },
        ),
        (
            "neo-Hookean",
            false,
            quote!(domain(J > 0.0), extend),
            quote! {
                fn E([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
                    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
                }
            },
        ),
        (
            "Mooney–Rivlin",
            false,
            quote!(domain(J > 0.0), extend),
            quote! {
                fn E([l1, l2, l3]: [f64; 3], c10: f64, c01: f64, kappa: f64) -> f64 {
                    c10 * (I1b - 3.0) + c01 * (I2b - 3.0) + kappa / 2.0 * (J - 1.0).powi(2)
                }
            },
        ),
        (
            "Hencky",
            false,
            quote!(domain(J > 0.0), extend),
            quote! {
                fn E([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
                    mu * (l1.ln().powi(2) + l2.ln().powi(2) + l3.ln().powi(2)) + lambda / 2.0 * J.ln().powi(2)
                }
            },
        ),
        (
            "Ogden",
            false,
            quote!(domain(J > 0.0), extend(mu[p] * alpha[p] > 0.0)),
            quote! {
                fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; N], kappa: f64) -> f64 {
                    sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0))
                        - sum(|p| mu[p]) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
                }
            },
        ),
        (
            "Gent",
            false,
            quote!(domain(J > 0.0, I1 - 3.0 < jm), admissible(jm > 0.0)),
            quote! {
                fn E([l1, l2, l3]: [f64; 3], mu: f64, jm: f64, kappa: f64) -> f64 {
                    -mu * jm / 2.0 * (1.0 - (I1 - 3.0) / jm).ln() - mu * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
                }
            },
        ),
        (
            "Fung",
            false,
            quote!(),
            quote! {
                fn E([l1, l2, l3]: [f64; 3], c: f64, a1: f64, a2: f64) -> f64 {
                    let e1 = (l1 * l1 - 1.0) / 2.0;
                    let e2 = (l2 * l2 - 1.0) / 2.0;
                    let e3 = (l3 * l3 - 1.0) / 2.0;
                    c / 2.0 * ((a1 * (e1 + e2 + e3).powi(2) + a2 * (e1 * e1 + e2 * e2 + e3 * e3)).exp() - 1.0)
                }
            },
        ),
        // Functions of single stretches that are neither symmetric nor odd, and their products.
        (
            "Valanis–Landel with products",
            false,
            quote!(domain(J > 0.0), prestressed),
            quote! {
                fn E([l1, l2, l3]: [f64; 3], a: f64) -> f64 {
                    let sums = l1 * l1.ln() + l2 * l2.ln() + l3 * l3.ln() + (l1 / 2.0).exp() + (l2 / 2.0).exp() + (l3 / 2.0).exp();
                    let roots = (l1 * l2).sqrt() + (l2 * l3).sqrt() + (l3 * l1).sqrt();
                    let products = l1.powf(a) * l2.ln() * l3.ln() + l2.powf(a) * l3.ln() * l1.ln() + l3.powf(a) * l1.ln() * l2.ln();
                    sums + roots + products + (l1.cbrt() + l2.cbrt() + l3.cbrt()).recip()
                }
            },
        ),
    ]
}

fn compile(name: &str, arguments: &TokenStream, item: &TokenStream) -> Model {
    parse(arguments.clone(), item.clone()).and_then(|d| model(&d)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

struct Judge<'a> {
    name: &'a str,
    graph: &'a Graph,
    variant: &'a Variant,
}

impl Judge<'_> {
    fn value(&self, id: Id, point: &Point) -> f64 {
        evaluate(self.graph, id, point).value
    }

    /// Relative to all parts of the tangent, tolerance 1e-11: a hundred roundings amplified by gaps no less
    /// than 0.05.
    #[track_caller]
    fn check(&self, what: &str, value: f64, expected: f64, point: &Point) {
        let scale: f64 = self.variant.hessian.iter().map(|&h| self.value(h, point).abs()).sum();
        assert!(
            (value - expected).abs() <= 1e-11 * (scale + expected.abs()),
            "{}: {what} is {value:e}, not {expected:e}, at {:?}",
            self.name,
            point.stretches
        );
    }

    fn separated(&self, point: &Point) {
        let gradient = self.variant.gradient.map(|id| self.value(id, point));
        let l = point.stretches;
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            let plain = (gradient[i] - gradient[j]) / (l[i] - l[j]);
            self.check("flip", self.value(self.variant.flip[k], point), plain, point);
            let plain = (gradient[i] + gradient[j]) / (l[i] + l[j]);
            self.check("twist", self.value(self.variant.twist[k], point), plain, point);
        }
    }

    /// At equal stretches D⁻ij is ψii − ψij.
    fn coincident(&self, point: &Point) {
        let equal = Point { stretches: [point.stretches[0]; 3], ..point.clone() };
        let [normal, mixed] = [0, 3].map(|k| self.value(self.variant.hessian[k], &equal));
        for &flip in &self.variant.flip {
            self.check("flip of equal stretches", self.value(flip, &equal), normal - mixed, &equal);
        }
    }

    /// At opposite stretches a removable D⁺ij is ψii + ψij.
    fn opposite(&self, point: &Point) {
        let [x, y, _] = point.stretches;
        let point = Point { stretches: [x, y, -y], ..point.clone() };
        let [normal, mixed] = [1, 5].map(|k| self.value(self.variant.hessian[k], &point));
        self.check(
            "twist of opposite stretches",
            self.value(self.variant.twist[2], &point),
            normal + mixed,
            &point,
        );
    }
}

#[test]
fn quotients_are_what_they_are_defined_to_be() {
    for (name, _, arguments, item) in energies() {
        let model = compile(name, &arguments, &item);
        for variant in [Some(&model.plain), model.extended.as_ref()].into_iter().flatten() {
            let judge = Judge { name, graph: &model.graph, variant };
            for point in &model.samples {
                judge.separated(point);
                judge.coincident(point);
            }
        }
        if let Some(extended) = &model.extended {
            let judge = Judge { name, graph: &model.graph, variant: extended };
            for stretches in [[1.2, 0.7, -0.3], [0.8, 0.3, 0.1], [0.45, 0.3, -0.1], [1.2, 0.55, 0.45]] {
                judge.separated(&Point { stretches, ..model.samples[0].clone() });
            }
            let equal = [0.3; 3];
            judge.coincident(&Point { stretches: equal, ..model.samples[0].clone() });
        }
    }
}

/// Where one stretch is far below the other, the plain quotient is exact. ψ1 is a product of a factor that
/// vanishes with its stretch and of one that grows without bound.
#[test]
fn factors_of_opposite_trends_do_not_cancel_on_flat_elements() {
    let item = quote! {
        fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
            mu * (sum(|l| l.ln().tanh() + l.powi(2)) - 3.0)
        }
    };
    let model = compile("opposite trends", &quote!(domain(J > 0.0), prestressed), &item);
    for flat in [1e-2, 1e-4, 1e-8, 1e-10] {
        let point = Point { stretches: [1.3, 1.1, flat], ..model.samples[0].clone() };
        let value = |id| evaluate(&model.graph, id, &point).value;
        let [g1, _, g3] = model.plain.gradient.map(value);
        let (found, plain) = (value(model.plain.flip[1]), (g1 - g3) / (1.3 - flat));
        assert!((found - plain).abs() <= 1e-12 * plain.abs(), "{found:e} for {plain:e} at {flat:e}");
    }
}

#[test]
fn twists_have_poles_exactly_where_the_stress_jumps() {
    for (name, has_pole, arguments, item) in energies() {
        let model = compile(name, &arguments, &item);
        assert_eq!(model.plain.has_pole, has_pole, "{name}");
        // Extended in its stretches, no energy is even any more.
        assert!(model.extended.as_ref().is_none_or(|extended| extended.has_pole), "{name}, extended");
        if matches!(name, "st_venant_kirchhoff" | "Fung") {
            let judge = Judge { name, graph: &model.graph, variant: &model.plain };
            model.samples.iter().for_each(|point| judge.opposite(point));
        }
    }
}

#[test]
fn extension_is_twice_continuously_differentiable() {
    for (name, _, arguments, item) in energies() {
        let model = compile(name, &arguments, &item);
        let Some(extended) = &model.extended else { continue };
        let judge = Judge { name, graph: &model.graph, variant: extended };
        for sample in &model.samples {
            // ε is 0.5 in the samples; above it nothing changes, and across it nothing jumps.
            let at = |z: f64| Point { stretches: [1.25, 0.75, z], ..sample.clone() };
            let (above, below) = (at(0.5 + 1e-13), at(0.5 - 1e-13));
            let all = |v: &Variant| [&[v.energy][..], &v.gradient, &v.hessian, &v.flip].concat();
            for (inside, outside) in all(&model.plain).into_iter().zip(all(extended)) {
                judge.check("above ε", judge.value(outside, &above), judge.value(inside, &above), &above);
                judge.check("across ε", judge.value(outside, &below), judge.value(outside, &above), &below);
            }
        }
    }
}

/// The seam's promise, read off the operations themselves.
#[test]
fn nothing_is_divided_by_a_difference_of_stretches() {
    for (name, _, arguments, item) in energies() {
        let mut model = compile(name, &arguments, &item);
        for variant in [Some(model.plain.clone()), model.extended.clone()].into_iter().flatten() {
            let roots = [&variant.gradient[..], &variant.hessian, &variant.flip, &variant.twist].concat();
            let program = model.program(&roots);
            let operations: Vec<_> = program
                .statements
                .iter()
                .flat_map(|statement| match statement {
                    Statement::Let(value, op) => vec![(*value, *op)],
                    Statement::Loop { body, .. } => body.clone(),
                })
                .collect();
            let of = |value| operations.iter().find(|(v, _)| *v == value).map(|(_, op)| *op);
            for (_, op) in &operations {
                if let Op::Div(_, denominator) = op {
                    let is_gap = matches!(of(*denominator), Some(Op::Sub(a, b))
                        if matches!((of(a), of(b)), (Some(Op::Stretch(_)), Some(Op::Stretch(_)))));
                    assert!(!is_gap, "{name} divides by a gap");
                }
            }
        }
    }
}

#[test]
fn ogden_needs_three_powers_for_each_term_and_energy_alone_no_quotient() {
    let (_, _, arguments, item) = energies().swap_remove(5);
    let mut model = compile("Ogden", &arguments, &item);
    let variant = model.plain.clone();
    let mut count = |roots: &[Id]| {
        let program = model.program(roots);
        let (mut powers, mut quotients) = (0, 0);
        for statement in &program.statements {
            if let Statement::Loop { body, .. } = statement {
                powers += body.iter().filter(|(_, op)| matches!(op, Op::Power(..))).count();
                quotients += body.iter().filter(|(_, op)| matches!(op, Op::PowerQuotient { .. })).count();
            }
        }
        (powers, quotients)
    };
    assert_eq!(count(&[variant.energy]), (3, 0));
    assert_eq!(count(&variant.gradient), (3, 0));
    let all = [&variant.gradient[..], &variant.hessian, &variant.flip, &variant.twist].concat();
    assert_eq!(count(&all), (3, 3));
}

/// I1b is even in each pair of stretches: the twist quotient of a power of it has no quotient of powers, and
/// no power of a mirrored I1b.
#[test]
fn twists_of_isochoric_powers_need_one_power() {
    let item = quote! {
        fn E([l1, l2, l3]: [f64; 3], mu: f64, n: f64) -> f64 { mu / n * (I1b / 3.0).powf(n) + mu * (J - 1.0).powi(2) }
    };
    let mut model = compile("power of I1b", &quote!(domain(J > 0.0)), &item);
    let twist = model.plain.twist;
    let program = model.program(&twist);
    let operations = program.statements.iter().filter_map(|statement| match statement {
        Statement::Let(_, op) => Some(*op),
        Statement::Loop { .. } => None,
    });
    let count = |is: fn(&Op) -> bool| operations.clone().filter(is).count();
    assert_eq!(count(|op| matches!(op, Op::Power(..))), 1);
    assert_eq!(count(|op| matches!(op, Op::PowerQuotient { .. })), 0);
}

#[test]
fn moduli_follow_from_the_energy() {
    let (_, _, arguments, item) = energies().swap_remove(5);
    let model = compile("Ogden", &arguments, &item);
    for point in &model.samples {
        let [mu, lambda] = model.moduli.map(|id| evaluate(&model.graph, id, point).value);
        let expected: f64 =
            point.parameters[0].iter().zip(&point.parameters[1]).map(|(m, a)| m * a / 2.0).sum();
        assert!((mu - expected).abs() <= 1e-12 * expected.abs(), "μ {mu} is Σ μₚ αₚ / 2 = {expected}");
        assert!((lambda - point.parameters[2][0]).abs() <= 1e-12 * lambda.abs());
    }
}

/// Far outside its domain an exponential overflows, which does not reveal its parity: the pole must stay.
#[test]
fn overflow_is_no_parity() {
    let arguments = quote!(domain(J > 0.0), extend, prestressed);
    let item = quote! {
        fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
            mu * (l1.powi(-12) + l2.powi(-12) + l3.powi(-12)).exp()
        }
    };
    let model = compile("exponential of powers", &arguments, &item);
    assert!(model.extended.is_some_and(|extended| extended.has_pole));
}

/// A root of high degree would multiply its rounding error: 1.305678 is 652839/500000.
#[test]
fn literal_exponents_are_real_powers_unless_they_are_simple_fractions() {
    let item = quote! {
        fn E([x, y, z]: [f64; 3], a: f64) -> f64 {
            a * (x.powf(1.305678) + y.powf(1.305678) + z.powf(1.305678)) + a * (x.powf(1.5) + y.powf(1.5) + z.powf(1.5))
        }
    };
    let mut model = compile("literal exponents", &quote!(domain(J > 0.0), prestressed), &item);
    let variant = model.plain.clone();
    let roots = [&variant.gradient[..], &variant.hessian, &variant.flip, &variant.twist].concat();
    let program = model.program(&roots);
    let count = |matches: fn(&Op) -> bool| {
        let is_match = |statement: &&Statement| matches!(statement, Statement::Let(_, op) if matches(op));
        program.statements.iter().filter(is_match).count()
    };
    assert_eq!(count(|op| matches!(op, Op::Power(..))), 3);
    assert_eq!(count(|op| matches!(op, Op::PowerQuotient { .. })), 3);
    assert_eq!(count(|op| matches!(op, Op::Sqrt(_))), 3);
    let judge = Judge { name: "literal exponents", graph: &model.graph, variant: &variant };
    model.samples.iter().for_each(|point| judge.separated(point));
}

/// Multiplying out all of it would take 4⁴ · 4⁴ terms.
#[test]
fn products_of_sums_compile_in_no_time() {
    let item = quote! {
        fn E([x, y, z]: [f64; 3], a: f64) -> f64 {
            let s = x + y + z;
            a * (s + J).powi(4) * (s + I1).powi(4) * (s + I2).powi(4) * (s + 1.0).powi(4)
        }
    };
    let start = std::time::Instant::now();
    let model = compile("product of sums", &quote!(prestressed), &item);
    assert!(start.elapsed().as_secs() < 5);
    let judge = Judge { name: "product of sums", graph: &model.graph, variant: &model.plain };
    model.samples.iter().filter(|point| point.stretches[2] > 0.0).for_each(|point| judge.separated(point));
}

#[test]
fn parameters_may_be_large_or_in_order() {
    let large = quote!(
        fn E([x, y, z]: [f64; 3], mu: f64) -> f64 {
            mu * ((I1 - 3.0).powi(2) + I1 * I1 / 3.0 - I2)
        }
    );
    compile("large", &quote!(admissible(mu > 1e9)), &large);
    let ordered = quote! {
        fn E([x, y, z]: [f64; 3], a: f64, b: f64, c: f64, d: f64) -> f64 {
            ((b - a) * (c - b)).sqrt() * (d - c).ln().powi(2) * (1.0 - d).sqrt() * (I1 * I1 / 3.0 - I2)
        }
    };
    compile("ordered", &quote!(admissible(a > 0.0, a < b, b < c, c < d, d < 1.0)), &ordered);
}

/// 2²⁴ terms when written out; a hundred nodes in the graph.
#[test]
fn formulas_are_cut_off() {
    let mut body = String::from("let v0 = I1 / 3.0 - 1.0;");
    for k in 0..24 {
        body += &format!("let v{0} = 0.5 * (v{1} + v{1} * (1.0 - v{1}));", k + 1, k);
    }
    let body: TokenStream =
        format!("{{ {body} mu * (v24.powi(2) + I1 * I1 / 3.0 - I2) }}").parse().expect("tokens");
    let item = quote!(fn E([x, y, z]: [f64; 3], mu: f64) -> f64 #body);
    let mut model = compile("shared", &quote!(), &item);
    let declaration = parse(quote!(), item).expect("a declaration");
    let text = piola_codegen::printer::formula(&mut model.graph, &declaration, model.energy);
    assert!(text.contains('…') && text.len() < 20_000, "{} bytes", text.len());
}
