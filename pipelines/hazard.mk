# Runs and frequencies -> return periods and hazard classes (GeoTIFF with style and page, GeoPackage).
# in: [hazard], [hazard.class.*], HAZARD_FLAGS (e.g. --cell-size-m 10)   out: $(OUT)/hazard/*.tif, .qml, .png, .pdf,
#     $(OUT)/hazard/hazard.gpkg, $(OUT)/hazard.json
# With several classes the runs of class C are those of the case C (CASES, dda.mk). Without frequencies there are no
# classes, and talus-hazard says why.
$(eval $(call remember,hazard,$(class_flags) $(HAZARD_FLAGS)))
hazard_files := $(addprefix $(OUT)/,$(hazard_products))
hazard: $(hazard_files) ## runs and frequencies -> return periods, hazard classes
$(eval $(call together,$(hazard_files)))
# class_list(CLASS): a command that writes the list of its runs that have a result. No line of the shell holds the names
# of many runs: make writes them.
class_runs = $(filter $(OUT)/runs/run_$1_%,$(run_files))
write_class = $(if $(is_dry_run),,$(file >$(STAGES)/class_$1.list)$(foreach file,$(call class_runs,$1),$(file >>$(STAGES)/class_$1.list,$(file))))
class_list_by = $(call write_class,$1)parts=$2 sh $(PIPELINES)run_outcomes.sh there $(failed_marks) --from $(STAGES)/class_$1.list >/dev/null
class_list = $(call class_list_by,$1,$(parts_taken))
framed_class_list = $(call class_list_by,$1,$(if $(keep_frames),,$(parts_taken)))
several_classes := $(word 2,$(SITE_HAZARD_CLASSES))
classes_in = $(foreach class,$(SITE_HAZARD_CLASSES),--class $(class)=@$(STAGES)/class_$(class).list.$(if $1,in_parts,there))
hazard_runs = $(if $(several_classes),$(call classes_in,$(parts_taken)),$(call run_there,$(run_files)))
# For a tool that wants the frames, which parts have not.
framed_hazard_runs = $(if $(several_classes),$(call classes_in,$(if $(keep_frames),,$(parts_taken))),$(call framed_there,$(run_files)))
$(OUT)/hazard.json: $(run_files) $(OUT)/blocks.h5 $(STAGES)/hazard.txt $(STAGES)/runs.flags $(STAGES)/hazard.flags $(STAGES)/hazard.files
	$(call say,hazard: $(call counted_runs,$(run_files)) -> return periods and classes)
	@$(call outcomes,some,$(run_files))
	@rm -f $(addprefix $(OUT)/,$(hazard_patterns))
	@$(if $(several_classes),$(foreach class,$(SITE_HAZARD_CLASSES),$(call class_list,$(class));))
	$(Q)$(BIN)talus-hazard site.toml $(hazard_runs) --trn $(ground_of_runs) -o $(OUT)/hazard --json $(OUT)/hazard.json --pages png,pdf \
	  $(class_flags) $(HAZARD_FLAGS) --overwrite $(DB)
	$(call made,talus-hazard)
