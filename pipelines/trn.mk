# TIN -> terrain of nodes, with its error report and a hillshade to look at.
# in: TRN_FLAGS (e.g. --cell-size-m)   out: $(OUT)/trn.tif, $(OUT)/trn.json, $(OUT)/hillshade.png
$(OUT)/trn.tif $(OUT)/trn.json $(OUT)/hillshade.png &: $(OUT)/tin.ply
	$(BIN)talus-trn $(OUT)/tin.ply -o $(OUT)/trn.tif --report $(OUT)/trn.json --hillshade $(OUT)/hillshade.png $(TRN_FLAGS) --overwrite
