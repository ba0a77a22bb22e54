//! Presentation mode for lectures: plots and the sliders in use, enlarged, on the full screen.

use super::tab::Tab;
use egui::{Context, Vec2, ViewportCommand, vec2};

/// Minimum space for plots and sliders in points. On a larger screen everything is enlarged.
const LEAST: Vec2 = vec2(760.0, 470.0);
/// Minimum width of a tab next to other tabs.
const LEAST_OF_A_TAB: f32 = 370.0;
/// Maximum enlargement.
const LARGEST: f32 = 2.0;

/// Running presentation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Presentation {
    /// True if the window filled the screen before. This state is restored afterwards.
    filled_before: bool,
    /// Tabs whose axes were locked before. This state is restored afterwards.
    locked_before: Vec<Tab>,
}

impl Presentation {
    /// Starts the presentation and switches to full screen.
    pub fn begin(ctx: &Context, locked: &[Tab]) -> Self {
        let filled_before = ctx.input(|i| i.viewport().fullscreen).unwrap_or(false);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(true));
        Self { filled_before, locked_before: locked.to_vec() }
    }

    /// Returns the tabs whose axes were locked before.
    pub fn locked_before(&self) -> &Vec<Tab> {
        &self.locked_before
    }

    /// Ends the presentation and restores the window. Returns the tabs whose axes shall be locked from now on.
    pub fn end(self, ctx: &Context) -> Vec<Tab> {
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(self.filled_before));
        self.locked_before
    }
}

/// Returns the enlargement for a window with this size, in points at the chosen text size, and this number of
/// visible tabs.
pub fn enlargement(window: Vec2, tabs: usize) -> f32 {
    let fits = window / vec2(LEAST.x.max(LEAST_OF_A_TAB * tabs as f32), LEAST.y);
    // Use steps, so that a window that is being resized does not flicker.
    let factor = (20.0 * fits.min_elem()).floor() / 20.0;
    factor.clamp(1.0, LARGEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn larger_screens_enlarge_more_and_plots_keep_their_room() {
        let screens = [vec2(600.0, 400.0), vec2(1024.0, 640.0), vec2(1280.0, 800.0), vec2(1920.0, 1080.0)];
        let factors = screens.map(|screen| enlargement(screen, 2));
        assert!((factors[0] - 1.0).abs() < 1e-6 && (factors[3] - 2.0).abs() < 1e-6, "{factors:?}");
        assert!(
            factors[1] > 1.25 && factors[2] > 1.6 && factors.windows(2).all(|pair| pair[0] < pair[1]),
            "{factors:?}"
        );
        for (screen, factor) in screens.iter().zip(factors).skip(1) {
            let of_three = enlargement(*screen, 3);
            assert!(of_three <= factor && (of_three == 1.0 || screen.x / of_three >= 3.0 * LEAST_OF_A_TAB));
            assert!((*screen / factor).x >= LEAST.x && (*screen / factor).y >= LEAST.y);
        }
    }
}
