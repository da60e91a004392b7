# SPDX-License-Identifier: Apache-2.0
# make demo: install, build, and see it work.   make test: what each change must pass.
SHELL := /bin/bash
SECONDS_OF_DEMO := $(if $(filter environment command line,$(origin SECONDS)),--seconds $(SECONDS),)

.PHONY: help setup program build package container demo test test-all test-timing test-tsan tidy soak test-arm64 format fuzz bench-web figures clean

help:
	@echo "make demo               install what is needed, build, and meet two people in a streamed room"
	@echo "make demo SECONDS=20    the same, ending by itself"
	@echo "make test               build everything and run the checks that each change must pass (make test-all: all)"
	@echo "make test-all           the same with what takes long: fuzzing, TSan everywhere, clang-tidy"
	@echo "make test-timing        rates, ages and shaped links; needs a machine that does nothing else"
	@echo "make test-tsan          the modules that have threads under the thread sanitizer"
	@echo "make tidy               clang-tidy on what differs from main, on main from the last commit; SINCE=COMMIT, or ALL=1 for everything"
	@echo "make soak MINUTES=120   a recorded session under random faults; SEED=n repeats one"
	@echo "make test-arm64         tests of the SIMD kernels on emulated 64-bit ARM"
	@echo "make build              build/release/apps/theatron/theatron, and the browser client beside it"
	@echo "make package            Debian packages in build/packages: program, service, documentation"
	@echo "make container          an image of the program packages for podman or docker; needs root"
	@echo "make fuzz TIME=600      every fuzz target, TIME seconds each"
	@echo "make bench-web FOLDERS='DIR ...'   depth codecs natively and under node"
	@echo "make figures            repeat the sizes and likenesses that docs/ states, and compare; SLOW=1: also what takes many minutes"
	@echo "make format             clang-format over all sources"

setup:
	@tools/setup.sh

program: setup
	@tools/build.sh release theatron

build: program
	@tools/build.sh release manual theatron_bench
	@if command -v em++ > /dev/null; then tools/build.sh web page; \
	else echo "build: em++ is missing, so the host has no browser client"; fi

package: setup
	@tools/package.sh

container: package
	@tools/container.sh

demo: setup
	@tools/demo.sh $(SECONDS_OF_DEMO)

test: setup
	@tools/test.sh

test-all: setup
	@tools/test.sh --all

test-timing: build
	@tools/build.sh release
	@ctest --preset timing

test-tsan: setup
	@tools/test_tsan.sh $(MODULES)

tidy: setup
	@base=$$(git merge-base HEAD main); [ "$$base" != "$$(git rev-parse HEAD)" ] || base=HEAD^; \
	tools/tidy.sh $(if $(ALL),--all,$(or $(SINCE),$$base))

soak: build
	@tools/build.sh release link_shaper slow_disk capture_test
	@COUNT=1000 build/release/src/capture/capture_test --gtest_brief=1 --gtest_filter='DamagedRecording.*'
	@python3 tests/soak/soak.py --minutes $(or $(MINUTES),10) $(if $(SEED),--seed $(SEED))

test-arm64: setup
	@tools/test_arm64.sh

fuzz: setup
	@tools/fuzz.sh $(or $(TIME),60)

bench-web: setup
	@tools/bench_web.sh $(FOLDERS)

figures: build
	@tools/figures.py --program build/release/apps/theatron/theatron $(if $(SLOW),--slow)

format: setup
	@git ls-files '*.h' '*.cpp' '*.cu' | xargs clang-format -i

clean:
	rm -rf build demo
