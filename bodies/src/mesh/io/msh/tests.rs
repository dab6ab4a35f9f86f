//! Files of both versions, good and malformed.

use super::*;

/// Two tetrahedra with odd node tags, a triangle on a named surface, a stray node, an unknown section.
const GOOD: &str = include_str!("tests/good.msh");

/// The same in the older format; the second tetrahedron, of two groups, stands there twice.
const OLDER: &str = include_str!("tests/older.msh");

#[test]
fn both_formats_say_the_same() {
    assert_eq!(parse(OLDER), parse(GOOD));
    // Without groups, and without tags at all.
    let bare = parse(&OLDER.replace("11 4 2 9 1 40", "11 4 0 40")).expect("no tags");
    assert_eq!((bare.groups[1].tets.as_slice(), bare.tets.len()), (&[1][..], 2));
    let reversed = parse(&OLDER.replace("3 20 10 30", "3 10 20 30")).expect("a reversed tetrahedron");
    assert_eq!(reversed, TetMesh { turned_tets: 1, ..parse(GOOD).expect("a good file") });
}

#[test]
fn nodes_elements_and_groups_arrive() {
    let mesh = parse(GOOD).expect("a good file");
    assert_eq!((mesh.positions.len(), mesh.dropped_nodes), (5, 1), "the stray node is dropped");
    assert_eq!(mesh.bounds().max, [1.0; 3], "and is not in the bounds");
    assert_eq!(mesh.positions[4], [1.0, 1.0, 1.0]);
    assert_eq!(mesh.tets, [[0, 1, 2, 3], [1, 2, 3, 4]]);
    assert_eq!(mesh.tags, [11, 12]);
    assert_eq!(
        mesh.groups,
        [
            Group::of("left side", 2, &[0, 1, 2], &[]),
            Group::of("flesh", 3, &[0, 1, 2, 3, 4], &[0, 1]),
            Group::of("11", 3, &[1, 2, 3, 4], &[1]),
        ]
    );
    assert!(mesh.rest_shapes().is_ok());
}

/// Replaces a piece of the good file and expects a complaint.
#[track_caller]
fn check(piece: &str, replacement: &str, line: usize, problem: &str) {
    check_in(GOOD, piece, replacement, line, problem);
}

#[track_caller]
fn check_in(good: &str, piece: &str, replacement: &str, line: usize, problem: &str) {
    assert!(good.contains(piece));
    let text = good.replacen(piece, replacement, 1);
    assert_eq!(parse(&text), Err(Problem { line, text: problem.to_owned() }));
}

#[test]
fn problems_name_the_line() {
    check(
        "4.1 0 8",
        "4.1 1 8",
        2,
        "the file is binary, only ASCII is read; `gmsh OLD.msh -save -format msh41 -o NEW.msh` of Gmsh 4.1 or \
         later converts it",
    );
    let other =
        format!("expected `$MeshFormat`, found `mesh`; is this a Gmsh file? If meshio reads it, {BY_MESHIO}");
    check("$MeshFormat\n", "mesh\n", 1, &other);
    check("\"flesh\"", "flesh", 7, "expected the name of the group in double quotes");
    check("0 1 0\n", "0 one 0\n", 32, "expected the y coordinate, found `one`");
    check("0 1 0\n", "0 NaN 0\n", 32, "the y coordinate is NaN; it must be finite");
    check("\n10\n", "\n40\n", 28, "node 40 is given twice");
    check("11 40 3 20 10", "11 40 3 20 99", 41, "the element names node 99, which does not exist");
    check("11 40 3 20 10", "11 40 3 20", 41, "the tag of a node is missing");
    check("12 3 20 10 30\n", "", 43, "expected the tag of the element, found `$EndElements`");
    check("$EndElements\n", "", 44, "the file ends where the end of the section is expected");
    check("$EndNodes", "$EndNode", 35, "expected `$EndNodes`, found `$EndNode`");
    check("$Comments", "stray", 16, "expected the start of a section, found `stray`");
    check(
        "$Comments",
        "$PartitionedEntities",
        16,
        "the mesh is partitioned, only whole ones are read; in Gmsh, `Mesh > Unpartition` joins the parts",
    );
    check("11 40 3 20 10", "11 40 3 20 10 30", 41, "the tetrahedron has more than four nodes");
    check(
        "3 1 4 1\n11 40 3 20 10\n3 2 4 1\n12 3 20 10 30",
        "3 1 15 1\n11 40\n3 2 15 1\n12 3",
        45,
        "the file ends without volume elements; in Gmsh, mesh with `-3`, and if there are physical groups add \
         one of the volume",
    );
}

