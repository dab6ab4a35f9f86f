//! The page: a few files inside the program, and the headers that keep it to itself.

use super::request::Denied;

/// A file of the page.
#[derive(Debug)]
struct File {
    path: &'static str,
    kind: &'static str,
    content: &'static str,
}

const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const PLAIN: &str = "text/plain; charset=utf-8";

macro_rules! files {
    ($($path:literal is $kind:ident in $name:literal),+ $(,)?) => {
        const FILES: &[File] = &[$(
            File { path: $path, kind: $kind, content: include_str!(concat!("../../assets/view/", $name)) },
        )+];
    };
}

files! {
    "/" is HTML in "index.html",
    "/style.css" is CSS in "style.css",
    "/page.js" is SCRIPT in "page.js",
    "/link.js" is SCRIPT in "link.js",
    "/stage.js" is SCRIPT in "stage.js",
    "/orbit.js" is SCRIPT in "orbit.js",
    "/drag.js" is SCRIPT in "drag.js",
    "/panel.js" is SCRIPT in "panel.js",
    "/slider.js" is SCRIPT in "slider.js",
    "/three/three.module.min.js" is SCRIPT in "three/three.module.min.js",
    "/three/three.core.min.js" is SCRIPT in "three/three.core.min.js",
    "/three/LICENSE" is PLAIN in "three/LICENSE",
}

/// The answer to a request for a file: header and content.
pub(super) fn file(path: &str) -> (String, &'static str) {
    match FILES.iter().find(|file| file.path == path) {
        Some(file) => (header("200 OK", file.kind, file.content.len()), file.content),
        None => denied(Denied("404 Not Found", "there is no such file")),
    }
}

/// The answer to a request that is denied.
pub(super) fn denied(Denied(status, reason): Denied) -> (String, &'static str) {
    (header(status, PLAIN, reason.len()), reason)
}

/// The header of an answer: the page may load nothing from elsewhere, send nothing there, and be in no other page's frame.
fn header(status: &str, kind: &str, length: usize) -> String {
    format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nConnection: close\r\n\
         Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n\
         Cross-Origin-Resource-Policy: same-origin\r\nContent-Security-Policy: default-src 'none'; \
         script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; base-uri 'none'; \
         form-action 'none'; frame-ancestors 'none'\r\n\r\n"
    )
}
