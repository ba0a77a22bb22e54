//! Checked arrangement of the tabs, rebuilt from the valid parts of a file.

use crate::app::tab::Tab;
use egui_tiles::{Container, Linear, Tabs, Tile, TileId, Tiles, Tree};
use std::collections::HashSet;

/// Maximum number of containers and tabs of a layout.
const MOST_TILES: usize = 100;

/// Returns a layout with every tab once. Tabs that the file does not contain are appended. `None` if the layout is
/// damaged or comes from another program.
pub fn checked(tree: &Tree<Tab>) -> Option<Tree<Tab>> {
    // The count also limits the depth, because no tile is visited twice.
    let root = tree.root().filter(|_| tree.tiles.iter().count() <= MOST_TILES)?;
    let mut copy = Copy { from: &tree.tiles, to: Tiles::default(), seen: HashSet::new(), tabs: Vec::new() };
    let root = copy.tile(root)?;
    for tab in Tab::ALL.iter().copied().filter(|tab| !copy.tabs.contains(tab)) {
        let pane = copy.to.insert_pane(tab);
        let Some(Tile::Container(container)) = copy.to.get_mut(root) else { return None };
        container.add_child(pane);
    }
    Some(Tree::new(egui::Id::unique("tabs"), root, copy.to))
}

struct Copy<'a> {
    from: &'a Tiles<Tab>,
    to: Tiles<Tab>,
    seen: HashSet<TileId>,
    tabs: Vec<Tab>,
}

impl Copy<'_> {
    fn tile(&mut self, id: TileId) -> Option<TileId> {
        let first = self.seen.insert(id);
        let container = match self.from.get(id).filter(|_| first)? {
            Tile::Pane(tab) if self.tabs.contains(tab) => return None,
            Tile::Pane(tab) => {
                self.tabs.push(*tab);
                return Some(self.to.insert_pane(*tab));
            }
            Tile::Container(container) => container,
        };
        let old: Vec<TileId> = container.children().copied().collect();
        let new = old.iter().map(|child| self.tile(*child)).collect::<Option<Vec<TileId>>>()?;
        let copied = match container {
            _ if new.is_empty() => return None,
            Container::Tabs(tabs) => {
                let active = old.iter().zip(&new).find(|(old, _)| Some(**old) == tabs.active).map(|(_, new)| *new);
                let mut copied = Tabs::new(new);
                copied.active = active.or(copied.active);
                Container::Tabs(copied)
            }
            Container::Linear(linear) => {
                let mut copied = Linear::new(linear.dir, new.clone());
                for (old, new) in old.into_iter().zip(new) {
                    let share = linear.shares[old];
                    (share.is_finite() && share > 0.0).then(|| copied.shares.set_share(new, share))?;
                }
                Container::Linear(copied)
            }
            // No layout of this window has a grid.
            Container::Grid(_) => return None,
        };
        Some(self.to.insert_container(copied))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui_tiles::LinearDir;

    fn tabs_of(panes: Vec<Tab>) -> Tree<Tab> {
        Tree::new_tabs(egui::Id::unique("tabs"), panes)
    }

    #[test]
    fn old_layout_gets_a_new_tab() {
        let old: Vec<Tab> = Tab::ALL.iter().copied().filter(|tab| *tab != Tab::Results).rev().collect();
        let tree = checked(&tabs_of(old.clone())).unwrap();
        let panes: Vec<Tab> = match tree.root().and_then(|root| tree.tiles.get(root)) {
            Some(Tile::Container(container)) => {
                container.children().filter_map(|id| tree.tiles.get_pane(id).copied()).collect()
            }
            _ => Vec::new(),
        };
        assert_eq!(panes, [&old[..], &[Tab::Results]].concat());
        assert!(checked(&tabs_of(vec![Tab::Profiles; 2])).is_none());
        assert!(checked(&Tree::empty(egui::Id::unique("tabs"))).is_none());
    }

    #[test]
    fn adjacent_tabs_keep_shares_and_bad_layouts_are_refused() {
        // Two groups of tabs next to each other, the first twice as wide.
        let side_by_side = |share: f32| {
            let mut tiles = Tiles::default();
            let groups = [&Tab::ALL[..3], &Tab::ALL[3..]].map(|group| {
                let panes: Vec<TileId> = group.iter().map(|tab| tiles.insert_pane(*tab)).collect();
                tiles.insert_tab_tile(panes)
            });
            let mut linear = Linear::new(LinearDir::Horizontal, groups.to_vec());
            linear.shares.set_share(groups[0], share);
            let root = tiles.insert_container(linear);
            (Tree::new(egui::Id::unique("tabs"), root, tiles), root, groups[1])
        };
        let (tree, ..) = side_by_side(2.0);
        let again = checked(&tree).unwrap();
        let Some(Tile::Container(Container::Linear(linear))) = again.tiles.get(again.root().unwrap()) else { panic!() };
        assert_eq!(linear.children.iter().map(|child| linear.shares[*child]).collect::<Vec<_>>(), [2.0, 1.0]);
        for share in [f32::NAN, f32::INFINITY, 0.0, -1.0] {
            assert!(checked(&side_by_side(share).0).is_none(), "{share}");
        }
        let (mut cyclic, root, group) = side_by_side(2.0);
        if let Some(Tile::Container(container)) = cyclic.tiles.get_mut(group) {
            container.add_child(root);
        }
        assert!(checked(&cyclic).is_none());
        let mut grid = Tiles::default();
        let panes = Tab::ALL.iter().copied().map(|tab| grid.insert_pane(tab)).collect();
        let root = grid.insert_grid_tile(panes);
        assert!(checked(&Tree::new(egui::Id::unique("tabs"), root, grid)).is_none());
    }
}
