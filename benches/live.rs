//! What happens at every change on screen, on the example of paper 004: conditions, design, simulation, all of it.

#![cfg_attr(target_arch = "wasm32", no_main)]
#![cfg(not(target_arch = "wasm32"))]

use descry::document::{Document, read_document, write_document_compact};
use descry::numerics::Watch;
use descry::observer::{DesignChoice, Order, assess, conditions};
use descry::paper::example;
use descry::session::{JobRequest, Task, analyse, perform};

fn main() {
    divan::main();
}

/// The example with its parameter uncertainty on or off.
fn document(uncertain: bool) -> Document {
    let text = example("proportional-integral").map_or("", |example| example.text);
    let Ok(mut document) = read_document(text) else { unreachable!("the example is tested") };
    if let Some(uncertainty) = &mut document.scenario.uncertainty {
        uncertainty.scale = if uncertain { 1.0 } else { 0.0 };
    }
    document
}

#[divan::bench(args = [Order::Reduced, Order::Full, Order::General])]
fn ask_conditions(bencher: divan::Bencher<'_, '_>, order: Order) {
    let document = document(false);
    let Ok(system) = document.system() else { return };
    let choice = DesignChoice { order, ..document.design.clone() };
    bencher.bench(|| conditions(&system.clone().into(), &choice, &document.tolerance));
}

#[divan::bench(args = [Order::Reduced, Order::Full, Order::General])]
fn conditions_and_design(bencher: divan::Bencher<'_, '_>, order: Order) {
    let document = document(false);
    let Ok(system) = document.system() else { return };
    let choice = DesignChoice { order, ..document.design.clone() };
    bencher.bench(|| assess(&system.clone().into(), &choice, &document.tolerance, &Watch::none()));
}

#[divan::bench(args = [false, true])]
fn whole_analysis(bencher: divan::Bencher<'_, '_>, uncertain: bool) {
    let document = document(uncertain);
    bencher.bench(|| analyse(&document, &Watch::none()));
}

#[divan::bench(args = [false, true])]
fn whole_job(bencher: divan::Bencher<'_, '_>, uncertain: bool) {
    let document = write_document_compact(&document(uncertain));
    let request = JobRequest { id: 1, revision: 1, document, task: Task::Analyse };
    bencher.bench(|| perform(&request, &Watch::none()));
}
