# Runs and frequencies -> return periods and hazard classes (GeoTIFF, GeoPackage).
# in: [hazard], [hazard.class.*], HAZARD_FLAGS (e.g. --memory-mb 2000)
# out: $(OUT)/hazard/*.tif, .qml, .png, .pdf, hazard.gpkg, filing.gpkg, $(OUT)/hazard.json
# With several classes the runs of class C are those of [variant.C]. Without frequencies
# classes are not made, and talus-hazard says why.
$(eval $(call remember,hazard,$(HAZARD_FLAGS)))
hazard_files := $(addprefix $(OUT)/,$(hazard_products))
hazard: $(hazard_files) ## runs and frequencies -> return periods, hazard classes
$(eval $(call together,$(hazard_files)))
$(OUT)/hazard.json: $(OUT)/runs/ensemble.json $(STAGES)/hazard.txt $(STAGES)/hazard.flags \
  $(STAGES)/hazard.files
	$(call say,hazard: runs -> return periods and classes)
	@rm -f $(addprefix $(OUT)/,$(hazard_patterns))
	$(Q)$(BIN)talus-hazard $(site) $(OUT)/runs --trn $(ground_of_runs) -o $(OUT)/hazard \
	  --json $(OUT)/hazard.json --pages png,pdf $(HAZARD_FLAGS) --overwrite $(DB)
	$(call made,talus-hazard)
