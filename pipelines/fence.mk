# Runs -> arrivals at each fence of the site, their verdicts, and changes by the fence.
# in: [fence.*], FENCE_FLAGS (e.g. --code onr)
# out: $(OUT)/fence.gpkg, .json, .csv, and with runs without the fences $(OUT)/change.tif, .qml,
#     .png, .pdf; nothing for a site without fences; of variants with a weight also fences/NAME/*
$(eval $(call remember,fence,$(FENCE_FLAGS)))
ifneq ($(SITE_FENCES),)
fence_files := $(addprefix $(OUT)/,$(fence_products) $(if $(without),$(change_products)))
$(eval $(call together,$(fence_files)))
fence_tool = $(BIN)talus-fence $(site) $(OUT)/runs$1 $(if $(without),--without $(without)$1) \
  --trn $(ground_of_runs) $(inputs_given) $(FENCE_FLAGS) --overwrite $(DB)
$(OUT)/fence.gpkg: $(ensembles) $(without:%=%/ensemble.json) $(STAGES)/fence.txt \
  $(STAGES)/fence.flags $(STAGES)/fence.files
	$(call say,fence: runs -> fences)
	$(Q)$(fence_tool) $(if $(without),--change $(OUT)/change.tif) -o $@ \
	  --json $(OUT)/fence.json --csv $(OUT)/fence.csv
	$(call made,talus-fence)

# Of each case alone: a verdict over all cases has no meaning.
case_fence_files := $(several_cases:%=$(OUT)/fences/%/fence.json)
define fence_case
$(call together,$(OUT)/fences/$1/fence.json $(OUT)/fences/$1/fence.gpkg)
$(OUT)/fences/$1/fence.json: $(OUT)/fence.gpkg
	$$(call say,fence: case $1 -> fences)
	@mkdir -p $$(dir $$@)
	$$(Q)$$(call fence_tool,/$1) -o $(OUT)/fences/$1/fence.gpkg --json $$@
	$$(call made,talus-fence)
endef
$(foreach case,$(several_cases),$(eval $(call fence_case,$(case))))
endif
fence: $(fence_files) $(case_fence_files) ## runs -> what the fences meet and hold
