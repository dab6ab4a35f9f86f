// Entry points for an energy, whose own text stands before this one: an invocation computes a point.

struct Point { parameters: energy_parameters, F: array<f32, 9> }
@group(0) @binding(0) var<storage, read> points: array<Point>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

// Words of the results at a point: the outputs of each function, and its status.
const WORDS = 194u;

@compute @workgroup_size(1)
fn check() {
    results[0] = energy_check(points[0].parameters);
}

@compute @workgroup_size(64)
fn at_energy(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&points) { return; }
    let at = WORDS * id.x;
    var F: array<f32, 9>;
    for (var k = 0u; k < 9u; k++) { F[k] = points[id.x].F[k]; }
    var psi: f32;
    results[at + 1u] = energy_energy(points[id.x].parameters, F, &psi);
    results[at] = bitcast<u32>(psi);
}

@compute @workgroup_size(64)
fn at_stress(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&points) { return; }
    let at = WORDS * id.x + 2u;
    var F: array<f32, 9>;
    for (var k = 0u; k < 9u; k++) { F[k] = points[id.x].F[k]; }
    var P: array<f32, 9>;
    results[at + 9u] = energy_stress(points[id.x].parameters, F, &P);
    for (var k = 0u; k < 9u; k++) { results[at + k] = bitcast<u32>(P[k]); }
}

@compute @workgroup_size(64)
fn at_tangent(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&points) { return; }
    let at = WORDS * id.x + 12u;
    var F: array<f32, 9>;
    for (var k = 0u; k < 9u; k++) { F[k] = points[id.x].F[k]; }
    var P: array<f32, 9>;
    var A: array<f32, 81>;
    results[at + 90u] = energy_tangent(points[id.x].parameters, F, &P, &A);
    for (var k = 0u; k < 9u; k++) { results[at + k] = bitcast<u32>(P[k]); }
    for (var k = 0u; k < 81u; k++) { results[at + 9u + k] = bitcast<u32>(A[k]); }
}

@compute @workgroup_size(64)
fn at_projected(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&points) { return; }
    let at = WORDS * id.x + 103u;
    var F: array<f32, 9>;
    for (var k = 0u; k < 9u; k++) { F[k] = points[id.x].F[k]; }
    var P: array<f32, 9>;
    var A: array<f32, 81>;
    results[at + 90u] = energy_projected(points[id.x].parameters, F, &P, &A);
    for (var k = 0u; k < 9u; k++) { results[at + k] = bitcast<u32>(P[k]); }
    for (var k = 0u; k < 81u; k++) { results[at + 9u + k] = bitcast<u32>(A[k]); }
}
