// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/label_readers.h"

#include <algorithm>

#include "engine/window/window_memory.h"

namespace mw::engine {

std::uint64_t prepared_bytes(const io::DenseVolume& volume, const MeshSettings& settings,
                             const LabelNeed* need) {
  const Index3 shape = volume.info().shape;
  const bool sized = !settings.sizes.labels.empty();
  if (need == nullptr) return prepared_label_bytes(shape, sized);
  return prepared_label_bytes(bricks_of(*need, shape, settings), shape, sized);
}

LabelReaders::LabelReaders(const io::DenseVolume& volume, const MeshSettings& settings,
                           const RunHooks& hooks, RunStore& store) {
  const std::uint64_t each = preparation_bytes(settings);
  const auto max_threads = static_cast<std::uint64_t>(thread_count(hooks.threads));
  const auto at_once = std::clamp<std::uint64_t>(hooks.store.memory / 4 / each, 1, max_threads);
  threads = static_cast<int>(at_once);
  scratch = store.reserve(Purpose::kLabels, at_once * each + volume.raw().buffer_bytes(threads));
}

}  // namespace mw::engine
