//! Meshes, their embeddings, and files of them.

use piola_bodies::mesh::{
    Bounds, Embedding, ReadError, Surface, parse_msh, parse_surface_obj, read_msh, read_surface_obj,
    read_tetgen, tetrahedral_box,
};
use piola_bodies::system::Pins;

use crate::arguments::check;

#[test]
fn meshes_and_embeddings() {
    check(|hostile| {
        let mesh = hostile.mesh();
        let _ = mesh.rest_shapes();
        let _ = (mesh.connected_components(), mesh.unused_nodes(), mesh.bounds(), mesh.tag(usize::MAX));
        let _ = mesh.clone().without_unused_nodes();
        let _ = Pins::in_box(&mesh, Bounds { min: hostile.point(), max: hostile.point() });
        let _ = Pins::of_group(&mesh, hostile.one_of(&["half", "", "\u{1b}"]));
        let good = [[0.5, 0.5, 0.5], [1.0, 0.0, 0.0], [2.01, 0.5, 0.5]];
        let surface = Surface { positions: hostile.points(&good), triangles: vec![[usize::MAX; 3]] };
        let tolerance = hostile.about(0.1);
        if let Ok(embedding) = Embedding::new(&mesh, &surface, tolerance) {
            let weights = embedding.anchors().iter().flat_map(|anchor| anchor.weights);
            assert!(tolerance > 1e50 || weights.into_iter().all(f64::is_finite), "{tolerance:e}");
        }
        let cells = [(); 3].map(|()| hostile.one_of(&[0, 1, 2, 3, 1 << 46, usize::MAX]));
        let _ = tetrahedral_box(cells, hostile.point());
    });
}

#[test]
fn files() {
    let msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n\
               $Elements\n2\n1 4 2 1 1 1 2 3 4\n2 7 2 1 1 1 2 3 4 1\n$EndElements\n";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let node = "4 3 1 1\n1 0 0 0 7 -1 # a node\n2 1 0 0 7 0\n3 0 1 0 7 0\n4 0 0 1e3 7 0\n";
    let ele = "1 4 1\n1 1 2 3 4 5\n";
    let file = std::env::temp_dir().join(format!("piola-hostile-{}", std::process::id()));
    let files = ["node", "ele"].map(|extension| file.with_extension(extension));
    check(|hostile| {
        for text in [msh, obj, node, ele] {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..hostile.0.below(4) {
                let at = hostile.0.below(bytes.len());
                let words: [&[u8]; 6] = [b"\xff\xfe", b"-", b"18446744073709551616", b"1e999", b"\n", b"\0"];
                let word = hostile.one_of(&words);
                bytes.splice(at..(at + hostile.0.below(3)).min(bytes.len()), word.iter().copied());
            }
            let text = String::from_utf8_lossy(&bytes);
            let mesh = parse_msh(&text, "some.msh").or_else(ReadError::only_tetrahedra);
            let _ = mesh.map(|mesh| mesh.rest_shapes());
            let _ = parse_surface_obj(&text, "some.obj");
            for (file, good) in files.iter().zip([node, ele]) {
                let text = if hostile.0.once_in(2) { good } else { &text };
                std::fs::write(file, text).expect("a scratch file");
            }
            let _ = read_tetgen(&file).map(|mesh| mesh.rest_shapes());
        }
    });
    files.iter().for_each(|file| std::fs::remove_file(file).expect("a scratch file"));
    for path in ["", "/", "no/such/file", "\0"] {
        assert!(read_msh(path).is_err() && read_tetgen(path).is_err() && read_surface_obj(path).is_err());
    }
}
