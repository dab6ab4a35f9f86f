//! The viewer of piola behind a page without a server: the driver and the conversation of `piola view`, in
//! WebAssembly.
//!
//! What passes the border is text and numbers, as `piola-viewer` describes them. The page requests [`room`]
//! and writes its input there, a scene for [`begin`] or a message for [`hear`]; and lets the driver work with
//! [`turn`], which returns the time for which there is nothing to do. Messages for the page wait in a queue:
//! [`next`] takes the first one, whose [`length`] bytes are at [`message`].

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use piola_scenes::error::Error;
use piola_scenes::scene::Scene;
use piola_scenes::settings::Settings;
use piola_viewer::conversation::Conversation;
use piola_viewer::driver::Driver;
use piola_viewer::protocol::Words;
use piola_viewer::session::Session;
use piola_viewer::topology;

/// Kinds of messages that [`next`] returns.
const NOTHING: u32 = 0;
const TEXT: u32 = 1;
const NUMBERS: u32 = 2;

/// State between two calls.
#[derive(Default)]
struct Border {
    /// Message written by the page.
    heard: Vec<u8>,
    behind: Option<(Driver, Conversation)>,
    /// Queue of messages for the page.
    words: VecDeque<Words>,
    /// Message that the page reads now.
    said: Arc<[u8]>,
}

thread_local! {
    static BORDER: RefCell<Border> = RefCell::default();
}

// SAFETY: the page gives a function of this type, or the module cannot be instantiated.
#[link(wasm_import_module = "browser")]
unsafe extern "C" {
    /// Milliseconds since some moment that stays the same.
    safe fn now() -> f64;
}

/// Time by the clock of the page: one that is not a number, or runs backwards, stands still.
fn clock() -> Duration {
    Duration::try_from_secs_f64(1e-3 * now()).unwrap_or_default()
}

/// Allocates memory for `length` bytes, and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    BORDER.with_borrow_mut(|border| {
        border.heard.clear();
        border.heard.resize(length, 0);
        border.heard.as_mut_ptr()
    })
}

/// Starts the scene whose name is in the buffer. Returns false if there is none; the reason is then the next
/// message.
#[unsafe(no_mangle)]
pub extern "C" fn begin() -> bool {
    BORDER.with_borrow_mut(|border| match session(&String::from_utf8_lossy(&border.heard)) {
        Ok(session) => {
            border.words = [Words::Binary(topology(&session.play().geometry).into())].into();
            border.behind = Some((Driver::new(clock, None, session, None), Conversation::new(0)));
            true
        }
        Err(error) => {
            border.words = [Words::Text(error.to_string().into())].into();
            false
        }
    })
}

fn session(scene: &str) -> Result<Session, Error> {
    Session::new(Settings::new(Scene::find(scene)?))
}

/// Handles the message in the buffer. Returns false if it is malformed; the reason is then the next message.
#[unsafe(no_mangle)]
pub extern "C" fn hear() -> bool {
    BORDER.with_borrow_mut(|Border { heard, behind, words, .. }| {
        let Some((driver, conversation)) = behind else { return false };
        match conversation.order(&String::from_utf8_lossy(heard)) {
            Ok(order) => {
                order.into_iter().for_each(|order| driver.obey(order));
                true
            }
            Err(reason) => {
                *words = [Words::Text(reason.into())].into();
                false
            }
        }
    })
}

/// Makes a step if one is due. Returns the milliseconds until the next one; ∞ if none is due.
#[unsafe(no_mangle)]
pub extern "C" fn turn() -> f64 {
    BORDER.with_borrow_mut(|Border { behind, words, .. }| {
        let Some((driver, conversation)) = behind else { return f64::INFINITY };
        driver.turn();
        words.extend(conversation.words());
        driver.rest().map_or(f64::INFINITY, |rest| 1e3 * rest.as_secs_f64())
    })
}

/// Takes the next message from the queue. Returns its kind: 0 for none, 1 for text, 2 for numbers.
#[unsafe(no_mangle)]
pub extern "C" fn next() -> u32 {
    BORDER.with_borrow_mut(|border| {
        let (kind, said): (u32, Arc<[u8]>) = match border.words.pop_front() {
            None => (NOTHING, Arc::default()),
            Some(Words::Text(text)) => (TEXT, text.into()),
            Some(Words::Binary(numbers)) => (NUMBERS, numbers),
        };
        border.said = said;
        kind
    })
}

/// Address of the last message taken.
#[unsafe(no_mangle)]
pub extern "C" fn message() -> *const u8 {
    BORDER.with_borrow(|border| border.said.as_ptr())
}

/// Length of the message that was taken last, in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    BORDER.with_borrow(|border| border.said.len())
}
