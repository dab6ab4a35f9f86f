//! The socket of a page: turns its messages into orders, and sends back the answers.
//!
//! One thread reads and writes in turn. While a page waits for a frame, it listens in short turns; otherwise
//! in long ones. A paused page may be silent for hours. One that its browser has stopped keeps its place
//! until the connection ends.

use std::io::{ErrorKind, Read};
use std::net::TcpStream;
use std::sync::mpsc::SyncSender;
use std::time::{Duration, Instant};

use piola_viewer::conversation::Conversation;
use piola_viewer::driver::Order;
use piola_viewer::protocol::Words;
use tungstenite::handshake::server::{Response, write_response};
use tungstenite::protocol::frame::coding::CloseCode;
use tungstenite::protocol::{CloseFrame, Role, WebSocketConfig};
use tungstenite::{Bytes, Error as SocketError, Message as Envelope, Utf8Bytes, WebSocket};

/// The longest message that makes sense is a declaration with its parameters.
const MAX_MESSAGE: usize = 16 * 1024;
/// Longest extra wait of a page that waits for a frame.
const TURN: Duration = Duration::from_millis(3);
/// Longest wait for anything else while no page waits for a frame.
const LONG_TURN: Duration = Duration::from_millis(200);
/// Time for which a page that is disconnected may still send, so that it receives the reason.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// Serves a page until it is closed, goes away or breaks the protocol; none of these is an error.
pub(super) fn serve(
    mut stream: TcpStream,
    response: &Response,
    number: u64,
    topology: Bytes,
    orders: &SyncSender<Order>,
) {
    if stream.set_nodelay(true).is_err() || write_response(&mut stream, response).is_err() {
        return;
    }
    let limits = WebSocketConfig::default()
        .max_message_size(Some(MAX_MESSAGE))
        .max_frame_size(Some(MAX_MESSAGE))
        .read_buffer_size(MAX_MESSAGE);
    let socket = WebSocket::from_raw_socket(stream, Role::Server, Some(limits));
    let mut connection = Connection { socket, orders, conversation: Conversation::new(number) };
    if connection.send(Envelope::Binary(topology)).is_ok() {
        let end = connection.talk();
        connection.part(end);
    }
}

struct Connection<'a> {
    socket: WebSocket<TcpStream>,
    orders: &'a SyncSender<Order>,
    conversation: Conversation,
}

impl Drop for Connection<'_> {
    fn drop(&mut self) {
        // Where the driver is gone, so are its pulls.
        let _ = self.orders.send(self.conversation.leave());
    }
}

/// Reason why a conversation ends.
enum End {
    /// The other side has gone.
    Gone,
    /// The server closes it, with this code and reason.
    Because(CloseCode, String),
}

impl Connection<'_> {
    fn talk(&mut self) -> End {
        loop {
            if let Err(end) = self.listen().and_then(|()| self.reply()) {
                return end;
            }
        }
    }

    /// Takes one message, or none in this turn.
    fn listen(&mut self) -> Result<(), End> {
        let turn = if self.conversation.waits { TURN } else { LONG_TURN };
        let limited = self.socket.get_ref().set_read_timeout(Some(turn)).map_err(SocketError::from);
        match limited.and_then(|()| self.socket.read()) {
            Ok(Envelope::Text(text)) => match self.conversation.order(&text) {
                Ok(Some(order)) => self
                    .orders
                    .send(order)
                    .map_err(|_| End::Because(CloseCode::Away, "the viewer ends".into())),
                Ok(None) => Ok(()),
                Err(reason) => Err(End::Because(CloseCode::Policy, reason)),
            },
            Ok(Envelope::Binary(_)) => Err(End::Because(CloseCode::Unsupported, "messages are text".into())),
            Ok(Envelope::Ping(_) | Envelope::Pong(_) | Envelope::Close(_) | Envelope::Frame(_)) => Ok(()),
            // Errors of systems when a read takes too long.
            Err(SocketError::Io(error))
                if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) =>
            {
                Ok(())
            }
            Err(SocketError::Capacity(error)) => Err(End::Because(CloseCode::Size, error.to_string())),
            Err(SocketError::Utf8(error)) => Err(End::Because(CloseCode::Invalid, error)),
            Err(SocketError::Protocol(error)) => Err(End::Because(CloseCode::Protocol, error.to_string())),
            Err(_) => Err(End::Gone),
        }
    }

    fn reply(&mut self) -> Result<(), End> {
        for words in self.conversation.words() {
            self.send(match words {
                Words::Text(text) => Envelope::Text(Utf8Bytes::from(&*text)),
                Words::Binary(numbers) => Envelope::Binary(Bytes::from_owner(numbers)),
            })?;
        }
        Ok(())
    }

    fn send(&mut self, envelope: Envelope) -> Result<(), End> {
        self.socket.send(envelope).map_err(|_| End::Gone)
    }

    /// Sends the reason and waits until the other side has read it: unread data would make the system cut the
    /// line.
    fn part(&mut self, end: End) {
        let End::Because(code, reason) = end else { return };
        let reason = reason.chars().take(100).collect::<String>();
        if self.socket.close(Some(CloseFrame { code, reason: reason.into() })).is_err() {
            return;
        }
        // The bytes themselves: a socket must not be read on after an error.
        let (stream, mut words, start) = (self.socket.get_mut(), [0; 4096], Instant::now());
        // If it fails, the limit of a turn stays.
        let _ = stream.set_read_timeout(Some(LAST_WORDS));
        while start.elapsed() < LAST_WORDS && stream.read(&mut words).is_ok_and(|count| count > 0) {}
    }
}
