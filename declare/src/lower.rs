//! Lowering of the operations of the compiler to a program of the interpreter, with register allocation.
//!
//! A value needs its register from where it is computed to where it is read last, and a register holds many
//! values one after the other: fewer registers stay in the innermost cache. What a loop reads of values from
//! outside of it, it reads for every entry, so that these keep their registers until its end.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use piola::__private::interpreter::{Loop, Operation, Program, Register, Sizes};
use piola_codegen::read::parse::Declaration;
use piola_codegen::schedule::{Op, Program as Ordered, Statement, Value};

/// Maximum number of registers of one kind: a tile of them takes two mebibytes.
const MOST_REGISTERS: usize = 4096;

/// The program of ordered operations for the interpreter; `None` if it needs too many registers.
pub(crate) fn lower(declaration: &Declaration, ordered: &Ordered) -> Option<Program> {
    lower_parts(declaration, &[ordered])
}

/// The program of a response, and behind it that of the bounds of its domain if there are any, whose
/// constants and arguments are in the same registers; `None` if it needs too many of them.
///
/// They are not ordered as one, because common operations could then be shared: bits of the response would
/// depend on the domain.
pub(crate) fn lower_parts(declaration: &Declaration, parts: &[&Ordered]) -> Option<Program> {
    let constants = constants(declaration, parts);
    let mut registers: [Registers; 5] = Default::default();
    // Two values may be one constant, so that these are enough.
    registers[Kind::Number as usize].first = constants.len();
    let mut lowering = Lowering {
        declaration,
        lives: lives(parts),
        constants,
        places: BTreeMap::new(),
        filled: HashMap::new(),
        registers,
        part: 0,
        latest: None,
        preparations: Vec::new(),
        program: Program::default(),
    };
    for (part, ordered) in parts.iter().enumerate() {
        lowering.part = part;
        lowering.inputs(ordered);
    }
    let mut time = 0;
    let mut outputs = [Vec::new(), Vec::new()];
    for (part, ordered) in parts.iter().enumerate() {
        lowering.part = part;
        for statement in &ordered.statements {
            lowering.statement(statement, &mut time);
        }
        outputs[part] = ordered.outputs.iter().map(|&output| lowering.read(output)).collect();
    }
    let [results, bounds] = outputs;
    let stretches = [0, 1, 2].map(|i| lowering.register(Name::Stretch(i)));
    let preparations = lowering.preparations.len();
    lowering.program.operations.splice(..0, lowering.preparations);
    let constants = lowering.constants.len();
    let [numbers, _, logarithms, pairs, _] =
        lowering.registers.map(|registers| registers.first + registers.count);
    let sizes = Sizes { numbers, constants, logarithms, pairs };
    let most = numbers.max(logarithms).max(pairs);
    let program = Program { stretches, preparations, results, bounds, sizes, ..lowering.program };
    (most <= MOST_REGISTERS).then_some(program)
}

/// A value of a part of the program, or a stretch, which an operation may read that does not name it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Name {
    Value(usize, Value),
    Stretch(usize),
}

/// The time at which each value is read last. Each operation has a time of its own, and so has the end of
/// each loop; results are read after all.
fn lives(parts: &[&Ordered]) -> BTreeMap<Name, usize> {
    let mut last = BTreeMap::new();
    let mut time = 0;
    for (part, ordered) in parts.iter().enumerate() {
        let named = |value: Value| Name::Value(part, value);
        for statement in &ordered.statements {
            match statement {
                Statement::Let(_, op) => {
                    time += 1;
                    last.extend(reads(part, op).map(|name| (name, time)));
                }
                Statement::Loop { body, totals, .. } => {
                    let inside: BTreeSet<_> = body.iter().map(|&(value, _)| named(value)).collect();
                    let end = time + body.len() + 1;
                    for (_, op) in body {
                        time += 1;
                        let until = |name| if inside.contains(&name) { time } else { end };
                        last.extend(reads(part, op).map(|name| (name, until(name))));
                    }
                    time = end;
                    for name in totals.iter().flat_map(|&(total, term)| [total, term]).map(named) {
                        last.insert(name, end);
                    }
                }
            }
        }
        last.extend(ordered.outputs.iter().map(|&output| (named(output), usize::MAX)));
    }
    // A stretch is in one register under all its names.
    for i in 0..3 {
        let mut names = vec![Name::Stretch(i)];
        for (part, ordered) in parts.iter().enumerate() {
            let values = ordered.operations().filter(|&(_, op)| op == Op::Stretch(i));
            names.extend(values.map(|(value, _)| Name::Value(part, value)));
        }
        if let Some(latest) = names.iter().filter_map(|name| last.get(name).copied()).max() {
            last.extend(names.into_iter().map(|name| (name, latest)));
        }
    }
    last
}

