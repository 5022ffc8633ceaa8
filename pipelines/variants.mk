# The measures of the site, each computed like the site with the same seeds, and compared with it.
# in: [variant.NAME] without a weight
#     VARIANT, BASE  given to the make of a measure: its name, and the results of the site as it is
# out: $(OUT)/variant/NAME/*: what OUT has of the site; maps/compare.tif and differences at objects
# Each is a make of its own, one after the other: what it shares with the site it takes over.
measures := $(if $(VARIANT)$(SHARD),,$(SITE_MEASURES))
measure_reports := $(measures:%=$(OUT)/variant/%/report.html)
.PHONY: variants each-time
variants: $(measure_reports) ## measures of the site, each compared with it
each-time: ;
before :=
define measure
$(OUT)/variant/$1/report.html: each-time | $(ensembles) $(before_runs) \
  $(patsubst %,$(OUT)/variant/%/report.html,$2)
	$$(call say,variants: $1)
	@mkdir -p $$(@D)
	+$$(Q)$$(MAKE) --no-print-directory -f $(firstword $(MAKEFILE_LIST)) OUT=$$(@D) VARIANT=$1 \
	  BASE=$(OUT) report $(if $(is_dry_run),,&& rm -f $$(@D)/.failed || \
	  { [ -s $$@ ] && touch $$(@D)/.failed; })
endef
$(foreach name,$(measures),$(eval $(call measure,$(name),$(before)))$(eval before := $(name)))
failed_measure = @[ ! -e $(OUT)/variant/$1/.failed ] || \
  { echo 'variant $1: not all of it could be made, see above' >&2; exit 2; }$(newline)
