# Variables that make is given are checked before anything runs; numbers of runs are talus-batch's
# (runs.mk).
# in: OUT (site.mk), CONTOURS, DEM (inputs.mk), WITHOUT (runs.mk), LINE (profile.mk), VARIANT, BASE
#   (variants.mk)
# out: an error with the expected values
# A word of a rule and of a recipe: it cannot hold characters that make or the shell would split at
# or run.
signs := ' " ` $$ ; & | < > * ? : %
sign_in = $(firstword $(foreach sign,$(signs),$(if $(findstring $(sign),$1),$(sign))))
one_word = $(if $(filter 1,$(words $1)),$(if $(sign_in),$(error $2 is $1, expected the name of $3 \
  without $(sign_in))),$(error $2 is '$1', expected the name of $3 without blanks))
$(call one_word,$(OUT),OUT,a folder)
override OUT := $(strip $(OUT))
ifeq ($(realpath $(OUT)),$(realpath .))
$(error OUT is $(OUT), the site's own folder, whose files results would replace: name another one)
endif
# Files of the ground: site.toml takes names that make would take apart.
ifeq ($(filter new-site,$(MAKECMDGOALS)),)
$(foreach name,CONTOURS DEM,$(if $(filter command environment,$(firstword $(origin $(name)))),$(if \
  $(findstring :,$(firstword $(subst |, ,$($(name)))))$(if \
  $(filter DEM,$(name)),$(word 2,$($(name)))),\
  $(error $(name) is '$($(name))', whose colon or blank make would take for its own: name it in \
  [terrain] of site.toml))))
endif
ifneq ($(LINE),)
line_file := $(firstword $(subst |, ,$(LINE)))
$(if $(findstring |,$(LINE)),,$(call one_word,$(LINE),LINE,one file))
$(call one_word,$(line_file),LINE,one file)
$(if $(wildcard $(line_file)),,$(error LINE is $(LINE): there is no such file))
else ifneq ($(filter profile,$(MAKECMDGOALS)),)
$(error profile needs LINE, a file with one line: make profile LINE=road.geojson)
endif
$(if $(filter-out yes no,$(WITHOUT)),$(error WITHOUT is '$(WITHOUT)', expected yes or no))
$(if $(VARIANT),$(call one_word,$(VARIANT),VARIANT,a [variant.NAME]))
$(if $(BASE),$(call one_word,$(BASE),BASE,the folder of the results of the site as it is))
# CASES, CASE_<name> and WEIGHTS of earlier makefiles: the sections that take their place.
toml_line = $(shell printf %s '$(subst ','\'',$1)' | \
  sed -E "s/=(true|false|[-+0-9\[\"'].*)$$/ = \1/; t; s/=(.*)/ = \"\1\"/")
ifneq ($(CASES)$(WEIGHTS),)
CASE_weakening ?= --set solver.friction=weakening
$(foreach case,$(CASES),$(if $(WEIGHTS)$(CASE_$(case)),$(info [variant.$(case)])\
  $(foreach weight,$(patsubst $(case)=%,%,$(filter $(case)=%,$(WEIGHTS))),\
  $(info weight = $(weight)))\
  $(foreach key,$(filter-out --set,$(CASE_$(case))),$(info $(call toml_line,$(key))))))
$(error CASES, CASE_* and WEIGHTS are gone: write the lines above in site.toml. Variants with a \
  weight count together, those without one are compared with the site)
endif
alone := $(filter submit prepare runs-shard,$(MAKECMDGOALS))
$(if $(alone),$(if $(word 2,$(MAKECMDGOALS)),$(error $(firstword $(alone)) stands alone: give \
  other goals to a make of their own)))
$(if $(filter submit runs-shard,$(alone)),$(if $(SHARDS),,$(error $(alone) needs SHARDS, e.g. 40)))
$(if $(filter $(if $(SHARD),yes,no),$(if $(filter runs-shard,$(alone)),yes,no)),,$(error SHARD \
  goes with the goal runs-shard: make SHARD=1 SHARDS=8 runs-shard))
