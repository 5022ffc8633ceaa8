# Contours -> triangulated irregular network.
# in: CONTOURS, TIN_FLAGS (e.g. --elevation-field)   out: $(OUT)/tin.ply, $(OUT)/tin.json
$(OUT)/tin.ply $(OUT)/tin.json &: $(CONTOURS) | $(OUT)
	$(BIN)talus-tin $(CONTOURS) -o $(OUT)/tin.ply --report $(OUT)/tin.json $(TIN_FLAGS) --overwrite
