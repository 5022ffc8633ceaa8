# The runs as an array of jobs on Slurm, then a job that makes the rest. Prints it with -n.
#   make submit SHARDS=40 SBATCH_FLAGS='-A account -p partition -t 240 -c 4' RUNS=10000
# in: SHARDS          how many jobs at most; 10 to 60 minutes of work each
#     SBATCH_FLAGS    word for word to sbatch, for the shards and the last job; -c: runs at once
#     SHARDS_AT_ONCE  at most so many jobs at a time
#     FINAL           goals of the last job (all)
# out: $(OUT)/shards/log/*.txt, $(OUT)/shards/jobs: the jobs sent
# Sent again, it sends only the shards that lack runs. Jobs get the variables that make was given. A
# job whose node dies, or that is preempted, begins again elsewhere: its runs resume where they
# were.
FINAL ?= all
.PHONY: submit

# Of the command line, and those of the environment that these rules know.
known_variables := OUT BIN CONTOURS DEM RUNS RUNS_MOST SEED VARIANT BASE WITHOUT DB LINE \
  VERIFY_RUNS $(filter %_FLAGS,$(.VARIABLES))
not_handed_on := SHARD SHARDS SHARDS_AT_ONCE SBATCH_FLAGS FINAL BIN SENT MAKEOVERRIDES MAKEFLAGS \
  MFLAGS GNUMAKEFLAGS -% .%
is_given = $(filter command override $(if $(filter $1,$(known_variables)),environment),$(firstword \
  $(origin $1)))
given_variables = $(sort $(foreach name,$(filter-out $(not_handed_on),$(.VARIABLES)),$(if $(call \
  is_given,$(name)),$(name))))
# The tools by their folder: the search path of a job may be another one.
tools_there = $(or $(BIN),$(dir $(shell command -v talus-dda)))
# make_there(ARGUMENTS): the make of a job, without the variables that a make hands on to those that
# it starts.
make_there = unset MAKEFLAGS MFLAGS MAKELEVEL; exec make -C $(call quoted,$(CURDIR)) \
  $(call quoted,BIN=$(tools_there)) $(foreach name,$(given_variables),$(call \
  quoted,$(name)=$(value $(name)))) $1 -j "$${SLURM_CPUS_PER_TASK:-1}"

comma := ,
parts := $(filter-out -,$(foreach kind,$(kinds),$(word 3,$(status_$(kind)))))
array = $(subst $(subst ,, ),$(comma),$(strip $(sort $(parts))))
sbatch = sbatch --parsable --ntasks=1 --requeue --open-mode=append $(SBATCH_FLAGS)
log := $(OUT)/shards/log
send_shards = id=$$($(sbatch) --job-name=talus --array=$(array)$(SHARDS_AT_ONCE:%=\%%) \
  --output=$(log)/%A_%a.txt --wrap $(call quoted,$(call make_there,SHARD=$$SLURM_ARRAY_TASK_ID \
  SHARDS=$(SHARDS) runs-shard))) && id=$${id%%;*} && echo $$id >$(OUT)/shards/jobs && \
  echo "submit: job $$id: shards $(array) of $(SHARDS)" &&
send_final = final=$$($(sbatch) --job-name=talus-final --output=$(log)/final_%j.txt $(if \
  $(parts),--dependency=afterok:$$id --kill-on-invalid-dep=yes) --wrap $(call quoted,$(call \
  make_there,SENT=yes $(FINAL)))) && final=$${final%%;*} && echo $$final >>$(OUT)/shards/jobs && \
  echo "submit: job $$final: make $(FINAL)$(if $(parts),$(comma) once these have ended well)"

submit: $(before_runs) $(OUT)/check.html ## SHARDS=n: the runs as jobs of Slurm, then the rest
	@mkdir -p $(log) && rm -f $(OUT)/shards/jobs
	$(Q)$(if $(parts),$(send_shards)) $(send_final)
