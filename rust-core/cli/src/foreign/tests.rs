//! Command lines of other programs.

use super::{
    table::{ROWS, State},
    translate,
};
use crate::arguments::{Arguments, Command, RenderOptions};
use clap::{CommandFactory, Parser};

fn words(text: &str) -> Vec<String> {
    ["gonio", "render"].into_iter().chain(text.split_whitespace()).map(str::to_owned).collect()
}

fn parsed(text: &str) -> Box<RenderOptions> {
    let translated = translate(&words(text)).expect("understood");
    match Arguments::try_parse_from(&translated.words).map(|arguments| arguments.command) {
        Ok(Command::Render(mut options)) => {
            options.settle();
            options
        }
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn what_works_is_an_option_of_gonio() {
    let command = Arguments::command();
    let render = command.find_subcommand("render").expect("there");
    for row in ROWS {
        let State::Works(own) = row.state else { continue };
        assert!(render.get_arguments().any(|argument| argument.get_long() == own.strip_prefix("--")), "{own}");
    }
    for row in ROWS {
        assert!(
            matches!(row.state, State::Works(_)) || !row.note.is_empty() || row.names[0] == "--usd-input",
            "{:?} says nothing",
            row.names
        );
    }
}

#[test]
fn every_option_alone() {
    for row in ROWS {
        for name in row.names {
            let value = match row.names[0] {
                "--headlight" => "dome",
                "--colorCorrectionMode" => "sRGB",
                "--complexity" => "low",
                "--res" | "--tile-count" => "3 4",
                "--usd-input" => "b.usda",
                _ => "7",
            };
            let stage = if row.names[0] == "--usd-input" { "" } else { "a.usda" };
            let line = format!("{name} {} {stage}", if row.takes > 0 { value } else { "" });
            match row.state {
                State::Refused => {
                    let error = translate(&words(&line)).expect_err("refused").to_string();
                    assert!(error.contains(name) && error.contains(row.note), "{error}");
                }
                _ => drop(parsed(&line)),
            }
        }
    }
}

#[test]
fn usdrecord_s_command_lines() {
    let options = parsed("--frames 1:10x2 --camera Main -w 640 -c veryhigh -color sRGB -rs /S --renderer Storm stage.usda out.####.exr");
    assert_eq!(options.stage.stage.to_str(), Some("stage.usda"));
    assert_eq!(options.files.output.iter().map(|path| path.to_str()).collect::<Vec<_>>(), [Some("out.####.exr")]);
    assert_eq!((options.frames.as_deref(), options.camera.as_deref(), options.image_width), (Some("1:10x2"), Some("Main"), Some(640)));
    assert_eq!(options.stage.settings.as_deref(), Some("/S"));
    assert!(format!("{:?}", options.stage.complexity).contains("Veryhigh"));
    assert!(parsed("-d stage.usda out.exr").default_time);
}

#[test]
fn husk_s_command_lines() {
    let options = parsed(
        "-o out.$F4.exr,b.<F4>.png -f 1 -n 10 -i 2 -r 640 360 -V a3 -p 16 --make-output-path -R BRAY_HdKarma -c /cams/a --pass /P stage.usd",
    );
    assert_eq!(options.files.output.len(), 2);
    assert_eq!((options.frames.as_deref(), options.frame_count, options.frame_inc), (Some("1"), Some(10), Some(2.0)));
    assert_eq!((options.res.as_deref(), options.spp, options.stage.verbose), (Some(&[640, 360][..]), Some(16), true));
    assert_eq!((options.camera.as_deref(), options.stage.render_pass.as_deref()), (Some("/cams/a"), Some("/P")));
    assert!(parsed("--verbose 0 stage.usd").quiet);
    assert!(parsed("-V2 stage.usd --verbose").stage.verbose);
    assert_eq!(parsed("stage.usd --frame-list 1 5 9 -o a.####.exr").frames.as_deref(), Some("1,5,9"));
    assert_eq!(parsed("--res-scale=-1 stage.usd").res_scale, -1.0);
    assert_eq!(parsed("--frame=3 --res 8 8 stage.usd").frames.as_deref(), Some("3"));
}

#[test]
fn what_changes_nothing_is_told() {
    let notes = translate(&words("a.usda --engine xpu --renderer Storm --bucket-size 32")).expect("taken").notes;
    assert_eq!(notes.len(), 3);
    assert!(notes[0].starts_with("--engine (husk) changes nothing"));
}

#[test]
fn other_commands_keep_their_words() {
    let info = ["gonio", "info", "a.usda", "-f", "3"].map(str::to_owned);
    assert_eq!(translate(&info).expect("as it is").words, info);
}
