#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Runs one test of bench/paper, which needs Debian's numpy.  Usage: run.sh TEST.py
set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
python=/usr/bin/python3
"$python" -c 'import numpy' 2>/dev/null || {
  echo "skipped: python3-numpy is missing"
  exit 77
}
export PYTHONPATH="$here/../../../bench/paper" PYTHONDONTWRITEBYTECODE=1
exec "$python" "$here/$1" --verbose
