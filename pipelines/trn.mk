# TIN or elevation model -> terrain of nodes, with its error report and a hillshade to look at.
# in: [terrain], [dam.*], DEM, TRN_FLAGS (e.g. --like)
# out: $(OUT)/trn.tif, $(OUT)/trn.json, hillshade.png
$(eval $(call remember,trn,$(DEM) $(TRN_FLAGS)))
# The site's dams are burnt into the terrain here, before blocks are cut.
dams_given := $(if $(SITE_DAMS),$(site) $(inputs_given))
ground_source := $(if $(CONTOURS),$(OUT)/tin.ply,$(DEM))
trn_files := $(addprefix $(OUT)/,$(trn_products))
terrain: $(trn_files) ## contours or elevation model -> terrain
$(eval $(call together,$(trn_files)))
$(OUT)/trn.tif: $(if $(CONTOURS),$(OUT)/tin.ply) $(STAGES)/trn.txt $(STAGES)/trn.flags \
  $(STAGES)/trn.files | $(DEM) $(OUT)/inputs.gpkg
	$(call not_in_a_shard,$@)
	$(call say,trn: $(if $(CONTOURS),triangles,elevation model) -> terrain)
	$(Q)$(call taken,$(trn_files))$(BIN)talus-trn \
	  $(ground_source) $(dams_given) -o $(OUT)/trn.tif --report $(OUT)/trn.json \
	  --hillshade $(OUT)/hillshade.png $(SITE_TRN_FLAGS) $(TRN_FLAGS) --overwrite $(DB)
	$(call made,talus-trn)
