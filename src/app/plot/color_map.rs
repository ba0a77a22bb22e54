//! Colour map of fields. It is perceptually uniform and also readable in greyscale and by colour-blind people.

use crate::scene::drawing;
use egui::Color32;

/// Number of entries of a colour table, finer than a screen can show.
pub const ENTRIES: usize = 512;

/// Returns the colour at t, 0…1, from dark to light.
pub fn viridis(t: f64) -> Color32 {
    let [red, green, blue] = drawing::viridis(t);
    Color32::from_rgb(red, green, blue)
}

/// Returns all colours from dark to light, or from light to dark.
pub fn table(reversed: bool) -> Vec<Color32> {
    let t = |k: usize| k as f64 / (ENTRIES - 1) as f64;
    (0..ENTRIES).map(|k| viridis(if reversed { 1.0 - t(k) } else { t(k) })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the lightness L* of CIE 1976, 0…100.
    fn lightness(color: Color32) -> f64 {
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let y = 0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b());
        116.0 * y.cbrt() - 16.0
    }

    #[test]
    fn the_map_is_viridis() {
        for (t, [r, g, b]) in [(0.0, [68, 1, 84]), (0.25, [59, 82, 139]), (0.5, [33, 145, 140]), (1.0, [253, 231, 37])]
        {
            let color = viridis(t);
            for (ours, theirs) in [(color.r(), r), (color.g(), g), (color.b(), b)] {
                assert!((i32::from(ours) - theirs).abs() <= 8, "{t}: {color:?}");
            }
        }
    }

    #[test]
    fn lightness_rises_evenly_so_that_greyscale_prints_say_the_same() {
        let lightness: Vec<f64> = table(false).into_iter().map(lightness).collect();
        let (first, last) = (lightness[0], lightness[ENTRIES - 1]);
        assert!(first < 20.0 && last > 88.0, "{first} {last}");
        for (k, pair) in lightness.windows(33).step_by(16).enumerate() {
            let share = (pair[32] - pair[0]) / (last - first) / (32.0 / (ENTRIES - 1) as f64);
            assert!((0.6..1.6).contains(&share), "{k}: {share}");
        }
        assert_eq!(table(true).first(), table(false).last());
    }
}
