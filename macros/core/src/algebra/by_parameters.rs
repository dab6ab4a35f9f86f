//! Derivatives with respect to the parameters, for least-squares fits: of the stress, and of the conditions
//! on parameters.
//!
//! A number is a variable like a stretch. The entry q of a list m occurs in sums T = Σₚ b(mₚ, …), wherever
//! these stand, and sums may stand in the terms of others. With ∂e/∂T the derivative by the whole sum as one
//! variable, and b differentiated with whole sums inside it constant,
//!
//! ```text
//! ∂e/∂m_q = Σ_T ∂e/∂T · ∂b/∂m (m_q, …)     over all sums T in e
//! ```
//!
//! The factor on the right has an entry outside any sum: [`Node::Entry`] there is entry q, for any q. The
//! factor on the left has no entry, so that an entry inside a sum is never mistaken for one outside.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::diff::Differentiator;
use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::simplify::simplify;

/// The derivatives of each expression by each variable, a parameter or the entry of a list outside any sum.
pub fn by_parameters<const N: usize>(
    graph: &mut Graph,
    variables: &[Node],
    expressions: [Id; N],
) -> Vec<[Id; N]> {
    let mut parents: FxHashMap<Id, Vec<Id>> = FxHashMap::default();
    for id in graph.reachable(&expressions) {
        for child in graph.children(id) {
            parents.entry(child).or_default().push(id);
        }
    }
    let mut by_variable = |variable: &Node| {
        let variable_id = graph.leaf(variable.clone());
        expressions.map(|expression| {
            let derivative = match variable {
                Node::Entry(_) => by_entry(graph, expression, variable_id, &parents),
                // Most parts of an energy with many parameters depend on few of them.
                _ => Differentiator::within(above(variable_id, &parents)).derivative(
                    graph,
                    expression,
                    variable_id,
                ),
            };
            simplify(graph, derivative)
        })
    };
    variables.iter().map(&mut by_variable).collect()
}

/// An expression and all that contain it.
fn above(id: Id, parents: &FxHashMap<Id, Vec<Id>>) -> FxHashSet<Id> {
    let (mut found, mut left) = (FxHashSet::default(), vec![id]);
    while let Some(id) = left.pop() {
        if found.insert(id) {
            left.extend(parents.get(&id).into_iter().flatten());
        }
    }
    found
}

/// ∂e/∂m_q of a list m, given what contains each node.
fn by_entry(graph: &mut Graph, e: Id, entry: Id, parents: &FxHashMap<Id, Vec<Id>>) -> Id {
    let containing = above(entry, parents);
    let mut d = Differentiator::within(containing.clone());
    // Entry q outside any sum.
    let mut terms = vec![d.derivative(graph, e, entry)];
    for sum in graph.reachable(&[e]).into_iter().filter(|id| containing.contains(id)) {
        let Node::Sum(_, body) = *graph.node(sum) else { continue };
        let inner = d.derivative(graph, body, entry);
        if !graph.is_zero(inner) {
            let outer = Differentiator::within(above(sum, parents)).derivative(graph, e, sum);
            terms.push(graph.mul(outer, inner));
        }
    }
    graph.sum_of(&terms)
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use proc_macro2::TokenStream;
    use quote::quote;

    use crate::algebra::interpret::{Point, evaluate};
    use crate::analyse;

    /// Entry `place` of every list in place of entry 0, which stands for all outside sums.
    fn with_first(point: &Point, place: usize) -> Point {
        let mut point = point.clone();
        Rc::make_mut(&mut point.parameters)
            .iter_mut()
            .filter(|list| list.len() > place)
            .for_each(|list| list.swap(0, place));
        point
    }

    /// Compares with finite differences by each parameter: their error must fall as h², or be at most
    /// rounding.
    #[track_caller]
    fn check(body: TokenStream, parameters: &[&[f64]], stretches: [f64; 3]) {
        let item = quote! {
            fn E<const N: usize>([x, y, z]: [f64; 3], m: [f64; N], a: [f64; N], k: f64) -> f64 { #body }
        };
        let (declaration, mut model) =
            analyse(quote!(domain(J > 0.0), prestressed), item).expect("an energy");
        let point = Point {
            stretches,
            parameters: Rc::new(parameters.iter().map(|list| list.to_vec()).collect()),
            lengths: vec![parameters[0].len()],
            ..Point::default()
        };
        let gradient = model.by_parameters(&declaration).gradient;
        for (list, derivatives) in gradient.into_iter().enumerate() {
            for (place, stress) in
                (0..parameters[list].len()).flat_map(|place| [0, 1, 2].map(|stress| (place, stress)))
            {
                let exact = evaluate(&model.graph, derivatives[stress], &with_first(&point, place)).value;
                let at = |change: f64| {
                    let mut point = point.clone();
                    Rc::make_mut(&mut point.parameters)[list][place] += change;
                    evaluate(&model.graph, model.plain.gradient[stress], &point)
                };
                let error = |h: f64| ((at(h).value - at(-h).value) / (2.0 * h) - exact).abs();
                let (coarse, fine) = (error(1e-2), error(1e-3));
                let rounding = 100.0 * f64::EPSILON / 1e-3 * at(0.0).magnitude;
                let is_slope = fine <= rounding || (80.0..120.0).contains(&(coarse / fine));
                assert!(is_slope, "ψ{} by {list}, entry {place}: {coarse:e} then {fine:e}", stress + 1);
            }
        }
    }

    const LISTS: [&[f64]; 3] = [&[1.5, 0.7, 0.4], &[1.3, 3.0, -2.0], &[0.8]];
    const STRETCHES: [f64; 3] = [1.7, 1.2, 0.6];

    #[test]
    fn entries_of_two_lists_in_one_sum() {
        let ogden = quote! {
            sum(|p| m[p] / a[p] * (x.powf(a[p]) + y.powf(a[p]) + z.powf(a[p]) - 3.0)) - sum(|p| m[p]) * J.ln() * k
        };
        check(ogden.clone(), &LISTS, STRETCHES);
        check(ogden, &LISTS, [1.0; 3]);
    }

    #[test]
    fn sums_in_products_and_functions() {
        let body = quote! {
            let powers = sum(|p| m[p] * (x.powf(a[p]) + y.powf(a[p]) + z.powf(a[p])));
            powers * sum(|p| a[p] * a[p]) * (k * J).ln() + powers.powi(-2) + powers.sqrt()
        };
        check(body, &LISTS, STRETCHES);
    }

    #[test]
    fn sums_in_the_terms_of_others() {
        let body = quote! {
            let total = sum(|p| m[p]);
            let shares = sum(|p| m[p] / total * (I1 * a[p]).exp() * total.ln());
            sum(|p| a[p] * shares.powi(2) * m[p]) + k * I1
        };
        check(body, &[&[0.5, 0.7], &[0.1, 0.2], &[0.8]], STRETCHES);
    }

    #[test]
    fn parameters_in_exponents() {
        let body = quote! {
            let exponent = k * sum(|p| m[p]) - 1.0;
            I1.powf(exponent) + sum(|p| (1.0 + m[p] * I1).powf(a[p] * k)) + 2.0.powf(k * k) * J.powf(k / 3.0)
        };
        check(body.clone(), &LISTS, STRETCHES);
        check(body.clone(), &[&[1.0], &[0.0], &[1.0]], [1.0; 3]);
        check(body, &[&[1.0], &[1.0], &[0.0]], STRETCHES);
    }
}
