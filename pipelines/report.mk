# Everything of a site -> one HTML file, and a QGIS project.
# in: $(OUT)/*, REPORT_FLAGS   out: $(OUT)/report.html, $(OUT)/site.qgz
$(eval $(call remember,report,$(REPORT_FLAGS)))
report: $(OUT)/report.html $(OUT)/site.qgz ## all of it -> report.html, site.qgz
$(OUT)/report.html $(OUT)/site.qgz &: site.toml $(runout_files) $(map_files) $(fence_files) $(STAGES)/report.flags
	$(BIN)talus-report site.toml --dir $(OUT) -o $(OUT)/report.html --qgis $(OUT)/site.qgz $(REPORT_FLAGS) --overwrite $(DB)
