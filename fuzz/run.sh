#!/usr/bin/env bash
# Fuzzes every target in turns, half of the time `solve`, for so many core-hours.
#
#   fuzz/run.sh HOURS [JOBS]      from anywhere; JOBS slices run at once, 1 if left out
#   fuzz/run.sh 0                 only minimises the corpus, which else comes last
#
# After each slice a row is added to LOG.md, so that killing this loses no more than a slice. Several
# may run at once. Needs cargo-fuzz: cargo install cargo-fuzz --locked
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# Seconds of a slice by the clock. Shorter, and reading the corpus takes its share; longer, and
# more is lost when a slice is killed.
slice=${FUZZ_SLICE:-300}
# A slice ends after so many findings: a shallow bug would be found again and again.
most_findings=3
# Seconds by the clock after which an input hangs: many, since neighbours may have the processor. What
# is slow but ends is found by processor time, in the target.
hang=120
# Bytes of corpus that are kept of each target: the smallest inputs, some thousand files in all.
most_corpus=150000

schedule=(solve bezier solve read_json solve read_sfd solve read_csv)
targets=(solve bezier read_json read_csv read_sfd)

# Builds every target, and copies it, so that building while this runs disturbs nothing.
build() {
    local host folder target flags
    host=$(rustc -vV | sed -n 's/^host: //p')
    folder=$(cargo metadata --format-version 1 --no-deps | sed -n 's/.*"target_directory":"\([^"]*\)".*/\1/p')
    for target in "${targets[@]}"; do
        case $target in
            read_*) flags=() ;;
            # Comparisons of numbers teach nothing and cost a third of the time.
            *) flags=(--no-trace-compares) ;;
        esac
        # Without sanitizers: there is no unsafe code to look after, and it is twice as fast.
        cargo fuzz build --sanitizer none "${flags[@]}" "$target"
        cp "$folder/$host/release/$target" "$bin/"
        mkdir -p "corpus/$target" "artifacts/$target"
    done
}

options() {
    case $1 in
        read_*) echo "-dict=dictionaries/${1#read_}.dict" ;;
        # A dozen knots with everything given.
        *) echo -max_len=1024 ;;
    esac
}

seeds() {
    case $1 in
        read_*) echo "seeds/$1" ../examples ;;
    esac
}

# One slice of a target, started again after each finding. Logs it and prints the core-seconds that
# it took.
run_slice() {
    local target=$1 out=$2 left=$slice spent=0 executions=0 findings=0 start status used file
    while [ "$left" -gt 0 ] && [ "$findings" -lt "$most_findings" ]; do
        start=$SECONDS
        status=0
        # The lock keeps the corpus from being minimised meanwhile.
        # shellcheck disable=SC2046
        { TIMEFORMAT='cpu %U %S'; time flock -s "corpus/$target" "$bin/$target" \
            "corpus/$target" $(seeds "$target") $(options "$target") \
            -max_total_time="$left" -timeout="$hang" -rss_limit_mb=2048 -print_final_stats=1 \
            -artifact_prefix="artifacts/$target/" >"$out" 2>&1; } 2>"$out.time" || status=$?
        left=$((left - (SECONDS - start)))
        used=$(sed -n 's/^cpu \([0-9]*\)[.,][0-9]* \([0-9]*\).*/\1 \2/p' "$out.time")
        spent=$((spent + ${used% *} + ${used#* }))
        used=$(sed -n 's/^stat::number_of_executed_units: *//p' "$out" | tail -n 1)
        executions=$((executions + ${used:-0}))
        [ "$status" = 0 ] && break
        findings=$((findings + 1))
        # An input that an earlier version took may fail now; it must not stop every slice.
        for file in "artifacts/$target"/*-*; do rm -f "corpus/$target/${file##*-}"; done
        {
            date -u +'%F %T'
            grep -E -A1 'panicked at|ERROR: libFuzzer|Test unit written' "$out" || tail -n 5 "$out"
        } >>"artifacts/$target/findings.txt"
    done
    flock LOG.md printf '| %s | %s | %s | %s | %s |\n' \
        "$(date -u +%F)" "$target" "$spent" "$executions" "$findings" >>LOG.md
    echo "$spent"
}

# Slices from some place of the schedule on, until so many core-seconds are spent.
worker() {
    local left=$1 turn=$2 out=$bin/$2.out spent
    while [ "$left" -gt 0 ]; do
        spent=$(run_slice "${schedule[turn % ${#schedule[@]}]}" "$out")
        # Something always passes, so that a target that can't start doesn't run for ever.
        left=$((left - (spent > 0 ? spent : 1)))
        turn=$((turn + 1))
    done
}

# Drops what adds no coverage, and the largest inputs beyond the limit.
minimise() {
    local target=$1 small size=0 bytes file
    small=$(mktemp -d "corpus/.$target.XXXXXX")
    # shellcheck disable=SC2046
    if "$bin/$target" -merge=1 -timeout="$hang" $(options "$target") \
        "$small" "corpus/$target" $(seeds "$target") >"$bin/merge.out" 2>&1; then
        find "corpus/$target" -type f -delete
        while read -r bytes file; do
            size=$((size + bytes))
            if [ "$size" -le "$most_corpus" ]; then mv "$file" "corpus/$target/"; fi
        done < <(find "$small" -type f -printf '%s %p\n' | sort -n)
    fi
    rm -rf "$small"
}

main() {
    local usage='usage: fuzz/run.sh HOURS [JOBS]'
    local hours=${1:?$usage} jobs=${2:-1} seconds job target
    bin=$(mktemp -d)
    trap 'rm -rf "$bin"' EXIT
    build
    seconds=$(awk "BEGIN { print int($hours * 3600 / $jobs) }")
    for ((job = 0; job < jobs; job++)); do
        worker "$seconds" "$job" &
    done
    wait
    for target in "${targets[@]}"; do
        (
            flock 9
            minimise "$target"
        ) 9<"corpus/$target"
    done
}

# On one line, so that the file may change while it runs.
main "$@"; exit
