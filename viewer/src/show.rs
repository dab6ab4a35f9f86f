//! Messages to a page: the surface's triangles once, then frames as the page requests them.
//!
//! Texts are JSON objects with one key that names their kind: `setup`, `figures` or `refused`.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use piola::material::Parameter;
use piola_declare::{Energy, Mistake};
use piola_materials::DECLARATIONS;
use piola_scenes::error::Error;
use piola_scenes::geometry::Geometry;
use piola_scenes::material::MaterialSpec;
use piola_scenes::measure;
use piola_scenes::play::Play;
use rayon::prelude::*;
use serde_json::json;

use crate::protocol::Act;
use crate::session::Session;

/// Figures of the last steps, measured by the driver.
#[derive(Clone, Debug, Default)]
pub(crate) struct FrameStats {
    pub(crate) paused: bool,
    pub(crate) real_time: bool,
    /// Steps per second of the solver's own time; `None` before the first.
    pub(crate) steps_per_second: Option<f64>,
    /// Newton iterations of the last step.
    pub(crate) newton_iterations: usize,
    /// Elastic energy after the last step, J.
    pub(crate) elastic_energy: f64,
    /// Reason why the last step failed.
    pub(crate) trouble: Option<String>,
}

/// Triangles of the surface and edges of the tetrahedra, as a binary message: the first for a page.
///
/// Binary messages begin with three unsigned numbers of 32 bits, little-endian as all that follows:
///
/// ```text
/// 0, triangles, edges    then three vertices for each triangle, two nodes for each edge of the cage, as u32
/// 1, vertices, nodes     then three coordinates for each, m, as f32
/// ```
#[must_use]
pub fn topology(geometry: &Geometry) -> Vec<u8> {
    let edges = measure::edges(&geometry.mesh.tets);
    let header = [0, geometry.triangles.len() as u32, edges.len() as u32];
    let triangles = geometry.triangles.as_flattened().iter().copied();
    let ends = edges.as_flattened().iter().map(|&node| node as u32);
    let numbers = header.into_iter().chain(triangles).chain(ends);
    numbers.flat_map(u32::to_le_bytes).collect()
}

/// Positions of the surface and the nodes, as a binary message.
pub(crate) fn positions(session: &Session) -> Arc<[u8]> {
    let nodes = session.play().simulation.positions();
    let vertices = session.play().geometry.surface_at(nodes);
    let header = [1, vertices.len() as u32, nodes.len() as u32];
    let coordinates = vertices.as_flattened().iter().copied();
    let coordinates = coordinates.chain(nodes.as_flattened().iter().map(|&x| x as f32));
    header.into_iter().flat_map(u32::to_le_bytes).chain(coordinates.flat_map(f32::to_le_bytes)).collect()
}

/// The scene and its material, which change only with acts, and the name of the file for saved states.
pub(crate) fn setup(session: &Session, save: Option<&Path>) -> Arc<str> {
    let Play { settings, geometry, material: name, .. } = session.play();
    let mesh = &geometry.mesh;
    let bounds = mesh.bounds();
    let style = settings.body.style;
    let parameter = |parameter: &Parameter| {
        json!({
            "name": parameter.name,
            "doc": parameter.doc,
            "is_list": parameter.is_list(),
            "values": settings.material.values_of(&parameter.name),
        })
    };
    let material = settings.material.description().map(|description| {
        json!({
            "name": name,
            "summary": description.summary,
            "formula": description.formula,
            "text": text(&settings.material),
            "is_declared": settings.material.energy.is_some(),
            "domain": description.domain,
            "parameters": description.parameters.iter().map(parameter).collect::<Vec<_>>(),
        })
    });
    let materials = DECLARATIONS.par_iter().filter_map(|known| {
        let material = MaterialSpec::new(known.name);
        material.description().ok().map(|description| (known.name, description.summary.clone()))
    });
    let setup = json!({
        "scene": settings.scene.name,
        "about": settings.scene.about,
        "colour": style.colour, // linear RGB
        "azimuth": style.azimuth,
        "elevation": style.elevation,
        "bounds": [bounds.min, bounds.max], // of the tetrahedra at rest, m
        "tets": mesh.tets.len(),
        "nodes": mesh.positions.len(),
        "vertices": geometry.embedding.len(),
        "dt": settings.dt,
        "dt_of_scene": settings.scene.dt,
        "material": material.ok(),
        "materials": materials.collect::<Vec<_>>(),
        "is_saved": session.saved().is_some(),
        "file": save.map(name_of),
    });
    json!({ "setup": setup }).to_string().into()
}

/// The text of the energy in use: for one of the catalogue the declaration in Rust.
fn text(material: &MaterialSpec) -> &str {
    let known = || DECLARATIONS.iter().find(|known| material.is(known.name));
    let source = material.energy.as_ref().map(Energy::text).or_else(|| known().map(|known| known.source));
    let text = source.unwrap_or_default();
    // Documentation and imports of the file are not part of the energy.
    text.find("\n///").map_or(text, |begin| &text[begin + 1..])
}

/// Figures that change with each step.
pub(crate) fn figures(session: &Session, stats: &FrameStats) -> Arc<str> {
    let Play { geometry, simulation, clock, .. } = session.play();
    let (mesh, positions) = (&geometry.mesh, simulation.positions());
    let figures = json!({
        "frame": clock.frame,
        "time": clock.time(),
        "paused": stats.paused,
        "real_time": stats.real_time,
        "steps_per_second": stats.steps_per_second,
        "newton_iterations": stats.newton_iterations,
        "min_det_f": measure::min_det_f(&mesh.positions, positions, &mesh.tets),
        "inverted": measure::inverted(&mesh.positions, positions, &mesh.tets),
        "from_rest": measure::distance_from_rest(mesh, positions, simulation.pinned().len()),
        "elastic_energy": stats.elastic_energy,
        "pulls": session.pulls().map(|(_, drag)| (drag.vertex, drag.target)).collect::<Vec<_>>(),
        "trouble": stats.trouble,
    });
    json!({ "figures": figures }).to_string().into()
}

/// The reason why an act was refused, and the mistakes of a text with their places.
pub(crate) fn refused(act: &Act, error: Error) -> Arc<str> {
    let (reason, mistakes) = match error {
        Error::Declaration(mistakes) => (mistakes.to_string(), mistakes.list),
        Error::Write { path, source } => {
            let reason = source.get_ref().map_or_else(|| source.kind().to_string(), |own| own.to_string());
            (format!("cannot write {}: {reason}", name_of(&path)), Vec::new())
        }
        error => (error.to_string(), Vec::new()),
    };
    let mistake = |Mistake { message, place }: &Mistake| {
        let place = place.map(|place| [place.line, place.column, place.length]);
        json!({ "message": message, "place": place })
    };
    let mistakes: Vec<_> = mistakes.iter().map(mistake).collect();
    json!({ "refused": { "act": act, "reason": reason, "mistakes": mistakes } }).to_string().into()
}

/// The name of a file without its path: pages get no other information about this machine, and of an error of
/// the system only its kind.
fn name_of(path: &Path) -> Cow<'_, str> {
    path.file_name().unwrap_or_default().to_string_lossy()
}
