//! Prints how fast everything is, as Markdown: `cargo bench -p piola-tests --bench speed`.
//!
//! With `--quick` less often repeated, and for the best back end only. One core; nothing else should run on
//! the machine, and where something does, the least of the times is disturbed least.

#![expect(clippy::print_stdout, reason = "a command line tool")]

use std::time::Duration;

use piola::lanes::Backend;
use piola_speed::{Effort, IN_CACHE, STREAMING, processor};

mod comparisons;
mod measure;
mod point_by_point;
mod tables;
mod typed;

fn main() {
    let is_quick = std::env::args().skip(1).any(|argument| argument == "--quick");
    let at_most = Duration::MAX;
    let repeats = if is_quick { 15 } else { 101 };
    let effort = Effort { repeats, at_least: Duration::from_micros(100), at_most };
    let repeats = if is_quick { 5 } else { 15 };
    let streaming_effort = Effort { repeats, at_least: Duration::ZERO, at_most };
    let best = Backend::best();

    println!("# Nanoseconds per point, one thread\n");
    println!("Processor: {}. Best back end: {best}.\n", processor());
    println!(
        "Of {} repeats the least and, in parentheses, the median. In cache: {IN_CACHE} points, the same arrays again and \
         again. Streaming: {STREAMING} points, once through. +C: filtered with `Filter::Clamp`.\n",
        effort.repeats
    );
    println!(
        "F = I + 0.3 X with entries of X uniform in [−1, 1) and det F > 0. In lines, by points: `Layout::Lines`, \
         `Layout::Points`.\n"
    );
    println!("## Energies typed at run time\n\n{}", typed::table(effort).expect("typical parameters"));
    println!("## The method of [SZLSB11], a scalar at a time\n\n{}", comparisons::paper(effort));
    println!("## Few points a call, {best}, f64, by points\n\n{}", tables::few_points(effort));
    for backend in Backend::available().take(if is_quick { 1 } else { usize::MAX }) {
        println!("## In cache, {backend}, f64\n\n{}", tables::in_cache::<f64>(effort, backend));
        println!("## In cache, {backend}, f32\n\n{}", tables::in_cache::<f32>(effort, backend));
    }
    println!("## Streaming, {best}, f64, in lines\n\n{}", tables::streaming::<f64>(streaming_effort));
    println!("## Streaming, {best}, f32, in lines\n\n{}", tables::streaming::<f32>(streaming_effort));
}
