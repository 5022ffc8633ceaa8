# Terrain and site file -> the blocks of one rock mass of several: [uncertainty] rock_masses.
# in: site.toml, BLOCKS_FLAGS   out: $(OUT)/rock/blocks_K.h5, $(OUT)/rock/bed_K.tif
# A run of seed i has mass (i - 1) mod rock_masses + 1. Where there is one mass, it is that of blocks.mk.
rock_masses := $(SITE_ROCK_MASSES)
# What runs are evaluated on: their beds differ from mass to mass, the terrain before them does not.
ground_of_runs := $(OUT)/$(if $(rock_masses),trn,bed).tif

ifneq ($(rock_masses),)
masses_of_seeds := $(shell seq $(SEED) $$(($(SEED) + $(RUNS) - 1)) | awk '{ print ($$1 - 1) % $(rock_masses) + 1 }')
masses_of_runs := $(if $(CASES),$(foreach case,$(CASES),$(masses_of_seeds)),$(masses_of_seeds))
# of_mass(RUN,MASS): whose blocks a run moves
define of_mass
$1: mass := $2
$1: $(OUT)/rock/blocks_$2.h5
endef
of_masses = $(foreach pair,$(join $(1:%=%|),$(masses_of_runs)),$(eval $(call of_mass,$(firstword $(subst |, ,$(pair))),$(lastword $(subst |, ,$(pair))))))
$(call of_masses,$(run_files))
$(if $(without_files),$(call of_masses,$(without_files)))
$(foreach mass,$(sort $(masses_of_seeds)),$(eval $(call together,$(OUT)/rock/blocks_$(mass).h5 $(OUT)/rock/bed_$(mass).tif)))

$(OUT)/rock/blocks_%.h5: $(OUT)/trn.tif $(STAGES)/rock.txt $(STAGES)/blocks.flags $(STAGES)/blocks.files | $(OUT)/blocks.h5 $(OUT)/rock
	$(call not_in_a_shard,$@)
	$(call say,rock: blocks of mass $*)
	$(Q)$(BIN)talus-blocks site.toml --trn $(OUT)/trn.tif -o $@ --trn-out $(OUT)/rock/bed_$*.tif --sample $* $(BLOCKS_FLAGS) --overwrite $(DB)
	$(call made,talus-blocks)
endif
