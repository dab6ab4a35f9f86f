//! Assembly into a sparse matrix of the caller: compressed rows given as slices of any kind of integer.

use std::fmt;

use super::{Layout, LengthError, Tetrahedra};
use crate::lanes::Scalar;

/// Mark of an entry of an element that the matrix does not store because it stores the one across the
/// diagonal.
const ACROSS: u32 = u32::MAX;

/// Mark of a node that has no unknowns.
const NONE: u32 = u32::MAX - 1;

/// Places of the stiffnesses of tetrahedra in a sparse matrix of the caller, found once.
///
/// The matrix may be whole, or one of its triangles. Unknowns may have any numbers, and nodes may have none,
/// such as pinned ones. Takes 576 bytes for each tetrahedron. The [front page](crate#tetrahedra) of the crate
/// has a program.
#[derive(Clone, Debug)]
pub struct CsrPlaces {
    places: Vec<[u32; 144]>,
    entries: usize,
}

impl CsrPlaces {
    /// Finds the places in a matrix whose row r holds the columns
    /// `columns[row_starts[r]..row_starts[r + 1]]`, in any order.
    ///
    /// `unknowns` gives the first of the three successive unknowns of a node, or `None` for a node that has
    /// none.
    ///
    /// # Errors
    /// [`CsrError`] for slices that are not a matrix, an unknown without a row, an entry that neither the
    /// matrix nor its transpose holds, too little memory, or more than four thousand million entries.
    pub fn new<I: Copy + TryInto<usize>>(
        tetrahedra: Tetrahedra<'_>,
        unknowns: impl Fn(usize) -> Option<usize>,
        row_starts: &[I],
        columns: &[I],
    ) -> Result<Self, CsrError> {
        let not_a_row = |row: usize| {
            CsrError(format!(
                "row {row} (from 0) is not one of compressed rows: its start must not be beyond its end, nor its end beyond \
                 the columns"
            ))
        };
        let too_large = || CsrError("the places of the stiffnesses do not fit into memory".to_owned());
        let rows = row_starts.len().checked_sub(1).ok_or_else(|| not_a_row(0))?;
        let start = |row: usize| row_starts[row].try_into().ok();
        for row in 0..rows {
            let is_row = |(start, end): (usize, usize)| start <= end && end <= columns.len();
            if !start(row).zip(start(row + 1)).is_some_and(is_row) {
                return Err(not_a_row(row));
            }
        }
        if columns.len() >= NONE as usize {
            return Err(too_large());
        }
        let find = |row: usize, column: usize| {
            let (start, end) = (start(row)?, start(row + 1)?);
            let at = columns[start..end].iter().position(|&other| other.try_into().ok() == Some(column))?;
            Some((start + at) as u32)
        };
        let mut places = Vec::new();
        places.try_reserve_exact(tetrahedra.corners.len()).map_err(|_| too_large())?;
        for corners in tetrahedra.corners {
            let unknown_of = corners.map(&unknowns);
            let mut of_element = [NONE; 144];
            for (k, place) in of_element.iter_mut().enumerate() {
                let (row, column) = (k / 12, k % 12);
                let of = |at: usize| unknown_of[at / 3].map(|unknown| unknown.saturating_add(at % 3));
                let Some((row, column)) = of(row).zip(of(column)) else { continue };
                if row.max(column) >= rows {
                    return Err(CsrError(format!(
                        "there is no row {}: the {rows} rows of the matrix are numbered from 0",
                        row.max(column)
                    )));
                }
                *place = match find(row, column) {
                    Some(place) => place,
                    None if find(column, row).is_some() => ACROSS,
                    None => {
                        return Err(CsrError(format!(
                            "the matrix has no entry in row {row} and column {column} (from 0), nor across the diagonal, though a \
                             tetrahedron joins these unknowns"
                        )));
                    }
                };
            }
            places.push(of_element);
        }
        Ok(Self { places, entries: columns.len() })
    }

    /// Adds the stiffnesses of all tetrahedra, 144 entries each in the layout of
    /// [`Batch::stiffnesses`](super::Batch::stiffnesses), to the values of the matrix, in the order of
    /// the tetrahedra.
    ///
    /// # Errors
    /// [`LengthError`] if there are not as many stiffnesses as tetrahedra, or values as entries. The values
    /// are then as they were.
    pub fn add<E: Scalar>(
        &self,
        stiffnesses: &[E],
        layout: Layout,
        values: &mut [E],
    ) -> Result<(), LengthError> {
        let group = layout.group::<E>();
        let points = self.places.len().next_multiple_of(group);
        LengthError::check("stiffnesses", stiffnesses.len(), 144, points, group)?;
        LengthError::check("values", values.len(), 1, self.entries, 1)?;
        for (element, places) in self.places.iter().enumerate() {
            for (k, &place) in places.iter().enumerate() {
                if place < NONE {
                    let value = &mut values[place as usize];
                    *value = *value + stiffnesses[layout.index::<E>(element, 144, k)];
                }
            }
        }
        Ok(())
    }
}

