// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One segment of neuroglancer's legacy meshes.
#include "io/surface/precomputed/legacy_sink.h"

#include <limits>

#include "io/surface/binary_numbers.h"

namespace mw::io {

LegacySink::LegacySink(const std::filesystem::path& segment, double nm_per_unit)
    : segment_(segment),
      fragment_(segment.string() + ".mesh"),
      file_(fragment_),
      nm_per_unit_(nm_per_unit) {}

void LegacySink::begin(const SurfaceHeader& header) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
  check_max(segment_.string(), "vertices", header.vertices(), kMax);
  append_little(file_, static_cast<std::uint32_t>(header.vertices()));
}

void LegacySink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) append_little(file_, static_cast<float>(x * nm_per_unit_));
  }
}

void LegacySink::write_triangles(std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    for (const std::uint64_t vertex : triangle) {
      append_little(file_, static_cast<std::uint32_t>(vertex));
    }
  }
}

void LegacySink::finish() {
  file_.commit();
  AtomicFile manifest(segment_.string() + ":0");
  manifest.append("{\"fragments\":[\"" + fragment_.filename().string() + "\"]}\n");
  manifest.commit();
}

}  // namespace mw::io
