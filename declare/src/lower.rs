//! Lowering of the operations of the compiler to a program of the interpreter, with register allocation.
//!
//! A value needs its register from where it is computed to where it is read last, and a register holds many
//! values one after the other: fewer registers stay in the innermost cache. What a loop reads of values from
//! outside of it, it reads for every entry, so that these keep their registers until its end.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use piola::__private::interpreter::{Loop, Operation, Program, Register, Sizes};
use piola_codegen::read::parse::Declaration;
use piola_codegen::schedule::{Block, Op, Program as Ordered, Value};

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
    let ordered = joined(parts);
    let constants = constants(declaration, &ordered);
    let mut registers: [Registers; 5] = Default::default();
    // Two values may be one constant, so that these are enough.
    registers[Kind::Number as usize].first = constants.len();
    let mut lowering = Lowering {
        declaration,
        lives: lives(&ordered),
        constants,
        places: BTreeMap::new(),
        filled: HashMap::new(),
        registers,
        latest: None,
        preparations: Vec::new(),
        program: Program::default(),
    };
    lowering.inputs(&ordered);
    let mut time = 0;
    ordered.blocks.iter().for_each(|block| lowering.block(block, &mut time));
    let mut results: Vec<_> = ordered.outputs.iter().map(|&output| lowering.register(output)).collect();
    let bounds = results.split_off(parts[0].outputs.len());
    let stretches = STRETCHES.map(|stretch| lowering.register(stretch));
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

/// The stretches in a program of all parts, which an operation may read without naming them.
const STRETCHES: [Value; 3] = [Value(0), Value(1), Value(2)];

/// The parts as one program, in which a stretch is one value.
fn joined(parts: &[&Ordered]) -> Ordered {
    let mut all = Ordered { blocks: Vec::new(), outputs: Vec::new() };
    for (part, &ordered) in parts.iter().enumerate() {
        let stretch = |(value, op): (Value, Op)| match op {
            Op::Stretch(i) => Some((value, STRETCHES[i])),
            _ => None,
        };
        let stretches: HashMap<_, _> = ordered.operations().filter_map(stretch).collect();
        let mut ordered = ordered.clone();
        ordered.rename(|value| {
            let other = Value(STRETCHES.len() + parts.len() * value.0 + part);
            stretches.get(&value).copied().unwrap_or(other)
        });
        all.blocks.append(&mut ordered.blocks);
        all.outputs.append(&mut ordered.outputs);
    }
    all
}

/// The time at which each value is read last. Each operation has a time of its own, and so has the end of
/// each loop; results are read after all.
fn lives(ordered: &Ordered) -> BTreeMap<Value, usize> {
    let mut last = BTreeMap::new();
    let mut time = 0;
    for Block { length, body, totals } in &ordered.blocks {
        let is_loop = length.is_some();
        let inside: BTreeSet<_> = body.iter().map(|&(value, _)| value).filter(|_| is_loop).collect();
        let end = time + body.len() + usize::from(is_loop);
        for (_, op) in body {
            time += 1;
            let until = |value: Value| if is_loop && !inside.contains(&value) { end } else { time };
            last.extend(reads(op).map(|value| (value, until(value))));
        }
        time = end;
        last.extend(totals.iter().flat_map(|&(total, term)| [(total, end), (term, end)]));
    }
    last.extend(ordered.outputs.iter().map(|&output| (output, usize::MAX)));
    last
}

/// The values that are the same at every point: those of the declaration and its parameters, and those
/// computed from them.
fn constants(declaration: &Declaration, ordered: &Ordered) -> BTreeSet<Value> {
    let mut constants = BTreeSet::new();
    let is_whole = |k: usize| declaration.parameters[k].is_whole;
    for (value, op) in ordered.operations() {
        let are_constant = || op.operands().iter().all(|operand| constants.contains(operand));
        let is_constant = match op {
            Op::Literal(_) | Op::Epsilon => true,
            Op::Parameter(k) | Op::Entry(k) => !is_whole(k),
            Op::Neg(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..) => are_constant(),
            Op::MulAdd(..) | Op::NegMulAdd(..) | Op::MulSub(..) => are_constant(),
            _ => false,
        };
        if is_constant {
            constants.insert(value);
        }
    }
    constants
}

/// The values that an operation reads.
fn reads(op: &Op) -> impl Iterator<Item = Value> {
    let unnamed = if *op == Op::PoleFloor { STRETCHES.len() } else { 0 };
    op.operands().into_iter().chain(STRETCHES.into_iter().take(unnamed))
}

