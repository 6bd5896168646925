// What passes a medium, by the length inside it.

// Share that passes `length` cells of opacity `alpha` a cell.
fn transmittance(alpha: f32, length: f32) -> f32 {
    return select(pow(max(1.0 - alpha, 0.0), length), 0.0, alpha >= 1.0);
}
