//! Explorer as a web page: one instance of this module draws it; further instances in workers of the page do the
//! computations.
//!
//! The files in `page` start both. They provide an object `ehl` with the browser functions that the program needs
//! (`ehl_explorer::host::page`).

#![cfg(target_arch = "wasm32")]

use eframe::egui::Context;
use eframe::{App, CreationContext, WebOptions, WebRunner};
use ehl_explorer::app::{Explorer, perform};
use ehl_explorer::engine::job::Performer;
use ehl_explorer::engine::{Store, Workbench};
use ehl_explorer::host::{browser, files, page};
use ehl_explorer::scene::{Scene, Table, run_scene};
use std::cell::RefCell;
use std::path::Path;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;
use web_sys::HtmlCanvasElement;

/// Draws the explorer on a canvas.
///
/// # Errors
/// If the browser has no WebGL.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement) -> Result<(), JsValue> {
    let fragment = page::fragment();
    let linked = fragment.len() > 1;
    let explorer = move |creation: &CreationContext<'_>| -> Result<Box<dyn App>, _> {
        SCREEN.set(Some(creation.egui_ctx.clone()));
        let mut explorer = Explorer::with_embedded_models().keeping_session_in(Path::new(files::SESSION), !linked);
        if linked {
            explorer.open_link(&fragment);
        }
        Ok(Box::new(explorer))
    };
    WebRunner::new().start(canvas, WebOptions::default(), Box::new(explorer)).await
}

/// Called by the page with the data for a ticket, or without data when there will be no more.
#[wasm_bindgen]
pub fn deliver(ticket: u32, bytes: Option<Vec<u8>>) {
    page::deliver(ticket, bytes);
}

/// Called by the page with a file dropped on it: name, a zero, content.
#[wasm_bindgen]
pub fn dropped(file: &[u8]) {
    browser::take_dropped(file);
    repaint();
}

/// Called by the page with the fragment of an address that the user has opened.
#[wasm_bindgen]
pub fn opened(fragment: String) {
    browser::ask(fragment);
    repaint();
}

thread_local! {
    static SCREEN: RefCell<Option<Context>> = const { RefCell::new(None) };
}

fn repaint() {
    SCREEN.with_borrow(|screen| screen.iter().for_each(Context::request_repaint));
}

/// Runs a scene, given as text, without the screen. Returns its tables as `ehl-explorer run --out` writes them.
///
/// # Errors
/// With a sentence if the scene is invalid.
#[wasm_bindgen]
pub fn run(scene: &str) -> Result<String, JsValue> {
    let refused = |why: &dyn std::fmt::Display| JsValue::from_str(&why.to_string());
    let scene = Scene::from_ron(scene).map_err(|why| refused(&why))?;
    let outcome = run_scene(&scene, &mut Workbench::new(""), &()).map_err(|why| refused(&why))?;
    Ok(outcome.tables.iter().map(Table::to_csv).collect::<Vec<_>>().join("\n"))
}

/// Does a task in a worker.
#[wasm_bindgen]
pub fn work(ticket: u32, kind: &str, task: &[u8]) {
    thread_local! {
        static STORE: Store = Store::default();
    }
    let performer = Performer {
        send: Box::new(move |event| page::send(ticket, &event)),
        stops: Box::new(move || page::stops(ticket)),
    };
    STORE.with(|store| perform(kind, task, store, performer));
}