/// The values that are the same at every point: those of the declaration and its parameters, and those
/// computed from them.
fn constants(declaration: &Declaration, parts: &[&Ordered]) -> BTreeSet<Name> {
    let mut constants = BTreeSet::new();
    let is_whole = |k: usize| declaration.parameters[k].is_whole;
    for (part, ordered) in parts.iter().enumerate() {
        for (value, op) in ordered.operations() {
            let mut operands = op.operands().into_iter();
            let mut are_constant = || operands.all(|operand| constants.contains(&Name::Value(part, operand)));
            let is_constant = match op {
                Op::Literal(_) | Op::Epsilon => true,
                Op::Parameter(k) | Op::Entry(k) => !is_whole(k),
                Op::Neg(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..) => are_constant(),
                Op::MulAdd(..) | Op::NegMulAdd(..) | Op::MulSub(..) => are_constant(),
                _ => false,
            };
            if is_constant {
                constants.insert(Name::Value(part, value));
            }
        }
    }
    constants
}

/// The names that an operation of a part reads.
fn reads(part: usize, op: &Op) -> impl Iterator<Item = Name> {
    let stretches = if *op == Op::PoleFloor { 0..3 } else { 0..0 };
    let values = op.operands().into_iter().map(move |value| Name::Value(part, value));
    values.chain(stretches.map(Name::Stretch))
}

/// The kind of a register.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Number,
    Constant,
    Logarithm,
    Pair,
    /// A whole exponent, which is read from the parameters.
    Exponent,
}

/// Registers of one kind.
#[derive(Default)]
struct Registers {
    /// The first of the kind.
    first: usize,
    count: usize,
    free: Vec<Register>,
}

/// Location of a value.
type Place = (Kind, Register);

struct Lowering<'a> {
    declaration: &'a Declaration,
    /// The time at which each value is read last.
    lives: BTreeMap<Name, usize>,
    /// Location of each value, or its location when it was read last.
    places: BTreeMap<Name, Place>,
    /// The registers of constants that are filled before the first operation.
    filled: HashMap<Op<Register>, Register>,
    /// The values that are constants.
    constants: BTreeSet<Name>,
    registers: [Registers; 5],
    /// The part of the program that is being lowered.
    part: usize,
    /// The value of the last operation.
    latest: Option<Name>,
    /// Operations that compute constants.
    preparations: Vec<Operation>,
    program: Program,
}

