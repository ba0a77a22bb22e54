//! Text of a link.
//!
//! `#1.…` is a document with the arrangement of its tabs: a scene as text, compressed, in base 64 for addresses; 1
//! is the version. `#embed=profiles&sliders=M,L&lock=SRR&lesson=4&1.…` shows one tab with chosen sliders, for the
//! page of a course. All parts are optional, and their order is free.

use super::arrangement::Part;
use crate::app::document::Document;
use crate::app::panels::sliders::SLIDERS;
use crate::app::tab::Tab;
use crate::solver::parameters::Quantity;
use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use egui_tiles::Tree;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use serde::{Deserialize, Serialize};

/// Version of packed documents.
const VERSION: &str = "1";
/// Maximum size of an unpacked document in a link \[bytes\].
const MOST_BYTES: usize = 1 << 20;
/// Maximum length of a link \[characters\].
const LONGEST: usize = 64 << 10;
/// Highest compression level.
const LEVEL: u8 = 9;

/// Reason why a link is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// The text is no link of this program.
    #[error("this is not a link of EHL Explorer: a link begins with # and then 1. or embed=")]
    Foreign,
    /// The link was written by another version of the program.
    #[error("this link has version {0}; this program reads version {VERSION}")]
    OtherVersion(String),
    /// The link is incomplete or changed.
    #[error("this link is damaged or cut off: copy it again, whole")]
    Damaged,
    /// The content is no document.
    #[error("this link holds no contact: {0}")]
    Document(String),
    /// An embed names an unknown tab, slider or lesson.
    #[error("this link names the unknown {what} {name}; accepted are {known}")]
    Unknown {
        /// Tab, slider or lesson.
        what: &'static str,
        /// Name in the link.
        name: String,
        /// Accepted names.
        known: String,
    },
}

/// Content of a link.
#[derive(Clone, Default)]
pub struct Fragment {
    /// Document.
    pub document: Option<Document>,
    /// Arrangement of the tabs.
    pub tree: Option<Tree<Tab>>,
    /// Single tab with chosen sliders.
    pub embed: Option<Embed>,
    /// Number of a lesson, from 1.
    pub lesson: Option<usize>,
}

/// Single tab for the page of a course.
#[derive(Clone, Debug, PartialEq)]
pub struct Embed {
    /// Tab.
    pub tab: Tab,
    /// Displayed sliders. All sliders if it is empty.
    pub sliders: Vec<Quantity>,
    /// Sliders that cannot be moved.
    pub locked: Vec<Quantity>,
}

/// Document in its packed form.
#[derive(Serialize, Deserialize)]
struct Packed {
    scene: String,
    tabs: Option<Part>,
}

impl Fragment {
    /// Returns the link of a document with its tabs.
    ///
    /// # Errors
    /// In practice never.
    pub fn link(document: &Document, tree: &Tree<Tab>) -> Result<String, LinkError> {
        let refused = |why: String| LinkError::Document(why);
        let scene = document.to_ron().map_err(|why| refused(why.to_string()))?;
        let packed = Packed { scene, tabs: Part::of(tree) };
        let packed: &dyn erased_serde::Serialize = &packed;
        let text = ron::to_string(packed).map_err(|why| refused(why.to_string()))?;
        let bytes = compress_to_vec(text.as_bytes(), LEVEL);
        Ok(format!("#{VERSION}.{}", URL_SAFE_NO_PAD.encode(bytes)))
    }

    /// Reads a link. Text before its `#` is ignored.
    ///
    /// # Errors
    /// A sentence.
    pub fn read(text: &str) -> Result<Self, LinkError> {
        let text = text.trim();
        let (_, parts) = text.split_once('#').filter(|_| text.len() <= LONGEST).ok_or(LinkError::Foreign)?;
        let (mut fragment, mut sliders, mut locked, mut tab) = (Self::default(), Vec::new(), Vec::new(), None);
        for part in parts.split('&') {
            match part.split_once('=') {
                Some(("embed", name)) => tab = Some(tab_of(name)?),
                Some(("sliders", names)) => sliders = quantities(names)?,
                Some(("lock", names)) => locked = quantities(names)?,
                Some(("lesson", name)) => fragment.lesson = Some(lesson_of(name)?),
                Some(_) => return Err(LinkError::Foreign),
                None => (fragment.document, fragment.tree) = unpacked(part)?,
            }
        }
        fragment.embed = tab.map(|tab| Embed { tab, sliders, locked });
        Ok(fragment)
    }
}

