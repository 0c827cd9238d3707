# make demo       a service, the press at the paper's clearances over HTTP, figures in demo/, stop
# make reproduce  the paper's figures and numbers beside ours: reproduction/report.html
# make test       everything that continuous integration checks
# make test-long  the tests that take longer
# make bench      measure speed on this machine
# make install    .venv with all packages (two minutes, 1.8 GB), and the integration loop compiled (half a minute)
# make docs       the documentation as a site: build/site/index.html
# make clean      remove what the others made
.DEFAULT_GOAL := help
SHELL := /bin/bash
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed

help:
	@grep -E '^# make' Makefile | cut -c3-

# The newest Python of 3.11 and up that really runs (a pyenv shim may not) and can make a
# virtual environment (Debian's python3 without python3-venv cannot). Bytecode is made on all
# processors, and without what dependencies test themselves with: pip takes one for it, and longer.
$(STAMP): pyproject.toml
	@set -e; if ! $(BIN)/python -m pip --version >/dev/null 2>&1; then \
	  for candidate in python3.15 python3.14 python3.13 python3.12 python3.11 python3; do \
	    if $$candidate -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; \
	    then chosen=$$candidate; break; fi; \
	  done; \
	  if [ -z "$$chosen" ]; then \
	    echo "jointplay needs Python 3.11 or newer with venv: install python3-venv (or python3.11-venv)."; exit 2; \
	  fi; \
	  echo "$$($$chosen --version) makes $(VENV)"; $$chosen -m venv --clear $(VENV); \
	fi; \
	echo "installing the packages into $(VENV) (two minutes, 1.8 GB; README says how to install less)"; \
	$(BIN)/python -m pip install --quiet --no-compile --disable-pip-version-check --editable '.[dev,xarray]'; \
	$(BIN)/python -W ignore -m compileall -qq -j 0 -x '/tests?/' $(VENV)/lib || true; \
	touch $(STAMP)

install: $(STAMP)
	@echo "compiling the integration loop (half a minute, once)"
	@$(BIN)/python -m jointplay.solver.kernels.compile_loop

demo: $(STAMP)
	@$(BIN)/jointplay demo seven-bar-press

reproduce: $(STAMP)
	@rm -rf reproduction
	@$(BIN)/jointplay reproduce -o reproduction

test: $(STAMP)
	@tests/page/install_chromium.sh & $(BIN)/python -m tests.everything; code=$$?; wait; exit $$code

test-long: $(STAMP)
	@$(BIN)/python -m tests.everything --long

bench: $(STAMP)
	@$(BIN)/python -m benchmarks

docs: $(STAMP)
	@$(BIN)/python -m mkdocs build --quiet
	@echo "build/site/index.html"

clean:
	rm -rf $(VENV) demo reproduction build *.egg-info .jointplay .mypy_cache .ruff_cache .pytest_cache .import_linter_cache .hypothesis

.PHONY: help install demo reproduce test test-long bench docs clean
