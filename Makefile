# The developer's commands. Each runs alone on a machine that has Rust, Node, Python, g++ and make; what more it
# needs it installs itself, and says so first.

CARGO ?= cargo
GROUNDSTATE := target/release/groundstate
# With its assertions: tests run it, which build it anyway, and so does the demo where they did.
TESTED := target/debug/groundstate
MODELS := library/patterns library/runtime examples
REFINEMENTS := library/refinement examples/visual_servoing/refinement
# Clippy's driver is the compiler with its lints, so that tests and lints are one build.
LINTED := $(if $(shell command -v clippy-driver),RUSTC_WORKSPACE_WRAPPER=clippy-driver CLIPPY_ARGS=-D__CLIPPY_HACKERY__warnings)
OLDEST := $(shell sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
TIMED := sh xtask/timed.sh
PARTS := lint unit scenarios cpp systems robot web

.PHONY: help demo test full quick times lint unit scenarios verify cpp cpp-full systems robot robot-full mutants cpp-mutants rust-mutants fuzz bench \
    install studio studio-full bench-studio web msrv bench-cpp corpus update vscode clean

help: ## this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*##/\t/' | expand -t 12

demo: ## the model for a second with every scenario → out/report.html; the robot in closed loop, held to its model → out/robot.html
ifneq ($(wildcard $(TESTED)),)
	@COMPILE="$(MAKE) --no-print-directory $(TESTED)" GROUNDSTATE=$(TESTED) sh docs/demo.sh
else
	@COMPILE="$(CARGO) build --locked --profile demo --package cli" GROUNDSTATE=target/demo/groundstate sh docs/demo.sh
endif

# Two at a time: what waits, links or runs in one thread leaves a processor to the other.
test: ## everything that must hold before a change lands: a quarter of an hour on two processors
	@$(TIMED) --begin
	@$(TIMED) build $(MAKE) --no-print-directory $(TESTED)
	@$(TIMED) all $(MAKE) --no-print-directory --jobs=2 --output-sync=target $(PARTS:%=timed-%) || { $(TIMED); exit 1; }
	@$(TIMED)

timed-%:
	@$(TIMED) $* $(MAKE) --no-print-directory $*

# What is not newer than what it was made of is not made again.
WEB := $(shell find web crates/report/src/html -name node_modules -prune -o -name dist -prune -o -type f -print 2>/dev/null)

web/node_modules/.package-lock.json: web/package.json web/package-lock.json
	cd web && npm ci --no-audit --no-fund
	@touch $@

web/dist/index.html: $(WEB) web/node_modules/.package-lock.json
	cd web && npm run build
	@touch $@

studio: web/dist/index.html ## a project in the browser: `make studio FOLDER=examples`, without one this project
	$(CARGO) build --locked --profile demo --package cli
	target/demo/groundstate studio $(or $(FOLDER),.)

install: web/dist/index.html ## the tool, with the studio's pages in it, where cargo installs programs
	$(CARGO) install --locked --path shells/cli

web: web/node_modules/.package-lock.json ## the studio's front end: types and the fast tests
	cd web && npm test

# What drives the browser needs Node 20; Debian 12 has 18.
studio-full: web/dist/index.html $(TESTED) ## the studio in Debian's Chromium: every view, light and dark, its faults of accessibility
	@if node -e 'process.exit(+process.versions.node.split(".")[0] < 20 ? 1 : 0)'; then \
	    sh cpp/install.sh chromium cmake && cd web && GROUNDSTATE=$(CURDIR)/$(TESTED) npm run e2e; \
	else echo "studio-full: not tried: Node 20 is not installed"; fi

bench-studio: web/dist/index.html $(GROUNDSTATE) ## the studio's first picture, frames, and the time from a letter to its fault
	sh cpp/install.sh chromium
	cd web && GROUNDSTATE=$(CURDIR)/$(GROUNDSTATE) npm run bench

vscode: ## the extension for VS Code, checked and packed: editors/vscode/groundstate*.vsix
	cd editors/vscode && npm ci --no-audit --no-fund && npm test && npm run package

full: export GROUNDSTATE_FULL = 1
full: ## `make test` with the largest samples, and what is slow and rarely breaks: the oldest Rust, sanitizers, all robots, proofs, mutants: hours
	@for part in test msrv verify cpp-full robot-full mutants cpp-mutants studio-full; do \
	    $(TIMED) $$part $(MAKE) --no-print-directory $$part || failed="$$failed $$part"; \
	done; $(TIMED); test -z "$$failed" || { echo "failed:$$failed"; exit 1; }

quick: $(TESTED) ## what a one-line change needs: lints, the tests that are over in a moment, the library's scenarios
	$(CARGO) fmt --all --check
	$(LINTED) $(CARGO) test --workspace --locked --lib --bins
	$(TESTED) test --quiet library/patterns

times: $(TESTED) ## how long each test takes that takes longer than a second
	RUSTC_BOOTSTRAP=1 $(LINTED) $(CARGO) test --workspace --locked --no-fail-fast -- -Zunstable-options --report-time 2>/dev/null | \
	    sed -nE 's/^test (.*) \.\.\. [a-zA-Z]* <([0-9.]+)s>$$/\2 s  \1/p' | sort -rn | awk '$$1 >= 1'

lint: $(TESTED)
	@clippy-driver --version
	$(CARGO) fmt --all --check
	$(TESTED) fmt --check library examples bench/models cpp/systems
	$(LINTED) python3 xtask/docs.py
	python3 editors/kate/make.py --check

unit: $(TESTED)
	sh cpp/install.sh z3 cvc5 clang
	MAKEFLAGS= $(LINTED) $(CARGO) test --workspace --locked --no-fail-fast

scenarios: $(TESTED)
	$(TESTED) check $(MODELS) library/verification
	$(TESTED) test $(MODELS)
	sh library/verification/verify.sh $(TESTED) expected.txt
	sh library/refinement/refine.sh $(TESTED) examples/visual_servoing/refinement/expected.txt

# The toolchain is not installed here: it would be one more compiler for one check.
msrv: ## the workspace, checked by the oldest Rust that Cargo.toml promises, if rustup has it
	@if rustup run $(OLDEST) rustc --version 2>/dev/null; then \
	    CARGO_TARGET_DIR=target/oldest rustup run $(OLDEST) cargo check --workspace --locked; \
	else echo "msrv: not checked: Rust $(OLDEST) is not installed (rustup toolchain install $(OLDEST) --profile minimal)"; fi

verify: $(GROUNDSTATE) ## the pattern library's properties in every state, its seeded faults found, mutants of library and examples, its refinements, the reference systems counted: minutes, 4 GB
	sh cpp/install.sh z3 cvc5
	sh library/verification/verify.sh $(GROUNDSTATE) expected.txt expected-long.txt
	sh library/refinement/refine.sh $(GROUNDSTATE) $(REFINEMENTS:%=%/expected.txt) $(REFINEMENTS:%=%/expected-long.txt)
	sh library/verification/mutants.sh $(GROUNDSTATE) library/verification/mutants.txt examples/mutants.txt
	sh examples/sorting_cell/check.sh $(GROUNDSTATE) whole

cpp: ## the C++ runtime and the cameras: their tests as they are; the runtime's under ThreadSanitizer, too
	sh cpp/run.sh plain thread

cpp-full: ## the same by clang++, and under AddressSanitizer and UndefinedBehaviorSanitizer, too
	sh cpp/run.sh

systems: $(TESTED) ## programs generated from systems: run, held to their models, with faults put in
	sh cpp/systems/run.sh $(TESTED)
	sh examples/sorting_cell/check.sh $(TESTED)
	sh examples/machines.sh $(TESTED)

robot: $(TESTED) ## the case study's robot: servo law, vision, the controller in closed loop, held to its model
	sh examples/robot.sh $(TESTED) visual_servoing

robot-full: $(TESTED) ## all four robots, also under the sanitizers and with faults put in, and the servo law beside ViSP's
	sh examples/robot.sh $(TESTED)

mutants: ## mutated texts through every command, every fifth change of an event in logs of generated systems through `conform`
	$(CARGO) xtask mutate-text
	$(CARGO) xtask mutate-log --every 5

cpp-mutants: ## small faults in the C++ runtime: its tests and ThreadSanitizer notice each that is not listed; every Nth with EVERY=N
	sh cpp/install.sh libgtest-dev
	python3 cpp/mutate.py --every $(or $(EVERY),1)

# cargo-mutants is not installed here: it would be one more program for one check.
rust-mutants: ## small faults in `conform`, the search and the semantics, judged by their tests, if cargo-mutants is there: a day; a part with MUTANTS="--shard 0/8"
	@if cargo mutants --version 2>/dev/null; then code=0; \
	    for judged in conform verify "machine --test-package oracle"; do \
	        cargo mutants --package $${judged%% *} --test-package $$judged --output out/rust-mutants/$${judged%% *} $(MUTANTS) || code=$$?; \
	    done; exit $$code; \
	else echo "rust-mutants: not judged: cargo-mutants is not installed (cargo install --locked cargo-mutants)"; fi

fuzz: ## the fuzz targets, a minute each, guided by coverage; `make unit` tries the same on mutations
	sh fuzz/run.sh 60

bench: ## steps per second and peak memory; with CORPUS=path also of the public models with a reference
	$(CARGO) xtask bench $(if $(CORPUS),--corpus $(CORPUS)) $(if $(PEER),--peer $(PEER)) $(if $(TLC),--tlc $(TLC))

bench-cpp: ## what it costs to hand data over in C++, and to draw a simulated frame
	sh cpp/bench/run.sh

corpus: $(GROUNDSTATE) ## make corpus CORPUS=path: compare with recorded results of the public corpus, count charts, hold generated code to it, decide its refinements
	@mkdir -p out/corpus
	$(CARGO) xtask corpus $(CORPUS) --scripts out/corpus/scripts
	$(CARGO) run --locked --profile quick --package generate --example folder -- $(CORPUS) \
	    --scripts out/corpus/scripts --log out/corpus/generated.log $(if $(EVERY),--every $(EVERY))
	sh cpp/install.sh z3 cvc5
	sh bench/refinements/refine.sh $(GROUNDSTATE) $(CORPUS)

update: ## rewrite all golden expectations
	UPDATE_EXPECT=1 SNAPSHOTS=overwrite TRYCMD=overwrite $(LINTED) $(CARGO) test --workspace --locked --no-fail-fast

clean: ## remove what was built
	$(CARGO) clean
	rm -rf out

# Cargo knows best what is up to date.
$(GROUNDSTATE): FORCE
	$(CARGO) build --release --locked --package cli
# As the tests are built: alone it would be given other features, and all below them be compiled twice.
$(TESTED): FORCE
	$(LINTED) $(CARGO) test --workspace --locked --no-run
FORCE:
