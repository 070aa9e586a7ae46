//! Networks in documents: reading and writing.

use serde_json::{Value, json};

use super::DocumentError;
use super::cursor::Cursor;
use super::entry::{EntryMatrix, number};
use super::limits::{MAX_SPARSE_ENTRIES, MAX_SUBSYSTEMS};
use super::model::{Coupling, NetworkData};
use super::read::at_matrix;

pub(super) fn read_network(cursor: &Cursor<'_>) -> Result<NetworkData, DocumentError> {
    let object = cursor.object(&["a", "b", "c", "c_G", "c_L", "Gamma", "Psi", "local"])?;
    let dense = |key| EntryMatrix::read(&object.need(key, "this matrix of the network is needed")?);
    let coupling = |key| read_coupling(&object.need(key, "this matrix of the network is needed")?);
    let mut data = NetworkData {
        a: dense("a")?,
        b: dense("b")?,
        c: dense("c")?,
        c_G: dense("c_G")?,
        c_L: dense("c_L")?,
        Gamma: coupling("Gamma")?,
        Psi: coupling("Psi")?,
        local: Vec::new(),
    };
    let big = data.Gamma.shape().0;
    if let Some(local) = object.get("local") {
        for item in local.list(MAX_SUBSYSTEMS, "subsystem numbers")? {
            let number = usize::try_from(item.whole_in(1, big as u64)?).unwrap_or(usize::MAX);
            if data.local.contains(&number) {
                return Err(
                    item.error("each subsystem with local measurements stands once in the list".to_owned())
                );
            }
            data.local.push(number);
        }
    }
    data.network().map_err(|error| at_matrix(cursor.path(), &error))?;
    Ok(data)
}

fn read_coupling(cursor: &Cursor<'_>) -> Result<Coupling, DocumentError> {
    if cursor.is_list() {
        return EntryMatrix::read(cursor).map(Coupling::Dense);
    }
    let object = cursor.object(&["rows", "columns", "entries"])?;
    let side = |key| -> Result<u64, DocumentError> {
        object.need(key, "rows, columns and entries are needed")?.whole_in(1, MAX_SUBSYSTEMS as u64)
    };
    let (rows, columns) = (side("rows")?, side("columns")?);
    let list = object.need("entries", "a list of [row, column, value] is needed")?;
    let mut entries = Vec::new();
    for item in list.list(MAX_SPARSE_ENTRIES, "entries")? {
        let parts = item.list(3, "numbers")?;
        let [row, column, value] = parts.as_slice() else {
            return Err(item.error("three numbers are needed: [row, column, value]"));
        };
        let index = |cursor: &Cursor<'_>, limit| {
            cursor.whole_in(1, limit).map(|i| usize::try_from(i).unwrap_or(usize::MAX))
        };
        entries.push((index(row, rows)?, index(column, columns)?, value.number()?));
    }
    let size = |n| usize::try_from(n).unwrap_or(usize::MAX);
    Ok(Coupling::Sparse { rows: size(rows), columns: size(columns), entries })
}

pub(super) fn network_value(data: &NetworkData) -> Value {
    json!({
        "a": data.a.write(), "b": data.b.write(), "c": data.c.write(),
        "c_G": data.c_G.write(), "c_L": data.c_L.write(),
        "Gamma": coupling_value(&data.Gamma), "Psi": coupling_value(&data.Psi), "local": data.local,
    })
}

fn coupling_value(coupling: &Coupling) -> Value {
    match coupling {
        Coupling::Dense(matrix) => matrix.write(),
        Coupling::Sparse { rows, columns, entries } => {
            let entries: Vec<Value> =
                entries.iter().map(|(i, j, value)| json!([i, j, number(*value)])).collect();
            json!({ "rows": rows, "columns": columns, "entries": entries })
        }
    }
}
