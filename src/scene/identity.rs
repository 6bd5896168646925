//! Which scene it is, so that what is saved of it tells what it was made from.

use serde::{Deserialize, Serialize};

use super::Scene;
use crate::digest::Digest;

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneIdentity {
    /// The file's path as it was opened, or a built-in scene's name.
    pub source: String,
    /// [`Scene::digest`].
    pub digest: Option<Digest>,
}

impl Scene {
    pub fn identity(&self) -> SceneIdentity {
        let path = self.source.as_ref().map(|path| path.display().to_string());
        SceneIdentity { source: path.unwrap_or_else(|| self.name.clone()), digest: self.digest }
    }
}
