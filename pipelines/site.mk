# The chain of tools for one site, included by sample_sites/<site>/Makefile. What is computed stands in
# site.toml; the Makefile may set
#   CONTOURS or DEM                what the ground is made from, instead of [terrain]
#   TIN_FLAGS, TRN_FLAGS, BLOCKS_FLAGS, DDA_FLAGS, RUNOUT_FLAGS, MAPS_FLAGS, FENCE_FLAGS
#                                  further options of the tools
#   EVALUATE_FLAGS                 of all tools that evaluate runs (e.g. --allow-unfinished)
#   RUNS, SEED, CASES, WITHOUT     dda.mk
# and so may the command line (make RUNS=50 -j4). Every rule is one tool: files in, files out.

PIPELINES := $(dir $(lastword $(MAKEFILE_LIST)))
OUT ?= out
# The tools of this checkout when they are built here, else those on the search path.
BIN ?= $(firstword $(wildcard $(PIPELINES)../build/release/tools/ $(PIPELINES)../build/demo/tools/))
STAGES := $(OUT)/stages
DB := --db $(OUT)/runs.sqlite

include $(PIPELINES)variables.mk

.DEFAULT_GOAL := all
.SUFFIXES:
.PHONY: all terrain blocks runs runout maps fence report clean help

all: report ## everything, up to the report

clean: ## remove everything that was made
	rm -rf '$(OUT)'

# The goals in the order of the pipeline, and those that the site's Makefile adds.
help_files := $(addprefix $(PIPELINES),site.mk trn.mk source.mk blocks.mk dda.mk runout.mk maps.mk fence.mk report.mk new_site.mk) \
  $(filter-out $(PIPELINES)%,$(MAKEFILE_LIST))
help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  \1: \2/p' $(help_files)$(if $(wildcard manifest.sha256),, | grep -v '^  data:')
	@echo 'Several runs side by side: make RUNS=50 -j4. One input, other results: make OUT=out2 ...'

include $(PIPELINES)new_site.mk

# Goals that need no site file read.
ifneq ($(filter-out clean help data new-site,$(or $(MAKECMDGOALS),all)),)

# talus-site parts site.toml into a file a stage and touches only those that have changed, so that a
# stage is repeated when its own settings or files have changed and not else.
include $(STAGES)/site.mk
$(STAGES)/site.mk: site.toml $(SITE_FILES)
	@$(BIN)talus-site site.toml -o $(STAGES) --overwrite --no-db
$(STAGES)/%.txt: | $(STAGES)/site.mk
	@$(BIN)talus-site site.toml -o $(STAGES) --overwrite --no-db
$(SITE_FILES): ;

# remember(NAME,TEXT): a file that changes when TEXT does, e.g. options given to make.
is_dry_run := $(findstring n,$(filter-out --%,$(firstword -$(MAKEFLAGS))))
define remember
ifeq ($(is_dry_run),)
ifneq ($$(strip $$(file <$(STAGES)/$1.flags)),$$(strip flags: $2))
$$(shell mkdir -p $(STAGES))$$(file >$(STAGES)/$1.flags,$$(strip flags: $2))
endif
endif
$(STAGES)/$1.flags: ;
endef

# named_in(FLAGS): files that options name (--like FILE, --like=FILE), to depend on; not folders, nor
# what lies in OUT.
named_in = $(filter-out $(OUT)/%,$(foreach name,$(wildcard $(foreach word,$1,$(lastword $(subst =, ,$(word))))),$(if $(wildcard $(name)/.),,$(subst :,\:,$(name)))))

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

CONTOURS ?= $(SITE_CONTOURS)
DEM ?= $(SITE_DEM)

$(OUT) $(OUT)/runs $(OUT)/without:
	@mkdir -p $@

include $(PIPELINES)tin.mk
include $(PIPELINES)trn.mk
include $(PIPELINES)source.mk
include $(PIPELINES)blocks.mk
include $(PIPELINES)dda.mk
include $(PIPELINES)runout.mk
include $(PIPELINES)maps.mk
include $(PIPELINES)fence.mk
include $(PIPELINES)report.mk
endif

# Sites whose data are not in the repository keep a list of what they need, with checksums.
ifneq ($(wildcard manifest.sha256),)
.PHONY: data
data: ## check the site's data against manifest.sha256
	sha256sum --check --quiet manifest.sha256
$(OUT)/data.ok: manifest.sha256 $(wildcard $(shell cut -c67- manifest.sha256)) | $(OUT)
	@sha256sum --check --quiet manifest.sha256 || { echo "The data of this site are missing or differ: see README.md." >&2; exit 1; }
	@touch $@
$(STAGES)/site.mk $(OUT)/tin.ply $(OUT)/trn.tif: | $(OUT)/data.ok
endif
