# The runs as an array of jobs on Slurm, then a job that makes the rest. Prints it with -n.
#   make submit SHARDS=40 SBATCH_FLAGS='-A account -p partition -t 240 -c 4' RUNS=10000
# in: SHARDS          how many jobs at most; 10 to 60 minutes of work each
#     SBATCH_FLAGS    word for word to sbatch, for the shards and for the last job; -c: cores, so many runs at once
#     SHARDS_AT_ONCE  at most so many jobs at a time
#     FINAL           goals of the last job (all)
# out: $(OUT)/shards/log/*.txt, $(OUT)/shards/jobs: the jobs sent
# Sent again, it sends only the shards that lack runs. Jobs get the variables that make was given, and make again what
# they name; a node that dies, or a job that is preempted, is made up for elsewhere (--requeue): its runs go on where
# they were.
FINAL ?= all
.PHONY: submit

# Of the command line, and of the environment what these rules know.
known_variables := OUT BIN CONTOURS DEM RUNS SEED CASES WEIGHTS WITHOUT DB REDUCE SHARD_LAST EVALUATE_FLAGS \
  $(foreach stage,TIN TRN BLOCKS CHECK DDA RUNOUT MAPS FENCE PLACES HAZARD TRACE REPORT,$(stage)_FLAGS) $(filter CASE_%,$(.VARIABLES))
not_handed_on := SHARD SHARDS SHARDS_AT_ONCE SBATCH_FLAGS FINAL BIN SENT MAKEOVERRIDES MAKEFLAGS MFLAGS GNUMAKEFLAGS -% .%
given_variables = $(filter-out $(not_handed_on),$(foreach name,$(.VARIABLES),$(if $(filter command override,$(firstword $(origin $(name)))),$(name))) \
  $(foreach name,$(known_variables),$(if $(filter environment,$(firstword $(origin $(name)))),$(name))))
# The tools by their folder: the search path of a job may be another one.
tools_there = $(or $(BIN),$(dir $(shell command -v talus-dda)))
# make_there(ARGUMENTS): the make of a job. It must not take what a make hands on to those that it starts itself.
make_there = unset MAKEFLAGS MFLAGS MAKELEVEL; exec make -C $(call quoted,$(CURDIR)) $(call quoted,BIN=$(tools_there)) \
  $(foreach name,$(sort $(given_variables)),$(call quoted,$(name)=$(value $(name)))) $1 -j "$${SLURM_CPUS_PER_TASK:-1}"

lacking_shards = $(foreach shard,$(sort $(shard_numbers)),$(if $(filter $(lacking_runs),$(call of_shard,$(shard))),$(shard)))
commas = $(subst $(empty) $(empty),$(comma),$(strip $1))
comma := ,
empty :=
array = $(if $(filter $(words $(lacking_shards)),$(words $(sort $(shard_numbers)))),1-$(words $(lacking_shards)),$(call commas,$(lacking_shards)))
sbatch = sbatch --parsable --ntasks=1 --requeue --open-mode=append
send_shards = id=$$($(sbatch) --job-name=talus --array=$(array)$(if $(SHARDS_AT_ONCE),%$(SHARDS_AT_ONCE)) --output=$(OUT)/shards/log/%A_%a.txt \
  $(SBATCH_FLAGS) --wrap $(call quoted,$(call make_there,SHARD=$$SLURM_ARRAY_TASK_ID SHARDS=$(SHARDS) runs-shard))) && id=$${id%%;*} && \
  echo $$id >$(OUT)/shards/jobs && echo "submit: job $$id: shards $(array) of $(SHARDS), $(call counted_runs,$(lacking_runs)) to make"
send_final = final=$$($(sbatch) --job-name=talus-final --output=$(OUT)/shards/log/final_%j.txt $(SBATCH_FLAGS) \
  $(if $(lacking_runs),--dependency=afterok:$$id --kill-on-invalid-dep=yes) --wrap $(call quoted,$(call make_there,SENT=yes $(FINAL)))) && \
  final=$${final%%;*} && echo $$final >>$(OUT)/shards/jobs && echo "submit: job $$final: make $(FINAL)$(if $(lacking_runs),$(comma) once these have ended well); words of the jobs: $(OUT)/shards/log"

submit: $(if $(notes_runs),$(run_files) $(without_files)) ## SHARDS=n: the runs as jobs of Slurm, then the rest
	@mkdir -p $(OUT)/shards/log && rm -f $(OUT)/shards/jobs
	$(Q)$(if $(lacking_runs),$(send_shards) && )\
	  $(send_final)