/// Unpacks a document and its tabs.
fn unpacked(text: &str) -> Result<(Option<Document>, Option<Tree<Tab>>), LinkError> {
    let (version, data) = text.split_once('.').ok_or(LinkError::Foreign)?;
    if version.is_empty() || !version.bytes().all(|digit| digit.is_ascii_digit()) {
        return Err(LinkError::Foreign);
    }
    if version != VERSION {
        return Err(LinkError::OtherVersion(version.chars().take(9).collect()));
    }
    let bytes = URL_SAFE_NO_PAD.decode(data).map_err(|_| LinkError::Damaged)?;
    let text = decompress_to_vec_with_limit(&bytes, MOST_BYTES).map_err(|_| LinkError::Damaged)?;
    let text = String::from_utf8(text).map_err(|_| LinkError::Damaged)?;
    let Packed { scene, tabs } = ron::from_str(&text).map_err(|_| LinkError::Damaged)?;
    let document = Document::from_ron(&scene).map_err(|why| LinkError::Document(why.to_string()))?;
    Ok((Some(document), tabs.and_then(|tabs| tabs.tree())))
}

/// Returns the letters and digits of a name in lower case, for comparison.
fn plain(name: &str) -> String {
    name.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

fn tab_of(name: &str) -> Result<Tab, LinkError> {
    let known = |tab: &&Tab| plain(&format!("{tab:?}")) == plain(name) || plain(tab.title()) == plain(name);
    let names = || Tab::ALL.iter().map(|tab| format!("{tab:?}").to_lowercase()).collect::<Vec<_>>().join(", ");
    let unknown = || LinkError::Unknown { what: "tab", name: name.to_owned(), known: names() };
    Tab::ALL.iter().find(known).copied().ok_or_else(unknown)
}

fn quantities(names: &str) -> Result<Vec<Quantity>, LinkError> {
    let of = |name: &str| {
        let known = |quantity: &&Quantity| plain(quantity.name()) == plain(name);
        let names = || SLIDERS.map(Quantity::name).join(", ");
        let unknown = || LinkError::Unknown { what: "slider", name: name.to_owned(), known: names() };
        SLIDERS.iter().find(known).copied().ok_or_else(unknown)
    };
    names.split(',').filter(|name| !name.is_empty()).map(of).collect()
}

fn lesson_of(name: &str) -> Result<usize, LinkError> {
    let count = crate::app::lessons::count();
    let number = name.parse().ok().filter(|number| (1..=count).contains(number));
    number.ok_or_else(|| LinkError::Unknown {
        what: "lesson",
        name: name.to_owned(),
        known: format!("the lessons 1 to {count}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::{Edit, Shape};
    use crate::app::layouts::Layout;
    use crate::scene::named_lubricant::NAMED;
    use crate::scene::{View, examples};
    use crate::solver::physics::lubricant::{Cavitation, Lubricant};
    use fastrand::Rng;

    fn log(rng: &mut Rng, low: f64, high: f64) -> f64 {
        low * (high / low).powf(rng.f64())
    }

    /// Returns a document that a user may have made: an example or the first contact, after some changes.
    fn document(rng: &mut Rng) -> Document {
        let example = &examples::all()[rng.usize(..examples::all().len())];
        let mut document = match rng.bool() {
            true => Document::of_scene(example.scene.clone()).unwrap_or_default(),
            false => Document::default(),
        };
        for _ in 0..rng.usize(..6) {
            let lubricant = document.lubricant;
            let edit = match rng.u8(..8) {
                0 => Edit::Shape(Shape::ALL[rng.usize(..3)]),
                1 => Edit::Quantity(Quantity::M, log(rng, 3.0, 900.0)),
                2 => Edit::Quantity(Quantity::L, log(rng, 0.5, 20.0)),
                3 => Edit::Quantity(Quantity::SlideToRollRatio, rng.f64()),
                4 => Edit::Typed(Quantity::Speed, log(rng, 0.1, 20.0)),
                5 => Edit::Named(&NAMED[rng.usize(..NAMED.len())]),
                6 => Edit::Heat(lubricant.heat.is_none()),
                _ => match rng.u8(..3) {
                    0 => Edit::Laws(Box::new(Lubricant { cavitation: Cavitation::Complementarity, ..lubricant })),
                    1 => {
                        let cavitation = Cavitation::MassConserving { supply_film_m: None };
                        Edit::Laws(Box::new(Lubricant { cavitation, ..lubricant }))
                    }
                    _ => Edit::View(Box::new(View {
                        pressure_loss: Some(log(rng, 1e-8, 1e-3)),
                        ..document.view.clone()
                    })),
                },
            };
            // A refused edit leaves the document unchanged.
            let _ = document.edit(edit);
        }
        document
    }

    #[test]
    fn a_link_opens_the_document_and_the_tabs_that_it_was_made_of() {
        let mut rng = Rng::with_seed(5);
        let layouts = [Layout::Explore, Layout::Teach, Layout::Engineer, Layout::ModelReduction];
        for k in 0..500 {
            let (document, mut tree) = (document(&mut rng), layouts[k % 4].tree([1280.0, 2560.0][k % 2]));
            let front = Tab::ALL[rng.usize(..Tab::ALL.len())];
            tree.make_active(|_, tile| matches!(tile, egui_tiles::Tile::Pane(tab) if *tab == front));
            let link = Fragment::link(&document, &tree).unwrap();
            let read = Fragment::read(&format!("https://host/page/{link}")).unwrap_or_else(|why| panic!("{k}: {why}"));
            let again = read.document.unwrap();
            // A link omits what a saved scene omits, such as constants of heat that is switched off.
            assert!(
                again.key() == document.key() && again.to_ron().unwrap() == document.to_ron().unwrap(),
                "{k}: {link}"
            );
            assert_eq!(Part::of(read.tree.as_ref().unwrap()), Part::of(&tree), "{k}");
            assert_eq!(Fragment::link(&again, &read.tree.unwrap()).unwrap(), link, "{k}");
        }
        let short = Fragment::link(&Document::default(), &Layout::Explore.tree(1280.0)).unwrap();
        assert!(short.len() < 700, "{} characters: {short}", short.len());
    }

    #[test]
    fn damaged_links_are_refused_with_a_sentence() {
        let link = Fragment::link(&Document::default(), &Layout::Explore.tree(1280.0)).unwrap();
        let mut rng = Rng::with_seed(6);
        for _ in 0..500 {
            let mut bytes = link.clone().into_bytes();
            match rng.u8(..3) {
                0 => bytes.truncate(rng.usize(4..bytes.len())),
                1 => bytes[rng.usize(3..link.len())] = b'!' + rng.u8(..90),
                _ => {
                    let at = rng.usize(3..link.len());
                    bytes.splice(at..at, (0..rng.usize(1..9)).map(|_| b'!' + rng.u8(..90)));
                }
            }
            let text = String::from_utf8(bytes).unwrap();
            match Fragment::read(&text) {
                // The checks of the format may miss a change. The result must still be a document.
                Ok(read) => assert!(read.document.is_some() || text.contains('&')),
                Err(why) => assert!(why.to_string().len() > 20, "{why}"),
            }
        }
        let huge = URL_SAFE_NO_PAD.encode(compress_to_vec(&vec![b' '; MOST_BYTES + 1], LEVEL));
        for (text, wanted) in [
            ("", LinkError::Foreign),
            ("https://host/page", LinkError::Foreign),
            ("#something", LinkError::Foreign),
            ("#2.abc", LinkError::OtherVersion("2".to_owned())),
            ("#1.", LinkError::Damaged),
            ("#1.!!", LinkError::Damaged),
            (&format!("#1.{huge}"), LinkError::Damaged),
            (&"#1.".repeat(LONGEST), LinkError::Foreign),
        ] {
            assert_eq!(Fragment::read(text).err(), Some(wanted), "{}", text.chars().take(40).collect::<String>());
        }
    }

    #[test]
    fn an_embed_names_its_tab_and_sliders() {
        let read = Fragment::read("#embed=contact-map&sliders=M,srr&lock=L&lesson=2").unwrap();
        let sliders = vec![Quantity::M, Quantity::SlideToRollRatio];
        assert_eq!(read.embed, Some(Embed { tab: Tab::ContactMap, sliders, locked: vec![Quantity::L] }));
        assert!(read.lesson == Some(2) && read.document.is_none() && read.tree.is_none());
        for text in ["#embed=pictures", "#embed=profiles&sliders=load", "#lesson=99", "#lesson=0"] {
            let why = Fragment::read(text).err().unwrap();
            assert!(matches!(why, LinkError::Unknown { .. }) && why.to_string().contains("accepted are"), "{why}");
        }
    }
}
