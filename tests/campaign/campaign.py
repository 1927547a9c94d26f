#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Random cases for a given time; see campaign.sh."""
import argparse
import collections
import concurrent.futures
import sys
import time

import case

CASES_A_SEED = 1_000_000
SECONDS_A_LINE = 120


def arguments():
    parser = argparse.ArgumentParser(prog="tests/campaign.sh", description=__doc__)
    parser.add_argument("minutes", nargs="?", type=float, default=1)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("--case", type=int, help="only this one; its files stay")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--judge", help=argparse.SUPPRESS)
    return parser.parse_args()


def report(number, text):
    print(f"campaign: FAILED: reproduce by: tests/campaign.sh --case {number}\n{text}", flush=True)


def summary(counts, failed):
    words = ", ".join(f"{count} {word}" for word, count in counts.items())
    return f"campaign: {words}; {failed} failed"


def one(args):
    verdict, what = case.run_case(args.case, args.program, args.judge, keep=True, tell=print)
    if verdict == "failed":
        report(args.case, what)
        return 1
    print(f"campaign: case {args.case}: " + ", ".join(what))
    return 0


def many(args):
    """Starts cases until the time is over; each worker takes the next number."""
    end = time.monotonic() + 60 * args.minutes
    numbers = iter(range(args.seed * CASES_A_SEED, (args.seed + 1) * CASES_A_SEED))
    counts, failed, told = collections.Counter(), 0, time.monotonic()

    def next_case():
        if time.monotonic() >= end:
            return None
        number = next(numbers)
        return number, *case.run_case(number, args.program, args.judge)

    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        running = {pool.submit(next_case) for _ in range(args.jobs)}
        while running:
            done, running = concurrent.futures.wait(running, return_when="FIRST_COMPLETED")
            for result in (future.result() for future in done):
                if result is None:
                    continue
                running.add(pool.submit(next_case))
                number, verdict, what = result
                counts["cases"] += 1
                if verdict == "ok":
                    counts.update(what)
                else:
                    failed += 1
                    report(number, what)
                if time.monotonic() >= told + SECONDS_A_LINE:
                    told = time.monotonic()
                    print(summary(counts, failed), flush=True)
    print(summary(counts, failed))
    return 1 if failed else 0


def main():
    args = arguments()
    return many(args) if args.case is None else one(args)


if __name__ == "__main__":
    sys.exit(main())
