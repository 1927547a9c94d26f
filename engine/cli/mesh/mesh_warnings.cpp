// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run of `mwmesh mesh` warns of at its end.
#include "engine/cli/mesh/mesh_warnings.h"

#include <algorithm>
#include <numeric>

#include "engine/cli/log.h"
#include "engine/cli/requests.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/report/connect_report.h"
#include "io/file/errors.h"

namespace mw::cli {
namespace {

/// Warns if a coarse size could not be had at interfaces, though no other line explains it.
void warn_of_stopped(const report::FinishedRun& run) {
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

/// Warns if the mesh cannot have the number that was asked for.
void warn_of_count(const report::FinishedRun& run) {
  if (!run.count) return;
  if (run.count->is_least) log_warning(least_text(run));
  if (run.count->is_most) log_warning(most_text(run));
}

/// Warns if the mesh is far from the number that was asked for, though an end of the range of
/// sizes does not explain it.
void warn_of_count_missed(const report::FinishedRun& run) {
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
void warn_of_unmet(const report::FinishedRun& run) {
  if (!run.connected || run.connected->unmet.empty()) return;
  log_warning("--size " + report::pairs_text(run.connected->unmet, run.labels.is_signed()) +
              ": these labels do not meet: they share no face in the mesh");
}

/// Warns of an image that asks for smaller sizes than can be had.
void warn_of_raised(const report::FinishedRun& run) {
  if (run.raised.voxels == 0) return;
  log_warning(io::text("--size ", run.sizes.rules.image, ": ", run.raised.voxels,
                       run.raised.voxels == 1 ? " voxel asks" : " voxels ask", " for less than ",
                       run.raised.least, ", the least size that can be had here, and got that"));
}

/// Warns of interfaces that were to open and do not.
void warn_of_closed(const report::FinishedRun& run) {
  if (!run.connected) return;
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
}

void warn_of_across(const report::FinishedRun& run) {
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

}  // namespace

void print_warnings(const report::FinishedRun& run) {
  warn_of_count(run);
  warn_of_raised(run);
  warn_of_stopped(run);
  warn_of_count_missed(run);
  warn_of_closed(run);
  warn_of_unmet(run);
  warn_of_across(run);
}

}  // namespace mw::cli
