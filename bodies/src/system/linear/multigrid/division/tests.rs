//! Multigrid for a matrix that is divided among threads, which exchange lists of integers.

use std::sync::{Arc, Barrier, Mutex};

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::*;

use piola::__private::random::Random;
use piola::point::Filter;

use crate::mesh::{TetMesh, tetrahedral_box};
use crate::system::Body;
use crate::system::assemble::Elastic;
use crate::system::linear::multigrid::Multigrid;
use crate::system::nodal_stiffness::NodalStiffness;
use crate::system::testing::kirchhoff;

/// Board on which each machine posts a list, and reads the lists of all machines.
struct Board {
    barrier: Barrier,
    lists: Mutex<Vec<Vec<u64>>>,
}

impl Board {
    fn exchange(&self, machine: usize, list: Vec<u64>) -> Vec<Vec<u64>> {
        self.lists.lock().expect("no panic")[machine] = list;
        self.barrier.wait();
        let lists = self.lists.lock().expect("no panic").clone();
        self.barrier.wait();
        lists
    }
}

/// Rows of a level on one machine.
#[derive(Clone)]
struct Machine {
    board: Arc<Board>,
    number: usize,
    /// Global number of the first owned row of each machine, followed by the number of all rows.
    starts: Vec<u64>,
    copies: Vec<u64>,
}

impl Machine {
    fn new(board: &Arc<Board>, number: usize, rows: usize, copies: Vec<u64>) -> Self {
        let mut starts = vec![0];
        for rows in board.exchange(number, vec![rows as u64]) {
            starts.push(starts[starts.len() - 1] + rows[0]);
        }
        Self { board: board.clone(), number, starts, copies }
    }

    fn own(&self) -> std::ops::Range<u64> {
        self.starts[self.number]..self.starts[self.number + 1]
    }

    /// Posts lists of rows, and returns the lists of all machines, in the order of the machines.
    fn lists(&self, lists: impl Iterator<Item = (u64, Vec<u64>)>) -> Vec<(u64, Vec<u64>)> {
        let words = lists.flat_map(|(row, list)| [vec![row, list.len() as u64], list].concat()).collect();
        let mut all = Vec::new();
        for words in self.board.exchange(self.number, words) {
            let mut rest = words.as_slice();
            while let [row, length, after @ ..] = rest {
                let (list, after) = after.split_at(*length as usize);
                all.push((*row, list.to_vec()));
                rest = after;
            }
        }
        all
    }

    fn numbers(&self) -> Vec<u64> {
        self.own().chain(self.copies.iter().copied()).collect()
    }
}

/// Bits of a number in f64, in which every f32 is exact.
fn bits<E: Into<f64>>(x: E) -> u64 {
    x.into().to_bits()
}

fn made<T>(mut list: impl FnMut(usize, &mut Vec<T>), row: usize) -> Vec<T> {
    let mut words = Vec::new();
    list(row, &mut words);
    words
}

impl Division for Machine {
    type Error = LinearError;
    type Last = Gathered;

    fn copies(&self) -> usize {
        self.copies.len()
    }

    fn copy<E: Real + Into<f64>, const N: usize>(&mut self, rows: &mut [[E; N]]) {
        let owned = rows.len() - self.copies.len();
        let lists = self.lists_for_copies(|row, list| list.extend(rows[row].map(bits)));
        for (row, list) in rows[owned..].iter_mut().zip(lists) {
            *row = std::array::from_fn(|c| E::splat(f64::from_bits(list[c])));
        }
    }

    fn sum<E: Real + Into<f64>, const N: usize>(&mut self, rows: &mut [[E; N]]) {
        let owned = rows.len() - self.copies.len();
        for (row, list) in self.lists_for_owners(|copy, list| list.extend(rows[owned + copy].map(bits))) {
            (0..N).for_each(|c| rows[row][c] = rows[row][c] + E::splat(f64::from_bits(list[c])));
        }
    }

    fn lists_for_copies(&mut self, mut list: impl FnMut(usize, &mut Vec<u64>)) -> Vec<Vec<u64>> {
        let all = self.lists(self.own().enumerate().map(|(row, number)| (number, made(&mut list, row))));
        let list = |copy: &u64| all.iter().find(|(row, _)| row == copy).expect("of its owner").1.clone();
        self.copies.iter().map(list).collect()
    }

