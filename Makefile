# hybridmesh: GNU make. `make help` lists the targets.

VERSION    := $(shell sed -n 's/^.define HM_VERSION "\(.*\)"/\1/p' libcommon/hm_cli.h)
PREFIX     ?= /usr/local
PROGPREFIX ?=
DESTDIR    ?=
SANITIZE   ?=
CC         ?= cc
CFLAGS     ?= -O2 -g

# The seven programs of the scheme need libc, libm and threads, nothing else.
SCHEME     := bsgrid slope breaklines bsmesh trimesh stitch quality
COMPANIONS := georef hmconv hmdraw

# hmdraw draws with cairo, georef computes with GeographicLib, which is C++; without them all other
# programs are built. hmconv reads GeoJSON by jansson; without it, all else.
CAIRO_CFLAGS := $(shell pkg-config --cflags cairo 2>/dev/null)
CAIRO_LIBS   := $(shell pkg-config --libs cairo 2>/dev/null)
GEOD_CFLAGS  := $(shell pkg-config --cflags geographiclib 2>/dev/null)
GEOD_LIBS    := $(if $(shell command -v $(CXX)),$(shell pkg-config --libs geographiclib 2>/dev/null))
JSON_CFLAGS  := $(shell pkg-config --cflags jansson 2>/dev/null)
JSON_LIBS    := $(shell pkg-config --libs jansson 2>/dev/null)
MISSING      := $(if $(CAIRO_LIBS),,hmdraw) $(if $(GEOD_LIBS),,georef)
PROGRAMS     := $(SCHEME) $(filter-out $(MISSING),$(COMPANIONS))

B := build$(if $(SANITIZE),/san)
Q := $(if $(V),,@)
# Targets that build before they run do so on all cores, unless make was told how many.
JOBS = $(if $(filter -j%,$(MAKEFLAGS)),,-j$(shell nproc))

# -ffp-contract=off: the exact predicates depend on every operation being rounded by itself.
WARN   := -Wall -Wextra -Wshadow -Wconversion -Wmissing-prototypes
SANFLAGS := $(if $(SANITIZE),-fsanitize=$(SANITIZE) -fno-sanitize-recover=all -fno-omit-frame-pointer)
HM_CFLAGS  = -std=c11 -D_POSIX_C_SOURCE=200809L -D_FILE_OFFSET_BITS=64 -ffp-contract=off -pthread \
             $(WARN) $(SANFLAGS) -Ilibcommon -MMD -MP $(CPPFLAGS) $(CFLAGS)
CXXFLAGS ?= -O2 -g
HM_CXXFLAGS = -std=c++17 -D_FILE_OFFSET_BITS=64 -ffp-contract=off -pthread -Wall -Wextra -Wshadow \
             -Wconversion $(SANFLAGS) -Ilibcommon $(GEOD_CFLAGS) -MMD -MP $(CPPFLAGS) $(CXXFLAGS)
HM_LDFLAGS = -pthread $(SANFLAGS) $(LDFLAGS)

