//! A page without a browser.

use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// A page without a browser.
pub(crate) struct Page {
    pub(crate) socket: WebSocket<TcpStream>,
    pub(crate) figures: Value,
    pub(crate) setup: Value,
    pub(crate) refusals: Vec<Value>,
    pub(crate) positions: Vec<f32>,
}

impl Page {
    /// Opens the socket of the page at an address.
    pub(crate) fn open(url: &str) -> Self {
        Self::try_open(url).expect("a page's own socket")
    }

    /// Opens the socket unless it is refused.
    pub(crate) fn try_open(url: &str) -> Option<Self> {
        let (address, query) = parts(url);
        let stream = TcpStream::connect(address).ok()?;
        // No answer in so long is none at all.
        stream.set_read_timeout(Some(Duration::from_secs(20))).ok()?;
        let mut request = format!("ws://{address}/socket{query}").into_client_request().ok()?;
        let origin = format!("http://{address}").parse().ok()?;
        request.headers_mut().insert("Origin", origin);
        let (socket, _) = tungstenite::client(request, stream).ok()?;
        let mut page = Self {
            socket,
            figures: Value::Null,
            setup: Value::Null,
            refusals: Vec::new(),
            positions: Vec::new(),
        };
        let topology = page.socket.read().ok()?.into_data();
        assert_eq!(word(&topology, 0), 0, "topology comes first");
        assert_eq!(topology.len() as u32, 12 + 12 * word(&topology, 1) + 8 * word(&topology, 2));
        Some(page)
    }

    pub(crate) fn send(&mut self, message: Value) {
        self.socket.send(Message::text(message.to_string())).expect("somebody listens");
    }

    /// The next frame.
    pub(crate) fn look(&mut self) -> &Value {
        self.send(json!({ "look": {} }));
        loop {
            match self.socket.read().expect("a frame") {
                Message::Text(text) => {
                    let told: Value = serde_json::from_str(&text).expect("JSON");
                    match told.as_object().and_then(|object| object.iter().next()) {
                        Some((kind, figures)) if kind == "figures" => self.figures = figures.clone(),
                        Some((kind, setup)) if kind == "setup" => self.setup = setup.clone(),
                        Some((kind, refusal)) if kind == "refused" => self.refusals.push(refusal.clone()),
                        _ => panic!("{text}"),
                    }
                }
                Message::Binary(data) => {
                    let coordinates = data[12..].chunks_exact(4);
                    let coordinates = coordinates.map(|x| f32::from_le_bytes([x[0], x[1], x[2], x[3]]));
                    self.positions = coordinates.collect();
                    assert_eq!(word(&data, 0), 1);
                    assert_eq!(self.positions.len() as u32, 3 * (word(&data, 1) + word(&data, 2)));
                    assert!(self.positions.iter().all(|x| x.is_finite()));
                    return &self.figures;
                }
                other => panic!("{other:?}"),
            }
        }
    }

    /// Looks until it is so.
    #[track_caller]
    pub(crate) fn wait(&mut self, what: &str, is_so: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        while !is_so(self) {
            assert!(start.elapsed() < Duration::from_secs(20), "{what}: {}", self.figures);
            self.look();
        }
    }

    pub(crate) fn frame(&self) -> u64 {
        self.figures["frame"].as_u64().unwrap_or_default()
    }

    pub(crate) fn vertex(&self, vertex: usize) -> [f32; 3] {
        std::array::from_fn(|c| self.positions[3 * vertex + c])
    }
}

fn word(data: &[u8], index: usize) -> u32 {
    let bytes = &data[4 * index..][..4];
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}

/// The part of a page's address that names the machine and the port, and the part behind the path.
pub(crate) fn parts(url: &str) -> (&str, &str) {
    url.strip_prefix("http://").and_then(|rest| rest.split_once('/')).expect("an address")
}
