//! Gradients and stiffnesses of linear tetrahedra, computed by one invocation each.
//!
//! Numbers of elements lie in lines: component k of the 64 elements of a workgroup, then component k + 1. So
//! neighbours read and write side by side. The program is in `tetrahedra.wgsl`.

use std::time::Duration;

use wgpu::{BindGroup, Buffer, ComputePipeline};

use crate::Error;
use crate::device::Device;
use crate::mesh::Mesh;

/// Elements of a line, and invocations of a workgroup, as in the program.
const LINE: usize = 64;

/// Components of an element's results, as in the program: the gradient, then the stiffness.
pub const COMPONENTS: usize = 12 + 144;

/// Elements on a device.
#[derive(Debug)]
pub struct Elements<'a> {
    device: &'a Device,
    count: usize,
    program: ComputePipeline,
    chunks: Vec<Chunk>,
}

/// Elements that share buffers, as many as a binding may hold.
#[derive(Debug)]
struct Chunk {
    lines: u32,
    bindings: BindGroup,
    results: Buffer,
    statuses: Buffer,
}

impl<'a> Elements<'a> {
    /// The elements of a mesh, with the text of an energy, whose parameters are those of its example, and the
    /// function that is called: `tetrahedron` or `projected_tetrahedron`.
    ///
    /// # Errors
    /// The device does not compile the text, or the nodes are too many for it.
    pub fn new(device: &'a Device, (energy, function): (&str, &str), mesh: &Mesh) -> Result<Self, Error> {
        let limits = &device.limits;
        let largest = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if size_of_val(&mesh.positions[..]) as u64 > largest {
            return Err(format!("{} nodes are too many for {}", mesh.positions.len(), device.name).into());
        }
        let calls =
            include_str!("tetrahedra.wgsl").replace("energy_tetrahedron", &format!("energy_{function}"));
        let program = device.programs(&[energy, &calls].join("\n"), &["elements"])?.remove(0);
        let positions = device.filled(&mesh.positions);
        let lines = largest / (4 * COMPONENTS * LINE) as u64;
        let lines = lines.min(limits.max_compute_workgroups_per_dimension.into()) as usize;
        let parts = mesh.corners.chunks(lines * LINE).zip(mesh.rest.chunks(lines * LINE));
        let chunks = parts.map(|(corners, rest)| {
            // The last line is filled up with its last element.
            let lines = corners.len().div_ceil(LINE);
            let at = |k: usize| k.min(corners.len() - 1);
            let corners: Vec<_> = (0..lines * LINE).map(|k| corners[at(k)]).collect();
            let rest: Vec<f32> = (0..lines * LINE * 10)
                .map(|k| rest[at(k / (10 * LINE) * LINE + k % LINE)][k / LINE % 10])
                .collect();
            let [results, statuses] =
                [COMPONENTS, 1].map(|components| device.empty((4 * components * LINE * lines) as u64));
            let (corners, rest) = (device.filled(&corners), device.filled(&rest));
            let bindings = device.bind(&program, &[&positions, &corners, &rest, &results, &statuses]);
            Chunk { lines: lines as u32, bindings, results, statuses }
        });
        let chunks = chunks.collect();
        Ok(Self { device, count: mesh.corners.len(), program, chunks })
    }

    /// Computes all elements.
    ///
    /// # Errors
    /// The device is lost.
    pub fn compute(&self) -> Result<Duration, Error> {
        self.device.run(self.chunks.iter().map(|chunk| (&self.program, &chunk.bindings, chunk.lines)))
    }

    /// The status of each element.
    ///
    /// # Errors
    /// The device is lost.
    pub fn statuses(&self) -> Result<Vec<u32>, Error> {
        let mut all = Vec::new();
        for chunk in &self.chunks {
            all.extend(self.device.read::<u32>(&chunk.statuses)?);
        }
        all.truncate(self.count);
        Ok(all)
    }

    /// Gradient and stiffness of each element.
    ///
    /// # Errors
    /// The device is lost, or has no memory.
    pub fn results(&self) -> Result<Vec<[f32; COMPONENTS]>, Error> {
        let mut all = Vec::new();
        for chunk in &self.chunks {
            let lines = self.device.read::<f32>(&chunk.results)?;
            let component = |at: usize, k: usize| lines[(at / LINE * COMPONENTS + k) * LINE + at % LINE];
            all.extend((0..lines.len() / COMPONENTS).map(|at| std::array::from_fn(|k| component(at, k))));
        }
        all.truncate(self.count);
        Ok(all)
    }
}
