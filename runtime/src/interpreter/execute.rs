//! The executor: the operations of a program, each at many points before the next.
//!
//! An operation is read once for all registers of a tile, so that reading it costs little beside what it
//! computes. Each is the one that the emitted Rust of the same declaration performs, in the same order, so
//! that results have the same bits.

use std::any::Any;
use std::cell::{Cell, RefCell};

use super::domain::VolumeBound;
use super::parameters::Parameters;
use super::program::{Elementary, Exponent, Loop, Operation, Program, Register, Sizes};
use crate::lanes::{Backend, Kernel, Lanes, Real, Scalar};
use crate::quotient::{
    Pair, above_zero, asinh_quotient, atan_quotient, cos_quotient, cosh_quotient, erf_quotient,
    exp_m1_quotient, exp_quotient, ln_1p_quotient, ln_product, pole_floor, share_above, share_below,
    sigmoid_quotient, sin_quotient, sinh_quotient, softplus_quotient, tanh_quotient, whole_power,
    whole_power_quotient,
};
use crate::univariate::Univariate;

/// Registers of a program, each as many real numbers side by side as there are groups of points.
pub(super) struct Registers<R: Real> {
    /// Those for constants, and behind them those for other numbers.
    numbers: Vec<R>,
    /// How many are for constants.
    constants: usize,
    /// Whose constants these are.
    prepared: Option<Prepared>,
    logarithms: Vec<R::Logarithm>,
    pairs: Vec<Pair<R>>,
}

/// The material and the program whose constants are in registers, and their places.
#[derive(PartialEq)]
struct Prepared {
    /// The number of the material, which holds the program.
    material: u64,
    program: *const Program,
    entry: usize,
    groups: usize,
}

thread_local! {
    /// Registers that the thread has used, one set for each type of real number.
    static USED: RefCell<Vec<Box<dyn Any>>> = const { RefCell::new(Vec::new()) };
}

impl<R: Real> Registers<R> {
    /// Registers of at least these sizes; nothing is allocated once a thread has had them.
    #[inline(never)]
    pub(super) fn take(sizes: Sizes, groups: usize) -> Box<Self> {
        let used = USED.with_borrow_mut(|all| {
            let place = all.iter().position(|one| one.is::<Self>())?;
            all.swap_remove(place).downcast::<Self>().ok()
        });
        let mut registers = used.unwrap_or_else(|| {
            let (numbers, logarithms, pairs) = (Vec::new(), Vec::new(), Vec::new());
            Box::new(Self { numbers, constants: 0, prepared: None, logarithms, pairs })
        });
        registers.constants = sizes.constants;
        let one = R::splat(1.0);
        let Self { numbers, logarithms, pairs, .. } = &mut *registers;
        grow(numbers, sizes.numbers * groups, || one);
        grow(logarithms, sizes.logarithms * groups, || one.logarithm());
        grow(pairs, sizes.pairs * groups, || Pair::of(one, one));
        registers
    }

    /// Keeps the registers for the next program of the thread.
    #[inline(never)]
    pub(super) fn give_back(self: Box<Self>) {
        USED.with_borrow_mut(|all| all.push(self));
    }

    /// All registers for numbers, one after the other.
    pub(super) fn numbers(&mut self) -> &mut [R] {
        self.prepared = None;
        &mut self.numbers
    }

    /// Whether the constants of a program for so many groups are in their registers, which they are after it
    /// has been executed.
    fn prepare(&mut self, program: &Program, context: &Context<'_>, groups: usize) -> bool {
        let &Context { parameters, entry, material, .. } = context;
        let material = material.filter(|_| parameters.each.is_none());
        let these = material.map(|material| Prepared { material, program, entry, groups });
        let are_there = these.is_some() && self.prepared == these;
        self.prepared = these;
        are_there
    }

    /// The number in a register, where there is one group of points.
    #[inline(always)]
    pub(super) fn number(&self, register: Register) -> R {
        self.numbers[usize::from(register)]
    }
}

fn grow<T: Clone>(list: &mut Vec<T>, length: usize, entry: impl FnOnce() -> T) {
    if list.len() < length {
        list.resize(length, entry());
    }
}

