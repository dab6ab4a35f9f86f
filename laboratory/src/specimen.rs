//! Derivatives of a specimen along the axes of a test. A material requires stretches in falling order, so
//! they are sorted and sorted back.

use piola::material::{Moduli, Response as Specimen};

/// Three numbers along the axes of a test, and the order that a material requires.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ordered {
    /// Values from the greatest to the least.
    pub(crate) numbers: [f64; 3],
    /// The axis that each of them belongs to.
    axes: [usize; 3],
}

impl Ordered {
    pub(crate) fn new(along_axes: [f64; 3]) -> Self {
        let mut axes = [0, 1, 2];
        axes.sort_by(|&i, &j| along_axes[j].total_cmp(&along_axes[i]));
        Self { numbers: axes.map(|axis| along_axes[axis]), axes }
    }

    /// Values that belong to the ordered numbers, along the axes of the test.
    pub(crate) fn back<T: Copy + Default>(&self, ordered: [T; 3]) -> [T; 3] {
        let mut along_axes = [T::default(); 3];
        for (axis, number) in self.axes.into_iter().zip(ordered) {
            along_axes[axis] = number;
        }
        along_axes
    }
}

/// The stretches 1 + si.
pub(crate) fn stretches(strains: [f64; 3]) -> [f64; 3] {
    strains.map(|strain| 1.0 + strain)
}

/// ψ1, ψ2, ψ3 along the axes of a test, Pa; `None` outside the domain and if they are NaN.
pub(crate) fn gradient(specimen: &dyn Specimen<f64>, strains: [f64; 3]) -> Option<[f64; 3]> {
    let ordered = Ordered::new(strains);
    if !strains.iter().all(|strain| strain.is_finite()) || !specimen.admits(stretches(ordered.numbers)) {
        return None;
    }
    let gradient = specimen.gradient_at_strains(ordered.numbers);
    gradient.iter().all(|stress| stress.is_finite()).then(|| ordered.back(gradient))
}

/// ψij along the axes of a test, 3×3, Pa.
pub(crate) fn hessian(specimen: &dyn Specimen<f64>, strains: [f64; 3]) -> [[f64; 3]; 3] {
    let ordered = Ordered::new(strains);
    let [h11, h22, h33, h12, h13, h23] = specimen.blocks(stretches(ordered.numbers)).hessian;
    let rows = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]];
    ordered.back(rows.map(|row| ordered.back(row)))
}

/// μ = (ψ11 − ψ12)/2 and λ = ψ12 at F = I.
pub(crate) fn moduli(specimen: &dyn Specimen<f64>) -> Moduli {
    let [h11, _, _, h12, ..] = specimen.blocks([1.0; 3]).hessian;
    Moduli { mu: 0.5 * (h11 - h12), lambda: h12 }
}
