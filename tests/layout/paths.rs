//! Paths that a source names, from its tokens, so that comments, doc links and strings do not count.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// `scene/sky/mod.rs` is `scene`, `sky`; `lib.rs` is the root.
pub(crate) fn module_of(path: &str) -> Vec<String> {
    let path = path.trim_end_matches(".rs").trim_end_matches("/mod");
    if path == "lib" {
        Vec::new()
    } else {
        path.split('/').map(str::to_owned).collect()
    }
}

/// The paths from the root of the crate, in a `use` or not, that `tokens` in the given module name.
pub(crate) fn paths(tokens: TokenStream, module: &[String]) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    collect(tokens, module, &mut found);
    found.sort();
    found.dedup();
    found
}

fn collect(tokens: TokenStream, module: &[String], found: &mut Vec<Vec<String>>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let word = |i: usize| match tokens.get(i) {
        Some(TokenTree::Ident(word)) => Some(word.to_string()),
        _ => None,
    };
    let mut i = 0;
    while i < tokens.len() {
        match (&tokens[i], word(i).as_deref()) {
            (TokenTree::Group(group), _) => collect(group.stream(), module, found),
            (_, Some("mod")) => {
                if let (Some(name), Some(TokenTree::Group(body))) = (word(i + 1), tokens.get(i + 2))
                {
                    let inner = [module, &[name]].concat();
                    collect(body.stream(), &inner, found);
                    i += 2;
                }
            }
            (_, Some("crate" | "restframe")) if !follows_colons(&tokens, i) => {
                follow(&tokens[i + 1..], &[], found);
            }
            (_, Some("super")) if !follows_colons(&tokens, i) => {
                let above = module.split_last().map_or(&[][..], |(_, up)| up);
                follow(&tokens[i + 1..], above, found);
            }
            _ => {}
        }
        i += 1;
    }
}

fn is_colon(token: Option<&TokenTree>) -> bool {
    matches!(token, Some(TokenTree::Punct(mark)) if mark.as_char() == ':')
}

/// Whether `::` stands before token `i`, which is then no beginning of a path.
fn follows_colons(tokens: &[TokenTree], i: usize) -> bool {
    i >= 2 && is_colon(tokens.get(i - 1)) && is_colon(tokens.get(i - 2))
}

/// Adds the ends of a path whose rest begins with `::` after the module `at`: through braces, and
/// up through `super`.
fn follow(rest: &[TokenTree], at: &[String], found: &mut Vec<Vec<String>>) {
    if !(is_colon(rest.first()) && is_colon(rest.get(1))) {
        if !at.is_empty() {
            found.push(at.to_vec());
        }
        return;
    }
    match rest.get(2) {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => {
            let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
            let comma = |t: &TokenTree| matches!(t, TokenTree::Punct(p) if p.as_char() == ',');
            tokens.split(comma).for_each(|part| step(part, at, found));
        }
        Some(_) => step(&rest[2..], at, found),
        None => {}
    }
}

fn step(path: &[TokenTree], at: &[String], found: &mut Vec<Vec<String>>) {
    let Some(TokenTree::Ident(word)) = path.first() else {
        return;
    };
    match word.to_string().as_str() {
        "super" => follow(&path[1..], &at[..at.len().saturating_sub(1)], found),
        "self" => follow(&path[1..], at, found),
        name => follow(&path[1..], &[at, &[name.to_owned()]].concat(), found),
    }
}
