//! Reference of `average_light.wgsl`: a node's light and opacity from its children, in f64.
//!
//! In: eight children (x + 2y + 4z), empty ones zero. Light times opacity is their mean, and so is
//! opacity: the occupied share. Along an axis, what a child lets through meets the one behind it; four
//! such columns cover the node.

/// Light times opacity, opacity as a share of volume, and opacity along x, y, z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lit {
    pub light: [f64; 3],
    pub opacity: f64,
    pub along: [f64; 3],
}

impl Lit {
    /// A leaf stops the same along every axis.
    pub fn leaf(light: [f64; 3], opacity: f64) -> Self {
        Self { light: light.map(|channel| channel * opacity), opacity, along: [opacity; 3] }
    }
}

pub fn average(children: &[Lit; 8]) -> Lit {
    let mean = |value: &dyn Fn(&Lit) -> f64| children.iter().map(value).sum::<f64>() / 8.0;
    let along = |axis: usize| {
        let columns = (0..8).filter(|child| child >> axis & 1 == 0);
        let through = |child: usize| 1.0 - children[child].along[axis];
        columns.map(|child| 1.0 - through(child) * through(child | 1 << axis)).sum::<f64>() / 4.0
    };
    Lit {
        light: [0, 1, 2].map(|channel| mean(&|child| child.light[channel])),
        opacity: mean(&|child| child.opacity),
        along: [0, 1, 2].map(along),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_stays_a_wall_across_and_is_half_open_along() {
        // Children with x = 0 are full.
        let wall = std::array::from_fn(|child| if child & 1 == 0 { Lit::leaf([2.0; 3], 1.0) } else { Lit::default() });
        let node = average(&wall);
        assert_eq!((node.opacity, node.along), (0.5, [1.0, 0.5, 0.5]));
        assert_eq!(node.light, [1.0; 3], "of mean radiance 2");
    }

    #[test]
    fn a_homogeneous_node_stops_what_its_length_does() {
        let node = average(&[Lit::leaf([1.0; 3], 0.25); 8]);
        assert_eq!(node.along, [1.0 - 0.75 * 0.75; 3]);
        assert_eq!(node.opacity, 0.25);
    }
}
