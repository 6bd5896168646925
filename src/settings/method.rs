//! How it is computed and shown: voxels, light, cones, view.

use serde::{Deserialize, Serialize};

use super::cone_tracing::ConeTracing;
use super::discretization::Discretization;
use super::lighting::Lighting;
use super::look::Look;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MethodSettings {
    pub discretization: Discretization,
    pub lighting: Lighting,
    pub cone_tracing: ConeTracing,
    pub look: Look,
}

impl MethodSettings {
    pub(super) fn check(&self) -> Result<(), String> {
        self.discretization.check()?;
        self.lighting.check()?;
        self.cone_tracing.check()?;
        self.look.check(self.discretization.depth())
    }
}
