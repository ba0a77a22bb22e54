//! The map for other programs: all nodes as a table, the picture with axes as SVG.

use super::images::{ContactMap, ticks};
use super::{MapView, Shown, scale};
use crate::app::export as tables;
use crate::app::numbers;
use crate::app::picture::Picture;
use std::fmt::Write as _;

/// All nodes of both halves, X after X, with their SI twins.
pub fn csv(picture: &Picture) -> String {
    let (hertz, scale) = (picture.key.point.hertz(), picture.key.point.film_scale_m());
    let solution = &picture.solution;
    let ny = solution.y.len();
    let halves = move || (0..ny).map(|j| (j, 1.0)).chain((0..ny.saturating_sub(1)).rev().map(|j| (j, -1.0)));
    let rows = (0..solution.x.len()).flat_map(move |i| {
        halves().map(move |(j, sign)| {
            let (x, y, k) = (solution.x[i], sign * solution.y[j], i * ny + j);
            let (p, h) = (solution.pressure[k], solution.film[k]);
            let a = hertz.half_width_m;
            [x, y, p, h, x * a, y * a, p * hertz.pressure_pa, h * scale].map(Some).to_vec()
        })
    });
    let comments = [tables::describe(picture), picture.origin.describe()];
    tables::csv(&comments, &["X", "Y", "P", "H", "x_m", "y_m", "p_pa", "h_m"], rows)
}

/// Pixels per Hertzian radius.
const UNIT: f64 = 110.0;
/// Room left of the map, above and below it.
const MARGIN: (f64, f64, f64) = (64.0, 58.0, 74.0);
/// Room right of the map, for the scale.
const SCALE: f64 = 130.0;

/// The map with title, axes, contours, cuts, scale and parameters.
pub fn svg(picture: &Picture, images: &ContactMap, view: &MapView) -> String {
    let (from, to, edge) = images.domain();
    let (left, above, below) = MARGIN;
    let (width, height) = ((to - from) * UNIT, -2.0 * edge * UNIT);
    let at = |x: f64, y: f64| (left + (x - from) * UNIT, above + (-edge - y) * UNIT);
    let mut out = String::new();
    // Writing to a string cannot fail.
    let mut line = |text: String| {
        let _ok = writeln!(out, "{text}");
    };
    let (page_width, page_height) = (left + width + SCALE, above + height + below);
    line(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{page_width:.0}\" height=\"{page_height:.0}\" viewBox=\"0 0 {page_width:.0} {page_height:.0}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">"
    ));
    line(format!("<rect width=\"{page_width:.0}\" height=\"{page_height:.0}\" fill=\"#fff\"/>"));
    let moes = numbers::moes(picture.key.point.moes());
    line(format!("<text x=\"{left:.0}\" y=\"22\" font-size=\"16\">{}, {moes}</text>", view.shown.name()));
    line(format!(
        "<text x=\"{left:.0}\" y=\"42\" font-size=\"10\" fill=\"#666\">{}</text>",
        escaped(&caption(picture, view))
    ));
    let image = base64(&images.png());
    line(format!(
        "<image x=\"{left:.1}\" y=\"{above:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" preserveAspectRatio=\"none\" href=\"data:image/png;base64,{image}\"/>"
    ));
    for (_, points) in images.contours() {
        let path: Vec<String> = points.iter().map(|p| at(p.x, p.y)).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        line(format!("<polyline points=\"{}\" fill=\"none\" stroke=\"#fff\" stroke-opacity=\"0.7\"/>", path.join(" ")));
    }
    for (name, _) in images.contours() {
        let Some((place, text)) = name else { continue };
        let (x, y) = at(place.x, place.y);
        line(format!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"10\" fill=\"#fff\" text-anchor=\"middle\">{text}</text>"
        ));
    }
    let (x, y) = at(0.0, 0.0);
    line(format!(
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{UNIT:.1}\" fill=\"none\" stroke=\"#fff\" stroke-dasharray=\"5 4\"/>"
    ));
    line(format!(
        "<rect x=\"{left:.1}\" y=\"{above:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"#444\"/>"
    ));
    for k in (from.ceil() as i32)..=(to.floor() as i32) {
        let (x, y) = at(f64::from(k), edge);
        line(format!("<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>", y + 18.0, numeral(k)));
    }
    for k in (edge.ceil() as i32)..=((-edge).floor() as i32) {
        let (x, y) = at(from, f64::from(k));
        line(format!("<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>", x - 8.0, y + 4.5, numeral(k)));
    }
    let (middle, bottom) = (left + 0.5 * width, above + height + 40.0);
    let a = numbers::length(picture.key.point.hertz().half_width_m);
    line(format!(
        "<text x=\"{middle:.1}\" y=\"{bottom:.1}\" text-anchor=\"middle\"><tspan font-style=\"italic\">X = x/a</tspan>, a = {a}</text>"
    ));
    let center = above + 0.5 * height;
    line(format!(
        "<text transform=\"translate(20 {center:.1}) rotate(-90)\" text-anchor=\"middle\" font-style=\"italic\">Y = y/a</text>"
    ));
    legend(&mut line, picture, images, view, left + width + 18.0, (above, height));
    line("</svg>".to_owned());
    out
}

