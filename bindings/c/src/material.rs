//! Materials: energies with values for their parameters.

use std::ffi::c_char;
use std::sync::{Arc, OnceLock};

use piola::Inversion;
use piola::batch::{Kernels, TileMaterial};
use piola::interpreter::Interpreted;
use piola::material::{Moduli, PerPoint};
use piola_scenes::material::{MaterialInfo, MaterialSpec};

use crate::energy::Energy;
use crate::error::{Code, Failure};
use crate::functions::functions;
use crate::lent::{Arrays, Plain, plain};
use crate::{handle, lent};

/// A material: an energy with values for its parameters, the same for all points, or some for each.
/// Immutable: threads may share it.
pub struct Material {
    /// The energy with the values of the first point.
    spec: MaterialSpec,
    moduli: Moduli,
    /// The material in double precision, as compiled with the library, if it is.
    elements: Box<dyn TileMaterial<f64>>,
    /// The material as a program, made when single precision is first used.
    interpreted: OnceLock<Interpreted>,
    /// Instead of these, a material for each point.
    each: Option<PerPoint<Interpreted, Arc<[Interpreted]>>>,
}

/// Values of a parameter.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Parameter {
    /// Name of the parameter.
    pub name: *const c_char,
    /// Its values, in SI units.
    pub values: *const f64,
    /// Number of its values at a point: 1, or more for a list.
    pub length: usize,
    /// Distance from the values of a point to those of the next one; 0 if they are the same for all points.
    pub stride: usize,
}
plain!(Parameter);

functions! {
/// Makes a material of an energy and values for all of its parameters, in any order.
///
/// `points` is 0 for one material that is the same for any number of points. Otherwise it has exactly
/// `points` points, and parameters with a stride have values for each of them: those of point p begin at
/// `values[p * stride]`. In a body, points are the tetrahedra of a part, in their order.
///
/// `extension` is the behaviour outside the domain of the energy, such as for inverted elements. Between 0
/// and 1 it is the stretch below which the energy is continued, which then restores them. 0: such points are
/// refused. Negative: 0.1 if the energy can be continued, else 0.
///
/// Parameters of a declared energy that are not given have the typical values of the declaration, if it has
/// some.
///
/// Energies of the catalogue that the library was not compiled with, values for each point, and single
/// precision are interpreted, with the same bits. An interpreted energy is compiled at its first use, within
/// milliseconds to seconds.
///
/// Errors: PIOLA_CODE_MATERIAL for unknown and missing parameters and values out of range; the message names
/// them, and the point.
fn piola_material_new(
    energy: &Energy,
    parameters: &[Parameter],
    extension: f64,
    points: usize,
    material: New<Material>,
) {
    // SAFETY: texts and values, as the header requires.
    let given = |parameter| unsafe { Given::new(parameter, points) };
    let given = parameters.iter().map(given).collect::<Result<Vec<_>, _>>()?;
    material.give(|| Material::new(&energy.spec, &given, extension, points))
}

/// Moduli at rest, Pa: the shear modulus μ and Lamé's λ. Each pointer may be null. For a material with values
/// for each point they are those of the first.
fn piola_material_moduli(material: &Material, mu: Out<f64>, lambda: Out<f64>) {
    mu.write(material.moduli.mu)?;
    lambda.write(material.moduli.lambda)
}
}

/// Frees a material, or does nothing with null. Bodies made of it stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_material_free(material: Option<Box<Material>>) {
    handle::free(material);
}

/// A parameter as given, its lengths checked.
struct Given<'a> {
    name: &'a str,
    values: &'a [f64],
    length: usize,
    stride: usize,
}

impl<'a> Given<'a> {
    /// # Safety
    /// The parameter points to a text, and to as many values as its points need.
    unsafe fn new(parameter: &Parameter, points: usize) -> Result<Self, Failure> {
        let &Parameter { name, values, length, stride } = parameter;
        // SAFETY: that of this function.
        let name = unsafe { lent::text("parameters[].name", name) }?;
        if stride != 0 && (stride < length || points == 0) {
            let message = format!(
                "`{name}` has a stride of {stride}; it must be 0, or, in a material for a given number of points, at \
                 least the number of its values, {length}"
            );
            return Err(Failure::new(Code::Length, message));
        }
        let all = points.saturating_sub(1).saturating_mul(stride).saturating_add(length);
        // SAFETY: as before.
        let values = unsafe { Arrays::new().input(name, values, all) }?;
        Ok(Self { name, values, length, stride })
    }

    fn at(&self, point: usize) -> &[f64] {
        &self.values[point * self.stride..][..self.length]
    }
}

fn with_extension(spec: MaterialSpec, extension: f64) -> MaterialSpec {
    match extension {
        0.0 => spec.with_inversion(Inversion::Refuse),
        epsilon if epsilon < 0.0 => spec,
        epsilon => spec.with_inversion(Inversion::Extend { epsilon }),
    }
}

/// The specification with the values of a point.
fn at(spec: MaterialSpec, given: &[Given<'_>], point: usize) -> MaterialSpec {
    given.iter().fold(spec, |spec, given| spec.with_parameter(given.name, given.at(point)))
}

/// The failure of a point, where there are several.
fn of_point(failure: impl Into<Failure>, point: usize, points: usize) -> Failure {
    let failure = failure.into();
    match points {
        0 => failure,
        _ => Failure { message: format!("point {point} (from 0): {}", failure.message), ..failure },
    }
}

impl Material {
    fn new(
        energy: &MaterialSpec,
        given: &[Given<'_>],
        extension: f64,
        points: usize,
    ) -> Result<Self, Failure> {
        let energy = with_extension(energy.clone(), extension);
        let spec = at(energy.clone(), given, 0);
        let info = spec.build().map_err(|error| of_point(error, 0, points))?;
        let MaterialInfo { elements, moduli, .. } = info;
        let material = |point| {
            let material = at(energy.clone(), given, point).interpreted();
            material.map_err(|error| of_point(error, point, points))
        };
        let each = match points {
            0 => None,
            _ => Some(PerPoint::new((0..points).map(material).collect::<Result<Arc<[_]>, _>>()?)?),
        };
        Ok(Self { spec, moduli, elements, interpreted: OnceLock::new(), each })
    }

    /// The material for a part of a body.
    pub(crate) fn for_body(&self) -> Result<Box<dyn TileMaterial<f64>>, Failure> {
        Ok(match &self.each {
            None => self.spec.build()?.elements,
            Some(each) => Box::new(each.clone()),
        })
    }
}

/// Numbers of the two precisions.
pub(crate) trait Precision: Kernels + Plain {
    /// The material of a batch.
    fn tiles(material: &Material) -> Result<&dyn TileMaterial<Self>, Failure>;
}

impl Precision for f64 {
    fn tiles(material: &Material) -> Result<&dyn TileMaterial<Self>, Failure> {
        Ok(match &material.each {
            None => &*material.elements,
            Some(each) => each,
        })
    }
}

impl Precision for f32 {
    fn tiles(material: &Material) -> Result<&dyn TileMaterial<Self>, Failure> {
        if let Some(each) = &material.each {
            return Ok(each);
        }
        if let Some(interpreted) = material.interpreted.get() {
            return Ok(interpreted);
        }
        let interpreted = material.spec.interpreted()?;
        Ok(material.interpreted.get_or_init(|| interpreted))
    }
}
