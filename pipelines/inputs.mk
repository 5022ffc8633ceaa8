# What the site is made from, looked at by content whenever make starts: other contents repeat a stage,
# other times do not. talus-site writes a file a stage with the values that it reads and the digests of
# its files, and leaves one that would be the same as it is.
# in: site.toml, CONTOURS, DEM, *_FLAGS, manifest.sha256   out: $(STAGES)/*.txt, *.files, *.flags, SITE_*

# --- the tools: of this checkout when it is built whole, else on the search path ---
tool_names := site tin trn blocks check dda reduce runout maps fence places hazard trace profile fence-search report
whole_build = $(if $(word $(words $(tool_names)),$(wildcard $(tool_names:%=$1talus-%))),$1)
BIN ?= $(firstword $(call whole_build,$(PIPELINES)../build/release/tools/) $(call whole_build,$(PIPELINES)../build/demo/tools/))
wanted := $(or $(MAKECMDGOALS),all)
needed_tools := site tin trn $(if $(filter-out terrain,$(wanted)),blocks) $(if $(filter-out terrain blocks,$(wanted)),check) \
  $(if $(filter-out terrain blocks check,$(wanted)),dda) $(if $(filter-out terrain blocks check runs runs-shard prepare,$(wanted)),runout maps fence places hazard trace fence-search report) \
  $(if $(filter runs-shard,$(wanted)),$(if $(filter no,$(REDUCE)),,reduce)) $(filter profile,$(wanted))
missing_tools := $(shell for tool in $(needed_tools); do command -v $(BIN)talus-$$tool >/dev/null || echo talus-$$tool; done)
ifneq ($(missing_tools),)
$(error $(missing_tools) cannot be found$(if $(BIN), in $(BIN)): $(if $(wildcard $(PIPELINES)demo.sh),build first: sh $(PIPELINES)demo.sh; or )name the folder of the tools with a slash at its end: make BIN=/where/tools/)
endif

