# Runs -> what crosses a line that was drawn after them, and a profile along it.
# in: LINE (a file with one line: GeoJSON, GeoPackage, Shapefile),
#     PROFILE_FLAGS (e.g. --bin-m 5 --line-layer roads)
# out: $(OUT)/profile/profile.gpkg, .json, crossings.csv, bins.csv, stations.csv, *.svg
# Another LINE replaces them: make profile LINE=road.geojson. Nothing else needs them.
ifneq ($(LINE),)
$(eval $(call remember,profile,$(LINE) $(PROFILE_FLAGS)))
profile_files := $(addprefix $(OUT)/,$(profile_products))
$(eval $(call together,$(profile_files)))
profile_folder := $(OUT)/profile
$(OUT)/profile/profile.gpkg: $(OUT)/runs/ensemble.json $(STAGES)/profile.flags \
  $(STAGES)/profile.files
	$(call say,profile: runs -> what crosses $(LINE))
	@mkdir -p $(profile_folder)
	$(Q)$(BIN)talus-profile $(OUT)/runs --trn $(ground_of_runs) --line-file '$(LINE)' -o $@ \
	  --json $(profile_folder)/profile.json --csv $(profile_folder)/crossings.csv \
	  --bins $(profile_folder)/bins.csv --stations $(profile_folder)/stations.csv \
	  --charts $(profile_folder) $(PROFILE_FLAGS) --overwrite $(DB)
	$(call made,talus-profile)
endif
profile: $(profile_files) ## runs -> what crosses a LINE drawn afterwards
