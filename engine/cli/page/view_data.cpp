// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The surfaces that a page carries for its view in three dimensions.
#include "engine/cli/page/view_data.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "kernels/core/sort_distinct.h"

namespace mw::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "pages hold little endian numbers");

/// Returns the labels from the one with the most tets on, with the surrounding one at the end.
std::vector<Label> by_size(const io::GroupedMesh& mesh, std::optional<Label> surrounding) {
  std::vector<Label> out(mesh.table().size());
  for (Label rank = 0; rank < out.size(); ++rank) out[rank] = rank;
  const std::vector<io::RowRange>& tets = mesh.label_tets();
  std::stable_sort(out.begin(), out.end(),
                   [&](Label a, Label b) { return tets[a].size() > tets[b].size(); });
  if (surrounding) {
    std::stable_partition(out.begin(), out.end(), [&](Label rank) { return rank != *surrounding; });
  }
  return out;
}

/// Returns for each label its groups of facets, ascending.
std::vector<std::vector<std::size_t>> groups_of(const io::GroupedMesh& mesh) {
  std::vector<std::vector<std::size_t>> out(mesh.table().size());
  const io::FacetGroups& groups = mesh.facet_groups();
  for (std::size_t i = 0; i < groups.size(); ++i) {
    out[groups[i].first].push_back(i);
    if (groups[i].second != kExterior) out[groups[i].second].push_back(i);
  }
  return out;
}

}  // namespace

ViewData::ViewData(io::GroupedMesh& mesh, std::optional<Label> surrounding) : mesh_(mesh) {
  choose(surrounding);
  collect_rows();
}

void ViewData::choose(std::optional<Label> surrounding) {
  const io::FacetGroups& groups = mesh_.facet_groups();
  const std::vector<std::vector<std::size_t>> of_label = groups_of(mesh_);
  std::vector<bool> taken(groups.size());
  for (const Label rank : by_size(mesh_, surrounding)) {
    std::uint64_t more = 0;
    for (const std::size_t i : of_label[rank]) more += taken[i] ? 0 : groups[i].facets.size();
    if (triangles_ + more > kMaxViewTriangles || labels_.size() == kMaxViewLabels) continue;
    for (const std::size_t i : of_label[rank]) taken[i] = true;
    triangles_ += more;
    labels_.push_back(rank);
  }
  std::sort(labels_.begin(), labels_.end());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (taken[i]) groups_.push_back(groups[i]);
  }
}

void ViewData::collect_rows() {
  rows_.reserve(3 * triangles_);
  for (const io::FacetGroup& group : groups_) {
    for (std::uint64_t number = group.facets.begin; number < group.facets.end; ++number) {
      for (const std::uint64_t row : mesh_.facet(number).rows) rows_.push_back(row);
    }
  }
  sort_distinct(rows_);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const io::Position p = mesh_.node(rows_[i]);
    if (i == 0) lo_ = hi_ = p;
    for (std::size_t k = 0; k < 3; ++k) {
      lo_[k] = std::min(lo_[k], p[k]);
      hi_[k] = std::max(hi_[k], p[k]);
    }
  }
}

std::int64_t ViewData::index(Label rank) const {
  const auto found = std::lower_bound(labels_.begin(), labels_.end(), rank);
  return found == labels_.end() || *found != rank ? -1 : found - labels_.begin();
}

io::Json ViewData::json() const {
  io::Json groups = io::Json::array();
  for (const io::FacetGroup& group : groups_) {
    groups.push_back({index(group.first), index(group.second), group.facets.size()});
  }
  return {{"lo", lo_},
          {"hi", hi_},
          {"box", {{"origin", mesh_.box().origin}, {"edges", mesh_.box().edges}}},
          {"groups", std::move(groups)}};
}

void ViewData::write_vertices(const AppendText& append) {
  Base64 out(append);
  for (const std::uint64_t row : rows_) {
    const io::Position p = mesh_.node(row);
    std::array<std::uint16_t, 3> numbers{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = hi_[k] - lo_[k];
      const double share = length > 0 ? (p[k] - lo_[k]) / length : 0;
      numbers[k] = static_cast<std::uint16_t>(std::lround(65535 * share));
    }
    out.add(std::as_bytes(std::span(numbers)));
  }
  out.finish();
}

void ViewData::write_triangles(const AppendText& append) {
  Base64 out(append);
  for (const io::FacetGroup& group : groups_) {
    for (std::uint64_t number = group.facets.begin; number < group.facets.end; ++number) {
      std::array<std::uint32_t, 3> numbers{};
      const io::Facet facet = mesh_.facet(number);
      for (std::size_t i = 0; i < 3; ++i) {
        numbers[i] = static_cast<std::uint32_t>(
            std::lower_bound(rows_.begin(), rows_.end(), facet.rows[i]) - rows_.begin());
      }
      out.add(std::as_bytes(std::span(numbers)));
    }
  }
  out.finish();
}

}  // namespace mw::cli
