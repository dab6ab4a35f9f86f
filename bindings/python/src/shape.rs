//! Shapes of arrays, and numpy's rules of broadcasting.

/// The shape that two arrays have together; `None` if they cannot be broadcast.
pub(crate) fn common(one: &[usize], other: &[usize]) -> Option<Vec<usize>> {
    let (longer, shorter) = if one.len() < other.len() { (other, one) } else { (one, other) };
    let mut shape = longer.to_vec();
    for (length, &here) in shape[longer.len() - shorter.len()..].iter_mut().zip(shorter) {
        match (*length, here) {
            (_, 1) => {}
            (1, _) => *length = here,
            (length, here) if length == here => {}
            _ => return None,
        }
    }
    Some(shape)
}

/// The entry of an array that is at each point of a shape to which the array is broadcast.
pub(crate) fn entries(array: &[usize], points: &[usize]) -> Vec<usize> {
    let added = points.len() - array.len();
    let mut entries = vec![0];
    for (axis, &count) in points.iter().enumerate() {
        let length = axis.checked_sub(added).map_or(1, |axis| array[axis]);
        let along =
            move |entry: usize| (0..count).map(move |k| length * entry + if length == 1 { 0 } else { k });
        entries = entries.into_iter().flat_map(along).collect();
    }
    entries
}

/// The index, along each axis, of a point that is counted in the order of C.
pub(crate) fn index(point: usize, points: &[usize]) -> Vec<usize> {
    let behind = |axis: usize| points[axis + 1..].iter().product::<usize>();
    (0..points.len()).map(|axis| point / behind(axis) % points[axis]).collect()
}

/// A shape, or an index, as Python writes it.
pub(crate) fn text(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => format!("({})", shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
}
