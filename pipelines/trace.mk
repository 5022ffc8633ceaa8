# Runs -> which source hits which object of the site.
# in: [object.*], TRACE_FLAGS (e.g. --source-cell-m 10)   out: $(OUT)/trace.gpkg, .json, $(OUT)/links.csv,
#     $(OUT)/sources/source_OBJECT.tif, .qml, .png, .pdf
$(eval $(call remember,trace,$(class_flags) $(TRACE_FLAGS)))
trace_files := $(addprefix $(OUT)/,$(trace_products))
trace: $(trace_files) ## runs -> which source hits which object
$(eval $(call together,$(trace_files)))
$(OUT)/trace.gpkg: $(run_files) $(OUT)/blocks.h5 $(STAGES)/trace.txt $(STAGES)/runs.flags $(STAGES)/trace.flags $(STAGES)/trace.files
	$(call say,trace: $(call counted_runs,$(run_files)) -> objects and their sources)
	@$(call outcomes,some,$(run_files))
	@rm -f $(addprefix $(OUT)/,$(trace_patterns))
	@$(if $(several_classes),$(foreach class,$(SITE_HAZARD_CLASSES),$(call class_list,$(class));))
	$(Q)$(BIN)talus-trace site.toml $(hazard_runs) --trn $(ground_of_runs) -o $(OUT)/trace.gpkg --json $(OUT)/trace.json \
	  --csv $(OUT)/links.csv --rasters $(OUT)/sources --pages png,pdf $(class_flags) $(TRACE_FLAGS) --overwrite $(DB)
	$(call made,talus-trace)