impl Lowering<'_> {
    fn named(&self, value: Value) -> Name {
        Name::Value(self.part, value)
    }

    /// Fills registers before the first operation.
    fn inputs(&mut self, ordered: &Ordered) {
        let mut input = |value: Value, op: Op, is_in_loop: bool| {
            let name = self.named(value);
            let is_whole = |k: usize| self.declaration.parameters[k].is_whole;
            let place = match op {
                Op::Parameter(k) | Op::Entry(k) if is_whole(k) => self.exponent(k),
                Op::Stretch(i) => (Kind::Number, self.stretch(i)),
                Op::PoleFloor => return (0..3).for_each(|i| _ = self.stretch(i)),
                Op::Strain(i) => {
                    let register = self.make(Kind::Number, name);
                    return self.program.arguments.push((register, 3 + i));
                }
                Op::Literal(bits) => self.constant(Op::Literal(bits)),
                Op::Parameter(k) => self.constant(Op::Parameter(k)),
                Op::Entry(k) if !is_in_loop => self.constant(Op::Entry(k)),
                Op::Epsilon => self.constant(Op::Epsilon),
                _ => return,
            };
            self.places.insert(name, place);
        };
        for statement in &ordered.statements {
            match statement {
                Statement::Let(value, op) => input(*value, *op, false),
                Statement::Loop { body, .. } => body.iter().for_each(|&(value, op)| input(value, op, true)),
            }
        }
    }

    /// The place of a constant that is filled before the first operation.
    fn constant(&mut self, constant: Op<Register>) -> Place {
        let (registers, program) = (&mut self.registers, &mut self.program);
        let register = *self.filled.entry(constant).or_insert_with(|| {
            let register = registers[Kind::Constant as usize].add();
            program.filled.push((register, constant));
            register
        });
        (Kind::Constant, register)
    }

    fn exponent(&mut self, parameter: usize) -> Place {
        self.program.exponents.push(parameter);
        (Kind::Exponent, self.registers[Kind::Exponent as usize].add())
    }

    /// The register of a stretch.
    fn stretch(&mut self, i: usize) -> Register {
        if let Some(&(_, register)) = self.places.get(&Name::Stretch(i)) {
            return register;
        }
        let register = self.make(Kind::Number, Name::Stretch(i));
        self.program.arguments.push((register, i));
        register
    }

    fn statement(&mut self, statement: &Statement, time: &mut usize) {
        match statement {
            Statement::Let(value, op) if self.constants.contains(&self.named(*value)) => {
                *time += 1;
                let operation = self.operation(*value, op, *time);
                self.preparations.extend(operation);
            }
            Statement::Let(value, op) => self.step(*value, op, time),
            Statement::Loop { length, body, totals } => {
                let parameters = &self.declaration.parameters;
                let list = parameters.iter().position(|parameter| parameter.length() == Some(*length));
                let mut sum = |total: Value| self.make(Kind::Number, self.named(total));
                let sums: Vec<_> = totals.iter().map(|&(total, _)| sum(total)).collect();
                let mut entries = Vec::new();
                for &(value, op) in body {
                    if let Op::Entry(k) = op
                        && !parameters[k].is_whole
                    {
                        entries.push((self.make(Kind::Constant, self.named(value)), k));
                    }
                }
                let place = self.program.loops.len();
                self.program.operations.push(Operation::Begin(place));
                let begin = self.program.operations.len();
                for (value, op) in body {
                    self.step(*value, op, time);
                }
                let length = self.program.operations.len() - begin;
                self.program.operations.push(Operation::End(place));
                *time += 1;
                let totals = sums.into_iter().zip(totals.iter().map(|&(_, term)| self.read(term))).collect();
                let list = list.unwrap_or_default();
                self.program.loops.push(Loop { list, entries, totals, length });
                let is_over = |name: &&Name| self.lives.get(*name) == Some(time);
                let over = self.places.keys().filter(is_over).copied().collect();
                self.free(over);
            }
        }
    }

    /// The next operation, which may become one with that before.
    fn step(&mut self, value: Value, op: &Op, time: &mut usize) {
        *time += 1;
        let Some(operation) = self.operation(value, op, *time) else { return };
        let before = self.latest.replace(self.named(value));
        // A constant is computed once for all points, and stays apart.
        let is_passed = |name: Name| self.lives.get(&name) == Some(time) && !self.constants.contains(&name);
        let operations = &mut self.program.operations;
        let last = operations.last_mut().filter(|_| before.is_some_and(is_passed));
        match last.and_then(|last| Some((fused(*last, operation)?, last))) {
            Some((both, last)) => *last = both,
            None => operations.push(operation),
        }
    }

    /// The operation at a time; `None` for one that fills a register before all others.
    fn operation(&mut self, value: Value, op: &Op, time: usize) -> Option<Operation> {
        let kind = match op {
            Op::Literal(_) | Op::Stretch(_) | Op::Strain(_) => return None,
            Op::Parameter(_) | Op::Entry(_) | Op::Epsilon => return None,
            Op::Logarithm(_) => Kind::Logarithm,
            Op::Pair { .. } => Kind::Pair,
            _ if self.constants.contains(&self.named(value)) => Kind::Constant,
            _ => Kind::Number,
        };
        let over = reads(self.part, op).filter(|name| self.lives.get(name) == Some(&time)).collect();
        self.free(over);
        let to = self.make(kind, self.named(value));
        Some(Operation::One(to, op.map(|value| self.read(value))))
    }

    /// The register of a value, which the order of the operations has filled.
    fn read(&self, value: Value) -> Register {
        self.register(self.named(value))
    }

    fn register(&self, name: Name) -> Register {
        self.places.get(&name).map_or(0, |&(_, register)| register)
    }

    /// A free register for a value; constants keep theirs.
    fn make(&mut self, kind: Kind, name: Name) -> Register {
        let registers = &mut self.registers[kind as usize];
        let register = registers.free.pop().unwrap_or_else(|| registers.add());
        self.places.insert(name, (kind, register));
        // A value that nothing reads is still written.
        if kind != Kind::Constant && !self.lives.contains_key(&name) {
            registers.free.push(register);
        }
        register
    }

    /// Frees the registers of values that nothing reads any more.
    fn free(&mut self, over: BTreeSet<Name>) {
        let places = over.iter().filter_map(|name| self.places.get(name).copied());
        // Two names may be one register.
        let registers: BTreeSet<_> = places.filter(|&(kind, _)| kind != Kind::Constant).collect();
        registers.into_iter().for_each(|(kind, register)| self.registers[kind as usize].free.push(register));
    }
}

