//! Traction and film as a figure for other programs (SVG).

use super::chart::{Axes, CENTRAL, SMALLEST, TRACTION};
use crate::app::plots::svg::{self, Chart, Curve, FILM, Page};
use crate::app::traction::{Choices, Sample, Sweep, TractionView, export};

const PAGE: (f64, f64) = (760.0, 640.0);
const LEFT: f64 = 76.0;
const SIZE: (f64, f64) = (650.0, 220.0);
const TOPS: [f64; 2] = [74.0, 350.0];

/// The figure; `None` where there is nothing to draw along the sweep.
pub fn svg(view: &TractionView, choices: Choices, sweep: &Sweep) -> Option<String> {
    let curve = view.curve.as_ref().filter(|curve| curve.sweep.varied == sweep.varied);
    let markers = view.markers.as_ref().filter(|markers| markers.sweep.varied == sweep.varied);
    let own = curve.map(|curve| &curve.sweep).or(markers.map(|markers| &markers.sweep))?;
    let reduced: &[Sample] = curve.map_or(&[], |curve| &curve.samples);
    // Rings of another sweep have no place in a figure that states one.
    let full: &[Sample] = markers.filter(|markers| markers.sweep == *own).map_or(&[], |markers| &markers.samples);
    if reduced.is_empty() && full.is_empty() {
        return None;
    }
    let Choices { against, logarithmic, .. } = choices;
    let axes = Axes { against, sweep: own, logarithmic };
    let mut page = Page::new(PAGE.0, PAGE.1);
    page.text((LEFT, 24.0), "font-size=\"16\"", &format!("Traction and film against {}", against.name()));
    for (k, line) in export::describe(own).iter().enumerate() {
        page.text((LEFT, 40.0 + 11.0 * k as f64), "font-size=\"8.5\" fill=\"#666\"", line);
    }
    let along = against.axis(own.base.point.kind).replace(['{', '}'], "");
    let rows: [(&str, &[(_, &str)], &str); 2] = [
        ("Traction coefficient µ", &[(TRACTION, "none")], svg::TRACTION),
        ("Film in µm: central, and smallest (dashed)", &[(CENTRAL, "none"), (SMALLEST, "8 4")], FILM),
    ];
    for (id, ((title, quantities, color), top)) in rows.into_iter().zip(TOPS).enumerate() {
        let of = |samples| quantities.iter().map(|(of, _)| axes.points(samples, *of)).collect::<Vec<_>>();
        let (curves, rings) = (of(reduced), of(full));
        let all: Vec<&[f64; 2]> = curves.iter().chain(&rings).flatten().collect();
        let chart = Chart {
            id,
            place: (LEFT, top),
            size: SIZE,
            x: svg::range(all.iter().map(|point| &point[0])),
            y: svg::range(all.iter().map(|point| &point[1])),
            titles: (&along, title),
            logarithmic,
        };
        let line =
            |dashes: &str| format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"2\" stroke-dasharray=\"{dashes}\"");
        chart.draw(
            &mut page,
            quantities.iter().zip(&curves).map(|((_, dashes), points)| Curve { stroke: line(dashes), points }),
        );
        rings.iter().for_each(|points| chart.rings(&mut page, "#222", points));
    }
    Some(page.finish())
}
