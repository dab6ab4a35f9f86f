//! The page: a few files inside the program, and the headers that keep it to itself.

/// Files with their names.
macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        &[$(($name, include_str!(concat!("../../assets/view/", $name)))),+]
    };
}

const FILES: &[(&str, &str)] = files![
    "index.html",
    "style.css",
    "page.js",
    "link.js",
    "line.js",
    "stage.js",
    "orbit.js",
    "drag.js",
    "panel.js",
    "editor.js",
    "slider.js",
    "three/three.module.min.js",
    "three/three.core.min.js",
    "three/LICENSE",
];

/// An answer to a request: header and content.
pub(super) type Answer = (String, &'static str);

/// The answer to a request for a file.
pub(super) fn file(path: &str) -> Answer {
    let wanted = if path == "/" { "index.html" } else { path.trim_start_matches('/') };
    let Some((name, content)) = FILES.iter().find(|(name, _)| *name == wanted) else {
        return denied("404 Not Found", "there is no such file");
    };
    let kind = match name.rsplit('.').next() {
        Some("html") => "html",
        Some("css") => "css",
        Some("js") => "javascript",
        _ => "plain",
    };
    (header("200 OK", kind, content.len()), content)
}

/// The answer to a request that is not granted, with status and reason.
pub(super) fn denied(status: &str, reason: &'static str) -> Answer {
    (header(status, "plain", reason.len()), reason)
}

/// The header of an answer: the page may load nothing from elsewhere, send nothing there, and be in no other
/// page's frame.
fn header(status: &str, kind: &str, length: usize) -> String {
    format!(
        "HTTP/1.1 {status}\r\nContent-Type: text/{kind}; charset=utf-8\r\nContent-Length: {length}\r\nConnection: close\r\n\
         Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n\
         Cross-Origin-Resource-Policy: same-origin\r\nContent-Security-Policy: default-src 'none'; \
         script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; base-uri 'none'; \
         form-action 'none'; frame-ancestors 'none'\r\n\r\n"
    )
}
