# Runs -> what crosses a line that was drawn after them, and a profile along it.
# in: LINE (a file with one line: road.geojson, "map.gpkg|layername=roads"), PROFILE_FLAGS (e.g. --bin-m 5)
# out: $(OUT)/profile/profile.gpkg, .json, crossings.csv, bins.csv, stations.csv, *.svg
# Another LINE replaces them: make profile LINE=road.geojson. Nothing else needs them.
ifneq ($(LINE),)
$(eval $(call remember,profile,$(LINE) $(evaluate_flags) $(PROFILE_FLAGS)))
profile_files := $(addprefix $(OUT)/,$(profile_products))
$(eval $(call together,$(profile_files)))
$(OUT)/profile/profile.gpkg: $(run_files) $(OUT)/blocks.h5 $(STAGES)/runs.flags $(STAGES)/profile.flags $(STAGES)/profile.files | $(OUT)/profile
	$(call say,profile: $(call counted_runs,$(run_files)) -> what crosses $(LINE))
	@$(call outcomes,some,$(run_files))
	$(Q)$(BIN)talus-profile $(call framed_there,$(run_files)) --trn $(ground_of_runs) --line-file '$(subst ','\'',$(LINE))' -o $@ --json $(OUT)/profile/profile.json \
	  --tables $(OUT)/profile $(evaluate_flags) $(PROFILE_FLAGS) --overwrite $(DB)
	$(call made,talus-profile)
$(OUT)/profile:
	@mkdir -p $@
endif
profile: $(profile_files) ## runs -> what crosses a LINE drawn afterwards
