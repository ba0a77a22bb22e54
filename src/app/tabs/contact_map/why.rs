//! Explanation of the map of the present point contact.

use crate::app::numbers::share;
use crate::scene::regime::Ratios;
use crate::solver::full::{Scalars, Solution};

/// Distance of H_min from the axis, in units of b, from which it lies in a side lobe.
const LOBE: f64 = 0.1;

/// Returns the explanation in three sentences.
pub fn explain(solution: &Solution) -> String {
    let Scalars { h_c, h_min, y_h_min, .. } = solution.scalars;
    let share = share(h_min / h_c);
    let elastic = Ratios::of(solution).regime().is_elastic();
    let (film, thinnest) = match (y_h_min < -LOBE, elastic) {
        (true, true) => (
            "the film is flat in the middle and thin in a horseshoe around the sides and the outlet, where pressure \
             drives oil out",
            format!("It is thinnest in the two side lobes, with {share} of the central film thickness"),
        ),
        (false, true) => (
            "the film is flat in the middle and narrows towards the outlet",
            format!("It is thinnest at the outlet on the axis, with {share} of the central film thickness"),
        ),
        (_, false) => (
            "the gap is close to that of rigid bodies: it is narrowest near the middle and opens to all sides",
            format!("The minimum film thickness is {share} of the central one"),
        ),
    };
    format!(
        "Seen from above, {film}. {thinnest}. The interferogram shows the same film as photographed in a rig with a \
         glass disc, each colour one thickness."
    )
}
