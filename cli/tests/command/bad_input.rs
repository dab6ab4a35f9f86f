//! Wrong input of any kind: `piola` reports the mistake and how to correct it, ends with status 2 and writes
//! nothing.

use std::net::TcpListener;

use crate::{Folder, assert_contains};

/// Runs `piola` in a folder with these files; `guilty` must all be in its message.
#[track_caller]
fn check(files: &[(&str, String)], arguments: &str, guilty: &[&str]) {
    let folder = Folder::new();
    files.iter().for_each(|(name, content)| folder.write(name, content));
    assert_contains(&folder.refusal(arguments), guilty);
}

/// Gmsh text of a unit tetrahedron between these nodes.
pub(crate) fn tetrahedron(nodes: [usize; 4]) -> String {
    let [a, b, c, d] = nodes;
    format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
         $Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n\
         $Elements\n1 1 7 7\n3 1 4 1\n7 {a} {b} {c} {d}\n$EndElements\n"
    )
}

fn good_mesh() -> (&'static str, String) {
    ("cage.msh", tetrahedron([1, 2, 3, 4]))
}

#[test]
fn meshes_and_surfaces() {
    let run = "run horse --mesh cage.msh";
    check(&[], run, &["cage.msh", "cannot be read"]);
    let malformed = tetrahedron([1, 2, 3, 4]).replace("0 1 0\n", "0 one 0\n");
    check(&[("cage.msh", malformed)], run, &["cage.msh:13", "`one`"]);
    let flat = tetrahedron([1, 2, 3, 4]).replace("0 0 1\n$End", "1 1 0\n$End");
    check(&[("cage.msh", flat)], run, &["cage.msh: element 7 is flat"]);

    let run = "run horse --mesh cage.msh --surface skin.obj";
    check(&[good_mesh()], run, &["skin.obj"]);
    for (surface, guilty) in [
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", &["skin.obj:4", "9"][..]),
        ("v 0 0 0\nv 1 0 0\nv 0 9 0\nf 1 2 3\n", &["skin.obj", "vertex 3", "outside"]),
    ] {
        check(&[good_mesh(), ("skin.obj", surface.into())], run, guilty);
    }
}

/// Beginnings of files as other tools write them.
#[test]
fn meshes_of_other_tools_are_named_with_the_next_step() {
    let by_meshio = "`meshio convert OLD NEW.msh --output-format gmsh22 --ascii`";
    for (name, text, format, next) in [
        ("bar.vtk", "# vtk DataFile Version 2.0\nbar, by hand\nASCII\n", "VTK,", by_meshio),
        ("bar51.vtk", "# vtk DataFile Version 5.1\nbar\nASCII\n", "VTK,", by_meshio),
        ("bar.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n", "(VTU)", by_meshio),
        ("bar.inp", "** bar\n*Heading\n*Part, name=BAR\n*Node\n", "Abaqus", by_meshio),
        ("bar.mesh", "MeshVersionFormatted 2\n\nDimension\n3\n", "Medit", by_meshio),
        ("bar.veg", "# bar\n*VERTICES\n45 3 0 0\n1 0 0 0\n", "VegaFEM", "saved as NEW.ele"),
        ("bar.feb", "<?xml version=\"1.0\"?>\n<febio_spec version=\"4.0\">\n", "FEBio", "write_points_cells"),
        ("bar.key", "$# by hand\n*KEYWORD\n*NODE\n", "LS-DYNA", "write_points_cells"),
        ("bar.tet", "45 vertices\n96 tets\n0 0 0\n", "the format .tet", "write_points_cells"),
        ("bar.off", "OFF\n45 2 0\n0 0 0\n", "OFF", "gmsh NEW.geo -3"),
        ("bar.stl", "solid bar\nfacet normal 0 0 1\n", "STL", "gmsh NEW.geo -3"),
        ("bar.obj", "o bar\nv 0 0 0\n", "Wavefront OBJ", "gmsh NEW.geo -3"),
    ] {
        check(&[(name, text.into())], &format!("run stretch --mesh {name}"), &[name, format, next]);
    }
}

#[test]
fn volume_elements_other_than_linear_tetrahedra_are_refused_by_type_and_count() {
    let mixed = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
                 $Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n\
                 $Elements\n2\n1 4 0 1 2 3 4\n2 6 0 1 2 3 1 2 4\n$EndElements\n";
    for arguments in ["run stretch --mesh cage.msh", "view --port 0 --mesh cage.msh"] {
        let advice = "or leave the others out with --only-tetrahedra";
        check(&[("cage.msh", mixed.into())], arguments, &["1 prism, 1 tetrahedr", "`Recombine`", advice]);
    }
}

#[test]
fn units_that_are_none_or_without_a_mesh() {
    check(&[good_mesh()], "run horse --mesh cage.msh --unit ell", &["'ell'", "mm", "ft"]);
    check(&[], "run horse --unit mm", &["--mesh"]);
    check(&[], "run horse --only-tetrahedra", &["--mesh"]);
    check(&[good_mesh()], "view --load x.json --mesh cage.msh --unit mm", &["leave out"]);
}

