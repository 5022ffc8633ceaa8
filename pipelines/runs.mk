# Blocks on their bed -> runs, by talus-batch: those that lack, several at a time, and their
# outcome.
# in: site.toml, DDA_FLAGS
#   RUNS, SEED  how many seeds, from which one ([solver] n_runs and seed); RUNS=auto, RUNS_MOST
#   WITHOUT     yes: also the runs without fences; when not given: where the site has an active
#        fence. A measure may share those of the site (inputs.mk)
#   SHARD, SHARDS  which of the runs, of several makes that share them (slurm.mk)
# out: $(OUT)/runs/run_SEED.h5, of variants with a weight runs/NAME/run_SEED.h5, runs/ensemble.json;
#     without/ alike
# ensemble.json changes when a run does. Results depend on it, not on the times of runs.
WITHOUT ?= $(SITE_FENCES_STAND)
without := $(if $(filter yes,$(WITHOUT)),$(or $(shared_without),$(OUT)/without))
kinds := runs $(if $(filter $(OUT)/without,$(without)),without)
ensembles := $(kinds:%=$(OUT)/%/ensemble.json)

option_of = $(if $($1),$2 $(call quoted,$($1)))
batch = $(lastword $(BIN))talus-batch $(site) --results $(OUT) $(if $(BIN),--launcher '$(BIN)')
# batch_of(KIND,OPTIONS)
batch_of = $(batch) --into $1 $(call option_of,RUNS,--runs) $(call option_of,SEED,--seed) \
  $(call option_of,RUNS_MOST,--most) $2 -- $(DDA_FLAGS) \
  $(if $(filter without,$1),$(SITE_WITHOUT_FENCES))
# Status by talus-batch: current or stale, runs to make, parts that lack some, the seed
# after them, how many they are, rock masses.
status_of = $(shell $(call batch_of,$1,--status --no-db --part $(or $(SHARD),0)/$(or $(SHARDS),1)))
ask = $(eval status_$1 := $(status_of))$(if $(status_$1),,$(error The runs cannot be made, see \
  above: what is wrong with RUNS, SEED, SHARD, SHARDS, DDA_FLAGS or the site))
$(if $(filter-out terrain source blocks stability,$(wanted)),\
  $(foreach kind,$(kinds),$(call ask,$(kind))))

# Rocks that each run draws are then made by talus-batch, which knows no BLOCKS_FLAGS.
$(if $(and $(filter auto,$(RUNS)),$(SITE_ROCKS_ALONE),$(strip $(BLOCKS_FLAGS))),$(error \
  RUNS=auto makes the rocks of further runs without BLOCKS_FLAGS: write in site.toml what they say))

# A run that failed stops no other (3): make continues with the rest, and ends with an error.
some_failed := || test $$? = 3
rock_masses := $(wordlist 6,9999,$(status_runs))
# Terrain for the evaluation of runs: the beds of several masses differ, the terrain before them
# does not.
ground_of_runs := $(OUT)/$(if $(rock_masses),trn,bed).tif
before_runs := $(OUT)/blocks.h5 $(rock_masses:%=$(OUT)/rock/blocks_%.h5)
define runs_of
$(OUT)/$1/ensemble.json: $(before_runs) $(if $(filter stale,$(status_$1)),stale-runs) | \
  $(OUT)/check.html $(if $(filter without,$1),$(OUT)/runs/ensemble.json)
	$$(call say,batch: $1)
	$$(call taken_runs,$1)
	$$(Q)$$(call batch_of,$1,$$(DB)) $$(some_failed)
	@[ $$@ -nt $(OUT)/blocks.h5 ] || touch -c $$@
endef
.PHONY: stale-runs
$(if $(SHARD),,$(foreach kind,$(kinds),$(eval $(call runs_of,$(kind)))))
runs: $(ensembles) ## blocks -> runs (RUNS=50: with 50 seeds)

# The last goal that has to do with runs comes after the rest and lists failed runs.
asked := $(filter $(run_goals),$(wanted))
last_goal := $(or $(filter all,$(asked)),$(lastword $(asked)))
with_runs_alone := maps runout places calibrate hazard trace profile fence-search
goal_kinds := $(if $(filter-out $(with_runs_alone),$(asked)),$(kinds),runs)
$(if $(last_goal),$(last_goal): | $(filter-out $(last_goal),$(asked)))
has_failed = $(shell $(call batch_of,$1,--status --no-db) >/dev/null 2>&1 || echo yes)
list_failed = $(if $(call has_failed,$1),@$(call batch_of,$1,--status --no-db)$(newline))
ifeq ($(is_dry_run)$(SHARD),)
$(or $(last_goal),runs):
	$(foreach kind,$(goal_kinds),$(call list_failed,$(kind)))
	$(if $(filter all report variants,$(asked)),$(foreach \
	  name,$(measures),$(call failed_measure,$(name))))
endif
define newline


endef

# --- shards: by Slurm (slurm.mk), GNU parallel, Snakemake or by hand ---
# They make only runs, never the inputs of runs: several would at once.
.PHONY: prepare runs-shard
prepare: $(before_runs) $(OUT)/check.html ## all that runs read, before they are made in shards
	$(call say,$(foreach kind,$(kinds),$(kind): $(word 2,$(status_$(kind))) to make))
part_of = $(Q)$(call batch_of,$1,--part $(SHARD)/$(SHARDS) $(DB)) $(some_failed)$(newline)
runs-shard: $(before_runs) ## SHARD=k SHARDS=n: the runs of one shard (after `make prepare`)
	@mkdir -p $(OUT)/shards
	$(foreach kind,$(kinds),$(call part_of,$(kind)))
# One registry comes after them.
shard_registries := $(if $(SHARD)$(alone),,$(wildcard $(OUT)/shards/*.sqlite))
ifneq ($(and $(filter-out --%,$(DB)),$(shard_registries)),)
$(OUT)/shards/merged: $(shard_registries) $(wildcard $(OUT)/shards/*.sqlite-wal)
	$(Q)$(BIN)talus-runs merge $(shard_registries) -o $(filter-out --%,$(DB)) && touch $@ || \
	  echo 'the logs of the shards are not merged; results do not need them' >&2
$(ensembles): | $(OUT)/shards/merged
%.sqlite-wal: ;
endif
