// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Packs a description as bytes, for the way between two processes on the same machine.
#include "io/volume/hdf5/description.h"

#include <cstring>

namespace mw::io {
namespace {

/// Writes everything as numbers of 64 bits, and runs of bytes behind their length.
class DescriptionWriter {
 public:
  void number(std::uint64_t value) {
    out_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void bytes(const void* data, std::size_t size) {
    number(size);
    if (size > 0) out_.append(static_cast<const char*>(data), size);
  }
  void string(const std::string& value) { bytes(value.data(), value.size()); }
  template <class T>
  void array(const std::vector<T>& values) {
    bytes(values.data(), values.size() * sizeof(T));
  }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

/// Reads what DescriptionWriter wrote.  What is not there reads as 0 or empty, and sound() says so.
class DescriptionReader {
 public:
  explicit DescriptionReader(const std::string& bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t number() {
    std::uint64_t value = 0;
    copy(&value, sizeof value);
    return value;
  }
  [[nodiscard]] std::string string() {
    std::string value(length(), '\0');
    copy(value.data(), value.size());
    return value;
  }
  template <class T>
  [[nodiscard]] std::vector<T> array() {
    const std::size_t size = length();
    std::vector<T> values(size / sizeof(T));
    sound_ = sound_ && size % sizeof(T) == 0;
    copy(values.data(), values.size() * sizeof(T));
    return values;
  }
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

 private:
  [[nodiscard]] std::size_t length() {
    const std::uint64_t claimed = number();
    sound_ = sound_ && claimed <= bytes_.size() - at_;
    return sound_ ? static_cast<std::size_t>(claimed) : 0;
  }
  void copy(void* out, std::size_t size) {
    sound_ = sound_ && size <= bytes_.size() - at_;
    if (!sound_ || size == 0) return;
    std::memcpy(out, bytes_.data() + at_, size);
    at_ += size;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
  bool sound_ = true;
};

void write_filters(DescriptionWriter& out, const std::vector<Hdf5Filter>& filters) {
  out.number(filters.size());
  for (const Hdf5Filter& filter : filters) {
    out.number(filter.id);
    out.array(filter.parameters);
  }
}

std::vector<Hdf5Filter> read_filters(DescriptionReader& in) {
  std::vector<Hdf5Filter> filters;
  for (std::uint64_t left = in.number(); left > 0 && in.sound(); --left) {
    const auto id = static_cast<std::uint32_t>(in.number());
    filters.push_back({.id = id, .parameters = in.array<std::uint32_t>()});
  }
  return filters;
}

void write_numbers(DescriptionWriter& out,
                   const std::map<std::string, std::vector<double>>& numbers) {
  out.number(numbers.size());
  for (const auto& [name, values] : numbers) {
    out.string(name);
    out.array(values);
  }
}

std::map<std::string, std::vector<double>> read_numbers(DescriptionReader& in) {
  std::map<std::string, std::vector<double>> numbers;
  for (std::uint64_t left = in.number(); left > 0 && in.sound(); --left) {
    const std::string name = in.string();
    numbers[name] = in.array<double>();
  }
  return numbers;
}

}  // namespace

std::string pack(const Hdf5Description& description) {
  DescriptionWriter out;
  out.string(description.path);
  out.array(description.shape);
  out.number(static_cast<std::uint64_t>(description.type));
  out.number(static_cast<std::uint64_t>(description.order));
  out.number(static_cast<std::uint64_t>(description.layout));
  out.number(description.offset);
  out.string(description.bytes);
  out.array(description.chunk_shape);
  write_filters(out, description.filters);
  out.number(description.edges_unfiltered ? 1 : 0);
  out.string(description.fill);
  out.array(description.chunks);
  write_numbers(out, description.numbers);
  out.string(description.axistags);
  return out.take();
}

std::optional<Hdf5Description> unpack_description(const std::string& bytes) {
  DescriptionReader in(bytes);
  Hdf5Description out;
  out.path = in.string();
  out.shape = in.array<std::uint64_t>();
  const std::uint64_t type = in.number();
  const std::uint64_t order = in.number();
  const std::uint64_t layout = in.number();
  if (type > static_cast<std::uint64_t>(VoxelType::kF64) || order > 1 || layout > 2) return {};
  out.type = static_cast<VoxelType>(type);
  out.order = static_cast<ByteOrder>(order);
  out.layout = static_cast<Hdf5Layout>(layout);
  out.offset = in.number();
  out.bytes = in.string();
  out.chunk_shape = in.array<std::uint64_t>();
  out.filters = read_filters(in);
  out.edges_unfiltered = in.number() != 0;
  out.fill = in.string();
  out.chunks = in.array<Hdf5Chunk>();
  out.numbers = read_numbers(in);
  out.axistags = in.string();
  if (!in.sound() || !in.at_end()) return {};
  return out;
}

}  // namespace mw::io