#[test]
fn unknown_names_are_answered_with_those_that_exist() {
    check(&[], "run hrose", &["`hrose`", "`horse`", "`dinosaur`"]);
    check(&[], "run horse --body cow", &["`cow`", "`horse`", "`bar`", "--mesh"]);
    check(&[], "run horse --material steel", &["`steel`", "piola materials"]);
    check(&[], "run horse --param mue=1", &["`mue`", "`mu`", "`lambda`"]);
    check(&[], "run horse --pin hoof", &["`hoof`", "LOW:HIGH"]);
    check(&[], "run horse --pin :,90:,:", &["`:,90:,:`", "no node"]);
    check(&[], "jump horse", &["jump"]);
}

#[test]
fn parameters_and_numbers_out_of_range() {
    check(&[], "run horse --param mu=NaN", &["`mu`", "NaN", "finite"]);
    check(&[], "run horse --param mu=-1", &["mu", "-1"]);
    check(&[], "run horse --param mu", &["NAME=VALUE"]);
    check(&[], "run horse --material st_venant_kirchhoff --param mu=1", &["value for `lambda`", "--param"]);
    check(&[], "run horse --param mu=1e308 --param lambda=1", &["Young's modulus", "--param"]);
    check(&[], "run dinosaur --inversion 1.5", &["1.5", "--inversion"]);
    check(&[], "run horse --inversion 1e-300", &["1e-300", "--inversion", "from 1e-6"]);
    check(&[], "run horse --dt NaN", &["time step", "--dt", "from 1e-12 to 1e6"]);
    check(&[], "run horse --density -2", &["density", "--density", "from 1e-9"]);
    check(&[], "run horse --part legs", &["--part legs", "GROUP=NAME"]);
    check(&[], "run horse --part legs=gent;density=1,2", &["density=RHO", "one number"]);
    check(&[], "run horse --gravity NaN", &["--gravity", "from -1e9"]);
    for frames in ["0", "18446744073709551615"] {
        check(&[], &format!("run horse --frames {frames}"), &["--frames", "from 1 to 1000000"]);
    }
    check(&[], "run horse --frames -3", &["-3"]);
    check(&[], "run horse --threads 100000", &["--threads", "100000", "at most"]);
}

#[test]
fn materials_that_cannot_start_where_a_scene_does() {
    let known =
        ["`yeoh`", "`horse`", "J > 0", "cannot be extended", "neo_hookean", "--material", "`stretch`"];
    check(&[], "run horse --material yeoh", &known);
    let mesh = include_str!("twomaterials.msh").to_owned();
    check(&[("two.msh", mesh)], "run horse --mesh two.msh --part stiff=yeoh", &known);
    let refused = "run horse --material neo_hookean --inversion refuse";
    check(&[], refused, &["`neo_hookean`", "J > 0", "leave out --inversion refuse"]);
}

#[test]
fn only_scenes_that_scramble_take_a_seed() {
    check(&[], "run horse --seed 3", &["`horse`", "--seed", "`scramble`"]);
    check(&[], "run point --amplitude 1", &["`point`", "--amplitude", "`scramble`"]);
    check(&[], "run scramble --amplitude far", &["far", "`box`"]);
    check(&[], "run scramble --amplitude -1", &["--amplitude", "from 0 to 1000"]);
}

#[test]
fn folders_and_files_that_are_others() {
    let occupied = ("out", String::from("a file, not a folder"));
    check(&[occupied], "run horse --frames 1 --out out/deeper", &["out/deeper"]);
    check(&[], "view hrose", &["`hrose`", "`horse`"]);
    check(&[], "view --load state.json", &["state.json", "cannot be read"]);
    check(&[], "view dinosaur --load state.json", &["leave out", "--load"]);
    let state = ("state.json", String::from("{\"format\": \"piola state 0\"}"));
    check(&[state], "view --load state.json", &["state.json", "not a saved state"]);
    check(&[], "view --port 65536", &["65536"]);
    let taken = TcpListener::bind(("127.0.0.1", 0)).and_then(|taken| Ok((taken.local_addr()?.port(), taken)));
    let (port, _taken) = taken.expect("a port");
    check(&[], &format!("view --port {port}"), &[&port.to_string(), "--port"]);
}

