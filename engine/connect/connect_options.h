// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which parts of a mesh are written, where vertices are doubled, and what is found about parts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/labels/label_table.h"
#include "io/mesh/mesh_record.h"

namespace mw::engine {

/// Which parts are written.  A part is a set of tets that faces join, whatever their labels.
struct PartsRule {
  bool only_largest = false;     ///< only the part with the most tets, the first of equals
  std::uint64_t least_tets = 0;  ///< only parts of at least this many tets

  [[nodiscard]] bool leaves_out() const { return only_largest || least_tets > 0; }
  friend bool operator==(const PartsRule&, const PartsRule&) = default;
};

using LabelPair = std::pair<RawLabel, RawLabel>;

/// Interfaces at which a mesh comes apart.
struct SplitRule {
  bool all = false;
  std::vector<LabelPair> pairs;  ///< smaller number first; ascending

  [[nodiscard]] bool any() const { return all || !pairs.empty(); }
  [[nodiscard]] bool cuts(RawLabel one, RawLabel other) const;
};

struct ConnectOptions {
  PartsRule parts;
  SplitRule split;
  bool open_hinges = false;
  io::CohesiveRule cohesive{};  ///< interfaces that are split, too, and get wedges
  /// Pairs of labels that are looked for in the mesh; smaller number first, ascending.
  std::vector<LabelPair> watched{};

  /// True if the mesh that is written may differ from the one that was made.
  [[nodiscard]] bool change_mesh() const { return parts.leaves_out() || double_vertices(); }
  /// True if sides of interfaces, or parts that hang at a vertex, get vertices of their own.
  [[nodiscard]] bool double_vertices() const {
    return split.any() || open_hinges || cohesive.any();
  }
  /// Returns all interfaces whose vertices are doubled.
  [[nodiscard]] SplitRule all_split() const;
};

/// Parses "all", "largest", or the least number of tets.  ERRORS: mw::Error(kUsage).
[[nodiscard]] PartsRule parse_parts(std::string_view text);
/// Parses "1|2,1|3", or "*" for all interfaces.  ERRORS: mw::Error(kUsage).
[[nodiscard]] SplitRule parse_split(std::string_view text);
/// Takes pairs as parse_split() does; wedges go from the first label of a pair to the second.
/// ERRORS: mw::Error(kUsage), also for a pair that is there twice.
[[nodiscard]] io::CohesiveRule parse_cohesive(std::string_view text);
/// ERRORS: mw::Error(kUsage) for a label in --split or --cohesive that the volume does not have.
void check_interfaces(const ConnectOptions& options, const io::LabelTable& table);

/// Parts of fewer tets are counted as small.
inline constexpr std::uint64_t kSmallPartTets = 20;
/// The most parts and hinges that are reported with a place, and labels that are listed.
inline constexpr std::size_t kMostPlaces = 20;

struct PartPlace {
  std::uint64_t tets = 0;
  bool is_free = false;   ///< no chain of parts that touch joins it to the largest part
  RawLabel label = 0;     ///< label of one of its tets
  std::uint64_t row = 0;  ///< row of one of its vertices, in the mesh as it was made
  io::Position place{};   ///< place of that vertex
};

/// A vertex at which tets meet that neither faces nor edges join there, or an edge at which tets
/// meet that no faces join there.
struct HingePlace {
  bool is_edge = false;
  std::array<RawLabel, 2> labels{};     ///< labels of two tets that meet
  std::array<std::uint64_t, 2> rows{};  ///< rows of the edge's ends; equal for a vertex
  std::array<io::Position, 2> places{};
};

/// What hangs together in a mesh, before vertices are doubled.
struct ConnectFacts {
  std::uint64_t found = 0;    ///< parts, before any was left out
  std::uint64_t parts = 0;    ///< parts that are written; all that follows is about these
  std::uint64_t hanging = 0;  ///< parts that only vertices or edges join to the largest one
  std::uint64_t free = 0;     ///< parts that nothing joins to the largest one
  std::uint64_t small = 0;    ///< parts of fewer than kSmallPartTets tets
  std::uint64_t largest_tets = 0;
  std::uint64_t tets = 0;  ///< tets that are written
  std::uint64_t vertices = 0;
  std::uint64_t hinge_vertices = 0;
  std::uint64_t hinge_edges = 0;
  std::vector<PartPlace> others;   ///< parts without the largest, those of the fewest tets first
  std::vector<HingePlace> hinges;  ///< in the order of rows
  std::uint64_t doubled = 0;       ///< vertices that were doubled
  std::uint64_t copies = 0;        ///< vertices that doubling added
  std::uint64_t parts_after = 0;   ///< parts of the mesh with its doubled vertices
  std::uint64_t wedges = 0;        ///< wedges between the sides of cohesive interfaces
  std::uint64_t closed = 0;        ///< facets of these interfaces with no vertex doubled
  std::uint64_t facets = 0;        ///< facets of all interfaces that should come apart
  std::uint64_t held = 0;          ///< those of them with no vertex doubled, which cannot open
  std::vector<LabelPair> apart;    ///< pairs that should come apart but share no face
  std::vector<LabelPair> unmet;    ///< pairs of ConnectOptions::watched that share no face
  std::uint64_t labels = 0;        ///< labels of the mesh, before parts were left out
  std::uint64_t stiff_labels = 0;  ///< labels without a vertex inside
  std::vector<RawLabel> stiff;     ///< the first kMostPlaces of those
};

}  // namespace mw::engine
