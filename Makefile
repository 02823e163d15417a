# The developer's commands. Each runs alone on a machine that has Rust, Node, Python, g++ and make; what more it
# needs it installs itself, and says so first.

CARGO ?= cargo
GROUNDSTATE := target/release/groundstate
# Tests run it with its assertions, which is built anyway.
TESTED := target/debug/groundstate
MODELS := library/patterns library/runtime examples

.PHONY: help demo test lint unit scenarios verify cpp systems robot robot-sanitized fuzz bench bench-cpp corpus update clean

help: ## this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*##/\t/' | expand -t 12

demo: $(GROUNDSTATE) ## the model for a second with every scenario → out/report.html; the robot in closed loop, held to its model → out/robot.html
	@GROUNDSTATE=$(GROUNDSTATE) sh docs/demo.sh

# Two at a time: what waits, links or runs in one thread leaves a processor to the other.
test: ## everything that must hold before a change lands
	$(MAKE) --no-print-directory --jobs=2 --output-sync=target lint unit scenarios cpp systems robot

lint: $(TESTED)
	$(CARGO) fmt --all --check
	$(TESTED) fmt --check library examples bench/models cpp/systems
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings

unit: $(TESTED)
	sh cpp/install.sh z3 cvc5
	$(CARGO) test --workspace --locked

scenarios: $(TESTED)
	$(TESTED) check $(MODELS) library/verification
	$(TESTED) test $(MODELS)
	sh library/verification/verify.sh $(TESTED) expected.txt

verify: $(GROUNDSTATE) ## the pattern library's properties in every state, its seeded faults found, the reference systems counted: minutes, 4 GB
	sh library/verification/verify.sh $(GROUNDSTATE) expected.txt expected-long.txt

cpp: ## the C++ runtime and the cameras: their tests as they are and under the sanitizers
	sh cpp/run.sh

systems: $(TESTED) ## programs generated from systems: run, held to their models, with faults put in
	sh cpp/systems/run.sh $(TESTED)

robot: $(TESTED) ## the robots: servo law, vision, kinematics, the controllers in closed loop, held to their models
	sh examples/robot.sh $(TESTED)

robot-sanitized: robot ## all four robots in closed loop under the sanitizers; `make robot` runs one under each
	sh examples/sanitized.sh thread visual_servoing object_tracking pick_and_place micro_assembly
	sh examples/sanitized.sh address visual_servoing object_tracking pick_and_place micro_assembly

fuzz: ## the fuzz targets, a minute each, guided by coverage; `make unit` tries the same on mutations
	sh fuzz/run.sh 60

bench: ## steps per second and peak memory; with CORPUS=path also of the public models with a reference
	$(CARGO) xtask bench $(if $(CORPUS),--corpus $(CORPUS)) $(if $(PEER),--peer $(PEER)) $(if $(TLC),--tlc $(TLC))

bench-cpp: ## what it costs to hand data over in C++, and to draw a simulated frame
	sh cpp/bench/run.sh

corpus: ## make corpus CORPUS=path: compare with recorded results of the public corpus, count charts, hold generated code to it
	@mkdir -p out/corpus
	$(CARGO) xtask corpus $(CORPUS) --scripts out/corpus/scripts
	$(CARGO) run --locked --profile quick --package generate --example folder -- $(CORPUS) \
	    --scripts out/corpus/scripts --log out/corpus/generated.log $(if $(EVERY),--every $(EVERY))

update: ## rewrite all golden expectations
	UPDATE_EXPECT=1 SNAPSHOTS=overwrite $(CARGO) test --workspace

clean: ## remove what was built
	$(CARGO) clean
	rm -rf out

# Cargo knows best what is up to date.
$(GROUNDSTATE): FORCE
	$(CARGO) build --release --locked --package cli
# As the tests are built: alone it would be given other features, and all below them be compiled twice.
$(TESTED): FORCE
	$(CARGO) test --workspace --locked --no-run
FORCE:
