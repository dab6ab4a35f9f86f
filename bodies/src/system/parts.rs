//! Loops over the parts of a slice on the threads of rayon's pool.
//!
//! rayon's code is compiled once for each type of entry, not once for each loop: what a loop does stands
//! behind a pointer.

/// Calls `change` for parts of 1 to `length` entries, with the index of the first entry of the part.
pub(crate) fn for_each_part<T: Send>(
    entries: &mut [T],
    length: usize,
    change: impl Fn(usize, &mut [T]) + Sync,
) {
    if !entries.is_empty() {
        halve(0, entries, length, &change);
    }
}

/// Calls `change` for each entry, with its index; a thread takes up to `length` entries at a time.
pub(crate) fn for_each_entry<T: Send>(
    entries: &mut [T],
    length: usize,
    change: impl Fn(usize, &mut T) + Sync,
) {
    for_each_part(entries, length, |first, part| {
        part.iter_mut().zip(first..).for_each(|(entry, index)| change(index, entry));
    });
}

fn halve<T: Send>(first: usize, entries: &mut [T], length: usize, change: &(dyn Fn(usize, &mut [T]) + Sync)) {
    if entries.len() <= length {
        return change(first, entries);
    }
    let middle = (entries.len() / 2).next_multiple_of(length);
    let (one, other) = entries.split_at_mut(middle);
    rayon::join(|| halve(first, one, length, change), || halve(first + middle, other, length, change));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_is_in_one_part() {
        for count in [0, 1, 7, 8, 9, 15, 16, 17, 100] {
            let mut entries = vec![0; count];
            for_each_part(&mut entries, 8, |first, part| {
                assert!((1..=8).contains(&part.len()) && first % 8 == 0);
            });
            for_each_entry(&mut entries, 8, |index, entry| *entry += index + 1);
            assert_eq!(entries, (1..=count).collect::<Vec<_>>());
        }
    }
}
