# Blocks on their bed -> runs, each a job of its own (make -j).
# in: site.toml, DDA_FLAGS   out: $(OUT)/runs/run_SEED.h5, and $(OUT)/without/run_SEED.h5 without the fences
#   RUNS, SEED  how many seeds, counted up from which ([solver] n_runs and seed)
#   CASES       names of variants, CASE_<name> the options of each; RUNS of each are made, e.g.
#               CASES = low high, CASE_low = --set ground.slope.friction_deg=28, CASE_high = ...
#   WITHOUT     yes: also the runs without fences; when not given: where a fence of the site stands
#   SHARD, SHARDS   shards.mk
# With [uncertainty] each run draws the sample of its seed; blocks of other rock masses: rock.mk.
# A run that was stopped goes on where it was (--resume). One that fails stops no other: what can be made
# is made, then make lists what failed and ends with an error.
# What the cases count among one another, for all that evaluates runs: WEIGHTS = low=1 high=3 (evaluate_flags of
# site.mk). Without it runs count alike, and outputs say that they are no probabilities.
RUNS ?= $(SITE_RUNS)
SEED ?= $(SITE_SEED)
WITHOUT ?= $(SITE_FENCES_STAND)

seeds := $(shell seq $(SEED) $$(($(SEED) + $(RUNS) - 1)))
run_names := $(if $(CASES),$(foreach case,$(CASES),$(addprefix $(case)_,$(seeds))),$(seeds))
run_files := $(run_names:%=$(OUT)/runs/run_%.h5)
without_files := $(if $(filter yes,$(WITHOUT)),$(run_names:%=$(OUT)/without/run_%.h5))
runs: $(run_files) $(without_files) ## blocks -> runs (RUNS=50: with 50 seeds)

$(eval $(call remember,runs,$(run_files) $(without_files)))

# A run counts that is known to be made with the settings of now, whatever its time is: those of the site file, of
# options, and of all that is made before it. Its key stands for them.
key_of = $(firstword $(shell printf '%s' $(call quoted,$(state_before_runs) $(strip $1)) | sha256sum))
key_before_cases := $(call key_of,$(if $(CONTOURS),$(CONTOURS) $(TIN_FLAGS)) $(DEM) $(TRN_FLAGS) $(BLOCKS_FLAGS) $(DDA_FLAGS))
# key_of_case(CASE)
key_of_case = $(call key_of,$(key_before_cases) $(if $1,$(state_of_$1) $(CASE_$1)))
$(if $(CASES),$(foreach case,$(CASES),$(eval key_$(case) := $(call key_of_case,$(case)))),$(eval key_ := $(key_of_case)))
key_of_run = $(or $(key_$(if $(findstring _,$*),$(firstword $(subst _, ,$*)))),-)
made_lists := $(STAGES)/made
made_list := $(made_lists)/$(if $(SHARD),$(SHARD)-of-$(SHARDS),runs)
# of_other_settings(KEY PATTERN ...): files of runs
of_other_settings = $(shell sh $(PIPELINES)made_with.sh others $(made_lists) $1)
# noted(RUN,KEY,MARK)
noted = $(if $(is_dry_run),,@sh $(PIPELINES)made_with.sh note $(made_list) $2 $1 $(failed_marks)/$3)
other_runs := $(call of_other_settings,$(foreach case,$(or $(CASES),-),$(foreach folder,runs without,\
  $(key_$(filter-out -,$(case))) '$(OUT)/$(folder)/run_$(if $(CASES),$(case)_)*.h5')))
.PHONY: of-other-settings

# Of the name CASE_SEED or SEED that a run has. What [uncertainty] draws is the sample of the same number.
seed_of_run = $(lastword $(subst _, ,$*))
mass :=
$(if $(SITE_SAMPLES),$(if $(filter 0,$(firstword $(seeds))),$(error SEED is 0: samples of [uncertainty] count from 1)))
run_options = --seed $(seed_of_run) $(if $(SITE_SAMPLES),--sample $(seed_of_run)) $(CASE_$(firstword $(subst _, ,$*))) $(DDA_FLAGS)
# run(NAME,MARK): before it starts, its mark says that it has not ended; talus-dda says how it did.
failed_marks := $(STAGES)/failed
not_ended := did not end by itself: it was killed, the machine was out of memory, or what starts it (BIN) lost it
tab := $(shell printf '\t')
run = $(if $(is_dry_run),,$(count_runs)$(file >$(failed_marks)/$2,none$(tab)$(not_ended)))-$(Q)$(BIN)talus-dda site.toml \
  --trn $(if $(mass),$(OUT)/rock/bed_$(mass).tif,$(OUT)/bed.tif) --blocks $(if $(mass),$(OUT)/rock/blocks_$(mass).h5,$(OUT)/blocks.h5) -o $@ $(run_options) --label $1 --failures $(failed_marks)/$2 --resume --overwrite $(DB)
# Whoever asks for the file of one run is told at once that it failed (make out/runs/run_3.h5).
must := $(if $(filter $(OUT)/%,$(MAKECMDGOALS)),must)

