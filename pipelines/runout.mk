# Runs -> deposit, paths, run-out, angle of reach, mobility.
# in: RUNOUT_FLAGS (e.g. --friction-deg 30)   out: $(OUT)/runout.gpkg, .json, .csv, .svg, $(OUT)/runs.csv, sensitivity.csv, curves.csv,
# $(OUT)/thickness.tif
$(eval $(call remember,runout,$(evaluate_flags) $(RUNOUT_FLAGS)))
runout_files := $(addprefix $(OUT)/,$(runout_products))
runout: $(runout_files) ## runs -> deposit, paths, angle of reach
$(eval $(call together,$(runout_files)))
$(OUT)/runout.gpkg: $(run_files) $(OUT)/blocks.h5 $(STAGES)/runs.flags $(STAGES)/runout.flags $(STAGES)/runout.files
	$(call say,runout: $(call counted_runs,$(run_files)) -> run-out)
	@$(call outcomes,some,$(run_files))
	$(Q)$(BIN)talus-runout $(call framed_there,$(run_files)) --trn $(ground_of_runs) -o $(OUT)/runout.gpkg --json $(OUT)/runout.json --tables $(OUT) \
	  --thickness $(OUT)/thickness.tif $(evaluate_flags) $(RUNOUT_FLAGS) --overwrite $(DB)
	$(call made,talus-runout)
