//! Block-Jacobi preconditioning: the inverses of the 3×3 blocks on the diagonal of a matrix.

use crate::system::parts::for_each_entry;

/// Number of blocks that a thread takes at a time.
const BLOCKS: usize = 1024;

/// Factors of a block, L D Lᵀ with D > 0: 1/D on the diagonal, L below it. Positive definite for any rounding
/// errors in the block.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Factor([[f64; 3]; 3]);

impl Factor {
    /// Factors a symmetric block, given by its lower triangle. If the block is not positive definite, the
    /// unit matrix times its norm is factored instead.
    fn new(block: &[[f64; 3]; 3]) -> Self {
        let [[a00, ..], [a10, a11, _], [a20, a21, a22]] = *block;
        let (l10, l20) = (a10 / a00, a20 / a00);
        let d1 = a11 - l10 * a10;
        let l21 = (a21 - l20 * a10) / d1;
        let d2 = a22 - l20 * a20 - l21 * (a21 - l20 * a10);
        if a00 > 0.0 && d1 > 0.0 && d2 > 0.0 {
            return Self([[1.0 / a00, 0.0, 0.0], [l10, 1.0 / d1, 0.0], [l20, l21, 1.0 / d2]]);
        }
        let norm = block.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt();
        let inverse = if norm > 0.0 { 1.0 / norm } else { 1.0 };
        Self([[inverse, 0.0, 0.0], [0.0, inverse, 0.0], [0.0, 0.0, inverse]])
    }

    /// Product of the inverse of the block with a vector.
    fn solve(&self, [r0, r1, r2]: [f64; 3]) -> [f64; 3] {
        let [[d0, ..], [l10, d1, _], [l20, l21, d2]] = self.0;
        let y1 = r1 - l10 * r0;
        let y2 = r2 - l20 * r0 - l21 * y1;
        let z2 = d2 * y2;
        let z1 = d1 * y1 - l21 * z2;
        [d0 * r0 - l10 * z1 - l20 * z2, z1, z2]
    }
}

/// Factored blocks on the diagonal of a matrix.
#[derive(Clone)]
pub(crate) struct BlockJacobi {
    factors: Vec<Factor>,
}

impl BlockJacobi {
    /// Preconditioner of the unit matrix.
    pub(crate) fn new(blocks: usize) -> Self {
        Self { factors: vec![Factor::new(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]); blocks] }
    }

    pub(crate) fn len(&self) -> usize {
        self.factors.len()
    }

    /// Factors the block of each row.
    pub(crate) fn factor<'a>(&mut self, block: impl Fn(usize) -> &'a [[f64; 3]; 3] + Sync) {
        for_each_entry(&mut self.factors, BLOCKS, |row, factor| *factor = Factor::new(block(row)));
    }

    /// Computes z: the inverse of each block times its part of r.
    pub(crate) fn solve(&self, r: &[[f64; 3]], z: &mut [[f64; 3]]) {
        let blocks = z.len().min(r.len()).min(self.factors.len());
        for_each_entry(&mut z[..blocks], BLOCKS, |row, z| *z = self.factors[row].solve(r[row]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_times_the_solution_is_the_right_side() {
        let block = [[4.0, 1.0, -2.0], [1.0, 5.0, 0.5], [-2.0, 0.5, 3.0]];
        let mut jacobi = BlockJacobi::new(2);
        let r = [[1.0, -2.0, 3.0], [0.5, 0.0, -1.0]];
        let mut z = [[0.0; 3]; 2];
        jacobi.solve(&r, &mut z);
        assert_eq!(z, r);
        jacobi.factor(|_| &block);
        jacobi.solve(&r, &mut z);
        for (r, z) in r.iter().zip(z) {
            for i in 0..3 {
                let product: f64 = (0..3).map(|j| block[i][j] * z[j]).sum();
                // A dozen operations with a matrix of condition 10.
                assert!((product - r[i]).abs() <= 100.0 * f64::EPSILON, "{product} for {}", r[i]);
            }
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_replaced_by_its_norm() {
        let unit = |s: f64| Factor([[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]]);
        assert_eq!(Factor::new(&[[3.0, 0.0, 0.0], [0.0, -4.0, 0.0], [0.0; 3]]), unit(0.2));
        assert_eq!(Factor::new(&[[0.0; 3]; 3]), unit(1.0));
    }
}
