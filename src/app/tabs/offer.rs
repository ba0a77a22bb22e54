//! Exports of a tab, in a menu at the same place of each tab.

use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::named;
use crate::app::purpose::{Purpose, Written};
use crate::app::tab::Tab;
use crate::engine::arrays::{Array, npz};
use crate::scene::ReportFormat;
use egui::{Button, Ui};

/// Export with its name and a function that makes it. `None` if there is nothing to export yet.
pub struct Offer<'a> {
    name: &'static str,
    tip: &'static str,
    make: Option<Box<dyn Fn() -> Command + 'a>>,
}

impl<'a> Offer<'a> {
    /// Creates an export from a function that returns its command.
    pub fn new(name: &'static str, tip: &'static str, make: Option<impl Fn() -> Command + 'a>) -> Self {
        let make = make.map(|make| Box::new(make) as Box<dyn Fn() -> Command + 'a>);
        Self { name, tip, make }
    }

    /// Creates an export of arrays for numpy.
    pub fn arrays<T: 'a>(
        name: &'static str,
        tip: &'static str,
        of: Option<T>,
        arrays: impl Fn(&T) -> Vec<Array> + 'a,
    ) -> Self {
        let write = |arrays: Vec<Array>| Command::Ask(Purpose::Write(Written::Arrays, npz(&arrays).into()));
        Self::new(name, tip, of.map(|of| move || write(arrays(&of))))
    }

    /// Creates an export of a table.
    pub fn table<T: 'a>(
        name: &'static str,
        tip: &'static str,
        of: Option<T>,
        text: impl Fn(&T) -> String + 'a,
    ) -> Self {
        Self::new(name, tip, of.map(|of| move || Command::csv(text(&of))))
    }
}

/// Draws the menu of a tab. Its entries are computed only while it is open.
pub fn menu<'a>(ui: &mut Ui, tab: Tab, offers: impl FnOnce() -> Vec<Offer<'a>>, commands: &mut Commands) {
    let shown = ui.menu_button("Export", |ui| {
        let item = |ui: &mut Ui, name: &str, tip: &str, there: bool| {
            let response = ui.add_enabled(there, Button::new(name)).on_hover_text(tip);
            let clicked = response.on_disabled_hover_text("Not available yet").clicked();
            if clicked {
                ui.close();
            }
            clicked
        };
        let tip = "A plot of this tab with a size, a title and a caption, as SVG or PNG";
        if item(ui, "Figure…", tip, true) {
            commands.push(Command::ExportFigure(tab));
        }
        ui.separator();
        for offer in offers() {
            if item(ui, offer.name, offer.tip, offer.make.is_some())
                && let Some(make) = offer.make
            {
                commands.push(make());
            }
        }
        ui.separator();
        for (name, format) in [("Report as PDF…", ReportFormat::Pdf), ("Report as HTML…", ReportFormat::Html)] {
            let tip = "One page with inputs, results, checks and figures of the contact on the screen, in full and by \
                       the reduced model";
            if item(ui, name, tip, true) {
                commands.push(Command::ExportReport(format));
            }
        }
    });
    let tip = "Figures and data of this tab, and a report of the contact";
    named(ui, shown.response, &format!("Export from {}", tab.title())).on_hover_text(tip);
}
