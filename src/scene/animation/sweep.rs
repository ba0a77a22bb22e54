//! Animation of a sweep: profiles of one contact after the other, with film thickness and pressure over the varied
//! quantity.

use super::frame::{ALONG, FILM, PRESSURE, add, composed, dot, encoded};
use crate::scene::answer::Answer;
use crate::scene::bench::Bench;
use crate::scene::chart::{Chart, ChartAxis};
use crate::scene::drawing::{AnimationError, Drawing};
use crate::scene::error::RunError;
use crate::scene::study::{Study, sweep};
use crate::scene::{Scene, Steps};
use crate::solver::full::Solution;
use crate::solver::training::TrainingObserver;

/// Solves the contacts of a sweep over one quantity by its first method, draws a frame of each, and encodes them as an
/// animated PNG.
///
/// # Errors
/// If the scene is no such sweep, if no contact can be solved, or if the observer stops.
pub fn of_sweep(
    scene: &Scene,
    bench: &mut dyn Bench,
    dark: bool,
    observer: &dyn TrainingObserver,
) -> Result<Vec<u8>, RunError> {
    scene.check()?;
    let refused = || RunError::Study("an animation needs a sweep over one quantity".to_owned());
    let Study::Sweep(study) = &scene.study else { return Err(refused()) };
    let [axis] = study.over.as_slice() else { return Err(refused()) };
    let requests = sweep::requests(study, &scene.experiment())?;
    let mut places: Vec<(f64, Answer)> = Vec::new();
    for (k, (value, request)) in requests.iter().enumerate() {
        observer.progress(crate::solver::observer::Progress {
            stage: "sweep".to_owned(),
            done: k,
            total: requests.len(),
        });
        if observer.cancelled() {
            return Err(RunError::Cancelled);
        }
        let former = places.last().and_then(|(_, answer)| answer.fields());
        let answer = bench.answer(request, former, observer)?;
        if answer.fields().is_some() {
            places.push((*value, answer));
        }
    }
    let label = (axis.vary.label(), matches!(axis.values, Steps::Log { .. }));
    let solved: Vec<(f64, &Solution)> =
        places.iter().filter_map(|(value, answer)| Some((*value, answer.fields()?))).collect();
    let ends = Ends::of(&solved);
    let film = encoded(solved.len(), observer, |k| frame(&solved, k, &ends, label, dark));
    film.map_err(|why| RunError::Study(why.to_string()))
}

/// Ends of the axes that all frames share: half width \[mm\], central film thickness \[µm\] and maximum pressure
/// \[GPa\], each the largest of all contacts.
struct Ends {
    widest: f64,
    thickest: f64,
    highest: f64,
}

impl Ends {
    fn of(solved: &[(f64, &Solution)]) -> Self {
        let most = |of: fn(&Solution, [f64; 3]) -> f64| {
            solved.iter().map(|(_, solution)| of(solution, units(solution))).fold(0.0, f64::max)
        };
        Self {
            widest: most(|_, [mm, ..]| mm),
            thickest: most(|solution, [_, um, _]| um * solution.scalars.h_c),
            highest: most(|solution, [.., gpa]| gpa * solution.scalars.p_max),
        }
    }
}

/// Units of a contact: lengths \[mm\], film thicknesses \[µm\], pressures \[GPa\].
fn units(solution: &Solution) -> [f64; 3] {
    let (point, hertz) = (&solution.problem.point, solution.problem.point.hertz());
    [1e3 * hertz.half_width_m, 1e6 * point.film_scale_m(), 1e-9 * hertz.pressure_pa]
}

fn frame(
    solved: &[(f64, &Solution)],
    k: usize,
    &Ends { widest, thickest, highest }: &Ends,
    (label, log): (&str, bool),
    dark: bool,
) -> Result<Drawing, AnimationError> {
    let (value, solution) = *solved.get(k).ok_or(AnimationError::Frames(0))?;
    let [mm, um, gpa] = units(solution);
    let axis = || ChartAxis { ends: Some((widest * ALONG.0, widest * ALONG.1)), ..ChartAxis::linear("{x} in mm") };
    let mut pressure = Chart::new("Pressure", axis(), ChartAxis::linear("{p} in GPa"));
    let mut film = Chart::new("Film thickness", axis(), ChartAxis::linear("{h} in µm"));
    (pressure.y.ends, film.y.ends) = (Some((0.0, 1.1 * highest)), Some((0.0, 3.0 * thickest)));
    let near = || solution.profile().filter(|(x, ..)| (widest * ALONG.0..=widest * ALONG.1).contains(&(mm * x)));
    add(&mut pressure, "", (PRESSURE, 1.6), near().map(|(x, p, _)| [mm * x, gpa * p]));
    let thin = near().filter(|(.., h)| um * h <= 3.0 * thickest);
    add(&mut film, "", (FILM, 1.6), thin.map(|(x, _, h)| [mm * x, um * h]));
    let along = |title: &str, y: &str, color, of: &dyn Fn(&Solution, [f64; 3]) -> f64| {
        let mut chart = Chart::new(title, ChartAxis::new(label, log), ChartAxis::linear(y));
        let point = |(value, solution): &(f64, &Solution)| [*value, of(solution, units(solution))];
        add(&mut chart, "", (color, 1.4), solved.iter().map(point));
        dot(&mut chart, color, point(&(value, solution)));
        chart
    };
    let mut right = [
        along("Maximum pressure", "{p_max} in GPa", PRESSURE, &|s, [.., gpa]| gpa * s.scalars.p_max),
        along("Central film thickness", "{h_c} in µm", FILM, &|s, [_, um, _]| um * s.scalars.h_c),
    ];
    let mut left = [pressure, film];
    left.iter_mut().chain(&mut right).for_each(|chart| chart.marked = true);
    let moes = solution.problem.moes;
    let caption = format!("{label}: {value:.4}   {{M}} = {:.1}   {{L}} = {:.1}", moes.m, moes.l);
    Ok(composed((&left, &right), &caption, dark))
}
