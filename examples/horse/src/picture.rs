//! Frames of a surface as one picture in SVG.

type Vector = [f64; 3];

/// Width and height of a frame, and length of a metre, in units of the picture.
const FRAME: [f64; 2] = [1200.0, 1000.0];
const METRE: f64 = 440.0;
/// Direction to the light.
const LIGHT: Vector = [-0.45, 0.75, 0.48];

/// Draws a surface at several times, three frames a row.
pub(crate) fn svg(frames: &[(f64, Vec<Vector>)], triangles: &[[usize; 3]]) -> String {
    let [width, height] = [3.0 * FRAME[0], frames.len().div_ceil(3) as f64 * FRAME[1]];
    let start = "<svg xmlns='http://www.w3.org/2000/svg' stroke-width='2' font-size='50'";
    let mut svg = format!("{start} width='1350' viewBox='0 0 {width} {height}'><style>");
    for (shade, name) in ('a'..='z').enumerate() {
        let [r, g, b] = [52, 34, 22].map(|c| c + c * 15 * shade / 100);
        svg += &format!(".{name}{{fill:rgb({r},{g},{b});stroke:rgb({r},{g},{b})}}");
    }
    svg += "</style><rect width='100%' height='100%' fill='#f1f1ef'/>";
    for (number, (time, vertices)) in frames.iter().enumerate() {
        let [x, y] = [number % 3, number / 3].map(|place| place as f64);
        let ([w, h], [x, y]) = (FRAME, [x * FRAME[0], y * FRAME[1]]);
        svg += &format!("<svg x='{x}' y='{y}' width='{w}' height='{h}' viewBox='-550 -850 {w} {h}'>");
        draw(&mut svg, vertices, triangles);
        svg += &format!("<text x='-500' y='-780'>{time:.2} s</text></svg>");
    }
    svg + "</svg>\n"
}

/// Draws the shadow on the ground y = 0, then the triangles that face the camera, the farthest first, each in
/// one of 26 shades.
fn draw(svg: &mut String, vertices: &[Vector], triangles: &[[usize; 3]]) {
    let shadow = |[x, y, z]: Vector| seen([x - y * LIGHT[0] / LIGHT[1], 0.0, z - y * LIGHT[2] / LIGHT[1]]);
    let mut drawn = Vec::new();
    *svg += "<path fill='#7b8291' fill-opacity='0.5' d='";
    for triangle in triangles {
        let corners = triangle.map(|vertex| vertices[vertex]);
        let up = normal(corners);
        let brightness: f64 = (0..3).map(|k| up[k] * LIGHT[k]).sum();
        if brightness > 0.0 {
            *svg += &outline(corners.map(shadow));
        }
        let corners = corners.map(seen);
        if normal(corners)[2] > 0.0 {
            let shade = 25.0 * (0.25 + 0.15 * up[1] + 0.6 * brightness.max(0.0));
            drawn.push((corners.iter().map(|x| x[2]).sum::<f64>(), shade as u8, outline(corners)));
        }
    }
    *svg += "'/>";
    drawn.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, shade, outline) in drawn {
        *svg += &format!("<path class='{}' d='{outline}'/>", char::from(b'a' + shade));
    }
}

/// A point in the directions of the camera: to the right, up, and towards it.
fn seen([x, y, z]: Vector) -> Vector {
    let ((sin, cos), (up, along)) = (0.6_f64.sin_cos(), 0.22_f64.sin_cos());
    let (x, z) = (x * cos - z * sin, x * sin + z * cos);
    [x, y * along - z * up, y * up + z * along]
}

fn outline(corners: [Vector; 3]) -> String {
    let [a, b, c] = corners.map(|[x, y, _]| [x, -y].map(|x| (METRE * x).round() as i32));
    format!("M{} {}l{} {} {} {}z", a[0], a[1], b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1])
}

/// Unit normal of a triangle; zero if the triangle has no area.
fn normal([a, b, c]: [Vector; 3]) -> Vector {
    let [u, v] = [b, c].map(|x| [x[0] - a[0], x[1] - a[1], x[2] - a[2]]);
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    n.map(|x| x / n.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE))
}
