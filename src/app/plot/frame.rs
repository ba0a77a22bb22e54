//! Plot with described axes, for the screen in the chosen units and for print.

use crate::app::controls::named;
use crate::app::figure::{Axis, Canvas, Recording};
use crate::app::plot::axes::{TITLE_SIZE, decade_label, few_decade_marks, log_label, log_marks, round_marks, tick};
use crate::app::theme::rich;
use crate::app::units::{Manner, Scale, Units};
use egui::{Color32, Id, Ui, Vec2, Vec2b};
use egui_plot::{GridInput, GridMark, HoverPosition, Plot, PlotBounds, PlotResponse};

/// Plot in the style of the explorer.
pub struct PlotFrame<'a> {
    plot: Plot<'a>,
    x: Axis,
    y: Axis,
    /// Approximate number of marks of each axis. `None` if the axis defines its own marks.
    marks: [Option<f64>; 2],
    equal: bool,
    manner: Manner,
    ink: Color32,
}

/// Settings that are passed on to the plot of the toolkit.
macro_rules! handed_on {
    ($($name:ident($($argument:ident: $kind:ty),*);)*) => {
        $(
            #[doc = concat!("The same as `Plot::", stringify!($name), "`.")]
            pub fn $name(mut self, $($argument: $kind),*) -> Self {
                self.plot = self.plot.$name($($argument),*);
                self
            }
        )*
    };
}

impl<'a> PlotFrame<'a> {
    /// Creates a plot whose axes have about `marks` marks. A title may contain symbols (see [`rich`]); an empty one
    /// is omitted.
    pub fn new(ui: &Ui, plot: Plot<'a>, titles: [&str; 2], marks: [f64; 2]) -> Self {
        let axis = |title: &str| Axis { title: title.to_owned(), ..Axis::default() };
        let [x, y] = titles.map(axis);
        let (manner, ink) = (Manner::of(ui.ctx()), ui.visuals().text_color());
        Self { plot, x, y, marks: marks.map(Some), equal: false, manner, ink }
    }

