//! From the operations of the compiler to a program of the interpreter: which register each value is in.
//!
//! A value needs its register from where it is computed to where it is read last, and a register serves many
//! values one after the other: fewer registers stay in the innermost cache. What a loop reads of values from
//! outside of it, it reads for every entry, so that these keep their registers until its end.

use std::collections::{BTreeMap, BTreeSet};

use piola::interpreter::{Elementary, Exponent, Loop, Operation, Program, Register, Sizes};
use piola_codegen::algebra::expr::Elementary as Function;
use piola_codegen::read::parse::Declaration;
use piola_codegen::schedule::{Op, Program as Ordered, Statement, Value};

/// The most registers of one kind: a tile of them takes half a mebibyte.
const MOST_REGISTERS: usize = 1024;

/// The program of ordered operations for the interpreter; `None` if it needs too many registers.
pub(crate) fn lower(declaration: &Declaration, ordered: &Ordered) -> Option<Program> {
    let mut lowering = Lowering {
        declaration,
        lives: lives(ordered),
        places: BTreeMap::new(),
        registers: Kind::ALL.map(|_| Registers::default()),
        program: Program {
            literals: Vec::new(),
            arguments: Vec::new(),
            parameters: Vec::new(),
            entries: Vec::new(),
            epsilon: None,
            operations: Vec::new(),
            loops: Vec::new(),
            results: Vec::new(),
            sizes: Sizes::default(),
        },
    };
    lowering.inputs(ordered);
    let mut time = 0;
    for statement in &ordered.statements {
        lowering.statement(statement, &mut time);
    }
    let results = ordered.outputs.iter().map(|&output| lowering.read(output)).collect();
    let [numbers, logarithms, pairs] = lowering.registers.map(|registers| registers.count);
    let sizes = Sizes { numbers, logarithms, pairs };
    (numbers.max(logarithms).max(pairs) <= MOST_REGISTERS).then_some(Program {
        results,
        sizes,
        ..lowering.program
    })
}

/// A value of the program, or a stretch, which an operation may read that does not name it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Name {
    Value(Value),
    Stretch(usize),
}

/// The time at which each value is read last. Each operation has a time of its own, and so has the end of
/// each loop; results are read after all.
fn lives(ordered: &Ordered) -> BTreeMap<Name, usize> {
    let mut last = BTreeMap::new();
    let mut time = 0;
    for statement in &ordered.statements {
        match statement {
            Statement::Let(_, op) => {
                time += 1;
                reads(op, |name| _ = last.insert(name, time));
            }
            Statement::Loop { body, totals, .. } => {
                let inside: BTreeSet<_> = body.iter().map(|&(value, _)| Name::Value(value)).collect();
                let end = time + body.len() + 1;
                for (_, op) in body {
                    time += 1;
                    reads(op, |name| _ = last.insert(name, if inside.contains(&name) { time } else { end }));
                }
                time = end;
                for name in totals.iter().flat_map(|&(total, term)| [total, term]) {
                    last.insert(Name::Value(name), end);
                }
            }
        }
    }
    last.extend(ordered.outputs.iter().map(|&output| (Name::Value(output), usize::MAX)));
    // A stretch is in one register, whatever it is called.
    for statement in &ordered.statements {
        if let Statement::Let(value, Op::Stretch(i)) = *statement {
            let both = [Name::Value(value), Name::Stretch(i)];
            if let Some(latest) = both.into_iter().filter_map(|name| last.get(&name).copied()).max() {
                last.extend(both.map(|name| (name, latest)));
            }
        }
    }
    last
}

/// Shows the names that an operation reads.
fn reads(op: &Op, mut show: impl FnMut(Name)) {
    op.operands().into_iter().for_each(|value| show(Name::Value(value)));
    if *op == Op::PoleFloor {
        (0..3).for_each(|i| show(Name::Stretch(i)));
    }
}

/// The kind of a register.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Number,
    Logarithm,
    Pair,
}

impl Kind {
    const ALL: [Self; 3] = [Self::Number, Self::Logarithm, Self::Pair];
}

/// Registers of one kind.
#[derive(Default)]
struct Registers {
    count: usize,
    free: Vec<Register>,
}

/// Where a value is.
#[derive(Clone, Copy)]
enum Place {
    Register(Kind, Register),
    /// A whole exponent, which is read from the parameters.
    Whole(Exponent),
}

struct Lowering<'a> {
    declaration: &'a Declaration,
    /// The time at which each value is read last.
    lives: BTreeMap<Name, usize>,
    /// Where each value is, or was when it was read last.
    places: BTreeMap<Name, Place>,
    registers: [Registers; 3],
    program: Program,
}

