//! The report card: one line a check with what is exact, what was got, the error and its bound.

use std::path::Path;

/// Name of a case, and what runs it unless it has run.
pub(crate) type Case = (&'static str, fn() -> &'static Card);

/// The checks of one case.
#[derive(Default)]
pub(crate) struct Card {
    lines: Vec<Line>,
}

struct Line {
    quantity: String,
    exact: String,
    got: String,
    error: f64,
    bound: f64,
}

impl Card {
    /// |got − exact| ≤ bound.
    pub(crate) fn near(&mut self, quantity: &str, exact: f64, got: f64, bound: f64) {
        self.push(quantity, exact, got, (got - exact).abs(), bound);
    }

    /// |got/exact − 1| ≤ bound.
    pub(crate) fn relative(&mut self, quantity: &str, exact: f64, got: f64, bound: f64) {
        self.push(quantity, exact, got, (got / exact - 1.0).abs(), bound);
    }

    /// The two are the same number, to the bit.
    pub(crate) fn same(&mut self, quantity: &str, exact: f64, got: f64) {
        let error = if exact.to_bits() == got.to_bits() {
            0.0
        } else {
            f64::INFINITY
        };
        self.push(quantity, exact, got, error, 0.0);
    }

    /// An error that was measured elsewhere, the worst of many, is at most `bound`.
    pub(crate) fn at_most(&mut self, quantity: &str, error: f64, bound: f64) {
        self.lines.push(Line {
            quantity: quantity.to_owned(),
            exact: "0".to_owned(),
            got: String::new(),
            error,
            bound,
        });
    }

    /// Something that is true or not.
    pub(crate) fn holds(&mut self, claim: &str, holds: bool) {
        self.lines.push(Line {
            quantity: claim.to_owned(),
            exact: "yes".to_owned(),
            got: if holds { "yes" } else { "no" }.to_owned(),
            error: if holds { 0.0 } else { f64::INFINITY },
            bound: 0.0,
        });
    }

    fn push(&mut self, quantity: &str, exact: f64, got: f64, error: f64, bound: f64) {
        self.lines.push(Line {
            quantity: quantity.to_owned(),
            exact: number(exact),
            got: number(got),
            error,
            bound,
        });
    }

    /// Fails on the first check that does not hold.
    pub(crate) fn passes(&self) {
        assert!(!self.lines.is_empty(), "nothing was checked");
        for line in &self.lines {
            assert!(
                line.error <= line.bound,
                "{}: exact {}, got {}, error {:e}, allowed {:e}",
                line.quantity,
                line.exact,
                line.got,
                line.error,
                line.bound
            );
        }
    }
}

/// Cases of one section: each a test, and an entry of `CASES`. Each runs once, for its test and the
/// report card together.
macro_rules! cases {
    ($($(#[$doc:meta])* fn $name:ident($card:ident) $body:block)*) => {
        $($(#[$doc])* fn $name($card: &mut crate::hard_cases::card::Card) $body)*

        pub(crate) const CASES: &[super::card::Case] = &[$((stringify!($name), once::$name)),*];

        mod once {
            use crate::hard_cases::card::Card;
            use std::sync::OnceLock;

            $(pub(super) fn $name() -> &'static Card {
                static CARD: OnceLock<Card> = OnceLock::new();
                CARD.get_or_init(|| {
                    let mut card = Card::default();
                    super::$name(&mut card);
                    card
                })
            })*
        }

        mod tests {
            $(#[test]
            fn $name() {
                super::once::$name().passes();
            })*
        }
    };
}

/// Ten digits: what another machine's library functions may make of the last ones does not show.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        let digits = 10 - value.abs().max(1e-9).log10().floor() as i32 - 1;
        let text = format!("{value:.*}", digits.clamp(0, 12) as usize);
        if text.contains('.') {
            return text.trim_end_matches('0').trim_end_matches('.').to_owned();
        }
        return text;
    }
    format!("{value:.9e}")
}

/// The power of ten that an error is below, so that its last digits do not show either.
fn error(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "fails".to_owned();
    }
    format!("< 1e{}", value.log10().floor() as i32 + 1)
}

fn bound(value: f64) -> String {
    if value == 0.0 {
        "0".to_owned()
    } else {
        format!("{value:.0e}")
    }
}

/// The card as a page.
fn page(sections: &[(&'static str, &'static [Case])]) -> String {
    let mut page = String::from(HEAD);
    for (title, cases) in sections {
        page += &format!(
            "\n## {title}\n\n| case | quantity | exact | got | error | bound |\n|---|---|---|---|---|---|\n"
        );
        // Not on rayon's threads: one that waits here for a case could be one that the case waits for.
        for (name, case) in *cases {
            page += &rows(name, case());
        }
    }
    page
}

fn rows(name: &str, card: &Card) -> String {
    let (row, claim) = name.split_once('_').unwrap_or((name, ""));
    let head = format!("{} {}", row.to_uppercase(), claim.replace('_', " "));
    let mut text = String::new();
    for (i, line) in card.lines.iter().enumerate() {
        let first = if i == 0 { head.as_str() } else { "" };
        text += &format!(
            "| {first} | {} | {} | {} | {} | {} |\n",
            line.quantity,
            line.exact,
            line.got,
            error(line.error),
            bound(line.bound)
        );
    }
    text
}

/// Compares the card with docs/hard-cases.md; `RESTFRAME_CARD=print` prints it, `=write` renews the
/// file.
pub(crate) fn compare(sections: &[(&'static str, &'static [Case])]) {
    let page = page(sections);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/hard-cases.md");
    match std::env::var("RESTFRAME_CARD").as_deref() {
        Ok("print") => println!("{page}"),
        Ok("write") => std::fs::write(&path, &page).unwrap(),
        _ => {
            let kept = std::fs::read_to_string(&path).unwrap_or_default();
            for (kept, found) in kept.lines().zip(page.lines()) {
                assert_eq!(
                    kept, found,
                    "docs/hard-cases.md is not current: run scripts/hard-cases --write"
                );
            }
            assert_eq!(
                kept.lines().count(),
                page.lines().count(),
                "run scripts/hard-cases --write"
            );
        }
    }
}

const HEAD: &str = "# Hard cases

The report card of `scripts/hard-cases`, which runs every case below; `scripts/test` fails where a line is not within its bound, or this page is not what the tests print. An error of `< 1e-15` is below that power of ten. Errors are absolute where the exact value may be 0, else relative.

Not here, for want of what they need: F1 to F7 (worldlines that accelerate or rotate; all are straight), B10 and E6 (lamps that blink or are switched: a lamp shines always), D6 (bodies that begin to exist), G3 (spectral channels in EXR files), and the half-float part of C12 (files hold 32-bit floats).
";
