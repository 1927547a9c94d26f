// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers as bytes of messages: the processes of a run have one program, and machines of one kind.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace mw::engine {

template <typename T>
[[nodiscard]] std::vector<std::byte> bytes_of(const T* first, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::byte> out(count * sizeof(T));
  if (count > 0) std::memcpy(out.data(), first, out.size());
  return out;
}

template <typename T>
[[nodiscard]] std::vector<T> list_of(const std::vector<std::byte>& bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

}  // namespace mw::engine