# --- the folder of the results ---
ifeq ($(is_dry_run),)
cannot_make := $(shell mkdir -p $(STAGES) 2>&1)
ifneq ($(cannot_make),)
$(error $(cannot_make): name another folder for the results: make OUT=/where/results)
endif
endif
# One that the pipeline never wrote into may hold files of others under the names of its own.
foreign := $(if $(wildcard $(OUT)/$(mark_of_out)),,$(wildcard $(addprefix $(OUT)/,$(products) runs/*.h5 without/*.h5)))
ifneq ($(foreign),)
$(error $(firstword $(foreign)) was not made by the pipeline, which would replace it: name another OUT, or move it away)
endif

# --- who else works there ---
run_goals := runs runout maps fence hazard trace profile fence-search report all
# While jobs of this folder wait or run nothing else may make the same runs; their own makes may.
ifeq ($(is_dry_run)$(SHARD)$(SENT),)
ifneq ($(and $(wildcard $(OUT)/shards/jobs),$(filter submit prepare $(run_goals),$(wanted))),)
jobs_left := $(shell sh $(PIPELINES)jobs_left.sh $(OUT)/shards/jobs)
$(if $(jobs_left),$(error Jobs of Slurm for $(OUT) wait or run: $(jobs_left). Wait for them, or end them: scancel $(jobs_left)))
endif
endif
# What changes from now on is newer than all that is there (in_time.sh).
ifeq ($(is_dry_run),)
$(locked)
$(if $(SHARD),,$(shell sh $(PIPELINES)in_time.sh $(OUT)))
endif

# --- data that a manifest lists: checked again when one of them is another file ---
ifneq ($(wildcard manifest.sha256),)
data_state := $(shell cut -c67- manifest.sha256 | tr '\n' '\0' | xargs -0 stat -L -c '%n %s %i %y %z' -- manifest.sha256 2>&1)
ifneq ($(strip $(file <$(OUT)/data.ok)),$(strip $(data_state)))
data_trouble := $(shell sha256sum --check --quiet manifest.sha256 >&2 || echo trouble)
ifneq ($(data_trouble),)
$(error The data of this site are missing or differ: see README.md)
endif
ifeq ($(is_dry_run),)
$(file >$(OUT)/data.ok,$(data_state))
endif
endif
endif

# --- what a stage reads ---
# named_in(FLAGS): files that options name (--like FILE, --set 'KEY="FILE"', "FILE|layername=A"); not folders, nor what
# lies in OUT.
words_in = $(subst =, ,$(subst |, ,$(subst ",,$(subst ',,$1))))
named_in = $(filter-out $(OUT)/%,$(foreach name,$(wildcard $(call words_in,$1)),$(if $(wildcard $(name)/.),,$(name))))
# Of "map.gpkg|layername=index|subset=ELEV > 900" the file, and a word of the recipe that chooses layers and features.
contours_file = $(if $(findstring |,$(CONTOURS)),$(firstword $(subst |, ,$(CONTOURS))),$(CONTOURS))
contours_part = $(if $(findstring |,$(CONTOURS)),'$(subst ','\'',$(subst $(contours_file)|,|,$(CONTOURS)))',$(if $(call differ,$(CONTOURS),$(SITE_CONTOURS)),,$(SITE_CONTOURS_PART)))
# given(NAME,FLAGS): options of talus-site for the files of a list, which may be empty
given = --given $1= $(foreach name,$(call named_in,$2),--given '$1=$(subst ','\'',$(name))')
given_files := $(if $(CONTOURS),--given tin=$(contours_file)) $(call given,tin,$(TIN_FLAGS)) \
  $(if $(DEM),--given trn=$(DEM)) $(call given,trn,$(TRN_FLAGS)) $(call given,blocks,$(BLOCKS_FLAGS)) $(call given,check,$(CHECK_FLAGS)) \
  $(call given,dda,$(filter-out %.xmf,$(DDA_FLAGS))) $(foreach case,$(CASES),$(call given,case_$(case),$(CASE_$(case)))) \
  $(call given,runout,$(RUNOUT_FLAGS)) $(call given,maps,$(MAPS_FLAGS)) $(call given,fence,$(FENCE_FLAGS)) $(call given,places,$(PLACES_FLAGS)) \
  $(call given,hazard,$(HAZARD_FLAGS)) $(call given,trace,$(TRACE_FLAGS)) $(call given,search,$(SEARCH_FLAGS)) \
  $(if $(LINE),--given 'profile=$(line_file)') $(call given,profile,$(PROFILE_FLAGS)) \
  --given report=site.toml $(call given,report,$(REPORT_FLAGS))

# With -n and -q the stage files go to a folder of their own and are compared.
ifeq ($(is_dry_run),)
stages_now := $(STAGES)
else
stages_now := $(shell mktemp -d)
copied := $(shell cp $(STAGES)/.digests $(stages_now) 2>/dev/null)
endif
said := $(shell $(BIN)talus-site site.toml -o $(stages_now) --results $(OUT) $(given_files) --overwrite --no-db)
ifneq ($(.SHELLSTATUS),0)
ifneq ($(is_dry_run),)
removed := $(shell rm -rf $(stages_now))
endif
$(error site.toml or a file that it names cannot be used, see above)
endif
include $(stages_now)/site.mk
$(stages_now)/site.mk: ;
$(STAGES)/%.txt $(STAGES)/%.files: ;
# What runs depend on, with all that is made before them (dda.mk).
stage_state = $(firstword $(shell cat $(addprefix $(stages_now)/,$1) 2>/dev/null | sha256sum))
state_before_runs := $(call stage_state,trn.txt trn.files blocks.txt blocks.files run.txt dda.files \
  $(if $(SITE_ROCK_MASSES),rock.txt) $(if $(or $(CONTOURS),$(SITE_CONTOURS)),tin.txt tin.files))
$(foreach case,$(CASES),$(eval state_of_$(case) := $(call stage_state,case_$(case).files)))
ifneq ($(is_dry_run),)
.PHONY: $(shell for file in $(stages_now)/*.txt $(stages_now)/*.files; do \
  cmp -s $$file $(STAGES)/$${file##*/} || echo $(STAGES)/$${file##*/}; done; rm -rf $(stages_now))
endif

# remember(NAME,TEXT): a file that changes when TEXT does, e.g. options given to make. The rules that it gives do not
# hold TEXT, which may have signs of make's own.
differ = $(subst |$1|,,|$2|)$(subst |$2|,,|$1|)
remembered = $(if $(call differ,$(strip $(file <$(STAGES)/$1.flags)),$(strip flags: $2)),$(if $(is_dry_run),.PHONY: $(STAGES)/$1.flags,$(file >$(STAGES)/$1.flags,$(strip flags: $2))))
define remember
$(call remembered,$1,$2)
$(STAGES)/$1.flags: ;
endef

# Given to make they stand above the site file's. Rules name them behind a bar: one that another rule
# makes is made first, and its content counts, not its time.
CONTOURS ?= $(SITE_CONTOURS)
DEM ?= $(SITE_DEM)
