# What make is given is looked at before anything runs; runs and cases are talus-batch's (runs.mk).
# in: OUT (site.mk), WITHOUT (runs.mk), LINE (profile.mk)   out: an error that says what is expected
# A word of a rule and of a recipe: it cannot hold what make or the shell would part or run.
signs := ' " ` $$ ; & | < > * ? : %
sign_in = $(firstword $(foreach sign,$(signs),$(if $(findstring $(sign),$1),$(sign))))
one_word = $(if $(filter 1,$(words $1)),$(if $(sign_in),$(error $2 is $1, expected the name of $3 \
  without $(sign_in))),$(error $2 is '$1', expected the name of $3 without blanks))
$(call one_word,$(OUT),OUT,a folder)
override OUT := $(strip $(OUT))
ifeq ($(realpath $(OUT)),$(realpath .))
$(error OUT is $(OUT), the site's own folder, whose files results would replace: name another one)
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
alone := $(filter submit prepare runs-shard,$(MAKECMDGOALS))
$(if $(alone),$(if $(word 2,$(MAKECMDGOALS)),$(error $(firstword $(alone)) stands alone: give \
  other goals to a make of their own)))
$(if $(filter submit runs-shard,$(alone)),$(if $(SHARDS),,$(error $(alone) needs SHARDS, e.g. 40)))
$(if $(filter $(if $(SHARD),yes,no),$(if $(filter runs-shard,$(alone)),yes,no)),,$(error SHARD \
  goes with the goal runs-shard: make SHARD=1 SHARDS=8 runs-shard))