impl Registers {
    /// One more register.
    fn add(&mut self) -> Register {
        self.count += 1;
        Register::try_from(self.first + self.count - 1).unwrap_or(Register::MAX)
    }
}

/// Two operations that follow each other as one, if the second reads once what the first has computed, and
/// nothing else does: that value then needs no register.
fn fused(first: Operation, second: Operation) -> Option<Operation> {
    use Operation::{MulAddMul, MulMul, MulMulAdd, MulMulMul, NegMul, NegMulAddMul, NegMulMulAdd, One};
    let (One(passed, Op::Mul(..) | Op::MulAdd(..) | Op::NegMulAdd(..)) | MulMul(passed, _)) = first else {
        return None;
    };
    let One(to, second) = second else { return None };
    let factor = |x: Register, y: Register| match (x == passed, y == passed) {
        (true, false) => Some(y),
        (false, true) => Some(x),
        _ => None,
    };
    let addend = |z: Register| Some(z).filter(|&z| z != passed);
    Some(match (first, second) {
        (One(_, Op::Mul(a, b)), Op::Neg(_)) => NegMul(to, a, b),
        (One(_, Op::Mul(a, b)), Op::Mul(x, y)) => MulMul(to, [a, b, factor(x, y)?]),
        (MulMul(_, [a, b, c]), Op::Mul(x, y)) => MulMulMul(to, [a, b, c, factor(x, y)?]),
        (One(_, Op::MulAdd(a, b, c)), Op::Mul(x, y)) => MulAddMul(to, [a, b, c, factor(x, y)?]),
        (One(_, Op::NegMulAdd(a, b, c)), Op::Mul(x, y)) => NegMulAddMul(to, [a, b, c, factor(x, y)?]),
        (One(_, Op::Mul(a, b)), Op::MulAdd(x, y, z)) => MulMulAdd(to, [a, b, factor(x, y)?, addend(z)?]),
        (One(_, Op::Mul(a, b)), Op::NegMulAdd(x, y, z)) => {
            NegMulMulAdd(to, [a, b, factor(x, y)?, addend(z)?])
        }
        _ => return None,
    })
}
