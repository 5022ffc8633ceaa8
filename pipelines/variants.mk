# The measures of the site, each computed like the site with the same seeds, and compared with it.
# in: [variant.NAME] without a weight
#     VARIANT, BASE  given to the make of a measure: its name, and the results of the site as it is
# out: $(OUT)/variant/NAME/*: files as OUT has of the site; maps/compare.tif and differences at
#     objects
# Each is a make of its own, one after the other: it takes over the parts that it shares with the
# site. All are checked before the first run.
measures := $(if $(VARIANT)$(SHARD),,$(SITE_MEASURES))
measure_reports := $(measures:%=$(OUT)/variant/%/report.html)
checked := $(if $(filter all report variants,$(wanted)),$(measures:%=checked-%))
.PHONY: variants each-time $(checked)
variants: $(measure_reports) ## measures of the site, each compared with it
each-time: ;
# make_measure(NAME,GOAL)
make_measure = +$(Q)$(MAKE) --no-print-directory -f $(firstword $(MAKEFILE_LIST)) \
  OUT=$(OUT)/variant/$1 VARIANT=$1 BASE=$(OUT) $2
before :=
define measure
checked-$1: $(before_runs) $(OUT)/check.html | $(patsubst %,checked-%,$2)
	$$(call say,variants: $1)
	@mkdir -p $(OUT)/variant/$1
	$$(call make_measure,$1,check)
$(OUT)/variant/$1/report.html: each-time | $(ensembles) \
  $(patsubst %,$(OUT)/variant/%/report.html,$2)
	$$(call say,variants: $1)
	$$(call make_measure,$1,report) $(if $(is_dry_run),,&& rm -f $$(@D)/.failed || \
	  { [ -s $$@ ] && touch $$(@D)/.failed; })
endef
$(foreach name,$(measures),$(eval $(call measure,$(name),$(before)))$(eval before := $(name)))
$(if $(checked),$(eval $(ensembles): | $(checked)))
# In a dry run the results of the site may not be there yet.
ensembles_of_base := $(BASE:%=%/runs/ensemble.json) $(BASE:%=%/without/ensemble.json)
$(if $(BASE),$(if $(is_dry_run),$(eval $(ensembles_of_base): ;)))
# A measure that changes nothing in the runs has those of the site; talus-batch looks at them.
taken_runs = $(if $(BASE),@if cmp -s $(STAGES)/run.txt $(BASE)/stages/run.txt && \
  [ -d $(BASE)/$1 ]; then mkdir -p $(OUT)/$1 && cp -ru --reflink=auto $(BASE)/$1/. $(OUT)/$1; fi)
failed_measure = @[ ! -e $(OUT)/variant/$1/.failed ] || \
  { echo 'variant $1: not all of it could be made, see above' >&2; exit 2; }$(newline)
