# Contours -> triangulated irregular network.
# in: $(OUT)/inputs.gpkg, [terrain] flat, TIN_FLAGS (e.g. --hold-out-every 3)
# out: $(OUT)/tin.ply, tin.json
$(eval $(call remember,tin,$(TIN_FLAGS)))
ifneq ($(CONTOURS),)
tin_files := $(addprefix $(OUT)/,$(tin_products))
$(eval $(call together,$(tin_files)))
$(OUT)/tin.ply: $(addprefix $(STAGES)/,tin.txt tin.flags tin.files import.flags import.files) \
  | $(OUT)/inputs.gpkg
	$(call not_in_a_shard,$@)
	$(call say,tin: contours -> triangles)
	$(Q)$(call taken,$(tin_files))$(BIN)talus-tin \
	  $(OUT)/inputs.gpkg -o $(OUT)/tin.ply --report $(OUT)/tin.json \
	  $(SITE_TIN_FLAGS) $(TIN_FLAGS) --overwrite $(DB)
	$(call made,talus-tin)
endif
