//! Writes the script that computes a campaign with Slurm: a job array for the open shards, then a merge, round by
//! round.

use super::CampaignError;
use super::document::Plan;
use crate::scene::atomic_file;
use std::path::{Path, PathBuf};

/// Name of the script.
pub const SCRIPT: &str = "slurm.sh";

/// Writes the script of a campaign into its folder.
pub(super) fn write(folder: &Path, plan: &Plan) -> Result<(), CampaignError> {
    let program = std::env::current_exe().unwrap_or_else(|_| PathBuf::from("ehl-explorer"));
    let text = script(&plan.name, &program);
    Ok(atomic_file::replace(&folder.join(SCRIPT), text.as_bytes())?)
}

/// Quotes a word for the shell.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', r"'\''"))
}

fn script(name: &str, program: &Path) -> String {
    let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    format!(
        r#"#!/bin/bash
# Submit with: bash slurm.sh
# It submits an array of jobs, one processor each, for the shards that are open, and a job behind it that merges them
# and, where that opens another round, submits again. Shards that are missing then are submitted at most three times.
# EHL_EXPLORER names another place of the same program, EHL_TASKS the most jobs of an array (1000), SBATCH_* variables
# the partition, account and time limit, as Slurm reads them.
set -u
program="${{EHL_EXPLORER:-{program}}}"
dir="${{EHL_CAMPAIGN:-$(cd "$(dirname "$0")" && pwd)}}"
export EHL_CAMPAIGN="$dir"

submit() {{
    mkdir -p "$dir/slurm"
    open="$dir/slurm/open.$(date +%s).$$"
    "$program" campaign status "$dir" --open > "$open" || exit 2
    count=$(wc -l < "$open")
    if [ "$count" -gt 0 ]; then
        tasks=$((count < ${{EHL_TASKS:-1000}} ? count : ${{EHL_TASKS:-1000}}))
        array=$(sbatch --parsable --requeue --job-name={plain} --ntasks=1 --cpus-per-task=1 --array=0-$((tasks - 1)) \
            --output="$dir/slurm/%A_%a.log" "$dir/slurm.sh" shards "$open" "$tasks") || exit 1
        sbatch --job-name={plain}_merge --ntasks=1 --cpus-per-task=1 --dependency=afterany:"${{array%%;*}}" \
            --output="$dir/slurm/%j_merge.log" "$dir/slurm.sh" merge "$1" || exit 1
    else
        sbatch --job-name={plain}_merge --ntasks=1 --cpus-per-task=1 \
            --output="$dir/slurm/%j_merge.log" "$dir/slurm.sh" merge "$1" || exit 1
    fi
}}

case "${{1:-submit}}" in
submit)
    submit 1
    ;;
shards)
    failed=0
    while read -r shard; do
        "$program" campaign shard "$dir" "$shard" || failed=1
    done < <(awk -v mine="$SLURM_ARRAY_TASK_ID" -v tasks="$3" 'NR % tasks == (mine + 1) % tasks' "$2")
    exit "$failed"
    ;;
merge)
    if [ -n "$("$program" campaign status "$dir" --open)" ]; then
        if [ "$2" -ge 3 ]; then
            echo "shards are still missing after three attempts; see $dir/slurm and submit again" >&2
            exit 1
        fi
        submit $(($2 + 1))
    else
        "$program" campaign merge "$dir"
        code=$?
        if [ "$code" -lt 2 ] && [ -n "$("$program" campaign status "$dir" --open)" ]; then
            submit 1
        else
            exit "$code"
        fi
    fi
    ;;
esac
"#,
        program = quoted(&program.to_string_lossy()).trim_matches('\'')
    )
}