    fn lists_for_owners(&mut self, mut list: impl FnMut(usize, &mut Vec<u64>)) -> Vec<(usize, Vec<u64>)> {
        let copies = self.copies.iter().enumerate();
        let all = self.lists(copies.map(|(copy, &number)| (number, made(&mut list, copy))));
        let own = self.own();
        let mine = all.into_iter().filter(|(row, _)| own.contains(row));
        mine.map(|(row, list)| ((row - own.start) as usize, list)).collect()
    }

    fn totals<const N: usize>(&self, numbers: [f64; N]) -> [f64; N] {
        let all = self.board.exchange(self.number, numbers.map(f64::to_bits).to_vec());
        std::array::from_fn(|at| all.iter().map(|list| f64::from_bits(list[at])).sum())
    }

    fn largest(&self, number: f64) -> f64 {
        let all = self.board.exchange(self.number, vec![number.to_bits()]);
        all.iter().map(|list| f64::from_bits(list[0])).fold(f64::NEG_INFINITY, f64::max)
    }

    fn first(&self, rows: usize) -> u64 {
        let all = self.board.exchange(self.number, vec![rows as u64]);
        all[..self.number].iter().map(|list| list[0]).sum()
    }

    fn coarse(&self, rows: usize, copies: Vec<u64>) -> Result<Self, LinearError> {
        Ok(Self::new(&self.board, self.number, rows, copies))
    }

    fn is_last(&self, rows: usize, _: usize) -> bool {
        rows <= 20
    }

    fn last(&self, level: &LastLevel<'_>) -> Result<Gathered, LinearError> {
        let numbers = self.numbers();
        let blocks = level.blocks().map(|(row, column, block)| {
            let entries = block.as_flattened().iter().map(|x| x.to_bits());
            (numbers[row], [numbers[column]].into_iter().chain(entries).collect())
        });
        let unknowns = 6 * self.starts[self.starts.len() - 1] as usize;
        let mut dense = vec![0.0; unknowns * unknowns];
        for (row, list) in self.lists(blocks) {
            let (row, column) = (row as usize, list[0] as usize);
            for (entry, bits) in list[1..].iter().enumerate() {
                let (r, c) = (6 * row + entry / 6, 6 * column + entry % 6);
                dense[unknowns * r + c] += f64::from_bits(*bits);
                if row != column {
                    dense[unknowns * c + r] += f64::from_bits(*bits);
                }
            }
        }
        let cholesky = Cholesky::new(DMatrix::from_row_slice(unknowns, unknowns, &dense));
        let cholesky = cholesky.ok_or(LinearError::NotPositive { column: 0 })?;
        assert_eq!(level.motions.len() as u64, self.own().end - self.own().start);
        Ok(Gathered { rows: self.clone(), cholesky })
    }
}

/// Whole last level, on each machine.
struct Gathered {
    rows: Machine,
    cholesky: Cholesky<f64, Dyn>,
}

impl LastSolver for Gathered {
    fn solve(&mut self, b: &mut [[f32; 6]]) {
        let own = self.rows.own();
        let owned = (own.end - own.start) as usize;
        let words = b[..owned].as_flattened().iter().map(|x| u64::from(x.to_bits())).collect();
        let lists = self.rows.board.exchange(self.rows.number, words).concat();
        let numbers = lists.iter().map(|&bits| f64::from(f32::from_bits(bits as u32)));
        let all = self.cholesky.solve(&DVector::from_iterator(lists.len(), numbers));
        let mine = &all.as_slice()[6 * own.start as usize..6 * own.end as usize];
        b[..owned].as_flattened_mut().iter_mut().zip(mine).for_each(|(x, &y)| *x = y as f32);
    }
}

/// Part of a body on a machine: its elements, the numbers of its nodes, and the number of owned nodes.
struct Part {
    mesh: TetMesh,
    nodes: Vec<usize>,
    owned: usize,
}

