//! From characters to tokens.

use super::{ExpressionError, ExpressionProblem, MAX_CHARACTERS};

/// An operator as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Plus,
    Minus,
    Times,
    Divide,
    Power,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Not,
}

/// What a token is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    Number(f64),
    Name(String),
    Operator(Operator),
    Open,
    Close,
    Comma,
    End,
}

/// A token and the characters it covers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) start: usize,
    pub(super) end: usize,
}

/// Cuts the text into tokens; the last one is [`Kind::End`].
pub(super) fn tokens(characters: &[char]) -> Result<Vec<Token>, ExpressionError> {
    if characters.len() > MAX_CHARACTERS {
        let problem = ExpressionProblem::TooLong { characters: characters.len() };
        return Err(ExpressionError { position: MAX_CHARACTERS, problem });
    }
    let mut found = Vec::new();
    let mut start = 0;
    while let Some(&first) = characters.get(start) {
        if first.is_whitespace() {
            start += 1;
            continue;
        }
        let (kind, end) =
            token(characters, start).map_err(|problem| ExpressionError { position: start, problem })?;
        found.push(Token { kind, start, end });
        start = end;
    }
    found.push(Token { kind: Kind::End, start, end: start });
    Ok(found)
}

/// The token that begins at `start`, and where it ends.
fn token(characters: &[char], start: usize) -> Result<(Kind, usize), ExpressionProblem> {
    let first = characters[start];
    let next = characters.get(start + 1).copied().unwrap_or(' ');
    if first.is_ascii_digit() || (first == '.' && next.is_ascii_digit()) {
        return number(characters, start);
    }
    if is_name_start(first) {
        let length =
            characters[start..].iter().take_while(|c| is_name_start(**c) || c.is_ascii_digit()).count();
        return Ok((name(&characters[start..start + length]), start + length));
    }
    if let Some(kind) = pair(first, next) {
        return Ok((kind, start + 2));
    }
    single(first).map(|kind| (kind, start + 1)).ok_or_else(|| unexpected(first, next))
}

fn is_name_start(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

fn name(characters: &[char]) -> Kind {
    let name: String = characters.iter().collect();
    Kind::Name(if name == "\u{3c0}" { "pi".to_owned() } else { name })
}

/// A decimal number: digits, at most one point, at most one exponent. The point of `2.*t` belongs to the operator.
fn number(characters: &[char], start: usize) -> Result<(Kind, usize), ExpressionProblem> {
    let at = |i: usize| characters.get(i).copied().unwrap_or(' ');
    let mut end = start;
    while at(end).is_ascii_digit() || (at(end) == '.' && !matches!(at(end + 1), '*' | '/' | '^')) {
        end += 1;
    }
    if matches!(at(end), 'e' | 'E') {
        let digits = end + 1 + usize::from(matches!(at(end + 1), '+' | '-' | '\u{2212}'));
        if at(digits).is_ascii_digit() {
            end = digits;
            while at(end).is_ascii_digit() {
                end += 1;
            }
        }
    }
    let text: String =
        characters[start..end].iter().map(|c| if *c == '\u{2212}' { '-' } else { *c }).collect();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((Kind::Number(value), end)),
        Ok(_) => {
            Err(ExpressionProblem::Number { text, reason: "too large; the largest number is about 1.8e308" })
        }
        Err(_) => Err(ExpressionProblem::Number { text, reason: "not a number; it has more than one point" }),
    }
}

/// Operators of two characters.
fn pair(first: char, next: char) -> Option<Kind> {
    use Operator::{And, Divide, Equal, GreaterEqual, LessEqual, NotEqual, Or, Power, Times};
    let operator = match (first, next) {
        ('.', '*') => Times,
        ('.', '/') => Divide,
        ('.', '^') => Power,
        ('<', '=') => LessEqual,
        ('>', '=') => GreaterEqual,
        ('=', '=') => Equal,
        ('~' | '!', '=') => NotEqual,
        ('&', '&') => And,
        ('|', '|') => Or,
        _ => return None,
    };
    Some(Kind::Operator(operator))
}

/// Operators and punctuation of one character, with what word processors make of them.
fn single(first: char) -> Option<Kind> {
    use Operator::{And, Divide, Greater, GreaterEqual, Less, LessEqual, Minus, Not};
    use Operator::{NotEqual, Or, Plus, Power, Times};
    let operator = match first {
        '(' => return Some(Kind::Open),
        ')' => return Some(Kind::Close),
        ',' => return Some(Kind::Comma),
        '+' => Plus,
        '-' | '\u{2212}' | '\u{2013}' => Minus,
        '*' | '\u{b7}' | '\u{d7}' | '\u{22c5}' => Times,
        '/' | '\u{f7}' => Divide,
        '^' => Power,
        '<' => Less,
        '>' => Greater,
        '\u{2264}' => LessEqual,
        '\u{2265}' => GreaterEqual,
        '\u{2260}' => NotEqual,
        '&' => And,
        '|' => Or,
        '~' | '!' => Not,
        _ => return None,
    };
    Some(Kind::Operator(operator))
}

fn unexpected(first: char, next: char) -> ExpressionProblem {
    let hint = match first {
        '=' => "; equality is written ==",
        '[' | ']' | '{' | '}' => "; parentheses are written ( ), and only one number is needed here",
        ';' => "; only one expression is needed here",
        '\'' | '"' => "; there is nothing to transpose or quote in a number",
        '\\' => "; division is written /",
        '%' | '#' => "; there are no comments here, and the remainder is mod(x, y)",
        '.' if next.is_whitespace() => "; a number needs digits",
        '\u{b2}' => "; the square is written ^2",
        '\u{b3}' => "; the third power is written ^3",
        '\u{221a}' => "; the root is written sqrt(x)",
        '\u{221e}' => "; only finite numbers are possible",
        _ => "",
    };
    ExpressionProblem::Character { found: first.to_string(), hint }
}
