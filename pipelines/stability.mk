# Blocks on their bed -> the factor of safety of the mass, and the water at which it fails.
# in: site.toml, STABILITY_FLAGS (e.g. --seismic 0.1)
# out: $(OUT)/stability/stability.json, blocks.gpkg, with [water] levels.svg
# It takes many short runs: the look before the runs and the report have one that was asked for, now
# or before.
$(eval $(call remember,stability,$(STABILITY_FLAGS)))
stability_files := $(addprefix $(OUT)/stability/,stability.json blocks.gpkg \
  $(if $(SITE_WATER),levels.svg))
stability: $(stability_files) ## blocks -> factor of safety, and the water at which it fails
$(eval $(call together,$(stability_files)))
$(OUT)/stability/stability.json: $(OUT)/blocks.h5 $(STAGES)/stability.txt \
  $(STAGES)/stability.flags $(STAGES)/stability.files
	$(call not_in_a_shard,$@)
	$(call say,stability: blocks -> factor of safety)
	@rm -f $(OUT)/stability/levels.svg
	$(Q)$(BIN)talus-stability $(site) --trn $(OUT)/bed.tif --blocks $(OUT)/blocks.h5 \
	  -o $(OUT)/stability $(inputs_given) $(STABILITY_FLAGS) --overwrite $(DB)
	$(call made,talus-stability)
stability_for_others := $(if $(or $(wildcard $(OUT)/stability/stability.json),$(filter \
  stability,$(wanted))),$(stability_files))
