//! Six contacts in the notation of each interface: inside and outside the trained range, thermal, starved, elliptical,
//! shear-thinning. Python's tests read the same file.

use ehl_explorer::scene::Scene;
use serde_json::Value;

/// Contact in the notation of each interface.
pub struct Stated(Value);

impl Stated {
    /// Returns all six contacts.
    pub fn all() -> Vec<Self> {
        let all: Vec<Value> = serde_json::from_str(include_str!("../data/six_contacts.json")).unwrap();
        all.into_iter().map(Stated).collect()
    }

    /// Name of the contact.
    pub fn name(&self) -> &str {
        self.0["name"].as_str().unwrap()
    }

    /// True if it is inside the trained range of an embedded model.
    pub fn trained(&self) -> bool {
        self.0["trained"].as_bool().unwrap()
    }

    /// Words of the warning that gives the reason, if not.
    pub fn says(&self) -> Option<&str> {
        self.0["says"].as_str()
    }

    /// Slide-to-roll ratio.
    pub fn srr(&self) -> f64 {
        self.0["options"].get("srr").map_or(0.0, |srr| srr.as_f64().unwrap())
    }

    /// Values by names of fields.
    fn fields(&self) -> impl Iterator<Item = (&str, String)> {
        let word = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let words = move |value: &Value| match value {
            Value::Bool(_) => "yes".to_owned(),
            Value::Array(values) => values.iter().map(word).collect::<Vec<_>>().join(","),
            value => word(value),
        };
        self.0["options"].as_object().unwrap().iter().map(move |(name, value)| (name.as_str(), words(value)))
    }

    /// Returns the options of the command line.
    pub fn options(&self) -> Vec<String> {
        let option = |(name, word)| if word == "yes" { format!("--{name}") } else { format!("--{name}={word}") };
        self.fields().map(option).collect()
    }

    /// Returns a table of load cases.
    pub fn table(&self) -> String {
        let (titles, cells): (Vec<&str>, Vec<String>) = self.fields().unzip();
        format!("{}\n{}\n", titles.join(";"), cells.join(";"))
    }

    /// Returns a scene with this study.
    pub fn scene(&self, study: &str) -> Scene {
        let stated = self.0["scene"].as_str().unwrap();
        let text = format!("Scene(version: 1, title: \"{}\", {stated}, study: {study})", self.name());
        Scene::from_ron(&text).unwrap_or_else(|refused| panic!("{text}: {refused}"))
    }
}
