//! A plan, printed: one row a pass and method.

use super::keys::Keys;
use super::{Asked, Held, Part, Pass, PlannedPart, Row, State, light, surfaces, views, voxels};

type Verdict = (State, &'static str);

/// What was decided, of all parts.
type Decided<'a> = (&'a [PlannedPart], &'a Held);

pub(super) fn rows(methods: &[Asked], keys: &[Keys], decided: Decided<'_>) -> Vec<Row> {
    let mut rows = Vec::new();
    for (method, (asked, own)) in methods.iter().zip(keys).enumerate() {
        let shares = |part: Part| {
            let key = own.get(part);
            key.is_none() || keys[..method].iter().any(|earlier| earlier.get(part) == key)
        };
        for pass in Pass::ALL {
            if method > 0 && pass.parts().iter().all(|part| shares(*part)) {
                continue;
            }
            let (state, reason) = verdict(pass, asked, own, decided);
            if method == 0 || state != State::Skip {
                rows.push(Row { method, pass, state, reason });
            }
        }
    }
    rows
}

/// Of all parts that the pass makes: one that runs before one that is kept.
fn verdict(pass: Pass, asked: &Asked, keys: &Keys, decided: Decided<'_>) -> Verdict {
    let mut verdicts = pass.parts().iter().map(|part| part_verdict(*part, keys, decided));
    let first = verdicts.next().unwrap_or((State::Skip, "nothing is made"));
    let (state, reason) = verdicts.fold(first, |best, other| match (best.0, other.0) {
        (State::Run, _) | (State::Reuse, State::Skip) | (State::Skip, State::Skip) | (State::Reuse, State::Reuse) => {
            best
        }
        _ => other,
    });
    let left_out = match pass.parts() {
        // Which of them draws depends on the view alone.
        [Part::Picture] => views::not_drawn_by(pass, asked),
        _ if state == State::Skip => None,
        _ => left_out(pass, asked),
    };
    left_out.map_or((state, reason), |reason| (State::Skip, reason))
}

/// Why a pass of a part that is made is left out, if so.
pub(super) fn left_out(pass: Pass, asked: &Asked) -> Option<&'static str> {
    voxels::left_out(pass, asked).or(light::left_out(pass, asked)).or(surfaces::left_out(pass, asked))
}

fn part_verdict(part: Part, keys: &Keys, (to_run, held): Decided<'_>) -> Verdict {
    match keys.wanted(part) {
        Err(reason) => (State::Skip, reason),
        Ok(key) if to_run.iter().any(|planned| planned.part == part && planned.key == *key) => {
            let because = held.before(part, key).map_or("made for the first time", |before| key.difference(before));
            (State::Run, because)
        }
        Ok(key) if held.holds(part, key) => (State::Reuse, part.unchanged()),
        Ok(_) => (State::Reuse, "what is made from it is kept"),
    }
}