/// The scale at the right.
fn legend(
    line: &mut impl FnMut(String),
    picture: &Picture,
    images: &ContactMap,
    view: &MapView,
    x: f64,
    (top, height): (f64, f64),
) {
    let (low, high) = images.range();
    let colors = scale::colors(picture, view, (low, high));
    let strip = height / colors.len().max(1) as f64;
    for (k, color) in colors.iter().enumerate() {
        let y = top + height - (k + 1) as f64 * strip;
        line(format!(
            "<rect x=\"{x:.1}\" y=\"{y:.2}\" width=\"16\" height=\"{:.2}\" fill=\"#{:02x}{:02x}{:02x}\"/>",
            strip + 0.4,
            color.r(),
            color.g(),
            color.b()
        ));
    }
    let symbol = if view.shown == Shown::Pressure { "P" } else { "H" };
    line(format!("<text x=\"{x:.1}\" y=\"{:.1}\" font-style=\"italic\">{symbol}</text>", top - 8.0));
    for value in ticks((low, high)) {
        let t = (value - low) / (high - low);
        let text = format!("{}  ({})", numbers::digits(value, 2), scale::si(picture, view, value));
        line(format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\">{text}</text>",
            x + 22.0,
            top + height * (1.0 - t) + 4.0
        ));
    }
}

/// What the picture belongs to, in one line.
fn caption(picture: &Picture, view: &MapView) -> String {
    let rig = &view.rig;
    let light = match (view.shown, view.three_colors) {
        (Shown::Interferogram, true) => format!(
            "; light 630, 532, 460 nm, n {}, phase {:.0}°, V {}",
            rig.refractive_index,
            rig.phase.to_degrees(),
            rig.visibility
        ),
        (Shown::Interferogram, false) => format!(
            "; light {:.0} nm, n {}, phase {:.0}°, V {}",
            1e9 * rig.wavelength_m,
            rig.refractive_index,
            rig.phase.to_degrees(),
            rig.visibility
        ),
        _ => String::new(),
    };
    let point = &picture.key.point;
    format!(
        "R {}, u_m {} m/s, w {} N, E' {} GPa, η₀ {} Pa·s, α {} 1/GPa; {}×{} nodes; {}{light}",
        numbers::length(point.radius_m),
        numbers::significant(point.speed_m_per_s),
        numbers::significant(point.load),
        numbers::significant(1e-9 * point.modulus_pa),
        numbers::significant(point.viscosity_pa_s),
        numbers::significant(1e9 * point.alpha_per_pa),
        picture.solution.x.len(),
        picture.solution.y.len(),
        picture.origin.describe()
    )
}

fn numeral(k: i32) -> String {
    k.to_string().replace('-', "−")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Base64 of RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for triple in bytes.chunks(3) {
        let word = (0..3).fold(0u32, |word, k| word << 8 | u32::from(triple.get(k).copied().unwrap_or(0)));
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= triple.len() { char::from(digit) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, coded) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
