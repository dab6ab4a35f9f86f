//! Declarations in the states in which an editor passes them while they are typed: never a panic, always a
//! material or a mistake.

use catalogue::catalogue;
use proc_macro2::{Group, TokenStream, TokenTree};

#[path = "shared/catalogue.rs"]
mod catalogue;

/// The tokens whose numbers, counted from `next` on, `keeps` accepts. A group is one token, and so is each
/// inside it.
fn thinned(tokens: TokenStream, next: &mut usize, keeps: &impl Fn(usize) -> bool) -> TokenStream {
    let mut kept = Vec::new();
    for token in tokens {
        let is_kept = keeps(*next);
        *next += 1;
        let token = match token {
            TokenTree::Group(group) => {
                let inner = thinned(group.stream(), next, keeps);
                TokenTree::Group(Group::new(group.delimiter(), inner))
            }
            token => token,
        };
        if is_kept {
            kept.push(token);
        }
    }
    kept.into_iter().collect()
}

fn count(tokens: &TokenStream) -> usize {
    let mut count = 0;
    thinned(tokens.clone(), &mut count, &|_| true);
    count
}

/// The remaining tokens of both streams, as if the item followed the arguments.
fn expand(arguments: &TokenStream, item: &TokenStream, keeps: impl Fn(usize) -> bool) {
    let mut next = 0;
    let arguments = thinned(arguments.clone(), &mut next, &keeps);
    let item = thinned(item.clone(), &mut next, &keeps);
    let expansion = piola_codegen::expand(arguments.clone(), item.clone());
    // At the outermost level a mistake starts as `::core::compile_error!`, and the implementations of a
    // material are in a `const` block.
    let mut words = expansion.into_iter().filter_map(|token| match token {
        TokenTree::Ident(word) => Some(word),
        _ => None,
    });
    assert!(
        words.any(|word| word == "compile_error" || word == "const"),
        "neither a material nor a mistake: #[material({arguments})] {item}"
    );
}

/// Calls `expand` for each declaration and each of its tokens.
fn for_each_token(expand: impl Fn(&TokenStream, &TokenStream, usize)) {
    let declarations: Vec<_> = catalogue().into_iter().flat_map(|(_, declared)| declared).collect();
    assert!(declarations.len() > 30, "{} declarations", declarations.len());
    for (arguments, item) in declarations {
        for k in 0..count(&arguments) + count(&item) {
            expand(&arguments, &item, k);
        }
    }
}

#[test]
fn without_one_token() {
    for_each_token(|arguments, item, missing| expand(arguments, item, |k| k != missing));
}

#[test]
fn without_what_follows_a_token() {
    for_each_token(|arguments, item, end| expand(arguments, item, |k| k < end));
}
