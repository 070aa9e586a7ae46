//! Text in SVG: escaped, measured by rule of thumb, wrapped.

use super::curve::decimal;
use super::scale::Label;

/// Where a text begins, is centred or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    fn word(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// Escapes what has a meaning in XML and drops control characters, which XML cannot hold.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' | '\r' => escaped.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => escaped.push(c),
        }
    }
    escaped
}

/// A text element.
pub(super) fn text(at: [f64; 2], size: f64, anchor: Anchor, content: &str) -> String {
    element(at, size, anchor, "", &escape(content))
}

/// A title in bold.
pub(super) fn bold(at: [f64; 2], size: f64, anchor: Anchor, content: &str) -> String {
    element(at, size, anchor, " font-weight=\"bold\"", &escape(content))
}

/// A text that runs upwards.
pub(super) fn upwards([x, y]: [f64; 2], size: f64, content: &str) -> String {
    let turn = format!(" transform=\"rotate(-90 {} {})\"", decimal(x), decimal(y));
    element([x, y], size, Anchor::Middle, &turn, &escape(content))
}

/// A label of a tick.
pub(super) fn label(at: [f64; 2], size: f64, anchor: Anchor, label: &Label) -> String {
    match label {
        Label::Plain(plain) => text(at, size, anchor, plain),
        Label::Power(exponent) => {
            let exponent = exponent.to_string().replace('-', "\u{2212}");
            let small = decimal(0.75 * size);
            let content =
                format!("10<tspan dy=\"{}\" font-size=\"{small}\">{exponent}</tspan>", decimal(-0.4 * size));
            element(at, size, anchor, "", &content)
        }
    }
}

fn element([x, y]: [f64; 2], size: f64, anchor: Anchor, more: &str, content: &str) -> String {
    let (x, y, size, anchor) = (decimal(x), decimal(y), decimal(size), anchor.word());
    format!(
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{more}>{content}</text>\n"
    )
}

/// Width of a text in pixels; fonts differ, hence a little generous.
pub(super) fn width(text: &str, size: f64) -> f64 {
    0.56 * size * text.chars().count() as f64
}

/// Breaks a text into lines of at most `room` pixels, between words.
pub(super) fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) + size < room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_in_names_is_escaped() {
        assert_eq!(
            escape("a<b & \"c\"\u{1}\n>"),
            "a&lt;b &amp; &quot;c&quot; &gt;",
            "nothing of it is markup"
        );
    }

    #[test]
    fn long_captions_are_wrapped_between_words() {
        let lines = wrapped("one two three four", 10.0, 70.0);
        assert_eq!(lines, ["one two", "three four"], "two lines");
        assert_eq!(wrapped("", 10.0, 70.0).len(), 0, "no caption, no line");
    }
}