/// Divides a mesh by slices along x; nodes are numbered machine after machine.
fn divide(mesh: &TetMesh, machines: usize) -> (Vec<Part>, Vec<usize>) {
    let slice = |tet: &[usize; 4]| {
        let x = tet.iter().map(|&node| mesh.positions[node][0]).sum::<f64>() / 4.0;
        ((x * machines as f64) as usize).min(machines - 1)
    };
    let mut owner = vec![usize::MAX; mesh.positions.len()];
    for tet in &mesh.tets {
        tet.iter().for_each(|&node| owner[node] = owner[node].min(slice(tet)));
    }
    let mut order: Vec<usize> = (0..owner.len()).collect();
    order.sort_by_key(|&node| owner[node]);
    let mut number = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, &node)| number[node] = at);
    let part = |machine: usize| {
        let tets: Vec<_> = mesh.tets.iter().filter(|tet| slice(tet) == machine).collect();
        let mut nodes: Vec<usize> = tets.iter().flat_map(|tet| **tet).collect();
        nodes.sort_unstable_by_key(|&node| (owner[node] != machine, number[node]));
        nodes.dedup();
        let local = |node: &usize| nodes.iter().position(|other| other == node).expect("its own");
        let tets = tets.iter().map(|tet| tet.each_ref().map(local)).collect();
        let mesh = TetMesh::new(nodes.iter().map(|&node| mesh.positions[node]).collect(), tets);
        let owned = nodes.iter().filter(|&&node| owner[node] == machine).count();
        Part { mesh, nodes, owned }
    };
    ((0..machines).map(part).collect(), number)
}

/// Applies cycles to a solution on a machine; returns the norms of the residual.
fn residuals(part: &Part, number: &[usize], board: &Arc<Board>, machine: usize) -> Vec<f64> {
    let Part { mesh, nodes, owned } = part;
    let body = Body::new(mesh, kirchhoff(), 1000.0).expect("a body");
    let mut elastic = Elastic::new(&body);
    elastic.evaluate(&body, &mesh.positions);
    let mut stiffness = NodalStiffness::of_body(&body).expect("small");
    stiffness.linearise(&body, &mut elastic, Filter::Clamp);
    let is_free: Vec<bool> = mesh.positions.iter().map(|x| x[1] > 1e-9).collect();
    let copies = nodes[*owned..].iter().map(|&node| number[node] as u64).collect();
    let mut rows = Machine::new(board, machine, *owned, copies);
    let matrix = stiffness.matrix();
    let diagonals = diagonals(matrix, &mut rows);
    let multigrid = Multigrid::new(matrix, &diagonals, &is_free, &mesh.positions, &mut rows);
    let mut multigrid = multigrid.expect("a matrix");
    assert!(multigrid.levels().0.len() > 1);
    let b: Vec<[f64; 3]> = (0..*owned)
        .map(|row| {
            let mut random = Random::new(number[nodes[row]] as u64);
            [0; 3].map(|_| f64::from(is_free[row]) * random.uniform(-1.0, 1.0))
        })
        .collect();
    let mut matrix = matrix.clone();
    let (mut x, mut product) = (vec![[0.0; 3]; nodes.len()], vec![[0.0; 3]; nodes.len()]);
    let mut norms = Vec::new();
    for _ in 0..12 {
        rows.copy(&mut x);
        matrix.multiply(&x, &mut product);
        rows.sum(&mut product);
        let residual: Vec<[f64; 3]> = (0..*owned)
            .map(|row| std::array::from_fn(|c| f64::from(is_free[row]) * (b[row][c] - product[row][c])))
            .collect();
        norms.push(rows.total(residual.as_flattened().iter().map(|r| r * r).sum()).sqrt());
        let mut z = vec![[0.0; 3]; *owned];
        multigrid.solve(&mut rows, &residual, &mut z);
        for (x, z) in x.iter_mut().zip(z) {
            (0..3).for_each(|c| x[c] += z[c]);
        }
    }
    norms
}

/// Cycles alone, without conjugate gradients, solve a system about as fast on three machines as on one.
#[test]
fn levels_of_a_divided_matrix_are_of_as_much_use() {
    let mesh = tetrahedral_box([8; 3], [1.0; 3]).expect("a box");
    let falls = |machines: usize| {
        let (parts, number) = divide(&mesh, machines);
        let (barrier, lists) = (Barrier::new(machines), Mutex::new(vec![Vec::new(); machines]));
        let board = Arc::new(Board { barrier, lists });
        let norms = std::thread::scope(|scope| {
            let (board, number) = (&board, &number);
            let run = |(machine, part)| scope.spawn(move || residuals(part, number, board, machine));
            let all: Vec<_> = parts.iter().enumerate().map(run).collect();
            all.into_iter().map(|run| run.join().expect("no panic")).collect::<Vec<_>>()
        });
        assert!(norms.iter().all(|other| *other == norms[0]), "machines disagree");
        norms[0].last().expect("twelve") / norms[0][0]
    };
    let (one, three) = (falls(1), falls(3));
    // Half of the error in each cycle.
    assert!(one <= 1e-3 && three <= 1e-3, "{one:e} on one machine, {three:e} on three");
}
