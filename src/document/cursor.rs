//! Reading JSON with a path, so that every error names its place.

use serde_json::{Map, Value};

use super::DocumentError;
use super::duplicates::Unambiguous;
use super::limits::{MAX_BYTES, MAX_TEXT};

/// A value and the path that leads to it.
#[derive(Clone, Debug)]
pub(super) struct Cursor<'a> {
    path: String,
    value: &'a Value,
}

/// An object whose keys are taken one by one; keys that nobody asked for are errors.
#[derive(Debug)]
pub(super) struct Object<'a> {
    path: String,
    map: &'a Map<String, Value>,
    known: &'static [&'static str],
}

/// Parses text of bounded size.
pub(super) fn parse(text: &str) -> Result<Value, DocumentError> {
    if text.len() > MAX_BYTES {
        return Err(DocumentError::TooLarge { found: text.len(), limit: MAX_BYTES });
    }
    let message =
        |error: &serde_json::Error| error.to_string().split(" at line").next().unwrap_or_default().to_owned();
    let value = serde_json::from_str(text).map_err(|error| DocumentError::NotJson {
        message: message(&error),
        line: error.line(),
        column: error.column(),
    })?;
    serde_json::from_str::<Unambiguous>(text).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        DocumentError::at(
            &place,
            message(&error),
            "a key may stand only once in an object; remove one of them",
        )
    })?;
    Ok(value)
}

/// A short description of what stands somewhere.
fn describe(value: &Value) -> String {
    match value {
        Value::Null => "nothing (null)".to_owned(),
        Value::Bool(b) => format!("`{b}`"),
        Value::Number(n) => format!("the number {n}"),
        Value::String(s) => {
            let short: String = s.chars().take(40).collect();
            format!("the text \"{short}{}\"", if s.chars().count() > 40 { "..." } else { "" })
        }
        Value::Array(items) => format!("a list of {}", items.len()),
        Value::Object(map) => format!("an object with {} keys", map.len()),
    }
}

impl<'a> Cursor<'a> {
    pub(super) fn root(value: &'a Value) -> Self {
        Self { path: String::new(), value }
    }

    pub(super) fn path(&self) -> &str {
        if self.path.is_empty() { "the document" } else { &self.path }
    }

    pub(super) fn error(&self, needed: impl Into<String>) -> DocumentError {
        DocumentError::at(self.path(), describe(self.value), needed)
    }

    pub(super) fn object(&self, known: &'static [&'static str]) -> Result<Object<'a>, DocumentError> {
        let Value::Object(map) = self.value else {
            return Err(self.error(format!("an object is needed here, with the keys {}", known.join(", "))));
        };
        if let Some(key) = map.keys().find(|key| !known.contains(&key.as_str())) {
            let short: String = key.chars().take(40).collect();
            let hint = super::nearest(&short, known)
                .map_or(String::new(), |near| format!("; did you mean \"{near}\"?"));
            return Err(DocumentError::at(
                self.path(),
                format!("the unknown key \"{short}\""),
                format!("the keys here are {}{hint}", known.join(", ")),
            ));
        }
        Ok(Object { path: self.path.clone(), map, known })
    }

    /// Items of a list with at most `limit` of them; places are numbered from one.
    pub(super) fn list(&self, limit: usize, of: &str) -> Result<Vec<Self>, DocumentError> {
        let Value::Array(items) = self.value else {
            return Err(self.error(format!("a list of {of} is needed here")));
        };
        if items.len() > limit {
            return Err(self.error(format!("at most {limit} {of} are allowed here")));
        }
        let item = |(i, value)| Self { path: format!("{}[{}]", self.path, i + 1), value };
        Ok(items.iter().enumerate().map(item).collect())
    }

    pub(super) fn text(&self) -> Result<&'a str, DocumentError> {
        match self.value {
            Value::String(text) if text.len() <= MAX_TEXT => Ok(text),
            Value::String(text) => Err(DocumentError::at(
                self.path(),
                format!("a text of {} bytes", text.len()),
                format!("at most {MAX_TEXT} are allowed"),
            )),
            _ => Err(self.error("a text in quotes is needed here")),
        }
    }

    pub(super) fn number(&self) -> Result<f64, DocumentError> {
        let number = self.value.as_f64().filter(|x| x.is_finite());
        number.ok_or_else(|| self.error("a finite number is needed here"))
    }

    /// A number within bounds, both included.
    pub(super) fn number_in(&self, low: f64, high: f64) -> Result<f64, DocumentError> {
        let number = self.number()?;
        if (low..=high).contains(&number) {
            return Ok(number);
        }
        Err(self.error(format!("a number from {low} to {high} is needed here")))
    }

    /// `true` or `false`.
    pub(super) fn truth(&self) -> Result<bool, DocumentError> {
        self.value.as_bool().ok_or_else(|| self.error("true or false is needed here"))
    }

    /// A whole number within bounds, both included.
    pub(super) fn whole_in(&self, low: u64, high: u64) -> Result<u64, DocumentError> {
        let number = self.value.as_u64().filter(|n| (low..=high).contains(n));
        number.ok_or_else(|| self.error(format!("a whole number from {low} to {high} is needed here")))
    }

    pub(super) fn is_text(&self) -> bool {
        self.value.is_string()
    }

    pub(super) fn is_list(&self) -> bool {
        self.value.is_array()
    }

    pub(super) fn is_number(&self) -> bool {
        self.value.is_number()
    }

    pub(super) fn renamed(mut self, path: String) -> Self {
        self.path = path;
        self
    }

    /// One of a fixed list of words.
    pub(super) fn word<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, DocumentError> {
        let known = || words.iter().map(|(word, _)| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
        let text = self.value.as_str().unwrap_or_default();
        let found = words.iter().find(|(word, _)| *word == text);
        found.map(|(_, value)| *value).ok_or_else(|| self.error(format!("one of {} is needed here", known())))
    }
}

impl<'a> Object<'a> {
    /// The value of a key; `null` counts as absent.
    pub(super) fn get(&self, key: &'static str) -> Option<Cursor<'a>> {
        debug_assert!(self.known.contains(&key), "a key that is read must be declared as known");
        let path = if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) };
        self.map.get(key).filter(|value| !value.is_null()).map(|value| Cursor { path, value })
    }

    pub(super) fn need(&self, key: &'static str, why: &str) -> Result<Cursor<'a>, DocumentError> {
        let place = if self.path.is_empty() { "the document" } else { &self.path };
        self.get(key).ok_or_else(|| DocumentError::at(place, format!("no key \"{key}\""), why))
    }
}
