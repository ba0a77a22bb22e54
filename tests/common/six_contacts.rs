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

    /// As a table of load cases, if that has columns for it.
    pub fn table(&self) -> Option<&str> {
        self.0["table"].as_str()
    }

    /// Its slide-to-roll ratio.
    pub fn srr(&self) -> f64 {
        self.0["options"].get("srr").map_or(0.0, |srr| srr.as_f64().unwrap())
    }

    /// As options of the command line.
    pub fn options(&self) -> Vec<String> {
        let word = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let option = |(name, value): (&String, &Value)| match value {
            Value::Bool(_) => format!("--{name}"),
            Value::Array(values) => format!("--{name}={}", values.iter().map(word).collect::<Vec<_>>().join(",")),
            value => format!("--{name}={}", word(value)),
        };
        self.0["options"].as_object().unwrap().iter().map(option).collect()
    }

    /// As a scene that asks a question.
    pub fn scene(&self, study: &str) -> Scene {
        let stated = self.0["scene"].as_str().unwrap();
        let text = format!("Scene(version: 1, title: \"{}\", {stated}, study: {study})", self.name());
        Scene::from_ron(&text).unwrap_or_else(|refused| panic!("{text}: {refused}"))
    }
}
