# Inputs of the site, compared by content whenever make starts: other contents repeat a
# stage, other times do not. talus-site writes a file a stage with the values that it reads and the
# digests of its files, and leaves one that would be the same as it is.
# in: site.toml, CONTOURS, DEM, *_FLAGS, manifest.sha256
# out: $(STAGES)/*.txt, *.files, *.flags, SITE_*

# --- the tools: of this checkout when it is built whole, else on the search path ---
tool_names := site import tin trn blocks check batch dda reduce runout maps fence places \
  calibrate hazard trace profile fence-search report
whole_build = $(if $(word $(words $(tool_names)),$(wildcard $(tool_names:%=$1talus-%))),$1)
BIN ?= $(firstword $(call whole_build,$(PIPELINES)../build/release/tools/) \
  $(call whole_build,$(PIPELINES)../build/demo/tools/))
stages_wanted := $(filter-out terrain blocks stability check runs runs-shard prepare,$(wanted))
needed_tools := site import tin trn \
  $(if $(filter-out terrain,$(wanted)),blocks check batch dda reduce) \
  $(if $(stages_wanted),runout maps fence places calibrate hazard trace fence-search report profile)
missing_tools := $(shell for tool in $(needed_tools); do \
  command -v $(BIN)talus-$$tool >/dev/null || echo talus-$$tool; done)
ifneq ($(missing_tools),)
$(error $(missing_tools) cannot be found$(if $(BIN), in $(BIN)): $(if $(wildcard \
  $(PIPELINES)demo.sh),build first: sh $(PIPELINES)demo.sh; or )name the folder of the tools with \
  a slash at its end: make BIN=/where/tools/)
endif

