//! Cost of transient marches by each method, next to published values (Tables 4.4, 4.6, 4.7 and 4.9).

use super::data::TransientStudy;
use super::march::{By, March};
use super::models::Model;
use super::published::PublishedMarch;
use crate::scene::table::Table;
use crate::solver::full::transient::Quantity;

const COLUMNS: [&str; 13] = [
    "modes",
    "rows or points",
    "steps",
    "ms per step",
    "s",
    "times faster",
    "H_c.difference_l2",
    "published modes",
    "published rows or points",
    "published steps",
    "published ms per step",
    "published s",
    "published times faster",
];
/// Number of columns without published values.
const OWN: usize = 7;

/// Returns the table `costs` of some marches: median time per step, total time, speed-up relative to the full march,
/// and relative L2 difference of H_c from it. Published values follow if the study has any.
pub(super) fn table(study: &TransientStudy, marches: &[&March], models: &[&Model]) -> Table {
    let columns = if study.published.is_empty() { OWN } else { COLUMNS.len() };
    let mut table = Table::new("costs", &COLUMNS[..columns]);
    let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let count = |value: Option<usize>| number(value.map(|value| value as f64));
    let published = |name: &str| study.published.iter().find(|march| march.name == name);
    for march in marches {
        let (model, full_name, method) = match &march.by {
            By::Full { .. } => (None, &march.name, "full"),
            By::Model { model, method, full } => (models.iter().find(|own| own.name == *model), full, &**method),
        };
        let (own, full) = (published(&format!("{full_name}.{method}")), published(&format!("{full_name}.full")));
        let quotient = |of: fn(&PublishedMarch) -> Option<f64>| Some(full.and_then(of)? / own.and_then(of)?);
        let faster = march.full(marches).map(|full| full.march_s() / march.march_s());
        table.labels.push(march.name.clone());
        let mut row = vec![
            count(model.map(|model| model.modes())),
            count(model.map(|model| model.chosen())),
            march.steps().len() as f64,
            1e3 * march.step_s(),
            march.march_s(),
            number(faster),
            number(march.difference(Quantity::CentralFilm, study, marches).map(|(_, l2)| l2)),
            count(own.and_then(|told| told.modes)),
            count(own.and_then(|told| told.rows)),
            count(own.and_then(|told| told.steps)),
            1e3 * number(own.and_then(PublishedMarch::seconds_per_step)),
            number(own.and_then(|told| told.march_s)),
            number(quotient(|told| told.march_s).or_else(|| quotient(PublishedMarch::seconds_per_step))),
        ];
        row.truncate(columns);
        table.rows.push(row);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, Study};
    use crate::solver::full::Mesh;
    use crate::solver::full::transient::{Frame, Moment, Trajectory};

    fn march(name: &str, by: By, steps: usize, step_s: f64) -> March {
        let scene = Scene::from_ron(SCENE).unwrap();
        let Study::Transient(study) = &scene.study else { panic!() };
        let transient = study.own_march(scene.point().unwrap(), scene.laws(), Frame::Fixed);
        let scales =
            Frame::Fixed.conditions(&transient.problem().unwrap(), 0.0, transient.inputs.at(0.0)).unwrap().scales;
        let moment = |k: usize| Moment {
            time: k as f64 * 0.01,
            step: 0.01,
            input: transient.inputs.at(0.0),
            scales,
            h_c: 0.1,
            h_min: 0.08,
            x_h_min: 0.9,
            p_c: 1.0,
            p_max: 1.0,
            x_p_max: 0.0,
            asperity_load_share: 0.0,
            effort: Default::default(),
        };
        let grid = scene.grid.spec().unwrap().line().unwrap().scaled(1.0);
        let begun = Trajectory::begun(&transient, Mesh::of_line(&grid), &grid.x).unwrap();
        let trajectory = Trajectory { moments: (0..=steps).map(moment).collect(), ..begun };
        March {
            name: name.to_owned(),
            by,
            trajectory,
            seconds: vec![step_s; steps],
            mass_defect: None,
            grid_cost: None,
            record: None,
            outside: Vec::new(),
        }
    }

    const SCENE: &str =
        "Scene(version: 1, title: \"t\", grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), study: Transient(
        duration: 4.0, time_step: Fixed(0.01), published: [
            (name: \"fixed.full\", rows: 300, steps: 1000, march_s: 800.0),
            (name: \"fixed.rnsa\", rows: 300, steps: 1200, march_s: 40.0),
        ]))";

    #[test]
    fn a_march_stands_beside_what_was_published_of_it() {
        let Study::Transient(study) = Scene::from_ron(SCENE).unwrap().study else { panic!() };
        let by = By::Model { model: "fixed.rnsa".to_owned(), method: "rnsa".into(), full: "fixed".to_owned() };
        let full = march("fixed", By::Full { first: None }, 400, 5e-3);
        let reduced = march("fixed.rnsa", by, 400, 2.5e-4);
        let table = table(&study, &[&full, &reduced], &[]);
        assert_eq!(table.labels, ["fixed", "fixed.rnsa"]);
        let [full, reduced] = [&table.rows[0], &table.rows[1]];
        assert!(full[0].is_nan() && full[2] == 400.0 && full[5] == 1.0 && full[6].is_nan() && full[12] == 1.0);
        assert!((reduced[3] - 0.25).abs() < 1e-12 && (reduced[5] - 20.0).abs() < 1e-9 && reduced[6] == 0.0);
        assert!((reduced[10] - 1e3 * 40.0 / 1200.0).abs() < 1e-9 && reduced[12] == 20.0);
        let mut names: Vec<&String> = table.columns.iter().collect();
        names.sort();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "no two columns have one name");
    }
}
