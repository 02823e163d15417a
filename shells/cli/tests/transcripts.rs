//! Transcripts: commands and their answers, in tests/cmd/. `TRYCMD=overwrite` rewrites the answers.

#[test]
fn transcripts() {
    trycmd::TestCases::new().case("tests/cmd/*.trycmd");
}
