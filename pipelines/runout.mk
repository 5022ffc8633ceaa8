# Runs -> deposit, paths, run-out, angle of reach, mobility.
# in: RUNOUT_FLAGS (e.g. --friction-deg 30)
# out: $(OUT)/runout.gpkg, .json, .csv, .svg, $(OUT)/runs.csv, sensitivity.csv, curves.csv,
#     thickness.tif
$(eval $(call remember,runout,$(RUNOUT_FLAGS)))
runout_files := $(addprefix $(OUT)/,$(runout_products))
runout: $(runout_files) ## runs -> deposit, paths, angle of reach
$(eval $(call together,$(runout_files)))
$(OUT)/runout.gpkg: $(OUT)/runs/ensemble.json $(STAGES)/runout.flags $(STAGES)/runout.files
	$(call say,runout: runs -> run-out)
	$(Q)$(BIN)talus-runout $(OUT)/runs --trn $(ground_of_runs) -o $(OUT)/runout.gpkg \
	  --json $(OUT)/runout.json --tables $(OUT) --thickness $(OUT)/thickness.tif $(RUNOUT_FLAGS) \
	  --overwrite $(DB)
	$(call made,talus-runout)
