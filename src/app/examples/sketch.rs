//! Sketch of the kind of result of a study, without real numbers.

use crate::app::theme::Palette;
use crate::scene::{Scene, Study};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use egui::{Color32, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};
use std::f32::consts::{PI, TAU};

/// Colour of a part of a sketch.
#[derive(Clone, Copy)]
pub(super) enum Hue {
    Pressure,
    Film,
    Deformation,
    Friction,
    Quiet,
}

/// Part of a sketch. Coordinates run from 0 to 1, upwards.
pub(super) enum Mark {
    Line(Hue, Vec<Pos2>),
    Dashes(Hue, Vec<Pos2>),
    Dots(Hue, Vec<Pos2>),
}

use Hue::{Deformation, Film, Friction, Pressure, Quiet};
use Mark::{Dashes, Dots, Line};

fn along(n: usize, at: impl Fn(f32) -> Pos2) -> Vec<Pos2> {
    (0..n).map(|k| at(k as f32 / (n - 1) as f32)).collect()
}

fn curve(height: impl Fn(f32) -> f32) -> Vec<Pos2> {
    along(41, |x| pos2(x, height(x)))
}

fn dots(n: usize, height: impl Fn(f32) -> f32) -> Vec<Pos2> {
    along(n, |x| pos2(x, height(x)))
}

/// Returns evenly scattered points, always the same ones.
fn scattered(n: usize) -> Vec<Pos2> {
    (1..=n).map(|k| pos2((0.618_034 * k as f32).fract(), (0.754_878 * k as f32).fract())).collect()
}

/// Returns the typical pressure and film thickness of a contact.
fn contact(kind: ContactKind) -> Vec<Mark> {
    match kind {
        ContactKind::Line => {
            let hertz = |x: f32| (1.0 - (2.6 * x - 1.4).powi(2)).max(0.0).sqrt();
            let spike = |x: f32| 0.25 * (-((x - 0.83) / 0.025).powi(2)).exp();
            let film = |x: f32| 0.1 + 1.6 * (0.22 - x).max(0.0).powi(2) * 6.0 + 14.0 * (x - 0.9).max(0.0).powi(2);
            let dip = |x: f32| 0.05 * (-((x - 0.88) / 0.04).powi(2)).exp();
            vec![
                Line(Pressure, curve(|x| 0.35 + 0.5 * hertz(x) + spike(x))),
                Line(Film, curve(|x| (film(x) - dip(x)).min(0.95))),
            ]
        }
        ContactKind::Point => {
            let ring = |r: f32, from: f32, to: f32| {
                along(33, |t| {
                    let angle = from + t * (to - from);
                    pos2(0.5 + 0.62 * r * angle.cos(), 0.5 + r * angle.sin())
                })
            };
            vec![
                Line(Quiet, ring(0.46, 0.0, TAU)),
                Line(Film, ring(0.38, -0.62 * PI, 0.62 * PI)),
                Line(Deformation, ring(0.22, 0.0, TAU)),
            ]
        }
    }
}

