//! Functions of the page that the program calls, and functions of the program that the page calls.
//!
//! The page defines an object `ehl` with these functions before the program starts. Calls with a ticket return
//! their results later through [`deliver`].

use std::cell::RefCell;
use std::collections::HashMap;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Offers a file for download.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn download(name: &str, bytes: &[u8]);
    /// Lets the user choose a file. Its name and content arrive as one delivery.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn pick(endings: &str, ticket: u32);
    /// Stores a text beyond this visit. Returns a reason if it fails.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn keep(name: &str, text: &str) -> Option<String>;
    /// Returns a stored text.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn kept(name: &str) -> Option<String>;
    /// Sends a task to the worker of a lane. Returns false if there are no workers.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn post(lane: u32, ticket: u32, kind: &str, task: &[u8]) -> bool;
    /// Requests a task to stop.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn stop(ticket: u32, times: u8);
    /// Fetches the file of a model. An empty delivery reports success, no delivery a failure.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn fetch_model(name: &str, ticket: u32);
    /// Returns the file of a model that has been fetched. In a worker this call fetches it.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn model(name: &str) -> Option<Vec<u8>>;
    /// Sets the fragment of the address.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn link(fragment: &str);
    /// Announces a message to users of screen readers.
    #[wasm_bindgen(js_namespace = ehl)]
    pub(super) fn news(text: &str);
    /// Returns the fragment of the address.
    #[wasm_bindgen(js_namespace = ehl)]
    pub fn fragment() -> String;
    /// Sends a result of a task to the instance that posted it. For workers.
    #[wasm_bindgen(js_namespace = ehl)]
    pub fn send(ticket: u32, event: &[u8]);
    /// Returns how often a task was requested to stop. For workers.
    #[wasm_bindgen(js_namespace = ehl)]
    pub fn stops(ticket: u32) -> u8;
}

/// Receives the deliveries of a ticket, or `None` after the last one. Returns true if more may follow.
type Receive = Box<dyn FnMut(Option<Vec<u8>>) -> bool>;

#[derive(Default)]
struct Tickets {
    last: u32,
    waiting: HashMap<u32, Receive>,
}

thread_local! {
    static TICKETS: RefCell<Tickets> = RefCell::default();
}

/// Returns a new ticket.
pub(super) fn ticket(receive: impl FnMut(Option<Vec<u8>>) -> bool + 'static) -> u32 {
    TICKETS.with_borrow_mut(|tickets| {
        tickets.last += 1;
        tickets.waiting.insert(tickets.last, Box::new(receive));
        tickets.last
    })
}

/// Removes a ticket.
pub(super) fn forget(ticket: u32) {
    TICKETS.with_borrow_mut(|tickets| tickets.waiting.remove(&ticket));
}

/// Passes a delivery to the receiver of a ticket; `None` marks the end. Called by the page.
pub fn deliver(ticket: u32, bytes: Option<Vec<u8>>) {
    // The receiver may request further tickets, so it must not run inside the borrow.
    let receive = TICKETS.with_borrow_mut(|tickets| tickets.waiting.remove(&ticket));
    let last = bytes.is_none();
    if let Some(mut receive) = receive
        && receive(bytes)
        && !last
    {
        TICKETS.with_borrow_mut(|tickets| tickets.waiting.insert(ticket, receive));
    }
}
