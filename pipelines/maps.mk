# Runs -> hazard maps (GeoTIFF with style and picture).
# in: MAPS_FLAGS (e.g. --cell-size-m 10)   out: $(OUT)/maps/*.tif, .qml, .png
$(eval $(call remember,maps,$(EVALUATE_FLAGS) $(MAPS_FLAGS)))
map_names := reach velocity ke_translational ke_total pass_height_centroid \
  pass_height_top exceedance deposit arrival energy_line
map_files := $(foreach suffix,tif png qml,$(map_names:%=$(OUT)/maps/%.$(suffix)))
maps: $(map_files) ## runs -> velocity, energy, height, reach
$(eval $(call together,$(map_files)))
$(OUT)/maps/reach.tif: $(run_files) $(OUT)/blocks.h5 $(STAGES)/runs.flags $(STAGES)/maps.flags $(call named_in,$(MAPS_FLAGS))
	$(BIN)talus-maps $(run_files) --trn $(OUT)/bed.tif -o $(OUT)/maps --png $(EVALUATE_FLAGS) $(MAPS_FLAGS) --overwrite $(DB)