/// Parameters, the entry of lists that a program reads outside of sums, and the threshold of an extension.
#[derive(Clone, Copy)]
pub(super) struct Context<'a> {
    /// The number of the material, if the program is its own.
    pub(super) material: Option<u64>,
    pub(super) parameters: Parameters<'a>,
    pub(super) entry: usize,
    pub(super) epsilon: f64,
}

/// Executes a program for one point, or one register of points.
///
/// Not inlined into the function of a back end, and so slow on lanes: see [`execute_tile`].
#[inline(never)]
pub(super) fn execute_alone<R: Real>(
    program: &Program,
    context: Context<'_>,
    arguments: &[R],
    registers: &mut Registers<R>,
) {
    let is_prepared = registers.prepare(program, &context, 1);
    let file = Files::<R, 1>::new(registers, &context.parameters);
    for &(register, k) in &program.arguments {
        file.number(register).set(0, arguments[k]);
    }
    execute(program, context, &file, is_prepared);
}

/// Arguments of a program at the points of a tile, and room for its results.
pub(super) struct Request<'a, E> {
    pub(super) count: usize,
    /// How far rows of arguments and of results are apart.
    pub(super) stride: usize,
    pub(super) arguments: &'a [E],
    pub(super) results: &'a mut [E],
    /// Results that nothing reads, as bits.
    pub(super) unread: u32,
    /// The volumes inside the domain.
    pub(super) volume: VolumeBound,
}

/// Executes a program for a tile of points. Gives the points at which its bounds are positive and whose
/// volume is inside the domain, as bits.
///
/// One kernel for all programs: what differs between them is data.
pub(super) fn execute_tile<E: Scalar>(
    backend: Backend,
    program: &Program,
    context: Context<'_>,
    request: Request<'_, E>,
) -> u64 {
    backend.run(Tile { program, context, request })
}

/// [`execute_tile`] on the lanes of a back end.
struct Tile<'a, 'c, E> {
    program: &'a Program,
    context: Context<'c>,
    request: Request<'a, E>,
}

impl<E: Scalar> Kernel<E> for Tile<'_, '_, E> {
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        // As many groups together as make a tile, or one after the other where there are few points.
        if self.request.count <= 2 * R::LANES {
            return self.by_groups::<R, 1>();
        }
        match R::GROUPS {
            4 => self.by_groups::<R, 4>(),
            8 => self.by_groups::<R, 8>(),
            16 => self.by_groups::<R, 16>(),
            _ => self.by_groups::<R, 32>(),
        }
    }
}

/// Lanes as parts of a tile.
trait Part: Lanes {
    /// How many make a tile: a constant by itself, so that the compiler forgets the other numbers at once.
    const GROUPS: usize = 64 / Self::LANES;
}

impl<R: Lanes> Part for R {}

impl<E: Scalar> Tile<'_, '_, E> {
    /// Executes the program for G groups of lanes at a time.
    #[inline(always)]
    fn by_groups<R: Lanes<Scalar = E>, const G: usize>(self) -> u64 {
        let Self { program, mut context, request } = self;
        let Request { count, stride, arguments, results, unread, volume } = request;
        context.parameters.lanes = R::LANES;
        let mut registers = Registers::<R>::take(program.sizes, G);
        let mut admitted = if volume.is_any() && program.bounds.is_empty() { u64::MAX } else { 0 };
        let mut start = 0;
        while start < count {
            context.parameters.start = start;
            let is_prepared = registers.prepare(program, &context, G);
            let file = Files::<R, G>::new(&mut registers, &context.parameters);
            for &(register, k) in &program.arguments {
                let from = &arguments[k * stride + start..][..G * R::LANES];
                let to = file.number(register);
                for group in 0..G {
                    to.set(group, R::load(&from[group * R::LANES..]));
                }
            }
            execute(program, context, &file, is_prepared);
            for (k, &register) in program.results.iter().enumerate() {
                if unread >> k & 1 == 1 {
                    continue;
                }
                let to = &mut results[k * stride + start..][..G * R::LANES];
                let from = file.number(register);
                for group in 0..G {
                    from.get(group).store(&mut to[group * R::LANES..]);
                }
            }
            if admitted != u64::MAX {
                for group in 0..G {
                    let at = start + group * R::LANES;
                    let argument = |k: usize| R::load(&arguments[k * stride + at..]);
                    let mut is_inside = volume.holds([argument(0), argument(1), argument(2)]);
                    for &bound in &program.bounds {
                        is_inside = is_inside & R::splat(0.0).less(file.number(bound).get(group));
                    }
                    admitted |= R::bits(is_inside) << at;
                }
            }
            start += G * R::LANES;
        }
        registers.give_back();
        admitted
    }
}

