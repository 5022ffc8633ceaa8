# Inputs of the site -> the same in metres, in one system, each decision recorded. Stages
# depend on the parts that they read (stages/*.txt), not on the file: another fence is not a new
# ground. They come after it: all need trn.tif, which does.
# in: CONTOURS, DEM, all files that site.toml names, IMPORT_FLAGS (e.g. --t-srs EPSG:32632)
# out: $(OUT)/inputs.gpkg, import.json
$(eval $(call remember,import,$(CONTOURS) $(DEM) $(dem_given) $(IMPORT_FLAGS)))
import_files := $(addprefix $(OUT)/,$(import_products))
inputs_given := --inputs $(OUT)/inputs.gpkg
$(eval $(call together,$(import_files)))
$(OUT)/inputs.gpkg: $(STAGES)/import.txt $(STAGES)/import.flags $(STAGES)/import.files \
  | $(contours_file) $(DEM) $(OUT)
	$(call not_in_a_shard,$@)
	$(call say,import: what the site names -> metres in one system)
	$(Q)$(call taken,$(import_files))$(BIN)talus-import \
	  $(site) $(contours_given) $(dem_given) -o $(OUT)/inputs.gpkg \
	  --report $(OUT)/import.json $(IMPORT_FLAGS) --overwrite $(DB)
	$(call made,talus-import)
