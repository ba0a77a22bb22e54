//! Validation page of the manual, generated from the results page of all scenes.

use super::results::{PAGE, Written, written};
use super::speed;

/// Places of the plots in the page, as references to pictures.
pub const MARGINS_PLOT: &str = "plots/margins";
/// Plot of the times of the speed table.
pub const SPEED_PLOT: &str = "plots/speed";
/// A deviation is plotted if the digits of its value resolve this share of the limit.
const RESOLVED: f64 = 0.05;

/// Folders of scenes with what they validate.
const FOLDERS: [(&str, &str); 17] = [
    ("line", "Line contacts: tables of the dissertation and independent solutions"),
    ("point", "Circular contacts: tables of the dissertation, independent solutions and measured films"),
    ("ellipse", "Elliptical contacts, with their limits"),
    ("rupture", "Models of cavitation"),
    ("shear", "Shear-thinning lubricants and friction"),
    ("heat", "Heat in film and bodies"),
    ("rough", "Rough surfaces"),
    ("time", "Transient contacts"),
    ("reach", "Slow, soft, light and reversing contacts"),
    ("machines", "Bearings, gears and cams"),
    ("fit", "Fits to measured data"),
    ("load_cases", "Tables of load cases"),
    ("convergence", "Convergence of the full solver over whole ranges"),
    ("accuracy", "Sources of error and film formulas"),
    ("reduced", "Reduced models against full solutions"),
    ("plans", "Selection of training contacts: Tables 3.2 and 3.3"),
    ("training", "Training of reduced models"),
];

/// Scene of the results page.
struct Scene<'a> {
    title: &'a str,
    place: &'a str,
    source: &'a str,
    /// Day of the run; empty if it has not run.
    day: &'a str,
    /// Expectation and value, and whether it holds; empty if the scene has not run.
    checks: Vec<(&'a str, &'a str, bool)>,
}

impl<'a> Scene<'a> {
    /// Returns the scenes of a results page, in its order.
    fn all(results: &'a str) -> Vec<Self> {
        let scene = |Written { title, place, source, run, lines }: Written<'a>| {
            let day = run.split(' ').next().unwrap_or_default();
            Self { title, place, source, day, checks: if day.is_empty() { Vec::new() } else { lines } }
        };
        written(results).into_iter().map(scene).collect()
    }

    fn folder(&self) -> &'a str {
        self.place.rsplit_once('/').map_or("", |(folder, _)| folder)
    }

    fn ran(&self) -> bool {
        !self.day.is_empty()
    }

    /// Returns the shares of their limits that the values use, for the expectations that have one.
    fn shares(&self) -> impl Iterator<Item = f64> {
        self.checks.iter().filter_map(|(wanted, value, _)| share(wanted, value))
    }

    fn held(&self) -> usize {
        self.checks.iter().filter(|(_, _, holds)| *holds).count()
    }

    /// Returns the scene as an entry of a list.
    fn entry(&self) -> String {
        let Self { title, place, source, day, checks } = self;
        let verdict = match (self.ran(), self.held()) {
            (false, _) => "has not run as it is now".to_owned(),
            (true, held) if held == checks.len() => format!("{held} of {held} hold, {day}"),
            (true, held) => format!("**{held} of {}** hold, {day}", checks.len()),
        };
        let source = if source.is_empty() { String::new() } else { format!(" {}.", source.trim_end_matches('.')) };
        format!("- **{title}**: {verdict}.{source} `{place}`\n")
    }
}

/// Returns the share of the limit that a value uses: the value over the largest accepted one, or the deviation from the
/// expected value over the largest accepted deviation. `None` if there is no such limit, or the page has too few digits.
fn share(wanted: &str, value: &str) -> Option<f64> {
    let value: f64 = value.parse().ok()?;
    let condition = wanted.split_once("`: ").or_else(|| wanted.split_once("): "))?.1.split(';').next()?;
    if let Some(most) = condition.strip_prefix("at most ") {
        let most: f64 = most.parse().ok()?;
        return (most > 0.0 && value > 0.0).then_some(value / most);
    }
    let (expected, tolerance) = match condition.split_once(" ± ") {
        Some((expected, tolerance)) => (expected.parse::<f64>().ok()?, tolerance.parse::<f64>().ok()?),
        None => {
            let (expected, relative) = condition.split_once(", relative error at most ")?;
            let expected: f64 = expected.parse().ok()?;
            (expected, relative.parse::<f64>().ok()? * expected.abs())
        }
    };
    let deviation = (value - expected).abs();
    // Values have four digits.
    let rounding = 0.5e-3 * value.abs();
    (tolerance > 0.0 && deviation > rounding && rounding <= RESOLVED * tolerance).then_some(deviation / tolerance)
}

/// Returns the folders of a results page with the shares of their limits that the values use.
pub fn margins(results: &str) -> Vec<(&'static str, Vec<f64>)> {
    let scenes = Scene::all(results);
    let of = |folder: &str| scenes.iter().filter(|scene| scene.folder() == folder).flat_map(Scene::shares).collect();
    let folders = FOLDERS.iter().map(|(folder, _)| (*folder, of(folder)));
    folders.filter(|(_, shares): &(_, Vec<f64>)| !shares.is_empty()).collect()
}

