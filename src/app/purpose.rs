//! Purpose of a path that the user is to choose.

use std::sync::Arc;

/// Purpose of a path that the user is to choose.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// Open a scene.
    Open,
    /// Save the scene.
    Save,
    /// Read inputs of a transient contact.
    Inputs,
    /// Read the heights of a surface's feature with this index.
    Profile(usize),
    /// Read a table of load cases.
    Cases,
    /// Read a table of measured values.
    Measured,
    /// Read a reduced model for a comparison.
    ComparedModel,
    /// Write a file with this content.
    Write(Written, Arc<Vec<u8>>),
}

/// Type of an exported file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// A reduced model.
    Model,
    Table,
    /// A vector drawing.
    Svg,
    /// An image.
    Png,
    /// A web page.
    Html,
    /// A page for print.
    Pdf,
    Arrays,
}

/// Texts of the dialog for a path.
pub struct Words {
    /// Title above the field.
    pub title: &'static str,
    /// Label of the button.
    pub action: &'static str,
    /// Name of this type of file.
    pub files: &'static str,
    /// Accepted file extensions.
    pub endings: &'static [&'static str],
    /// Suggested name.
    pub name: &'static str,
}

impl Purpose {
    /// Returns true if a file is read. It must then exist, and no file is replaced.
    pub fn reads(&self) -> bool {
        matches!(
            self,
            Self::Open | Self::Inputs | Self::Profile(_) | Self::Cases | Self::Measured | Self::ComparedModel
        )
    }

    /// Returns the texts of the dialog.
    pub fn words(&self) -> Words {
        let (title, action, files, endings, name): (_, _, _, &[&str], _) = match self {
            Self::Open => {
                let files = "Scene, campaign or reduced model";
                ("Open a scene, a campaign or a reduced model", "Open", files, &["ron", "rom"], "")
            }
            Self::Save => ("Save the scene", "Save", "Scene", &["ron"], "contact.ron"),
            Self::Inputs => ("Inputs from a table", "Read", "Table", &["csv"], ""),
            Self::Profile(_) => ("Profile of a surface from a table", "Read", "Table", &["csv"], ""),
            Self::Cases => ("Load cases from a table", "Read", "Table", &["csv"], ""),
            Self::Measured => ("Measured data from a table", "Read", "Table", &["csv", "txt"], ""),
            Self::ComparedModel => ("Add a reduced model to the comparison", "Add", "Reduced model", &["rom"], ""),
            Self::Write(Written::Model, _) => ("Save the reduced model", "Save", "Reduced model", &["rom"], "line.rom"),
            Self::Write(Written::Table, _) => ("Export the data as CSV", "Export", "Table", &["csv"], "profiles.csv"),
            Self::Write(Written::Html, _) => ("Export the page", "Export", "Page", &["html", "htm"], "contact.html"),
            Self::Write(Written::Pdf, _) => ("Export the report", "Export", "Report", &["pdf"], "contact.pdf"),
            Self::Write(Written::Arrays, _) => ("Export arrays", "Export", "Arrays for numpy", &["npz"], "model.npz"),
            Self::Write(Written::Svg, _) => ("Export the picture", "Export", "Picture", &["svg"], "contact.svg"),
            Self::Write(Written::Png, _) => ("Export the picture", "Export", "Picture", &["png"], "contact.png"),
        };
        Words { title, action, files, endings, name }
    }
}
