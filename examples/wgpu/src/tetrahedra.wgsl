// Entry point for an energy, whose own text stands before this one: an invocation computes an element.

// Elements of a line, and invocations of a workgroup.
const LINE = 64u;
// Components of an element's results: the gradient, then the stiffness.
const COMPONENTS = 156u;

@group(0) @binding(0) var<storage, read> positions: array<f32>;
@group(0) @binding(1) var<storage, read> corners: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> rests: array<f32>;
@group(0) @binding(3) var<storage, read_write> results: array<f32>;
@group(0) @binding(4) var<storage, read_write> statuses: array<u32>;

@compute @workgroup_size(LINE)
fn elements(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let element = LINE * group.x + lane;
    let nodes = corners[element];
    var x: array<f32, 12>;
    for (var k = 0u; k < 12u; k++) {
        x[k] = positions[3u * nodes[k / 3u] + k % 3u];
    }
    var rest: array<f32, 10>;
    for (var k = 0u; k < 10u; k++) {
        rest[k] = rests[(10u * group.x + k) * LINE + lane];
    }
    var gradient: array<f32, 12>;
    var K: array<f32, 144>;
    statuses[element] = energy_tetrahedron(energy_example(), x, rest, &gradient, &K);
    for (var k = 0u; k < 12u; k++) {
        results[(COMPONENTS * group.x + k) * LINE + lane] = gradient[k];
    }
    for (var k = 0u; k < 144u; k++) {
        results[(COMPONENTS * group.x + 12u + k) * LINE + lane] = K[k];
    }
}