/// Returns the page: a table of all folders, plots, expectations that do not hold, and the scenes of each folder.
pub fn page(results: &str, speed_page: &str) -> String {
    let scenes = Scene::all(results);
    let held = |own: &[&Scene<'_>]| own.iter().map(|scene| scene.held()).sum::<usize>();
    let checks = |own: &[&Scene<'_>]| own.iter().map(|scene| scene.checks.len()).sum::<usize>();
    let all: Vec<&Scene<'_>> = scenes.iter().collect();
    let days = || scenes.iter().filter(|scene| scene.ran()).map(|scene| scene.day);
    let (first, last) = (days().min().unwrap_or("?"), days().max().unwrap_or("?"));
    let mut text = format!(
        "# Validation\n\nResults of the scenes of the program against published values, independent solutions, limits and \
         requirements: {} of {} expectations hold. They ran from {first} to {last}. *Examples* opens each scene; \
         `scenes/{PAGE}` has every expectation with its value. This page is generated from it.\n\n\
         | folder | scenes | not run | expectations | hold |\n|---|---|---|---|---|\n",
        held(&all),
        checks(&all)
    );
    let folders: Vec<(&str, &str, Vec<&Scene<'_>>)> = FOLDERS
        .iter()
        .map(|(folder, what)| (*folder, *what, all.iter().copied().filter(|scene| scene.folder() == *folder).collect()))
        .filter(|(_, _, own): &(_, _, Vec<_>)| !own.is_empty())
        .collect();
    for (folder, _, own) in &folders {
        let missing = own.iter().filter(|scene| !scene.ran()).count();
        text += &format!("| `{folder}` | {} | {missing} | {} | {} |\n", own.len(), checks(own), held(own));
    }
    text += &format!(
        "\n![Deviations over their limits. Each point is one expectation; 1 is the limit.]({MARGINS_PLOT})\n\n## Speed\n\n\
         {} [Speed](speed.md) has the table.\n\n\
         ![Median times of the rows of the speed table.]({SPEED_PLOT})\n",
        speed::measured_on(speed_page).unwrap_or_default()
    );
    text += "\n## What does not hold\n\n";
    let mut short = false;
    for scene in &scenes {
        for (wanted, value, _) in scene.checks.iter().filter(|(_, _, holds)| !holds) {
            short = true;
            text += &format!("- **{}**: {wanted}. Value: {value}. `{}`\n", scene.title, scene.place);
        }
    }
    if !short {
        text += "All expectations hold.\n";
    }
    for (folder, what, own) in &folders {
        text += &format!("\n## {what}\n\nFolder `{folder}`.\n\n");
        own.iter().for_each(|scene| text += &scene.entry());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const RESULTS: &str = include_str!("../../scenes/RESULTS.md");
    const SPEED: &str = include_str!("../../assets/manual/speed.md");

    #[test]
    fn shares_of_limits_agree_with_the_verdicts() {
        let shares = |scene: &Scene<'_>| -> Vec<(f64, bool)> {
            let of = |(wanted, value, holds): &(&str, &str, bool)| Some((share(wanted, value)?, *holds));
            scene.checks.iter().filter_map(of).collect()
        };
        let all: Vec<(f64, bool)> = Scene::all(RESULTS).iter().flat_map(shares).collect();
        assert!(all.len() > 200, "{}", all.len());
        // The digits of the page are few where a value is close to its limit.
        assert!(all.iter().all(|(share, holds)| (*share <= 1.0 + 1e-3) == *holds || (share - 1.0).abs() < 1e-3));
        assert_eq!(share("`a`: at most 0.01; reason", "0.005"), Some(0.5));
        let relative = share("`a` (full): 2, relative error at most 1e-1; reason", "2.100").unwrap();
        assert!((relative - 0.5).abs() < 1e-9);
        let digits = "`a`: 2, relative error at most 1e-5";
        assert_eq!(share(digits, "2.000"), None, "four digits do not show this deviation");
        assert_eq!(share("`a`: 0; every contact is solved", "0"), None);
        assert_eq!(margins(RESULTS).iter().map(|(_, shares)| shares.len()).sum::<usize>(), all.len());
    }

    #[test]
    fn every_scene_of_the_results_has_an_entry() {
        let (scenes, page) = (Scene::all(RESULTS), page(RESULTS, SPEED));
        assert!(scenes.len() > 150 && scenes.len() == RESULTS.lines().filter(|line| line.starts_with("| [")).count());
        for scene in &scenes {
            assert!(page.contains(&scene.entry()), "{} is in no folder of the page", scene.place);
        }
        let said = RESULTS.lines().find(|line| line.contains(" expectations: ")).unwrap();
        let checks: usize = scenes.iter().map(|scene| scene.checks.len()).sum();
        let held: usize = scenes.iter().map(Scene::held).sum();
        assert!(
            said.contains(&format!(" with {checks} expectations: ")) && page.contains(&format!("{held} of {checks}"))
        );
        let missing = scenes.iter().filter(|scene| !scene.ran()).count();
        assert!(
            said.contains("have not run") == (missing > 1) && (missing == 0 || said.contains(&missing.to_string()))
        );
    }

    #[test]
    fn what_does_not_hold_is_named() {
        let results = "| [A \\| b](line/a.ron) | Moes. | `H_c`: 1 | 2.000 | **short** | 2026-11-29 <!-- 1 --> |\n\
                       |  |  | `P_c`: 1 | 1.000 | ok |  |\n\
                       | [B](point/b.ron) |  | it runs | not yet |  |  |\n";
        let page = page(results, SPEED);
        for said in [
            "1 of 2 expectations hold",
            "- **A \\| b**: `H_c`: 1. Value: 2.000. `line/a.ron`",
            "- **A \\| b**: **1 of 2** hold, 2026-11-29. Moes. `line/a.ron`",
            "- **B**: has not run as it is now. `point/b.ron`",
            "| `point` | 1 | 1 | 0 | 0 |",
        ] {
            assert!(page.contains(said), "{said}: {page}");
        }
    }
}