# More than three runs are one line each: what came of it.
say_run = $(if $(word 4,$(run_files)),,$(call say,$1))

# How far the runs are: what is to be made is counted when the first one starts, and all that they read is made.
fresh_runs = $(filter-out $(other_runs),$(shell find $(wildcard $(OUT)/runs $(OUT)/without) -name 'run_*.h5' -newer $(OUT)/blocks.h5))
# Those of the goals: maps and run-out need none without fences.
goal_runs = $(run_files) $(if $(filter-out maps runout places hazard trace profile fence-search fence-verified,$(wanted)),$(without_files))
wanted_runs = $(or $(if $(SHARD),$(shard_runs)),$(filter $(MAKECMDGOALS),$(goal_runs)),$(goal_runs))
count_runs = $(if $(runs_begun),,$(eval runs_begun := $(shell date +%s))$(eval n_to_make := $(words $(filter-out $(fresh_runs),$(wanted_runs)))))
run_progress := $(STAGES)/.progress$(if $(SHARD),-$(SHARD)-of-$(SHARDS))
# The second make of fence_search.mk works while runs of the first one may still end.
$(if $(is_dry_run)$(filter fence-verified,$(MAKECMDGOALS)),,$(if $(wildcard $(run_progress)),$(shell rm -f $(run_progress))))
# run_ended(NAME,MARK)
run_ended = $(if $(is_dry_run),,@sh $(PIPELINES)run_ended.sh $1 $(failed_marks)/$2 $(run_progress) $(n_to_make) $(runs_begun) $(must)$(if $(findstring s,$(short_flags)), >/dev/null))

$(run_files) $(without_files): $(OUT)/blocks.h5 | $(OUT)/check.html $(OUT)/runs $(OUT)/without $(failed_marks)
$(filter $(other_runs),$(run_files) $(without_files)): of-other-settings
# Before jobs are sent, make finds out what they are to do: the rule of a run notes that it is to be made, and makes
# nothing (shards.mk, slurm.mk).
notes_runs := $(filter submit prepare,$(MAKECMDGOALS))
ifeq ($(notes_runs),)
$(OUT)/runs/run_%.h5:
	$(call say_run,dda: run_$*)
	$(call run,run_$*,run_$*)
	$(call noted,$@,$(key_of_run),run_$*)
	$(call run_ended,run_$*,run_$*)
$(OUT)/without/run_%.h5:
	$(call say_run,dda: run_$* without fences)
	$(call run,without/run_$*,without_run_$*) $(SITE_WITHOUT_FENCES)
	$(call noted,$@,$(key_of_run),without_run_$*)
	$(call run_ended,without/run_$*,without_run_$*)
else
lacking_runs :=
$(run_files) $(without_files): ; $(eval lacking_runs += $@)
endif

# --- what became of them ---
# More names than this do not go into one line of a shell, which holds 128 KiB: lists hold them.
most_named := 1000
# A shard names its own runs, and leaves the lists to others, since many shards are made at a time.
run_lists := $(if $(SHARD),,$(if $(word $(most_named),$(run_files) $(without_files)),yes))
$(if $(run_lists),$(if $(is_dry_run),,$(file >$(STAGES)/runs.list)$(file >$(STAGES)/without.list)\
  $(foreach file,$(run_files),$(file >>$(STAGES)/runs.list,$(file)))$(foreach file,$(without_files),$(file >>$(STAGES)/without.list,$(file)))))
list_of = $(if $(filter $(firstword $2),$(firstword $1) $(lastword $1)),--from $(STAGES)/$3.list)
named = $(if $(run_lists),$(call list_of,$1,$(run_files),runs) $(call list_of,$(lastword $1),$(lastword $(without_files)),without),$1)
# outcomes(WHAT,FILES)
outcomes = most_failed=$(SITE_MAX_FAILED_SHARE) sh $(PIPELINES)run_outcomes.sh $1 $(failed_marks) $(call named,$2)
counted_runs = $(words $1) run$(if $(filter 1,$(words $1)),,s)
# run_there(FILES): options of a tool that evaluates: parts where shards made some (shards.mk), and the other runs.
# framed_there(FILES): for one that wants the frames, which parts have not.
run_there = $$(parts=$(parts_taken) $(call outcomes,there,$1))
framed_there = $(if $(keep_frames),$$($(call outcomes,there,$1)),$(run_there))
# The last goal that has to do with runs comes after the others and lists what failed.
asked := $(filter $(run_goals),$(or $(MAKECMDGOALS),all))
last_goal := $(if $(filter all,$(asked)),all,$(lastword $(asked)))
$(if $(last_goal),$(last_goal): | $(filter-out $(last_goal),$(asked)))
$(or $(last_goal),$(filter-out all,$(run_goals))):
	$(if $(findstring n,$(short_flags)),,$(if $(shell $(call outcomes,failed,$(goal_runs))),@$(call outcomes,list,$(goal_runs))))
