//! Circles of imports between the files of a room.
//!
//! Unit tests do not count: they may look at any file of their room. Nor does `mod.rs`, which
//! declares and re-exports: a path by way of it leads to the file where the item stands.

use super::paths::{module_of, paths};
use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};

type Module = Vec<String>;

/// The sources by module: their tokens without unit tests.
pub(crate) struct Files {
    tokens: BTreeMap<Module, TokenStream>,
    declaring: BTreeSet<Module>,
    /// Where an item that a module re-exports stands.
    exports: BTreeMap<(Module, String), Module>,
}

impl Files {
    pub(crate) fn new(files: &[(String, String)]) -> Self {
        let mut all = Self {
            tokens: BTreeMap::new(),
            declaring: BTreeSet::new(),
            exports: BTreeMap::new(),
        };
        for (path, text) in files {
            let Ok(tokens) = text.parse::<TokenStream>() else {
                continue;
            };
            let module = module_of(path);
            if path == "lib.rs" || path.ends_with("mod.rs") {
                all.declaring.insert(module.clone());
            }
            all.tokens.insert(module, without_tests(tokens));
        }
        all.find_exports();
        all
    }

    /// One line for each circle.
    pub(crate) fn circles(&self) -> Vec<String> {
        let edges: BTreeMap<&Module, BTreeSet<Module>> = self
            .tokens
            .keys()
            .filter(|module| !self.declaring.contains(*module))
            .map(|module| (module, self.imports(module)))
            .collect();
        let mut found: BTreeSet<Vec<String>> = BTreeSet::new();
        for module in edges.keys() {
            let mut members: Vec<String> = edges
                .keys()
                .filter(|other| reaches(&edges, module, other) && reaches(&edges, other, module))
                .map(|other| other.join("/"))
                .collect();
            members.sort();
            if !members.is_empty() {
                found.insert(members);
            }
        }
        let line = |members: Vec<String>| format!("{} import each other", members.join(", "));
        found.into_iter().map(line).collect()
    }

    /// The files of its own room that a file imports.
    fn imports(&self, module: &Module) -> BTreeSet<Module> {
        let mut named = paths(self.tokens[module].clone(), module);
        named.extend(self.children(module));
        let files = named.iter().filter_map(|path| self.file_of(path));
        let own = |file: &Module| {
            file != module && file.first() == module.first() && !self.declaring.contains(file)
        };
        files.filter(own).collect()
    }

    /// Paths into files below a file that is no `mod.rs`, which need no `self`.
    fn children(&self, module: &Module) -> Vec<Module> {
        let mut found = Vec::new();
        heads(self.tokens[module].clone(), &mut found);
        found
            .into_iter()
            .map(|head| [&module[..], &[head]].concat())
            .filter(|path| self.tokens.contains_key(path))
            .collect()
    }

    /// The file that a path leads to.
    fn file_of(&self, path: &[String]) -> Option<Module> {
        let mut path = path.to_vec();
        for _ in 0..8 {
            let length = (0..=path.len())
                .rev()
                .find(|&n| self.tokens.contains_key(&path[..n]))?;
            let (file, rest) = path.split_at(length);
            let item = rest.first().map(|item| (file.to_vec(), item.clone()));
            match item.and_then(|item| self.exports.get(&item)) {
                Some(home) if home[..] != *file => path = [&home[..], rest].concat(),
                _ => return Some(file.to_vec()),
            }
        }
        None
    }

    fn find_exports(&mut self) {
        for module in &self.declaring {
            let tokens: Vec<TokenTree> = self.tokens[module].clone().into_iter().collect();
            let mark = |t: &TokenTree| matches!(t, TokenTree::Punct(p) if p.as_char() == ';');
            for statement in tokens.split(mark) {
                let word = |t: &TokenTree| matches!(t, TokenTree::Ident(w) if w == "use");
                let Some(start) = statement.iter().position(word) else {
                    continue;
                };
                // `use a::B` in a module is a path below it.
                let below: TokenStream = "super::".parse().expect("tokens");
                let rest = statement[start + 1..].iter().cloned();
                let inner = [&module[..], &["use".to_owned()]].concat();
                let absolute = statement
                    .get(start + 1)
                    .is_some_and(|t| ["crate", "super", "std"].contains(&&*t.to_string()));
                if absolute {
                    continue;
                }
                for path in paths(below.into_iter().chain(rest).collect(), &inner) {
                    if let Some((item, home)) = path.split_last() {
                        let key = (module.clone(), item.clone());
                        self.exports.insert(key, home.to_vec());
                    }
                }
            }
        }
    }
}

fn reaches(edges: &BTreeMap<&Module, BTreeSet<Module>>, from: &Module, to: &Module) -> bool {
    let mut seen = BTreeSet::new();
    let mut open: Vec<&Module> = edges[from].iter().collect();
    while let Some(next) = open.pop() {
        if next == to {
            return true;
        }
        if seen.insert(next) {
            open.extend(edges.get(next).into_iter().flatten());
        }
    }
    false
}

/// Words that a path begins with.
fn heads(tokens: TokenStream, found: &mut Vec<String>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let colon = |i: usize| matches!(tokens.get(i), Some(TokenTree::Punct(p)) if p.as_char() == ':');
    for (i, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Group(group) => heads(group.stream(), found),
            TokenTree::Ident(word) if colon(i + 1) && colon(i + 2) && !(i > 0 && colon(i - 1)) => {
                found.push(word.to_string());
            }
            _ => {}
        }
    }
}

/// The same without modules named `tests`.
fn without_tests(tokens: TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let is = |i: usize, text: &str| matches!(tokens.get(i), Some(TokenTree::Ident(w)) if w == text);
    let kept = (0..tokens.len()).filter(|&i| {
        let body = matches!(tokens[i], TokenTree::Group(_));
        !(body && i >= 2 && is(i - 1, "tests") && is(i - 2, "mod"))
    });
    kept.map(|i| tokens[i].clone()).collect()
}
