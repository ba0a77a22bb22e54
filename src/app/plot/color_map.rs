//! Colour map of fields. It is perceptually uniform and also readable in greyscale and by colour-blind people.

use egui::Color32;

/// Number of entries of a colour table, finer than a screen can show.
pub const ENTRIES: usize = 512;

/// Viridis (S. van der Walt and N. Smith, public domain) as a polynomial of sixth degree in each channel, constant
/// term first. It is within 2 % of the original everywhere.
const VIRIDIS: [[f64; 3]; 7] = [
    [0.277_727_3, 0.005_407_3, 0.334_099_8],
    [0.105_093_0, 1.404_613_5, 1.384_590_2],
    [-0.330_861_8, 0.214_847_6, 0.095_095_2],
    [-4.634_230_5, -5.799_101_0, -19.332_441_0],
    [6.228_269_9, 14.179_933_4, 56.690_552_6],
    [4.776_385_0, -13.745_145_4, -65.353_032_6],
    [-5.435_455_9, 4.645_852_6, 26.312_435_2],
];

/// Returns the colour at t, 0…1, from dark to light.
pub fn viridis(t: f64) -> Color32 {
    let t = t.clamp(0.0, 1.0);
    let channel = |c: usize| {
        let value = VIRIDIS.iter().rev().fold(0.0, |sum, coefficients| sum * t + coefficients[c]);
        (255.0 * value).round().clamp(0.0, 255.0) as u8
    };
    Color32::from_rgb(channel(0), channel(1), channel(2))
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
