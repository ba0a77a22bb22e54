//! Six contacts in the words of each interface: inside and outside the trained range, thermal, starved, elliptical,
//! shear-thinning. Python's tests read the same file.

use ehl_explorer::scene::Scene;
use serde_json::Value;

/// A contact in the words of each interface.
pub struct Stated(Value);

impl Stated {
    /// All six.
    pub fn all() -> Vec<Self> {
        let all: Vec<Value> = serde_json::from_str(include_str!("../data/six_contacts.json")).unwrap();
        all.into_iter().map(Stated).collect()
    }

    /// What it is.
    pub fn name(&self) -> &str {
        self.0["name"].as_str().unwrap()
    }

    /// Whether a model of the program was trained for it.
    pub fn trained(&self) -> bool {
        self.0["trained"].as_bool().unwrap()
    }

    /// Words of the warning that says why not.
    pub fn says(&self) -> Option<&str> {
        self.0["says"].as_str()
    }

    /// Its slide-to-roll ratio.
    pub fn srr(&self) -> f64 {
        self.0["options"].get("srr").map_or(0.0, |srr| srr.as_f64().unwrap())
    }

    /// Names of fields and what they are.
    fn fields(&self) -> impl Iterator<Item = (&str, String)> {
        let word = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let words = move |value: &Value| match value {
            Value::Bool(_) => "yes".to_owned(),
            Value::Array(values) => values.iter().map(word).collect::<Vec<_>>().join(","),
            value => word(value),
        };
        self.0["options"].as_object().unwrap().iter().map(move |(name, value)| (name.as_str(), words(value)))
    }

    /// As options of the command line.
    pub fn options(&self) -> Vec<String> {
        let option = |(name, word)| if word == "yes" { format!("--{name}") } else { format!("--{name}={word}") };
        self.fields().map(option).collect()
    }

    /// As a table of load cases.
    pub fn table(&self) -> String {
        let (titles, cells): (Vec<&str>, Vec<String>) = self.fields().unzip();
        format!("{}\n{}\n", titles.join(";"), cells.join(";"))
    }

    /// As a scene that asks a question.
    pub fn scene(&self, study: &str) -> Scene {
        let stated = self.0["scene"].as_str().unwrap();
        let text = format!("Scene(version: 1, title: \"{}\", {stated}, study: {study})", self.name());
        Scene::from_ron(&text).unwrap_or_else(|refused| panic!("{text}: {refused}"))
    }
}
