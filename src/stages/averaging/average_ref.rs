//! Reference of `average.wgsl`: a node from its children (section 4.1), in f64 and exact integers.
//!
//! In: occupancy (2^3k a full leaf), albedo's code and biased normal of each child. Out: Σ occupancy, and
//! the means weighted by it, unrounded, that of albedo as its code; exactly zero where nothing is below.

/// An inner node, before quantisation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// Σ over the leaves below.
    pub occupancy: u128,
    /// Codes: 0 … 1020.
    pub albedo: [f64; 3],
    /// 0 … 1022: biased by 511.
    pub normal: [f64; 3],
}

pub fn average(children: &[Node]) -> Node {
    let occupancy: u128 = children.iter().map(|child| child.occupancy).sum();
    if occupancy == 0 {
        return Node::default();
    }
    let mean = |value: &dyn Fn(&Node) -> [f64; 3]| {
        [0, 1, 2].map(|axis| {
            let sum: f64 = children.iter().map(|child| child.occupancy as f64 * value(child)[axis]).sum();
            sum / occupancy as f64
        })
    };
    let albedo = mean(&|child| child.albedo.map(|code| code * code)).map(f64::sqrt);
    Node { occupancy, albedo, normal: mean(&|child| child.normal) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_to_one() {
        let a = Node { occupancy: 3, albedo: [5.0, 0.0, 0.0], normal: [511.0, 511.0, 1022.0] };
        let b = Node { occupancy: 1, albedo: [11.0, 1020.0, 0.0], normal: [511.0, 511.0, 0.0] };
        let mean = average(&[a, Node::default(), b]);
        assert_eq!(mean, Node { occupancy: 4, albedo: [7.0, 510.0, 0.0], normal: [511.0, 511.0, 766.5] });
        assert_eq!(average(&[Node::default(); 8]), Node::default());
    }
}
