//! The place of the window on the screen.

use egui::{Context, Rect};
use serde::{Deserialize, Serialize};

/// Where the window stands and how large it is, in points of the screen, whatever the size of everything in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Place {
    pub(super) corner: Option<(f32, f32)>,
    /// Width and height.
    pub size: (f32, f32),
    /// Whether it fills the screen.
    pub maximized: bool,
    /// Width of the panel with the sliders.
    pub sliders: f32,
}

impl Default for Place {
    fn default() -> Self {
        Self { corner: None, size: (1280.0, 800.0), maximized: false, sliders: 312.0 }
    }
}

/// Whether a number of a file lies where numbers of its kind do; not a number lies nowhere.
pub fn within<T: PartialOrd>(value: T, (from, to): (T, T)) -> bool {
    from <= value && value <= to
}

impl Place {
    /// Smallest size of a window.
    pub const LEAST: (f32, f32) = (900.0, 560.0);
    /// Widths of the panel with the sliders.
    pub const SLIDERS: (f32, f32) = (250.0, 520.0);

    /// Returns true if all numbers lie where numbers of their kind do.
    pub fn is_sound(&self) -> bool {
        let ((width, height), (least_width, least_height)) = (self.size, Self::LEAST);
        within(width, (0.5 * least_width, 16e3))
            && within(height, (0.5 * least_height, 16e3))
            && within(self.sliders, Self::SLIDERS)
            && self.corner.is_none_or(|(x, y)| within(x, (-16e3, 16e3)) && within(y, (-16e3, 16e3)))
    }

    /// Takes in where the window stands; a window that fills the screen remembers where it stood before.
    pub fn follow(&mut self, ctx: &Context) {
        let zoom = ctx.zoom_factor();
        ctx.input(|input| {
            let viewport = input.viewport();
            self.maximized = viewport.maximized.unwrap_or(false);
            if self.maximized || viewport.fullscreen == Some(true) || viewport.minimized == Some(true) {
                return;
            }
            if let Some(size) = viewport.inner_rect.map(|rect| rect.size() * zoom).filter(|size| size.is_finite()) {
                self.size = (size.x.round(), size.y.round());
            }
            let corner = |rect: Rect| ((rect.min.x * zoom).round(), (rect.min.y * zoom).round());
            self.corner = viewport.outer_rect.map(corner).or(self.corner);
        });
    }

    #[cfg(feature = "desktop")]
    pub fn window(&self) -> egui::ViewportBuilder {
        let window = egui::ViewportBuilder::default()
            .with_inner_size([self.size.0, self.size.1])
            .with_min_inner_size([Self::LEAST.0, Self::LEAST.1])
            .with_maximized(self.maximized);
        // Windows shows nothing of a window whose screen has been taken away.
        match self.corner.filter(|_| !cfg!(windows)) {
            Some((x, y)) => window.with_position([x, y]),
            None => window,
        }
    }
}
