//! Tests of nodes that leave the cavitated set, and of the end of a cycle. Solutions are tested in `tests/solver`.

use super::{ActiveSet, CYCLE};

fn set(ruptured: &str, multiplier: &[f64]) -> ActiveSet {
    let ruptured = ruptured.chars().map(|c| c == 'A').collect();
    ActiveSet { ruptured, multiplier: multiplier.to_vec(), ..ActiveSet::default() }
}

fn word(set: &ActiveSet) -> String {
    set.ruptured.iter().map(|&ruptured| if ruptured { 'A' } else { 'P' }).collect()
}

#[test]
fn blocks_are_filled_from_both_ends_up_to_the_inflow() {
    // The inflow of the first cell exceeds its demand by 3. It fills the next two cells, but not the last one.
    let mut flooded = set("PPAAAA", &[0.0, 0.0, -3.0, 1.0, 1.0, 2.0]);
    assert!(flooded.release(&[1.0; 6], 1));
    assert_eq!(word(&flooded), "PPPPPA");
    // The same from the right, with cells of other widths.
    let mut flooded = set("AAAAPP", &[2.0, 1.0, 1.0, -3.0, 0.0, 0.0]);
    assert!(flooded.release(&[1.0, 1.0, 1.0, 0.5, 1.0, 1.0], 1));
    assert_eq!(word(&flooded), "AAPPPP");
    // Inside a block only the nodes with λ < 0 leave.
    let mut hole = set("PAAAAP", &[0.0, 1.0, -0.5, 1.0, 1.0, 0.0]);
    assert!(hole.release(&[1.0; 6], 1));
    assert_eq!(word(&hole), "PAPAAP");
    let mut steady = set("PPAAAA", &[0.0, 0.0, 0.2, 1.0, 1.0, 2.0]);
    assert!(!steady.release(&[1.0; 6], 1));
}

#[test]
fn lines_are_filled_each_for_itself() {
    // Two adjacent lines: the inflow of the second one fills two cells, that of the first one none.
    let mut plane = set("PPAAAAAA", &[0.0, 0.0, 0.5, -1.5, 1.0, 1.0, 1.0, 1.0]);
    assert!(plane.release(&[1.0; 4], 2));
    assert_eq!(word(&plane), "PPAPAPAA");
}

#[test]
fn recurring_sets_are_then_moved_node_by_node() {
    let mut cycling = set("PPAAAA", &[0.0, 0.0, -3.0, 1.0, 1.0, 2.0]);
    for k in 0..1 + CYCLE {
        assert!(!cycling.cautious, "after {k} steps");
        cycling.remember();
        cycling.ruptured[2] = !cycling.ruptured[2];
        assert!(!cycling.is_still());
    }
    assert!(cycling.cautious);
    cycling.ruptured[2] = true;
    assert!(cycling.release(&[1.0; 6], 1));
    assert_eq!(word(&cycling), "PPPAAA");
}
