# Shards of runs as jobs of Snakemake, in a site's folder:
#   snakemake -s TALUS/pipelines/shards.smk --cores 8 --config shards=40 make="RUNS=400 OUT=out"
# config: shards  how many jobs; make  the variables for make; goals  of the last job (all);
#   cores  of each shard (1)
# Make decides which runs are to be made, so every job is begun each time, and one with nothing to
# do ends at once. Jobs of a run each would be too many: a scheduler takes longer over one than some
# runs do.
variables = str(config.get("make", ""))
n_shards = int(config["shards"])
goals = str(config.get("goals", "all"))
outs = [word[4:] for word in variables.split() if word.startswith("OUT=")]
marks = (outs or ["out"])[-1] + "/shards"

# Variables that Snakemake hands on to its jobs are not for make.
shell.prefix("unset MAKEFLAGS MFLAGS MAKELEVEL; ")
localrules: all, prepare

rule all:
    input: expand(marks + "/{shard}.ended", shard=range(1, n_shards + 1))
    shell: "make {variables} {goals}"

rule prepare:
    output: temp(touch(marks + "/prepared"))
    shell: "make {variables} prepare"

rule shard:
    input: marks + "/prepared"
    output: temp(touch(marks + "/{shard}.ended"))
    threads: int(config.get("cores", 1))
    shell: "make {variables} SHARD={wildcards.shard} SHARDS={n_shards} runs-shard -j {threads}"
