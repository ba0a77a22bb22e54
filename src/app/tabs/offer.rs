//! Export menu of a tab. Every tab has it at the same place. It contains a figure, the exports that the tab offers, and
//! reports of the contact.

use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::named;
use crate::app::purpose::{Purpose, Written};
use crate::app::tab::Tab;
use crate::engine::arrays::{Array, npz};
use crate::scene::ReportFormat;
use egui::{Button, Ui};

/// Export that a tab offers in its menu.
pub struct Offer<'a> {
    /// Label in the menu.
    name: &'static str,
    /// Tooltip.
    tip: &'static str,
    /// Returns the command that exports the data. `None` if there is nothing to export yet.
    make: Option<Box<dyn Fn() -> Command + 'a>>,
}

impl<'a> Offer<'a> {
    /// Creates an export. `make` returns its command; `None` disables the entry.
    pub fn new(name: &'static str, tip: &'static str, make: Option<impl Fn() -> Command + 'a>) -> Self {
        let make = make.map(|make| Box::new(make) as Box<dyn Fn() -> Command + 'a>);
        Self { name, tip, make }
    }

    /// Creates an export of arrays in the file format npz of NumPy. `arrays` computes them from `of`; if that is
    /// `None`, the entry is disabled.
    pub fn arrays<T: 'a>(
        name: &'static str,
        tip: &'static str,
        of: Option<T>,
        arrays: impl Fn(&T) -> Vec<Array> + 'a,
    ) -> Self {
        let write = |arrays: Vec<Array>| Command::Ask(Purpose::Write(Written::Arrays, npz(&arrays).into()));
        Self::new(name, tip, of.map(|of| move || write(arrays(&of))))
    }

    /// Creates an export of a CSV table. `text` computes it from `of`; if that is `None`, the entry is disabled.
    pub fn table<T: 'a>(
        name: &'static str,
        tip: &'static str,
        of: Option<T>,
        text: impl Fn(&T) -> String + 'a,
    ) -> Self {
        Self::new(name, tip, of.map(|of| move || Command::csv(text(&of))))
    }
}

/// Draws the export menu of a tab. `offers` is called only while the menu is open.
pub fn menu<'a>(ui: &mut Ui, tab: Tab, offers: impl FnOnce() -> Vec<Offer<'a>>, commands: &mut Commands) {
    let shown = ui.menu_button("Export", |ui| {
        let item = |ui: &mut Ui, name: &str, tip: &str, enabled: bool| {
            let response = ui.add_enabled(enabled, Button::new(name)).on_hover_text(tip);
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
