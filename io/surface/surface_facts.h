// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What triangles make as a reader of their file finds them: whether they are closed, whether they
// are a manifold, and what they enclose.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "io/file/scratch/external_sort.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

struct SurfaceFacts {
  std::uint64_t triangles = 0;
  std::uint64_t open_edges = 0;        ///< with more triangles one way along them than the other
  std::uint64_t crowded_edges = 0;     ///< with two triangles or more the same way along them
  std::uint64_t pinched_vertices = 0;  ///< with several fans of triangles
  double volume = 0;                   ///< signed; what is enclosed where the surface is closed

  [[nodiscard]] bool is_closed() const { return open_edges == 0; }
  [[nodiscard]] bool is_manifold() const { return crowded_edges == 0 && pinched_vertices == 0; }
};

/// What a reader takes for one vertex.
enum class Joined : std::uint8_t {
  kByNumber,  ///< corners with the same number
  kByPlace,   ///< corners whose coordinates are the same in 32 bits
};

/// Passes a surface on, and finds out what it is before it passes on finish(): from the triangles
/// alone, and from the coordinates that the reader gets.  Triangles with a corner twice have no
/// area, and are left out.
/// Memory: 32 MiB; what does not fit waits in temporary files.
class SurfaceFactsSink : public SurfaceSink {
 public:
  /// REQUIRES: next outlives it.
  SurfaceFactsSink(SurfaceSink& next, Joined joined, const std::filesystem::path& folder);

  void begin(const SurfaceHeader& header) override { next_.begin(header); }
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

  /// REQUIRES: finish() was called.
  [[nodiscard]] const SurfaceFacts& facts() const { return facts_; }

 private:
  /// A sum of doubles that loses no more than a few of the last bits of the result (Neumaier 1974).
  class Sum {
   public:
    void add(double term);
    [[nodiscard]] double total() const { return sum_ + lost_; }

   private:
    double sum_ = 0;
    double lost_ = 0;
  };

  void join_places();
  [[nodiscard]] Position seen(const Position& position) const;

  SurfaceSink& next_;
  Joined joined_;
  std::filesystem::path folder_;
  PagedFile<Position> vertices_;
  ExternalSort<3> places_;                         ///< of vertices: x and y, z, number
  std::optional<PagedArray<std::uint64_t>> same_;  ///< by number: the first vertex at its place
  ExternalSort<3> corners_;        ///< a vertex, that of the next corner, that of the third
  std::optional<Position> first_;  ///< volumes are those of tets with this corner
  Sum volume6_;
  SurfaceFacts facts_;
};

}  // namespace mw::io
