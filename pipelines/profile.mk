# Runs -> crossings of a line that was drawn after them, and a profile along it.
# in: LINE (a file with one line: road.geojson, "map.gpkg|layername=roads"),
#     PROFILE_FLAGS (e.g. --bin-m 5)
# out: $(OUT)/profile/profile.gpkg, .json, crossings.csv, bins.csv, stations.csv, *.svg
# Another LINE replaces them: make profile LINE=road.geojson. Nothing else needs them.
ifneq ($(LINE),)
$(eval $(call remember,profile,$(LINE) $(PROFILE_FLAGS)))
profile_files := $(addprefix $(OUT)/,$(profile_products))
$(eval $(call together,$(profile_files)))
$(OUT)/profile/profile.gpkg: $(OUT)/runs/ensemble.json $(STAGES)/profile.flags \
  $(STAGES)/profile.files
	$(call say,profile: runs -> what crosses $(LINE))
	@mkdir -p $(OUT)/profile
	$(Q)$(BIN)talus-profile $(OUT)/runs --trn $(ground_of_runs) \
	  --line-file '$(subst ','\'',$(LINE))' -o $@ --json $(OUT)/profile/profile.json \
	  --tables $(OUT)/profile $(PROFILE_FLAGS) --overwrite $(DB)
	$(call made,talus-profile)
endif
profile: $(profile_files) ## runs -> what crosses a LINE drawn afterwards
