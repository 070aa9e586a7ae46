//! A document in the fragment of an address: compact text, deflated, in the alphabet of URLs.

use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;

use super::limits::MAX_BYTES;
use super::{Document, DocumentError, read_document, write_document_compact};

/// What every link begins with; the digit is the version of the packing.
const PREFIX: &str = "#d1=";

/// Letters of the longest link that is unpacked: what cannot be packed at all still fits.
const MAX_LETTERS: usize = MAX_BYTES / 3 * 4 + 1024;

/// Why a link holds no document.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// Another beginning.
    #[error("the address holds no document: a link begins with {PREFIX}")]
    Prefix,
    /// Letters are missing, or others came in.
    #[error("the link is damaged or was cut off: copy it again, from its beginning to its end")]
    Damaged,
    /// It unpacks to more than a document may have.
    #[error("the link unpacks to more than {MAX_BYTES} bytes, which is more than a document may have")]
    TooLarge,
    /// What it holds is not a document.
    #[error("{0}")]
    Document(#[from] DocumentError),
}

/// The fragment of an address that holds the document, with its `#`.
pub fn to_link_fragment(document: &Document) -> String {
    /// Best compression.
    const LEVEL: u8 = 9;
    let packed = compress_to_vec(write_document_compact(document).as_bytes(), LEVEL);
    format!("{PREFIX}{}", URL_SAFE_NO_PAD.encode(packed))
}

/// Whether a fragment means to be a link to a document.
pub fn is_link_fragment(fragment: &str) -> bool {
    fragment.starts_with(PREFIX)
}

/// The document that a fragment (with its `#`) holds.
///
/// # Errors
/// [`LinkError`], in words for the person who got the link.
pub fn from_link_fragment(fragment: &str) -> Result<Document, LinkError> {
    let letters = fragment.strip_prefix(PREFIX).ok_or(LinkError::Prefix)?;
    if letters.len() > MAX_LETTERS {
        return Err(LinkError::TooLarge);
    }
    let packed = URL_SAFE_NO_PAD.decode(letters).map_err(|_| LinkError::Damaged)?;
    let bytes = decompress_to_vec_with_limit(&packed, MAX_BYTES).map_err(|error| match error.status {
        miniz_oxide::inflate::TINFLStatus::HasMoreOutput => LinkError::TooLarge,
        _ => LinkError::Damaged,
    })?;
    let text = String::from_utf8(bytes).map_err(|_| LinkError::Damaged)?;
    Ok(read_document(&text)?)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::paper::EXAMPLES;

    fn first() -> Document {
        read_document(EXAMPLES[0].text).unwrap()
    }

    fn packed(bytes: &[u8]) -> String {
        format!("{PREFIX}{}", URL_SAFE_NO_PAD.encode(compress_to_vec(bytes, 9)))
    }

    #[test]
    fn every_example_comes_back_from_its_link() {
        for example in EXAMPLES {
            let document = read_document(example.text).unwrap();
            let link = to_link_fragment(&document);
            assert_eq!(from_link_fragment(&link).unwrap(), document, "{}", example.key);
            assert!(is_link_fragment(&link), "{}: it is recognised", example.key);
            let plain = link[1..].chars().all(|c| c.is_ascii_alphanumeric() || "-_=".contains(c));
            assert!(plain, "{}: every letter survives in an address", example.key);
            // the ring lists two thousand couplings; browsers take addresses of 64 thousand letters
            let most = if example.key == "network-ring" { 16_000 } else { 4000 };
            assert!(link.len() < most, "{}: {} letters", example.key, link.len());
        }
    }

    #[test]
    fn wrong_links_say_what_is_wrong() {
        let link = to_link_fragment(&first());
        assert_eq!(from_link_fragment("#d2=abc"), Err(LinkError::Prefix), "another version");
        assert_eq!(from_link_fragment(""), Err(LinkError::Prefix), "nothing");
        assert_eq!(from_link_fragment(&link[..link.len() / 2]), Err(LinkError::Damaged), "cut off");
        assert_eq!(from_link_fragment(&format!("{link}%")), Err(LinkError::Damaged), "a foreign letter");
        assert_eq!(from_link_fragment("#d1=AAAA"), Err(LinkError::Damaged), "no deflate stream");
        assert_eq!(from_link_fragment(&packed(&[0xff, 0xfe])), Err(LinkError::Damaged), "no text");
        assert!(matches!(from_link_fragment(&packed(b"{}")), Err(LinkError::Document(_))), "no document");
    }

    #[test]
    fn a_bomb_is_not_unpacked() {
        let bomb = packed(&vec![b' '; 40 * MAX_BYTES]);
        assert!(bomb.len() < 400_000, "it is small: {} letters", bomb.len());
        assert_eq!(from_link_fragment(&bomb), Err(LinkError::TooLarge), "stopped at the limit");
        let long = format!("{PREFIX}{}", "A".repeat(MAX_LETTERS + 1));
        assert_eq!(from_link_fragment(&long), Err(LinkError::TooLarge), "not even decoded");
    }

    proptest! {
        #[test]
        fn no_link_makes_it_panic(text in ".{0,200}", bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let tried = [
                text.clone(),
                format!("{PREFIX}{text}"),
                format!("{PREFIX}{}", URL_SAFE_NO_PAD.encode(&bytes)),
                packed(&bytes),
            ];
            for link in tried {
                prop_assert!(from_link_fragment(&link).is_err(), "chance writes no document");
            }
        }

        #[test]
        fn a_changed_letter_never_panics(at in 4_usize..900, letter in "[A-Za-z0-9_-]") {
            let mut link = to_link_fragment(&first());
            let at = at.min(link.len() - 1);
            link.replace_range(at..=at, &letter);
            // it may still be a document: deflate has no checksum
            if let Ok(document) = from_link_fragment(&link) {
                prop_assert_eq!(from_link_fragment(&to_link_fragment(&document)).unwrap(), document);
            }
        }
    }
}
