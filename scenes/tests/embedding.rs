//! The committed meshes carry their surfaces: positions at rest come back, all of them from inside or near
//! the mesh.

use piola_bodies::mesh::{embed, read_msh, read_surface_obj};

#[test]
fn the_meshes_of_the_scenes_carry_their_surfaces() {
    for name in ["dinosaur", "horse"] {
        let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/");
        let mesh = read_msh(format!("{assets}{name}.msh")).expect("a committed mesh");
        let surface = read_surface_obj(format!("{assets}{name}.obj")).expect("a committed surface");
        let anchors = embed(&mesh, &surface, 0.1).expect("inside the mesh or near it");
        assert_eq!(anchors.len(), surface.positions.len());
        for (vertex, (x, anchor)) in surface.positions.iter().zip(anchors).enumerate() {
            let y = anchor.position(&mesh.positions);
            let norm = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
            let error = norm(std::array::from_fn(|c| x[c] - y[c]));
            // Barycentric coordinates err by the condition of a tetrahedron, far below 100 here.
            assert!(error <= 100.0 * f64::EPSILON * norm(*x).max(1.0), "vertex {vertex} of {name}");
        }
    }
}
