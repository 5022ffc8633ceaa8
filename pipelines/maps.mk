# Runs -> hazard maps (GeoTIFF with style and picture).
# in: MAPS_FLAGS (e.g. --cell-size-m 10)   out: $(OUT)/maps/*.tif, .qml, .png
$(eval $(call remember,maps,$(evaluate_flags) $(MAPS_FLAGS)))
map_files := $(addprefix $(OUT)/,$(map_products))
maps: $(map_files) ## runs -> velocity, energy, height, reach
$(eval $(call together,$(map_files)))
$(OUT)/maps/reach.tif: $(run_files) $(OUT)/blocks.h5 $(STAGES)/runs.flags $(STAGES)/maps.flags $(STAGES)/maps.files
	$(call say,maps: $(call counted_runs,$(run_files)) -> maps)
	@$(call outcomes,some,$(run_files))
	$(Q)$(BIN)talus-maps $(call run_there,$(run_files)) --trn $(OUT)/bed.tif -o $(OUT)/maps --png $(evaluate_flags) $(MAPS_FLAGS) --overwrite $(DB)
	$(call made,talus-maps)
