# The runs in shards, each a make of its own: by Slurm (slurm.mk), GNU parallel, Snakemake or by hand.
#   make RUNS=400 prepare && parallel make RUNS=400 SHARD={} SHARDS=8 runs-shard ::: 1 2 3 4 5 6 7 8 && make RUNS=400
# in: SHARDS  how many shards    SHARD  which one, from 1; its runs are those at SHARD, SHARD + SHARDS, ...: one that
#     is lost thins the sample and leaves no hole
#     SHARD_LAST  a command, the last step of a shard
# out: its runs, as by `make runs`; $(OUT)/shards/SHARD-of-SHARDS.sqlite: its registry
# A shard makes runs alone, never what they read: several would at once. All of the runs stay the set of the maps.

# shard_numbers: a word a run
ifneq ($(SHARDS),)
shard_numbers := $(shell seq 0 $$(($(words $(run_names)) - 1)) | awk -v n=$(SHARDS) '{ print $$1 % n + 1 }')
runs_by_shard := $(join $(run_files:%=%|),$(shard_numbers)) $(if $(without_files),$(join $(without_files:%=%|),$(shard_numbers)))
endif
# of_shard(NUMBER): its files
of_shard = $(patsubst %|$1,%,$(filter %|$1,$(runs_by_shard)))

# --- one shard ---
shard_runs := $(if $(SHARD),$(call of_shard,$(SHARD)))
$(if $(SHARD),$(shard_runs): | $(OUT)/shards)
# What else a shard does when its runs have ended, e.g. bring those with a result, $(call run_there,$(shard_runs)),
# together in one file. Another rule file may set it.
SHARD_LAST ?=
.PHONY: runs-shard
runs-shard: $(shard_runs) ## SHARD=k SHARDS=n: the runs of one shard (after `make prepare`)
	@$(if $(shard_runs),$(call outcomes,ended,$(shard_runs)))
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
	$(Q)$(BIN)talus-runs merge $(filter %.sqlite,$^) -o $(registry) && touch $@
$(OUT)/maps/reach.tif $(OUT)/runout.gpkg $(OUT)/report.html $(if $(SITE_FENCES),$(OUT)/fence.gpkg) $(if $(SITE_PLACES),$(OUT)/places.json) $(OUT)/hazard.json $(OUT)/trace.gpkg $(if $(SITE_FENCE_SEARCHES),$(OUT)/search/screen.json): | $(OUT)/shards/merged
%.sqlite-wal: ;
endif
