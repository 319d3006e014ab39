//! Temporary.
use nalgebra::{DMatrix, DVector};

/// Nodes and weights.
#[derive(Debug, Clone)]
pub struct AxialRule {
    points: Vec<(f64, f64)>,
}

impl AxialRule {
    /// Rule with `nodes` nodes.
    #[must_use]
    pub fn new(inner: f64, outer: f64, length: f64, nodes: usize) -> Self {
        let h = 0.5 * length;
        let reach = outer.hypot(h);
        let moment = |a: f64, j: usize| -> f64 {
            let f = |n: usize| (1..=n).map(|v| v as f64).product::<f64>();
            (0..=j / 2)
                .map(|i| {
                    let s = if i % 2 == 0 { 1.0 } else { -1.0 };
                    let e = (j - 2 * i + 1) as f64;
                    s * f(j) / (f(j - 2 * i) * f(i).powi(2) * 4f64.powi(i as i32))
                        * (2.0 * h.powf(e) / e)
                        * (2.0 * core::f64::consts::PI * a.powi(2 * i as i32 + 2) / (2 * i + 2) as f64)
                })
                .sum()
        };
        let half = nodes / 2;
        let z: Vec<f64> = (0..nodes)
            .map(|k| {
                if nodes == 1 { 0.0 } else { (core::f64::consts::PI * (k as f64) / (nodes - 1) as f64).cos() }
            })
            .collect();
        // symmetric: unknown weights for pairs
        let n = half + nodes % 2;
        let m = DMatrix::from_fn(n, n, |r, c| {
            let p = z[c].powi(2 * r as i32);
            if nodes % 2 == 1 && c == half { if r == 0 { 1.0 } else { 0.0 } } else { 2.0 * p }
        });
        let b = DVector::from_fn(n, |r, _| {
            (moment(outer, 2 * r) - moment(inner, 2 * r)) / reach.powi(2 * r as i32)
        });
        let w = m.lu().solve(&b).unwrap_or(b);
        let points = (0..nodes).map(|k| (z[k] * reach, w[k.min(nodes - 1 - k)])).collect();
        Self { points }
    }
    /// Points.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.points.iter().copied()
    }
}