/// The kind of a register.
#[derive(Clone, Copy, PartialEq, Eq)]
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
    lives: BTreeMap<Value, usize>,
    /// Location of each value, or its location when it was read last.
    places: BTreeMap<Value, Place>,
    /// The registers of constants that are filled before the first operation.
    filled: HashMap<Op<Register>, Register>,
    /// The values that are constants.
    constants: BTreeSet<Value>,
    registers: [Registers; 5],
    /// The value of the last operation.
    latest: Option<Value>,
    /// Operations that compute constants.
    preparations: Vec<Operation>,
    program: Program,
}

impl Lowering<'_> {
    /// Fills registers before the first operation.
    fn inputs(&mut self, ordered: &Ordered) {
        let mut input = |value: Value, op: Op, is_in_loop: bool| {
            let is_whole = |k: usize| self.declaration.parameters[k].is_whole;
            let place = match op {
                Op::Parameter(k) | Op::Entry(k) if is_whole(k) => self.exponent(k),
                Op::Stretch(i) => return self.stretch(i),
                Op::PoleFloor => return (0..3).for_each(|i| self.stretch(i)),
                Op::Strain(i) => {
                    let register = self.make(Kind::Number, value);
                    return self.program.arguments.push((register, 3 + i));
                }
                Op::Literal(bits) => self.constant(Op::Literal(bits)),
                Op::Parameter(k) => self.constant(Op::Parameter(k)),
                Op::Entry(k) if !is_in_loop => self.constant(Op::Entry(k)),
                Op::Epsilon => self.constant(Op::Epsilon),
                _ => return,
            };
            self.places.insert(value, place);
        };
        for Block { length, body, .. } in &ordered.blocks {
            body.iter().for_each(|&(value, op)| input(value, op, length.is_some()));
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

    /// Gives a stretch its register.
    fn stretch(&mut self, i: usize) {
        if !self.places.contains_key(&STRETCHES[i]) {
            let register = self.make(Kind::Number, STRETCHES[i]);
            self.program.arguments.push((register, i));
        }
    }

    fn block(&mut self, Block { length, body, totals }: &Block, time: &mut usize) {
        if length.is_none() {
            for (value, op) in body {
                if self.constants.contains(value) {
                    *time += 1;
                    let operation = self.operation(*value, op, *time);
                    self.preparations.extend(operation);
                } else {
                    self.step(*value, op, time);
                }
            }
            return;
        }
        let parameters = &self.declaration.parameters;
        let list = parameters.iter().position(|parameter| parameter.length() == *length);
        let sums: Vec<_> = totals.iter().map(|&(total, _)| self.make(Kind::Number, total)).collect();
        let mut entries = Vec::new();
        for &(value, op) in body {
            if let Op::Entry(k) = op
                && !parameters[k].is_whole
            {
                entries.push((self.make(Kind::Constant, value), k));
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
        let totals = sums.into_iter().zip(totals.iter().map(|&(_, term)| self.register(term))).collect();
        let list = list.unwrap_or_default();
        self.program.loops.push(Loop { list, entries, totals, length });
        let is_over = |value: &&Value| self.lives.get(*value) == Some(time);
        let over = self.places.keys().filter(is_over).copied().collect();
        self.free(over);
    }

    /// The next operation, which may become one with that before.
    fn step(&mut self, value: Value, op: &Op, time: &mut usize) {
        *time += 1;
        let Some(operation) = self.operation(value, op, *time) else { return };
        let before = self.latest.replace(value);
        // A constant is computed once for all points, and stays apart.
        let is_passed =
            |value: Value| self.lives.get(&value) == Some(time) && !self.constants.contains(&value);
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
            _ if self.constants.contains(&value) => Kind::Constant,
            _ => Kind::Number,
        };
        let over = reads(op).filter(|operand| self.lives.get(operand) == Some(&time)).collect();
        self.free(over);
        let to = self.make(kind, value);
        Some(Operation::One(to, op.map(|operand| self.register(operand))))
    }

    /// The register of a value, which the order of the operations has filled.
    fn register(&self, value: Value) -> Register {
        self.places.get(&value).map_or(0, |&(_, register)| register)
    }

    /// A free register for a value; constants keep theirs.
    fn make(&mut self, kind: Kind, value: Value) -> Register {
        let registers = &mut self.registers[kind as usize];
        let register = registers.free.pop().unwrap_or_else(|| registers.add());
        self.places.insert(value, (kind, register));
        // A value that nothing reads is still written.
        if kind != Kind::Constant && !self.lives.contains_key(&value) {
            registers.free.push(register);
        }
        register
    }

    /// Frees the registers of values that nothing reads any more.
    fn free(&mut self, over: BTreeSet<Value>) {
        for value in over {
            if let Some(&(kind, register)) = self.places.get(&value)
                && kind != Kind::Constant
            {
                self.registers[kind as usize].free.push(register);
            }
        }
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
