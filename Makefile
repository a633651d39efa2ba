# What a newcomer runs: `make render`, `make test`. What takes longer: `make validate`, `make validation`, `make compare-cycles`, `make same-bits`,
# `make bench`, `make bench-peers`, `make bench-caustics`. `make docs` writes the site of the documentation. Other systems: `make cross-check`,
# `make arm`, `make wheels`.

PYTHON ?= python3.11
VENV := $(CURDIR)/.venv
BIN := $(VENV)/bin
export VIRTUAL_ENV := $(VENV)
export PYO3_PYTHON := $(BIN)/python

# Blender as a Python package, in the versions that Python 3.11 can load.
BPY := $(CURDIR)/.venv-bpy45 $(CURDIR)/.venv-bpy50

FUZZED := ies ldt tm33 goniogram gldf gldf-product l3d l3d-structure gdtf gdtf-description rays weather merl utia rgl pbrdf bsdf-xml zemax gbsdf measured polygons

.PHONY: fuzz build dev render extension blender cross-check arm wheels lint-workflows test test-levels test-quick test-rust test-python test-blender lint compare-cycles validation validate same-bits bench bench-peers bench-caustics docs clean

# The Python environment with everything that building and testing wants.
$(VENV)/ready: pyproject.toml Makefile
	command -v $(PYTHON) >/dev/null && $(PYTHON) -m venv $(VENV) || python3 -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip
	$(BIN)/python -m pip install --quiet "maturin>=1.9,<2" "usd-core>=25.5" "materialx>=1.39,<2" "ifcopenshell>=0.8.1" "pyoidn>=2.5,<3" "PySide6-Essentials>=6.6" numpy pytest pytest-timeout pytest-xdist openexr mypy
	touch $@

