//! What a path is asked for.

use crate::scene::Sheet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a path is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// Open a scene.
    Open,
    /// Save the scene.
    Save,
    /// Read inputs of a contact in time.
    Inputs,
    /// Read a table of load cases.
    Cases,
    /// Read a reduced model that others are compared with.
    Beside,
    /// Write a file with this content.
    Write(Written, Arc<Vec<u8>>),
    /// Write a sheet as notes with figures beside them.
    Notes(Arc<Sheet>),
}

/// What is written beside scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// A reduced model.
    Model,
    Table,
    /// A drawing.
    Svg,
    /// An image.
    Png,
    /// A page.
    Html,
    Arrays,
}

/// How a path is asked for.
pub struct Words {
    /// Above the field.
    pub title: &'static str,
    /// On the button.
    pub action: &'static str,
    /// What such files are called.
    pub files: &'static str,
    /// How their names end.
    pub endings: &'static [&'static str],
    /// A name to begin with.
    pub name: &'static str,
}

impl Purpose {
    /// Whether a file is read: then it must exist, and none is replaced.
    pub fn reads(&self) -> bool {
        matches!(self, Self::Open | Self::Inputs | Self::Cases | Self::Beside)
    }

    /// What is written besides a file of a name.
    pub fn beside(&self, path: &Path) -> Vec<PathBuf> {
        let Self::Notes(sheet) = self else { return Vec::new() };
        sheet.notes(path).into_iter().skip(1).map(|(path, _)| path).collect()
    }

    /// How a path is asked for.
    pub fn words(&self) -> Words {
        let (title, action, files, endings, name): (_, _, _, &[&str], _) = match self {
            Self::Open => {
                let files = "Scene, campaign or reduced model";
                ("Open a scene, a campaign or a reduced model", "Open", files, &["ron", "rom"], "")
            }
            Self::Save => ("Save the scene", "Save", "Scene", &["ron"], "contact.ron"),
            Self::Inputs => ("Inputs from a table", "Read", "Table", &["csv"], ""),
            Self::Cases => ("Load cases from a table", "Read", "Table", &["csv"], ""),
            Self::Beside => ("Add a reduced model to the comparison", "Add", "Reduced model", &["rom"], ""),
            Self::Write(Written::Model, _) => ("Save the reduced model", "Save", "Reduced model", &["rom"], "line.rom"),
            Self::Write(Written::Table, _) => ("Export the data as CSV", "Export", "Table", &["csv"], "profiles.csv"),
            Self::Notes(_) => ("Export the sheet", "Export", "Notes", &["md"], "contact.md"),
            Self::Write(Written::Html, _) => ("Export the sheet", "Export", "Page", &["html", "htm"], "contact.html"),
            Self::Write(Written::Arrays, _) => ("Export arrays", "Export", "Arrays for numpy", &["npz"], "model.npz"),
            Self::Write(Written::Svg, _) => ("Export the picture", "Export", "Picture", &["svg"], "contact.svg"),
            Self::Write(Written::Png, _) => ("Export the picture", "Export", "Picture", &["png"], "contact.png"),
        };
        Words { title, action, files, endings, name }
    }
}
