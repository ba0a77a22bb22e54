//! Predefined arrangements of the tabs. The user can drag the tabs afterwards.

use super::tab::Tab;
use egui_tiles::{Linear, LinearDir, Tile, TileId, Tiles, Tree};

/// Width of the window from which another tab fits next to the first \[points\].
const WIDE: f32 = 1700.0;

/// Arrangement of the tabs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Layout {
    /// One tab at a time.
    #[default]
    Explore,
    /// Profiles next to the chart of regimes.
    Teach,
    /// Profiles next to traction and results, with axes in SI units.
    Engineer,
    /// Basis next to its errors.
    ModelReduction,
}

impl Layout {
    /// All arrangements in their order.
    #[cfg(test)]
    const ALL: [Self; 4] = [Self::Explore, Self::Teach, Self::Engineer, Self::ModelReduction];

    /// Returns the groups of tabs from left to right. The first tab of each group is in front. Tabs that are not
    /// listed go to the last group.
    fn groups(self, wide: bool) -> &'static [&'static [Tab]] {
        use Tab::{Accuracy, Basis, ContactMap, Profiles, Regimes, Results, Tpwl, Traction, Training, Transient};
        match (self, wide) {
            (Self::Explore, false) => &[&[]],
            (Self::Explore, true) => {
                &[&[Profiles, ContactMap, Basis, Accuracy, Training, Transient, Tpwl, Results], &[Regimes, Traction]]
            }
            (Self::Teach, false) => &[&[Profiles, ContactMap, Traction, Transient], &[Regimes]],
            (Self::Teach, true) => &[&[Profiles, ContactMap, Transient], &[Regimes], &[Traction]],
            (Self::Engineer, false) => &[&[Profiles, ContactMap, Regimes], &[Traction, Results]],
            (Self::Engineer, true) => &[&[Profiles, ContactMap], &[Traction, Regimes], &[Results]],
            (Self::ModelReduction, false) => &[&[Basis, Profiles, ContactMap, Regimes], &[Accuracy]],
            (Self::ModelReduction, true) => &[&[Basis], &[Profiles, ContactMap, Regimes], &[Accuracy]],
        }
    }

    /// Returns the tree of tabs for a window of this width \[points\]. Each tab occurs once.
    pub fn tree(self, width: f32) -> Tree<Tab> {
        let groups = self.groups(width >= WIDE);
        let listed: Vec<Tab> = groups.iter().flat_map(|group| group.iter().copied()).collect();
        let rest = || Tab::ALL.iter().copied().filter(|tab| !listed.contains(tab));
        let mut tiles = Tiles::default();
        let mut beside: Vec<TileId> = Vec::new();
        for (k, group) in groups.iter().enumerate() {
            let last = k + 1 == groups.len();
            let tabs = group.iter().copied().chain(rest().filter(|_| last));
            let panes: Vec<TileId> = tabs.map(|tab| tiles.insert_pane(tab)).collect();
            beside.push(tiles.insert_tab_tile(panes));
        }
        let root = match beside[..] {
            [only] => only,
            _ => tiles.insert_container(Linear::new(LinearDir::Horizontal, beside)),
        };
        Tree::new(egui::Id::unique("tabs"), root, tiles)
    }
}

/// Returns the visible tabs of a tree.
pub fn seen(tree: &Tree<Tab>) -> Vec<Tab> {
    let tab = |id: TileId| match tree.tiles.get(id) {
        Some(Tile::Pane(tab)) => Some(*tab),
        _ => None,
    };
    tree.active_tiles().into_iter().filter_map(tab).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layouts_have_every_tab_once() {
        for (layout, width) in Layout::ALL.into_iter().flat_map(|layout| [(layout, 1280.0), (layout, 2560.0)]) {
            let tree = layout.tree(width);
            let groups = layout.groups(width >= WIDE);
            let mut tabs: Vec<Tab> = tree
                .tiles
                .tiles()
                .filter_map(|tile| match tile {
                    Tile::Pane(tab) => Some(*tab),
                    Tile::Container(_) => None,
                })
                .collect();
            tabs.sort_by_key(|tab| Tab::ALL.iter().position(|other| other == tab));
            assert_eq!(tabs, Tab::ALL, "{layout:?}");
            let front: Vec<Tab> = groups.iter().filter_map(|group| group.first().copied()).collect();
            let seen = seen(&tree);
            assert!(front.iter().all(|tab| seen.contains(tab)), "{layout:?}: {seen:?}");
            assert_eq!(seen.len(), groups.len());
        }
    }
}
