# The chain of tools for one site, included by sample_sites/<site>/Makefile. The settings are in
# site.toml; the Makefile may set
#   CONTOURS or DEM     source of the ground, instead of [terrain]
#   IMPORT_FLAGS, TIN_FLAGS, TRN_FLAGS, BLOCKS_FLAGS, CHECK_FLAGS, STABILITY_FLAGS, DDA_FLAGS,
#   RUNOUT_FLAGS, MAPS_FLAGS, FENCE_FLAGS, PLACES_FLAGS, CALIBRATE_FLAGS, HAZARD_FLAGS, TRACE_FLAGS,
#   PROFILE_FLAGS, SEARCH_FLAGS, REPORT_FLAGS
#                       further options of the tools
#   RUNS, SEED, WITHOUT, RUNS_MOST                   runs.mk
#   SHARDS, SHARD, SBATCH_FLAGS                      runs.mk, slurm.mk
#   VARIANT, BASE                                    variants.mk
# and so may the command line (make RUNS=50 -j4). V=1 shows every command. Every rule is one tool:
# files in, files out.

PIPELINES := $(dir $(lastword $(MAKEFILE_LIST)))
OUT ?= out
STAGES := $(OUT)/stages
site := $(strip site.toml $(VARIANT:%=--variant %))
DB := --db $(OUT)/$(if $(SHARD),shards/$(SHARD)-of-$(SHARDS),runs).sqlite

include $(PIPELINES)variables.mk
include $(PIPELINES)products.mk

.DEFAULT_GOAL := all
.SUFFIXES:
.PHONY: all terrain blocks stability check runs runout maps fence calibrate hazard trace profile \
  report clean help

all: check report ## everything, up to the report

clean: ## remove what was made, and nothing else
	$(if $(wildcard $(STAGES)/.lock),$(locked))@for out in $(wildcard $(OUT)/variant/*) $(OUT); do \
	  sh $(PIPELINES)clean.sh $$out '$(mark_of_out)' '$(products) $(made_patterns)' \
	  '$(made_folders)'; done

# The rules in the order of the pipeline, and the goals in them and in the site's Makefile.
rules := trn source blocks stability check runs runout maps fence places calibrate hazard trace \
  profile fence_search variants report slurm new_site
help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  \1: \2/p' $(PIPELINES)site.mk $(rules:%=$(PIPELINES)%.mk) \
	  $(filter-out $(PIPELINES)%,$(MAKEFILE_LIST)) $(if $(wildcard manifest.sha256),, \
	  | grep -v '^  data:')
	@echo 'Several runs side by side: make RUNS=50 -j4. One input, other results: make OUT=out2 ...'
	@echo 'V=1 shows every command, -n shows what would be run.'

include $(PIPELINES)new_site.mk

short_flags := $(filter-out --%,$(firstword -$(MAKEFLAGS)))
# With -n and -q nothing is written.
is_dry_run := $(findstring n,$(short_flags))$(findstring q,$(short_flags))

# One make at a time works in OUT, shards apart (lock.sh).
locked = $(call stop_if,$(shell sh $(PIPELINES)lock.sh $(OUT) $(shell echo $$PPID) \
  $(if $(SHARD),shared,alone)))
stop_if = $(if $1,$(error $1))
# quoted(TEXT): a word of the shell
quoted = '$(subst ','\'',$1)'

# One short line a stage, or with V=1 the commands; with -s neither.
Q := $(if $(V),,@)
say = $(if $(findstring s,$(short_flags)),,$(info $1))

# Goals that need no site file read.
wanted := $(or $(MAKECMDGOALS),all)
ifneq ($(filter-out clean help data new-site,$(wanted)),)

include $(PIPELINES)inputs.mk

# made(TOOL): the line behind that of a tool, in a rule: has it really written the file?
made = $(if $(is_dry_run),,@sh $(PIPELINES)made.sh $1 $@ '$(shell stat -c '%i %Z' $@ 2>/dev/null)')
# Several shards at once must not make files that all of them read (runs.mk).
not_in_a_shard = $(if $(SHARD),$(error $1 is out of date, and shards only compute runs: make \
  prepare, or make submit))

# taken(FILES): in a rule before its tool: takes FILES over from BASE (taken.sh).
taken = $(if $(BASE),sh $(PIPELINES)taken.sh $(BASE) $(OUT) '$1' '$^' || )

# together(FILES): files that one run of a tool writes, the first one last and all with the same
# time. Rules name the first; the rest comes with it. One that is missing beside it makes the tool
# run again.
define together
$(wordlist 2,99,$1): $(firstword $1) ;
ifneq ($$(wildcard $(firstword $1)),)
ifneq ($$(words $$(wildcard $1)),$(words $1))
.PHONY: $(firstword $1)
endif
endif
endef

$(OUT) $(OUT)/rock:
	@mkdir -p $@

several_cases := $(SITE_ALTERNATIVES)
include $(patsubst %,$(PIPELINES)%.mk,import tin $(filter-out new_site,$(rules)) rock)
endif

# Sites whose data are not in the repository keep a list of the files that they need, with
# checksums.
ifneq ($(wildcard manifest.sha256),)
.PHONY: data
data: ## check the site's data against manifest.sha256
	sha256sum --check --quiet manifest.sha256
endif
