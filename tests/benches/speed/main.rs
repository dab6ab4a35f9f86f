//! Prints how fast everything is, as Markdown: `cargo bench -p piola-tests --bench speed`.
//!
//! With `--quick` less often repeated, and for the best back end only. One core; nothing else should run on
//! the machine, and where something does, the least of the times is disturbed least.

#![expect(clippy::print_stdout, reason = "a command line tool")]

use std::time::Duration;

use piola::lanes::Backend;
use piola_speed::{Effort, IN_CACHE, processor};

mod measure;
mod tables;
mod typed;

fn main() {
    let is_quick = std::env::args().skip(1).any(|argument| argument == "--quick");
    let at_most = Duration::MAX;
    let repeats = if is_quick { 15 } else { 101 };
    let effort = Effort { repeats, at_least: Duration::from_micros(100), at_most };
    let best = Backend::best();

    println!("# Nanoseconds per point, one thread\n");
    println!("Processor: {}. Best back end: {best}.\n", processor());
    println!(
        "Of {} repeats the least and, in parentheses, the median. In cache: {IN_CACHE} points, the same arrays again and \
         again. +C: filtered with `Filter::Clamp`.\n",
        effort.repeats
    );
    println!(
        "F = I + 0.3 X with entries of X uniform in [−1, 1) and det F > 0. In lines, by points: `Layout::Lines`, \
         `Layout::Points`.\n"
    );
    println!("## Energies typed at run time\n\n{}", typed::table(effort).expect("typical parameters"));
    println!("## Few points a call, {best}, f64, by points\n\n{}", tables::few_points(effort));
    for backend in Backend::available().take(if is_quick { 1 } else { usize::MAX }) {
        println!("## In cache, {backend}, f64\n\n{}", tables::in_cache::<f64>(effort, backend));
        println!("## In cache, {backend}, f32\n\n{}", tables::in_cache::<f32>(effort, backend));
    }
}
