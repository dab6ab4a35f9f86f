//! Meshes, their embeddings, and files of them.

use piola_bodies::mesh::{
    Bounds, ReadError, Surface, embed, parse_msh, parse_surface_obj, read_msh, read_surface_obj, read_tetgen,
    tetrahedral_box,
};
use piola_bodies::system::Pins;

use crate::arguments::check;

#[test]
fn meshes_and_embeddings() {
    check(|hostile| {
        let mesh = hostile.mesh();
        let _ = mesh.rest_shapes();
        let _ = (mesh.connected_components(), mesh.bounds(), mesh.tag(usize::MAX));
        let _ = mesh.clone().without_unused_nodes().turn_tets();
        let _ = Pins::in_box(&mesh, Bounds { min: hostile.point(), max: hostile.point() });
        let _ = Pins::of_group(&mesh, hostile.one_of(&["half", "", "\u{1b}"]));
        let good = [[0.5, 0.5, 0.5], [1.0, 0.0, 0.0], [2.01, 0.5, 0.5]];
        let surface = Surface { positions: hostile.points(&good), triangles: vec![[usize::MAX; 3]] };
        let tolerance = hostile.about(0.1);
        if let Ok(anchors) = embed(&mesh, &surface, tolerance) {
            let mut weights = anchors.iter().flat_map(|anchor| anchor.weights);
            assert!(tolerance > 1e50 || weights.all(f64::is_finite), "{tolerance:e}");
        }
        let cells = [(); 3].map(|()| hostile.one_of(&[0, 1, 2, 3, 1 << 46, usize::MAX]));
        let _ = tetrahedral_box(cells, hostile.point());
    });
}

/// Mutations of good files are the subject of `tests/hostile/`.
#[test]
fn files() {
    for text in [
        "",
        "$MeshFormat",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Elements\n18446744073709551615\n",
        "f 1 2 -9",
    ] {
        assert!(parse_msh(text, "some.msh").or_else(ReadError::only_tetrahedra).is_err());
        assert!(parse_surface_obj(text, "some.obj").is_err());
    }
    for path in ["", "/", "no/such/file", "\0"] {
        assert!(read_msh(path).is_err() && read_tetgen(path).is_err() && read_surface_obj(path).is_err());
    }
}
