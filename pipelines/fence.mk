# Runs -> what reaches each fence of the site, what it holds and changes.
# in: [fence.*], FENCE_FLAGS (e.g. --code onr)   out: $(OUT)/fence.gpkg, .json, .csv, and with runs without the fences
#     $(OUT)/change.tif, .qml, .png, .pdf; nothing for a site without fences;
#     of several CASES also $(OUT)/fences/CASE/fence.gpkg, .json
$(eval $(call remember,fence,$(evaluate_flags) $(FENCE_FLAGS)))
ifneq ($(SITE_FENCES),)
fence_files := $(addprefix $(OUT)/,$(fence_products) $(if $(without_files),$(change_products)))
$(eval $(call together,$(fence_files)))
$(OUT)/fence.gpkg: $(run_files) $(without_files) $(OUT)/blocks.h5 $(STAGES)/fence.txt $(STAGES)/runs.flags $(STAGES)/fence.flags $(STAGES)/fence.files
	$(call say,fence: $(call counted_runs,$(run_files) $(without_files)) -> fences)
	@$(call outcomes,some,$(run_files))
	@$(if $(without_files),$(call outcomes,some,$(without_files)))
	$(Q)$(BIN)talus-fence site.toml $(call run_there,$(run_files) $(without_files)) $(if $(without_files),--change $(OUT)/change.tif) --trn $(ground_of_runs) -o $(OUT)/fence.gpkg \
	  --json $(OUT)/fence.json --csv $(OUT)/fence.csv $(evaluate_flags) $(FENCE_FLAGS) --overwrite $(DB)
	$(call made,talus-fence)

# Of each case by itself, since a verdict of all cases is none.
case_fence_files := $(several_cases:%=$(OUT)/fences/%/fence.json)
define fence_case
$(call together,$(OUT)/fences/$1/fence.json $(OUT)/fences/$1/fence.gpkg)
$(OUT)/fences/$1/fence.json: $(OUT)/fence.gpkg
	$$(call say,fence: case $1 -> fences)
	@mkdir -p $$(dir $$@)
	$$(Q)ls $(OUT)/runs/run_$1_*.h5 >/dev/null 2>&1 || exit 0; $$(BIN)talus-fence site.toml $$(call run_there,$$(run_files) $$(without_files)) --only-case $1 \
	  --trn $$(ground_of_runs) -o $(OUT)/fences/$1/fence.gpkg --json $$@ $$(class_flags) $$(FENCE_FLAGS) --overwrite $$(DB)
	@ls $(OUT)/runs/run_$1_*.h5 >/dev/null 2>&1 || exit 0; $$(patsubst @%,%,$$(call made,talus-fence))
endef
$(foreach case,$(several_cases),$(eval $(call fence_case,$(case))))
endif
fence: $(fence_files) $(case_fence_files) ## runs -> what the fences meet and hold
