//! Lights from the command line: edits by name, lights of our own, and what `info` tells of them.

use std::fs;

use serde_json::{Value, json};

use crate::scenes::Scenes;
use crate::{json, octolume, on_small_grid, succeed};

/// What `info` tells of the courtyard's lights.
fn lights(options: &[&str]) -> Vec<Value> {
    let info = json(["info", "courtyard", "--json"].iter().chain(options));
    info["lights"].as_array().expect("a list").clone()
}

/// The one of this name and source.
fn light(lights: &[Value], source: &str, name: &str) -> Value {
    let called: Vec<&Value> =
        lights.iter().filter(|light| light["name"] == name && light["source"] == source).collect();
    assert_eq!(called.len(), 1, "{name}: {lights:?}");
    called[0].clone()
}

#[test]
fn info_tells_of_every_light() {
    let all = lights(&[]);
    let sun = light(&all, "scene", "sun");
    assert_eq!((&sun["kind"], &sun["unit"], &sun["shines"]), (&json!("directional"), &json!("lux"), &json!(true)));
    assert_eq!((&sun["cause"], &sun["edited"], &sun["node"]), (&json!(null), &json!(false), &json!("sun")));
    let own = light(&all, "sun", "sun");
    assert_eq!((&own["shines"], &own["cause"]), (&json!(false), &json!("off")));
    let text = succeed(["info", "courtyard", "--sun", "500", "--light", "sun:off"]);
    assert!(text.contains("own sun: directional, 500 lux of 1.000,0.960,0.900, on\n"), "{text}");
    assert!(text.contains("light \"sun\": directional, ") && text.contains(", off, changed\n"), "{text}");
}

#[test]
fn lights_are_changed_by_name_and_added() {
    let all = lights(&[
        "--light",
        "sun:lux=250:color=1,0.5,0",
        "--add-light",
        "spot:at=0,3,0:to=0,-1,0:candela=40:range=9:inner=10:outer=30:name=torch",
        "--add-light",
        "point:at=0,1,0",
        "--hide",
        "walls",
    ]);
    let sun = light(&all, "scene", "sun");
    assert_eq!((&sun["intensity"], &sun["color"]), (&json!(250.0), &json!([1.0, 0.5, 0.0])));
    assert_eq!(sun["edited"], true);
    let torch = light(&all, "added", "torch");
    assert_eq!((&torch["kind"], &torch["intensity"], &torch["range"]), (&json!("spot"), &json!(40.0), &json!(9.0)));
    // They are kept as radians, 24 bits each.
    for (told, given) in torch["cone_degrees"].as_array().expect("two angles").iter().zip([10.0, 30.0]) {
        let error = told.as_f64().expect("a number") - given;
        assert!(error.abs() <= given * f64::from(f32::EPSILON), "{told} for {given}");
    }
    assert_eq!(light(&all, "added", "light 1")["unit"], "candela");
    let hidden = lights(&["--hide", "sun"]);
    assert_eq!(light(&hidden, "scene", "sun")["cause"], "its node is hidden");
}

#[test]
fn our_own_sun_is_set_by_direction_or_illuminance() {
    for options in [&["--light-dir", "-1,-1,0"][..], &["--sun", "300"]] {
        assert_eq!(light(&lights(options), "sun", "sun")["shines"], true, "{options:?}");
    }
    assert_eq!(light(&lights(&["--light-dir", "1,0,0", "--sun", "off"]), "sun", "sun")["shines"], false);
    let scenes = Scenes::new();
    let scene = scenes.still_box();
    let info = json(["info".as_ref(), scene.as_os_str(), "--json".as_ref()]);
    assert_eq!(light(info["lights"].as_array().expect("a list"), "sun", "sun")["shines"], true, "nothing else does");
}

