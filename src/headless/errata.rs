//! `errata`: misprints, omissions and mistakes of the papers.

use super::{Answer, Refusal};
use crate::document::nearest;
use crate::document::report::errata_report;
use crate::paper::{Erratum, errata, papers_with_errata};

/// Lists those of one paper, or of all.
pub(super) fn list(paper: Option<&str>) -> Result<Answer, Refusal> {
    let papers = papers_with_errata();
    if let Some(unknown) = paper.filter(|paper| !papers.contains(paper)) {
        let hint =
            nearest(unknown, &papers).map_or(String::new(), |near| format!("; did you mean \"{near}\"?"));
        return Err(Refusal::bad_input(format!(
            "there is no paper \"{unknown}\": the keys are {}{hint}",
            papers.join(", ")
        )));
    }
    let chosen = papers.into_iter().filter(|key| paper.is_none_or(|paper| paper == *key));
    let found: Vec<&Erratum> = chosen.flat_map(errata).collect();
    Ok(Answer { text: errata_report(&found), ..Answer::default() })
}
