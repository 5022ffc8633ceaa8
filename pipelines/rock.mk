# Terrain and site file -> the blocks of one rock mass of several: [uncertainty] rock_masses.
# in: site.toml, BLOCKS_FLAGS   out: $(OUT)/rock/blocks_K.h5, $(OUT)/rock/bed_K.tif
# Which masses runs move says talus-batch (runs.mk). Where there is one, it is that of blocks.mk.
masses := $(sort $(rock_masses) $(verify_masses))
$(foreach mass,$(masses),$(eval $(call together,$(OUT)/rock/blocks_$(mass).h5 \
  $(OUT)/rock/bed_$(mass).tif)))
$(OUT)/rock/blocks_%.h5: $(OUT)/trn.tif $(STAGES)/rock.txt $(STAGES)/blocks.flags \
  $(STAGES)/blocks.files | $(OUT)/blocks.h5 $(OUT)/rock
	$(call not_in_a_shard,$@)
	$(call say,rock: blocks of mass $*)
	$(Q)$(call taken,$@ $(OUT)/rock/bed_$*.tif)$(BIN)talus-blocks \
	  $(site) --trn $(OUT)/trn.tif -o $@ \
	  --trn-out $(OUT)/rock/bed_$*.tif --sample $* $(inputs_given) $(BLOCKS_FLAGS) --overwrite $(DB)
	$(call made,talus-blocks)
