# Runs -> which source hits which object of the site.
# in: [object.*], TRACE_FLAGS (e.g. --source-cell-m 10)
# out: $(OUT)/trace.gpkg, .json, links.csv, sources/source_OBJECT.tif, .qml, .png, .pdf
$(eval $(call remember,trace,$(TRACE_FLAGS)))
trace_files := $(addprefix $(OUT)/,$(trace_products))
trace: $(trace_files) ## runs -> which source hits which object
$(eval $(call together,$(trace_files)))
# The site as it is may have other frequencies and other people at its objects.
trace_of_base := $(wildcard $(BASE:%=%/stages/trace.txt))
$(OUT)/trace.gpkg: $(OUT)/runs/ensemble.json $(BASE:%=%/runs/ensemble.json) \
  $(STAGES)/trace.txt $(STAGES)/trace.flags $(STAGES)/trace.files $(trace_of_base)
	$(call say,trace: runs -> objects and their sources)
	@rm -f $(addprefix $(OUT)/,$(trace_patterns))
	$(Q)$(BIN)talus-trace $(site) $(OUT)/runs --trn $(ground_of_runs) -o $(OUT)/trace.gpkg \
	  --json $(OUT)/trace.json --csv $(OUT)/links.csv --rasters $(OUT)/sources --pages png,pdf \
	  $(inputs_given) $(BASE:%=--compare %/runs) $(TRACE_FLAGS) --overwrite $(DB)
	$(call made,talus-trace)
