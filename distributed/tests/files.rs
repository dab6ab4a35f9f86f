//! Files that ranks read in parts, beside the readers of whole files.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;
use std::process::{Command, Stdio};

use piola_bodies::mesh::{Group, TetMesh, read_msh, tetrahedral_box};
use piola_distributed::error::Error;
use piola_distributed::files;
use piola_distributed::petsc::Library;
use piola_distributed::portion::{Place, Portion};
use piola_distributed::share::Share;
use piola_distributed::team::Team;

mod common;
use common::{TestResult, finish};

/// Tag of a node in the files, in another order than the nodes.
fn tag(node: usize) -> usize {
    7 * (node * 5 % 4913) + 3
}

/// Body, and the triangles of a group.
type Meshed = (TetMesh, Vec<[usize; 3]>);

/// Box with a group of triangles and two groups of tetrahedra that overlap; as many runs of lines as three
/// ranks need.
fn body() -> Result<Meshed, Box<dyn std::error::Error>> {
    let mut mesh = tetrahedral_box([16; 3], [1.0, 2.0, 1.0])?;
    let on_foot = |node: &usize| mesh.positions[*node][1] == 0.0;
    let faces = mesh.tets.iter().filter_map(|tet| {
        let face: Vec<usize> = tet.iter().copied().filter(on_foot).collect();
        face.try_into().ok()
    });
    let foot = faces.collect();
    let group = |name: &str, chosen: fn(usize) -> bool| Group {
        name: name.to_owned(),
        dimension: 3,
        nodes: Vec::new(),
        tets: (0..mesh.tets.len()).filter(|&tet| chosen(tet)).collect(),
    };
    mesh.groups = vec![group("upper half", |tet| tet % 2 == 0), group("7", |tet| tet % 3 == 0)];
    Ok((mesh, foot))
}

/// Groups of each tetrahedron, by their tags 6 and 7.
fn groups_of(mesh: &TetMesh, tet: usize) -> Vec<usize> {
    let is_in = |&group: &usize| mesh.groups[group].tets.binary_search(&tet).is_ok();
    (0..2).filter(is_in).map(|group| 6 + group).collect()
}

const NAMES: &str = "$PhysicalNames\n2\n2 4 \"foot\"\n3 6 \"upper half\"\n$EndPhysicalNames\n";

fn line(mut line: String, nodes: &[usize]) -> String {
    nodes.iter().for_each(|&node| line += &format!(" {}", tag(node)));
    line + "\n"
}

/// The body in MSH 2.2; a tetrahedron of two groups is repeated under another tag.
fn version_2((mesh, foot): &Meshed) -> String {
    let mut text =
        format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{NAMES}$Nodes\n{}\n", mesh.positions.len() + 1);
    text += "1 9 9 9\n";
    for (node, [x, y, z]) in mesh.positions.iter().enumerate() {
        text += &format!("{} {x:?} {y:?} {z:?}\n", tag(node));
    }
    let mut elements: Vec<String> =
        foot.iter().enumerate().map(|(face, nodes)| line(format!("{} 2 2 4 1", face + 1), nodes)).collect();
    for group in [0, 6, 7] {
        for (tet, nodes) in mesh.tets.iter().enumerate() {
            let groups = groups_of(mesh, tet);
            if groups.contains(&group) || (group == 0 && groups.is_empty()) {
                elements.push(line(format!("{} 4 2 {group} 1", elements.len() + 1), nodes));
            }
        }
    }
    text + &format!("$EndNodes\n$Elements\n{}\n{}$EndElements\n", elements.len(), elements.concat())
}

