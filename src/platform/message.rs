//! Messages between the page and its worker, as bytes; the only file that names `postcard`.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::session::JobReply;

/// What a worker tells the page; the page sends it [`crate::session::JobRequest`]s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FromWorker {
    /// A reply, with the duration in milliseconds when it is the last one of its request.
    Reply {
        /// The reply.
        reply: JobReply,
        /// How long the computation took.
        elapsed_ms: Option<f64>,
    },
    /// The worker stopped at an internal error and is of no more use.
    Crashed(String),
}

/// A message that is not understood.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a message between page and worker is not understood ({0}); load the page again")]
pub struct MessageError(String);

/// A message as bytes.
///
/// # Errors
/// When the value has a form that the format lacks, which a test excludes for the messages of this program.
pub fn encode<T: Serialize>(message: &T) -> Result<Vec<u8>, MessageError> {
    postcard::to_allocvec(message).map_err(|error| MessageError(error.to_string()))
}

/// Bytes as a message.
///
/// # Errors
/// When they are not one.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, MessageError> {
    postcard::from_bytes(bytes).map_err(|error| MessageError(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::Watch;
    use crate::paper::EXAMPLES;
    use crate::session::{JobRequest, Task, perform};

    #[test]
    fn requests_and_replies_of_every_example_pass_through() {
        for example in EXAMPLES {
            for task in [Task::Analyse, Task::Compare, Task::Figure { id: "none".to_owned() }] {
                let request = JobRequest { id: 7, revision: 3, document: example.text.to_owned(), task };
                let back: JobRequest = decode(&encode(&request).unwrap()).unwrap();
                assert_eq!(back, request, "{}: the request", example.key);
                let reply = perform(&request, &Watch::none()).unwrap();
                let sent = FromWorker::Reply { reply, elapsed_ms: Some(1.5) };
                let bytes = encode(&sent).unwrap();
                let back: FromWorker = decode(&bytes).unwrap();
                // not a number is not equal to itself: the bytes are compared
                assert_eq!(encode(&back).unwrap(), bytes, "{}: the reply", example.key);
            }
        }
    }

    #[test]
    fn garbage_is_refused() {
        assert!(decode::<FromWorker>(&[9, 9, 9]).is_err(), "no such message");
        assert!(decode::<JobRequest>(&[]).is_err(), "an empty message");
    }
}
