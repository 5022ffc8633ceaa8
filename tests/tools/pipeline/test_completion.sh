# Completion offers a tool's options, choices and sub-commands.
command -v bash >/dev/null || skip "needs bash"
# complete WORDS...: the completions of the last word
offered() {
  bash -c 'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _talus; printf "%s\n" "${COMPREPLY[@]}"' \
    "$source_dir/share/bash-completion/talus" "$@" >out
}
offered talus-tin --elev
prints "--elevation-field"
offered talus-tin --flat ""
[ "$(sort out | tr '\n' ' ')" = "fill keep " ] || fail "choices of --flat: $(cat out)"
offered talus-runs t
[ "$(cat out)" = trace ] || fail "sub-command: $(cat out)"
offered talus-report --
prints "--qgis"
prints "--overwrite"
# behind a file, whose name has signs of sed and of the shell
for name in data/site.toml 'a&b[1].toml' '*' --flat/x '--a\(b'; do
  bash -c 'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _talus' \
    "$source_dir/share/bash-completion/talus" talus-tin "$name" "" 2>err
  [ ! -s err ] || fail "completion behind $name says: $(cat err)"
done
for tool in "${bin%%:*}"/talus-*; do
  [ -x "$tool" ] && [ ! -d "$tool" ] || continue
  grep -qw -- "$(basename "$tool")" "$source_dir/share/bash-completion/talus" || fail "no completion for $tool"
done