#[test]
fn what_is_no_light_is_named_beside_those_there_are() {
    let scenes = Scenes::new();
    for (change, cause) in [
        ("moon:off", "courtyard has no light called \"moon\"; its lights are \"sun\""),
        ("sun:candela=3", "light \"sun\" cannot be changed: a directional light has no candela; its unit is lux"),
    ] {
        let output = octolume(["info", "courtyard", "--light", change]);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert!(errors.contains(cause) && errors.lines().count() == 1, "{errors}");
    }
    // Settings of another scene.
    let file = scenes.path("settings.json");
    let edit = r#"{"on": false, "kind": "directional", "color": [1, 1, 1], "intensity": 1}"#;
    fs::write(&file, format!(r#"{{"lighting": {{"edits": {{"0": {edit}}}}}}}"#)).expect("written");
    let scene = scenes.still_box();
    let output = on_small_grid(["info".as_ref(), scene.as_os_str(), "--settings".as_ref(), file.as_os_str()]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(1) && errors.contains("node 0 has no light"), "{errors}");
}

#[test]
fn a_light_out_of_range_is_wrong_usage_and_names_option_and_range() {
    let cases: [(&[&str], &str); 16] = [
        (&["--light", "sun:lux=-1"], "a finite number from 0"),
        (&["--light", "sun"], "NAME:KEY=VALUE"),
        (&["--add-light", "spot:at=0,0,0:inner=50"], "grow from 0° to at most 90°"),
        (&["--add-light", "point:candela=3"], "at=X,Y,Z"),
        (&["--add-light", "directional:to=0,0,0"], "which is no direction"),
        (&["--light-dir", "0,0,0"], "which is no direction"),
        (&["--sun", "dim"], "`auto`"),
        (&["--sky", "1,2,-3"], "from 0 as R,G,B"),
        (&["--emission", "-1"], "a finite number from 0"),
        (&["--shadows", "soft"], "`map`, `march`, `off`"),
        (&["--shadow-map", "100"], "[512, 1024, 2048, 4096, 8192]"),
        (&["--shadow-offset", "17"], "0 to 16"),
        (&["--opacity", "glass"], "`isotropic` or `directional`"),
        (&["--bounces", "65"], "0 to 64"),
        (&["--cones", "0"], "1 to 256"),
        (&["--cone-degrees", "121"], "0 to 120"),
    ];
    for (options, range) in cases {
        let output = octolume(["info", "courtyard"].iter().chain(options));
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {errors}");
        assert!(errors.contains(range), "{options:?}: {errors}");
    }
}

#[test]
fn views_of_light_out_of_range_are_wrong_usage() {
    let cases: [(&[&str], &str); 9] = [
        (&["--view", "radiance:9"], "0 (the root) to 7"),
        (&["--view", "glow"], "`level:N`"),
        (&["--slice", "y:1.5"], "0 to 1 of the grid"),
        (&["--slice-value", "heat"], "`radiance`, `irradiance`, `occupancy`"),
        (&["--slice-scale", "log"], "`linear` or `logarithmic`"),
        (&["--sampling", "cubic"], "`quadrilinear`"),
        (&["--lookup", "hash"], "`node-pointers`"),
        (&["--width", "0"], "1 to 1024"),
        (&["--exposure", "41"], "-40 to 40"),
    ];
    for (options, range) in cases {
        let output = octolume(["render", "courtyard", "-o", "x.png"].iter().chain(options));
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {errors}");
        assert!(errors.contains(range), "{options:?}: {errors}");
    }
}

#[test]
fn light_and_slices_are_drawn_and_a_shadow_map_that_is_not_there_is_told() {
    let scenes = Scenes::new();
    let file = scenes.path("view.png");
    let draw = |options: &[&str]| {
        let start = ["render", "courtyard", "--size", "64x48", "-o", file.to_str().expect("UTF-8")];
        let output = on_small_grid(start.iter().chain(options));
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{options:?}: {errors}");
        (image::open(&file).expect("a picture").to_rgba8().into_raw(), errors)
    };
    let looks: [&[&str]; 10] = [
        &["--view", "radiance"],
        &["--view", "radiance:4"],
        &["--view", "radiance", "--light", "sun:off", "--sky", "1,1,2"],
        &["--view", "radiance", "--exposure", "-3"],
        &["--view", "radiance", "--shadows", "off"],
        &["--view", "irradiance"],
        &["--view", "shadow-map"],
        &["--slice", "y:0.2"],
        &["--slice", "y:0.2", "--slice-value", "occupancy"],
        &["--slice", "y:0.2", "--width", "8"],
    ];
    let pictures: std::collections::HashSet<Vec<u8>> = looks.iter().map(|look| draw(look).0).collect();
    assert_eq!(pictures.len(), looks.len(), "every one is another picture");
    let (_, warnings) = draw(&["--view", "shadow-map:7"]);
    assert!(warnings.contains("there is no shadow map 7: they are 0 to 0, and 0 is shown"), "{warnings}");
}

#[test]
fn shadows_of_no_light_cannot_be_compared() {
    let scenes = Scenes::new();
    let scene = scenes.still_box();
    let arguments = ["accuracy".as_ref(), scene.as_os_str(), "--lighting".as_ref(), "--sun".as_ref(), "off".as_ref()];
    let output = on_small_grid(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert!(errors.contains("still: no light shines that could cast a shadow"), "{errors}");
    let output = octolume(["accuracy", "courtyard", "--lighting", "--grids", "100"]);
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
}
