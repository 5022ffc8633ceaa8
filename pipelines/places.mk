# Runs -> how surely blocks reach the places of the site, and how many runs to add.
# in: [place.*], PLACES_FLAGS   out: $(OUT)/places.json; nothing for a site without places
$(eval $(call remember,places,$(PLACES_FLAGS)))
ifneq ($(SITE_PLACES),)
places_files := $(OUT)/places.json
$(OUT)/places.json: $(OUT)/runs/ensemble.json $(STAGES)/place.txt $(STAGES)/places.flags \
  $(STAGES)/places.files
	$(call say,places: runs -> places)
	$(Q)$(BIN)talus-places $(site) $(OUT)/runs --trn $(ground_of_runs) $(inputs_given) --json $@ \
	  $(PLACES_FLAGS) --overwrite $(DB)
	$(call made,talus-places)
endif
.PHONY: places
places: $(places_files) ## runs -> how surely the places of the site are reached
