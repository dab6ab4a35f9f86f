//! What a page is told: the surface's triangles once, then frames as it asks for them.
//!
//! Texts are JSON objects with one key that says what they are: `setup`, `figures` or `refused`. Binary messages begin with
//! three unsigned numbers of 32 bits, little-endian as all that follows:
//!
//! ```text
//! 0, triangles, edges    then three vertices for each triangle, two nodes for each edge of the cage, as u32
//! 1, vertices, nodes     then three coordinates for each, m, as f32
//! ```

use std::collections::BTreeSet;

use piola::step::Energies;
use serde::Serialize;
use tungstenite::{Bytes, Utf8Bytes};

use super::protocol::Act;
use super::session::Session;
use crate::energy;
use crate::geometry::Geometry;
use crate::measure;

/// One look at the body.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Counts states; a page that has seen this one waits for another.
    pub(super) state: u64,
    /// Counts what [`setup`] has said; a page that knows this one needs no other.
    pub(super) revision: u64,
    pub(super) setup: Utf8Bytes,
    pub(super) figures: Utf8Bytes,
    pub(super) positions: Bytes,
}

/// What steps are like, measured by who makes them.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub(super) paused: bool,
    pub(super) real_time: bool,
    /// Whether a recording decides what happens.
    pub(super) replays: bool,
    /// Steps per second of the solver's own time; None before the first.
    pub(super) steps_per_second: Option<f64>,
    /// Newton iterations of the last step.
    pub(super) newton_iterations: usize,
    /// After the last step, J.
    pub(super) energies: Energies,
    /// Why the last step failed, or the last file could not be written.
    pub(super) trouble: Option<String>,
}

/// The triangles of the surface and the edges of the tetrahedra.
pub(super) fn topology(geometry: &Geometry) -> Bytes {
    let mut edges = BTreeSet::new();
    for &[a, b, c, d] in &geometry.mesh.tets {
        for (one, other) in [(a, b), (a, c), (a, d), (b, c), (b, d), (c, d)] {
            edges.insert([one.min(other) as u32, one.max(other) as u32]);
        }
    }
    let header = [0, geometry.triangles.len() as u32, edges.len() as u32];
    let triangles = geometry.triangles.as_flattened().iter().copied();
    let numbers = header.into_iter().chain(triangles).chain(edges.into_iter().flatten());
    numbers.flat_map(u32::to_le_bytes).collect()
}

/// Where the surface and the nodes are.
pub(super) fn positions(session: &Session) -> Bytes {
    let nodes = session.play().simulation().positions();
    let vertices = session.geometry().surface_at(nodes);
    let header = [1, vertices.len() as u32, nodes.len() as u32];
    let coordinates = vertices.as_flattened().iter().copied();
    let coordinates = coordinates.chain(nodes.as_flattened().iter().map(|&x| x as f32));
    header.into_iter().flat_map(u32::to_le_bytes).chain(coordinates.flat_map(f32::to_le_bytes)).collect()
}

/// What changes with an act at most: the scene and its material.
pub(super) fn setup(session: &Session, file: Option<&str>) -> Utf8Bytes {
    let settings = session.settings();
    let mesh = &session.geometry().mesh;
    let bounds = mesh.bounds();
    let parameter = |parameter: &'static piola::material::Parameter| Parameter {
        name: parameter.name,
        doc: parameter.doc,
        is_list: parameter.is_list(),
        values: settings.energy.values_of(parameter.name),
    };
    let material = settings.energy.description().map(|description| Material {
        name: session.play().material(),
        summary: description.summary,
        formula: description.formula,
        domain: description.domain,
        parameters: description.parameters.iter().map(parameter).collect(),
    });
    json(&Told::Setup(Setup {
        scene: settings.scene.name,
        about: settings.scene.about,
        colour: settings.body.style.colour,
        azimuth: settings.body.style.azimuth,
        elevation: settings.body.style.elevation,
        bounds: [bounds.min, bounds.max],
        tets: mesh.tets.len(),
        nodes: mesh.positions.len(),
        vertices: session.geometry().surface_vertices(),
        dt: settings.dt,
        dt_of_scene: settings.scene.dt,
        material: material.ok(),
        materials: energy::catalogue().map(|(name, about)| (name, about.summary)).collect(),
        is_saved: session.saved().is_some(),
        file,
    }))
}

/// What changes with each step.
pub(super) fn figures(session: &Session, tally: &Tally) -> Utf8Bytes {
    let mesh = &session.geometry().mesh;
    let (play, positions) = (session.play(), session.play().simulation().positions());
    json(&Told::Figures(Figures {
        frame: play.clock().frame(),
        time: play.clock().time(),
        paused: tally.paused,
        real_time: tally.real_time,
        replays: tally.replays,
        steps_per_second: tally.steps_per_second,
        newton_iterations: tally.newton_iterations,
        min_det_f: measure::min_det_f(&mesh.positions, positions, &mesh.tets),
        inverted: measure::inverted(&mesh.positions, positions, &mesh.tets),
        from_rest: measure::distance_from_rest(mesh, positions, play.simulation().pinned().len()),
        elastic_energy: tally.energies.elastic,
        kinetic_energy: tally.energies.kinetic,
        pulls: session.pulls().map(|(_, held)| (held.vertex, held.target)).collect(),
        trouble: tally.trouble.as_deref(),
    }))
}

/// Why an act was not done.
pub(super) fn refused(act: &Act, reason: &str) -> Utf8Bytes {
    json(&Told::Refused { act, reason })
}

fn json(told: &Told<'_>) -> Utf8Bytes {
    // Strings, numbers and lists of them: nothing that JSON could not say.
    serde_json::to_string(told).unwrap_or_default().into()
}

#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Told<'a> {
    Setup(Setup<'a>),
    Figures(Figures<'a>),
    Refused { act: &'a Act, reason: &'a str },
}

#[derive(Serialize)]
struct Setup<'a> {
    scene: &'a str,
    about: &'a str,
    /// Linear RGB.
    colour: [f32; 3],
    azimuth: f32,
    elevation: f32,
    /// Of the tetrahedra at rest, m.
    bounds: [[f64; 3]; 2],
    tets: usize,
    nodes: usize,
    vertices: usize,
    dt: f64,
    dt_of_scene: f64,
    material: Option<Material<'a>>,
    /// Names and summaries of the catalogue.
    materials: Vec<(&'a str, &'a str)>,
    is_saved: bool,
    /// Where states are saved to, if to a file.
    file: Option<&'a str>,
}

#[derive(Serialize)]
struct Material<'a> {
    name: &'a str,
    summary: &'a str,
    formula: &'a str,
    domain: &'a str,
    parameters: Vec<Parameter<'a>>,
}

#[derive(Serialize)]
struct Parameter<'a> {
    name: &'a str,
    doc: &'a str,
    is_list: bool,
    values: &'a [f64],
}

#[derive(Serialize)]
struct Figures<'a> {
    frame: usize,
    time: f64,
    paused: bool,
    real_time: bool,
    replays: bool,
    steps_per_second: Option<f64>,
    newton_iterations: usize,
    min_det_f: f64,
    inverted: usize,
    /// The largest distance of a node from rest in body heights, as a summary has it.
    from_rest: f64,
    elastic_energy: f64,
    kinetic_energy: f64,
    /// Vertex and target.
    pulls: Vec<(usize, [f64; 3])>,
    trouble: Option<&'a str>,
}
