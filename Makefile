# make demo    install, build the FMU, run the spindle co-simulation; results under out/
# make test    install with test tools and run the tests that take seconds: five minutes from nothing
# make heavy   the tests that take minutes
# make bits    compare the bits of kernels compiled in all ways; after a change in compiled/ or fmi/native/
# make lint    style, format, types and imports, checked by their tools
# make pages   the documentation: figures, tables, links, code of pages, and the site
# make soak    random walks with other draws for half an hour (SOAK=1800 s)
# make bench   time the fidelities beside other programs; writes docs/results/benchmark.md and .csv
# make tables  make the tables of docs/results again that another engine made, an hour of an idle machine
# make papers  run the papers' cases and write docs/papers; a quarter of an hour, kept under out/papers
# make measured  compare with what others measured; writes docs/measured.md, its figures and its tables
# make docs    make pages, then make site
# make site    build the documentation site into out/site; opens from the disk, works offline
# make wheels  one wheel per platform with compiled kernels inside, and a universal one, into out/wheels
# make wheel-check   look into these wheels, and use this machine's in a new environment without a compiler
# make release-fmus  the FMUs of the example scenes for the same platforms, into out/fmus
# make clean   remove what was made here

PYTHON ?= python3
VENV ?= .venv
OUT ?= out
JOBS ?= 2

BIN := $(VENV)/bin
# Not compiled by pip: Python compiles a module when it is first imported, most never are.
PIP := $(BIN)/python -m pip install --quiet --no-compile --disable-pip-version-check --constraint constraints.txt
SCENE := examples/scenes/7003C-spindle.toml
SPINDLE := examples/spindle_cosimulation
BEARING := $(OUT)/Bearing7003C.fmu
SOURCES := $(shell find fmu_bearing modelDescription -type f ! -name '*.pyc' 2>/dev/null)

# Two test workers on two cores: linear algebra libraries must not start threads of their own.
test heavy bits lint pages soak tables papers measured: export OPENBLAS_NUM_THREADS = 1
# No process has to compile sources again that one before it has imported, whatever the user's shell says.
export PYTHONDONTWRITEBYTECODE =

# .ci/run holds skipped tests against a list.
SKIPS ?=

.PHONY: demo test heavy bits lint pages soak bench tables papers measured docs site kernels compiled wheels \
	wheel-check release-fmus fresh-tables clean
.DELETE_ON_ERROR:

demo: $(BEARING) $(OUT)/SpindleMotor.fmu
	$(BIN)/python $(SPINDLE)/cosimulate.py --fmu-dir $(OUT) --output-dir $(OUT)

$(BEARING): $(VENV)/.installed build_fmu.py $(SCENE) $(SOURCES)
	@mkdir -p $(OUT)
	$(BIN)/python build_fmu.py $(SCENE) -o $@ --only-here

