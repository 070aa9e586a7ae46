//! JSON as people read it: one line per matrix row, objects indented.

use serde_json::Value;

/// Writes a value with lists of scalars on one line and everything else indented by two spaces.
pub(super) fn pretty(value: &Value) -> String {
    let mut text = String::new();
    write(value, 0, &mut text);
    text.push('\n');
    text
}

/// Longest line that a short list or object may fill.
const LINE: usize = 110;

fn write(value: &Value, depth: usize, text: &mut String) {
    let one_line = value.to_string();
    let inner = "  ".repeat(depth + 1);
    let outer = "  ".repeat(depth);
    match value {
        Value::Array(items) if !is_flat(items) || one_line.len() > LINE => {
            text.push_str("[\n");
            for (i, item) in items.iter().enumerate() {
                text.push_str(&inner);
                write(item, depth + 1, text);
                text.push_str(if i + 1 < items.len() { ",\n" } else { "\n" });
            }
            text.push_str(&outer);
            text.push(']');
        }
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(Value::to_string).collect();
            text.push('[');
            text.push_str(&items.join(", "));
            text.push(']');
        }
        Value::Object(map) if !map.is_empty() => {
            text.push_str("{\n");
            for (i, (key, item)) in map.iter().enumerate() {
                text.push_str(&inner);
                text.push_str(&Value::from(key.as_str()).to_string());
                text.push_str(": ");
                write(item, depth + 1, text);
                text.push_str(if i + 1 < map.len() { ",\n" } else { "\n" });
            }
            text.push_str(&outer);
            text.push('}');
        }
        Value::Object(_) | Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {
            text.push_str(&one_line);
        }
    }
}

fn is_flat(items: &[Value]) -> bool {
    items.iter().all(|item| !item.is_array() && !item.is_object())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_matrix_is_written_row_by_row() {
        let text = pretty(&json!({"A": [[1, "-1/3"], [0, 2.5]]}));
        assert_eq!(
            text, "{\n  \"A\": [\n    [1, \"-1/3\"],\n    [0, 2.5]\n  ]\n}\n",
            "rows stay on their lines"
        );
        assert_eq!(
            serde_json::from_str::<Value>(&text).unwrap(),
            json!({"A": [[1, "-1/3"], [0, 2.5]]}),
            "still JSON"
        );
    }
}
