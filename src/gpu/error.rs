//! What can go wrong on the GPU, as sentences.

/// Every variant reads as one sentence naming kernel, buffer or file, the number and the limit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    #[error("no GPU adapter{wanted}; {found}")]
    NoAdapter { wanted: String, found: String },
    #[error("the GPU \"{adapter}\" gives no device: {cause}")]
    NoDevice { adapter: String, cause: String },
    #[error("buffer \"{label}\" needs {bytes} bytes, more than the {limit} bytes that \"{adapter}\" allows a buffer")]
    BufferTooLarge { label: String, bytes: u64, limit: u64, adapter: String },
    #[error("no memory on the GPU for the {bytes} bytes of \"{label}\": {cause}")]
    OutOfMemory { label: String, bytes: u64, cause: String },
    #[error("{place}: {cause}")]
    Shader { place: String, cause: String },
    #[error("kernel \"{kernel}\", binding \"{binding}\": {cause}")]
    Binding { kernel: String, binding: String, cause: String },
    #[error("kernel \"{kernel}\" cannot run {threads} threads: {cause}")]
    Threads { kernel: String, threads: u64, cause: String },
    #[error(
        "{what} of buffer \"{label}\" is outside its {bytes} bytes or not a multiple of {alignment}: {start}..{end}"
    )]
    Range { what: &'static str, label: String, bytes: u64, alignment: u64, start: u64, end: u64 },
    #[error("the GPU refused {what}: {cause}")]
    Refused { what: String, cause: String },
    #[error("buffer \"{label}\" is read before any stage has made it")]
    Missing { label: String },
    #[error("the GPU was lost: {0}")]
    Lost(String),
}
