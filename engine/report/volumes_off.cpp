// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the worst few while labels pass by.
#include "engine/report/volumes_off.h"

#include <algorithm>
#include <cmath>

#include "engine/report/figures.h"
#include "engine/settings/promises.h"
#include "io/file/errors.h"

namespace mw::report {
namespace {

/// Ties go to the smaller label.
bool is_worse(const audit::VolumeRow& a, const audit::VolumeRow& b) {
  return std::abs(a.error) > std::abs(b.error) ||
         (std::abs(a.error) == std::abs(b.error) && a.label < b.label);
}

bool is_measured(const FinishedRun& run) {
  const bool is_whole = !run.connected || run.connected->parts == run.connected->found;
  return run.amounts && is_whole && run.why_no_volumes != engine::kVolumesOfScores;
}

std::string error_text(double error) {
  return (error > 0 ? "+" : "") + format_percent(error, 1);
}

}  // namespace

VolumesOff volumes_off(const FinishedRun& run) {
  VolumesOff out;
  if (!is_measured(run)) return out;
  for_each_volume(run, [&](const audit::VolumeRow& row) {
    if (row.voxels < audit::kMinJudgedVoxels || std::abs(row.error) <= VolumesOff::kShare) return;
    ++out.count;
    out.worst.insert(std::upper_bound(out.worst.begin(), out.worst.end(), row, is_worse), row);
    if (out.worst.size() > VolumesOff::kMostListed) out.worst.pop_back();
  });
  return out;
}

std::string volumes_off_text(const FinishedRun& run) {
  const VolumesOff off = volumes_off(run);
  if (off.count == 0) return "";
  std::string list;
  for (const audit::VolumeRow& row : off.worst) {
    list += (list.empty() ? "" : ", ") +
            label_text(run.labels.raw(row.label), run.labels.is_signed(), run.volume.names) + " " +
            error_text(row.error);
  }
  if (off.count > off.worst.size()) {
    list += io::text(", and ", with_commas(off.count - off.worst.size()), " more");
  }
  return io::text(with_commas(off.count), off.count == 1 ? " label" : " labels", " of ",
                  with_commas(audit::kMinJudgedVoxels), " voxels and more ",
                  off.count == 1 ? "is" : "are", " off by more than ",
                  format_percent(VolumesOff::kShare, 0), " in volume: ", list);
}

}  // namespace mw::report