/// The body in MSH 4.1; each set of groups has its entity.
fn version_4((mesh, foot): &Meshed) -> String {
    let count = mesh.positions.len();
    let mut text =
        format!("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{NAMES}$Entities\n0 0 1 4\n1 0 0 0 1 0 1 1 4 0\n");
    let sets: [&[usize]; 4] = [&[], &[6], &[7], &[6, 7]];
    for (entity, groups) in sets.iter().enumerate() {
        let tags: String = groups.iter().map(|group| format!("{group} ")).collect();
        text += &format!("{entity} 0 0 0 1 2 1 {} {tags}0\n", groups.len());
    }
    text += &format!("$EndEntities\n$Nodes\n3 {} 1 99999\n0 1 0 1\n1\n9 9 9\n", count + 1);
    for nodes in [0..count / 3, count / 3..count] {
        text += &format!("3 1 0 {}\n", nodes.len());
        nodes.clone().for_each(|node| text += &format!("{}\n", tag(node)));
        for node in nodes {
            let [x, y, z] = mesh.positions[node];
            text += &format!("{x:?} {y:?} {z:?}\n");
        }
    }
    text +=
        &format!("$EndNodes\n$Elements\n5 {} 1 99999\n2 1 2 {}\n", foot.len() + mesh.tets.len(), foot.len());
    foot.iter().enumerate().for_each(|(face, nodes)| text += &line(format!("{}", face + 1), nodes));
    for (entity, set) in sets.iter().enumerate() {
        let tets: Vec<usize> = (0..mesh.tets.len()).filter(|&tet| groups_of(mesh, tet) == *set).collect();
        text += &format!("3 {entity} 4 {}\n", tets.len());
        tets.iter().for_each(|&tet| text += &line(format!("{}", 1000 + tet), &mesh.tets[tet]));
    }
    text + "$EndElements\n"
}

