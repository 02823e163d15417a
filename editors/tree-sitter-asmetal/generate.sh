#!/bin/sh
# Generates src/ from grammar.js, runs the corpus, and notes the sums that the tests compare. Needs tree-sitter 0.25:
# `cargo install tree-sitter-cli --version 0.25.10 --no-default-features`, and Node. ABI 14 is what Neovim 0.7 to 0.11, Helix,
# Zed and Emacs 29 read.
set -eu
cd "$(dirname "$0")"
tree-sitter generate --abi 14
tree-sitter test
sha256sum grammar.js src/grammar.json src/node-types.json src/parser.c > src/sums
