// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What mwmesh surface says of the triangles that it wrote.
#include "engine/cli/surface/surface_summary.h"

#include <iostream>

#include "engine/cli/requests.h"
#include "io/file/errors.h"

namespace mw::cli {
namespace {

constexpr std::size_t kMaxListed = 20;

/// Returns "1 edge" or "2,000 edges".
std::string counted(std::uint64_t count, const std::string& one, const std::string& several) {
  return with_commas(count) + " " + (count == 1 ? one : several);
}

std::string closed_words(const io::SurfaceFacts& facts) {
  if (facts.is_closed()) return "closed";
  return "open at " + counted(facts.open_edges, "edge", "edges");
}

std::string manifold_words(const io::SurfaceFacts& facts) {
  if (facts.is_manifold()) return "manifold";
  std::vector<std::string> places;
  if (facts.crowded_edges > 0) places.push_back(counted(facts.crowded_edges, "edge", "edges"));
  if (facts.pinched_vertices > 0) {
    places.push_back(counted(facts.pinched_vertices, "vertex", "vertices"));
  }
  return "not manifold at " + joined(places, " and ");
}

/// Returns the volume that is enclosed; nothing where that is no volume of labels.
std::string volume_words(const io::SurfaceFacts& facts, bool of_labels, const std::string& unit) {
  if (!facts.is_closed() || !of_labels) return {};
  return ", " + std::string(unit.empty() ? "volume " : "") + format_volume(facts.volume, unit);
}

std::string words(const WrittenSurface& surface, const std::string& unit) {
  const io::SurfaceFacts& facts = surface.facts;
  return closed_words(facts) + ", " + manifold_words(facts) +
         volume_words(facts, surface.of_labels, unit) + ", " +
         counted(facts.triangles, "triangle", "triangles");
}

/// Returns "closed", or how many are.
std::string share_words(std::size_t some, std::size_t all, const std::string& what) {
  if (some == all) return "all " + what;
  return with_commas(some) + " " + what;
}

}  // namespace

void SurfaceSummary::add(WrittenSurface surface) {
  const io::SurfaceFacts& facts = surface.facts;
  ++count_;
  if (facts.is_closed()) ++closed_;
  if (facts.is_manifold()) ++manifold_;
  all_.triangles += facts.triangles;
  all_.open_edges += facts.open_edges;
  all_.volume += facts.volume;
  of_labels_ = of_labels_ && surface.of_labels;
  if (first_.size() < kMaxListed) first_.push_back(std::move(surface));
}

void SurfaceSummary::print() const {
  if (count_ == 1) {
    if (is_joined_ && !first_.front().facts.is_manifold()) {
      std::cout
          << "touching    readers of this format join labels where they touch; --each writes a "
             "file for each\n";
    }
    std::cout << "surface     " << words(first_.front(), unit_) << "\n";
    if (is_of_all_ && !first_.front().facts.is_closed()) {
      std::cout << "note        interfaces of all labels are no closed surface: --labels A,B or "
                   "--each writes closed ones\n";
    }
    return;
  }
  for (const WrittenSurface& surface : first_) {
    std::cout << "surface     " << surface.name << ": " << words(surface, unit_) << "\n";
  }
  if (count_ > first_.size()) std::cout << "            ...\n";
  std::cout << "surfaces    " << with_commas(count_) << ", "
            << share_words(closed_, count_, "closed") << ", "
            << share_words(manifold_, count_, "manifold") << volume_words(all_, of_labels_, unit_)
            << ", " << counted(all_.triangles, "triangle", "triangles") << "\n";
}

}  // namespace mw::cli