LIB       := $(B)/libhm.a
LIB_OBJ   := $(patsubst libcommon/%.c,$(B)/obj/%.o,$(wildcard libcommon/*.c))
BIN       := $(PROGRAMS:%=$(B)/bin/%)
GEN       := $(patsubst tests/gen/%.c,$(B)/test/%,$(wildcard tests/gen/*.c))
UNIT      := $(patsubst tests/unit/%.c,$(B)/test/%,$(wildcard tests/unit/test_*.c))
BENCH     := $(patsubst tests/bench/bench_%.cc,%,$(wildcard tests/bench/bench_*.cc))
BENCH_SH  := $(patsubst tests/bench/bench_%.sh,%,$(wildcard tests/bench/bench_*.sh))
# A target for each format that hmconv imports, all from one source.
IMPORTED  := $(shell sed -n 's/^    {"\([a-z0-9]*\)", hm_import_is_.*/\1/p' libcommon/hm_import.c)
FUZZ      := $(B)/fuzz/fuzz_reader $(B)/fuzz/fuzz_tri $(IMPORTED:%=$(B)/fuzz/fuzz_import_%)

SOURCES   := $(sort $(wildcard libcommon/*.[ch] libcommon/*.cpp tools/*.[ch] tools/*/*.[ch] tests/*/*.[ch] tests/*/*/*.[ch]))

.PHONY: all help deps demo casestudies pictures check check-long check-san fuzz bench lint install dist deb \
        clean FORCE
.DELETE_ON_ERROR:

all: $(BIN)
	$(Q)$(if $(CAIRO_LIBS),:,echo "hmdraw is not built: it needs cairo (make deps installs it)")
	$(Q)$(if $(JSON_LIBS),:,echo "hmconv reads no GeoJSON: it needs jansson (make deps installs it)")
	$(Q)$(if $(GEOD_LIBS),:,echo "georef is not built: it needs g++ and GeographicLib (make deps installs them)")

help:
	@sed -n 's/^#: //p' Makefile

#: make            build all programs in build/bin
#: make demo       the whole chain on a generated survey, pictures and all, in ./demo
#:                 (POINTS=survey.xyz LINES=lines.txt: the same with your own data)
#: make check      all tests that take under two minutes (TESTS=tests/x.t: that one)
#: make check-long the longer ones;  make check-san: make check under ASan and UBSan
#: make fuzz       fuzz targets (SECONDS=600 each, there are twelve; needs clang)
#: make bench      all benchmarks; bench-NAME for one
#: make casestudies: the paper's case studies with pictures and a table of goals, in ./casestudies
#: make pictures those of the classroom case, in build/classroom, and of the README (this needs Chromium)
#: make lint       format, static checks, man pages
#: make deps       install missing Debian packages (root, or sudo without a password)
#: make install    DESTDIR= PREFIX=/usr/local PROGPREFIX=
#: make dist       the sources in build/hybridmesh-VERSION.tar.gz;  make deb: a Debian package

$(B)/obj/%.o: libcommon/%.c
	@mkdir -p $(@D)
	$(if $(Q),@echo "  CC      $<")
	$(Q)$(CC) $(HM_CFLAGS) -c -o $@ $<

$(LIB): $(LIB_OBJ)
	$(if $(Q),@echo "  AR      $@")
	$(Q)rm -f $@ && $(AR) rcs $@ $^

# Needed by hmconv alone: who does not import, does not link jansson.
$(B)/obj/hm_import_geojson.o $(B)/fuzz/obj/hm_import_geojson.o: HM_CFLAGS += $(if $(JSON_LIBS),-DHM_JANSSON $(JSON_CFLAGS))

# The one file in C++, linked to georef alone: libhm.a is free of it.
$(B)/obj/hm_geod.o: libcommon/hm_geod.cpp
	@mkdir -p $(@D)
	$(if $(Q),@echo "  CXX     $<")
	$(Q)$(CXX) $(HM_CXXFLAGS) -c -o $@ $<

# A program too long for one file has its other files in a folder of its name.
.SECONDEXPANSION:
$(B)/bin/hmdraw: EXTRA_CFLAGS = $(CAIRO_CFLAGS)
$(B)/bin/hmdraw: EXTRA_LIBS = $(CAIRO_LIBS)
$(B)/bin/hmconv: EXTRA_LIBS = $(JSON_LIBS)
$(B)/bin/hmdraw: $(B)/gen/view3d.c
$(B)/bin/georef: $(B)/obj/hm_geod.o
$(B)/bin/georef: EXTRA_LIBS = $(B)/obj/hm_geod.o $(GEOD_LIBS) -lstdc++
$(B)/bin/%: tools/%.c $$(wildcard tools/$$*/*.[ch]) $(LIB)
	@mkdir -p $(@D)
	$(if $(Q),@echo "  LD      $@")
	$(Q)$(CC) $(HM_CFLAGS) $(EXTRA_CFLAGS) -o $@ $(filter %.c,$^) $(LIB) $(HM_LDFLAGS) $(EXTRA_LIBS) -lm

# The page of hmdraw -3: page.html with the files that it refers to in their places, as a C array.
VIEW3D := tools/hmdraw/view3d
$(B)/gen/view3d.html: tools/hmdraw/inline.awk $(wildcard $(VIEW3D)/*)
	@mkdir -p $(@D)
	$(Q)awk -v dir=$(VIEW3D) -f $< $(VIEW3D)/page.html >$@
$(B)/gen/view3d.c: $(B)/gen/view3d.html
	$(Q){ echo 'extern const char view3d_page[];'; echo 'const char view3d_page[] = {'; \
	    od -An -v -tx1 $< | sed "s/ *\([0-9a-f][0-9a-f]\)/'\\\\x\1',/g"; echo '0};'; } >$@

define test_program
$(B)/test/%: $(1)/%.c $$$$(wildcard $(1)/$$$$*/*.[ch]) $(LIB)
	@mkdir -p $$(@D)
	$$(if $$(Q),@echo "  LD      $$@")
	$$(Q)$$(CC) $$(HM_CFLAGS) -Itests/unit -o $$@ $$(filter $(1)/%.c,$$^) $$(LIB) $$(HM_LDFLAGS) -lm
endef
$(eval $(call test_program,tests/unit))
$(eval $(call test_program,tests/gen))

# Calls that fail, for tests/faults.t.
FAULT     := $(B)/test/fault.so
$(FAULT): tests/preload/fault.c
	@mkdir -p $(@D)
	$(if $(Q),@echo "  LD      $@")
	$(Q)$(CC) -std=gnu11 -O2 -fPIC -shared $(WARN) -o $@ $<

# A shell exports LINES, the height of its terminal: only one given to make is meant.
DEMO_LINES := $(if $(filter command,$(origin LINES)),$(LINES))

demo: deps-quiet
	$(Q)$(MAKE) $(JOBS) --no-print-directory all $(GEN)
	$(Q)B=$(CURDIR)/$(B) POINTS='$(POINTS)' LINES='$(DEMO_LINES)' D='$(D)' tests/demo

# A picture of every stage of the classroom case in hybridmesh(7), and those of the README, from the demo.
pictures: demo
	$(Q)PATH=$(CURDIR)/$(B)/bin:$$PATH tests/classroom/pictures $(B)/classroom
	$(Q)tests/deps browser quiet
	$(Q)$(B)/bin/hmdraw -s 1000 -l 16 -o man/hybrid.png demo/dem.hm demo/hybrid.hm
	$(Q)$(B)/bin/hmdraw -3 -f z -o demo/view.html demo/hybrid.hm demo/breaklines.hm demo/residuals.hm
	$(Q)tests/chromium.py demo/view.html size 900 500 drag 600 300 60 -10 wheel 560 260 -260 \
	    click 458 331 shot man/view.jpg

# The case studies of the paper; each ends with a table of goals, and all run before one that is missed counts.
casestudies: deps-quiet
	$(Q)$(MAKE) $(JOBS) --no-print-directory all $(GEN)
	$(Q)status=0; for study in junction danube; do echo "== $$study"; \
	    B=$(CURDIR)/$(B) tests/study/$$study casestudies/$$study || status=1; done; exit $$status

check: deps-quiet
	$(Q)$(MAKE) $(JOBS) --no-print-directory all $(GEN) $(UNIT) $(FAULT)
	$(Q)B=$(CURDIR)/$(B) tests/run $(or $(TESTS),$(wildcard tests/*.t) $(UNIT))

check-long: deps-quiet
	$(Q)$(MAKE) $(JOBS) --no-print-directory all $(GEN) $(UNIT) $(FAULT)
	$(Q)B=$(CURDIR)/$(B) tests/run $(or $(TESTS),$(wildcard tests/long/*.t))

check-san:
	$(Q)$(MAKE) --no-print-directory check SANITIZE=address,undefined

# Measured against the peers of tests/deps bench, which are C++ libraries: g++ -O3 for them, the library
# as it is. bench-NAME BENCH_ARGS=… passes arguments on.
$(B)/bench/%: tests/bench/%.cc $(LIB)
	@mkdir -p $(@D)
	$(if $(Q),@echo "  LD      $@")
	$(Q)$(CXX) -std=c++17 -O3 -DNDEBUG -Ilibcommon $(EXTRA_CFLAGS) -MMD -MP -o $@ $< $(LIB) -lgmp -lmpfr \
	    $(EXTRA_LIBS) -pthread -lm
$(B)/bench/bench_georef: EXTRA_CFLAGS = $(GEOD_CFLAGS)
$(B)/bench/bench_georef: EXTRA_LIBS = $(GEOD_LIBS)
bench-georef: $(B)/bin/georef $(B)/bin/hmconv

bench: $(BENCH:%=bench-%) $(BENCH_SH:%=bench-%)
bench-delaunay bench-refine bench-ruppert: BENCH_ARGS ?= $(wildcard $(HM_DATA)/bench_river/river.poly)
$(BENCH:%=bench-%): bench-%: $(B)/bench/bench_%
	$(Q)tests/deps bench quiet
	$(Q)PATH=$(CURDIR)/$(B)/bin:$$PATH $< $(BENCH_ARGS)
.PHONY: $(BENCH:%=bench-%) $(BENCH_SH:%=bench-%)

# The programs themselves, as a user runs them.
$(BENCH_SH:%=bench-%): bench-%: tests/bench/bench_%.sh all $(GEN)
	$(Q)tests/deps bench quiet
	$(Q)B=$(CURDIR)/$(B) $< $(BENCH_ARGS)

# Each target with libFuzzer and the sanitizers for SECONDS; what it finds stays in build/fuzz, the seeds
# in tests/fuzz/corpus.
SECONDS ?= 600
FUZZ_FLAGS = $(filter-out -O2,$(HM_CFLAGS)) -O1 -g -Itests/unit -fsanitize=address,undefined \
             -fno-sanitize-recover=all
$(B)/fuzz/obj/%.o: libcommon/%.c
	@mkdir -p $(@D)
	$(if $(Q),@echo "  CLANG   $<")
	$(Q)clang $(FUZZ_FLAGS) -fsanitize=fuzzer-no-link -c -o $@ $<
$(B)/fuzz/libhm.a: $(LIB_OBJ:$(B)/obj/%=$(B)/fuzz/obj/%)
	$(Q)rm -f $@ && $(AR) rcs $@ $^
$(IMPORTED:%=$(B)/fuzz/fuzz_import_%): $(B)/fuzz/fuzz_import_%: tests/fuzz/fuzz_import.c $(B)/fuzz/libhm.a
	$(if $(Q),@echo "  CLANG   $< $*")
	$(Q)clang $(FUZZ_FLAGS) -DFORMAT='"$*"' -fsanitize=fuzzer -o $@ $< $(B)/fuzz/libhm.a $(JSON_LIBS) -lm
$(B)/fuzz/%: tests/fuzz/%.c $(B)/fuzz/libhm.a
	$(if $(Q),@echo "  CLANG   $<")
	$(Q)clang $(FUZZ_FLAGS) -fsanitize=fuzzer -o $@ $< $(B)/fuzz/libhm.a -lm
fuzz:
	$(Q)tests/deps fuzz quiet
	$(Q)$(MAKE) --no-print-directory $(FUZZ)
	$(Q)for f in $(FUZZ); do n=$${f##*/}; mkdir -p $$f.found && \
	    $$f -max_total_time=$(SECONDS) -timeout=10 -max_len=4096 -print_final_stats=1 \
	        -artifact_prefix=$$f. $$f.found tests/fuzz/corpus/$$n || exit 1; done

# What a stranger's tools say about the sources: all of it must be silent.
lint:
	$(Q)tests/deps lint quiet
	$(Q)clang-format --dry-run -Werror $(SOURCES)
	$(Q)cppcheck --quiet --std=c11 --language=c --error-exitcode=1 --inline-suppr \
	    --enable=warning,portability --suppress=internalAstError -Ilibcommon \
	    $(filter-out %.cpp,$(filter %.c,$(SOURCES)))
	$(Q)$(MAKE) --no-print-directory B=build/lint CFLAGS='-O2 -Werror' all $(patsubst $(B)/%,build/lint/%,$(GEN) $(UNIT))
	$(Q)mandoc -T lint -W warning $(wildcard man/*.[157])
	$(Q)for f in tests/*.t tests/long/*.t tests/bench/*.sh tests/run tests/deps tests/demo tests/study/study.sh tests/study/junction \
	    tests/study/danube tests/classroom/stages tests/classroom/pictures .ci/run; do \
	    [ ! -e $$f ] || bash -n $$f || exit 1; done

compile_commands.json: FORCE
	$(Q){ echo '['; for f in $(filter %.c,$(SOURCES)); do \
	    printf '%s{"directory":"%s","file":"%s","command":"%s -c %s"}' "$$comma" '$(CURDIR)' $$f \
	        '$(CC) $(filter-out -MMD -MP,$(HM_CFLAGS)) -Itests/unit $(CAIRO_CFLAGS)' $$f; \
	    comma=','; echo; done; echo ']'; } >$@

deps:
	$(Q)tests/deps build
.PHONY: deps-quiet
deps-quiet:
	$(Q)tests/deps build quiet

COMPLETION = $(DESTDIR)$(PREFIX)/share/bash-completion/completions
install: all
	$(Q)mkdir -p $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/man/man1 \
	    $(DESTDIR)$(PREFIX)/share/man/man5 $(DESTDIR)$(PREFIX)/share/man/man7 $(COMPLETION) \
	    $(DESTDIR)$(PREFIX)/share/hybridmesh
	$(Q)for p in $(PROGRAMS); do \
	    install -m 755 $(B)/bin/$$p $(DESTDIR)$(PREFIX)/bin/$(PROGPREFIX)$$p && \
	    install -m 644 man/$$p.1 $(DESTDIR)$(PREFIX)/share/man/man1/$(PROGPREFIX)$$p.1 && \
	    sed 's/^\(complete .*_hybridmesh\) .*/\1 $(PROGPREFIX)'$$p/ tools/completion.bash \
	        >$(COMPLETION)/$(PROGPREFIX)$$p || exit 1; done
	$(Q)install -m 644 man/hybridmesh.5 $(DESTDIR)$(PREFIX)/share/man/man5/
	$(Q)install -m 644 man/hybridmesh.7 $(DESTDIR)$(PREFIX)/share/man/man7/
	$(Q)install -m 644 man/quality.schema.json $(DESTDIR)$(PREFIX)/share/hybridmesh/

# The sources as committed; and a Debian package of them, looked over by lintian. Who packs it says so
# by DEBFULLNAME and DEBEMAIL.
DIST := build/hybridmesh-$(VERSION)
dist:
	$(Q)mkdir -p build && git archive --prefix=hybridmesh-$(VERSION)/ HEAD | gzip -9n >$(DIST).tar.gz
	$(Q)echo "$(DIST).tar.gz"
deb: dist
	$(Q)tests/deps deb quiet
	$(Q)rm -rf build/deb && mkdir -p build/deb && tar -C build/deb -xzf $(DIST).tar.gz
	$(Q)who="$${DEBFULLNAME:-hybridmesh developers} <$${DEBEMAIL:-$$(git log -1 --format=%ae)}>"; \
	    when=$$(git log -1 --format=%cD); cd build/deb/hybridmesh-$(VERSION) && cp -r tools/debian debian && \
	    sed -i "s/@WHO@/$$who/" debian/control && \
	    printf 'hybridmesh (%s-1) unstable; urgency=medium\n\n  * As in CHANGES.\n\n -- %s  %s\n' \
	        $(VERSION) "$$who" "$$when" >debian/changelog && \
	    dpkg-buildpackage -us -uc -b >../log 2>&1 || { tail -n 20 ../log; exit 1; }
	$(Q)lintian --fail-on error,warning build/deb/*.changes && ls build/deb/*.deb

clean:
	rm -rf build demo casestudies compile_commands.json

-include $(wildcard $(B)/obj/*.d $(B)/bin/*.d $(B)/test/*.d $(B)/bench/*.d $(B)/fuzz/*.d $(B)/fuzz/obj/*.d)
