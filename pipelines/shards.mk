# The runs in shards, each a make of its own: by Slurm (slurm.mk), GNU parallel, Snakemake or by hand.
#   make RUNS=400 prepare && parallel make RUNS=400 SHARD={} SHARDS=8 runs-shard ::: 1 2 3 4 5 6 7 8 && make RUNS=400
# in: SHARDS  how many shards    SHARD  which one, from 1; its runs are those at SHARD, SHARD + SHARDS, ...: one that
#     is lost thins the sample and leaves no hole
#     REDUCE      yes: the runs of a shard are brought together in a part (talus-reduce), which maps, fences, places,
#                 hazard and traces are then made from; no: they are not, and all is made from the runs
#     SHARD_LAST  a command, the last step of a shard
# out: its runs, as by `make runs`; $(OUT)/shards/SHARD-of-SHARDS.sqlite: its registry;
#     $(OUT)/parts/SHARD-of-SHARDS.h5: its part, of each of CASES $(OUT)/parts/CASE_SHARD-of-SHARDS.h5, of runs without
#     the fences $(OUT)/parts/without/...; *.runs: what each holds (reduce.sh)
# A shard makes runs alone, never what they read: several would at once. All of the runs stay the set of the maps.

# shard_numbers: a word a run
ifneq ($(SHARDS),)
shard_numbers := $(shell seq 0 $$(($(words $(run_names)) - 1)) | awk -v n=$(SHARDS) '{ print $$1 % n + 1 }')
runs_by_shard := $(join $(run_files:%=%|),$(shard_numbers)) $(if $(without_files),$(join $(without_files:%=%|),$(shard_numbers)))
endif
# of_shard(NUMBER): its files
of_shard = $(patsubst %|$1,%,$(filter %|$1,$(runs_by_shard)))

# --- parts ---
REDUCE ?= yes
parts_taken := $(if $(filter yes,$(REDUCE)),$(OUT)/parts)
# Run-out, with its paths and curves, is made from the runs themselves where the site keeps their frames. Where it does
# not, a part has all that its runs have; those that keep their frames nevertheless stand in none.
keep_frames := $(or $(SITE_FRAMES),$(findstring output.,$(DDA_FLAGS) $(foreach case,$(CASES),$(CASE_$(case)))))
whole_seeds := $(if $(keep_frames)$(filter 0,$(SITE_WHOLE_SHARE)),,$(shell seq $(SEED) $$(($(SEED) + $(RUNS) - 1)) | awk -v s=$(SITE_WHOLE_SHARE) '\
  function up(x) { return x == int(x) ? x : int(x) + 1 } up($$1 * s) > up(($$1 - 1) * s)'))
whole_runs := $(if $(whole_seeds),$(foreach seed,$(whole_seeds),$(filter %/run_$(seed).h5 %_$(seed).h5,$(run_files) $(without_files))))

# --- one shard ---
shard_runs := $(if $(SHARD),$(call of_shard,$(SHARD)))
$(if $(SHARD),$(shard_runs): | $(OUT)/shards)
# What else a shard does when its runs have ended. Another rule file may set it.
SHARD_LAST ?=
# reduced(PART,RUNS): a line of the recipe. The names of many runs are more than a line of the shell holds: a list has
# them.
shard_list = $(OUT)/shards/$(subst /,_,$1)$(SHARD)-of-$(SHARDS).list
write_shard_list = $(if $(is_dry_run),,$(file >$1)$(foreach run,$2,$(file >>$1,$(run))))
define reduced
$(call write_shard_list,$(call shard_list,$1),$2)$(Q)sh $(PIPELINES)reduce.sh make $(OUT)/parts/$1$(SHARD)-of-$(SHARDS).h5 $(failed_marks) $(call shard_list,$1) \
  $(BIN)talus-reduce --trn $(ground_of_runs) $(DB)

endef
# The runs of each case by themselves, since each class of hazard takes those of its case.
reductions = $(foreach kind,runs/ without/,$(foreach case,$(or $(CASES:%=%_),-),$(call reduction,$(kind),$(filter-out -,$(case)))))
reduction = $(call reduced_if,$(filter-out runs/,$1)$2,$(filter-out $(whole_runs),$(filter $(OUT)/$1run_$2%,$(shard_runs))))
reduced_if = $(if $2,$(call reduced,$1,$2))
.PHONY: runs-shard
runs-shard: $(shard_runs) ## SHARD=k SHARDS=n: the runs of one shard (after `make prepare`)
	@$(if $(shard_runs),$(call outcomes,ended,$(shard_runs)))
	$(if $(parts_taken),$(reductions))
	$(if $(SHARD_LAST),$(Q)$(SHARD_LAST))

# --- what comes before the shards ---
.PHONY: prepare
prepare: $(if $(notes_runs),$(run_files) $(without_files)) ## all that runs read, before they are made in shards
	$(call say,$(call counted_runs,$(lacking_runs)) to make)

# --- what comes after them: one registry ---
$(OUT)/shards:
	@mkdir -p $@
registry := $(filter-out --%,$(DB))
shard_registries := $(if $(SHARD)$(notes_runs),,$(wildcard $(OUT)/shards/*.sqlite))
ifneq ($(and $(registry),$(shard_registries)),)
$(OUT)/shards/merged: $(shard_registries) $(wildcard $(OUT)/shards/*.sqlite-wal)
	$(Q)if $(BIN)talus-runs merge $(filter %.sqlite,$^) -o $(registry); then touch $@; else \
	  echo 'the logs of the shards are not merged; the runs are whole, and what is made of them does not need the logs' >&2; fi
$(OUT)/maps/reach.tif $(OUT)/runout.gpkg $(OUT)/report.html $(if $(SITE_FENCES),$(OUT)/fence.gpkg) $(if $(SITE_PLACES),$(OUT)/places.json) $(OUT)/hazard.json $(OUT)/trace.gpkg $(if $(LINE),$(OUT)/profile/profile.gpkg) $(if $(SITE_FENCE_SEARCHES),$(OUT)/search/screen.json): | $(OUT)/shards/merged
%.sqlite-wal: ;
endif
