// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run of `mwmesh mesh` says at its end.
#include "engine/cli/mesh/mesh_summary.h"

#include <algorithm>
#include <iostream>
#include <numeric>

#include "engine/cli/log.h"
#include "engine/cli/requests.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/report/connect_report.h"
#include "engine/report/mesh_facts.h"
#include "engine/report/volumes_off.h"
#include "io/file/errors.h"

namespace mw::cli {
namespace {

using io::Json;

/// Says what the coordinates are, where the file does.
void print_space(const io::VolumeSpace& space) {
  std::string what;
  if (space.frame != io::WorldFrame::kOwn) what = name(space.frame);
  if (!space.unit.empty()) what += (what.empty() ? "" : ", ") + space.unit;
  if (!is_upright(space)) what += (what.empty() ? "" : ", ") + std::string("axes turned");
  if (!what.empty()) std::cout << "coordinates " << what << "\n";
}

/// Points to --interpolate-slices where it would take steps away.
void print_thick_slices(const report::FinishedRun& run, const MeshRequest& request) {
  const io::SliceFacts slices = io::slices_of(run.volume);
  const bool is_refused =
      request.volume.open.values != io::VoxelValues::kLabels || request.job.settings.periodic != 0;
  if (run.slices || slices.layers < 2 || slices.slices < 2 || is_refused) return;
  std::cout << "thick       slices along "
            << "xyz"[slices.axis] << " are " << slices.layers
            << " times as thick as voxels are wide, so surfaces have steps; --interpolate-slices "
               "makes labels between them\n";
}

/// Prints how near edges are to the sizes asked of their labels, where that was measured.
void print_sizes(const report::FinishedRun& run) {
  if (!run.edges) return;
  const engine::EdgeRatios& ratios = run.edges->ratios;
  double all = 0, near = 0;
  for (std::size_t i = 0; i < ratios.counts.size(); ++i) {
    const auto count = static_cast<double>(ratios.counts[i]);
    const double from = i == 0 ? 0.0 : ratios.kBounds[i - 1];
    all += count;
    near += from >= 0.6 && i < ratios.kBounds.size() ? count : 0;
  }
  if (all == 0) return;
  std::cout << "sizes       " << format_percent(near / all, 1)
            << " of edges are 0.6 to 1.5 of what was asked\n";
}

/// Warns if a coarse size could not be had at interfaces, though no other line explains it.
void print_stopped(const report::FinishedRun& run) {
  if (!run.edges) return;
  const std::vector<std::uint64_t>& counts = run.edges->ratios.at_interfaces;
  const auto sum = [&](std::ptrdiff_t bins) {
    return std::accumulate(counts.begin(), counts.begin() + bins, std::uint64_t{0});
  };
  const std::uint64_t shorter = sum(4), all = sum(std::ssize(counts));  // of 0.8 of what was asked
  double largest = 0;
  for (Label label = 0; label < run.labels.size(); ++label) {
    largest = std::max(largest, run.sizes.rules.of_label(run.labels.raw(label)).value_or(0));
  }
  const bool is_coarse = largest >= 3 * engine::least_size(run.volume);
  if (run.count || !is_coarse || 2 * shorter <= all) return;
  log_warning(io::text("--size: ", 100 * shorter / all,
                       " % of the edges at interfaces are shorter than 0.8 of what was asked, as "
                       "the bounds on distance and topology allow no longer ones; a larger "
                       "--max-distance may"));
}

/// Returns whether a number of tets is as near to what was asked as --count promises.
bool is_near(std::uint64_t tets, const report::CountFacts& count) {
  const auto asked = static_cast<double>(count.asked);
  return std::abs(static_cast<double>(tets) - asked) <= 0.1 * asked;
}

std::string without_size_text(const report::CountFacts& count) {
  const bool is_one = count.labels_without_size == 1;
  return io::text(count.labels_without_size, is_one ? " label has" : " labels have",
                  " no size, so no factor reaches ", is_one ? "its" : "their",
                  " tets; add *=H to --size");
}

/// Says why the mesh cannot have as few tets as were asked for.
std::string least_text(const report::FinishedRun& run) {
  const std::string fewer = io::text("--count ", run.count->asked, ": fewer tets than ",
                                     run.engine.tets, " cannot be had");
  if (run.count->labels_without_size > 0) {
    return fewer + " with these sizes: " + without_size_text(*run.count);
  }
  const std::string within = fewer + " within the bounds on distance, topology and shapes";
  if (run.sizes.across > 0) return within + " with this --across; lower it";
  const std::string& image = run.sizes.rules.image;
  return within + "; raise --max-distance, or lower --quality-floor" +
         (image.empty() ? "" : "; no factor reaches tets where " + image + " gives no size");
}

/// Says why the mesh cannot have as many tets as were asked for.
std::string most_text(const report::FinishedRun& run) {
  const std::string more = io::text("--count ", run.count->asked, ": more tets than ",
                                    run.engine.tets, " cannot be had");
  if (run.count->labels_without_size > 0) {
    return more + " with these sizes: " + without_size_text(*run.count);
  }
  return more + " without cutting tets, which only --size does; ask for a size";
}

/// Prints how many tets were asked for, and warns if the mesh cannot have that number.
void print_count(const report::FinishedRun& run, const Json& count) {
  if (!run.count) return;
  std::cout << told("count       {asked} tets were asked, sizes are scaled by {scale:g}", count)
            << told(" after {pilot.meshes} pilot meshes in {pilot.seconds:g} s", count) << "\n";
  if (run.count->is_least) log_warning(least_text(run));
  if (run.count->is_most) log_warning(most_text(run));
}

/// Warns if the mesh is far from the number that was asked for, though an end of the range of
/// sizes does not explain it.
void print_count_missed(const report::FinishedRun& run) {
  if (!run.count || run.count->is_least || run.count->is_most) return;
  const report::CountFacts& count = *run.count;
  if (is_near(run.engine.tets, count)) return;
  std::string why;
  if (count.trials > 0 && !is_near(count.expected, count)) {
    why = io::text(", and no factor that the pilot tried came nearer than ", count.expected);
    if (count.labels_without_size > 0) why += "; " + without_size_text(count);
  } else if (count.trials > 0 && count.expected != run.engine.tets) {
    why = io::text("; the pilot expected ", count.expected);
  }
  if (run.connected && run.connected->parts < run.connected->found) {
    why += io::text("; ", run.connected->found - run.connected->parts, " of ", run.connected->found,
                    " parts were left out (--parts)");
  }
  log_warning(io::text("--count ", count.asked, ": the mesh has ", run.engine.tets, " tets", why));
}

/// Warns of sizes that were asked on faces between labels where there are none.
void print_unmet(const report::FinishedRun& run) {
  if (!run.connected || run.connected->unmet.empty()) return;
  log_warning("--size " + report::pairs_text(run.connected->unmet, run.labels.is_signed()) +
              ": these labels do not meet: they share no face in the mesh");
}

/// Warns of an image that asks for smaller sizes than can be had.
void print_raised(const report::FinishedRun& run) {
  if (run.raised.voxels == 0) return;
  log_warning(io::text("--size ", run.sizes.rules.image, ": ", run.raised.voxels,
                       run.raised.voxels == 1 ? " voxel asks" : " voxels ask", " for less than ",
                       run.raised.least, ", the least size that can be had here, and got that"));
}

void print_halvings(const report::FinishedRun& run) {
  const int times = run.engine.halvings;
  if (times == 0) return;
  std::cout << "halved      " << (times == 1 ? "once" : "twice")
            << ": a size is below the least of the marches, so each of their tets was cut into "
            << (times == 1 ? 8 : 64) << "; none has a radius ratio below "
            << format_figure(run.radius_ratio_floor) << "\n";
}

void print_parts(const report::FinishedRun& run) {
  if (!run.connected) return;
  const std::string parts = report::connect_text(*run.connected);
  if (!parts.empty()) std::cout << "parts       " << parts << "\n";
  const std::string apart = report::pairs_text(run.connected->apart, run.labels.is_signed());
  if (!apart.empty()) {
    log_warning("--split, --cohesive: " + apart +
                ": these labels share no face in the mesh, so nothing opens between them");
  }
  const std::uint64_t facets = run.connected->facets;
  if (facets > 0 && run.connected->held == facets) {
    log_warning(io::text("--split, --cohesive: nothing opens: ", facets,
                         facets == 1 ? " facet has" : " facets have",
                         " only vertices at which the interface ends; a smaller --size there gives "
                         "it others"));
  }
  const std::string stiff = report::stiff_text(*run.connected);
  if (!stiff.empty()) std::cout << "stiff       " << stiff << "\n";
}

void print_across(const report::FinishedRun& run) {
  if (run.sizes.across == 0) return;
  const engine::ThinParts& parts = run.engine.thin_parts;
  if (parts.voxels == 0) {
    log_warning(io::text("--across ", run.sizes.across,
                         ": no part of these labels is thin enough to be looked at: up to 32 voxels"
                         " of the lattice, which has the layers of thick slices"));
  }
  if (parts.too_thin == 0) return;
  log_warning(io::text("--across ", run.sizes.across, ": ", parts.too_thin, " of ", parts.voxels,
                       " voxels amid thin parts are in parts too thin for that, as edges are at "
                       "least as long as the diagonal of a voxel; a --size below that cuts tets"));
}

void print_sample(const Json& sample) {
  std::cout << told("sample      {name}: {statistic} of {file}, ", sample);
  const std::string range = told("{least:g} to {most:g}", sample);
  std::cout << (range.empty() ? "no tet has a value: the image lies elsewhere" : range);
  const std::uint64_t outside = sample["tets_outside"].integer();
  if (!range.empty() && sample["tets_partly_outside"].integer() > 0) {
    std::cout << told("; {tets_partly_outside} tets are partly outside of the image", sample);
  }
  if (!range.empty() && outside > 0) std::cout << "; " << outside << " are outside and have NaN";
  std::cout << "\n";
}

void print_certificate(const report::FinishedRun& run) {
  if (!run.certificate) {
    std::cout << "certificate none: " << run.why_no_certificate << "\n";
    return;
  }
  const std::vector<audit::Check>& checks = run.certificate->checks;
  const bool has_bound = std::any_of(checks.begin(), checks.end(), [](const audit::Check& check) {
    return check.name == "P4 distance";
  });
  std::vector<std::string> held{"topology", "partition"};
  if (run.radius_ratio_floor > 0) held.emplace_back("radius ratio");
  if (has_bound) held.emplace_back("distance");
  if (run.why_no_volumes.empty()) held.emplace_back("volumes");
  const std::string last = held.back();
  held.pop_back();
  std::cout << "certificate " << joined(held, ", ") << " and " << last << " hold"
            << (has_bound ? "" : "; distance had no bound") << "\n";
}

/// Says what keeps the volumes of thin labels, as measured (bench/parameters.md, "Thin labels").
std::string volumes_mend_text(const report::FinishedRun& run,
                              const engine::MeshSettings& settings) {
  constexpr double kNear = 1.0;
  if (!run.why_no_volumes.empty()) return run.why_no_volumes + " is why";
  if (settings.max_distance.value_or(kNear) <= kNear) return "";
  return "--max-distance 1 keeps thin labels better";
}

/// Names large labels whose volumes are off, and the option that mends most of that.
void print_volumes(const report::FinishedRun& run, const engine::MeshSettings& settings) {
  const std::string off = report::volumes_off_text(run);
  if (off.empty()) return;
  const std::string mend = volumes_mend_text(run, settings);
  std::cout << "volumes     " << off << (mend.empty() ? "" : "; ") << mend << "\n";
}

std::string name_of(RawLabel label, const report::FinishedRun& run) {
  return report::label_text(label, run.labels.is_signed(), run.volume.names);
}

/// Prints how many labels there are, and what the first few are called.
void print_labels(const report::FinishedRun& run, const LabelTets& tets) {
  constexpr std::size_t kMaxListed = 6;
  const std::size_t all = run.labels.size(), count = tets.counts().size();
  std::cout << "labels      ";
  if (count > 0 && count < all) std::cout << count << " of ";
  std::cout << all;
  std::size_t listed = 0;
  for (const auto& [label, number] : tets.counts()) {
    if (listed == kMaxListed) break;
    std::cout << (listed++ == 0 ? ": " : ", ") << name_of(label, run);
  }
  if (listed < count) std::cout << ", ...";
  if (all == 1) std::cout << "; the volume has no other, so the mesh is a filled box";
  std::cout << "\n";
}

/// Tells of label 0 if nobody chose labels and it has the most tets: it is then the background.
void print_background(const report::FinishedRun& run, const MeshRequest& request,
                      const LabelTets& tets) {
  const auto& counts = tets.counts();
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const engine::LabelChoice& choice = request.job.choice;
  if (choice.labels || choice.background || counts.size() < 2 || most->first != 0) return;
  const double share =
      100 * static_cast<double>(most->second) / static_cast<double>(run.engine.tets);
  std::cout << "background  label 0 is meshed, too, " << format_figure(share)
            << " % of the tets; --background 0 leaves it out\n";
}

}  // namespace

void LabelTets::write_tets(std::span<const io::TetRows> /*tets*/,
                           std::span<const RawLabel> labels) {
  // Tets of a label come in long runs.
  for (std::size_t at = 0; at < labels.size();) {
    const auto* const end = std::find_if(labels.data() + at, labels.data() + labels.size(),
                                         [&](RawLabel label) { return label != labels[at]; });
    const auto next = static_cast<std::size_t>(end - labels.data());
    counts_[labels[at]] += next - at;
    at = next;
  }
}

void print_summary(const report::FinishedRun& run, const MeshRequest& request,
                   const LabelTets& tets) {
  const Json facts = report::run_report(run, request.output, {});
  const auto print = [&](const char* line) { std::cout << told(line, facts); };
  print(
      "vertices    {output.vertices} ({output.vertex_fraction:2%} of the voxel corners)\n"
      "tets        {output.tets}\n");
  print_labels(run, tets);
  print_background(run, request, tets);
  print_parts(run);
  report::print_steps(run.specks, run.slices, run.welds);
  if (run.engine.lattice.layers != Index3{1, 1, 1}) {
    print("lattice     {lattice.shape_xyz}, voxels cut into {lattice.layers_xyz} layers\n");
  }
  print_thick_slices(run, request);
  print_space(run.volume.space);
  print_count(run, facts["size"]["count"]);
  print_halvings(run);
  print_raised(run);
  print_sizes(run);
  print_stopped(run);
  print_count_missed(run);
  print_unmet(run);
  print_across(run);
  for (const Json& sample : facts["samples"].elements()) print_sample(sample);
  print_volumes(run, request.job.settings);
  print_certificate(run);
  print(
      "seconds     {performance.wall_s:g}\nvoxels/s    {performance.voxels_per_s:g}\n"
      "peak memory {performance.peak_rss_bytes:b}\n");
}

}  // namespace mw::cli
