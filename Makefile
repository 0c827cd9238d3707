# make demo   the press end to end: install, start a service, simulate, fetch, draw, stop
# make test   everything that continuous integration checks
.DEFAULT_GOAL := help
SHELL := /bin/bash
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed

help:
	@grep -E '^# make' Makefile | cut -c3-

# the newest Python of 3.11 and up that can make a virtual environment
$(STAMP): pyproject.toml
	@set -e; if [ ! -x $(BIN)/python ]; then \
	  for version in 3.14 3.13 3.12 3.11; do \
	    python=$$(command -v python$$version || true); \
	    if [ -n "$$python" ] && $$python -c 'import venv, ensurepip' 2>/dev/null; then chosen=$$python; break; fi; \
	  done; \
	  if [ -z "$$chosen" ]; then echo "jointplay needs Python 3.11 or newer with venv: install the package python3-venv (or python3.11-venv)."; exit 2; fi; \
	  echo "using $$($$chosen --version)"; $$chosen -m venv $(VENV); \
	fi; \
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[dev]'; \
	touch $(STAMP)

install: $(STAMP)

clean:
	rm -rf $(VENV) demo build *.egg-info

.PHONY: help install clean
