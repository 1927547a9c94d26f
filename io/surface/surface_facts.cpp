// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What triangles make as a reader of their file finds them.
#include "io/surface/surface_facts.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/surface/surface.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

using CornerRecord = ExternalSort<3>::Record;

/// An edge at a vertex, and the triangles there that run along it to its other end and back.
struct Spoke {
  std::uint64_t end = 0;
  std::uint64_t leaving = 0;
  std::uint64_t coming = 0;
  std::size_t fan = 0;  ///< the place of a spoke that triangles lead to, or its own
};

std::vector<Spoke> spokes_of(std::span<const CornerRecord> around) {
  std::vector<Spoke> spokes;
  for (const auto& [vertex, to, from] : around) {
    spokes.push_back({.end = to, .leaving = 1});
    spokes.push_back({.end = from, .coming = 1});
  }
  std::sort(spokes.begin(), spokes.end(),
            [](const Spoke& a, const Spoke& b) { return a.end < b.end; });
  std::vector<Spoke> out;
  for (const Spoke& spoke : spokes) {
    if (out.empty() || out.back().end != spoke.end) {
      out.push_back({.end = spoke.end, .fan = out.size()});
    }
    out.back().leaving += spoke.leaving;
    out.back().coming += spoke.coming;
  }
  return out;
}

std::size_t place_of(const std::vector<Spoke>& spokes, std::uint64_t end) {
  const auto found =
      std::lower_bound(spokes.begin(), spokes.end(), end,
                       [](const Spoke& spoke, std::uint64_t vertex) { return spoke.end < vertex; });
  return static_cast<std::size_t>(found - spokes.begin());
}

std::size_t root_of(std::vector<Spoke>& spokes, std::size_t at) {
  while (spokes[at].fan != at) at = spokes[at].fan = spokes[spokes[at].fan].fan;
  return at;
}

/// Returns into how many parts the triangles at a vertex fall, joined where they share an edge.
std::size_t fans_of(std::vector<Spoke>& spokes, std::span<const CornerRecord> around) {
  std::size_t fans = spokes.size();
  for (const auto& [vertex, to, from] : around) {
    const std::size_t a = root_of(spokes, place_of(spokes, to));
    const std::size_t b = root_of(spokes, place_of(spokes, from));
    if (a == b) continue;
    spokes[std::max(a, b)].fan = std::min(a, b);
    --fans;
  }
  return fans;
}

void look_around(std::span<const CornerRecord> around, SurfaceFacts& facts) {
  std::vector<Spoke> spokes = spokes_of(around);
  const std::uint64_t vertex = around[0][0];
  for (const Spoke& spoke : spokes) {
    if (spoke.end < vertex) continue;  // the edge is counted at its other end
    if (spoke.leaving != spoke.coming) ++facts.open_edges;
    if (std::max(spoke.leaving, spoke.coming) > 1) ++facts.crowded_edges;
  }
  if (fans_of(spokes, around) > 1) ++facts.pinched_vertices;
}

/// Returns the bits of a coordinate in 32 bits, by which readers compare; 0 has no sign there.
std::uint64_t float_bits(double x) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(x) + 0.0F);
}

}  // namespace

void SurfaceFactsSink::Sum::add(double term) {
  const double sum = sum_ + term;
  lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
  sum_ = sum;
}

SurfaceFactsSink::SurfaceFactsSink(SurfaceSink& next, Joined joined,
                                   const std::filesystem::path& folder)
    : next_(next),
      joined_(joined),
      folder_(folder),
      vertices_(folder),
      places_(folder, kSurfaceSortBytes),
      corners_(folder, kSurfaceSortBytes) {}

Position SurfaceFactsSink::seen(const Position& position) const {
  if (joined_ == Joined::kByNumber) return position;
  Position out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = static_cast<float>(position[k]);
  return out;
}

void SurfaceFactsSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    if (joined_ == Joined::kByPlace) {
      constexpr unsigned kFloatBits = 32;
      places_.add({float_bits(position[0]) << kFloatBits | float_bits(position[1]),
                   float_bits(position[2]), vertices_.size()});
    }
    vertices_.append(seen(position));
    if (!first_) first_ = vertices_[0];
  }
  next_.write_vertices(positions);
}

void SurfaceFactsSink::join_places() {
  if (same_ || joined_ == Joined::kByNumber) return;
  same_.emplace(folder_, vertices_.size());
  places_.each_group<2>([&](std::span<const ExternalSort<3>::Record> here) {
    for (const auto& record : here) same_->set(record[2], here[0][2]);
  });
}

void SurfaceFactsSink::write_triangles(std::span<const Triangle> triangles) {
  join_places();
  for (const Triangle& triangle : triangles) {
    std::array<Position, 3> at{};
    Triangle corners = triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      at[i] = vertices_[triangle[i]];
      if (same_) corners[i] = same_->get(triangle[i]);
    }
    ++facts_.triangles;
    volume6_.add(volume6(*first_, at[0], at[1], at[2]));
    const auto& [a, b, c] = corners;
    if (a == b || b == c || c == a) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      corners_.add({corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]});
    }
  }
  next_.write_triangles(triangles);
}

void SurfaceFactsSink::finish() {
  corners_.each_group<1>(
      [&](std::span<const CornerRecord> around) { look_around(around, facts_); });
  constexpr double kSixths = 6;
  facts_.volume = volume6_.total() / kSixths;
  next_.finish();
}

}  // namespace mw::io
