// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The connected parts of classes, numbered so that those of a class follow each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/core/disjoint_sets.h"
#include "kernels/core/label.h"

namespace mw::audit {

/// The parts (sets) of all members, numbered by class and then by first member.
struct Parts {
  std::vector<std::uint32_t> of_member;
  std::vector<Label> part_class;  ///< ascending
};

/// Numbers the sets.  class_of(root) < class_count is asked once or twice for every root.
template <class ClassOf>
Parts number_parts(DisjointSets&& sets, std::size_t class_count, ClassOf&& class_of) {
  Parts parts{sets.take_parents(), {}};
  std::vector<std::uint32_t> next(class_count + 1, 0);
  const std::size_t count = parts.of_member.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (parts.of_member[i] == i) ++next[class_of(i) + 1];
  }
  for (std::size_t c = 0; c < class_count; ++c) {
    parts.part_class.insert(parts.part_class.end(), next[c + 1], static_cast<Label>(c));
    next[c + 1] += next[c];
  }
  // Parents are smaller, hence already replaced by their number when a member is reached.
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t parent = parts.of_member[i];
    parts.of_member[i] = parent == i ? next[class_of(i)]++ : parts.of_member[parent];
  }
  return parts;
}

}  // namespace mw::audit
