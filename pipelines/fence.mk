# Runs -> what reaches each fence of the site, what it holds and changes.
# in: [fence.*], FENCE_FLAGS (e.g. --code onr)   out: $(OUT)/fence.gpkg, .json, .csv, and with runs without the fences
#     $(OUT)/change.tif, .qml, .png; nothing for a site without fences
$(eval $(call remember,fence,$(evaluate_flags) $(FENCE_FLAGS)))
ifneq ($(SITE_FENCES),)
fence_files := $(addprefix $(OUT)/,$(fence_products) $(if $(without_files),$(change_products)))
$(eval $(call together,$(fence_files)))
$(OUT)/fence.gpkg: $(run_files) $(without_files) $(OUT)/blocks.h5 $(STAGES)/fence.txt $(STAGES)/runs.flags $(STAGES)/fence.flags $(STAGES)/fence.files
	$(call say,fence: $(call counted_runs,$(run_files) $(without_files)) -> fences)
	@$(call outcomes,some,$(run_files))
	@$(if $(without_files),$(call outcomes,some,$(without_files)))
	$(Q)$(BIN)talus-fence site.toml $(call run_there,$(run_files) $(without_files)) $(if $(without_files),--change $(OUT)/change.tif) --trn $(OUT)/bed.tif -o $(OUT)/fence.gpkg \
	  --json $(OUT)/fence.json --csv $(OUT)/fence.csv $(evaluate_flags) $(FENCE_FLAGS) --overwrite $(DB)
	$(call made,talus-fence)
endif
fence: $(fence_files) ## runs -> what the fences meet and hold
