//! Compact form of the arrangement of tabs.

use crate::app::session;
use crate::app::tab::Tab;
use egui_tiles::{Container, Linear, LinearDir, Tabs, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

/// Tile of the arrangement. Shares of a row or column are relative.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Part {
    /// One tab.
    #[serde(rename = "t")]
    Tab(Tab),
    /// Tabs behind each other, and the index of the front one.
    #[serde(rename = "g")]
    Group(Vec<Part>, usize),
    /// Tiles next to each other.
    #[serde(rename = "r")]
    Row(Vec<(f32, Part)>),
    /// Tiles below each other.
    #[serde(rename = "c")]
    Column(Vec<(f32, Part)>),
}

impl Part {
    /// Returns the whole arrangement. `None` if it has a tile that no layout of this window has.
    pub fn of(tree: &Tree<Tab>) -> Option<Self> {
        Self::of_tile(&tree.tiles, tree.root()?)
    }

    fn of_tile(tiles: &Tiles<Tab>, id: TileId) -> Option<Self> {
        Some(match tiles.get(id)? {
            Tile::Pane(tab) => Self::Tab(*tab),
            Tile::Container(Container::Tabs(tabs)) => {
                let front = tabs.children.iter().position(|child| Some(*child) == tabs.active);
                let parts = tabs.children.iter().map(|child| Self::of_tile(tiles, *child));
                Self::Group(parts.collect::<Option<_>>()?, front.unwrap_or(0))
            }
            Tile::Container(Container::Linear(linear)) => {
                let part = |child: &TileId| Some((linear.shares[*child], Self::of_tile(tiles, *child)?));
                let parts = linear.children.iter().map(part).collect::<Option<_>>()?;
                match linear.dir {
                    LinearDir::Horizontal => Self::Row(parts),
                    LinearDir::Vertical => Self::Column(parts),
                }
            }
            Tile::Container(Container::Grid(_)) => return None,
        })
    }

    /// Returns the arrangement as a tree of tabs. `None` if it is invalid.
    pub fn tree(&self) -> Option<Tree<Tab>> {
        let mut tiles = Tiles::default();
        let root = self.insert(&mut tiles);
        session::checked(&Tree::new(egui::Id::unique("tabs"), root, tiles))
    }

    fn insert(&self, tiles: &mut Tiles<Tab>) -> TileId {
        match self {
            Self::Tab(tab) => tiles.insert_pane(*tab),
            Self::Group(parts, front) => {
                let children: Vec<TileId> = parts.iter().map(|part| part.insert(tiles)).collect();
                let active = children.get(*front).copied();
                let mut tabs = Tabs::new(children);
                tabs.active = active.or(tabs.active);
                tiles.insert_container(tabs)
            }
            Self::Row(parts) => Self::linear(LinearDir::Horizontal, parts, tiles),
            Self::Column(parts) => Self::linear(LinearDir::Vertical, parts, tiles),
        }
    }

    fn linear(dir: LinearDir, parts: &[(f32, Self)], tiles: &mut Tiles<Tab>) -> TileId {
        let children: Vec<TileId> = parts.iter().map(|(_, part)| part.insert(tiles)).collect();
        let mut linear = Linear::new(dir, children.clone());
        for (child, (share, _)) in children.into_iter().zip(parts) {
            linear.shares.set_share(child, *share);
        }
        tiles.insert_container(linear)
    }
}
