//! The statements of a program.
//!
//! A number that is used once is written where it is used, unless the line becomes long; a product within a
//! sum is not, because compilers may fuse the two. Results are written into the outputs where they are
//! computed, also by calls: a branch of which both sides are arrays of calls is two calls with one output.

use std::collections::{HashMap, HashSet};
use std::fmt::Write;

use piola::__private::record::{Binary, Id, RecordedOperation, RecordedProgram, Unary};

use super::Printer;
use crate::emit::language::{Kind, Language};
use crate::emit::signature::{Returned, Signature, Value, place};
use crate::emit::steps::{Step, Steps, guarded};

/// Characters of an expression that is written where it is used.
const LONGEST: usize = 90;

/// The user of a number that a function returns.
const RETURNED: Id = Id::MAX;

/// The text of a number, and whether it needs parentheses within an expression.
type Text = (String, bool);

/// Statements of a program.
pub(super) struct Body<'a> {
    printer: &'a Printer<'a>,
    program: &'a RecordedProgram,
    signature: &'a Signature,
    steps: Steps,
    /// Number of times that each number is written, except as a result.
    uses: Vec<u32>,
    /// An operation that uses each number.
    user: Vec<Id>,
    /// Outputs that each number is written to, as text.
    targets: HashMap<Id, Vec<String>>,
    /// Outputs of calls that are outputs of this function, and those that this function has variables for.
    arrays: HashMap<(Id, usize), String>,
    /// Calls with outputs that another call overwrites.
    overwritten: HashSet<Id>,
    texts: HashMap<Id, Text>,
    names: HashSet<String>,
    /// Numbers that are written to outputs, with their places.
    results: Vec<(String, Id)>,
    /// Truth values that are returned.
    flags: &'a [Id],
}

impl<'a> Body<'a> {
    pub(super) fn new(
        printer: &'a Printer<'a>,
        program: &'a RecordedProgram,
        signature: &'a Signature,
    ) -> Self {
        let count = program.operations.len();
        let names = signature.inputs.iter().chain(&signature.outputs).map(|value| value.name.to_owned());
        let mut body = Self {
            printer,
            program,
            signature,
            steps: Steps::of(program),
            uses: vec![0; count],
            user: vec![0; count],
            targets: HashMap::new(),
            arrays: HashMap::new(),
            overwritten: HashSet::new(),
            texts: HashMap::new(),
            names: names.chain(["p".to_owned()]).collect(),
            results: Vec::new(),
            flags: &[],
        };
        let steps = std::mem::take(&mut body.steps.all);
        body.count_uses(&steps);
        for (k, &result) in program.results.iter().enumerate() {
            if signature.place(k).is_none() {
                let source = body.source(result) as usize;
                (body.uses[source], body.user[source]) = (body.uses[source] + 1, RETURNED);
            }
        }
        let mut rest = &program.results[usize::from(signature.returned == Returned::Number)..];
        for output in &signature.outputs {
            let (ids, others) = rest.split_at(output.count());
            if output.length.is_some() {
                body.settle(ids, output.name);
            }
            for (k, &id) in ids.iter().enumerate() {
                let element = body.element(output, k, true);
                body.targets.entry(body.source(id)).or_default().push(element.clone());
                body.results.push((element, id));
            }
            rest = others;
        }
        body.flags = rest;
        body.steps.all = steps;
        body
    }

