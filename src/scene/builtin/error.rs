//! What can go wrong when a scene is made.

/// Why a scene was not made.
#[derive(Debug, thiserror::Error)]
pub enum MakeError {
    #[error("a picture of the scene: {0}")]
    Picture(#[from] image::ImageError),
    #[error("the scene's JSON: {0}")]
    Json(#[from] gltf::json::Error),
    #[error("the scene's file: {0}")]
    File(#[from] gltf::Error),
}
