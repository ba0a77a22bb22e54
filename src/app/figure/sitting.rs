//! Recording of figures for print. The plots of a tab are drawn once more, invisibly, in the theme and the units of
//! the figure, and their content is recorded as charts. The charts are placed on pages of any size, with a title
//! and a caption.

use crate::app::tab::Tab;
use crate::scene::drawing::{Pixels, Rgb};
use crate::scene::{Chart, ColorScale};
use egui::{Color32, ColorImage, Context, Id};

/// Recorded charts, and the state of the recording.
#[derive(Clone, Default)]
pub struct Sitting {
    /// True if plots are recorded in this frame.
    pub on: bool,
    /// Tab that is being drawn.
    pub tab: Option<Tab>,
    pub charts: Vec<(Tab, Chart)>,
}

impl Sitting {
    /// Returns true while the plots of a tab are recorded.
    pub fn is_on(&self) -> bool {
        self.on && self.tab.is_some()
    }

    /// Stores a chart.
    pub fn keep(&mut self, chart: Chart) {
        self.charts.extend(self.tab.map(|tab| (tab, chart)));
    }
}

/// Gives access to the charts of a window.
pub fn with_sitting<T>(ctx: &Context, with: impl FnOnce(&mut Sitting) -> T) -> T {
    ctx.data_mut(|data| with(data.get_temp_mut_or_default(Id::unique("figures"))))
}

/// Sets the tab of the plots that are drawn next.
pub fn enter(ctx: &Context, tab: Option<Tab>) {
    with_sitting(ctx, |sitting| sitting.tab = tab);
}

/// Sets the colour scale of the map that was drawn last.
pub fn scale(ctx: &Context, label: &str, ends: (f64, f64), colors: &[Color32]) {
    with_sitting(ctx, |sitting| {
        let map = sitting.charts.last_mut().filter(|_| sitting.on).and_then(|(_, chart)| chart.map.as_mut());
        if let Some(map) = map {
            let colors = colors.iter().map(|color| rgb(*color).0).collect();
            map.scale = Some(ColorScale { label: label.to_owned(), ends, colors });
        }
    });
}

/// Returns a colour and its opacity.
pub fn rgb(color: Color32) -> (Rgb, f64) {
    let [r, g, b, alpha] = color.to_srgba_unmultiplied();
    ([r, g, b], f64::from(alpha) / 255.0)
}

/// Returns an image of the screen as pixels.
pub fn pixels(image: &ColorImage) -> Pixels {
    let rgb = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    Pixels { width: image.size[0], rgb }
}
