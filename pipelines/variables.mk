# What make is given is looked at before anything runs.
# in: OUT (site.mk), RUNS, SEED, WITHOUT, CASES (dda.mk)   out: an error that says what is expected

# A word of a rule and of a recipe: neither can carry what make or the shell would part or run.
ifneq ($(words $(OUT)),1)
$(error OUT is '$(OUT)', expected the name of a folder without blanks; the site's own folder may have some)
endif
$(foreach sign,' " ` $$ ; & | < > * ? : %,$(if $(findstring $(sign),$(OUT)),$(error OUT is $(OUT), expected the name of a folder without $(sign))))
override OUT := $(strip $(OUT))

no_digits = $(subst 0,,$(subst 1,,$(subst 2,,$(subst 3,,$(subst 4,,$(subst 5,,$(subst 6,,$(subst 7,,$(subst 8,,$(subst 9,,$1))))))))))
is_number = $(and $(filter 1,$(words $1)),$(if $(call no_digits,$(strip $1)),,yes))
ifneq ($(origin RUNS),undefined)
$(if $(and $(call is_number,$(RUNS)),$(subst 0,,$(RUNS))),,$(error RUNS is '$(RUNS)', expected a whole number, 1 or more))
endif
ifneq ($(origin SEED),undefined)
$(if $(call is_number,$(SEED)),,$(error SEED is '$(SEED)', expected a whole number, 0 or more))
endif
$(if $(filter-out yes no,$(WITHOUT)),$(error WITHOUT is '$(WITHOUT)', expected yes or no))
$(foreach case,$(CASES),$(if $(or $(findstring _,$(case)),$(findstring /,$(case))),$(error CASES names '$(case)', expected a name without _ and /, since files are named run_CASE_SEED.h5)))
