//! Conversation of a page with a driver: its messages become orders, and answers become messages for it.

use std::ops::Range;
use std::sync::mpsc::{Receiver, Sender, channel};

use crate::driver::{Answer, Order, Seen};
use crate::protocol::{Act, Message, Words};
use crate::typed;

/// Bound of the numbers that a page gives its drags; the number of its conversation distinguishes them from
/// those of other pages.
const DRAGS: u64 = 1 << 32;

/// The conversation with one page.
#[derive(Debug)]
pub struct Conversation {
    drags: Range<u64>,
    answer: Sender<Answer>,
    answers: Receiver<Answer>,
    /// True if the page has requested a frame that has not come.
    pub waits: bool,
    seen: Seen,
}

impl Conversation {
    /// A conversation with a number that is unique in the driver.
    #[must_use]
    pub fn new(number: u64) -> Self {
        let (answer, answers) = channel();
        let drags = number * DRAGS..(number + 1) * DRAGS;
        Self { drags, answer, answers, waits: false, seen: Seen::default() }
    }

    /// The first number for a conversation none of whose drags is among these.
    #[must_use]
    pub fn after(drags: impl Iterator<Item = u64>) -> u64 {
        drags.map(|drag| drag / DRAGS + 1).max().unwrap_or(0)
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
        let message: Message = serde_json::from_str(text).map_err(|error| error.to_string())?;
        Ok(match message {
            Message::Act(act) => self.act(act)?,
            Message::Run(run) => Some(Order::Run(run)),
            Message::Look {} if self.waits => None,
            Message::Look {} => {
                self.waits = true;
                Some(Order::Look { seen: self.seen, answer: self.answer.clone() })
            }
        })
    }

    fn act(&self, mut act: Act) -> Result<Option<Order>, String> {
        if let Act::Pull { drag, .. } | Act::Release { drag } = &mut act {
            if *drag >= DRAGS {
                return Err(format!("the drag {drag} is not below {DRAGS}"));
            }
            *drag += self.drags.start;
        }
        let energy = match &act {
            Act::Energy { text, parameters } => match typed::energy(text, parameters) {
                Ok(energy) => Some(energy),
                Err(error) => {
                    // The other end is in this conversation.
                    let _ = self.answer.send(Answer::refusal(&act, error));
                    return Ok(None);
                }
            },
            _ => None,
        };
        Ok(Some(Order::Act { act, energy, answer: self.answer.clone() }))
    }

    /// Messages for the page in the answers that have come.
    pub fn words(&mut self) -> Vec<Words> {
        let mut words = Vec::new();
        for answer in self.answers.try_iter() {
            if let Some(seen) = answer.seen {
                (self.waits, self.seen) = (false, seen);
            }
            words.extend(answer.words);
        }
        words
    }
}
