#!/usr/bin/env bash
# A heart beat from nothing: installs what is missing, builds the program and runs the healthy ventricle.
# Run again, it only runs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source apps/setup.sh

install_packages
build release cardiac_app
build/release/bin/cardiac run protocols/healthy_lv.toml --out results/healthy_lv
echo "Report: $PWD/results/healthy_lv/report.html"
