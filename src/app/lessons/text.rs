//! Source format of a lesson: Markdown with a line for the initial contact, and steps with their conditions.
//!
//! ```text
//! # Title
//! What it is about.
//! Start: line contact, M 40, L 10, roelands-oil
//! ## A step
//! What to do.
//! - Do: M between 1.5 and 3, tab Regimes
//! - At: M
//! - Seen: What there was to see.
//! - Check: P_max between 0.7 and 0.8
//! - Ask: A question of the worksheet.
//! ```

use super::goal::Goal;
use crate::app::refusal::Refusal;
use crate::scene::named_lubricant::{NAMED, NamedLubricant, by_name};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};

/// Lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Lesson {
    pub title: String,
    pub about: String,
    /// Initial contact.
    pub point: OperatingPoint,
    /// Initial lubricant.
    pub lubricant: &'static NamedLubricant,
    /// Steps in their order.
    pub steps: Vec<Step>,
}

/// Step of a lesson.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Step {
    pub title: String,
    /// Text: what to do, and why.
    pub text: String,
    /// Conditions of the step. Empty if it is only read.
    pub goals: Vec<Goal>,
    /// Name of the control for the step.
    pub control: Option<String>,
    /// Text after the step: what to notice.
    pub seen: String,
    /// Numbers of `seen` that the tests compare with the solver, separated by commas.
    pub check: String,
    /// Question of the worksheet.
    pub ask: String,
}

/// Reason why a text is no lesson.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct LessonError {
    line: usize,
    problem: String,
}

/// Maximum number of steps of a lesson, and of bytes of its text.
const MOST: (usize, usize) = (50, 100_000);

impl Lesson {
    /// Parses a lesson.
    ///
    /// # Errors
    /// The number of the invalid line, and the accepted form.
    pub fn read(text: &str) -> Result<Self, LessonError> {
        let refuse = |line: usize, problem: &str| LessonError { line: line + 1, problem: problem.to_owned() };
        if text.len() > MOST.1 {
            return Err(refuse(0, "a lesson has at most 100,000 letters"));
        }
        let mut lines = text.lines().enumerate();
        let title = lines.next().and_then(|(_, line)| line.strip_prefix("# "));
        let title = title.ok_or_else(|| refuse(0, "a lesson begins with `# ` and its title"))?.trim().to_owned();
        let (mut about, mut start, mut steps) = (String::new(), None, Vec::<Step>::new());
        // Name of the field to which a continuation line belongs.
        let mut last = "";
        for (k, line) in lines {
            let told = |why: Refusal| LessonError { line: k + 1, problem: why.to_string() };
            if let Some(title) = line.strip_prefix("## ") {
                if steps.len() == MOST.0 {
                    return Err(refuse(k, "a lesson has at most 50 steps"));
                }
                steps.push(Step { title: title.trim().to_owned(), ..Step::default() });
                last = "";
                continue;
            }
            match (steps.last_mut(), field(line)) {
                (None, Some(("Start", words))) => start = Some(start_of(words).map_err(told)?),
                (Some(step), Some(("Do", words))) => step.goals = Goal::all(words).map_err(told)?,
                (Some(step), Some(("At", words))) => step.control = Some(words.to_owned()),
                (Some(step), Some((name @ ("Seen" | "Check" | "Ask"), words))) => {
                    last = name;
                    if let Some(text) = step.folded(name) {
                        words.clone_into(text);
                    }
                }
                (None, _) => add(&mut about, line),
                (Some(step), _) if !last.is_empty() => {
                    if let Some(text) = step.folded(last) {
                        text.push(' ');
                        text.push_str(line.trim());
                    }
                }
                (Some(step), _) => add(&mut step.text, line),
            }
        }
        let missing = "a lesson needs a line like `Start: line contact, M 40, L 10, roelands-oil` before its steps";
        let (point, lubricant) = start.ok_or_else(|| refuse(0, missing))?;
        if steps.is_empty() {
            return Err(refuse(0, "a lesson needs a step; each begins with `## ` and its title"));
        }
        for step in &mut steps {
            step.text = step.text.trim().to_owned();
            for text in [&mut step.seen, &mut step.check, &mut step.ask] {
                *text = text.trim().to_owned();
            }
        }
        Ok(Self { title, about: about.trim().to_owned(), point, lubricant, steps })
    }
}

impl Step {
    /// Returns the text of a field that may continue on the next lines.
    fn folded(&mut self, name: &str) -> Option<&mut String> {
        match name {
            "Seen" => Some(&mut self.seen),
            "Check" => Some(&mut self.check),
            "Ask" => Some(&mut self.ask),
            _ => None,
        }
    }
}

