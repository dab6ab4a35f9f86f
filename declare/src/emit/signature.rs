//! What is written about the functions of a file: arguments, results and a sentence, in `functions.txt`.

/// Functions, an empty line between two. A number has a name, an array also its length; `?` is a truth
/// value, `status` the four of a status. A function of `p`, the parameters, belongs to the energy, the others
/// to all.
const FUNCTIONS: &str = include_str!("functions.txt");

/// Arguments and results of a function, and the comment above it.
pub(super) struct Signature {
    pub(super) name: &'static str,
    pub(super) comment: &'static str,
    pub(super) is_of_energy: bool,
    pub(super) inputs: Vec<Value>,
    /// Results that are written through pointers.
    pub(super) outputs: Vec<Value>,
    pub(super) returned: Returned,
}

/// A number or an array.
#[derive(Clone, Copy)]
pub(super) struct Value {
    pub(super) name: &'static str,
    /// Length of an array.
    pub(super) length: Option<usize>,
}

impl Value {
    pub(super) fn count(&self) -> usize {
        self.length.unwrap_or(1)
    }
}

/// What a function returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Returned {
    Nothing,
    /// Its first result, if there is no truth value.
    Number,
    /// Its last result.
    Truth(&'static str),
    Status,
}

impl Signature {
    /// All functions.
    pub(super) fn all() -> Vec<Self> {
        FUNCTIONS.trim_end().split("\n\n").filter_map(Self::parse).collect()
    }

    fn parse(text: &'static str) -> Option<Self> {
        let (first, comment) = text.split_once('\n')?;
        let (call, results) = first.split_once(" -> ")?;
        let (name, inputs) = call.strip_suffix(')')?.split_once('(')?;
        let is_of_energy = inputs == "p" || inputs.starts_with("p, ");
        let values = |text: &'static str| text.split(", ").filter(|one| *one != "p").map(value);
        let mut outputs: Vec<Value> = values(results).collect();
        let last = outputs.last()?.name;
        let returned = match last.strip_suffix('?') {
            Some(truth) => Returned::Truth(truth),
            None if last == "status" => Returned::Status,
            None if outputs[0].length.is_none() => Returned::Number,
            None => Returned::Nothing,
        };
        match returned {
            Returned::Status | Returned::Truth(_) => outputs.truncate(outputs.len() - 1),
            Returned::Number => _ = outputs.remove(0),
            Returned::Nothing => {}
        }
        Some(Self { name, comment, is_of_energy, inputs: values(inputs).collect(), outputs, returned })
    }

    /// The number of arguments and results.
    pub(super) fn size(&self) -> usize {
        self.inputs.iter().chain(&self.outputs).map(Value::count).sum()
    }

    /// The array or number of the outputs that a result is in, and its place there; `None` for the one that
    /// is returned.
    pub(super) fn place(&self, result: usize) -> Option<(usize, usize)> {
        let result = match self.returned {
            Returned::Number => result.checked_sub(1)?,
            _ => result,
        };
        place(&self.outputs, result)
    }

    /// True if a result is a truth value.
    pub(super) fn is_truth(&self, result: usize) -> bool {
        !matches!(self.returned, Returned::Number | Returned::Nothing) && self.place(result).is_none()
    }
}

/// The value that a number is in, and its place there.
pub(super) fn place(values: &[Value], mut number: usize) -> Option<(usize, usize)> {
    for (k, value) in values.iter().enumerate() {
        if number < value.count() {
            return Some((k, number));
        }
        number -= value.count();
    }
    None
}

fn value(text: &'static str) -> Value {
    let array =
        text.split_once('[').and_then(|(name, end)| Some((name, end.strip_suffix(']')?.parse().ok()?)));
    match array {
        Some((name, length)) => Value { name, length: Some(length) },
        None => Value { name: text, length: None },
    }
}