/// Executes a program whose arguments are in their registers, and its constants if it is prepared, for G
/// groups of points.
#[inline(always)]
fn execute<R: Real, const G: usize>(
    program: &Program,
    context: Context<'_>,
    file: &Files<'_, R, G>,
    is_prepared: bool,
) {
    let Context { ref parameters, mut entry, epsilon, .. } = context;
    let mut next = program.preparations;
    if !is_prepared {
        next = 0;
        for &(register, value) in &program.literals {
            file.number(register).fill(R::splat(value));
        }
        if let Some(register) = program.epsilon {
            file.number(register).fill(R::splat(epsilon));
        }
        for &(register, parameter) in &program.parameters {
            file.load(register, parameters, parameter, 0);
        }
        for &(register, list) in &program.entries {
            file.load(register, parameters, list, entry);
        }
    }
    let outside = entry;
    while let Some(operation) = program.operations.get(next) {
        next += 1;
        match *operation {
            Operation::Begin(place) => {
                let Loop { list, entries, totals, length } = &program.loops[place];
                totals.iter().for_each(|&(total, _)| file.number(total).fill(R::splat(0.0)));
                entry = 0;
                if parameters.length(*list) == 0 {
                    entry = outside;
                    next += length + 1;
                } else {
                    for &(register, list) in entries {
                        file.load(register, parameters, list, 0);
                    }
                }
            }
            Operation::End(place) => {
                let Loop { list, entries, totals, length } = &program.loops[place];
                for &(total, term) in totals {
                    let (total, term) = (file.number(total), file.number(term));
                    for group in 0..G {
                        total.set(group, total.get(group) + term.get(group));
                    }
                }
                entry += 1;
                if entry < parameters.length(*list) {
                    for &(register, list) in entries {
                        file.load(register, parameters, list, entry);
                    }
                    next -= length + 1;
                } else {
                    entry = outside;
                }
            }
            _ => compute(operation, file, parameters, entry),
        }
    }
}

/// The registers of each kind, as cells: an operand may be in the register of the result.
struct Files<'a, R: Real, const G: usize> {
    numbers: &'a [[Cell<R>; G]],
    /// How many of the numbers are constants, of which only the first group is in use.
    constants: usize,
    logarithms: &'a [[Cell<R::Logarithm>; G]],
    pairs: &'a [[Cell<Pair<R>>; G]],
}

/// The cells of a register for numbers, or of a constant.
#[derive(Clone, Copy)]
struct Numbers<'a, R, const G: usize> {
    cells: &'a [Cell<R>; G],
    /// A mask for the index of a group, which it makes zero where the first cell stands for all. No
    /// condition, for each of which the compiler would make another loop.
    mask: usize,
}

impl<R: Real, const G: usize> Numbers<'_, R, G> {
    #[inline(always)]
    fn is_constant(self) -> bool {
        self.mask == 0
    }

    #[inline(always)]
    fn get(self, group: usize) -> R {
        self.cells[group & self.mask].get()
    }

    #[inline(always)]
    fn set(self, group: usize, value: R) {
        self.cells[group].set(value);
    }

    /// Sets all groups.
    #[inline(always)]
    fn fill(self, value: R) {
        if self.is_constant() {
            return self.set(0, value);
        }
        for group in 0..G {
            self.set(group, value);
        }
    }
}

impl<'a, R: Real, const G: usize> Files<'a, R, G> {
    #[inline(always)]
    fn new(registers: &'a mut Registers<R>, parameters: &Parameters<'_>) -> Self {
        Self {
            numbers: Cell::from_mut(&mut registers.numbers[..]).as_slice_of_cells().as_chunks().0,
            constants: if parameters.each.is_none() { registers.constants } else { 0 },
            logarithms: Cell::from_mut(&mut registers.logarithms[..]).as_slice_of_cells().as_chunks().0,
            pairs: Cell::from_mut(&mut registers.pairs[..]).as_slice_of_cells().as_chunks().0,
        }
    }

