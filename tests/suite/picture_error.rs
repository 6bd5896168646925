//! Errors of pictures against closed forms, and maps of them.

use octolume::accuracy::picture_error::{
    CompareError, Display, LightPixel, PictureError, compare, difference_color, difference_map, difference_scale,
};
use octolume::settings::{Look, SurfaceView, ToneCurve};

const SIZE_PX: [u32; 2] = [32, 24];
const PIXELS: usize = 32 * 24;

fn shown(truth: &[LightPixel]) -> Display {
    Display::new(&Look::default(), SurfaceView::Final, truth)
}

/// Bright stripes, darker to the right.
fn stripes(factor: f32) -> Vec<LightPixel> {
    let pixel = |index: usize| {
        let (x, y) = (index % 32, index / 32);
        let light = factor * (if y % 6 < 3 { 1.0 } else { 0.2 }) / (1.0 + x as f32 / 8.0);
        [light, 0.5 * light, 0.25 * light, 1.0]
    };
    (0..PIXELS).map(pixel).collect()
}

fn error(found: &[LightPixel], truth: &[LightPixel]) -> PictureError {
    compare(found, truth, SIZE_PX, &shown(truth)).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_picture_is_like_itself() {
    let picture = stripes(3.0);
    let PictureError { rel_mse, bias, ssim, flip } = error(&picture, &picture);
    assert_eq!((rel_mse, bias), (0.0, 0.0));
    assert!((ssim - 1.0).abs() < 1e-6, "{ssim}");
    assert_eq!(flip, cfg!(feature = "flip").then_some(0.0));
}

#[test]
fn flat_pictures_have_closed_forms() {
    let [truth, found] = [2.0_f32, 2.5].map(|light| vec![[light, light, light, 1.0]; PIXELS]);
    let error = error(&found, &truth);
    // 0.5² / (2² + 0.2²).
    assert!((error.rel_mse - 0.25 / 4.04).abs() < 1e-12, "{}", error.rel_mse);
    assert!((error.bias - 0.25).abs() < 1e-12, "{}", error.bias);
    // Without structure only means are left: (2ab + c)/(a² + b² + c) with c = (0.01 · 255)².
    let shown = shown(&truth);
    let [a, b] = [&truth, &found].map(|light| f64::from(shown.bytes(&light[0])[0]));
    let c = (0.01_f64 * 255.0).powi(2);
    assert!((error.ssim - (2.0 * a * b + c) / (a * a + b * b + c)).abs() < 1e-4, "{}", error.ssim);
}

#[test]
fn errors_know_no_unit() {
    let dim = error(&stripes(1.3), &stripes(1.0));
    let bright = error(&stripes(1.3e5), &stripes(1e5));
    assert!((dim.rel_mse - bright.rel_mse).abs() < 1e-6 && (dim.bias - bright.bias).abs() < 1e-6);
    assert!((dim.ssim - bright.ssim).abs() < 1e-3, "{} {}", dim.ssim, bright.ssim);
    assert!((dim.bias - 0.3).abs() < 1e-6, "{}", dim.bias);
}

#[cfg(feature = "flip")]
#[test]
fn flip_grows_with_what_an_eye_sees() {
    let truth = stripes(1.0);
    let flips = [1.02, 1.2, 2.0, 8.0].map(|factor| error(&stripes(factor), &truth).flip.expect("is built in"));
    assert!(flips.is_sorted() && flips[0] < 0.05 && flips[3] > 0.2, "{flips:?}");
    let [black, white] = [0.0_f32, 1e6].map(|light| vec![[light, light, light, 1.0]; PIXELS]);
    let worst = compare(&white, &black, SIZE_PX, &Display { exposure: 1.0, curve: ToneCurve::Linear });
    assert!(worst.expect("same sizes").flip.expect("is built in") > 0.9);
}

#[test]
fn light_where_the_truth_has_no_surface_does_not_count() {
    let truth: Vec<LightPixel> = stripes(1.0).into_iter().map(|[r, g, b, _]| [r, g, b, 0.0]).collect();
    let found = error(&stripes(2.0), &truth);
    assert_eq!((found.rel_mse, found.bias), (0.0, 0.0));
    let half: Vec<LightPixel> =
        (0..).zip(stripes(1.0)).map(|(index, [r, g, b, _])| [r, g, b, f32::from(u8::from(index % 2 == 0))]).collect();
    assert!((error(&stripes(2.0), &half).bias - 1.0).abs() < 1e-6);
}

#[test]
fn pictures_of_any_size_are_compared_and_of_different_ones_refused() {
    for size_px in [[1, 1], [3, 2], [7, 9], [8, 8]] {
        let picture = vec![[0.5, 0.5, 0.5, 1.0]; (size_px[0] * size_px[1]) as usize];
        let error = compare(&picture, &picture, size_px, &shown(&picture)).expect("same sizes");
        assert_eq!(error.rel_mse, 0.0, "{size_px:?}");
        assert!(error.ssim.is_finite() && error.flip.is_none_or(f64::is_finite), "{size_px:?}: {error:?}");
    }
    let error = compare(&stripes(1.0), &stripes(1.0)[1..], SIZE_PX, &shown(&[])).expect_err("one is shorter");
    assert_eq!(error, CompareError::Sizes { found: PIXELS, truth: PIXELS - 1, size_px: SIZE_PX });
    assert!(error.to_string().contains("768 and 767 pixels"), "{error}");
}

#[test]
fn exposure_is_that_of_the_settings_or_what_the_picture_asks_for() {
    let picture = vec![[0.36, 0.36, 0.36, 1.0]; 4];
    let mean = Display::of_mean(&Look::default(), SurfaceView::Final, &picture);
    assert!((mean.exposure - 0.5).abs() < 1e-6, "{mean:?}");
    // As bright as 0.8, within a bin of luminances: a sixteenth.
    let shown_as = shown(&picture).exposure * 0.36;
    assert!((shown_as / 0.8 - 1.0).abs() <= 1.0 / 16.0, "{shown_as}");
    let look = Look { exposure_stops: Some(3.0), tone_curve: ToneCurve::Linear, ..Look::default() };
    let fixed = Display::new(&look, SurfaceView::Diffuse, &picture);
    assert_eq!(fixed, Display { exposure: 8.0, curve: ToneCurve::Linear });
    assert_eq!(fixed.bytes(&[1.0, 0.0, -1.0, 1.0]), [255, 0, 0]);
    let plain = Display { exposure: 1.0, curve: ToneCurve::Linear };
    assert_eq!(Display::new(&look, SurfaceView::Ao, &picture), plain);
    assert_eq!(Display::new(&Look::default(), SurfaceView::Final, &[[0.0; 4]; 4]).exposure, 1.0);
}

#[test]
fn a_map_is_red_where_too_bright_and_blue_where_too_dark() {
    let truth = vec![[1.0, 1.0, 1.0, 1.0]; 3];
    let found = [0.2_f32, 1.0, 1.8].map(|light| [light, light, light, 1.0]);
    let scale = difference_scale(&truth);
    assert!((scale - 1.0).abs() < 1e-6);
    let map = difference_map(&found, &truth, [3, 1], scale);
    let [dark, same, bright] = [0, 1, 2].map(|x| map.get_pixel(x, 0).0);
    assert!(dark[2] > dark[0] && bright[0] > bright[2], "{dark:?} {bright:?}");
    assert_eq!(same[..3], difference_color(0.0));
    assert!(same[..3].iter().all(|channel| *channel > 230), "{same:?}");
}
