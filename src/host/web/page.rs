//! What the page does for the program, and what it calls.
//!
//! The page has an object `ehl` with these functions before the program starts. Calls that take a ticket answer later by
//! [`deliver`].

use std::cell::RefCell;
use std::collections::HashMap;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Offers a file for download.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn download(name: &str, bytes: &[u8]);
    /// Lets the user choose a file; its name and content come as one delivery.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn pick(endings: &str, ticket: u32);
    /// Keeps a text beyond this visit; returns why it cannot.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn keep(name: &str, text: &str) -> Option<String>;
    /// A text that was kept.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn kept(name: &str) -> Option<String>;
    /// Sends a task to the worker of a lane; returns whether there are workers.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn post(lane: u32, ticket: u32, kind: &str, task: &[u8]) -> bool;
    /// Asks a task to stop.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn stop(ticket: u32, times: u8);
    /// Fetches the file of a model; an empty delivery says that it is there, none that it is not.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn fetch_model(name: &str, ticket: u32);
    /// The file of a model that has been fetched. A worker fetches it.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn model(name: &str) -> Option<Vec<u8>>;
    /// Puts a fragment into the address.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn link(fragment: &str);
    /// Has something said to people who cannot see the canvas.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn news(text: &str);
    /// The fragment of the address.
    #[wasm_bindgen(js_namespace = ehl)]
    pub fn fragment() -> String;
    /// Sends what a task has found to the instance that posted it. For workers.
    #[wasm_bindgen(js_namespace = ehl)]
    pub fn send(ticket: u32, event: &[u8]);
    /// How often a task was asked to stop. For workers.
    #[wasm_bindgen(js_namespace = ehl)]
    pub fn stops(ticket: u32) -> u8;
}

/// Takes what a ticket brings, or that it brings nothing any more; returns whether more may come.
type Receive = Box<dyn FnMut(Option<Vec<u8>>) -> bool>;

#[derive(Default)]
struct Tickets {
    last: u32,
    waiting: HashMap<u32, Receive>,
}

thread_local! {
    static TICKETS: RefCell<Tickets> = RefCell::default();
}

/// A new ticket.
pub(super) fn ticket(receive: impl FnMut(Option<Vec<u8>>) -> bool + 'static) -> u32 {
    TICKETS.with_borrow_mut(|tickets| {
        tickets.last += 1;
        tickets.waiting.insert(tickets.last, Box::new(receive));
        tickets.last
    })
}

/// Forgets a ticket.
pub(super) fn forget(ticket: u32) {
    TICKETS.with_borrow_mut(|tickets| tickets.waiting.remove(&ticket));
}

/// Called by the page when a ticket brings something, or `None` when it brings nothing any more.
pub fn deliver(ticket: u32, bytes: Option<Vec<u8>>) {
    // What is called may ask for further tickets.
    let receive = TICKETS.with_borrow_mut(|tickets| tickets.waiting.remove(&ticket));
    let last = bytes.is_none();
    if let Some(mut receive) = receive
        && receive(bytes)
        && !last
    {
        TICKETS.with_borrow_mut(|tickets| tickets.waiting.insert(ticket, receive));
    }
}
