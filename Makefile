# make demo    walk the island, or render its main views if there is no display
# make test    check style and types, then run the tests
# make test-all  the same, with all cases of the tests of which `make test` runs only some
# make docs    build the site of the course in build/site; make docs-check looks at it in Chromium
# make test-drivers  draw views with OpenGL as other drivers have it: fewer units and extensions
# make peer    build a fly-over in C, and time it beside ours over one environment
# make fuzz    try damaged and random inputs for ten minutes
# make test-windows  try the commands and the tests on Windows, by Wine
# They install what they need on the first run.

SHELL := bash
BIN := .venv/bin
LINT := .venv-lint/bin
OUT ?= out
VIEWS := fig35a fig35b fig35c fig35d fig35e fig35f fig35g fig35h fig35i
# Further options for the program, for example: make demo ARGS="--preset 2006"
ARGS ?=

.PHONY: demo peer test test-all test-drivers test-windows lint docs docs-check fuzz bench assets clean

demo:
	@scripts/setup.sh demo
	@if scripts/setup.sh screen; then \
	    exec $(BIN)/landscape walk $(ARGS); \
	else \
	    echo "No display: rendering $(words $(VIEWS)) views to $(OUT)/"; \
	    $(BIN)/landscape render $(VIEWS) --out $(OUT) -q $(ARGS) && ls -1 $(VIEWS:%=$(OUT)/%.png); \
	fi

# The tests run even if the style or the types fail; the status is that of both. Style and types are
# checked while the package is installed and beside the tests, and told after them. Some tests wait
# for a window or a process: one more of them than there are processors keeps those busy.
PROCESSORS := $(shell nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)
WORKERS := $(shell echo $$(( ($(PROCESSORS) < 3 ? $(PROCESSORS) : 3) + 1 )))

test:
	@scripts/setup.sh lint || true
	@told=$$(mktemp); $(MAKE) --no-print-directory lint >$$told 2>&1 & lint=$$!; \
	scripts/setup.sh test || { failed=$$?; kill $$lint; rm -f $$told; exit $$failed; }; \
	$(BIN)/pytest -q -n $(WORKERS) --dist loadfile $(ALL); tests=$$?; \
	wait $$lint; lint=$$?; cat $$told; rm -f $$told; \
	[ $$tests -eq 0 ] || exit $$tests; \
	[ $$lint -eq 0 ] || { echo "The tests passed; the style or the types did not: make lint"; exit 1; }

test-all:
	@$(MAKE) --no-print-directory test ALL=--all

test-windows:
	@scripts/setup.sh test
	@$(BIN)/python scripts/desks/windows.py $(ARGS)

# For the other systems mypy leaves out what is installed, which has the same types there: this takes
# an eighth of the time. Each system has a cache of its own, or they would take turns in one.
lint:
	@scripts/setup.sh lint
	@$(LINT)/ruff check .
	@$(LINT)/ruff format --check .
	@$(LINT)/mypy framelens landscape
	@for system in win32 darwin; do \
	    $(LINT)/mypy --platform $$system --no-site-packages --ignore-missing-imports \
	        --cache-dir .mypy_cache/$$system framelens landscape || exit; \
	done

docs:
	@scripts/setup.sh docs
	@$(BIN)/python scripts/site build $(ARGS)

docs-check:
	@scripts/setup.sh docs-check
	@$(BIN)/python scripts/site check $(ARGS)

fuzz:
	@scripts/setup.sh test
	@$(BIN)/python scripts/fuzz $(ARGS)

test-drivers:
	@scripts/setup.sh test
	@$(BIN)/python scripts/desks/drivers.py $(ARGS)

# Another environment, for example: make peer ARGS=canyon
peer:
	@scripts/setup.sh demo
	@mkdir -p build/peer
	@$(BIN)/landscape flyover $(or $(ARGS),island) --export build/peer --fps 1 -q
	@$(CC) -O2 -o build/peer/flyover scripts/peer/flyover.c -lm
	@build/peer/flyover build/peer 1024 768 build/peer/last.pgm
	@$(BIN)/landscape flyover build/peer --bench --jobs 1 --set flyover.mirror=false

bench:
	@scripts/setup.sh demo
	@$(BIN)/landscape bench $(ARGS)

assets:
	@scripts/setup.sh studio
	@$(BIN)/landscape assets build $(ARGS)

clean:
	rm -rf .venv .venv-lint $(OUT) build dist .pytest_cache .mypy_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
