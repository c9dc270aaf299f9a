# `make demo` and `make test` set up everything they need; tools/bootstrap says what that is.
venv := build/venv/bin
reedvalve := build/release/drivers/reedvalve/reedvalve
decks := table_3_4 film_tables gap_study film_gap_study film_fields film_edge response table_5
demo := results/demo
# Matplotlib keeps its font list here, not in the home folder, which need not exist.
export MPLCONFIGDIR := $(abspath build/matplotlib)

.PHONY: help demo test test-programs test-python wheel-test build deb bench lint format bootstrap checks clean
help:
	@echo "make demo      run the paper's cases, compare with its tables, write a report"
	@echo "make test      build, then run all tests"
	@echo "make build     build the program: $(reedvalve)"
	@echo "make deb       Debian packages: build/deb/packages"
	@echo "make bench     cases per second, beside other solvers; quick=1: less of it, in a minute"
	@echo "make lint      check format and style of the sources; make format puts them right"
	@echo "make debug-test, sanitize-test, valgrind-test    the tests in builds with more checks"
	@echo "make deb-test  the packages in a Debian of their own"
	@echo "make wheel-test    the Python package as pip installs it, in an environment of its own"
	@echo "make clean     remove build/ and results/"

bootstrap:
	@tools/bootstrap
checks:
	@tools/bootstrap checks

build: build-release
build-%: bootstrap
	@echo "== $* build"
	@cmake --preset $* >/dev/null
	@cmake --build --preset $* $(if $(target),--target $(target))

deb: checks build-deb
	@cpack --preset deb

demo:
	@$(MAKE) --no-print-directory build target=reedvalve_cli
	@mkdir -p $(demo)
	@for deck in $(decks); do $(reedvalve) run inputs/$$deck.nml -o $(demo)/$$deck --force || exit; done
	@$(venv)/python -m reedpost compare $(filter-out %/response,$(decks:%=$(demo)/%))
	@$(venv)/python -m reedpost plot $(decks:%=$(demo)/%)
	@$(venv)/python -m reedpost report $(decks:%=$(demo)/%) -o $(demo)/report.html >/dev/null
	@echo "The report: $(abspath $(demo)/report.html)"

test: build
	@echo "== tests: a few minutes; what they say comes when they are done"
	@$(MAKE) --no-print-directory --keep-going --jobs=2 --output-sync=target test-programs test-python
test-programs:
	@ctest --preset release; status=$$?; tools/skipped build/release; exit $$status
test-python:
	@REEDVALVE=$(abspath $(reedvalve)) $(venv)/python -m pytest -q postproc drivers/benchmarks drivers/python drivers/fmu

wheel-test: bootstrap
	@drivers/python/tests/wheel.sh

%-test: checks build-%
	ctest --preset $*; status=$$?; tools/skipped build/$*; exit $$status

bench: build
	@drivers/benchmarks/peers/build build/peers install
	@$(venv)/python drivers/benchmarks/benchmark.py $(if $(quick),--quick)

lint format: bootstrap
	@tools/$@

clean:
	rm -rf build results