/// Reason why the stiffnesses of tetrahedra do not fit into a matrix, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CsrError(String);

impl fmt::Display for CsrError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for CsrError {}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[usize; 4]; 2] = [[0, 1, 2, 3], [4, 3, 2, 1]];

    /// Compressed rows of a matrix of 12 unknowns whose entries `has` keeps, columns descending.
    fn compressed(has: impl Fn(usize, usize) -> bool) -> (Vec<u32>, Vec<u32>) {
        let (mut starts, mut columns) = (vec![0], Vec::new());
        for row in 0..12 {
            columns.extend((0..12).rev().filter(|&column| has(row, column)).map(|column| column as u32));
            starts.push(columns.len() as u32);
        }
        (starts, columns)
    }

    /// Node 2 is pinned; the others are numbered from the last.
    fn unknowns(node: usize) -> Option<usize> {
        [Some(9), Some(6), None, Some(3), Some(0)][node]
    }

    #[test]
    fn whole_matrices_and_triangles_hold_the_sum() {
        let tetrahedra = Tetrahedra::new(5, &CORNERS).expect("nodes that exist");
        // Entries of symmetric stiffnesses.
        let entry = |element: usize, r: usize, c: usize| ((100 * element + r * c + 7 * (r + c)) as f64).sin();
        let mut dense = [[0.0; 12]; 12];
        for (element, corners) in CORNERS.iter().enumerate() {
            for r in 0..12 {
                for c in 0..12 {
                    if let (Some(i), Some(j)) = (unknowns(corners[r / 3]), unknowns(corners[c / 3])) {
                        dense[i + r % 3][j + c % 3] += entry(element, r, c);
                    }
                }
            }
        }
        // Nodes 0 and 4 share no tetrahedron.
        let is_joined = |r: usize, c: usize| !matches!((r / 3, c / 3), (0, 3) | (3, 0));
        for keep in [|_: usize, _: usize| true, |r, c| r >= c, |r, c| r <= c] {
            let (starts, columns) = compressed(|r, c| is_joined(r, c) && keep(r, c));
            let places = CsrPlaces::new(tetrahedra, unknowns, &starts, &columns).expect("all entries");
            for layout in [Layout::Points, Layout::Lines] {
                let count = if layout == Layout::Points { 2 } else { f64::LINE };
                let mut stiffnesses = vec![f64::NAN; 144 * count];
                for (element, k) in (0..2).flat_map(|element| (0..144).map(move |k| (element, k))) {
                    stiffnesses[layout.index::<f64>(element, 144, k)] = entry(element, k / 12, k % 12);
                }
                let mut values = vec![1.0; columns.len()];
                places.add(&stiffnesses, layout, &mut values).expect("lengths fit");
                for row in 0..12 {
                    for at in starts[row] as usize..starts[row + 1] as usize {
                        let expected = 1.0 + dense[row][columns[at] as usize];
                        // The same three terms in another order.
                        assert!((values[at] - expected).abs() <= 8.0 * f64::EPSILON);
                    }
                }
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_an_error() {
        let tetrahedra = Tetrahedra::new(5, &CORNERS).expect("nodes that exist");
        for (starts, columns, expected) in [
            (&[0_i64; 0][..], &[0_i64; 0][..], "row 0 (from 0) is not one"),
            (&[0, 2], &[0], "row 0 (from 0) is not one"),
            (&[0, 1, 0], &[0], "row 1 (from 0) is not one"),
            (&[-1, 1], &[0], "row 0 (from 0) is not one"),
            (&[0, 1], &[0], "there is no row 9: the 1 rows"),
        ] {
            let error = CsrPlaces::new(tetrahedra, unknowns, starts, columns).expect_err(expected);
            assert!(error.to_string().starts_with(expected), "{error}");
        }
        let (starts, columns) = compressed(|r, c| (r, c) != (9, 6) && (r, c) != (6, 9));
        let missing =
            CsrPlaces::new(tetrahedra, unknowns, &starts, &columns).expect_err("an entry is missing");
        assert!(missing.to_string().contains("row 9 and column 6"), "{missing}");

        let (starts, columns) = compressed(|_, _| true);
        let places = CsrPlaces::new(tetrahedra, unknowns, &starts, &columns).expect("all entries");
        let mut values = vec![0.0; columns.len()];
        let error = places.add(&[0.0; 144], Layout::Points, &mut values).expect_err("one of two");
        assert_eq!((error.slice, error.found, error.points), ("stiffnesses", 144, 2));
        let error = places.add(&[0.0; 288], Layout::Points, &mut values[1..]).expect_err("one too few");
        assert_eq!((error.slice, error.found, error.points), ("values", 143, 144));
    }
}
