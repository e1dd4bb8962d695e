# make demo     writes the virtual campaign into demo/ and runs it: open demo/report/index.html
# make test     style, types, import rules and tests: what a change is checked with
# make test-all that, and the wheel, README typed in order, Dask, kills, planted faults, browser and documentation
# make slow     the slow tests: seeds 0-19 of the virtual campaign, MuJoCo, benchmarks, other laboratories' files
# make drill    500 kills, full and read-only disks (as root), two runs at once, damaged hostile files: two hours
# make docs     builds the documentation: open docs/build/html/index.html
# make study NAME=restitution  repeats one study with known truth, into reports/restitution-study.md; see STUDIES
# make reports  rebuilds the reference reports in reports/ and the pictures of README and tutorial
# make reproduce  repeats the paper on the virtual shake table, statement by statement: reports/manos, a quarter of an hour
# make format   rewrites the sources in the project's style
# make release VERSION=1.2.3  checks and builds a release, commits and tags it here; uploads nothing
# make clean    removes what the other targets made
#
# Written for GNU make 3.81 (macOS) and later. README.md says what to type without make.

PYTHONS := python3.14 python3.13 python3.12 python3.11 python3 python
FITS := import sys, venv, ensurepip; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))
BIN := .venv/bin
DEMO_INSTALLED := .venv/installed-demo
INSTALLED := .venv/installed
SLOW_INSTALLED := .venv/installed-slow
DOCS_INSTALLED := .venv/installed-docs
RELEASE_INSTALLED := .venv/installed-release
# Files of tests are shared out over the cores, each file to one of them, where it computes in one thread.
TESTED := OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest --numprocesses logical --maxprocesses 4 --dist loadfile \
  --no-loadscope-reorder --durations=10
# 5000 records (three minutes on two cores); 1000 tests judged by their spread (six); 480 tests forecast and scored
# (two); 3000 sets of records (a quarter of an hour).
STUDIES := restitution verdict forecast fragility

# Each command and worker starts several seconds sooner if Python keeps the bytecode of what it has imported.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: demo test test-all slow drill docs study reports reproduce format release clean

demo: $(DEMO_INSTALLED)
	@$(BIN)/colonnade demo demo

define CHECKED
$(BIN)/ruff check
$(BIN)/ruff format --check
$(BIN)/mypy
$(BIN)/lint-imports
endef

test: $(INSTALLED)
	$(CHECKED)
	$(TESTED)

test-all: docs
	$(CHECKED)
	$(TESTED) -m "not slow and not drill"

slow: $(SLOW_INSTALLED)
	$(BIN)/python -m pytest -m slow

drill: $(INSTALLED)
	$(BIN)/python -m pytest tests/drill -m drill

docs: $(DOCS_INSTALLED)
	$(BIN)/python -m sphinx -c docs -b html -W --keep-going -j 2 -q . docs/build/html

study: $(INSTALLED)
	@$(if $(filter $(NAME),$(STUDIES)),,echo "Choose one of: $(STUDIES:%=make study NAME=%;)"; exit 2)
	$(BIN)/python reports/$(NAME)_study.py

format: $(INSTALLED)
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

reports: $(INSTALLED)
	$(BIN)/python reports/rebuild.py
	$(BIN)/python reports/fault_atlas.py
	$(BIN)/python reports/verification.py
	$(BIN)/python reports/tutorial_pictures.py

reproduce: $(INSTALLED)
	$(BIN)/python reports/reproduce.py

release: $(RELEASE_INSTALLED)
	@$(BIN)/python tools/release.py "$(VERSION)" $(PYTHONS) --fits "$(FITS)"

clean:
	rm -rf .venv build demo dist docs/build docs/gallery docs/reference/generated .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache
	find pipeline tests -name __pycache__ -type d -prune -exec rm -rf {} +

# An interpreter counts if it runs, is 3.11 to 3.14 and can make an environment; being on the PATH is not enough
# (version managers leave stubs there). Installed again only when pyproject.toml is newer. The demo installs only what
# it needs; the tests add linters and the packages they compare with, the slow ones also heyoka and MuJoCo. Packages are
# compiled when they are first imported: most modules never are.
$(DEMO_INSTALLED): EXTRAS := demo
$(INSTALLED): EXTRAS := demo,test
$(SLOW_INSTALLED): EXTRAS := demo,test,bench
$(DOCS_INSTALLED): EXTRAS := demo,test,docs
$(RELEASE_INSTALLED): EXTRAS := demo,test,release
$(DEMO_INSTALLED) $(INSTALLED) $(SLOW_INSTALLED) $(DOCS_INSTALLED) $(RELEASE_INSTALLED): pyproject.toml
	@if ! $(BIN)/python -c "$(FITS)" >/dev/null 2>&1; then \
	  chosen=; \
	  for python in $(PYTHONS); do \
	    if $$python -c "$(FITS)" >/dev/null 2>&1; then chosen=$$python; break; fi; \
	  done; \
	  if [ -z "$$chosen" ]; then \
	    echo "colonnade needs Python 3.11, 3.12, 3.13 or 3.14 with venv, and found none. Type this line, then make again:"; \
	    if command -v brew >/dev/null 2>&1; then echo "  brew install python@3.13"; \
	    elif command -v apt-get >/dev/null 2>&1; then \
	      for version in 3.13 3.12 3.11 3; do \
	        if apt-cache show python$$version-venv >/dev/null 2>&1; then break; fi; \
	      done; \
	      echo "  sudo apt-get install python$$version-venv"; \
	    elif command -v dnf >/dev/null 2>&1; then echo "  sudo dnf install python3.13"; \
	    elif command -v zypper >/dev/null 2>&1; then echo "  sudo zypper install python313"; \
	    elif command -v pacman >/dev/null 2>&1; then echo "  sudo pacman -S python"; \
	    else echo "  open https://www.python.org/downloads/"; fi; \
	    exit 1; \
	  fi; \
	  echo "Making .venv with $$chosen ($$($$chosen --version))"; \
	  $$chosen -m venv --clear .venv || exit 1; \
	fi
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile --editable ".[$(EXTRAS)]"
	@touch $(DEMO_INSTALLED) $@