/// Runs the test `parts_are_those_of_the_whole` of this program on three ranks.
#[test]
fn gmsh_files_are_read_in_parts() -> TestResult {
    let body = body()?;
    let scratch = tempfile::tempdir()?;
    std::fs::write(scratch.path().join("2.msh"), version_2(&body))?;
    std::fs::write(scratch.path().join("4.msh"), version_4(&body))?;
    let good = version_4(&body);
    for (name, text) in [
        ("twice.msh", good.replacen(&format!("\n{}\n", tag(9)), &format!("\n{}\n", tag(8)), 1)),
        ("unknown.msh", good.replacen(&line("1005".to_owned(), &body.0.tets[5]), "1005 3 10 17 100000\n", 1)),
        (
            "same.msh",
            good.replacen(
                &line("1005".to_owned(), &body.0.tets[5]),
                &line("1005".to_owned(), &body.0.tets[7]),
                1,
            ),
        ),
        ("word.msh", good.replacen(&line("1005".to_owned(), &body.0.tets[5]), "1005 3 10 17 x\n", 1)),
        (
            "mixed.msh",
            good.replace(&format!("\n2 1 2 {}\n", body.1.len()), &format!("\n3 1 11 {}\n", body.1.len())),
        ),
    ] {
        std::fs::write(scratch.path().join(name), text)?;
    }
    let mut run = Command::new("mpirun");
    run.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    run.args(["--oversubscribe", "-n", "3"]).arg(std::env::current_exe()?);
    run.args(["--exact", "parts_are_those_of_the_whole", "--nocapture"]).env("PIOLA_FILES", scratch.path());
    run.stdout(Stdio::piped()).stderr(Stdio::piped());
    let output = finish(run)?;
    let (shown, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{shown}\n{errors}");
    assert_eq!(
        shown.matches("has nodes, elements and members").count(),
        2 * 3,
        "every rank has read\n{shown}"
    );
    Ok(())
}

/// Runs as a rank of the test above.
#[test]
fn parts_are_those_of_the_whole() -> TestResult {
    let Some(folder) = std::env::var_os("PIOLA_FILES") else { return Ok(()) };
    let folder = Path::new(&folder);
    let library = Library::start(&[])?;
    let team = Team::new(&library);
    for name in ["2.msh", "4.msh"] {
        check_part(&team, &folder.join(name))?;
    }
    check_pieces(&team, &folder.join("4.msh"))?;
    let error_of = |name: &str| match files::read(&team, &folder.join(name)) {
        Err(Error::OnRank { message, .. }) => message,
        other => format!("no error: {:?}", other.map(|_| ())),
    };
    for (name, expected) in
        [("twice.msh", format!("node {} is given twice", tag(8))), ("word.msh", "found `x`".to_owned())]
    {
        // Word by word that of the reader of whole files, with the line.
        let whole = read_msh(folder.join(name)).expect_err(name).to_string();
        assert!(whole.contains(&expected), "{whole}");
        assert_eq!(error_of(name), whole);
    }
    let unknown = error_of("unknown.msh");
    assert!(
        unknown.contains("the element names node 100000, which is not among the nodes of the file"),
        "{unknown}"
    );
    let same = error_of("same.msh");
    assert!(same.contains("elements 1005 and 1007 join the same four nodes"), "{same}");
    assert!(files::read(&team, &folder.join("mixed.msh"))?.is_none());
    Ok(())
}

/// Counts the tetrahedra on both sides of a layer of cells that is taken out.
fn check_pieces(team: &Team, file: &Path) -> TestResult {
    let part = files::read(team, file)?.ok_or("not read in parts")?;
    let layer = |node: u64| node / (17 * 17);
    let pieces = |is_cut: bool| -> Result<Vec<usize>, Error> {
        let is_left = |&&(nodes, _): &&([u64; 4], u64)| {
            !is_cut || nodes.map(layer).iter().min() != Some(&7) || nodes.map(layer).iter().max() != Some(&8)
        };
        let elements = part.elements.iter().filter(is_left);
        let elements = elements.map(|&([a, b, c, d], tag)| [a, b, c, d, tag, 0]).collect();
        let places = part.nodes.iter().map(|&rest| Place::at_rest(rest, false)).collect();
        let share = Share::of(team, Portion { homes: part.homes, places, elements })?;
        let mut pieces = share.pieces(team);
        pieces.sort_unstable();
        Ok(pieces)
    };
    assert_eq!(pieces(false)?, [24576]);
    assert_eq!(pieces(true)?, [10752, 12288]);
    Ok(())
}

/// Compares the part of this rank with the whole mesh.
#[expect(clippy::print_stdout, reason = "counted by the test that starts the ranks")]
fn check_part(team: &Team, file: &Path) -> TestResult {
    let whole = read_msh(file)?;
    let part = files::read(team, file)?.ok_or("not read in parts")?;
    let home = part.homes.range(team.rank());
    let home = home.start as usize..home.end as usize;
    assert_eq!((part.dropped, part.is_oriented), (whole.dropped_nodes, true));
    assert_eq!(part.nodes, whole.positions[home.clone()]);
    let nodes_of: HashMap<usize, [usize; 4]> =
        whole.tags.iter().copied().zip(whole.tets.iter().copied()).collect();
    for &(nodes, tag) in &part.elements {
        assert_eq!(nodes_of[&(tag as usize)], nodes.map(|node| node as usize), "element {tag}");
    }
    assert_eq!(team.count(part.elements.len()), whole.tets.len());
    let titles = |groups: &[Group]| {
        groups.iter().map(|group| (group.name.clone(), group.dimension)).collect::<Vec<_>>()
    };
    let found: Vec<_> =
        part.groups.iter().map(|group| (group.name.clone(), group.dimension as usize)).collect();
    assert_eq!(found, titles(&whole.groups));
    for (found, expected) in part.groups.iter().zip(&whole.groups) {
        if found.dimension == 3 {
            let here: BTreeSet<u64> = part.elements.iter().map(|&(_, tag)| tag).collect();
            let expected =
                expected.tets.iter().map(|&tet| whole.tags[tet] as u64).filter(|tag| here.contains(tag));
            let found: BTreeSet<u64> =
                found.members.iter().map(|&element| part.elements[element].1).collect();
            assert_eq!(found, expected.collect());
        } else {
            let expected =
                expected.nodes.iter().filter(|node| home.contains(node)).map(|node| node - home.start);
            assert_eq!(found.members, expected.collect::<Vec<_>>());
        }
    }
    if !part.nodes.is_empty()
        && !part.elements.is_empty()
        && part.groups.iter().all(|group| !group.members.is_empty())
    {
        println!("rank {} has nodes, elements and members", team.rank());
    }
    Ok(())
}
