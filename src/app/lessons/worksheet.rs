//! Worksheet of a lesson as a page of HTML for print: on the first page the questions with space for answers and the
//! picture of the first contact; from the second page on the solutions with a picture after each step.

use super::text::{Lesson, Step};
use crate::app::document::{Document, Edit, Key};
use crate::app::refusal::Refusal;
use crate::engine::Answer;
use crate::scene::{Page, profiles};
use crate::solver::physics::engineering::UnitSystem;
use std::fmt::Write as _;

impl Lesson {
    /// Returns the contact at the start and after each step, if each goal is met in the middle of its range.
    ///
    /// # Errors
    /// A sentence if the document refuses a goal.
    pub fn contacts(&self) -> Result<Vec<Key>, Refusal> {
        let mut document = Document::default();
        document.edit(Edit::Contact(self.point, Box::new(self.lubricant.laws)))?;
        let mut contacts = vec![document.key()];
        for step in &self.steps {
            step.goals.iter().try_for_each(|goal| goal.carry_out(&mut document))?;
            contacts.push(document.key());
        }
        Ok(contacts)
    }

    /// Returns the contacts without repetitions, and for the start and each step the index of its contact.
    ///
    /// # Errors
    /// A sentence if the document refuses a goal.
    pub fn pictures(&self) -> Result<(Vec<Key>, Vec<usize>), Refusal> {
        let (mut keys, mut indices) = (Vec::<Key>::new(), Vec::new());
        for contact in self.contacts()? {
            let known = keys.iter().position(|key| *key == contact);
            indices.push(known.unwrap_or(keys.len()));
            if known.is_none() {
                keys.push(contact);
            }
        }
        Ok((keys, indices))
    }

    /// Returns the worksheet with the answers to the contacts of [`Lesson::pictures`].
    pub fn worksheet(&self, answers: &[Answer], indices: &[usize]) -> String {
        let title = escaped(&self.title);
        let mut text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n<style>\n\
             body {{ font: 10.5pt sans-serif; color: #222; max-width: 46em; margin: 1.5em auto; padding: 0 1em }}\n\
             h2 {{ font-size: 1.05em; margin: 1.1em 0 0.2em }}\np {{ margin: 0.3em 0 }}\n\
             .answer {{ border-bottom: 1px solid #bbb; height: 1.7em }}\n.question {{ font-style: italic }}\n\
             .name {{ float: right }}\n.solutions {{ break-before: page }}\nsection {{ break-inside: avoid }}\n\
             svg {{ max-width: 48%; height: auto; margin: 0.2em 0.5em 0 0 }}\n</style>\n</head>\n<body>\n\
             <p class=\"name\">Name ______________________</p>\n<h1>{title}</h1>\n{}\n",
            paragraphs(&self.about)
        );
        let figures = |at: usize| indices.get(at).and_then(|k| answers.get(*k)).map(figures).unwrap_or_default();
        text.push_str(&figures(0));
        for (k, step) in self.steps.iter().enumerate() {
            let _ = write!(
                text,
                "<section>\n<h2>{}. {}</h2>\n{}\n<p class=\"question\">{}</p>\n{}</section>\n",
                k + 1,
                escaped(&step.title),
                paragraphs(&step.text),
                escaped(question(step)),
                "<div class=\"answer\"></div>\n".repeat(LINES)
            );
        }
        let _ = writeln!(text, "<h1 class=\"solutions\">{title}: solutions</h1>");
        for (k, step) in self.steps.iter().enumerate() {
            let (number, title) = (k + 1, escaped(&step.title));
            let _ = write!(text, "<section>\n<h2>{number}. {title}</h2>\n{}\n", paragraphs(&step.seen));
            // A step that only opens a tab has the picture of the step before.
            if indices.get(k) != indices.get(k + 1) {
                text.push_str(&figures(k + 1));
            }
            text.push_str("</section>\n");
        }
        text.push_str("</body>\n</html>\n");
        text
    }
}

/// Empty lines for an answer.
const LINES: usize = 2;

fn question(step: &Step) -> &str {
    if step.ask.is_empty() { "What do you see?" } else { &step.ask }
}

/// Draws pressure and film thickness of an answer.
fn figures(answer: &Answer) -> String {
    let moes = answer.request.point.moes();
    let caption = format!("M {:.3}, L {:.3}", moes.m, moes.l);
    let page = Page { width_mm: 80.0, height_mm: 52.0, caption, ..Page::default() };
    let charts = profiles(std::slice::from_ref(answer), UnitSystem::default()).map(|figure| figure.to_svg(&page));
    format!("<div>\n{}\n</div>\n", charts.join("\n"))
}

/// Returns Markdown with emphasis as HTML paragraphs.
fn paragraphs(text: &str) -> String {
    let bold = |paragraph: &str| {
        let escaped = escaped(&paragraph.split_whitespace().collect::<Vec<_>>().join(" "));
        let parts: Vec<String> = escaped
            .split("**")
            .enumerate()
            .map(|(k, part)| if k % 2 == 1 { format!("<b>{part}</b>") } else { part.to_owned() })
            .collect();
        format!("<p>{}</p>", parts.concat())
    };
    text.split("\n\n").map(bold).collect::<Vec<_>>().join("\n")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
