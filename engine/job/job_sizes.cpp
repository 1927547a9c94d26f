// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/job_sizes.h"

#include <cmath>
#include <limits>

#include "engine/job/halving.h"
#include "engine/labels/voxel_lattice.h"
#include "io/file/errors.h"

namespace mw::engine {
namespace {

/// Opens the image of sizes, if any.  ERRORS: those of SizeImage; kUsage when the job lacks it.
std::optional<SizeImage> size_image(const io::VolumeInfo& labels, const MeshJob& job) {
  const std::string& file = job.settings.sizes.rules.image;
  if (file.empty()) return std::nullopt;
  if (job.size_image != nullptr) return SizeImage(*job.size_image, labels, file);
  io::fail_usage("--size: the image " + file + " was not opened");
}

/// Returns the smallest size of an image.  ERRORS: mw::Error(kInput) if it asks for none.
double least_size_of(const SizeImage& image, const MeshJob& job) {
  const double least = image.least();
  if (std::isfinite(least)) return least;
  io::fail_input(job.settings.sizes.rules.image, {}, "has no positive number, so no size is asked",
                 "give edge lengths where they matter, and 0 elsewhere");
}

/// Returns how many voxels of an image, whose smallest size is `smallest`, ask for less than can be
/// had.
report::RaisedSizes raised_sizes(const SizeImage& image, double smallest,
                                 const io::VolumeInfo& labels, int halvings) {
  const double least = std::ldexp(least_size(labels), -halvings);
  if (smallest >= least) return {};
  return {.voxels = image.voxels_below(least), .least = told_size(least)};
}

}  // namespace

MeshJob with_physical_sizes(const io::LabelVolume& opened, MeshJob job) {
  const io::VolumeInfo volume = io::info_after(job.steps, opened.info());
  check_coordinates(volume);
  SizeRules& rules = job.settings.sizes.rules;
  rules = rules.in_physical_units(voxel_edge(volume));
  return job;
}

JobSizes settle_sizes(const io::VolumeInfo& opened, const MeshJob& asked, MeshJob& job) {
  // An image has the slices of the file, and the lattice those between them, too.
  JobSizes out{.image = size_image(opened, asked)};
  const io::VolumeInfo volume = io::info_after(asked.steps, opened);
  const double smallest =
      out.image ? least_size_of(*out.image, asked) : std::numeric_limits<double>::infinity();
  out.halvings = halvings_of(volume, asked, smallest);
  job.settings = before_halvings(asked.settings, out.halvings);
  if (!out.image) return out;
  if (asked.settings.sizes.count == 0) {
    out.raised = raised_sizes(*out.image, smallest, volume, out.halvings);
  }
  out.image.emplace(out.image->scaled(std::ldexp(1.0, out.halvings)));
  return out;
}

std::vector<double> edge_sizes(const SizeRules& rules, const io::LabelTable& table) {
  std::vector<double> out(table.size());
  for (Label label = 0; label < out.size(); ++label) {
    out[label] = rules.of_label(table.raw(label)).value_or(0.0);
  }
  return out;
}

std::vector<LabelPair> sized_interfaces(const MeshJob& job, const io::LabelTable& table) {
  std::vector<LabelPair> out;
  const LabelSelection kept(wanted_labels(job.choice, table), table);
  // A label that the volume does not have is refused by the marches.
  const auto is_written = [&](RawLabel label) {
    return table.contains(label) && kept.keeps(table.dense(label));
  };
  for (const InterfaceSize& s : job.settings.sizes.rules.interfaces) {
    const bool is_pair = s.low && s.high;
    if (is_pair && is_written(*s.low) && is_written(*s.high)) out.emplace_back(*s.low, *s.high);
  }
  return out;
}

}  // namespace mw::engine