/// Returns the sketch of a scene.
pub(super) fn marks(scene: &Scene) -> Vec<Mark> {
    let falling = |rate: f32| move |x: f32| 0.9 * (-rate * x).exp();
    match &scene.study {
        Study::Point(_) => contact(scene.contact),
        Study::Sweep(sweep) => {
            let rise = |x: f32| 0.9 * (1.0 - (-4.0 * x).exp());
            let hue =
                if sweep.over.iter().any(|axis| axis.vary == Quantity::SlideToRollRatio) { Friction } else { Film };
            vec![Line(hue, curve(rise)), Dots(hue, dots(7, rise))]
        }
        Study::Trajectory(_) => {
            let path = |t: f32| pos2(0.5 + 0.45 * (TAU * t).sin(), 0.5 + 0.42 * (2.0 * TAU * t + 0.4).sin());
            vec![Line(Deformation, along(61, path)), Dots(Deformation, along(12, path))]
        }
        Study::RandomTest(_) => vec![Dots(Film, scattered(34))],
        Study::ErrorSplit(_) => [0.9, 0.6, 0.35, 0.75]
            .iter()
            .enumerate()
            .map(|(k, top)| Line(Pressure, vec![pos2(0.15 + 0.23 * k as f32, 0.0), pos2(0.15 + 0.23 * k as f32, *top)]))
            .collect(),
        Study::GridStudy(_) => {
            let settling = |x: f32| 0.3 + 0.6 * (-4.0 * x).exp();
            vec![Dashes(Quiet, curve(|_| 0.3)), Line(Film, curve(settling)), Dots(Film, dots(5, settling))]
        }
        Study::Dimensions(_) => vec![Dots(Pressure, dots(14, falling(3.0))), Dots(Deformation, dots(14, falling(5.0)))],
        Study::ModelSizes(_) => {
            vec![
                Line(Pressure, curve(falling(4.0))),
                Dots(Pressure, dots(7, falling(4.0))),
                Line(Quiet, curve(|x| 0.1 + 0.6 * x * x)),
            ]
        }
        Study::Training(_) => {
            let frame = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)].map(|(x, y)| pos2(x, y)).to_vec();
            vec![Line(Quiet, frame), Dots(Deformation, scattered(22))]
        }
        Study::ErrorMeasures(_) => {
            let wavy = |x: f32| 0.1 + 0.7 * x * x + 0.12 * (23.0 * x).sin().abs();
            vec![Line(Film, curve(|x| 0.1 + 0.7 * x * x)), Line(Quiet, curve(wavy))]
        }
        Study::DistanceMeasure(_) => {
            let places = scattered(8);
            let pairs = places.windows(2).map(|pair| Line(Quiet, pair.to_vec()));
            pairs.chain([Dots(Deformation, places.clone())]).collect()
        }
        Study::PlanComparison(_) => vec![
            Line(Film, curve(falling(2.0))),
            Line(Pressure, curve(falling(3.5))),
            Line(Deformation, curve(falling(5.5))),
        ],
        Study::ToleranceStudy(_) => vec![Line(Film, curve(|x| 0.9 - 0.16 * (5.0 * x).floor()))],
        Study::SamplingComparison(_) => {
            let crowded = |t: f32| pos2(t, 0.12);
            let mut all = contact(ContactKind::Line);
            all.push(Dots(
                Deformation,
                [0.05, 0.12, 0.17, 0.21, 0.3, 0.5, 0.7, 0.8, 0.83, 0.86, 0.9].map(crowded).to_vec(),
            ));
            all
        }
        Study::Transient(_) => vec![
            Line(Pressure, curve(|x| 0.72 + 0.2 * (TAU * 1.5 * x).sin())),
            Line(Film, curve(|x| 0.3 + 0.2 * (TAU * 1.5 * x - 1.2).sin())),
        ],
        Study::LoadCases(_) => {
            let row = |y: f32| Line(Quiet, vec![pos2(0.0, y), pos2(1.0, y)]);
            let column = |x: f32| Line(Quiet, vec![pos2(x, 0.0), pos2(x, 1.0)]);
            let rows = [0.0, 0.25, 0.5, 0.75, 1.0].map(row).into_iter();
            rows.chain([0.0, 0.33, 0.66, 1.0].map(column)).chain([Dots(Film, dots(4, |_| 0.375))]).collect()
        }
        Study::FormulaComparison(_) => {
            let law = |x: f32| 0.15 + 0.7 * x.sqrt();
            vec![Dashes(Quiet, curve(law)), Dots(Film, dots(8, |x| law(x) - 0.07 + 0.05 * x))]
        }
        Study::MeasuredFilm(_) => {
            let film = |x: f32| 0.25 + 2.0 * (x - 0.45).powi(4) + if x > 0.8 { -0.1 } else { 0.0 };
            vec![Line(Film, curve(film)), Dots(Quiet, dots(9, |x| film(x) + 0.03))]
        }
        Study::Fit(_) => {
            let law = |x: f32| 0.1 + 0.75 * x.powf(0.7);
            let off = [0.05, -0.04, 0.03, -0.05, 0.04, -0.02, 0.05, -0.03];
            let measured = |x: f32| law(x) + off[((8.0 * x) as usize).min(7)];
            vec![Line(Film, curve(law)), Dots(Quiet, dots(8, measured))]
        }
        Study::Starvation(_) => {
            let law = |x: f32| 0.85 * 1.6 * x / (1.0 + (1.6 * x).powi(3)).powf(1.0 / 3.0);
            vec![Line(Quiet, curve(law)), Dots(Film, dots(8, law))]
        }
        Study::StationaryProfile(_) => {
            let waves = |x: f32| 0.04 * (40.0 * x).sin() + 0.025 * (67.0 * x + 1.0).sin();
            let bell = |x: f32| 0.8 * (1.0 - ((x - 0.5) / 0.35).powi(2)).max(0.0).sqrt();
            vec![
                Line(Pressure, curve(move |x| bell(x) * (1.0 + 3.0 * waves(x)))),
                Line(Film, curve(move |x| 0.2 + waves(x))),
            ]
        }
        Study::Transition(_) => {
            let bell = |width: f32, height: f32| move |x: f32| height * (-((x - 0.5) / width).powi(2)).exp();
            let hertz = |x: f32| 0.85 * (1.0 - ((x - 0.5) / 0.25).powi(2)).max(0.0).sqrt();
            vec![
                Line(Pressure, curve(bell(0.25, 0.5))),
                Line(Pressure, curve(bell(0.18, 0.7))),
                Dashes(Quiet, curve(hertz)),
            ]
        }
        Study::SchemesInTime(_) => {
            vec![Line(Film, curve(falling(2.0))), Line(Pressure, curve(|x| 0.5 + 0.3 * (9.0 * x).sin()))]
        }
        Study::InformationLoss(_) => vec![Line(Pressure, curve(falling(1.5))), Line(Film, curve(falling(4.0)))],
        Study::Amplitude(_) => {
            let law = |x: f32| 0.9 / (1.0 + (8.0 * (x - 0.5)).exp());
            vec![Line(Quiet, curve(law)), Dots(Film, dots(8, law))]
        }
        Study::Vibration(_) => {
            let rise = |x: f32| 1.0 / (1.0 + (-10.0 * (x - 0.5)).exp());
            vec![Line(Film, curve(|x| 0.45 + 0.3 * rise(x))), Line(Friction, curve(|x| 0.8 - 0.65 * rise(x)))]
        }
        Study::FlowCurve(_) => {
            let thinned = |x: f32| 0.2 + 0.65 / (1.0 + (10.0 * (x - 0.5)).exp());
            vec![Line(Friction, curve(thinned)), Dashes(Quiet, curve(|_| 0.85))]
        }
    }
}

pub(super) fn draw(ui: &Ui, area: Rect, scene: &Scene) {
    let palette = Palette::of(ui);
    let hue = |hue: Hue| -> Color32 {
        match hue {
            Pressure => palette.pressure,
            Film => palette.film,
            Deformation => palette.deformation,
            Friction => palette.traction,
            Quiet => palette.reference,
        }
    };
    let painter = ui.painter_at(area);
    painter.rect_filled(area, 3.0, ui.visuals().extreme_bg_color);
    let inside = area.shrink2(vec2(6.0, 6.0));
    let at = |p: &Pos2| pos2(inside.left() + p.x * inside.width(), inside.bottom() - p.y * inside.height());
    for mark in marks(scene) {
        match mark {
            Line(of, points) => {
                painter.add(Shape::line(points.iter().map(at).collect(), Stroke::new(1.5, hue(of))));
            }
            Dashes(of, points) => {
                let points: Vec<Pos2> = points.iter().map(at).collect();
                painter.extend(Shape::dashed_line(&points, Stroke::new(1.2, hue(of)), 4.0, 3.0));
            }
            Dots(of, points) => {
                for point in &points {
                    painter.circle_filled(at(point), 1.8, hue(of));
                }
            }
        }
    }
}
