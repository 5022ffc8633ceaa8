# Everything of a site -> one HTML file, and a QGIS project.
# in: $(OUT)/*, REPORT_FLAGS   out: $(OUT)/report.html, $(OUT)/site.qgz
$(eval $(call remember,report,$(REPORT_FLAGS)))
# A search makes runs of its own: the report has one that was asked for, now or before.
search_for_report := $(if $(or $(wildcard $(OUT)/fence_search.json),$(filter \
  fence-search,$(wanted))),$(search_files))
report: $(OUT)/report.html $(OUT)/site.qgz ## all of it -> report.html, site.qgz
$(eval $(call together,$(addprefix $(OUT)/,$(report_products))))
$(OUT)/report.html: $(import_files) $(tin_files) $(trn_files) $(block_files) $(ensembles) \
  $(runout_files) $(map_files) $(case_map_files) $(fence_files) $(case_fence_files) \
  $(places_files) $(if $(SITE_OBSERVED),$(calibrate_files)) \
  $(if $(SITE_HAZARD_CLASSES),$(hazard_files)) $(if $(SITE_OBJECTS),$(trace_files)) \
  $(if $(SITE_FENCE_SEARCHES),$(search_for_report)) $(stability_for_others) \
  $(measure_reports) \
  $(STAGES)/report.flags $(STAGES)/report.files
	$(call say,report: all of it -> report and QGIS project)
	$(Q)$(BIN)talus-report $(site) --dir $(OUT) -o $(OUT)/report.html --qgis $(OUT)/site.qgz \
	  $(REPORT_FLAGS) --overwrite $(DB)
	$(call made,talus-report)
