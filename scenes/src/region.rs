//! Boxes that select a part of a body, in metres or as shares of its bounding box.

use piola_bodies::mesh::Bounds;

/// All of space, in metres or shares.
pub const EVERYWHERE: Bounds = Bounds { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY; 3] };

/// A box from shares of another: 0 is the low side of `whole`, 1 the high one, to the last bit.
#[must_use]
pub fn within(whole: Bounds, shares: Bounds) -> Bounds {
    let size = whole.size();
    let place = |share: f64, i: usize| {
        match share {
            // A sum could round to a place beyond the last node.
            1.0 => whole.max[i],
            // An infinite share of a flat box would not be a number.
            _ if share.is_infinite() => share,
            _ => whole.min[i] + share * size[i],
        }
    };
    Bounds {
        min: std::array::from_fn(|i| place(shares.min[i], i)),
        max: std::array::from_fn(|i| place(shares.max[i], i)),
    }
}

/// Parses a box in metres, `LOW:HIGH,LOW:HIGH,LOW:HIGH`; a side that is left out lies at infinity.
///
/// # Errors
/// A description of the format if the text has another one, or a range is empty.
pub fn parse(text: &str) -> Result<Bounds, &'static str> {
    let mut region = EVERYWHERE;
    let mut ranges = text.split(',');
    for i in 0..3 {
        let (low, high) = ranges.next().and_then(|range| range.split_once(':')).ok_or(FORMAT)?;
        for (side, text) in [(&mut region.min[i], low.trim()), (&mut region.max[i], high.trim())] {
            if !text.is_empty() {
                *side = text.parse().map_err(|_| FORMAT)?;
            }
        }
    }
    let is_box = (0..3).all(|i| region.min[i] <= region.max[i]);
    if ranges.next().is_none() && is_box { Ok(region) } else { Err(FORMAT) }
}

/// The format of a box, for a text that is none.
const FORMAT: &str = "a box is three ranges LOW:HIGH in metres with LOW ≤ HIGH, separated by commas, where either side of a \
                      range may be left out, such as `:,:0.05,:`";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_may_be_open_and_nonsense_is_refused() {
        let open = f64::INFINITY;
        assert_eq!(
            parse(":, -1:0.05,.25:"),
            Ok(Bounds { min: [-open, -1.0, 0.25], max: [open, 0.05, open] })
        );
        for text in ["", "1,2,3", ":,:", ":,:,:,:", "1:0,:,:", "nan:,:,:", "a:b,:,:"] {
            assert_eq!(parse(text), Err(FORMAT), "{text}");
        }
    }

    #[test]
    fn shares_become_coordinates() {
        // Flat along z, where only the open sides make sense.
        let whole = Bounds { min: [0.0, 1.0, 2.0], max: [4.0, 3.0, 2.0] };
        let feet =
            Bounds { min: [0.5, f64::NEG_INFINITY, f64::NEG_INFINITY], max: [1.0, 0.25, f64::INFINITY] };
        let expected =
            Bounds { min: [2.0, f64::NEG_INFINITY, f64::NEG_INFINITY], max: [4.0, 1.5, f64::INFINITY] };
        assert_eq!(within(whole, feet), expected);
        for k in 0..1000 {
            let whole = Bounds { min: [0.1 * f64::from(k); 3], max: [0.1 * f64::from(k) + 0.0123; 3] };
            assert_eq!(within(whole, Bounds { min: [1.0; 3], max: [1.0; 3] }).min, whole.max);
        }
    }
}