fn add(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

/// Returns name and content of a line `- Do: words` or `Start: words`.
fn field(line: &str) -> Option<(&str, &str)> {
    let (name, words) = line.trim_start_matches("- ").split_once(':')?;
    ["Start", "Do", "At", "Seen", "Check", "Ask"].contains(&name).then(|| (name, words.trim()))
}

fn start_of(words: &str) -> Result<(OperatingPoint, &'static NamedLubricant), Refusal> {
    let like = "write it like `Start: line contact, M 40, L 10, roelands-oil`";
    let mut parts = words.split(',').map(str::trim);
    let kind = parts.next().and_then(|words| words.strip_suffix(" contact")).and_then(ContactKind::from_name);
    let Some(kind) = kind else {
        return Err(Refusal::new(format!("a lesson starts with a line contact or a point contact; {like}")));
    };
    let named = |name: &str| by_name(name).map_err(Refusal::from);
    let rest: Vec<&str> = parts.collect();
    let (point, name) = match *rest {
        ["published", name] => {
            let known = named(name)?;
            let point = known.studied_contact(kind);
            (point.ok_or_else(|| Refusal::new(format!("{name} has no published contact; {like}")))?, known.name)
        }
        [m, l, name] => {
            let number = |text: &str, name: &str| {
                let value = text.strip_prefix(name).and_then(|text| text.trim().parse().ok());
                value.ok_or_else(|| Refusal::new(format!("{name} is missing; {like}")))
            };
            let request = MoesRequest::new(kind, number(m, "M")?, number(l, "L")?);
            (si_from_moes(&request)?, named(name)?.name)
        }
        _ => return Err(Refusal::new(like)),
    };
    let lubricant = NAMED.iter().find(|named| named.name == name).ok_or_else(|| Refusal::new(like))?;
    Ok((point, lubricant))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "# Title\nAbout.\n\nStart: line contact, M 40, L 10, roelands-oil\n\n";

    #[test]
    fn a_lesson_is_read_with_its_start_and_steps() {
        let steps = "## One\nDo **this**.\n\n- Do: M between 1 and 3, tab Regimes\n- At: M\n- Seen: It is\n  so.\n- Check: M between 1\n  and 2\n- Ask: Why?\n\n## Two\nRead.\n";
        let lesson = Lesson::read(&format!("{HEAD}{steps}")).unwrap();
        assert!((lesson.point.moes().m - 40.0).abs() < 1e-9 && lesson.lubricant.name == "roelands-oil");
        let [one, two] = &lesson.steps[..] else { panic!("{:?}", lesson.steps) };
        assert_eq!((one.text.as_str(), one.seen.as_str()), ("Do **this**.", "It is so."));
        assert_eq!((one.goals.len(), one.control.as_deref()), (2, Some("M")));
        assert_eq!((one.check.as_str(), one.ask.as_str()), ("M between 1 and 2", "Why?"));
        assert!(two.goals.is_empty() && two.seen.is_empty());
        let published = Lesson::read("# T\nStart: point contact, published, squalane-pip\n## S\n").unwrap();
        assert_eq!(published.point.viscosity_pa_s, 0.0705);
    }

    #[test]
    fn what_is_no_lesson_is_refused_with_its_line() {
        for (text, line, part) in [
            ("Title", 1, "begins with"),
            ("# T\n## S\n", 1, "needs a line like `Start"),
            ("# T\nStart: cone, M 1, L 1, roelands-oil\n", 2, "line contact or a point contact"),
            ("# T\nStart: line contact, M 1, roelands-oil\n", 2, "write it like"),
            ("# T\nStart: line contact, M x, L 1, roelands-oil\n", 2, "M is missing"),
            ("# T\nStart: line contact, M 1, L 1, honey\n", 2, "no lubricant of that name"),
            ("# T\nStart: line contact, published, roelands-oil\n", 2, "no published contact"),
            ("# T\nStart: line contact, M nan, L 1, roelands-oil\n## S\n", 2, "Moes number M"),
        ] {
            let error = Lesson::read(text).unwrap_err();
            assert!(error.line == line && error.problem.contains(part), "{text:?}: {error}");
        }
        for goal in ["M between 3 and 1", "Q between 1 and 2", "tab Nowhere", "pin x", "lubricant honey", ""] {
            let error = Lesson::read(&format!("{HEAD}## S\n- Do: {goal}\n")).unwrap_err().to_string();
            assert!(error.contains("is no goal; accepted are"), "{goal}: {error}");
        }
        assert!(Lesson::read(HEAD).unwrap_err().to_string().contains("needs a step"));
    }
}