    #[inline(always)]
    fn number(&self, register: Register) -> Numbers<'a, R, G> {
        let place = usize::from(register);
        Numbers { cells: &self.numbers[place], mask: usize::from(place >= self.constants).wrapping_neg() }
    }

    #[inline(always)]
    fn logarithm(&self, register: Register) -> &'a [Cell<R::Logarithm>; G] {
        &self.logarithms[usize::from(register)]
    }

    #[inline(always)]
    fn pair(&self, register: Register) -> &'a [Cell<Pair<R>>; G] {
        &self.pairs[usize::from(register)]
    }

    /// Sets a constant to a parameter, or to an entry of a list.
    #[inline(always)]
    fn load(&self, register: Register, parameters: &Parameters<'_>, parameter: usize, entry: usize) {
        let to = self.number(register);
        if to.is_constant() {
            return to.set(0, R::splat(parameters.some.number(parameter, entry)));
        }
        for group in 0..G {
            to.set(group, parameters.number(parameter, entry, group));
        }
    }
}

/// An operand that is the same at all groups.
#[derive(Clone, Copy)]
struct Same<R>(R);

impl<R: Real> Same<R> {
    #[inline(always)]
    fn get(self, _group: usize) -> R {
        self.0
    }
}

/// An operand with a value of its own at each group.
#[derive(Clone, Copy)]
struct Each<'a, R, const G: usize>(&'a [Cell<R>; G]);

impl<R: Real, const G: usize> Each<'_, R, G> {
    #[inline(always)]
    fn get(self, group: usize) -> R {
        self.0[group].get()
    }
}

