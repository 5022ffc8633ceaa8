# Runs -> how surely blocks reach the places of the site, and how many runs to add.
# in: [place.*], PLACES_FLAGS   out: $(OUT)/places.json; nothing for a site without places
$(eval $(call remember,places,$(evaluate_flags) $(PLACES_FLAGS)))
ifneq ($(SITE_PLACES),)
places_files := $(OUT)/places.json
$(OUT)/places.json: $(run_files) $(OUT)/blocks.h5 $(STAGES)/place.txt $(STAGES)/runs.flags $(STAGES)/places.flags $(STAGES)/places.files
	$(call say,places: $(call counted_runs,$(run_files)) -> places)
	@$(call outcomes,some,$(run_files))
	$(Q)$(BIN)talus-places site.toml $(call run_there,$(run_files)) --trn $(ground_of_runs) --json $@ $(evaluate_flags) $(PLACES_FLAGS) --overwrite $(DB)
	$(call made,talus-places)
endif
.PHONY: places
places: $(places_files) ## runs -> how surely the places of the site are reached
