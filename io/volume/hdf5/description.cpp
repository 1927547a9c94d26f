// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Packs a description as bytes, for the way between two processes on the same machine.
#include "io/volume/hdf5/description.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <type_traits>

namespace mw::io {
namespace {

using Numbers = std::map<std::string, std::vector<double>>;

/// Returns references to all members, in the order in which they are packed.
template <class Description>
auto members_of(Description& d) {
  return std::tie(d.path, d.shape, d.type, d.order, d.layout, d.offset, d.bytes, d.chunk_shape,
                  d.filters, d.edges_unfiltered, d.fill, d.chunks, d.numbers, d.axistags);
}

template <class T>
constexpr bool kIsNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class Run>
void append_run(const Run& run, std::string& out) {
  const auto bytes = std::as_bytes(std::span(run));
  out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// Packs numbers in 64 bits, and runs of them, of structs or of characters behind their length.
template <class T>
void pack_value(const T& value, std::string& out) {
  if constexpr (kIsNumber<T>) {
    append_run(std::array{static_cast<std::uint64_t>(value)}, out);
  } else {
    pack_value(value.size(), out);
    append_run(value, out);
  }
}
void pack_value(const Numbers& numbers, std::string& out) {
  pack_value(numbers.size(), out);
  for (const auto& [name, values] : numbers) pack_value(name, out), pack_value(values, out);
}

/// Reads what pack_value() packed.  What is not there reads as 0 or empty, and sound() says so.
class DescriptionReader {
 public:
  explicit DescriptionReader(const std::string& bytes) : left_(std::as_bytes(std::span(bytes))) {}

  template <class T>
  void read(T& value) {
    std::uint64_t number = 0;
    fill(std::as_writable_bytes(std::span(&number, 1)));
    if constexpr (kIsNumber<T>) {
      value = static_cast<T>(number);
      sound_ = sound_ && static_cast<std::uint64_t>(value) == number;
    } else {
      sound_ = sound_ && number <= left_.size() / sizeof(value[0]);
      value.resize(sound_ ? number : 0);
      fill(std::as_writable_bytes(std::span(value)));
    }
  }
  void read(Numbers& numbers) {
    std::uint64_t count = 0;
    for (read(count); count > 0 && sound_; --count) {
      std::string name;
      read(name);
      read(numbers[name]);
    }
  }
  /// Whether all was there, and nothing is left.
  [[nodiscard]] bool sound() const { return sound_ && left_.empty(); }

 private:
  void fill(std::span<std::byte> out) {
    sound_ = sound_ && out.size() <= left_.size();
    if (!sound_) return;
    std::copy_n(left_.begin(), out.size(), out.begin());
    left_ = left_.subspan(out.size());
  }

  std::span<const std::byte> left_;
  bool sound_ = true;
};

}  // namespace

std::string pack(const Hdf5Description& description) {
  std::string out;
  std::apply([&](const auto&... members) { (pack_value(members, out), ...); },
             members_of(description));
  return out;
}

std::optional<Hdf5Description> unpack_description(const std::string& bytes) {
  DescriptionReader in(bytes);
  Hdf5Description out;
  std::apply([&](auto&... members) { (in.read(members), ...); }, members_of(out));
  // Compared without a sign, as a broken child may send a negative one.
  const auto is_up_to = [](auto last, auto value) {
    return static_cast<std::uint64_t>(value) <= static_cast<std::uint64_t>(last);
  };
  const bool is_known = is_up_to(VoxelType::kF64, out.type) &&
                        is_up_to(ByteOrder::kBig, out.order) &&
                        is_up_to(Hdf5Layout::kChunked, out.layout);
  if (!in.sound() || !is_known) return {};
  return out;
}

}  // namespace mw::io