    fn language(&self) -> &'a Language {
        &self.printer.language
    }

    fn operation(&self, id: Id) -> &'a RecordedOperation {
        &self.program.operations[id as usize]
    }

    /// The call that returns this number, if one does; else the number itself.
    fn source(&self, id: Id) -> Id {
        match *self.operation(id) {
            RecordedOperation::Part(call, k) if self.callee(call).place(k).is_none() => call,
            _ => id,
        }
    }

    /// The function that an operation calls.
    fn callee(&self, call: Id) -> &'a Signature {
        match self.operation(call) {
            RecordedOperation::Call(name, _) => &self.printer.file.signatures[name],
            _ => self.signature,
        }
    }

    fn count_uses(&mut self, steps: &[Step]) {
        for step in steps {
            match step {
                Step::Compute(id) => self.operation(*id).for_each_operand(|operand| {
                    let source = self.source(operand) as usize;
                    self.uses[source] += 1;
                    self.user[source] = *id;
                }),
                Step::Branch { mask, selections, inner } => {
                    let values = selections.iter().flat_map(|(_, values)| values);
                    for &id in values.chain([mask]) {
                        let source = self.source(id) as usize;
                        self.uses[source] += 1;
                        self.user[source] = selections[0].0;
                    }
                    inner.iter().for_each(|inner| self.count_uses(inner));
                }
            }
        }
    }

    /// Makes an output of a call that of this function where it has these numbers, or where a branch selects
    /// them.
    fn settle(&mut self, ids: &[Id], name: &str) {
        if let Some(output) = self.output_of_call(ids) {
            self.arrays.entry(output).or_insert_with(|| name.to_owned());
            return;
        }
        let branches = ids.iter().map(|&id| guarded(self.program, id));
        let Some(branches) = branches.collect::<Option<Vec<_>>>() else { return };
        let mask = branches[0].0;
        if branches.iter().any(|one| one.0 != mask) || ids.iter().any(|id| self.texts.contains_key(id)) {
            return;
        }
        for (k, &id) in ids.iter().enumerate() {
            self.texts.insert(id, (self.language().element(name, k, true), false));
        }
        let sides = [true, false].map(|holds| {
            branches.iter().map(|&(_, yes, no)| if holds { yes } else { no }).collect::<Vec<_>>()
        });
        let is_inside = |side: usize| {
            let condition = (mask, side == 0);
            self.steps.needed[self.source_of_array(&sides[side]) as usize].contains(&condition)
        };
        let are_inside = [is_inside(0), is_inside(1)];
        for (side, values) in sides.iter().enumerate() {
            // What is there before the branch must not be read when the branch has overwritten it.
            let is_free = are_inside[side] || are_inside[1 - side] && self.is_read_before(values, ids, mask);
            if is_free {
                self.settle(values, name);
                if !are_inside[side] {
                    self.overwritten.insert(self.source_of_array(values));
                }
            }
        }
    }

    /// The operation that numbers of an array come from.
    fn source_of_array(&self, ids: &[Id]) -> Id {
        match *self.operation(ids[0]) {
            RecordedOperation::Part(call, _) => call,
            _ => ids[0],
        }
    }

    /// True if these numbers are used before a branch by the mask, and by these selections.
    fn is_read_before(&self, numbers: &[Id], selections: &[Id], mask: Id) -> bool {
        let is_number: HashSet<_> = numbers.iter().collect();
        let first = selections.iter().min().copied().unwrap_or_default();
        self.program.operations.iter().zip(0..).all(|(operation, id)| {
            let mut reads = false;
            operation.for_each_operand(|operand| reads |= is_number.contains(&operand));
            let is_before = id < first && self.steps.needed[id as usize].iter().all(|one| one.0 != mask);
            !reads || is_before || selections.contains(&id)
        }) && !self.program.results.iter().any(|result| is_number.contains(result))
    }

    /// The output of a call that has these numbers and no others.
    fn output_of_call(&self, ids: &[Id]) -> Option<(Id, usize)> {
        let &RecordedOperation::Part(call, first) = self.operation(ids[0]) else { return None };
        let callee = self.callee(call);
        let (output, 0) = callee.place(first)? else { return None };
        let is_next =
            |(k, &id): (usize, &Id)| *self.operation(id) == RecordedOperation::Part(call, first + k);
        let is_whole = callee.outputs[output].length == Some(ids.len());
        (is_whole && ids.iter().enumerate().all(is_next)).then_some((call, output))
    }

    fn element(&self, value: &Value, k: usize, is_output: bool) -> String {
        match value.length {
            Some(_) => self.language().element(value.name, k, is_output),
            None if is_output => format!("*{}", value.name),
            None => value.name.to_owned(),
        }
    }

    /// A name that this function does not have yet.
    fn name(&mut self, wanted: &str, id: Id) -> String {
        let mut name = wanted.to_owned();
        if !self.names.insert(name.clone()) {
            name = format!("{wanted}_{id}");
            self.names.insert(name.clone());
        }
        name
    }

    pub(super) fn statements(&mut self) -> String {
        let mut text = String::new();
        let steps = std::mem::take(&mut self.steps.all);
        self.write(&steps, 1, &mut text);
        for (element, id) in &self.results {
            let value = self.operand(*id);
            // Unless it is there already.
            if value != *element && self.targets.contains_key(&self.source(*id)) {
                let _ = writeln!(text, "    {element} = {value};");
            }
        }
        let returned = match self.signature.returned {
            Returned::Nothing => return text,
            Returned::Number => self.operand(self.program.results[0]),
            Returned::Truth(_) => self.operand(self.flags[0]),
            Returned::Status => {
                let bits = self.flags.iter().enumerate();
                let bits = bits.filter(|&(_, &id)| *self.operation(id) != RecordedOperation::Truth(false));
                let bits: Vec<_> = bits.map(|(k, &id)| self.language().bit(k, &self.atom(id))).collect();
                if bits.is_empty() { "0u".to_owned() } else { bits.join(" | ") }
            }
        };
        let _ = writeln!(text, "    return {returned};");
        text
    }

    fn write(&mut self, steps: &[Step], depth: usize, text: &mut String) {
        let margin = "    ".repeat(depth);
        for step in steps {
            match step {
                Step::Compute(id) => self.compute(*id, &margin, text),
                Step::Branch { mask, selections, inner } => {
                    let mut variables = [Vec::new(), Vec::new()];
                    for &(id, _) in selections {
                        if !self.texts.contains_key(&id) {
                            let name = self.name(&format!("t{id}"), id);
                            variables[usize::from(self.kind(id) == Kind::Truth)].push(name.clone());
                            self.texts.insert(id, (name, false));
                        }
                    }
                    for (kind, names) in [Kind::Number, Kind::Truth].into_iter().zip(&variables) {
                        text.push_str(&self.language().variables(kind, names, &margin));
                    }
                    let [condition, negated] = [self.operand(*mask), format!("!{}", self.atom(*mask))];
                    let mut sides = [String::new(), String::new()];
                    for (k, inner) in inner.iter().enumerate() {
                        self.write(inner, depth + 1, &mut sides[k]);
                        for (id, values) in selections {
                            let (to, value) = (self.operand(*id), self.operand(values[k]));
                            if to != value {
                                let _ = writeln!(sides[k], "{margin}    {to} = {value};");
                            }
                        }
                    }
                    let [yes, no] = &sides;
                    *text += &match (yes.is_empty(), no.is_empty()) {
                        (true, true) => String::new(),
                        (true, false) => format!("{margin}if ({negated}) {{\n{no}{margin}}}\n"),
                        (false, true) => format!("{margin}if ({condition}) {{\n{yes}{margin}}}\n"),
                        _ => {
                            format!("{margin}if ({condition}) {{\n{yes}{margin}}} else {{\n{no}{margin}}}\n")
                        }
                    };
                }
            }
        }
    }

    /// Writes an operation, or keeps its text for the place where it is used.
    fn compute(&mut self, id: Id, margin: &str, text: &mut String) {
        let operation = self.operation(id);
        let (value, is_compound) = match operation {
            RecordedOperation::Call(_, arguments) => match self.call(id, arguments, margin, text) {
                Some(value) => (value, false),
                None => return,
            },
            _ => self.language().expression(operation, &|id| self.operand(id), &|id| self.atom(id)),
        };
        let (kind, uses) = (self.kind(id), self.uses[id as usize]);
        let mut reads_overwritten = false;
        operation.for_each_operand(|operand| {
            if let RecordedOperation::Part(call, _) = self.operation(operand) {
                reads_overwritten |= self.overwritten.contains(call);
            }
        });
        let is_call = matches!(operation, RecordedOperation::Call(..));
        let stays = reads_overwritten || is_call && !self.callee(id).outputs.is_empty();
        let is_result = self.targets.contains_key(&id);
        if let (0, Some(targets)) = (uses, self.targets.get(&id)) {
            *text += &self.language().assignment(targets, &value, margin);
            self.texts.insert(id, (targets[0].clone(), false));
            self.targets.remove(&id);
        } else if uses == 1 && !stays && !is_result && self.may_nest(id, value.len()) {
            self.texts.insert(id, (value, is_compound));
        } else if uses > 0 || is_result {
            let name = match self.callee(id).returned {
                Returned::Truth(name) if is_call => self.name(name, id),
                _ => self.name(&format!("t{id}"), id),
            };
            let _ = writeln!(text, "{margin}{}", self.language().constant(kind, &name, &value));
            self.texts.insert(id, (name, false));
        } else {
            let _ = writeln!(text, "{margin}{}{value};", self.language().unused());
        }
    }

    /// True unless an operation is long, or a product within a sum, which a compiler could fuse.
    fn may_nest(&self, id: Id, length: usize) -> bool {
        let user = self.user[id as usize];
        if user == RETURNED {
            return true;
        }
        use RecordedOperation::{Binary as Two, Unary as One};
        let is_product = |id: Id| match *self.operation(id) {
            Two(Binary::Multiply, ..) => true,
            One(Unary::Negate, of) => matches!(self.operation(of), Two(Binary::Multiply, ..)),
            _ => false,
        };
        let is_sum = |id: Id| match *self.operation(id) {
            Two(operator, ..) => matches!(operator, Binary::Add | Binary::Subtract),
            One(Unary::Negate, _) => true,
            _ => false,
        };
        // clang warns of `!f() | !g()`.
        let is_negation = matches!(self.operation(id), RecordedOperation::Not(_))
            && matches!(self.operation(user), RecordedOperation::And(..) | RecordedOperation::Or(..));
        length <= LONGEST && !(is_product(id) && is_sum(user)) && !is_negation
    }

    /// Writes the statements before a call; returns the call, unless it returns nothing.
    fn call(&mut self, id: Id, arguments: &[Id], margin: &str, text: &mut String) -> Option<String> {
        let (language, callee) = (self.language(), self.callee(id));
        let mut list = Vec::new();
        if callee.is_of_energy {
            list.push("p".to_owned());
        }
        let mut rest = arguments;
        for input in &callee.inputs {
            let (these, others) = rest.split_at(input.count());
            rest = others;
            list.push(match input.length {
                None => self.operand(these[0]),
                Some(_) => self.array(these, input.name, id, margin, text),
            });
        }
        let mut variables = Vec::new();
        for (k, output) in callee.outputs.iter().enumerate() {
            let is_own = self.arrays.get(&(id, k)).is_some_and(|name| self.is_output(name));
            if !is_own {
                let name = self.name(output.name, id);
                variables.push(match output.length {
                    Some(length) => language.array(&name, length),
                    None => name.clone(),
                });
                self.arrays.insert((id, k), name);
            }
            let name = &self.arrays[&(id, k)];
            list.push(language.address(name, output.length.is_some(), is_own));
        }
        text.push_str(&language.variables(Kind::Number, &variables, margin));
        let value = format!("{}({})", language.name_of(callee.name, callee.is_of_energy), list.join(", "));
        if callee.returned == Returned::Nothing {
            let _ = writeln!(text, "{margin}{value};");
            return None;
        }
        Some(value)
    }

    fn is_output(&self, name: &str) -> bool {
        self.signature.outputs.iter().any(|output| output.name == name)
    }

    /// Numbers as the argument of a call: an array that has them, or a new one.
    fn array(&mut self, ids: &[Id], wanted: &str, id: Id, margin: &str, text: &mut String) -> String {
        if let Some(output) = self.output_of_call(ids) {
            let name = &self.arrays[&output];
            // An array whose place a function in a branch needs would be in memory before the branch, too.
            let is_copied = margin.len() > 4 && !self.printer.is_inlined(self.callee(id));
            if self.is_output(name) || !is_copied || !self.steps.needed[output.0 as usize].is_empty() {
                return self.language().passed(name, self.is_output(name));
            }
        }
        let is_next = |(&id, k)| *self.operation(id) == RecordedOperation::Argument(k);
        if let RecordedOperation::Argument(first) = *self.operation(ids[0])
            && let Some((k, 0)) = place(&self.signature.inputs, first as usize)
            && self.signature.inputs[k].length == Some(ids.len())
            && ids.iter().zip(first..).all(is_next)
        {
            return self.signature.inputs[k].name.to_owned();
        }
        let numbers: Vec<_> = ids.iter().map(|&id| self.operand(id)).collect();
        let name = self.name(wanted, id);
        let _ = writeln!(text, "{margin}{}", self.language().constant_array(&name, &numbers));
        name
    }

    fn kind(&self, id: Id) -> Kind {
        use RecordedOperation::{And, IsZero, Less, Not, Or, Part, Select, Truth};
        match *self.operation(id) {
            Truth(_) | Less(..) | IsZero(_) | Not(_) | And(..) | Or(..) => Kind::Truth,
            Part(call, k) if self.callee(call).is_truth(k) => Kind::Truth,
            RecordedOperation::Call(..) if matches!(self.callee(id).returned, Returned::Truth(_)) => {
                Kind::Truth
            }
            Select(_, yes, no) if [yes, no].iter().any(|&id| self.kind(id) == Kind::Truth) => Kind::Truth,
            _ => Kind::Number,
        }
    }

    /// An operand by itself.
    fn operand(&self, id: Id) -> String {
        self.text(id).0
    }

    /// An operand within an expression.
    fn atom(&self, id: Id) -> String {
        match self.text(id) {
            (text, true) => format!("({text})"),
            (text, false) => text,
        }
    }

    fn text(&self, id: Id) -> Text {
        let simple = match *self.operation(id) {
            RecordedOperation::Argument(k) => place(&self.signature.inputs, k as usize)
                .map(|(value, k)| self.element(&self.signature.inputs[value], k, false)),
            RecordedOperation::Parameter(k) => Some(self.printer.parameters[k as usize].clone()),
            RecordedOperation::Literal(bits) => {
                let text = self.language().literal(f64::from_bits(bits));
                Some(if text.starts_with('-') { format!("({text})") } else { text })
            }
            RecordedOperation::Truth(truth) => Some(self.language().truth(truth)),
            RecordedOperation::Part(call, k) => self.callee(call).place(k).and_then(|(output, k)| {
                let name = self.arrays.get(&(call, output))?;
                Some(match self.callee(call).outputs[output].length {
                    Some(_) => self.language().element(name, k, self.is_output(name)),
                    None => name.clone(),
                })
            }),
            _ => None,
        };
        match simple {
            Some(text) => (text, false),
            None => self.texts.get(&self.source(id)).cloned().unwrap_or_default(),
        }
    }
}