# --- the folder of the results ---
ifeq ($(is_dry_run),)
cannot_make := $(shell mkdir -p $(STAGES) 2>&1)
ifneq ($(cannot_make),)
$(error $(cannot_make): name another folder for the results: make OUT=/where/results)
endif
endif
# One that the pipeline never wrote into may hold foreign files under the names of its own.
foreign := $(if $(wildcard $(OUT)/$(mark_of_out)),,$(wildcard $(addprefix \
  $(OUT)/,$(products) runs/*.h5 without/*.h5)))
ifneq ($(foreign),)
$(error $(firstword $(foreign)) was not made by the pipeline, which would replace it: name another \
  OUT, or move it away)
endif

# --- who else works there ---
run_goals := runs runout maps fence places calibrate hazard trace profile fence-search variants \
  report all
# While jobs of this folder wait or run nothing else may make the same runs; their own makes may.
sent_jobs := $(if $(is_dry_run)$(SHARD)$(SENT),,$(wildcard $(OUT)/shards/jobs))
ifneq ($(and $(sent_jobs),$(filter submit prepare $(run_goals),$(wanted))),)
jobs_left := $(shell for job in $$(cat $(sent_jobs)); do \
  [ -z "$$(squeue --noheader --jobs=$$job --format=%i 2>/dev/null)" ] || echo $$job; done)
$(if $(jobs_left),$(error Jobs of Slurm for $(OUT) wait or run: $(jobs_left). Wait for them, or \
  end them: scancel $(jobs_left)))
endif
# Files that change from now on are newer than all that exist (in_time.sh).
ifeq ($(is_dry_run),)
$(locked)
$(if $(SHARD),,$(shell sh $(PIPELINES)in_time.sh $(OUT)))
endif

# --- data that a manifest lists: checked again when one of them is another file ---
ifneq ($(wildcard manifest.sha256),)
data_state := $(shell cut -c67- manifest.sha256 | tr '\n' '\0' | \
  xargs -0 stat -L -c '%n %s %i %y %z' -- manifest.sha256 2>&1)
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

# --- inputs of a stage ---
# named_in(FLAGS): files that options name (--like FILE, --set 'KEY="FILE"', "FILE|layername=A");
# not folders, nor files in OUT.
words_in = $(subst =, ,$(subst |, ,$(subst ",,$(subst ',,$1))))
named_in = $(filter-out $(OUT)/%,$(foreach name,$(wildcard $(call words_in,$1)),$(if \
  $(wildcard $(name)/.),,$(name))))
# Of "map.gpkg|layername=index|subset=ELEV > 900" the file, and where make was given it the words of
# the recipe that name it whole.
contours_file = $(if $(findstring |,$(CONTOURS)),$(firstword $(subst |, ,$(CONTOURS))),$(CONTOURS))
contours_given = $(if $(call differ,$(CONTOURS),$(SITE_CONTOURS)),--set \
  terrain.contours=$(contours_file)$(if $(findstring |,$(CONTOURS)),'$(subst ','\'',$(subst \
  $(contours_file)|,|,$(CONTOURS)))'))
dem_given = $(if $(CONTOURS),,$(if $(call differ,$(DEM),$(SITE_DEM)),--set terrain.contours= \
  --set terrain.dem=$(DEM)) \
  $(systems_of_dem))
# The system of an elevation model in TRN_FLAGS is that of the site.
systems_of_dem = $(foreach option,--crs --t-srs,$(subst @, ,$(filter \
  $(option)@% $(option)=%,$(subst $(option) ,$(option)@,$(TRN_FLAGS)))))
# given(NAME,FLAGS): options of talus-site for the files of a list, which may be empty
given = --given $1= $(foreach name,$(call named_in,$2),--given '$1=$(subst ','\'',$(name))')
flags_of = $(shell echo $1 | tr a-z A-Z)_FLAGS
given_files := $(if $(CONTOURS),--given import=$(contours_file)) \
  $(if $(DEM),--given trn=$(DEM) --given import=$(DEM)) \
  $(if $(LINE),--given 'profile=$(line_file)') \
  --given report=site.toml $(foreach stage,import tin trn blocks check runout maps fence places \
  calibrate hazard trace search profile report stability,$(call given,$(stage),$($(call \
  flags_of,$(stage)))))
# With -n and -q the stage files go to a folder of their own and are compared.
ifeq ($(is_dry_run),)
stages_now := $(STAGES)
else
stages_now := $(shell mktemp -d)
copied := $(shell cp $(STAGES)/.digests $(stages_now) 2>/dev/null)
endif
said := $(shell $(BIN)talus-site $(site) -o $(stages_now) --results $(OUT) $(given_files) \
  --overwrite --no-db)
ifneq ($(.SHELLSTATUS),0)
ifneq ($(is_dry_run),)
removed := $(shell rm -rf $(stages_now))
endif
$(error site.toml or a file that it names cannot be used, see above)
endif
include $(stages_now)/site.mk
$(stages_now)/site.mk: ;
# Of a measure whose fences differ in height and strength alone, runs without fences are BASE's.
# A make by hand takes only those that are there.
strength := height_m|capacity_kj|max_deflection_m|cor|friction_deg|active
but_strength = "$$(sed -E '/^fence\..*\.($(strength)) = /d' $(foreach stage,import tin trn blocks \
  rock run,$1/$(stage).txt) 2>/dev/null)"
shared_without := $(if $(BASE),$(shell [ $(call but_strength,$(stages_now)) = $(call \
  but_strength,$(BASE)/stages) ] && if grep -qx 'SITE_FENCES_STAND := yes' $(BASE)/stages/site.mk; \
  then echo $(BASE)/without; else echo $(BASE)/runs; fi))
shared_without := $(if $(filter-out 0,$(MAKELEVEL))$(wildcard \
  $(shared_without)/ensemble.json),$(shared_without))
$(STAGES)/%.txt $(STAGES)/%.files: ;
ifneq ($(is_dry_run),)
.PHONY: $(shell for file in $(stages_now)/*.txt $(stages_now)/*.files; do \
  cmp -s $$file $(STAGES)/$${file##*/} || echo $(STAGES)/$${file##*/}; done; rm -rf $(stages_now))
endif

# remember(NAME,TEXT): a file that changes when TEXT does, e.g. options given to make. The rules
# that it gives do not hold TEXT, which may have signs of make's own.
differ = $(subst |$1|,,|$2|)$(subst |$2|,,|$1|)
flags_file = $(STAGES)/$1.flags
remembered = $(if $(call differ,$(strip $(file <$(flags_file))),$(strip flags: $2)),$(if \
  $(is_dry_run),.PHONY: $(flags_file),$(file >$(flags_file),$(strip flags: $2))))
define remember
$(call remembered,$1,$2)
$(STAGES)/$1.flags: ;
endef

# Given to make they override the site file's. Rules name them behind a bar: one that another
# rule makes is made first, and its content counts, not its time.
CONTOURS ?= $(SITE_CONTOURS)
DEM ?= $(SITE_DEM)
