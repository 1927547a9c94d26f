// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the stages of a run took (--report of mwmesh mesh), and would take with more cores.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/system/stages.h"

namespace mw::bench {

/// Returns the stages of the report of a run of one thread.  What the process did beside them (the
/// start, the report) is a last one, "rest", and all of it alone.
/// ERRORS: mw::Error(kInput) naming `file` where the text is no such report.
[[nodiscard]] std::vector<engine::StageCost> read_stages(std::string_view text,
                                                         std::string_view file);

/// Returns what a run holds during its marches beside windows and blocks, which memory may spill.
/// The peak of labels is one of their preparation, so it does not count.
/// ERRORS: those of read_stages().
[[nodiscard]] std::uint64_t read_held_bytes(std::string_view text, std::string_view file);

/// Returns how many cores a memory feeds, of those that there are, where a run moves `traffic`
/// bytes between memory and caches in its seconds of one core.  REQUIRES: all are positive.
[[nodiscard]] std::size_t fed_cores(std::size_t cores, double traffic, double seconds,
                                    double bandwidth);

/// Returns the seconds of a stage when threads share all of it that they can.  REQUIRES: cores > 0.
[[nodiscard]] double shared_by(const engine::StageCost& stage, std::size_t cores);

/// Returns the seconds of all stages beside the visits of windows, whose schedule decides.  Of the
/// stage "march" that is what the keeper of the march does alone.
[[nodiscard]] double seconds_beside_visits(std::span<const engine::StageCost> stages,
                                           std::size_t cores);

}  // namespace mw::bench
