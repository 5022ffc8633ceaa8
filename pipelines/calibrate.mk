# Runs -> observations beside them, with a score, and the values that these do not contradict.
# in: [observed.*], CALIBRATE_FLAGS   out: $(OUT)/calibrate.gpkg, .json, .toml
$(eval $(call remember,calibrate,$(CALIBRATE_FLAGS)))
calibrate_files := $(addprefix $(OUT)/,$(calibrate_products))
calibrate: $(calibrate_files) ## runs -> observations beside them, with a score
$(eval $(call together,$(calibrate_files)))
$(OUT)/calibrate.gpkg: $(OUT)/runs/ensemble.json $(STAGES)/calibrate.txt \
  $(STAGES)/calibrate.flags $(STAGES)/calibrate.files
	$(call say,calibrate: runs -> observations beside them)
	$(Q)$(BIN)talus-calibrate $(site) $(OUT)/runs --trn $(ground_of_runs) $(inputs_given) \
	  -o $(OUT)/calibrate.gpkg --json $(OUT)/calibrate.json \
	  --propose $(OUT)/calibrate.toml $(CALIBRATE_FLAGS) --overwrite $(DB)
	$(call made,talus-calibrate)
