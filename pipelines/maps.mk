# Runs -> hazard maps (GeoTIFF with style and page).
# in: MAPS_FLAGS (e.g. --cell-size-m 10)   out: $(OUT)/maps/*.tif, .qml, .png, .pdf; of several CASES also $(OUT)/maps/CASE/*
$(eval $(call remember,maps,$(evaluate_flags) $(MAPS_FLAGS)))
map_files := $(addprefix $(OUT)/,$(map_products))
maps: $(map_files) ## runs -> velocity, energy, height, reach
$(eval $(call together,$(map_files)))
$(OUT)/maps/reach.tif: $(run_files) $(OUT)/blocks.h5 $(STAGES)/runs.flags $(STAGES)/maps.flags $(STAGES)/maps.files
	$(call say,maps: $(call counted_runs,$(run_files)) -> maps)
	@$(call outcomes,some,$(run_files))
	$(Q)$(BIN)talus-maps $(call run_there,$(run_files)) --trn $(ground_of_runs) -o $(OUT)/maps --pages png,pdf $(evaluate_flags) $(MAPS_FLAGS) --overwrite $(DB)
	$(call made,talus-maps)

# --- the maps of each case by themselves, with one window: what cases have in common may be none of them ---
several_cases := $(if $(word 2,$(CASES)),$(CASES))
maps_of_case = $(map_products:maps/%=$(OUT)/maps/$1/%)
case_map_files := $(foreach case,$(several_cases),$(call maps_of_case,$(case)))
maps: $(case_map_files)
define map_case
$(call together,$(call maps_of_case,$1))
$(firstword $(call maps_of_case,$1)): $(OUT)/maps/reach.tif
	$$(call say,maps: case $1 -> maps)
	$$(Q)ls $(OUT)/runs/run_$1_*.h5 >/dev/null 2>&1 || exit 0; $$(BIN)talus-maps $$(call run_there,$$(run_files)) --only-case $1 --trn $$(ground_of_runs) \
	  -o $(OUT)/maps/$1 --window-of $(OUT)/maps/reach.tif --pages png,pdf $$(class_flags) $$(MAPS_FLAGS) --overwrite $$(DB)
	@ls $(OUT)/runs/run_$1_*.h5 >/dev/null 2>&1 || exit 0; $$(patsubst @%,%,$$(call made,talus-maps))
endef
$(foreach case,$(several_cases),$(eval $(call map_case,$(case))))
