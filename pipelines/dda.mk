# Blocks on their bed -> runs, each a job of its own (make -j).
# in: site.toml, DDA_FLAGS   out: $(OUT)/runs/run_SEED.h5, and $(OUT)/without/run_SEED.h5 without the fences
#   RUNS, SEED  how many seeds, counted up from which ([solver] n_runs and seed)
#   CASES       names of variants, CASE_<name> the options of each; RUNS of each are made, e.g.
#               CASES = low high, CASE_low = --set ground.slope.friction_deg=28, CASE_high = ...
#   WITHOUT     yes: also the runs without fences; when not given: where a fence of the site stands
# A run that was stopped goes on where it was (--resume). One that fails its health ends make, but
# not where what evaluates it may take it (EVALUATE_FLAGS).
RUNS ?= $(SITE_RUNS)
SEED ?= $(SITE_SEED)
WITHOUT ?= $(SITE_FENCES_STAND)

seeds := $(shell seq $(SEED) $$(($(SEED) + $(RUNS) - 1)))
run_names := $(if $(CASES),$(foreach case,$(CASES),$(addprefix $(case)_,$(seeds))),$(seeds))
run_files := $(run_names:%=$(OUT)/runs/run_%.h5)
without_files := $(if $(filter yes,$(WITHOUT)),$(run_names:%=$(OUT)/without/run_%.h5))
runs: $(run_files) $(without_files) ## blocks -> runs (RUNS=50: with 50 seeds)

$(eval $(call remember,dda,$(DDA_FLAGS)))
$(eval $(call remember,runs,$(run_files) $(without_files)))
$(foreach case,$(CASES),$(eval $(call remember,case_$(case),$(CASE_$(case)))))

# Of the name CASE_SEED or SEED that a run has.
run_options = --seed $(lastword $(subst _, ,$*)) $(CASE_$(firstword $(subst _, ,$*))) $(DDA_FLAGS)
dda = $(BIN)talus-dda site.toml --trn $(OUT)/bed.tif --blocks $(OUT)/blocks.h5 -o $@ $(run_options) --resume --overwrite $(DB)
may_fail := $(if $(filter --allow-unfinished,$(EVALUATE_FLAGS)),|| [ $$? -eq 3 ])

$(run_files) $(without_files): $(OUT)/blocks.h5 $(STAGES)/run.txt $(STAGES)/dda.flags $(call named_in,$(filter-out %.xmf,$(DDA_FLAGS))) | $(OUT)/runs $(OUT)/without
$(foreach case,$(CASES),$(eval $(filter $(OUT)/runs/run_$(case)_% $(OUT)/without/run_$(case)_%,$(run_files) $(without_files)): $(STAGES)/case_$(case).flags $(call named_in,$(CASE_$(case)))))
$(OUT)/runs/run_%.h5:
	$(dda) $(may_fail)
$(OUT)/without/run_%.h5:
	$(dda) $(SITE_FENCES:%=--set fence.%.active=false) $(may_fail)