#[test]
fn what_a_bench_cannot_do() {
    let data = |text: &str| [("rubber.csv", text.to_owned())];
    check(&[], "curve ruber", &["`ruber`", "piola materials"]);
    check(&[], "curve gent --mode twist", &["`twist`", "`pure_shear`"]);
    check(&[], "curve gent --from 2 --to 1", &["--to", "above --from"]);
    check(&[], "curve gent --from -1", &["--from", "from 1e-6"]);
    for rows in ["0", "18446744073709551615"] {
        check(&[], &format!("curve gent --rows {rows}"), &["--rows", "from 1 to 100000"]);
    }
    check(&[], "fit gent", &["--data"]);
    check(&[], "fit gent --data rubber.csv", &["rubber.csv", "cannot be read", "treloar"]);
    let arguments = "fit gent --data rubber.csv";
    check(&[], "fit gent --data treloar --hold nu", &["`nu`", "`mu`, `jm`, `kappa`"]);
    check(&[], "fit gent --data treloar --param jm=10", &["λ = 3.57", "--param"]);
    let text = "mode,stretch,nominal_stress_kPa\nuniaxial,2,300\n";
    check(&data(text), arguments, &["1 points", "--hold"]);
    check(&[], "check gent --from 2", &["from 2 to 3", "at least 1e-6 and at most 1e6"]);
    check(&[], "check gent --resolution 1", &["resolution is 1", "2 to 400"]);
}

#[test]
fn a_ranking_that_is_none() {
    check(&[], "curve all", &["--data treloar"]);
    check(&[], "curve all --data treloar --param mu=1", &["cannot use --param"]);
    let bulk = ("bulk.csv", "mode,stretch,nominal_stress_kPa\nvolumetric,0.9,-200\n".to_owned());
    check(&[bulk], "curve all --data bulk.csv", &["bulk.csv", "volumetric"]);
    check(&[], "curve all --data treloar --svg all.svg", &["cannot use --svg", "table"]);
}

#[test]
fn data_that_may_mean_two_things() {
    let data = |text: &str| [("rubber.csv", text.to_owned())];
    let arguments = "fit gent --data rubber.csv";
    check(&data("strain,stress\n0.1,0.2\n"), arguments, &["rubber.csv:1", "--mode uniaxial"]);
    let two = "fit gent --data rubber.csv --mode uniaxial --mode planar";
    check(&data("strain,stress_Pa\n0.1,0.2\n"), two, &["2 values of --mode", "1 of --data"]);
    check(&[], "fit gent --data treloar --mode volumetric", &["treloar", "equibiaxial"]);
    // Although the header of the data has a unit.
    let units = "fit gent --data treloar --unit MPa --unit kPa";
    check(&[], units, &["2 values of --unit", "1 of --data"]);
    check(&[], "curve gent --unit MPa", &["--unit", "--data"]);
    check(&[], "curve gent --strain 1", &["--strain", "--data"]);
    let chosen = "fit gent --data rubber.csv --mode uniaxial --strain '1=stress [MPa]'";
    check(&data("a,stress_Pa\n0.1,0.2\n"), chosen, &["rubber.csv:1", "not a stretch or a strain"]);
    let biaxial = "lambda1,lambda2,P11_MPa,P22_MPa\n1.3,1,0.337934,0.163314\n1.3,1.6,0.44888,0.582215\n\
                   1.9,1,0.701682,0.289197\n";
    check(&data(biaxial), arguments, &["rubber.csv:1", "1 `lambda1`, 2 `lambda2`", "general biaxial"]);
    let first = format!("{arguments} --mode equibiaxial --strain 1=stretch --stress '3=stress [MPa]'");
    check(&data(biaxial), &first, &["with 448.9 kPa at λ = 1.3 and 337.9 kPa", "stretches across"]);
    let beside = "1.0063\t0.0224\t0.9938\t-0.0226\t0.0125\t0.0150\n";
    check(&data(beside), arguments, &["no header above the numbers", "6 `0.0150`"]);
    let rheometer = "Time (s)\tTorque (Nm)\tNormal force (N)\tGap (um)\n0\t-0.0000144\t0.04\t9760\n";
    check(&data(rheometer), arguments, &["3 `Normal force (N)`", "by the cross-section"]);
    check(&[], "fit gent --data treloar --cycle second", &["--cycle", "`first`, or the number"]);
    check(&[], "fit gent --data treloar --floor 0.1 --absolute", &["--floor", "--absolute"]);
    check(&[], "curve gent --at 1.1 --rows 3", &["--at", "--rows"]);
    check(&[], "curve gent --param jm=105MPa", &["`jm`", "without a unit", "in Pa"]);
    check(&[], "curve gent --param mu=1/MPa", &["`mu`", "in Pa", "in 1/Pa"]);
    let curve =
        "curve --energy 'c1*(I1b - 3) + c2*ln(I2b/3)*(1 + b) + (J - 1)^2/D1' --param c1=0.29MPa --param b=2";
    for (others, guilty) in [
        ("--param c2=0.22 --param D1=1/MPa", ["`c2` is in Pa", "`c2=0.22MPa`", "`c2=0.22Pa`"]),
        ("--param c2=1kPa --param D1=1e-7", ["`D1` is in 1/Pa", "`D1=1e-7/MPa`", "`D1=1e-7/Pa`"]),
    ] {
        check(&[], &format!("{curve} {others}"), &guilty);
    }
}
