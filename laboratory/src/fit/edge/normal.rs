//! The normal of an edge, of what tells only whether it accepts a place.
//!
//! Lines in one direction d that begin at neighbouring places leave at different lengths: where n · x = c is the edge, moving
//! the beginning by ε eₖ changes the length by −ε nₖ / (n · d).

use nalgebra_34::DVector;

use super::Refusal;

/// How far apart the lines begin, by the length of the probe.
const APART: f64 = 0.1;
/// Halvings of the probe until its end at the edge is found: to 1e-12 of it, about what rounding of the place leaves.
const HALVINGS: usize = 40;
/// How often a line is made twice as long where it does not leave at once.
const DOUBLINGS: i32 = 4;

/// Outwards, of the length one, at the edge that refuses `from` + `probe` for that reason; `None` where not all lines about it
/// begin inside and leave.
///
/// Where several edges meet, the reason tells which is meant.
pub(super) fn normal(
    accepts: &impl Fn(&DVector<f64>) -> Result<(), Refusal>,
    from: &DVector<f64>,
    probe: &DVector<f64>,
    reason: &Refusal,
) -> Option<DVector<f64>> {
    let begin = from - probe;
    let apart = APART * probe.norm();
    let middle = exit(accepts, &begin, probe, reason)?;
    let mut normal = DVector::zeros(probe.len());
    for k in 0..probe.len() {
        let moved = |apart: f64| {
            let mut begin = begin.clone();
            begin[k] += apart;
            Some((middle - exit(accepts, &begin, probe, reason)?) / apart)
        };
        normal[k] = moved(apart).or_else(|| moved(-apart))?;
    }
    normal.try_normalize(0.0)
}

/// How many probes a line is long until it is refused for that reason; `None` where its beginning is refused, for any.
fn exit(
    accepts: &impl Fn(&DVector<f64>) -> Result<(), Refusal>,
    begin: &DVector<f64>,
    probe: &DVector<f64>,
    reason: &Refusal,
) -> Option<f64> {
    accepts(begin).ok()?;
    let is_outside = |length: &f64| {
        let refusal = accepts(&(begin + probe * *length)).err();
        refusal.is_some_and(|refusal| refusal.is_like(reason))
    };
    let mut outside = (1..=DOUBLINGS).map(|k| 2.0_f64.powi(k)).find(is_outside)?;
    let mut inside = 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        *(if is_outside(&middle) { &mut outside } else { &mut inside }) = middle;
    }
    Some(inside)
}

#[cfg(test)]
mod tests {
    use piola::material::Inadmissible;

    use super::*;

    fn violated(condition: &'static str) -> Refusal {
        Refusal::Inadmissible(Inadmissible::Violated { condition, given: Vec::new() })
    }

    /// 3 x + 4 y ≤ 5 and x ≤ 1, which meet at (1, 1/2).
    fn corner(place: &DVector<f64>) -> Result<(), Refusal> {
        if place[0] > 1.0 {
            return Err(violated("x"));
        }
        if 3.0 * place[0] + 4.0 * place[1] > 5.0 { Err(violated("plane")) } else { Ok(()) }
    }

    #[track_caller]
    fn check(from: [f64; 2], condition: &'static str, expected: [f64; 2]) {
        let (from, probe) = (DVector::from_row_slice(&from), DVector::from_row_slice(&[2e-3, 1e-3]));
        let found = normal(&corner, &from, &probe, &violated(condition)).expect("an edge");
        // 16 probes by 2⁴⁰ by a tenth of a probe, and rounding of the place by as much.
        let error = (found - DVector::from_row_slice(&expected)).norm();
        assert!(error <= 1e-9, "{error:e}");
    }

    #[test]
    fn each_edge_of_a_corner_has_its_own_normal() {
        check([1.0, 0.5], "x", [1.0, 0.0]);
        check([0.2, 1.1], "plane", [0.6, 0.8]);
        check([1.0, 0.0], "x", [1.0, 0.0]);
    }

    #[test]
    fn what_is_not_at_hand_has_no_normal() {
        let (from, probe) = (DVector::from_row_slice(&[0.0, 0.0]), DVector::from_row_slice(&[1e-3, 0.0]));
        assert_eq!(normal(&corner, &from, &probe, &violated("x")), None);
        let outside = DVector::from_row_slice(&[2.0, 0.0]);
        assert_eq!(normal(&corner, &outside, &probe, &violated("x")), None);
    }
}
