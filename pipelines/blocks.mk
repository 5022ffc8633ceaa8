# Terrain and site file -> blocks, their bed, and doubts.
# in: site.toml, BLOCKS_FLAGS (e.g. --exact)
# out: $(OUT)/blocks.h5, bed.tif, blocks.json, blocks.gpkg, stereonet.svg, sizes.svg
$(eval $(call remember,blocks,$(BLOCKS_FLAGS)))
block_files := $(addprefix $(OUT)/,$(block_products))
blocks: $(block_files) ## source and joints -> blocks and their bed
$(eval $(call together,$(block_files)))
$(OUT)/blocks.h5: $(OUT)/trn.tif $(STAGES)/blocks.txt $(STAGES)/blocks.flags $(STAGES)/blocks.files
	$(call not_in_a_shard,$@)
	$(call say,blocks: source and joints -> blocks)
	$(Q)$(call taken,$(block_files))$(BIN)talus-blocks \
	  $(site) --trn $(OUT)/trn.tif \
	  $(inputs_given) -o $(OUT)/blocks.h5 --trn-out $(OUT)/bed.tif --report $(OUT)/blocks.json \
	  --footprints $(OUT)/blocks.gpkg --stereonet $(OUT)/stereonet.svg \
	  --size-curve $(OUT)/sizes.svg $(BLOCKS_FLAGS) --overwrite $(DB)
	$(call made,talus-blocks)
