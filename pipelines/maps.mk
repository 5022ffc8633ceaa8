# Runs -> hazard maps (GeoTIFF with style and page).
# in: MAPS_FLAGS (e.g. --cell-size-m 10)
# out: $(OUT)/maps/*.tif, .qml, .png, .pdf; of variants with a weight also $(OUT)/maps/NAME/*; of a
#     measure maps/compare.tif: the measure minus the site as it is
$(eval $(call remember,maps,$(MAPS_FLAGS)))
map_files := $(addprefix $(OUT)/,$(map_products))
maps: $(map_files) ## runs -> velocity, energy, height, reach
$(eval $(call together,$(map_files)))
maps_tool = $(BIN)talus-maps $1 --trn $(ground_of_runs) --pages png,pdf $(MAPS_FLAGS) \
  --overwrite $(DB)
$(OUT)/maps/reach.tif: $(OUT)/runs/ensemble.json $(BASE:%=%/runs/ensemble.json) \
  $(STAGES)/maps.flags $(STAGES)/maps.files
	$(call say,maps: runs -> maps)
	$(Q)$(call maps_tool,$(OUT)/runs) -o $(OUT)/maps $(BASE:%=--compare %/runs)
	$(call made,talus-maps)

# The maps of each case alone, with one window: a map of all may be true of none.
maps_of_case = $(map_products:maps/%=$(OUT)/maps/$1/%)
case_map_files := $(foreach case,$(several_cases),$(call maps_of_case,$(case)))
maps: $(case_map_files)
define map_case
$(call together,$(call maps_of_case,$1))
$(firstword $(call maps_of_case,$1)): $(OUT)/maps/reach.tif
	$$(call say,maps: case $1 -> maps)
	$$(Q)$$(call maps_tool,$(OUT)/runs/$1) -o $(OUT)/maps/$1 --window-of $(OUT)/maps/reach.tif
	$$(call made,talus-maps)
endef
$(foreach case,$(several_cases),$(eval $(call map_case,$(case))))