/// Computes one operation at all groups.
#[inline(always)]
fn compute<R: Real, const G: usize>(
    operation: &Operation,
    file: &Files<'_, R, G>,
    parameters: &Parameters<'_>,
    entry: usize,
) {
    /// A loop over the groups: `to = value` with the operands read from their registers.
    macro_rules! each {
        (number $to:expr, [$($operand_kind:ident $x:ident: $register:expr),+] $value:expr) => {{
            let to = file.number($to);
            $(let $x = file.$operand_kind($register);)+
            for group in 0..G {
                to.set(group, { $(let $x = read!($operand_kind $x, group);)+ $value });
            }
        }};
        ($kind:ident $to:expr, [$($operand_kind:ident $x:ident: $register:expr),+] $value:expr) => {{
            let to = file.$kind($to);
            $(let $x = file.$operand_kind($register);)+
            for group in 0..G {
                let value = { $(let $x = read!($operand_kind $x, group);)+ $value };
                to[group].set(value);
            }
        }};
    }
    macro_rules! read {
        (number $x:ident, $group:expr) => {
            $x.get($group)
        };
        ($kind:ident $x:ident, $group:expr) => {
            $x[$group].get()
        };
    }
    macro_rules! unary {
        ($to:expr, $a:expr, |$x:ident| $value:expr) => { each!(number $to, [number $x: $a] $value) };
    }
    macro_rules! binary {
        ($to:expr, $a:expr, $b:expr, |$x:ident, $y:ident| $value:expr) => {
            each!(number $to, [number $x: $a, number $y: $b] $value)
        };
    }
    macro_rules! ternary {
        ($to:expr, $operands:expr, |$x:ident, $y:ident, $z:ident| $value:expr) => {
            each!(number $to, [number $x: $operands[0], number $y: $operands[1], number $z: $operands[2]] $value)
        };
    }
    /// An operation of arithmetic: an operand that is constant is read once, and a result that is constant
    /// computed once.
    macro_rules! arithmetic {
        ($to:expr, [$($x:ident: $register:expr),+] $value:expr) => {{
            let to = file.number($to);
            $(let $x = file.number($register);)+
            if to.is_constant() {
                to.set(0, { $(let $x = $x.get(0);)+ $value });
            } else {
                arithmetic!(to, [] [$($x)+] $value);
            }
        }};
        ($to:ident, [$($known:ident)*] [$x:ident $($others:ident)*] $value:expr) => {
            if $x.is_constant() {
                let $x = Same($x.get(0));
                arithmetic!($to, [$($known)* $x] [$($others)*] $value);
            } else {
                let $x = Each($x.cells);
                arithmetic!($to, [$($known)* $x] [$($others)*] $value);
            }
        };
        ($to:ident, [$($x:ident)+] [] $value:expr) => {
            for group in 0..G {
                $to.set(group, { $(let $x = $x.get(group);)+ $value });
            }
        };
    }
    let whole = |exponent: Exponent| match exponent {
        Exponent::Parameter(k) => parameters.whole(k, 0),
        Exponent::Entry(k) => parameters.whole(k, entry),
    };
    match *operation {
        // The order of the operations, which is not theirs to decide.
        Operation::Begin(_) | Operation::End(_) => {}
        Operation::Neg(to, a) => arithmetic!(to, [x: a] -x),
        Operation::Add(to, a, b) => arithmetic!(to, [x: a, y: b] x + y),
        Operation::Sub(to, a, b) => arithmetic!(to, [x: a, y: b] x - y),
        Operation::Mul(to, a, b) => arithmetic!(to, [x: a, y: b] x * y),
        Operation::Div(to, a, b) => arithmetic!(to, [x: a, y: b] x / y),
        Operation::MulAdd(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] x.mul_add(y, z)),
        Operation::NegMulAdd(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] (-x).mul_add(y, z)),
        Operation::MulSub(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] x.mul_add(y, -z)),
        Operation::MulMul(to, [a, b, c]) => arithmetic!(to, [x: a, y: b, z: c] x * y * z),
        Operation::MulMulMul(to, [a, b, c, d]) => arithmetic!(to, [x: a, y: b, z: c, w: d] x * y * z * w),
        Operation::MulMulAdd(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] (x * y).mul_add(z, w));
        }
        Operation::NegMulMulAdd(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] (-(x * y)).mul_add(z, w));
        }
        Operation::MulAddMul(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] x.mul_add(y, z) * w)
        }
        Operation::NegMulAddMul(to, [a, b, c, d]) => {
            arithmetic!(to, [x: a, y: b, z: c, w: d] (-x).mul_add(y, z) * w)
        }
        Operation::NegMul(to, a, b) => arithmetic!(to, [x: a, y: b] -(x * y)),
        Operation::Sqrt(to, a) => unary!(to, a, |x| x.sqrt()),
        Operation::Cbrt(to, a) => unary!(to, a, |x| x.cbrt()),
        Operation::Ln(to, a) => unary!(to, a, |x| x.ln()),
        Operation::Exp(to, a) => unary!(to, a, |x| x.exp()),
        Operation::Max(to, a, b) => binary!(to, a, b, |x, y| x.max(y)),
        Operation::Below(to, a, b) => binary!(to, a, b, |x, y| (x - y).min(R::splat(0.0))),
        Operation::AboveZero(to, a) => unary!(to, a, |x| above_zero(x)),
        Operation::WhereNegative(to, of) => {
            ternary!(to, of, |x, y, z| R::select(x.less(R::splat(0.0)), y, z))
        }
        Operation::ShareAbove(to, of) => ternary!(to, of, |x, y, z| share_above(x, y, z)),
        Operation::ShareBelow(to, of) => ternary!(to, of, |x, y, z| share_below(x, y, z)),
        Operation::PoleFloor(to, of) => ternary!(to, of, |x, y, z| pole_floor([x, y, z])),
        Operation::LnProduct(to, of) => ternary!(to, of, |x, y, z| ln_product([x, y, z])),
        Operation::Elementary(function, to, a) => match function {
            Elementary::Asinh => unary!(to, a, |x| x.asinh()),
            Elementary::Atan => unary!(to, a, |x| x.atan()),
            Elementary::Cos => unary!(to, a, |x| x.cos()),
            Elementary::Cosh => unary!(to, a, |x| x.cosh()),
            Elementary::Erf => unary!(to, a, |x| x.erf()),
            Elementary::ExpM1 => unary!(to, a, |x| x.exp_m1()),
            Elementary::Ln1p => unary!(to, a, |x| x.ln_1p()),
            Elementary::Sigmoid => unary!(to, a, |x| x.sigmoid()),
            Elementary::Sin => unary!(to, a, |x| x.sin()),
            Elementary::Sinh => unary!(to, a, |x| x.sinh()),
            Elementary::Softplus => unary!(to, a, |x| x.softplus()),
            Elementary::Tanh => unary!(to, a, |x| x.tanh()),
        },
        Operation::ElementaryQuotient(function, to, a, b) => match function {
            Elementary::Asinh => binary!(to, a, b, |x, y| asinh_quotient(x, y)),
            Elementary::Atan => binary!(to, a, b, |x, y| atan_quotient(x, y)),
            Elementary::Cos => binary!(to, a, b, |x, y| cos_quotient(x, y)),
            Elementary::Cosh => binary!(to, a, b, |x, y| cosh_quotient(x, y)),
            Elementary::Erf => binary!(to, a, b, |x, y| erf_quotient(x, y)),
            Elementary::ExpM1 => binary!(to, a, b, |x, y| exp_m1_quotient(x, y)),
            Elementary::Ln1p => binary!(to, a, b, |x, y| ln_1p_quotient(x, y)),
            Elementary::Sigmoid => binary!(to, a, b, |x, y| sigmoid_quotient(x, y)),
            Elementary::Sin => binary!(to, a, b, |x, y| sin_quotient(x, y)),
            Elementary::Sinh => binary!(to, a, b, |x, y| sinh_quotient(x, y)),
            Elementary::Softplus => binary!(to, a, b, |x, y| softplus_quotient(x, y)),
            Elementary::Tanh => binary!(to, a, b, |x, y| tanh_quotient(x, y)),
        },
        Operation::Logarithm(to, a) => each!(logarithm to, [number x: a] x.logarithm()),
        Operation::Power(to, logarithm, exponent) => {
            each!(number to, [logarithm ln: logarithm, number r: exponent] R::power(ln, r));
        }
        Operation::Pair { to, values: [a, b], reciprocals: [ra, rb], logarithms: [la, lb] } => {
            each!(pair to, [number a: a, number b: b, number ra: ra, number rb: rb, logarithm la: la, logarithm lb: lb] {
                Pair::new([a, b], [ra, rb], [la, lb])
            });
        }
        Operation::LnQuotient(to, pair) => each!(number to, [pair both: pair] both.ln_quotient()),
        Operation::PowerQuotient { to, pair, powers: [a, b], exponent } => {
            each!(number to, [pair both: pair, number a: a, number b: b, number r: exponent] {
                both.power_quotient([a, b], r)
            });
        }
        Operation::ExpQuotient(to, [a, ea], [b, eb]) => {
            each!(number to, [number a: a, number ea: ea, number b: b, number eb: eb] {
                exp_quotient([a, ea], [b, eb])
            });
        }
        Operation::WholePower(to, a, exponent, order) => {
            let n = whole(exponent);
            unary!(to, a, |x| whole_power(x, n, u32::from(order)));
        }
        Operation::WholePowerQuotient(to, [a, b], exponent, order) => {
            let n = whole(exponent);
            binary!(to, a, b, |x, y| whole_power_quotient([x, y], n, u32::from(order)));
        }
        Operation::Function(to, k, order, a) => match (order, parameters.function(k)) {
            (0, Some(function)) => unary!(to, a, |x| function.value(x)),
            (1, Some(function)) => unary!(to, a, |x| function.derivative(x)),
            (2, Some(function)) => unary!(to, a, |x| function.second_derivative(x)),
            _ => unary!(to, a, |_x| R::splat(f64::NAN)),
        },
        Operation::FunctionQuotient(to, k, order, [a, b]) => match (order, parameters.function(k)) {
            (0, Some(function)) => binary!(to, a, b, |x, y| function.quotient(x, y)),
            (1, Some(function)) => binary!(to, a, b, |x, y| function.derivative_quotient(x, y)),
            _ => unary!(to, a, |_x| R::splat(f64::NAN)),
        },
    }
}