#[test]
fn problems_of_the_older_format_name_the_line() {
    check_in(OLDER, "\n10 0 0 1", "\n40 0 0 1", 15, "node 40 is given twice");
    check_in(OLDER, "\n10 0 0 1", "\n10 0 0", 15, "the z coordinate is missing");
    check_in(OLDER, "40 3 20 10", "40 3 20 99", 21, "the element names node 99, which does not exist");
    check_in(OLDER, "\n5\n1 2", "\n6\n1 2", 25, "expected the tag of the element, found `$EndElements`");
}

/// The words for a version, in the first section or without any.
#[test]
fn other_versions_are_named() {
    for version in ["4", "4.0", "1", "2", "2.0", "2.1", "3", "5.0"] {
        let text = format!("the format is MSH `{version}`, only 4.1 and 2.2 are read; {CONVERTED}");
        let found = parse(&GOOD.replace("4.1 0", &format!("{version} 0")));
        assert_eq!(found, Err(Problem { line: 2, text }));
    }
    for section in ["$NOD", "$NOE", "$ELM"] {
        let expected = format!("`{section}` is of MSH 1, only 4.1 and 2.2 are read; {CONVERTED}");
        for text in [format!("{section}\n4\n"), GOOD.replace("$Comments", section)] {
            assert_eq!(parse(&text).expect_err(section).text, expected);
        }
    }
}

/// Parametric nodes have their coordinates first, in both formats.
#[test]
fn parametric_nodes_are_read() {
    let older = OLDER.replace("Nodes", "ParametricNodes").replace("8 8 8", "8 8 8 0 5");
    let older = older.replace("\n3 1 0 0\n", "\n3 1 0 0 2 1 0.25 0.75\n");
    assert_eq!(parse(&older), parse(OLDER));
    let newer = GOOD.replace("3 1 0 5", "3 1 1 5").replace("0 0 0\n1 0 0\n", "0 0 0 9 9 9\n1 0 0 9 9 9\n");
    assert_eq!(parse(&newer), parse(GOOD));
}

/// A section that could hold nodes or elements is not passed over; comments, fields on nodes and
/// relations between them are.
#[test]
fn sections_with_nodes_or_elements_are_not_passed_over() {
    for section in ["$ParametricNodes", "$nodes", "$HexElements", "$NodeBlocks"] {
        let text = GOOD.replace("Comments", &section[1..]);
        let error = parse(&text).expect_err(section);
        let expected = format!(
            "the section `{section}` is not known; nodes and elements are read from `$Nodes` and `$Elements`"
        );
        assert_eq!(error, Problem { line: 16, text: expected });
    }
    let harmless = WITHOUT_MESH.into_iter().chain(["$Periodic", "$InterpolationScheme", "$Parametrizations"]);
    for section in harmless {
        assert_eq!(parse(&GOOD.replace("Comments", &section[1..])), parse(GOOD), "{section}");
    }
}

/// Elements by their lines behind number, type, tags: two hexahedra, of which the second is of two groups
/// in the older format, a prism, a tetrahedron of second order, one of an unknown type.
const OTHERS: [(usize, usize, &str); 5] = [
    (21, 5, "40 3 20 10 30 1000 40 3"),
    (22, 5, "40 3 20 10 30 1000 3 40"),
    (23, 6, "40 3 20 10 30 1000"),
    (24, 11, "40 3 20 10 30 1000 40 3 20 10"),
    (25, 999, "1 2 3"),
];

/// Both files with other volume elements in addition to the tetrahedra.
fn mixed() -> [String; 2] {
    let newer = OTHERS.map(|(tag, kind, nodes)| format!("3 1 {kind} 1\n{tag} {nodes}\n")).concat();
    let older = OTHERS.map(|(tag, kind, nodes)| format!("{tag} {kind} 2 9 1 {nodes}\n")).concat();
    let again = "26 5 2 11 1 40 3 20 10 30 1000 3 40\n";
    [
        GOOD.replace("3 3 1 12\n", "8 8 1 25\n").replace("$EndElements", &format!("{newer}$EndElements")),
        OLDER
            .replace("$Elements\n5", "$Elements\n11")
            .replace("$EndElements", &format!("{older}{again}$EndElements")),
    ]
}

