# Completes ofm-slam's subcommands, options and files in bash. What there is to choose from is asked
# of the program, so that this file needs no change when it learns something new.

# Words that the help of the command in $@ offers: subcommands, and long options.
_ofm_slam_words() {
  "$@" --help 2>/dev/null | awk '
    /^[A-Za-z]+:$/ { section = $0; next }
    section == "Subcommands:" && /^  [a-z]/ { print $1 }
    section == "Options:" && /^  -/ { count = split($1, names, ","); for (i = 1; i <= count; ++i) if (names[i] ~ /^--/) print names[i] }'
}

_ofm_slam() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local command=("${COMP_WORDS[0]}") words word i
  # Subcommands come before everything else.
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    [[ $word =~ ^[a-z][a-z-]*$ ]] || break
    words=$(_ofm_slam_words "${command[@]}")
    grep -qx -- "$word" <<<"$words" || break
    command+=("$word")
  done
  case $previous in
    --camera) words="auto tum-fr1 tum-fr2 tum-fr3" ;;
    --segmenter) words="none masks yolo-seg mask-rcnn" ;;
    --dynamics) words="off paper full" ;;
    *) words=$(_ofm_slam_words "${command[@]}") ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; [[ $current == -* ]] || compgen -f -- "$current")
}

complete -o filenames -F _ofm_slam ofm-slam
