# bash completion for lacuna
_lacuna()
{
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= each
    for each in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        case $each in info | view | picture | check | convert | fill | help) command=$each && break ;; esac
    done
    COMPREPLY=()
    case $before in
        --output-dir) mapfile -t COMPREPLY < <(compgen -d -- "$word") && return ;;
        --history | --timing) mapfile -t COMPREPLY < <(compgen -f -- "$word") && return ;;
        --memory | --seconds | --threads | -j) return ;;
    esac
    local flags="--verbose --quiet --traceback --threads --timing --help"
    case $command in
        help) mapfile -t COMPREPLY < <(compgen -W "info view picture check convert fill" -- "$word") && return ;;
        info | check) flags+=" --json" ;;
        view) flags+=" --faces" ;;
        "") flags+=" --history --sandbox --output-dir --memory --seconds --version -i -j" ;;
    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$flags" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        [[ -n $command ]] || mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY \
            < <(compgen -W "info view picture check convert fill help" -- "$word")
    fi
}
complete -o filenames -F _lacuna lacuna