    handed_on! {
        allow_boxed_zoom(on: bool);
        allow_double_click_reset(on: bool);
        allow_drag(on: bool);
        allow_zoom(on: bool);
        auto_bounds(on: Vec2b);
        default_x_bounds(from: f64, to: f64);
        default_y_bounds(from: f64, to: f64);
        include_x(x: f64);
        include_y(y: f64);
        label_formatter(words: impl Fn(&HoverPosition<'_>) -> Option<String> + 'a);
        link_axis(group: Id, link: Vec2b);
        link_cursor(group: Id, link: Vec2b);
        reset();
        set_margin_fraction(fraction: Vec2);
        show_x(show: bool);
        show_y(show: bool);
        width(width: f32);
        y_axis_min_width(width: f32);
    }

    /// The same as `Plot::data_aspect`. On paper both axes have the same scale.
    pub fn data_aspect(mut self, aspect: f32) -> Self {
        self.plot = self.plot.data_aspect(aspect);
        self.equal = true;
        self
    }

    /// Sets the approximate number of round marks on the horizontal axis.
    pub fn marks_x(mut self, marks: f64) -> Self {
        self.marks[0] = Some(marks);
        self
    }

    /// Sets the approximate number of round marks on the vertical axis.
    pub fn marks_y(mut self, marks: f64) -> Self {
        self.marks[1] = Some(marks);
        self
    }

    /// Sets custom marks on the horizontal axis.
    pub fn x_grid_spacer(mut self, marks: impl Fn(GridInput) -> Vec<GridMark> + 'a) -> Self {
        self.marks[0] = None;
        self.plot = self.plot.x_grid_spacer(marks);
        self
    }

    /// Sets custom marks on the vertical axis.
    pub fn y_grid_spacer(mut self, marks: impl Fn(GridInput) -> Vec<GridMark> + 'a) -> Self {
        self.marks[1] = None;
        self.plot = self.plot.y_grid_spacer(marks);
        self
    }

    /// Declares that horizontal values are decimal logarithms over few decades.
    pub fn log_x(mut self) -> Self {
        self.x.log = true;
        self.plot = self.plot.x_axis_formatter(|mark, _| log_label(mark));
        self.x_grid_spacer(log_marks)
    }

    /// Declares that vertical values are decimal logarithms over few decades.
    pub fn log_y(mut self) -> Self {
        self.y.log = true;
        self.plot = self.plot.y_axis_formatter(|mark, _| log_label(mark));
        self.y_grid_spacer(log_marks)
    }

    /// Declares that horizontal values are decimal logarithms, with at most about `most` marks.
    pub fn decades_x(mut self, most: f64) -> Self {
        self.x.log = true;
        self.plot = self.plot.x_axis_formatter(|mark, _| decade_label(mark));
        self.x_grid_spacer(move |input| few_decade_marks(input, most))
    }

    /// Declares that vertical values are decimal logarithms, with at most about `most` marks.
    pub fn decades_y(self, most: f64) -> Self {
        self.decades_y_at(move |input| few_decade_marks(input, most))
    }

    /// Declares that vertical values are decimal logarithms, with custom marks.
    pub fn decades_y_at(mut self, marks: impl Fn(GridInput) -> Vec<GridMark> + 'a) -> Self {
        self.y.log = true;
        self.plot = self.plot.y_axis_formatter(|mark, _| decade_label(mark));
        self.y_grid_spacer(marks)
    }

    /// Sets names instead of numbers on the vertical axis. The screen shows them only if `shown` is true.
    pub fn names_y(mut self, names: Vec<(f64, String)>, shown: bool) -> Self {
        let marks: Vec<GridMark> = names.iter().map(|(value, _)| GridMark { value: *value, step_size: 1.0 }).collect();
        self.y.names.clone_from(&names);
        self.plot = self.plot.y_axis_formatter(move |mark, _| {
            let name = names.iter().find(|(value, _)| shown && (value - mark.value).abs() < 1e-9);
            name.map_or_else(String::new, |(_, name)| name.clone())
        });
        self.y_grid_spacer(move |_| marks.clone())
    }

    /// Sets the title of the horizontal axis on paper. On the screen it is below a neighbouring plot.
    pub fn paper_x(mut self, title: impl Into<String>) -> Self {
        self.x.on_paper = title.into();
        self
    }

    /// Sets the title of the vertical axis on paper.
    pub fn paper_y(mut self, title: impl Into<String>) -> Self {
        self.y.on_paper = title.into();
        self
    }

    /// Sets scale and title of the horizontal axis with units. The unit follows the title.
    pub fn units_x(mut self, scale: impl Into<Option<Scale>>, title: &str) -> Self {
        with_units(&mut self.x, self.manner.units, scale.into(), title);
        self
    }

    /// Sets scale and title of the vertical axis with units.
    pub fn units_y(mut self, scale: impl Into<Option<Scale>>, title: &str) -> Self {
        with_units(&mut self.y, self.manner.units, scale.into(), title);
        self
    }

    /// Sets scale and title of the horizontal axis of plotted values that have a unit in any case.
    pub fn always_x(mut self, scale: Scale, title: &str) -> Self {
        with_units(&mut self.x, Units::Dimensional, Some(scale), title);
        self
    }

    /// Sets scale and title of the vertical axis of plotted values that have a unit in any case.
    pub fn always_y(mut self, scale: Scale, title: &str) -> Self {
        with_units(&mut self.y, Units::Dimensional, Some(scale), title);
        self
    }

    /// Draws the plot under its accessible name, which is also its name in the export.
    pub fn show<R>(
        self,
        ui: &mut Ui,
        name: &str,
        content: impl FnOnce(&mut Canvas<'_, 'a>) -> R + 'a,
    ) -> PlotResponse<R> {
        let Self { mut plot, x, y, marks, equal, manner, ink } = self;
        let (across, up) = (x.factor, y.factor);
        if let Some(marks) = marks[0] {
            plot = plot
                .x_grid_spacer(move |input| scaled_marks(input, marks, across))
                .x_axis_formatter(move |mark, _| tick(mark.value * across));
        }
        if let Some(marks) = marks[1] {
            plot = plot
                .y_grid_spacer(move |input| scaled_marks(input, marks, up))
                .y_axis_formatter(move |mark, _| tick(mark.value * up));
        }
        if !x.title.is_empty() {
            plot = plot.x_axis_label(rich(&x.title, TITLE_SIZE, ink));
        }
        plot = plot.y_axis_label(rich(&y.title, TITLE_SIZE, ink));
        let kept = Id::unique(("bounds", name.to_owned()));
        let still = ui.data(|data| data.get_temp::<[f64; 4]>(kept)).filter(|_| manner.locked);
        let recording = Recording::wanted(ui.ctx(), name, [&x, &y], equal);
        let shown = plot.show(ui, move |plot| {
            if let Some([left, below, right, above]) = still {
                let (min, max) = ([left / across, below / up], [right / across, above / up]);
                plot.set_plot_bounds(PlotBounds::from_min_max(min, max));
            }
            let mut canvas = Canvas::new(plot, recording, still.is_some());
            let inner = content(&mut canvas);
            (inner, canvas.recorded())
        });
        let PlotResponse { inner: (inner, recording), response, transform, hovered_plot_item } = shown;
        let bounds = transform.bounds();
        let ([left, below], [right, above]) = (bounds.min(), bounds.max());
        ui.data_mut(|data| data.insert_temp(kept, [left * across, below * up, right * across, above * up]));
        if let Some(recording) = recording {
            recording.end(ui.ctx(), bounds);
        }
        PlotResponse { inner, response: named(ui, response, name), transform, hovered_plot_item }
    }
}

fn with_units(axis: &mut Axis, units: Units, scale: Option<Scale>, title: &str) {
    let Some(Scale { factor, unit }) = scale.filter(|_| units == Units::Dimensional) else { return };
    if factor.is_finite() && factor > 0.0 {
        axis.factor = factor;
        // A title that the screen shows elsewhere stays empty.
        for name in [&mut axis.title, &mut axis.on_paper] {
            if !name.is_empty() {
                *name = format!("{title} / {unit}");
            }
        }
    }
}

/// Returns marks that are round after multiplication with a factor.
fn scaled_marks(input: GridInput, marks: f64, factor: f64) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    let scaled = GridInput { bounds: (from * factor, to * factor), base_step_size: input.base_step_size * factor };
    let back = |mark: GridMark| GridMark { value: mark.value / factor, step_size: mark.step_size / factor };
    round_marks(scaled, marks).into_iter().map(back).collect()
}
