//! How numbers are written. What rounds to nothing has no sign, here and in every control.

/// So many decimals.
pub fn fixed(value: f64, decimals: usize) -> String {
    unsigned_zero(format!("{value:.decimals$}"))
}

/// The same with its sign, "+1.0"; nothing has none.
pub fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{value:+.decimals$}");
    if is_zero(&text) { text[1..].to_owned() } else { text }
}

/// Three significant digits of milliseconds.
pub fn milliseconds(ms: f64) -> String {
    match ms {
        ms if ms < 10.0 => fixed(ms, 2),
        ms if ms < 100.0 => fixed(ms, 1),
        ms => fixed(ms, 0),
    }
}

/// Three significant digits, with a power of ten where there would be many zeros.
pub fn short(value: f64) -> String {
    let power = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if (-3..6).contains(&power) {
        let text = fixed(value, (2 - power).clamp(0, 6) as usize);
        let is_decimal = text.contains('.');
        return if is_decimal { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text };
    }
    let text = format!("{value:.2e}");
    match text.split_once('e') {
        Some((digits, power)) => format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.')),
        None => text,
    }
}

/// As much of a time as a person needs to wait by.
pub fn duration(secs: f64) -> String {
    let minutes = (secs / 60.0).round();
    match secs {
        secs if secs < 59.5 => format!("{} s", fixed(secs, 0)),
        secs if secs < 59.5 * 60.0 => format!("{} min", fixed(minutes, 0)),
        _ => format!("{} h {} min", fixed((minutes / 60.0).floor(), 0), fixed(minutes % 60.0, 0)),
    }
}

/// As egui writes a number that is edited, by as few decimals as show it.
pub fn edited(value: f64, decimals: std::ops::RangeInclusive<usize>) -> String {
    unsigned_zero(egui::emath::format_with_decimals_in_range(value, decimals))
}

fn unsigned_zero(text: String) -> String {
    if text.starts_with('-') && is_zero(&text) { text[1..].to_owned() } else { text }
}

/// No digit of it is other than 0, and it is a number.
fn is_zero(text: &str) -> bool {
    text.contains('0') && text.chars().all(|letter| matches!(letter, '0' | '.' | '+' | '-'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_has_no_sign() {
        // The sum of no times at all is -0.0.
        let nothing: f64 = std::iter::empty::<f64>().sum();
        assert_eq!((milliseconds(nothing), milliseconds(-0.001)), ("0.00".to_owned(), "0.00".to_owned()));
        assert_eq!([fixed(-0.04, 1), fixed(-0.06, 1), fixed(-0.0, 0)], ["0.0", "-0.1", "0"]);
        assert_eq!(
            [signed(-0.04, 1), signed(0.04, 1), signed(-1.0, 1), signed(1.0, 1)],
            ["0.0", "0.0", "-1.0", "+1.0"]
        );
        assert_eq!([short(-0.0), short(-1.5), short(-2e-9), short(0.0)], ["0", "-1.5", "-2e-9", "0"]);
        assert_eq!([edited(-0.001, 0..=2), edited(-0.5, 0..=2)], ["0.00", "-0.5"]);
        assert_eq!([fixed(f64::NAN, 1), fixed(f64::NEG_INFINITY, 1)], ["NaN", "-inf"]);
    }

    #[test]
    fn times_have_three_digits() {
        assert_eq!([1.234, 12.34, 123.4].map(milliseconds), ["1.23", "12.3", "123"]);
        let left = [0.2, 12.0, 59.7, 200.0, 3_598.0, 5_000.0].map(duration);
        assert_eq!(left, ["0 s", "12 s", "1 min", "3 min", "1 h 0 min", "1 h 23 min"]);
    }
}
