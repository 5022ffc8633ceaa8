# The chain of tools for one site, included by sample_sites/<site>/Makefile. What is computed stands in
# site.toml; the Makefile may set
#   CONTOURS or DEM                what the ground is made from, instead of [terrain]
#   TIN_FLAGS, TRN_FLAGS, BLOCKS_FLAGS, CHECK_FLAGS, DDA_FLAGS, RUNOUT_FLAGS, MAPS_FLAGS, FENCE_FLAGS,
#   PLACES_FLAGS, HAZARD_FLAGS, TRACE_FLAGS, PROFILE_FLAGS, SEARCH_FLAGS
#                                  further options of the tools
#   EVALUATE_FLAGS                 of all tools that evaluate runs (e.g. --rest-speed-m-s 0.1)
#   RUNS, SEED, CASES, WEIGHTS, WITHOUT   dda.mk; RUNS=auto, RUNS_MOST: as many as [place.*] want (auto_runs.sh)
#   SHARDS, SHARD, REDUCE, SBATCH_FLAGS    shards.mk, slurm.mk
# and so may the command line (make RUNS=50 -j4). V=1 shows every command. Every rule is one tool: files
# in, files out.

PIPELINES := $(dir $(lastword $(MAKEFILE_LIST)))
OUT ?= out
STAGES := $(OUT)/stages
DB := --db $(OUT)/$(if $(SHARD),shards/$(SHARD)-of-$(SHARDS),runs).sqlite

include $(PIPELINES)variables.mk
include $(PIPELINES)products.mk

.DEFAULT_GOAL := all
.SUFFIXES:
.PHONY: all terrain blocks check runs runout maps fence hazard trace profile fence-search report clean help
RUNS_MOST ?= 1600

all: check report ## everything, up to the report

clean: ## remove what was made, and nothing else
	$(if $(wildcard $(STAGES)/.lock),$(locked))@sh $(PIPELINES)clean.sh '$(OUT)' '$(mark_of_out)' '$(products) $(made_patterns)' '$(made_folders)'

# The goals in the order of the pipeline, and those that the site's Makefile adds.
help_files := $(addprefix $(PIPELINES),site.mk trn.mk source.mk blocks.mk check.mk dda.mk runout.mk maps.mk fence.mk places.mk hazard.mk trace.mk profile.mk fence_search.mk report.mk shards.mk slurm.mk new_site.mk) \
  $(filter-out $(PIPELINES)%,$(MAKEFILE_LIST))
help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  \1: \2/p' $(help_files)$(if $(wildcard manifest.sha256),, | grep -v '^  data:')
	@echo 'Several runs side by side: make RUNS=50 -j4. One input, other results: make OUT=out2 ...'
	@echo 'V=1 shows every command, -n shows what would be run.'

include $(PIPELINES)new_site.mk

short_flags := $(filter-out --%,$(firstword -$(MAKEFLAGS)))
# With -n and -q nothing is written.
is_dry_run := $(findstring n,$(short_flags))$(findstring q,$(short_flags))

# One make at a time works in OUT, shards apart (lock.sh).
locked = $(call stop_if,$(shell sh $(PIPELINES)lock.sh $(OUT) $(shell echo $$PPID) $(if $(SHARD),shared,alone)))
stop_if = $(if $1,$(error $1))
# quoted(TEXT): a word of the shell
quoted = '$(subst ','\'',$1)'

# RUNS=auto: another make decides how many.
goals := $(or $(MAKECMDGOALS),all)
is_auto := $(and $(filter auto,$(RUNS)),$(filter-out clean help data new-site,$(goals)))
ifneq ($(is_auto),)
$(if $(is_dry_run),,$(locked))
.PHONY: auto-runs
$(goals): auto-runs ;
auto-runs:
	+@sh $(PIPELINES)auto_runs.sh '$(MAKE)' '$(OUT)' $(RUNS_MOST) $(goals)
endif

# One short line a stage, or with V=1 the commands; with -s neither.
Q := $(if $(V),,@)
say = $(if $(findstring s,$(short_flags)),,$(info $1))

# Goals that need no site file read.
ifneq ($(if $(is_auto),,$(filter-out clean help data new-site,$(goals))),)

include $(PIPELINES)inputs.mk

# made(TOOL): the line behind that of a tool, in a rule: has it really written the file?
made = $(if $(is_dry_run),,@sh $(PIPELINES)made.sh $1 $@ '$(shell stat -c '%i %Z' $@ 2>/dev/null)')
# Several shards at once must not make what all of them read (shards.mk).
not_in_a_shard = $(if $(SHARD),$(error $1 is to be made again, and a shard makes runs alone: make prepare, or make submit))

# together(FILES): what one run of a tool writes, the first file last and all with the same time. Rules
# name the first; the others come with it. One that is missing beside it makes the tool run again.
define together
$(wordlist 2,99,$1): $(firstword $1) ;
ifneq ($$(wildcard $(firstword $1)),)
ifneq ($$(words $$(wildcard $1)),$(words $1))
.PHONY: $(firstword $1)
endif
endif
endef

# evaluate_flags: of every tool that evaluates runs; what the site file says, unless make is given it, and what cases
# count (dda.mk). class_flags: of tools that take runs by class, which cases may be, without that.
class_flags = $(if $(findstring --max-failed-share,$(EVALUATE_FLAGS)),,--max-failed-share $(SITE_MAX_FAILED_SHARE)) $(EVALUATE_FLAGS)
evaluate_flags = $(WEIGHTS:%=--case-weight %) $(class_flags)

$(OUT) $(OUT)/runs $(OUT)/without $(OUT)/rock $(STAGES)/failed:
	@mkdir -p $@

include $(PIPELINES)tin.mk
include $(PIPELINES)trn.mk
include $(PIPELINES)source.mk
include $(PIPELINES)blocks.mk
include $(PIPELINES)check.mk
include $(PIPELINES)dda.mk
include $(PIPELINES)rock.mk
include $(PIPELINES)runout.mk
include $(PIPELINES)maps.mk
include $(PIPELINES)fence.mk
include $(PIPELINES)places.mk
include $(PIPELINES)hazard.mk
include $(PIPELINES)trace.mk
include $(PIPELINES)profile.mk
include $(PIPELINES)fence_search.mk
include $(PIPELINES)report.mk
include $(PIPELINES)shards.mk
include $(PIPELINES)slurm.mk
endif

# Sites whose data are not in the repository keep a list of what they need, with checksums.
ifneq ($(wildcard manifest.sha256),)
.PHONY: data
data: ## check the site's data against manifest.sha256
	sha256sum --check --quiet manifest.sha256
endif
