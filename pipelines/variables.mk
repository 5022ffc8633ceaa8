# What make is given is looked at before anything runs.
# in: OUT (site.mk), RUNS, SEED, WITHOUT, CASES, WEIGHTS (dda.mk), SHARD, SHARDS, REDUCE (shards.mk), LINE (profile.mk)   out: an error that says what is expected

# A word of a rule and of a recipe: neither can carry what make or the shell would part or run.
ifneq ($(words $(OUT)),1)
$(error OUT is '$(OUT)', expected the name of a folder without blanks; the site's own folder may have some)
endif
$(foreach sign,' " ` $$ ; & | < > * ? : %,$(if $(findstring $(sign),$(OUT)),$(error OUT is $(OUT), expected the name of a folder without $(sign))))
override OUT := $(strip $(OUT))
ifeq ($(realpath $(OUT)),$(realpath .))
$(error OUT is $(OUT), the site's own folder, whose files results would replace: name another one, e.g. OUT=out2)
endif
$(if $(filter profile,$(MAKECMDGOALS)),$(if $(LINE),,$(error profile needs LINE, a file with one line: make profile LINE=road.geojson)))
ifneq ($(LINE),)
line_file := $(firstword $(subst |, ,$(LINE)))
$(if $(findstring |,$(LINE)),,$(if $(word 2,$(LINE)),$(error LINE is '$(LINE)', expected the name of one file without blanks)))
$(foreach sign,' " ` $$ ; & < > * ? : %,$(if $(findstring $(sign),$(line_file)),$(error LINE is $(LINE), expected a file name without $(sign))))
$(if $(wildcard $(line_file)),,$(error LINE is $(LINE): there is no such file))
endif

no_digits = $(subst 0,,$(subst 1,,$(subst 2,,$(subst 3,,$(subst 4,,$(subst 5,,$(subst 6,,$(subst 7,,$(subst 8,,$(subst 9,,$1))))))))))
is_number = $(and $(filter 1,$(words $1)),$(if $(call no_digits,$(strip $1)),,yes))
$(if $(and $(filter auto,$(RUNS)),$(SHARDS)),$(error RUNS=auto decides from runs that are there: give a number with SHARDS))
ifneq ($(strip $(RUNS)),auto)
ifneq ($(origin RUNS),undefined)
$(if $(and $(call is_number,$(RUNS)),$(subst 0,,$(RUNS))),,$(error RUNS is '$(RUNS)', expected a whole number, 1 or more, or auto))
endif
endif
ifneq ($(origin SEED),undefined)
$(if $(call is_number,$(SEED)),,$(error SEED is '$(SEED)', expected a whole number, 0 or more))
endif
shard_goals := $(filter submit prepare runs-shard,$(MAKECMDGOALS))
$(if $(word 2,$(shard_goals))$(if $(shard_goals),$(filter-out $(shard_goals),$(MAKECMDGOALS))),$(error $(firstword $(shard_goals)) stands alone: give other goals to a make of their own))
$(if $(filter runs-shard,$(shard_goals)),$(if $(and $(SHARD),$(SHARDS)),,$(error runs-shard needs SHARD and SHARDS, e.g. make SHARD=1 SHARDS=8 runs-shard)))
$(if $(filter submit,$(shard_goals)),$(if $(SHARDS),,$(error submit needs SHARDS, the number of jobs, e.g. 40: so that each takes 10 to 60 minutes)))
$(foreach name,SHARD SHARDS SHARDS_AT_ONCE,$(if $($(name)),$(if $(and $(call is_number,$($(name))),$(subst 0,,$($(name)))),,$(error $(name) is '$($(name))', expected a whole number, 1 or more))))
$(if $(SHARD),$(if $(filter runs-shard,$(shard_goals)),,$(error SHARD goes with the goal runs-shard))$(if $(filter-out $(shell seq $(or $(SHARDS),1)),$(SHARD)),$(error SHARD is $(SHARD), expected a number up to SHARDS: $(SHARDS))))
$(if $(filter-out yes no,$(REDUCE)),$(error REDUCE is '$(REDUCE)', expected yes or no))
$(if $(filter-out yes no,$(WITHOUT)),$(error WITHOUT is '$(WITHOUT)', expected yes or no))
$(foreach one,$(WEIGHTS),$(if $(filter $(firstword $(subst =, ,$(one))),$(CASES)),,$(error WEIGHTS names '$(one)', expected CASE=NUMBER for each of CASES: $(CASES))))
$(if $(WEIGHTS),$(foreach case,$(CASES),$(if $(filter $(case)=%,$(WEIGHTS)),,$(error WEIGHTS has none of case $(case), expected CASE=NUMBER for each of CASES))))
$(foreach case,$(CASES),$(if $(or $(findstring _,$(case)),$(findstring /,$(case))),$(error CASES names '$(case)', expected a name without _ and /, since files are named run_CASE_SEED.h5)))
