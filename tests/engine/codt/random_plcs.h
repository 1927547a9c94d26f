// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Requests for workers: windows of small volumes of every kind.
#pragma once

#include "engine/codt/worker_pool.h"
#include "kernels/odt/window_plc.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/odt/window_meshes.h"

namespace mw::engine::codt::test {

using mw::test::below;

/// A simplified part of a volume, dead vertices dropped.
[[nodiscard]] inline TetMesh random_mesh(std::mt19937& random) {
  using namespace mw::test;
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  const std::int64_t edge = 3 + below(random, 4);
  const SmallVolume volume =
      random_volume_of(random, kind, {edge, edge, edge}, 1 + below(random, 5));
  const bool whole = below(random, 2) == 0;
  TetMesh mesh = whole ? dense_mesh(volume) : dense_cutout(volume, {{1, 0, 1}, {edge, edge, edge}});
  simplify(mesh, Metric(), {.quality_floor = below(random, 2) == 0 ? 0.0 : 0.1});
  return without_dead_vertices(mesh, far_corner(volume.shape));
}

[[nodiscard]] inline Plc random_plc(std::mt19937& random) {
  return window_plc(random_mesh(random), Metric()).plc;
}

/// An answer as bytes, so that equal is equal to the last bit; empty when there was none.
using Answer = std::vector<std::byte>;

[[nodiscard]] inline Answer answer_of(WorkerPool& pool, const Plc& plc) {
  const std::optional<Triangulation> made = pool.triangulate(plc);
  if (!made) return {};
  Answer out(bytes_of(*made));
  put(*made, out);
  return out;
}

[[nodiscard]] inline bool has_worker() {
  return std::filesystem::exists(MW_CODT_WORKER);
}

}  // namespace mw::engine::codt::test