impl Lowering<'_> {
    /// Fills registers before the first operation.
    fn inputs(&mut self, ordered: &Ordered) {
        let mut input = |value: Value, op: Op, is_in_loop: bool| {
            let name = Name::Value(value);
            let is_whole = |k: usize| self.declaration.parameters[k].is_whole;
            match op {
                Op::Parameter(k) if is_whole(k) => {
                    self.places.insert(name, Place::Whole(Exponent::Parameter(k)));
                }
                Op::Entry(k) if is_whole(k) => {
                    self.places.insert(name, Place::Whole(Exponent::Entry(k)));
                }
                Op::Stretch(i) => {
                    let register = self.stretch(i);
                    self.places.insert(name, Place::Register(Kind::Number, register));
                }
                Op::PoleFloor => (0..3).for_each(|i| _ = self.stretch(i)),
                Op::Strain(i) => {
                    let register = self.make(Kind::Number, name);
                    self.program.arguments.push((register, 3 + i));
                }
                Op::Literal(bits) => {
                    let register = self.make(Kind::Number, name);
                    self.program.literals.push((register, f64::from_bits(bits)));
                }
                Op::Parameter(k) => {
                    let register = self.make(Kind::Number, name);
                    self.program.parameters.push((register, k));
                }
                Op::Entry(k) if !is_in_loop => {
                    let register = self.make(Kind::Number, name);
                    self.program.entries.push((register, k));
                }
                Op::Epsilon => self.program.epsilon = Some(self.make(Kind::Number, name)),
                _ => {}
            }
        };
        for statement in &ordered.statements {
            match statement {
                Statement::Let(value, op) => input(*value, *op, false),
                Statement::Loop { body, .. } => body.iter().for_each(|&(value, op)| input(value, op, true)),
            }
        }
    }

    /// The register of a stretch.
    fn stretch(&mut self, i: usize) -> Register {
        if let Some(&Place::Register(_, register)) = self.places.get(&Name::Stretch(i)) {
            return register;
        }
        let register = self.make(Kind::Number, Name::Stretch(i));
        self.program.arguments.push((register, i));
        register
    }

    fn statement(&mut self, statement: &Statement, time: &mut usize) {
        match statement {
            Statement::Let(value, op) => {
                *time += 1;
                let operation = self.operation(*value, op, *time);
                self.program.operations.extend(operation);
            }
            Statement::Loop { length, body, totals } => {
                let parameters = &self.declaration.parameters;
                let list = parameters.iter().position(|parameter| parameter.length() == Some(*length));
                let sums: Vec<_> =
                    totals.iter().map(|&(total, _)| self.make(Kind::Number, Name::Value(total))).collect();
                let mut entries = Vec::new();
                for &(value, op) in body {
                    if let Op::Entry(k) = op
                        && !parameters[k].is_whole
                    {
                        entries.push((self.make(Kind::Number, Name::Value(value)), k));
                    }
                }
                let place = self.program.loops.len();
                self.program.operations.push(Operation::Begin(place));
                let begin = self.program.operations.len();
                for (value, op) in body {
                    *time += 1;
                    let operation = self.operation(*value, op, *time);
                    self.program.operations.extend(operation);
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

    /// The operation at a time; `None` for one that fills a register before all others.
    fn operation(&mut self, value: Value, op: &Op, time: usize) -> Option<Operation> {
        let kind = match op {
            Op::Literal(_) | Op::Stretch(_) | Op::Strain(_) => return None,
            Op::Parameter(_) | Op::Entry(_) | Op::Epsilon => return None,
            Op::Logarithm(_) => Kind::Logarithm,
            Op::Pair { .. } => Kind::Pair,
            _ => Kind::Number,
        };
        let mut over = BTreeSet::new();
        reads(op, |name| {
            if self.lives.get(&name) == Some(&time) {
                over.insert(name);
            }
        });
        self.free(over);
        let to = self.make(kind, Name::Value(value));
        let r = |value: Value| self.read(value);
        Some(match *op {
            Op::Neg(a) => Operation::Neg(to, r(a)),
            Op::Add(a, b) => Operation::Add(to, r(a), r(b)),
            Op::Sub(a, b) => Operation::Sub(to, r(a), r(b)),
            Op::Mul(a, b) => Operation::Mul(to, r(a), r(b)),
            Op::Div(a, b) => Operation::Div(to, r(a), r(b)),
            Op::MulAdd(a, b, c) => Operation::MulAdd(to, [a, b, c].map(r)),
            Op::NegMulAdd(a, b, c) => Operation::NegMulAdd(to, [a, b, c].map(r)),
            Op::MulSub(a, b, c) => Operation::MulSub(to, [a, b, c].map(r)),
            Op::Sqrt(a) => Operation::Sqrt(to, r(a)),
            Op::Cbrt(a) => Operation::Cbrt(to, r(a)),
            Op::Ln(a) => Operation::Ln(to, r(a)),
            Op::Exp(a) => Operation::Exp(to, r(a)),
            Op::Max(a, b) => Operation::Max(to, r(a), r(b)),
            Op::Below(a, b) => Operation::Below(to, r(a), r(b)),
            Op::AboveZero(a) => Operation::AboveZero(to, r(a)),
            Op::WhereNegative(a, b, c) => Operation::WhereNegative(to, [a, b, c].map(r)),
            Op::ShareAbove(a, b, c) => Operation::ShareAbove(to, [a, b, c].map(r)),
            Op::ShareBelow(a, b, c) => Operation::ShareBelow(to, [a, b, c].map(r)),
            Op::PoleFloor => Operation::PoleFloor(to, [0, 1, 2].map(|i| self.register(Name::Stretch(i)))),
            Op::LnProduct(factors) => Operation::LnProduct(to, factors.map(r)),
            Op::Elementary(function, a) => Operation::Elementary(elementary(function), to, r(a)),
            Op::ElementaryQuotient(function, a, b) => {
                Operation::ElementaryQuotient(elementary(function), to, r(a), r(b))
            }
            Op::Logarithm(a) => Operation::Logarithm(to, r(a)),
            Op::Power(logarithm, exponent) => Operation::Power(to, r(logarithm), r(exponent)),
            Op::Pair { values, reciprocals, logarithms } => Operation::Pair {
                to,
                values: values.map(r),
                reciprocals: reciprocals.map(r),
                logarithms: logarithms.map(r),
            },
            Op::LnQuotient(pair) => Operation::LnQuotient(to, r(pair)),
            Op::PowerQuotient { pair, powers, exponent } => {
                Operation::PowerQuotient { to, pair: r(pair), powers: powers.map(r), exponent: r(exponent) }
            }
            Op::ExpQuotient { values: [a, b], exponentials: [a_exp, b_exp] } => {
                Operation::ExpQuotient(to, [a, a_exp].map(r), [b, b_exp].map(r))
            }
            Op::WholePower(a, n, order) => Operation::WholePower(to, r(a), self.whole(n), order),
            Op::WholePowerQuotient(bases, n, order) => {
                Operation::WholePowerQuotient(to, bases.map(r), self.whole(n), order)
            }
            Op::Function(k, order, a) => Operation::Function(to, k, order, r(a)),
            Op::FunctionQuotient(k, order, a, b) => Operation::FunctionQuotient(to, k, order, [a, b].map(r)),
            Op::Literal(_)
            | Op::Stretch(_)
            | Op::Strain(_)
            | Op::Parameter(_)
            | Op::Entry(_)
            | Op::Epsilon => return None,
        })
    }

    /// The register of a value, which the order of the operations has filled.
    fn read(&self, value: Value) -> Register {
        self.register(Name::Value(value))
    }

    fn register(&self, name: Name) -> Register {
        match self.places.get(&name) {
            Some(&Place::Register(_, register)) => register,
            _ => 0,
        }
    }

    fn whole(&self, value: Value) -> Exponent {
        match self.places.get(&Name::Value(value)) {
            Some(&Place::Whole(exponent)) => exponent,
            _ => Exponent::Parameter(0),
        }
    }

    /// A free register for a value.
    fn make(&mut self, kind: Kind, name: Name) -> Register {
        let registers = &mut self.registers[kind as usize];
        let register = registers.free.pop().unwrap_or_else(|| {
            registers.count += 1;
            Register::try_from(registers.count - 1).unwrap_or(Register::MAX)
        });
        self.places.insert(name, Place::Register(kind, register));
        // A value that nothing reads is written all the same.
        if !self.lives.contains_key(&name) {
            registers.free.push(register);
        }
        register
    }

    /// Frees the registers of values that nothing reads any more.
    fn free(&mut self, over: BTreeSet<Name>) {
        let places = over.into_iter().filter_map(|name| match self.places.get(&name) {
            Some(&Place::Register(kind, register)) => Some((kind, register)),
            _ => None,
        });
        // Two names may be one register.
        let registers: BTreeSet<_> = places.collect();
        registers.into_iter().for_each(|(kind, register)| self.registers[kind as usize].free.push(register));
    }
}

fn elementary(function: Function) -> Elementary {
    match function {
        Function::Asinh => Elementary::Asinh,
        Function::Atan => Elementary::Atan,
        Function::Cos => Elementary::Cos,
        Function::Cosh => Elementary::Cosh,
        Function::Erf => Elementary::Erf,
        Function::ExpM1 => Elementary::ExpM1,
        Function::Ln1p => Elementary::Ln1p,
        Function::Sigmoid => Elementary::Sigmoid,
        Function::Sin => Elementary::Sin,
        Function::Sinh => Elementary::Sinh,
        Function::Softplus => Elementary::Softplus,
        Function::Tanh => Elementary::Tanh,
    }
}
