// The lobe of the formulas at each point.

struct Result {
    a: f32,
    b: f32,
    albedo: f32,
    rest: f32,
}

@group(0) @binding(0) var<storage, read_write> results: array<Result>;
@group(0) @binding(1) var<storage, read> points: array<vec2<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let lobe = sheen_fit_lobe(points[id.x].x, points[id.x].y);
    let m = lobe.m_inv;
    // 0 where the matrix has the rows (a,0,b), (0,a,0), (0,0,1).
    let rest = abs(m[1].y - m[0].x) + abs(m[2].z - 1.0) + abs(m[0].y) + abs(m[0].z) + abs(m[1].x) + abs(m[1].z) + abs(m[2].y);
    results[id.x] = Result(m[0].x, m[2].x, lobe.albedo, rest);
}
