//! Text with symbols, and its width.

use serde::{Deserialize, Serialize};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider as _};

/// Font size of a subscript over that of its symbol.
pub(super) const SUBSCRIPT: f64 = 0.72;
/// Offset of a subscript below the baseline, over the font size of its symbol.
pub(super) const LOWERED: f64 = 0.22;
/// Slant of italic symbols.
pub(super) const SLANT: f64 = 0.2;
/// Approximate width of a letter over the font size; larger than that of most letters.
const LETTER_WIDTH: f64 = 0.56;

/// Part of a text with one style.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Piece {
    pub text: String,
    pub italic: bool,
    pub subscript: bool,
}

/// Line of text with italic symbols and subscripts.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Words(Vec<Piece>);

impl Words {
    /// Returns plain text.
    pub fn plain(text: impl Into<String>) -> Self {
        Self(vec![Piece { text: text.into(), italic: false, subscript: false }])
    }

    /// Parses text with symbols in braces: `Pressure {P} = {p}/{p_H}`.
    pub fn marked(text: &str) -> Self {
        let mut words = Self::default();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            words.push(before, false, false);
            let (inside, behind) = after.split_once('}').unwrap_or((after, ""));
            let (base, subscript) = inside.split_once('_').unwrap_or((inside, ""));
            words.push(base, base.starts_with(|c: char| c.is_ascii_alphabetic()), false);
            words.push(subscript, false, true);
            rest = behind;
        }
        words.push(rest, false, false);
        words
    }

    /// Adds a part with one style.
    pub fn push(&mut self, text: &str, italic: bool, subscript: bool) {
        if !text.is_empty() {
            self.0.push(Piece { text: text.to_owned(), italic, subscript });
        }
    }

    pub(super) fn pieces(&self) -> &[Piece] {
        &self.0
    }

    /// Returns the text without styles. Subscripts follow a `_`.
    pub fn text(&self) -> String {
        let piece = |piece: &Piece| if piece.subscript { format!("_{}", piece.text) } else { piece.text.clone() };
        self.0.iter().map(piece).collect()
    }

    /// Returns the width at a font size, both in the same unit.
    pub fn length(&self, size: f64) -> f64 {
        self.0.iter().map(|piece| piece.length(size)).sum()
    }
}

impl Piece {
    /// Returns the font size of this part if normal text has `size`.
    pub fn size(&self, size: f64) -> f64 {
        if self.subscript { SUBSCRIPT * size } else { size }
    }

    /// Returns the width of this part.
    pub fn length(&self, size: f64) -> f64 {
        let size = self.size(size);
        let Some(font) = font() else { return self.text.chars().count() as f64 * LETTER_WIDTH * size };
        let (letters, widths) = (font.charmap(), font.glyph_metrics(Size::new(size as f32), LocationRef::default()));
        let width = |letter: char| letters.map(letter).and_then(|glyph| widths.advance_width(glyph));
        self.text.chars().map(|letter| width(letter).map_or(LETTER_WIDTH * size, f64::from)).sum()
    }
}

/// Returns the font that the program ships.
pub(super) fn font() -> Option<FontRef<'static>> {
    FontRef::new(epaint_default_fonts::UBUNTU_LIGHT).ok()
}

/// Breaks a text between words into lines of at most `width` at a font size, both in the same unit.
pub fn wrapped(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match (lines.last_mut(), longer) {
            (Some(line), Some(longer)) if Words::plain(&longer).length(size) <= width => *line = longer,
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_between_words_and_lose_none() {
        let text = "M 40.00, L 10.00, R 3.000 mm, w 200000 N/m";
        let lines = wrapped(text, 8.0, 70.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| Words::plain(line).length(8.0) <= 70.0), "{lines:?}");
        assert_eq!(lines.join(" "), text);
    }

    #[test]
    fn symbols_are_slanted_and_subscripts_are_small() {
        let words = Words::marked("Pressure {P} = {p}/{p_H}");
        assert_eq!(words.text(), "Pressure P = p/p_H");
        let looks: Vec<(bool, bool)> = words.pieces().iter().map(|piece| (piece.italic, piece.subscript)).collect();
        assert_eq!(
            looks,
            [
                (false, false),
                (true, false),
                (false, false),
                (true, false),
                (false, false),
                (true, false),
                (false, true)
            ]
        );
        assert!(Words::marked("{σ}").pieces().iter().all(|piece| !piece.italic));
        // Widths are those of the letters: wide letters take more room than narrow ones, a larger font more than a
        // small one.
        let [wide, narrow] = ["MMM", "iii"].map(|text| Words::plain(text).length(8.0));
        assert!(wide > 2.0 * narrow && (Words::plain("MMM").length(16.0) / wide - 2.0).abs() < 1e-3);
    }
}
