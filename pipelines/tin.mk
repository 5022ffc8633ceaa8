# Contours -> triangulated irregular network.
# in: CONTOURS, [terrain], TIN_FLAGS (e.g. --hold-out-every 3)   out: $(OUT)/tin.ply, $(OUT)/tin.json
$(eval $(call remember,tin,$(CONTOURS) $(TIN_FLAGS)))
ifneq ($(CONTOURS),)
tin_files := $(OUT)/tin.ply $(OUT)/tin.json
$(eval $(call together,$(tin_files)))
$(OUT)/tin.ply: $(CONTOURS) $(STAGES)/tin.txt $(STAGES)/tin.flags $(call named_in,$(TIN_FLAGS)) | $(OUT)
	$(BIN)talus-tin $(CONTOURS) -o $(OUT)/tin.ply --report $(OUT)/tin.json $(SITE_TIN_FLAGS) $(TIN_FLAGS) --overwrite $(DB)
endif