# One call writes both, the motor last.
$(OUT)/SpindleMotor.fmu: $(VENV)/.installed $(wildcard $(SPINDLE)/*.py $(SPINDLE)/native/*)
	@mkdir -p $(OUT)
	$(BIN)/python $(SPINDLE)/build.py --output-dir $(OUT)

# Kernels are compiled once, before the parallel tests share them. Without a C compiler there is no library
# for FMUs; tests of it then say so.
# Files stay together: what a file compiles or prepares for itself is made by one worker, not by each. Those that
# took longest go first (tests/order.py); TIMES=--measure-times measures them again.
TIMES ?=
test: kernels
	$(BIN)/python -m pytest -n $(JOBS) --dist loadfile --no-loadscope-reorder \
		-m "not heavy and not bits and not lint and not pages" \
		--times tests/times/quick.txt $(TIMES) $(SKIPS)

heavy: kernels
	HYPOTHESIS_PROFILE=many $(BIN)/python -m pytest -n $(JOBS) --dist loadfile --no-loadscope-reorder -m heavy \
		--times tests/times/heavy.txt $(TIMES) $(SKIPS)

# One worker: the compilers that it starts go side by side.
bits: kernels
	$(BIN)/python -m pytest -m bits $(SKIPS)

lint: $(VENV)/.installed-test
	$(BIN)/python -m pytest -n $(JOBS) -m lint $(SKIPS)

pages: kernels
	$(BIN)/python -m pytest -n $(JOBS) --dist loadfile --no-loadscope-reorder -m "pages and not heavy" \
		--times tests/times/pages.txt $(TIMES) $(SKIPS)

# What fails is printed with the draw that shows it.
SOAK ?= 1800
soak: kernels
	HYPOTHESIS_PROFILE=soak timeout $(SOAK) sh -c 'while $(BIN)/python -m pytest -n $(JOBS) -q -m "heavy or not heavy" \
		tests/extremes/test_random_walk.py tests/scene/test_scenes.py tests/native/test_shim_values.py; do :; done'; \
		test $$? -eq 124

# A quarter of an hour of one core; on a machine that does nothing else.
bench: $(VENV)/.installed-bench compiled
	$(BIN)/python -m benchmarks.run --output docs/results

# Interrupted, it goes on from what is under out/papers.
papers: compiled
	$(BIN)/python -m examples.papers.run --jobs $(JOBS)

# Those that another engine made, an hour of an idle machine; interrupted, it goes on with the first that is left.
tables: $(VENV)/.installed-bench compiled
	$(BIN)/python -m benchmarks.tables

# Three minutes of one core.
measured: compiled
	$(BIN)/python -m benchmarks.measured.run

# References are made from the code here, so it is installed too.
SITE ?= $(OUT)/site
docs: pages
	@$(MAKE) --no-print-directory site
site: $(VENV)/.installed-docs
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --quiet --config-file docs/site/mkdocs.yml --site-dir $(abspath $(SITE))
	@echo "open $(SITE)/index.html"

# The universal wheel last: it and the source distribution compile on first use.
PLATFORMS ?= linux64 aarch64-linux win64 darwin64 aarch64-darwin
wheels: $(VENV)/.installed-test
	@rm -rf $(OUT)/prebuilt && mkdir -p $(OUT)/wheels
	for platform in $(PLATFORMS); do \
		$(BIN)/python -m fmu_bearing.fmi.native.prebuilt $(OUT)/prebuilt/$$platform $$platform || exit 1; \
		FMU_BEARING_PREBUILT=$(abspath $(OUT))/prebuilt/$$platform \
			$(BIN)/python -m pip wheel --quiet --no-deps --wheel-dir $(OUT)/wheels . || exit 1; \
	done
	$(BIN)/python -m pip wheel --quiet --no-deps --wheel-dir $(OUT)/wheels .

# Needs Python alone, nothing of this repository's environment; on Windows and macOS, too.
wheel-check:
	$(PYTHON) -m tests.compiled.first_use $(OUT)/wheels

EXAMPLES := $(wildcard examples/scenes/*.toml)
FMUS := $(patsubst examples/scenes/%.toml,$(OUT)/fmus/%.fmu,$(EXAMPLES))
release-fmus: fresh-tables $(FMUS)
# A release has no table of another engine.
fresh-tables: $(VENV)/.installed-test
	$(BIN)/python -m benchmarks.tables --stale
$(FMUS): $(OUT)/fmus/%.fmu: examples/scenes/%.toml $(VENV)/.installed-test build_fmu.py $(SOURCES)
	@mkdir -p $(OUT)/fmus
	$(BIN)/python build_fmu.py $< -o $@ --platforms $(subst $() $(),$(comma),$(PLATFORMS))
comma := ,

# While pip installs the test tools, kernels are compiled with what is there: on two cores at the same time.
kernels: $(VENV)/.installed
	@$(MAKE) --no-print-directory -j 2 $(VENV)/.installed-test compiled

compiled: $(VENV)/.installed
	$(BIN)/fmu-bearing warm-up

# Stamps: pip runs again only when the requirements change.
# The demo and the papers draw pictures; rings of the papers' bearings bend.
$(VENV)/.installed: pyproject.toml constraints.txt | $(BIN)/python
	$(PIP) --editable ".[elastic,plots]"
	@touch $@

$(VENV)/.installed-test: pyproject.toml constraints.txt | $(VENV)/.installed
	$(PIP) --editable ".[test]"
	@touch $@ $(VENV)/.installed

$(VENV)/.installed-bench: pyproject.toml constraints.txt | $(BIN)/python
	$(PIP) --editable ".[bench]"
	@touch $@ $(VENV)/.installed

$(VENV)/.installed-docs: pyproject.toml constraints.txt | $(BIN)/python
	$(PIP) --editable ".[docs]"
	@touch $@ $(VENV)/.installed

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

clean:
	rm -rf $(VENV) $(OUT) .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
