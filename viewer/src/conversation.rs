//! Conversation of a page with a driver: its messages become orders, and answers become messages for it.

use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use crate::driver::{Answer, Order};
use crate::protocol::{Act, Message};
use crate::typed;

/// Bound of the numbers that a page gives its drags; the number of its conversation distinguishes them from
/// those of other pages.
const DRAGS: u64 = 1 << 32;

/// A message for a page.
#[derive(Clone, Debug)]
pub enum Words {
    /// JSON.
    Text(Arc<str>),
    /// Numbers, as [`topology`](crate::topology) describes them.
    Binary(Arc<[u8]>),
}

/// The conversation with one page.
#[derive(Debug)]
pub struct Conversation {
    drags: Range<u64>,
    answer: Sender<Answer>,
    answers: Receiver<Answer>,
    /// True if the page has requested a frame that has not come.
    waits: bool,
    /// The state and the revision of the setup that the page has seen last.
    seen: u64,
    revision: u64,
}

impl Conversation {
    /// A conversation with a number that is unique in the driver.
    #[must_use]
    pub fn new(number: u64) -> Self {
        let (answer, answers) = channel();
        let drags = number * DRAGS..(number + 1) * DRAGS;
        Self { drags, answer, answers, waits: false, seen: 0, revision: 0 }
    }

    /// The first number for a conversation none of whose drags is among these.
    #[must_use]
    pub fn after(drags: impl Iterator<Item = u64>) -> u64 {
        drags.map(|drag| drag / DRAGS + 1).max().unwrap_or(0)
    }

    /// True if the page has requested a frame that has not come.
    #[must_use]
    pub fn waits(&self) -> bool {
        self.waits
    }

    /// The order that ends all drags of the page.
    #[must_use]
    pub fn leave(&self) -> Order {
        Order::Leave { drags: self.drags.clone() }
    }

    /// The order in a message of the page; `None` if it requests the frame again that is already under way,
    /// and if the energy in it is refused.
    ///
    /// An energy is compiled here, by the caller, and not by the driver, so that the body keeps moving.
    ///
    /// # Errors
    /// The reason why it is not a message.
    pub fn order(&mut self, text: &str) -> Result<Option<Order>, String> {
        let answer = self.answer.clone();
        Ok(match Message::parse(text)? {
            Message::Act(act) => self.act(act, answer)?,
            Message::Run(run) => Some(Order::Run(run)),
            Message::Look {} if self.waits => None,
            Message::Look {} => {
                self.waits = true;
                Some(Order::Look { seen: self.seen, answer })
            }
        })
    }

    fn act(&self, act: Act, answer: Sender<Answer>) -> Result<Option<Order>, String> {
        let act = self.as_own(act)?;
        let energy = match &act {
            Act::Energy { text, parameters } => match typed::energy(text, parameters) {
                Ok(energy) => Some(energy),
                Err(error) => {
                    // The other end is in this conversation.
                    let _ = answer.send(Answer::refusal(&act, error));
                    return Ok(None);
                }
            },
            _ => None,
        };
        Ok(Some(Order::Act { act, energy, answer }))
    }

    /// Messages for the page in the answers that have come.
    pub fn words(&mut self) -> Vec<Words> {
        let mut words = Vec::new();
        while let Ok(answer) = self.answers.try_recv() {
            match answer {
                Answer::Refused(text) => words.push(Words::Text(text)),
                Answer::Frame(frame) => {
                    self.waits = false;
                    self.seen = frame.state;
                    if self.revision != frame.revision {
                        self.revision = frame.revision;
                        words.push(Words::Text(frame.setup));
                    }
                    words.extend([Words::Text(frame.figures), Words::Binary(frame.positions)]);
                }
            }
        }
        words
    }

    /// Numbers the drag so that it belongs to this page.
    fn as_own(&self, act: Act) -> Result<Act, String> {
        let own = |drag: u64| match drag < DRAGS {
            true => Ok(self.drags.start + drag),
            false => Err(format!("the drag {drag} is not below {DRAGS}")),
        };
        Ok(match act {
            Act::Pull { drag, vertex, target } => Act::Pull { drag: own(drag)?, vertex, target },
            Act::Release { drag } => Act::Release { drag: own(drag)? },
            act => act,
        })
    }
}
