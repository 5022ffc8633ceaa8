# What the site names as its contours -> the same in metres, in one system, each decision recorded.
# in: CONTOURS, [terrain], IMPORT_FLAGS (e.g. --t-srs EPSG:32632)
# out: $(OUT)/inputs.gpkg, import.json
$(eval $(call remember,import,$(CONTOURS) $(IMPORT_FLAGS)))
ifneq ($(CONTOURS),)
import_files := $(addprefix $(OUT)/,$(import_products))
$(eval $(call together,$(import_files)))
$(OUT)/inputs.gpkg: $(STAGES)/import.txt $(STAGES)/import.flags $(STAGES)/import.files \
  | $(contours_file) $(OUT)
	$(call not_in_a_shard,$@)
	$(call say,import: contours -> metres in one system)
	$(Q)$(BIN)talus-import site.toml $(contours_given) -o $(OUT)/inputs.gpkg \
	  --report $(OUT)/import.json $(IMPORT_FLAGS) --overwrite $(DB)
	$(call made,talus-import)
endif