# The wheel of this machine, which the gate's tests install everywhere, so that the engine's code is generated once.
build: $(VENV)/ready
	rm -rf dist/here
	$(BIN)/maturin build --release --quiet --compatibility linux --out dist/here
	$(BIN)/python -m pip install --quiet --force-reinstall --no-deps dist/here/*.whl

# The quick build into .venv: the scalar level and this machine's own one; Python sources are used where they stand.
dev: $(VENV)/ready
	$(BIN)/maturin develop --profile quick --features gonio-simd/own-level --quiet

# The tests of one crate (CRATE=gonio-bsdf), or of those over the public API, from the quick build.
CRATE ?= gonio-tests
test-quick:
	cargo test --profile quick --features gonio-simd/own-level --quiet -p $(CRATE)

# The quick build has this machine's SIMD level and the scalar one; `make test` builds the wheel with all of them.
render: dev
	mkdir -p out
	$(BIN)/gonio render examples/usd/office.usda -o out/office.exr -o out/office.png --aov color,luminance,illuminance --spp 16 --denoise --exposure 0.7
	@echo "The picture is out/office.png, denoised; radiance, and luminance (cd/m2) and illuminance (lx) as rendered, are in out/office.exr."

# A linker that knows old C libraries.
$(VENV)/zig: $(VENV)/ready
	$(BIN)/python -m pip install --quiet ziglang
	touch $@

# The Blender extension: one zip, the wheel inside, for every system that Blender itself runs on.
extension: $(VENV)/zig
	rm -rf dist/wheels
	PATH="$(BIN):$$PATH" $(BIN)/maturin build --release --quiet --zig --compatibility manylinux_2_28 --out dist/wheels
	$(BIN)/python blender-addon/build.py dist/wheels/*.whl --output-dir dist

$(CURDIR)/.venv-bpy45/ready: VERSION := 4.5.15
$(CURDIR)/.venv-bpy50/ready: VERSION := 5.0.1
$(addsuffix /ready,$(BPY)):
	command -v $(PYTHON) >/dev/null && $(PYTHON) -m venv $(@D) || python3 -m venv $(@D)
	$(@D)/bin/python -m pip install --quiet bpy==$(VERSION) numpy pytest
	touch $@

test: lint build test-rust test-python test-levels test-blender

lint:
	cargo fmt --all --check
	cargo clippy --release --quiet --workspace --all-targets -- --deny warnings

# Whether the workspace compiles for Linux on ARM, macOS and Windows (SYSTEMS="linux-arm64 macos-arm64 windows-x64" chooses); brings a compiler
# for them where there is none.
cross-check:
	tests/cross/check.sh $(SYSTEMS)

# The NEON level in an emulator: tests of lanes and of traversal, and a picture beside the one of this machine, in out/arm.
arm: build
	GONIO_PYTHON=$(BIN)/python tests/cross/arm.sh

# Wheels and extension zips for every system, in dist/wheels and dist, and what is in them; SYSTEMS as above, and linux-x64.
wheels:
	tests/cross/wheels.sh $(SYSTEMS)

# The workflows of the hosted CI: their form, and what could be misused in them.
lint-workflows: $(VENV)/ready
	$(BIN)/python -m pip install --quiet "zizmor>=1.32" "check-jsonschema>=0.39"
	$(BIN)/check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yml
	$(BIN)/zizmor --quiet --offline .github/workflows

test-rust: $(VENV)/ready
	cargo test --release --quiet --workspace --exclude gonio-python

# Two files at a time: starting processes and reading files leaves cores idle.
AT_ONCE := --numprocesses 2 --dist loadfile

test-python: build
	$(BIN)/python -m pytest $(AT_ONCE) tests/python tests/usd tests/cli tests/docs

# What renders at every level of this machine, as other machines would, and on one core.
LEVELS := scalar sse4.2 avx2
test-levels: build
	$(BIN)/python tests/cross/smoke.py
	for level in $(LEVELS); do GONIO_SIMD=$$level $(BIN)/python -m pytest --quiet tests/python/test_render.py tests/python/test_scene.py || exit 1; done
	taskset -c 0 $(BIN)/python -m pytest --quiet tests/python/test_render.py tests/python/test_scene.py

# The extension for this machine alone, with the wheel of `build`, in both versions of Blender.
blender: build $(addsuffix /ready,$(BPY))
	$(BIN)/python blender-addon/build.py dist/here/*.whl --output-dir dist
	for venv in $(BPY); do $$venv/bin/python -m pip install --quiet --force-reinstall --no-deps dist/here/*.whl || exit 1; done

# Both versions of Blender; the tests of a file share a process, which starts anew after a failure.
test-blender: blender
	$(BIN)/python -m pytest $(AT_ONCE) tests/blender -m "not validate"

# The same files in Cycles and in gonio, block by block; pictures and figures in out/compare-cycles/index.html.
compare-cycles: blender
	GONIO_BPY=$(CURDIR)/.venv-bpy50/bin/python $(BIN)/python -m pytest tests/blender/compare_cycles -m validate

# Light against closed forms and independent integrals; docs/validation.md is written of what was measured, whether it holds or not.
validation: blender
	rm -rf out/validation
	GONIO_BPY=$(CURDIR)/.venv-bpy50/bin/python $(BIN)/python -m pytest tests/validate/lighting tests/validate/goniometer tests/blender/test_lamps_lux.py -m validate; \
	    held=$$?; $(BIN)/python tests/validate/lighting/page.py && exit $$held

# Every reader of untrusted files, ten minutes each.
fuzz:
	cargo build --release --quiet -p gonio-formats --example fuzz
	for reader in $(FUZZED); do cargo run --release --quiet -p gonio-formats --example fuzz -- $$reader 600 || exit 1; done
	cargo run --release --quiet -p gonio-volume --example fuzz -- 600
	for kind in hbjson rad; do cargo run --release --quiet -p gonio-models --example fuzz -- $$kind 600 || exit 1; done

# The long checks: all luxtest frames, kill tests, other renderers where they can be had, Blender's export timed. Suites whose files have the same names
# run one after the other.
LONG := -m "validate or not validate" --timeout 1800
validate: test-blender compare-cycles validation fuzz
	$(BIN)/python -m pytest tests/python tests/usd tests/cli $(LONG)
	$(BIN)/python -m pytest tests/validate $(LONG) --ignore tests/validate/lighting --ignore tests/validate/goniometer
	$(BIN)/python -m pytest tests/peers $(LONG)
	$(BIN)/python -m pytest tests/blender $(LONG) --ignore tests/blender/compare_cycles --ignore tests/blender/test_lamps_lux.py
	cargo test --release --quiet --workspace --exclude gonio-python -- --include-ignored

# Two builds, each by the Python that has it, show twelve scenes with the same bits at every SIMD level.
same-bits: AFTER ?= $(BIN)/python
same-bits:
	$(BEFORE) tests/validate/same_bits/compare.py --before $(BEFORE) --after $(AFTER)

# Every stage at every SIMD level against one lane; docs/performance.md tells what the rows mean.
bench:
	cargo bench -p gonio-bench

# Needs Debian's libembree-dev and libllvm19 (15 aborts on processors with AVX-512; DRJIT_LIBLLVM_PATH names another copy), and a C compiler.
# The page of the pictures is out/peers/index.html, how paths grow with scenes out/peers/scaling.svg; PEERS="--seconds 60" makes them longer.
# Illuminances beside Radiance: out/peers/radiance.svg; RADIANCE=--write-docs puts the figures into docs/radiance.md. Pictures by wavelength:
# out/peers/spectral-cost.md, and what wavelengths cost beside red, green and blue: out/peers/spectral-price.md.
bench-peers: export DRJIT_LIBLLVM_PATH ?= /usr/lib/x86_64-linux-gnu/libLLVM.so.19.1
bench-peers: build $(CURDIR)/.venv-bpy50/ready
	cd tests/peers/embree && cargo run --release && cargo run --release -- curves
	$(BIN)/python tests/validate/environments.py mitsuba radiance
	$(BIN)/python tests/peers/render/bench.py $(PEERS)
	$(BIN)/python tests/peers/render/scaling.py
	$(BIN)/python tests/peers/radiance/bench.py $(RADIANCE)
	$(BIN)/python tests/peers/spectral/bench.py
	$(BIN)/python tests/peers/spectral/price_bench.py

# Error at equal time on six scenes full of caustics, beside Cycles, LuxCore and Mitsuba, in out/peers/caustics; needs what bench-peers needs.
# References that are missing are made first, in minutes each. CAUSTICS="pool --seconds 20" chooses; GONIO_CAUSTICS="name=value,..." has
# the settings of gonio with light paths. A rainbow beside LuxCore: out/peers/prism.md.
bench-caustics: export DRJIT_LIBLLVM_PATH ?= /usr/lib/x86_64-linux-gnu/libLLVM.so.19.1
bench-caustics: build $(CURDIR)/.venv-bpy50/ready
	$(BIN)/python tests/validate/environments.py mitsuba luxcore
	$(CURDIR)/.venv-mitsuba/bin/python tests/peers/caustics/references.py
	$(BIN)/python tests/peers/caustics/direct.py --seconds 20
	$(BIN)/python tests/peers/caustics/bench.py $(CAUSTICS)
	$(CURDIR)/.venv-mitsuba/bin/python tests/peers/caustics/rays.py
	$(BIN)/python tests/peers/spectral/prism_bench.py

DOCS := $(CURDIR)/.venv-docs
$(DOCS)/ready:
	command -v $(PYTHON) >/dev/null && $(PYTHON) -m venv $(@D) || python3 -m venv $(@D)
	$(@D)/bin/python -m pip install --quiet "mkdocs-material>=9.6,<10"
	touch $@

# The site, out/site/index.html: guide, reference, and a gallery that is rendered. GONIO_PYTHON names another Python that has gonio.
docs: export GONIO_PYTHON ?= $(BIN)/python
docs: export NO_MKDOCS_2_WARNING := 1
docs: $(DOCS)/ready
	$(GONIO_PYTHON) -c "import gonio" 2>/dev/null || $(MAKE) build
	$(GONIO_PYTHON) docs/site/gallery.py
	$(DOCS)/bin/mkdocs build --strict -f docs/site/mkdocs.yml
	@echo "The site is out/site/index.html."

clean:
	cargo clean
	rm -rf $(VENV) $(BPY) $(DOCS) out dist
