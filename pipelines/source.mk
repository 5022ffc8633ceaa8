# Terrain and site file -> on which planes of its joint sets the mass could leave, on the terminal.
# in: site.toml   out: $(OUT)/source.json, $(OUT)/source.gpkg
.PHONY: source
source: $(OUT)/trn.tif ## which planes of the joint sets daylight, before anything is cut
	$(call say,source: on which planes of the joint sets could it leave)
	$(Q)$(BIN)talus-source $(site) --trn $(OUT)/trn.tif $(inputs_given) -o $(OUT)/source.json \
	  --layers $(OUT)/source.gpkg --overwrite $(DB)