#[test]
fn other_volume_elements_are_refused_by_type_and_count_or_left_out_and_counted() {
    let others = "2 hexahedra, 1 prism, 1 second-order tetrahedron (10 nodes), 1 element of type 999";
    for text in mixed() {
        let error = parse_msh(&text, "mixed.msh").expect_err("a mixed mesh");
        assert_eq!(
            error.to_string(),
            format!(
                "mixed.msh: the volume is made of {others}, 2 tetrahedra, and only linear tetrahedra are read; \
                 mesh it with these alone (in Gmsh, without `Recombine` and with `-order 1`)"
            )
        );
        let mesh = error.only_tetrahedra().expect("its tetrahedra");
        assert_eq!(mesh.left_out.to_string(), others);
        let good = parse(GOOD).expect("a good file");
        assert_eq!((mesh.positions, mesh.tets, mesh.tags), (good.positions, good.tets, good.tags));
    }
}

#[test]
fn a_mesh_without_a_linear_tetrahedron_is_refused_whatever_is_wanted() {
    for text in mixed() {
        let text = text.replace("12 3 20 10 30\n", "12 3 20 10 30 40 1000\n").replace("3 2 4 1", "3 2 6 1");
        let text = text.replace("11 40 3 20 10\n", "11 40 3 20 10 30\n").replace("3 1 4 1", "3 1 7 1");
        let text = text.replace("12 4 2 9 2 3 20 10 30", "12 6 2 9 2 3 20 10 30 40 1000");
        let text = text.replace("12 4 2 11 2 3 20 10 30", "12 6 2 11 2 3 20 10 30 40 1000");
        let text = text.replace("11 4 2 9 1 40 3 20 10", "11 7 2 9 1 40 3 20 10 30");
        let error = parse_msh(&text, "mixed.msh").or_else(ReadError::only_tetrahedra).expect_err("none left");
        let expected = "2 hexahedra, 2 prisms, 1 pyramid, 1 second-order tetrahedron (10 nodes), 1 element of \
                        type 999, and only linear";
        assert!(error.to_string().contains(expected), "{error}");
    }
}

/// An element stands there once for each of its groups; twice for one of them is two elements.
#[test]
fn an_element_twice_in_one_group_is_two_elements() {
    let mesh = parse(&OLDER.replace("12 4 2 11 2 3 20", "13 4 2 9 2 3 20")).expect("a file");
    assert_eq!(mesh.tags, [11, 12, 13]);
    assert_eq!(
        mesh.rest_shapes().unwrap_err().to_string(),
        "elements 12 and 13 join the same four nodes, which would count their volume twice; remove one of them"
    );
}

/// Escapes, an invisible mark and a line of a million characters in every place where a message quotes
/// text of the file.
#[test]
fn messages_quote_nothing_that_a_terminal_obeys() {
    let hostile = format!("\u{1b}[2J\u{202e}{}", "x".repeat(1_000_000));
    let cuts =
        ["$MeshFormat\n", "4.1 0 8", "\"flesh\"", "0 1 0\n", "$EndNodes", "11 40 3 20 10", "$Comments"];
    for piece in cuts {
        for replacement in [hostile.clone(), format!("${hostile}"), format!("$X {hostile}\n")] {
            let text = GOOD.replacen(piece, &replacement, 1);
            let error = parse_msh(&text, "\u{1b}[31m.msh").expect_err(piece).to_string();
            assert!(error.chars().all(|c| !c.is_control() && c != '\u{202e}'), "{error:?}");
            assert!(error.len() < 300, "{error}");
        }
    }
}

#[test]
fn a_file_cut_anywhere_is_an_error_and_no_panic() {
    for good in [GOOD, OLDER] {
        for end in 0..good.len() - "$EndElements\n".len() {
            assert!(parse(&good[..end]).is_err(), "cut after {end} bytes");
        }
    }
}
